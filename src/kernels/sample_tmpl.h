// SPDX-License-Identifier: MIT
// Texture sampling for 8 lanes. All lanes that read the same mip level are served together, so that sizes
// and addresses are the same for all of them and the arithmetic stays vector arithmetic; lanes next to each
// other on the screen nearly always do. A lane's result never depends on the other lanes.
//
// Coordinates are folded into 0..1 by the address mode before they meet the size of a level: the fold is
// exact for any finite coordinate, and what is not finite becomes 0, so that no texel outside is touched.
#ifndef RHW_SAMPLE_TMPL_H
#define RHW_SAMPLE_TMPL_H

#include "../half.h"
#include "../simd.h"
#include "../srgb.h"
#include "../texture.h"

// What one call needs at every level. s and t are folded coordinates.
struct sample_source {
    const struct rhw_texture_data *texture;
    const struct rhw_sampler_def *sampler;
    f8 s, t;
};

// Folded into 0..1, or −1..2 with a border, where only what lies outside the texture matters. NaN becomes
// the lower bound.
static inline f8 sample_fold(enum rhw_address address, f8 u)
{
    const f8 zero = rhw_splat(0.0f), one = rhw_splat(1.0f);
    switch (address) {
    case RHW_ADDRESS_REPEAT:
        return rhw_clamp(u - rhw_floor(u), zero, one);
    case RHW_ADDRESS_MIRROR: {
        const f8 period = u - 2.0f * rhw_floor(0.5f * u); // 0..2
        return rhw_clamp(1.0f - rhw_abs(period - 1.0f), zero, one);
    }
    case RHW_ADDRESS_BORDER:
        return rhw_clamp(u, rhw_splat(-1.0f), rhw_splat(2.0f));
    default:
        return rhw_clamp(u, zero, one);
    }
}

// Texel numbers that may lie one outside a level, into it. A repeated or mirrored edge is already exact:
// folding leaves −1 and `size` only for the neighbour across the edge. Border texels are clamped as well,
// and replaced after the fetch.
static inline i8 sample_wrap(enum rhw_address address, i8 i, int size)
{
    if (address == RHW_ADDRESS_REPEAT) {
        const i8 n = i8_splat(size);
        return i + (n & (i >> 31)) - (n & ~rhw_less_int(i, n));
    }
    return rhw_max_int(rhw_min_int(i, i8_splat(size - 1)), i8_splat(0));
}

static inline i8 sample_outside(i8 i, int size)
{
    return (i >> 31) | ~rhw_less_int(i, i8_splat(size));
}

// c / 255 correctly rounded for whole c of 0..255: 1/255 = 1/256 + 1/65280.
RHW_INLINE f8 sample_unorm8(i8 code)
{
    const f8 c = rhw_to_float(code);
    return c * 0x1p-8f + c * 1.53186284e-05f;
}

// Texels (x, y) of a level as floats, colour linear.
static inline void sample_fetch(enum rhw_format format, const struct rhw_mip *mip, i8 x, i8 y, f8 texel[4])
{
    const size_t size = format == RHW_FORMAT_R8_UNORM    ? 1
                        : format == RHW_FORMAT_RG8_UNORM ? 2
                        : format == RHW_FORMAT_RGBA16_FLOAT ? 8
                        : format == RHW_FORMAT_RGBA32_FLOAT ? 16
                                                            : 4;
    const unsigned char *from[RHW_LANES];
    for (int i = 0; i < RHW_LANES; i++) {
        from[i] = mip->texels + (size_t)y[i] * mip->row_pitch + (size_t)x[i] * size;
    }
    texel[1] = texel[2] = rhw_splat(0.0f);
    texel[3] = rhw_splat(1.0f);
    switch (format) {
    case RHW_FORMAT_R8_UNORM:
    case RHW_FORMAT_RG8_UNORM: {
        i8 code[2];
        for (int i = 0; i < RHW_LANES; i++) {
            code[0][i] = from[i][0];
            code[1][i] = from[i][size - 1];
        }
        texel[0] = sample_unorm8(code[0]);
        texel[1] = size == 2 ? sample_unorm8(code[1]) : texel[1];
        break;
    }
    case RHW_FORMAT_RGBA8_UNORM:
    case RHW_FORMAT_RGBA8_SRGB: {
        i8 code;
        for (int i = 0; i < RHW_LANES; i++) {
            memcpy((char *)&code + 4 * i, from[i], 4);
        }
        if (format == RHW_FORMAT_RGBA8_UNORM) {
            for (int j = 0; j < 3; j++) {
                texel[j] = sample_unorm8((code >> (8 * j)) & 0xff);
            }
        } else {
            for (int i = 0; i < RHW_LANES; i++) {
                texel[0][i] = rhw_srgb_decode_table[code[i] & 0xff];
                texel[1][i] = rhw_srgb_decode_table[code[i] >> 8 & 0xff];
                texel[2][i] = rhw_srgb_decode_table[code[i] >> 16 & 0xff];
            }
        }
        texel[3] = sample_unorm8((code >> 24) & 0xff);
        break;
    }
    case RHW_FORMAT_RGBA16_FLOAT:
        for (int i = 0; i < RHW_LANES; i++) {
            uint16_t half[4];
            memcpy(half, from[i], sizeof half);
            for (int j = 0; j < 4; j++) {
                texel[j][i] = rhw_half_to_float(half[j]);
            }
        }
        break;
    case RHW_FORMAT_RGBA32_FLOAT:
        for (int i = 0; i < RHW_LANES; i++) {
            float value[4];
            memcpy(value, from[i], sizeof value);
            for (int j = 0; j < 4; j++) {
                texel[j][i] = value[j];
            }
        }
        break;
    default: // R32_FLOAT, D32_FLOAT
        for (int i = 0; i < RHW_LANES; i++) {
            memcpy((char *)&texel[0] + 4 * i, from[i], 4);
        }
        break;
    }
}

// As sample_fetch, for texel numbers that may lie outside the level.
static inline void sample_fetch_wrapped(const struct sample_source *source, const struct rhw_mip *mip, i8 x, i8 y,
                                        f8 texel[4])
{
    const struct rhw_sampler_def *const sampler = source->sampler;
    sample_fetch(source->texture->format, mip, sample_wrap(sampler->address_u, x, mip->width),
                 sample_wrap(sampler->address_v, y, mip->height), texel);
    i8 outside = i8_splat(0);
    if (sampler->address_u == RHW_ADDRESS_BORDER) {
        outside = outside | sample_outside(x, mip->width);
    }
    if (sampler->address_v == RHW_ADDRESS_BORDER) {
        outside = outside | sample_outside(y, mip->height);
    }
    if (rhw_any(outside)) {
        for (int i = 0; i < 4; i++) {
            texel[i] = rhw_select(outside, rhw_splat(sampler->border[i]), texel[i]);
        }
    }
}

static inline void sample_nearest(const struct sample_source *source, const struct rhw_mip *mip, f8 texel[4])
{
    i8 x = rhw_to_int_unchecked(rhw_floor(source->s * (float)mip->width));
    i8 y = rhw_to_int_unchecked(rhw_floor(source->t * (float)mip->height));
    // s = 1 stands for a coordinate just below the edge where the texture repeats.
    if (source->sampler->address_u != RHW_ADDRESS_BORDER) {
        x = rhw_min_int(x, i8_splat(mip->width - 1));
    }
    if (source->sampler->address_v != RHW_ADDRESS_BORDER) {
        y = rhw_min_int(y, i8_splat(mip->height - 1));
    }
    sample_fetch_wrapped(source, mip, x, y, texel);
}

static inline void sample_bilinear(const struct sample_source *source, const struct rhw_mip *mip, f8 texel[4])
{
    const f8 x = source->s * (float)mip->width - 0.5f, y = source->t * (float)mip->height - 0.5f;
    const f8 left = rhw_floor(x), top = rhw_floor(y);
    const f8 weight_x = x - left, weight_y = y - top;
    const i8 x0 = rhw_to_int_unchecked(left), y0 = rhw_to_int_unchecked(top);
    f8 corner[4][4];
    for (int i = 0; i < 4; i++) {
        sample_fetch_wrapped(source, mip, x0 + (i & 1), y0 + (i >> 1), corner[i]);
    }
    for (int i = 0; i < 4; i++) {
        const f8 above = rhw_mix(corner[0][i], corner[1][i], weight_x);
        const f8 below = rhw_mix(corner[2][i], corner[3][i], weight_x);
        texel[i] = rhw_mix(above, below, weight_y);
    }
}

static inline void sample_level(const struct sample_source *source, int level, enum rhw_filter filter, f8 texel[4])
{
    const struct rhw_mip *const mip = &source->texture->mip[level];
    if (filter == RHW_FILTER_LINEAR) {
        sample_bilinear(source, mip, texel);
    } else {
        sample_nearest(source, mip, texel);
    }
}

// log2 within 2^-16, exact at powers of two: the level of detail needs no more. Denormals and 0 give −127 or
// less than that, infinity 128.
static inline f8 sample_log2(f8 a)
{
    const i8 bits = (i8)a;
    const f8 t = (f8)((bits & 0x7fffff) | 0x3f800000) - 1.0f;
    const f8 curve = ((0.0451637469f * t - 0.148464322f) * t + 0.267204642f) * t - 0.441921592f;
    return rhw_to_float((bits >> 23) - 127) + (t + t * (t - 1.0f) * curve);
}

// Level of detail after OpenGL ES 3.0 §3.8.10, biased and limited by the sampler. Half the logarithm of the
// squared length spares the square root.
static inline f8 sample_lod(const struct sample_source *source, const f8 *grad, const f8 *lod)
{
    const struct rhw_sampler_def *const sampler = source->sampler;
    f8 level = lod ? *lod : rhw_splat(0.0f);
    if (grad) {
        const float width = (float)source->texture->mip[0].width, height = (float)source->texture->mip[0].height;
        const f8 ux = grad[0] * width, vx = grad[1] * height;
        const f8 uy = grad[2] * width, vy = grad[3] * height;
        level = 0.5f * sample_log2(rhw_max(ux * ux + vx * vx, uy * uy + vy * vy));
    }
    return rhw_clamp(level + sampler->lod_bias, rhw_splat(sampler->lod_min), rhw_splat(sampler->lod_max));
}

// All lanes at the levels that `level` names, by one filter; `fraction` of the way to the next level where
// it is above 0.
static inline void sample_levels(const struct sample_source *source, i8 level, f8 fraction, enum rhw_filter filter,
                                 f8 texel[4])
{
    const i8 between = rhw_less(rhw_splat(0.0f), fraction);
    for (unsigned todo = 0xff; todo != 0;) {
        const int first = level[__builtin_ctz(todo)];
        const i8 same = rhw_equal_int(level, i8_splat(first));
        todo &= ~(unsigned)rhw_mask_bits(same);
        f8 fine[4];
        sample_level(source, first, filter, fine);
        if (rhw_any(same & between)) {
            f8 coarse[4];
            sample_level(source, first + 1, filter, coarse);
            for (int i = 0; i < 4; i++) {
                fine[i] = rhw_select(between, rhw_mix(fine[i], coarse[i], fraction), fine[i]);
            }
        }
        for (int i = 0; i < 4; i++) {
            texel[i] = rhw_select(same, fine[i], texel[i]);
        }
    }
}

static void sample(const struct rhw_binding *binding, const rhw_float uv[2], const rhw_float grad[4],
                   const rhw_float *lod, rhw_float texel[4])
{
    const struct rhw_texture_data *const texture = binding->texture;
    const struct rhw_sampler_def *const sampler = binding->sampler;
    texel[0] = texel[1] = texel[2] = rhw_splat(0.0f);
    texel[3] = rhw_splat(1.0f);
    if (!texture) {
        return;
    }
    const struct sample_source source = {texture, sampler, sample_fold(sampler->address_u, uv[0]),
                                         sample_fold(sampler->address_v, uv[1])};
    const f8 zero = rhw_splat(0.0f);
    const bool one_level = texture->levels == 1 || sampler->mip_filter == RHW_MIP_FILTER_NONE;
    if (one_level && sampler->min_filter == sampler->mag_filter) {
        sample_level(&source, 0, sampler->min_filter, texel);
        return;
    }
    const f8 detail = sample_lod(&source, grad, lod);
    const f8 last = rhw_splat((float)(one_level ? 0 : texture->levels - 1));
    const f8 within = rhw_clamp(detail, zero, last);
    const bool blended = sampler->mip_filter == RHW_MIP_FILTER_LINEAR;
    const f8 level = blended ? rhw_floor(within) : rhw_max(rhw_ceil(within - 0.5f), zero);
    const f8 fraction = blended ? within - level : zero;
    const i8 number = rhw_to_int_unchecked(level);
    sample_levels(&source, number, fraction, sampler->min_filter, texel);
    const i8 magnified = rhw_less_equal(detail, zero);
    if (sampler->mag_filter != sampler->min_filter && rhw_any(magnified)) {
        f8 large[4];
        sample_level(&source, 0, sampler->mag_filter, large);
        for (int i = 0; i < 4; i++) {
            texel[i] = rhw_select(magnified, large[i], texel[i]);
        }
    }
}

#endif
