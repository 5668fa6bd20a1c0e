// SPDX-License-Identifier: MIT
// Texture sampling for 8 lanes. All lanes that read the same mip level are served together, so that sizes
// and addresses are the same for all of them and the arithmetic stays vector arithmetic; lanes next to each
// other on the screen nearly always do. A lane's result never depends on the other lanes.
//
// Coordinates are folded into 0..1 by the address mode before they meet the size of a level: the fold rounds
// to 2^-24 at most, however large the coordinate, and what is not finite lands on an edge, so that no texel
// outside is touched.
#ifndef RHW_SAMPLE_TMPL_H
#define RHW_SAMPLE_TMPL_H

#include "texel_tmpl.h"

// What one call needs at every level. s and t are folded coordinates.
struct sample_source {
    const struct rhw_texture_data *texture;
    const struct rhw_sampler_def *sampler;
    bool border; // along u or v
    f8 s, t;
};

// As sample_fetch, for texel numbers that may lie outside the level.
static inline void sample_fetch_wrapped(const struct sample_source *source, const struct rhw_mip *mip, i8 x,
                                        i8 y, f8 texel[4])
{
    const struct rhw_sampler_def *const sampler = source->sampler;
    sample_fetch(source->texture->format, mip, sample_wrap(sampler->address_u, x, mip->width),
                 sample_wrap(sampler->address_v, y, mip->height), texel);
    i8 outside = i8_splat(0);
    if (!source->border) {
        return;
    }
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

// &texture->mip[level], found by a loop where an index would do: the processor predicts when the loop ends and
// starts to load texels before it has worked out the level of detail, which saves a quarter of the time.
RHW_INLINE const struct rhw_mip *sample_mip(const struct rhw_texture_data *texture, int level)
{
    const struct rhw_mip *mip = texture->mip;
    for (int i = 0; i < level; i++) {
        mip++;
        __asm__("" : "+r"(mip)); // or the compiler would see through it
    }
    return mip;
}

// 8 bits in fixed point -----------------------------------------------------------------------------
// The usual case. A texel's four channels stand as 16-bit numbers, 255 · 128 for 1, two in each 32-bit lane,
// and are mixed with weights of 15 bits: one multiplication serves two channels, and no step is off by more
// than half a unit. Equal texels mix to exactly themselves. RGBA8_UNORM is widened when it is loaded;
// RGBA8_SRGB stands so in memory, decoded (srgb_texture.h).

struct sample_codes {
    i8 rb; // red in the lower, blue in the upper half
    i8 ga;
};

// Where 8 lanes meet one level.
struct sample_place {
    i8 xy;                 // top left texel of the four: x in the upper, y in the lower half, from −1
    i8 weight_x, weight_y; // of the right and the lower texels, 0.15, in both halves
};

RHW_INLINE i8 sample_mix_half(i8 a, i8 b, i8 weight)
{
    return (i8)((s16)a + s16_scale((s16)b - (s16)a, (s16)weight));
}

RHW_INLINE struct sample_codes sample_mix_codes(struct sample_codes a, struct sample_codes b, i8 weight)
{
    return (struct sample_codes){sample_mix_half(a.rb, b.rb, weight), sample_mix_half(a.ga, b.ga, weight)};
}

RHW_INLINE struct sample_codes sample_widen(i8 texel)
{
    return (struct sample_codes){(texel << 7) & 0x7f807f80, (i8)(((u8)texel >> 1) & 0x7f807f80u)};
}

// Coordinates in texels, 16.16, at most 16384 · 2^16 = 2^30. A negative one is truncated to the texel
// edge where flooring would give the neighbour with the whole weight on this one.
RHW_INLINE struct sample_place sample_place(const struct sample_source *source, const struct rhw_mip *mip)
{
    const i8 x = rhw_to_int_unchecked(source->s * mip->scale_x - 32768.0f);
    const i8 y = rhw_to_int_unchecked(source->t * mip->scale_y - 32768.0f);
    // A weight is the fraction without its last bit.
    return (struct sample_place){i8_join_upper(x, y), i8_halve_lower(x), i8_halve_lower(y)};
}

// The linear texels with these numbers, and their right neighbours.
RHW_INLINE void sample_load_linear_pairs(const unsigned char *texels, const uint32_t at[RHW_LANES],
                                         struct sample_codes *left, struct sample_codes *right)
{
    f4 row[RHW_LANES];
    for (int i = 0; i < RHW_LANES; i++) {
        memcpy(&row[i], texels + (size_t)at[i] * RHW_LINEAR_TEXEL, sizeof row[i]);
    }
    f8 column[4];
    f4_columns(row, column);
    *left = (struct sample_codes){(i8)column[0], (i8)column[1]};
    *right = (struct sample_codes){(i8)column[2], (i8)column[3]};
}

// The texels at these places.
RHW_INLINE struct sample_codes sample_load_codes(const struct rhw_mip *mip, i8 xy, bool linear)
{
    const i8 index = sample_index(xy, mip->step);
    if (linear) {
        return (struct sample_codes){i8_gather(mip->linear, index + index),
                                     i8_gather(mip->linear + 4, index + index)};
    }
    return sample_widen(i8_gather(mip->texels, index));
}

// The four texels of each lane where some lie across an edge.
static __attribute__((noinline)) void sample_corners_wrapped(const struct rhw_sampler_def *sampler,
                                                             const struct rhw_mip *mip, const i8 *xy,
                                                             bool linear, struct sample_codes corner[4])
{
    const i8 x = *xy >> 16, y = (*xy << 16) >> 16;
    const i8 x0 = sample_wrap(sampler->address_u, x, mip->width) << 16;
    const i8 x1 = sample_wrap(sampler->address_u, x + 1, mip->width) << 16;
    const i8 y0 = sample_wrap(sampler->address_v, y, mip->height);
    const i8 y1 = sample_wrap(sampler->address_v, y + 1, mip->height);
    corner[0] = sample_load_codes(mip, x0 | y0, linear);
    corner[1] = sample_load_codes(mip, x1 | y0, linear);
    corner[2] = sample_load_codes(mip, x0 | y1, linear);
    corner[3] = sample_load_codes(mip, x1 | y1, linear);
}

RHW_INLINE void sample_corners(const struct sample_source *source, const struct rhw_mip *mip,
                               const struct sample_place *place, bool linear, struct sample_codes corner[4])
{
    // Whether the four texels of every lane lie side by side in the level; −1 is large as an unsigned number.
    const bool interior = mip->interior >= 0 && i8_halves_within(place->xy, mip->interior);
    if (__builtin_expect(!interior, 0)) {
        const i8 xy = place->xy; // a copy, so that the one in registers stays there
        sample_corners_wrapped(source->sampler, mip, &xy, linear, corner);
        return;
    }
    uint32_t at[RHW_LANES];
    sample_spill(sample_index(place->xy, mip->step), at);
    if (linear) {
        sample_load_linear_pairs(mip->linear, at, &corner[0], &corner[1]);
        sample_load_linear_pairs(mip->linear + (RHW_LINEAR_TEXEL / 4) * mip->row_pitch, at, &corner[2],
                                 &corner[3]);
    } else {
        i8 texel[4];
        i8_load_pairs(mip->texels, at, &texel[0], &texel[1]);
        i8_load_pairs(mip->texels + mip->row_pitch, at, &texel[2], &texel[3]);
        for (int i = 0; i < 4; i++) {
            corner[i] = sample_widen(texel[i]);
        }
    }
}

// `linear`: the texels are RGBA8_SRGB; a constant where a call names it, here and below.
RHW_INLINE struct sample_codes sample_bilinear_codes(const struct sample_source *source,
                                                     const struct rhw_mip *mip, bool linear)
{
    const struct sample_place place = sample_place(source, mip);
    struct sample_codes corner[4];
    sample_corners(source, mip, &place, linear, corner);
    const struct sample_codes above = sample_mix_codes(corner[0], corner[1], place.weight_x);
    const struct sample_codes below = sample_mix_codes(corner[2], corner[3], place.weight_x);
    return sample_mix_codes(above, below, place.weight_y);
}

// One level, and where any lane in `live` has a weight the next one. A weight of 0 leaves a lane as it is.
RHW_INLINE struct sample_codes sample_trilinear_codes(const struct sample_source *source, int level,
                                                      i8 weight, i8 live, bool linear)
{
    const struct rhw_mip *const mip = sample_mip(source->texture, level);
    const struct sample_codes fine = sample_bilinear_codes(source, mip, linear);
    if (!i8_any_bit(weight & live)) {
        return fine;
    }
    return sample_mix_codes(fine, sample_bilinear_codes(source, mip + 1, linear), weight);
}

// Lanes at different levels, one level after the other.
static __attribute__((noinline)) void sample_mixed_codes(const struct sample_source *source, const i8 *level,
                                                         const i8 *weight, bool linear,
                                                         struct sample_codes *result)
{
    result->rb = result->ga = i8_splat(0);
    for (unsigned todo = 0xff; todo != 0;) {
        const int first = (*level)[__builtin_ctz(todo)];
        const i8 same = rhw_equal_int(*level, i8_splat(first));
        todo &= ~(unsigned)rhw_mask_bits(same);
        const struct sample_codes codes = sample_trilinear_codes(source, first, *weight, same, linear);
        result->rb = rhw_select_int(same, codes.rb, result->rb);
        result->ga = rhw_select_int(same, codes.ga, result->ga);
    }
}

// Code 8.7 / (255 · 128); codes without fraction give c / 255 correctly rounded.
RHW_INLINE f8 sample_from_code(i8 code)
{
    const f8 c = rhw_to_float(code);
    return c * 0x1p-15f + c * 1.19676784e-07f;
}

RHW_INLINE void sample_unpack_codes(struct sample_codes codes, f8 texel[4])
{
    texel[0] = sample_from_code(codes.rb & 0xffff);
    texel[1] = sample_from_code(codes.ga & 0xffff);
    texel[2] = sample_from_code(codes.rb >> 16);
    texel[3] = sample_from_code(codes.ga >> 16);
}

// LINEAR, no border, at levels of detail that the texture has: `detail` in 16.16.
RHW_INLINE void sample_detail_codes(const struct sample_source *source, i8 detail, bool linear, f8 texel[4])
{
    const i8 level = detail >> 16, weight = i8_halve_lower(detail);
    const int first = level[0];
    struct sample_codes result;
    if (__builtin_expect(rhw_all(rhw_equal_int(level, i8_splat(first))), 1)) {
        result = sample_trilinear_codes(source, first, weight, i8_splat(-1), linear);
    } else {
        const i8 levels = level, weights = weight;
        sample_mixed_codes(source, &levels, &weights, linear, &result);
    }
    sample_unpack_codes(result, texel);
}

// Level of detail and the whole ---------------------------------------------------------------------

// log2(a) / 2 within 2^-17, exact at powers of four: the level of detail needs no more. The bits of a float,
// read as a number, are its logarithm but for the curve between powers of two. 0 gives −63.5, infinity and
// NaN 64: the bits of a NaN differ between processors.
RHW_INLINE f8 sample_half_log2(f8 a)
{
    const i8 bits = (i8)rhw_min(a, rhw_splat(3.4028235e38f));
    const f8 straight = rhw_to_float(bits) * 0x1p-24f - 63.5f;
    const f8 t = (f8)((bits & 0x7fffff) | 0x3f800000) - 1.0f;
    const f8 square = t * t;
    const f8 curve = (0.133602321f * t - 0.220960796f) + square * (0.02258187345f * t - 0.074232161f);
    return straight + (square - t) * curve;
}

// Level of detail after OpenGL ES 3.0 §3.8.10, biased but not yet limited. Half the logarithm of the squared
// length spares the square root.
RHW_INLINE f8 sample_detail(const struct sample_source *source, const f8 *grad, const f8 *lod)
{
    const float bias = source->sampler->lod_bias;
    if (!grad) {
        return (lod ? *lod : rhw_splat(0.0f)) + bias;
    }
    const struct rhw_mip *const mip = &source->texture->mip[0]; // whose scale is 2^16 too large
    const f8 scale_x = f8_splat(mip->scale_x), scale_y = f8_splat(mip->scale_y);
    const f8 ux = grad[0] * scale_x, vx = grad[1] * scale_y;
    const f8 uy = grad[2] * scale_x, vy = grad[3] * scale_y;
    return sample_half_log2(rhw_max(ux * ux + vx * vx, uy * uy + vy * vy)) + (bias - 16.0f);
}

static inline void sample_level(const struct sample_source *source, const struct rhw_mip *mip,
                                enum rhw_filter filter, f8 texel[4])
{
    if (filter == RHW_FILTER_LINEAR && source->texture->format == RHW_FORMAT_RGBA8_SRGB && !source->border) {
        sample_unpack_codes(sample_bilinear_codes(source, mip, true), texel);
    } else if (filter == RHW_FILTER_LINEAR) {
        sample_bilinear(source, mip, texel);
    } else {
        sample_nearest(source, mip, texel);
    }
}

// All lanes at the levels that `level` names, by one filter; `fraction` of the way to the next level where
// it is above 0.
static inline void sample_levels(const struct sample_source *source, i8 level, f8 fraction,
                                 enum rhw_filter filter, f8 texel[4])
{
    const i8 between = rhw_less(rhw_splat(0.0f), fraction);
    texel[0] = texel[1] = texel[2] = texel[3] = rhw_splat(0.0f);
    for (unsigned todo = 0xff; todo != 0;) {
        const int first = level[__builtin_ctz(todo)];
        const i8 same = rhw_equal_int(level, i8_splat(first));
        todo &= ~(unsigned)rhw_mask_bits(same);
        const struct rhw_mip *const mip = sample_mip(source->texture, first);
        f8 fine[4];
        sample_level(source, mip, filter, fine);
        if (rhw_any(same & between)) {
            f8 coarse[4];
            sample_level(source, mip + 1, filter, coarse);
            for (int i = 0; i < 4; i++) {
                fine[i] = rhw_select(between, rhw_mix(fine[i], coarse[i], fraction), fine[i]);
            }
        }
        for (int i = 0; i < 4; i++) {
            texel[i] = rhw_select(same, fine[i], texel[i]);
        }
    }
}

// Everything but the fixed-point road. `last` is the last level that may be used.
static __attribute__((noinline)) void sample_any(const struct sample_source *source, const f8 *grad,
                                                 const f8 *lod, float last, f8 texel[4])
{
    const struct rhw_sampler_def *const sampler = source->sampler;
    const f8 zero = rhw_splat(0.0f);
    const f8 detail =
        rhw_clamp(sample_detail(source, grad, lod), rhw_splat(sampler->lod_min), rhw_splat(sampler->lod_max));
    const f8 within = rhw_clamp(detail, zero, rhw_splat(last));
    const bool blended = sampler->mip_filter == RHW_MIP_FILTER_LINEAR;
    const f8 level = blended ? rhw_floor(within) : rhw_max(rhw_ceil(within - 0.5f), zero);
    const f8 fraction = blended ? within - level : zero;
    sample_levels(source, rhw_to_int_unchecked(level), fraction, sampler->min_filter, texel);
    const i8 magnified = rhw_less_equal(detail, zero);
    if (sampler->mag_filter != sampler->min_filter && rhw_any(magnified)) {
        f8 large[4];
        sample_level(source, &source->texture->mip[0], sampler->mag_filter, large);
        for (int i = 0; i < 4; i++) {
            texel[i] = rhw_select(magnified, large[i], texel[i]);
        }
    }
}

static void sample(const struct rhw_binding *binding, const rhw_float uv[2], const rhw_float grad[4],
                   const rhw_float *lod, rhw_float texel[4])
{
    const struct rhw_texture_data *const texture = binding->texture;
    const struct rhw_sampler_def *const sampler = binding->sampler;
    if (!texture) {
        texel[0] = texel[1] = texel[2] = rhw_splat(0.0f);
        texel[3] = rhw_splat(1.0f);
        return;
    }
    const struct sample_source source = {
        texture, sampler,
        sampler->address_u == RHW_ADDRESS_BORDER || sampler->address_v == RHW_ADDRESS_BORDER,
        sample_fold(sampler->address_u, uv[0]), sample_fold(sampler->address_v, uv[1])};
    const float last = sampler->mip_filter == RHW_MIP_FILTER_NONE ? 0.0f : (float)(texture->levels - 1);
    const bool linear = texture->format == RHW_FORMAT_RGBA8_SRGB;
    const bool codes = (linear || texture->format == RHW_FORMAT_RGBA8_UNORM) &&
                       sampler->min_filter == RHW_FILTER_LINEAR && sampler->mag_filter == RHW_FILTER_LINEAR &&
                       sampler->mip_filter != RHW_MIP_FILTER_NEAREST && !source.border;
    if (!codes) {
        sample_any(&source, grad, lod, last, texel);
        return;
    }
    i8 detail = i8_splat(0);
    if (last > 0.0f) {
        const f8 biased = rhw_clamp(sample_detail(&source, grad, lod), rhw_splat(sampler->lod_min),
                                    rhw_splat(sampler->lod_max));
        detail = rhw_to_int_unchecked(rhw_clamp(biased, rhw_splat(0.0f), rhw_splat(last)) * 65536.0f);
    }
    if (linear) {
        sample_detail_codes(&source, detail, true, texel);
    } else {
        sample_detail_codes(&source, detail, false, texel);
    }
}

#endif
