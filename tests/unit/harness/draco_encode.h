// SPDX-License-Identifier: MIT
// Draco's encoder for tests in C.
#ifndef TEST_DRACO_ENCODE_H
#define TEST_DRACO_ENCODE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Triangles of three corners each, with an attribute for each array that is not NULL: positions (unique id 0), normals (1),
/// texture coordinates (2), colours of 8 bits (3), and joints as floats (4).
struct draco_soup {
    int triangles;
    const float (*positions)[3], (*normals)[3], (*uvs)[2];
    const uint8_t (*colors)[4];
    const float (*joints)[4];
    int position_bits, normal_bits, uv_bits, joint_bits; ///< of quantization; 0: floats are kept
};

/// At most `room` bytes into `bytes`; returns how many, 0 for failure.
size_t draco_encode(const struct draco_soup *soup, unsigned char *bytes, size_t room);

#ifdef __cplusplus
}
#endif

#endif
