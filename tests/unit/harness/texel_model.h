// SPDX-License-Identifier: MIT
// Texels of every colour format that is not compressed, one channel at a time, in double: where channels stand is read
// from the format's name, what they hold from the Vulkan specification. It shares nothing with the library's table.
#ifndef TEST_TEXEL_MODEL_H
#define TEST_TEXEL_MODEL_H

#include <rhw/rhw.h>
#include <stdbool.h>

enum texel_type { TEXEL_UNORM, TEXEL_SRGB, TEXEL_SNORM, TEXEL_UINT, TEXEL_SINT, TEXEL_FLOAT, TEXEL_SHARED };

struct texel_model {
    enum texel_type type;
    int channels;          ///< letters in the name
    int bytes;             ///< of a texel
    bool has[4];           ///< by channel: red, green, blue, alpha
    int first[4], bits[4]; ///< of the texel as a little-endian number
};

/// `name`: "RHW_FORMAT_RGB10A2_UNORM".
struct texel_model texel_model_of(const char *name);

/// Bits of the floats that a shader receives; of integers, of those.
void texel_model_decode(const struct texel_model *model, const unsigned char *texel, uint32_t bits[4]);
/// The texel of what a shader writes.
void texel_model_encode(const struct texel_model *model, const uint32_t bits[4], unsigned char *texel);
/// Sets the bits of the channels in a write mask.
void texel_model_mask(const struct texel_model *model, unsigned write_mask, unsigned char *texel);

#endif
