// SPDX-License-Identifier: MIT
// The sampler's fixed-point road: 8 bits, LINEAR, no border, which is what most textures are. A texel's four
// channels stand as 16-bit numbers, 255 · 128 for 1, two in each 32-bit lane, and are mixed with weights of 15
// bits: one multiplication serves two channels, and no step is off by more than half a unit. Equal texels mix
// to exactly themselves. RGBA8_UNORM is widened when it is loaded; RGBA8_SRGB stands so in memory, decoded
// (srgb_texture.h).
//
// With AVX2 the former are kept negated: the instruction that widens bytes multiplies by −128 but not by 128.
//
// Instructions are what a sample costs here, so lanes as most are, at the same two levels and away from the
// edges, have a straight road of their own; within it, lanes in one row of texels another one.
#ifndef RHW_CODES_TMPL_H
#define RHW_CODES_TMPL_H

#include "sample_constants_tmpl.h"
#include "level_tmpl.h"
#include "texel_tmpl.h"

struct sample_codes {
    i8 rb; // red in the lower, blue in the upper half
    i8 ga;
};

// Where 8 lanes meet one level.
struct sample_place {
    i8 xy;                 // top left texel of the four: x in the upper, y in the lower half, from −1
    i8 weight_x, weight_y; // of the right and the lower texels, 0.15, in both halves
};

// From here on `srgb` says that the texels are RGBA8_SRGB; a constant where a call names it.

// Whether codes are kept negated: where widening makes them so.
RHW_INLINE bool sample_is_negated(bool srgb)
{
    return I8_WIDENS_NEGATED && !srgb;
}

RHW_INLINE i8 sample_mix_half(i8 a, i8 b, i8 weight, bool srgb)
{
    if (sample_is_negated(srgb)) { // so that halves are rounded the same way
        return (i8)((s16)a - s16_scale((s16)a - (s16)b, (s16)weight));
    }
    return (i8)((s16)a + s16_scale((s16)b - (s16)a, (s16)weight));
}

RHW_INLINE struct sample_codes sample_mix_codes(struct sample_codes a, struct sample_codes b, i8 weight,
                                                bool srgb)
{
    return (struct sample_codes){sample_mix_half(a.rb, b.rb, weight, srgb),
                                 sample_mix_half(a.ga, b.ga, weight, srgb)};
}

// The codes themselves.
RHW_INLINE struct sample_codes sample_plain_codes(struct sample_codes a, bool srgb)
{
    if (sample_is_negated(srgb)) {
        return (struct sample_codes){(i8)(-(s16)a.rb), (i8)(-(s16)a.ga)};
    }
    return a;
}

RHW_INLINE struct sample_codes sample_widen(i8 texel)
{
    return (struct sample_codes){i8_widen_lower(texel), i8_widen_upper(texel)};
}

// Coordinates in texels, 16.16, at most 16384 · 2^16 = 2^30. A negative one is truncated to the texel
// edge where flooring would give the neighbour with the whole weight on this one.
RHW_INLINE struct sample_place sample_place(const struct rhw_mip *mip, f8 s, f8 t)
{
    const f8 half = sample_constants()->half_texel;
    const i8 x = rhw_to_int_unchecked(s * f8_load(mip->scale_x) - half);
    const i8 y = rhw_to_int_unchecked(t * f8_load(mip->scale_y) - half);
    // A weight is the fraction without its last bit.
    return (struct sample_place){i8_join_upper(x, y), i8_halve_lower(x), i8_halve_lower(y)};
}

RHW_INLINE struct sample_codes sample_mix_corners(const struct sample_codes corner[4],
                                                  const struct sample_place *place, bool srgb)
{
    const struct sample_codes above = sample_mix_codes(corner[0], corner[1], place->weight_x, srgb);
    const struct sample_codes below = sample_mix_codes(corner[2], corner[3], place->weight_x, srgb);
    return sample_mix_codes(above, below, place->weight_y, srgb);
}

// Loads ---------------------------------------------------------------------------------------------

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

// The texels with these numbers, `offset` bytes on in the level, and their right neighbours.
RHW_INLINE void sample_load_pairs(const struct rhw_mip *mip, size_t offset, const uint32_t at[RHW_LANES],
                                  bool srgb, struct sample_codes pair[2])
{
    if (srgb) {
        sample_load_linear_pairs(mip->linear + (RHW_LINEAR_TEXEL / 4) * offset, at, &pair[0], &pair[1]);
    } else {
        i8 left, right;
        i8_load_pairs(mip->texels + offset, at, &left, &right);
        pair[0] = sample_widen(left);
        pair[1] = sample_widen(right);
    }
}

// The texels at these places.
RHW_INLINE struct sample_codes sample_load_codes(const struct rhw_mip *mip, i8 xy, bool srgb)
{
    const i8 index = sample_index(xy, mip);
    if (srgb) {
        return (struct sample_codes){i8_gather(mip->linear, index + index),
                                     i8_gather(mip->linear + 4, index + index)};
    }
    return sample_widen(i8_gather(mip->texels, index));
}

// The four texels of each lane where some lie across an edge.
static __attribute__((noinline)) void sample_corners_wrapped(const struct rhw_sampler_data *sampler,
                                                             const struct rhw_mip *mip, const i8 *xy,
                                                             bool srgb, struct sample_codes corner[4])
{
    const i8 x = *xy >> 16, y = (*xy << 16) >> 16;
    const i8 x0 = sample_wrap(sampler->def.address_u, x, mip->width) << 16;
    const i8 x1 = sample_wrap(sampler->def.address_u, x + 1, mip->width) << 16;
    const i8 y0 = sample_wrap(sampler->def.address_v, y, mip->height);
    const i8 y1 = sample_wrap(sampler->def.address_v, y + 1, mip->height);
    uint32_t above[RHW_LANES], below[RHW_LANES];
    sample_spill(sample_index(x0 | y0, mip), above);
    sample_spill(sample_index(x0 | y1, mip), below);
    sample_load_pairs(mip, 0, above, srgb, &corner[0]);
    sample_load_pairs(mip, 0, below, srgb, &corner[2]);
    if (i8_any_bit(x1 - x0 - 0x10000)) { // some right neighbour is not next to its texel
        corner[1] = sample_load_codes(mip, x1 | y0, srgb);
        corner[3] = sample_load_codes(mip, x1 | y1, srgb);
    }
}

// Levels --------------------------------------------------------------------------------------------

// Lanes in one row of texels, at most 7 apart, as most are on a wall or a floor that is not turned against the
// screen: the row and the one below are loaded whole, from texel `first` on, and each lane finds its texels there.
RHW_INLINE void sample_row_corners(const struct rhw_mip *mip, i8 first, i8 lane,
                                   struct sample_codes corner[4])
{
    const unsigned char *const above = mip->texels + 4 * (size_t)(uint32_t)sample_index(first, mip)[0];
    const unsigned char *const below = above + mip->row_pitch;
    corner[0] = sample_widen(i8_permute(i8_load(above), lane));
    corner[1] = sample_widen(i8_permute(i8_load(above + 4), lane));
    corner[2] = sample_widen(i8_permute(i8_load(below), lane));
    corner[3] = sample_widen(i8_permute(i8_load(below + 4), lane));
}

// The four texels of lanes away from the edges, mixed.
RHW_INLINE struct sample_codes sample_interior_codes(const struct rhw_mip *mip,
                                                     const struct sample_place *place, bool srgb)
{
    struct sample_codes corner[4];
    if (I8_PERMUTES && !srgb) {
        const i8 apart = sample_constants()->not_in_row;
        i8 first = i8_splat_first(place->xy), offset = place->xy - first;
        if (i8_any_of(offset, apart)) { // perhaps it is the last lane that lies leftmost
            first = i8_splat_last(place->xy);
            offset = place->xy - first;
        }
        if (!i8_any_of(offset, apart)) {
            sample_row_corners(mip, first, offset >> 16, corner);
            return sample_mix_corners(corner, place, srgb);
        }
    }
    uint32_t at[RHW_LANES];
    sample_spill(sample_index(place->xy, mip), at);
    sample_load_pairs(mip, 0, at, srgb, &corner[0]);
    sample_load_pairs(mip, mip->row_pitch, at, srgb, &corner[2]);
    return sample_mix_corners(corner, place, srgb);
}

RHW_INLINE struct sample_codes sample_bilinear_codes(const struct rhw_sampler_data *sampler,
                                                     const struct rhw_mip *mip, f8 s, f8 t, bool srgb)
{
    const struct sample_place place = sample_place(mip, s, t);
    if (mip->interior[0] >= 0 && !i8_any_bit(i8_over_halves(place.xy, i8_load(mip->interior)))) {
        return sample_interior_codes(mip, &place, srgb);
    }
    const i8 xy = place.xy; // a copy, so that the one in registers stays there
    struct sample_codes corner[4];
    sample_corners_wrapped(sampler, mip, &xy, srgb, corner);
    return sample_mix_corners(corner, &place, srgb);
}

// Code 8.7 / (255 · 128); codes without fraction give c / 255 correctly rounded.
RHW_INLINE f8 sample_from_code(i8 code)
{
    const f8 c = rhw_to_float(code);
    return c * sample_constants()->code_scale + c * sample_constants()->code_rest;
}

RHW_INLINE void sample_unpack_codes(struct sample_codes codes, f8 texel[4])
{
    texel[0] = sample_from_code(codes.rb & sample_constants()->lower_half);
    texel[1] = sample_from_code(codes.ga & sample_constants()->lower_half);
    texel[2] = sample_from_code(codes.rb >> 16);
    texel[3] = sample_from_code(codes.ga >> 16);
}

// What two levels give, the second with this weight.
RHW_INLINE void sample_mix_levels(struct sample_codes a, struct sample_codes b, i8 weight, bool srgb,
                                  f8 texel[4])
{
    sample_unpack_codes(sample_plain_codes(sample_mix_codes(a, b, weight, srgb), srgb), texel);
}

// Any lanes: one level after the other, each with the next where a lane has a weight there. A weight of 0
// leaves a lane as it is.
RHW_INLINE void sample_codes_of_levels(const struct rhw_texture_data *texture,
                                       const struct rhw_sampler_data *sampler, f8 s, f8 t, i8 detail,
                                       bool srgb, f8 texel[4])
{
    const i8 level = detail >> 16, weight = i8_halve_lower(detail);
    struct sample_codes result = {i8_splat(0), i8_splat(0)};
    for (unsigned todo = 0xff; todo != 0;) {
        const int first = level[__builtin_ctz(todo)];
        const i8 same = rhw_equal_int(level, i8_splat(first));
        todo &= ~(unsigned)rhw_mask_bits(same);
        const struct rhw_mip *const mip = sample_mip(texture, first);
        struct sample_codes codes = sample_bilinear_codes(sampler, mip, s, t, srgb);
        if (i8_any_bit(weight & same)) {
            codes =
                sample_mix_codes(codes, sample_bilinear_codes(sampler, mip + 1, s, t, srgb), weight, srgb);
        }
        result.rb = rhw_select_int(same, codes.rb, result.rb);
        result.ga = rhw_select_int(same, codes.ga, result.ga);
    }
    sample_unpack_codes(sample_plain_codes(result, srgb), texel);
}

static __attribute__((noinline)) void sample_codes_apart(const struct rhw_texture_data *texture,
                                                         const struct rhw_sampler_data *sampler, f8 s, f8 t,
                                                         i8 detail, bool srgb, f8 texel[4])
{
    if (srgb) {
        sample_codes_of_levels(texture, sampler, s, t, detail, true, texel);
    } else {
        sample_codes_of_levels(texture, sampler, s, t, detail, false, texel);
    }
}

// The whole -----------------------------------------------------------------------------------------

// Level of detail within the sampler's limits and the texture's levels, 16.16.
RHW_INLINE i8 sample_detail_codes(const struct rhw_texture_data *texture,
                                  const struct rhw_sampler_data *sampler, const f8 *grad, const f8 *lod)
{
    if (sample_last_level(texture, sampler) == 0) {
        return i8_splat(0);
    }
    const f8 detail = rhw_clamp(sample_detail(texture, sampler, grad, lod), f8_load(sampler->detail_min),
                                f8_load(sampler->detail_max));
    return rhw_to_int_unchecked(rhw_min(detail, f8_load(texture->last_level)) * sample_constants()->one_16);
}

// Whether all lanes take the same two levels, and some have a weight in the second.
RHW_INLINE bool sample_same_levels(i8 detail, i8 weight)
{
    const i8 apart = detail ^ i8_splat_first(detail);
    return !i8_any_of(apart, sample_constants()->upper_half) && i8_any_of(weight, weight);
}

// Where lanes meet a level and the next. False where not all of their four texels lie side by side in both; if the
// coarser one has no side of 1, so has the finer one.
RHW_INLINE bool sample_places(const struct rhw_mip *fine, f8 s, f8 t, struct sample_place *near,
                              struct sample_place *far)
{
    const struct rhw_mip *const coarse = fine + 1;
    *near = sample_place(fine, s, t);
    *far = sample_place(coarse, s, t);
    const i8 over = i8_over_halves(near->xy, i8_load(fine->interior)) |
                    i8_over_halves(far->xy, i8_load(coarse->interior));
    return coarse->interior[0] >= 0 && !i8_any_of(over, over);
}

// The straight road, and the turn to the other.
RHW_INLINE void sample_codes(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler,
                             const f8 uv[2], i8 detail, bool srgb, f8 texel[4])
{
    const f8 s = sample_fold(sampler->def.address_u, uv[0]), t = sample_fold(sampler->def.address_v, uv[1]);
    const i8 weight = i8_halve_lower(detail);
    if (sample_same_levels(detail, weight)) {
        const struct rhw_mip *const fine = sample_mip(texture, detail[0] >> 16), *const coarse = fine + 1;
        if (!I8_PERMUTES) { // 16-byte registers are too few for two levels at once
            const struct sample_codes a = sample_bilinear_codes(sampler, fine, s, t, srgb);
            const struct sample_codes b = sample_bilinear_codes(sampler, coarse, s, t, srgb);
            sample_mix_levels(a, b, weight, srgb, texel);
            return;
        }
        struct sample_place near, far;
        if (sample_places(fine, s, t, &near, &far)) {
            const struct sample_codes a = sample_interior_codes(fine, &near, srgb);
            const struct sample_codes b = sample_interior_codes(coarse, &far, srgb);
            sample_mix_levels(a, b, weight, srgb, texel);
            return;
        }
    }
    sample_codes_apart(texture, sampler, s, t, detail, srgb, texel);
}

#endif
