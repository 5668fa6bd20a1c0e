// SPDX-License-Identifier: MIT
// 8 texels of several samples become texels of one. The tiles' resolve and the resolve of whole regions use this.
#ifndef RHW_RESOLVE_TEXELS_H
#define RHW_RESOLVE_TEXELS_H

#include "mip_codec.h"
#include "rhw/pass_def.h"

// What to resolve: 8 pixels, as the texels of each sample.
struct sample_row {
    const unsigned char *texels[RHW_MAX_SAMPLES];
    int count;
};

RHW_INLINE f32x8 resolved_value(enum rhw_resolve mode, const f32x8 *value, int count)
{
    f32x8 result = value[0];
    for (int s = 1; s < count; s++) {
        result = mode == RHW_RESOLVE_MIN   ? rhw_min(value[s], result)
                 : mode == RHW_RESOLVE_MAX ? rhw_max(value[s], result)
                                           : result + value[s];
    }
    return mode == RHW_RESOLVE_AVERAGE ? result * rhw_splat(1.0f / (float)count) : result;
}

// Store the mean of 4 samples of RGBA8_UNORM, or of its channels in another order, in the pixels of `lanes`. This is
// resolve_row with all that it has to ask known. Equal bytes have themselves as mean, as only means halfway between two
// depend on how sums are rounded.
RHW_INLINE void resolve_unorm8(const i32x8 sample[4], unsigned lanes, unsigned char *to)
{
    const i32x8 differ = (sample[1] ^ sample[0]) | (sample[2] ^ sample[0]) | (sample[3] ^ sample[0]);
    f32x8 mean[4];
    if ((i32x8_sign_bits(rhw_equal_int(differ, i32x8_splat(0))) & lanes) == lanes) {
        store_words(to, sample[0], i32x8_from_bits(lanes));
        return;
    }
    for (int c = 0; c < 4; c++) {
        mean[c] = unorm8_to_float(channel_byte(sample[0], c));
        for (int s = 1; s < 4; s++) {
            mean[c] = mean[c] + unorm8_to_float(channel_byte(sample[s], c));
        }
        mean[c] = mean[c] * (1.0f / 4);
    }
    store_words(to, unorm8_texels(mean), i32x8_from_bits(lanes));
}

// Resolve the pixels of `lanes`.
RHW_INLINE void resolve_row(const struct rhw_format_info *info, enum rhw_resolve mode,
                            const struct sample_row *row, unsigned lanes, unsigned char *to)
{
    struct raw_texels sample[RHW_MAX_SAMPLES], raw;
    f32x8 value[4][RHW_MAX_SAMPLES], result[4];
    const int count = mode == RHW_RESOLVE_SAMPLE_ZERO ? 1 : row->count;
    const struct raw_texels *const first = &sample[0];
    i32x8 agree = i32x8_splat(-1);
    const int words = (int)(info->size + 3) / 4;
    for (int s = 0; s < count; s++) {
        load_texel_row(info->size, row->texels[s], &sample[s]);
        for (int w = 0; w < words; w++) {
            agree &= rhw_equal_int(sample[s].word[w], first->word[w]);
        }
    }
    if ((i32x8_sign_bits(agree) & lanes) == lanes) {
        store_texel_row(info->size, first, i32x8_from_bits(lanes), to);
        return;
    }
    for (int s = 0; s < count; s++) {
        f32x8 channels[4];
        decode_texels(info, &sample[s], channels);
        for (int c = 0; c < 4; c++) {
            value[c][s] = channels[c];
        }
    }
    for (int c = 0; c < 4; c++) {
        result[c] = canonical_nan(resolved_value(mode, value[c], count));
    }
    encode_texels(info, result, &raw);
    // A mean of equal floats may round to another float.
    for (int w = 0; w < words; w++) {
        raw.word[w] = rhw_select_int(agree, first->word[w], raw.word[w]);
    }
    store_texel_row(info->size, &raw, i32x8_from_bits(lanes), to);
}

#endif
