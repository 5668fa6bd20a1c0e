// SPDX-License-Identifier: MIT
// Clear values become texels by the code that stores 8 fragments, so that no codec is written twice.
#include "clear_texel.h"

#include "kernels/texel/texel_codec.h"

void rhw_clear_texel(const struct rhw_format_info *format, const float value[4], unsigned char *texel)
{
    struct raw_texels raw = {{{0}, {0}, {0}, {0}}};
    f32x8 lanes[4];
    for (int c = 0; c < 4; c++) {
        int32_t bits; // a float that passes through float registers may change
        memcpy(&bits, &value[c], sizeof bits);
        lanes[c] = (f32x8)i32x8_splat(bits);
        if (!rhw_format_is_integer(format)) {
            lanes[c] = canonical_nan(lanes[c]);
        }
    }
    encode_texels(format, lanes, &raw);
    for (size_t i = 0; i < format->size; i += 4) {
        const int32_t word = raw.word[i / 4][0];
        memcpy(texel + i, &word, format->size - i < 4 ? format->size - i : 4);
    }
}
