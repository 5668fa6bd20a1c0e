// SPDX-License-Identifier: MIT
// The sRGB transfer function (IEC 61966-2-1), both ways, as tables. They are exact, the same on every machine, and
// faster than any polynomial. No pow runs when pictures are made.
#ifndef RHW_SRGB_H
#define RHW_SRGB_H

#include <stdint.h>
#include <string.h>

// The linear value of each 8-bit code c: the float nearest to s/12.92 for s = c/255 up to 0.04045, and to ((s +
// 0.055)/1.055)^2.4 for s above.
extern const float rhw_srgb_decode_table[256];

// The encoder's inverse has 255 thresholds. The floats of 2^-13 .. 1 are cut into buckets of equal upper 16 bits. No
// bucket holds more than one threshold (at 1, where they are densest, a bucket is 1/128 of a binade wide and the code
// grows by 0.87 over it). A bucket's entry is (code at its start) << 16, plus 2^16 − t when a threshold whose lower 16
// bits are t lies inside: adding the lower 16 bits of a value then carries into the code exactly from the threshold on.
enum {
    // The upper 16 bits of 2^-13, which is below the first threshold 1.5176e-4.
    RHW_SRGB_ENCODE_FIRST = 0x3900,
    RHW_SRGB_ENCODE_COUNT = 0x3f80 - RHW_SRGB_ENCODE_FIRST + 1
};
extern const uint32_t rhw_srgb_encode_table[RHW_SRGB_ENCODE_COUNT];

// Return the 8-bit code nearest to the encoded value, for every float. NaN and values below 0 give 0.
static inline uint8_t rhw_srgb_encode(float linear)
{
    const float above = linear > 0x1p-13f ? linear : 0x1p-13f;
    const float clamped = above < 1.0f ? above : 1.0f;
    uint32_t bits;
    memcpy(&bits, &clamped, sizeof bits);
    return (uint8_t)((rhw_srgb_encode_table[(bits >> 16) - RHW_SRGB_ENCODE_FIRST] + (bits & 0xffff)) >> 16);
}

#endif
