// SPDX-License-Identifier: MIT
// The fixed-point path of the sampler serves textures of 8 bits with LINEAR filters and no border: most are of this
// kind. A texel's four channels stand as 16-bit numbers, 255 · 128 for 1, two in each 32-bit lane, and are mixed with
// weights of 15 bits: one multiplication serves two channels, and no step is off by more than half a unit. Equal texels
// mix to exactly themselves. RGBA8_UNORM texels are widened when they are loaded; RGBA8_SRGB texels stand widened in
// memory, decoded (srgb_texture.h).
//
// With AVX2 RGBA8_UNORM texels are kept negated: the instruction that widens bytes multiplies by −128 but not by 128.
//
// Lanes as most are have special paths, each with what it saves of the instructions of a frame (AVX2, 640×360):
// - footprints away from the edges are loaded without wrapping each texel (filter_interior): 21 % of fill_tex, 13 % of
//   DamagedHelmet, 4 % of Sponza;
// - with AVX2, RGBA8_UNORM texels of lanes in one row are loaded by whole rows (load_row_footprint): 5 % of fill_tex
//   and 11 % of its time; models gain and lose less than 1 %.
// sample_fixed_general takes neither.
#ifndef RHW_FILTER_FIXED_H
#define RHW_FILTER_FIXED_H

#include "binding/binding.h"
#include "lod.h"
#include "sample_constants.h"
#include "texel_fetch.h"

// 8 texels as fixed-point numbers.
struct fixed_texels {
    i32x8 rb; // red in the lower, blue in the upper half
    i32x8 ga;
};

// The footprint of 8 lanes in a level: which 2×2 texels each lane filters, and how.
struct footprint {
    // The top left texel of the four, from −1 on: x in the upper half, y in the lower half.
    i32x8 xy;
    // Weights of the right and of the lower texels, 0.15, in both halves.
    i32x8 weight_x, weight_y;
};

// In the functions from here on `codec` is that of the texture, UNORM8 or SRGB8. It is a constant where a call names
// it.

// Return true if fixed-point texels are kept negated: where widening makes them negative.
RHW_INLINE bool keeps_negated(enum rhw_texel_codec codec)
{
    return I8_WIDENS_NEGATED && codec == RHW_CODEC_UNORM8;
}

RHW_INLINE i32x8 mix_halves(i32x8 a, i32x8 b, i32x8 weight, enum rhw_texel_codec codec)
{
    if (keeps_negated(codec)) { // halves are rounded as those that are not negated
        return (i32x8)((i16x16)a - i16x16_scale((i16x16)a - (i16x16)b, (i16x16)weight));
    }
    return (i32x8)((i16x16)a + i16x16_scale((i16x16)b - (i16x16)a, (i16x16)weight));
}

RHW_INLINE struct fixed_texels mix_fixed(struct fixed_texels a, struct fixed_texels b, i32x8 weight,
                                         enum rhw_texel_codec codec)
{
    return (struct fixed_texels){mix_halves(a.rb, b.rb, weight, codec),
                                 mix_halves(a.ga, b.ga, weight, codec)};
}

RHW_INLINE struct fixed_texels without_negation(struct fixed_texels a, enum rhw_texel_codec codec)
{
    if (keeps_negated(codec)) {
        return (struct fixed_texels){(i32x8)(-(i16x16)a.rb), (i32x8)(-(i16x16)a.ga)};
    }
    return a;
}

RHW_INLINE struct fixed_texels widen_texels(i32x8 texel)
{
    return (struct fixed_texels){i32x8_widen_lower(texel), i32x8_widen_upper(texel)};
}

// Return the footprint at coordinates in texels, 16.16, at most 16384 · 2^16 = 2^30. A negative coordinate is truncated
// to the texel edge where flooring would give the neighbour with the whole weight on this texel.
RHW_INLINE struct footprint footprint_at(const struct rhw_mip *mip, f32x8 s, f32x8 t)
{
    const f32x8 half = sample_constants()->half_texel;
    const i32x8 x = rhw_int_from_float_unchecked(s * f32x8_load(mip->scale_x) - half);
    const i32x8 y = rhw_int_from_float_unchecked(t * f32x8_load(mip->scale_y) - half);
    // A weight is the fraction without its last bit.
    return (struct footprint){i32x8_join_upper(x, y), i32x8_halve_lower(x), i32x8_halve_lower(y)};
}

// Mix the four texels of each lane: above left, above right, below left, below right.
RHW_INLINE struct fixed_texels mix_footprint(const struct fixed_texels texel[4],
                                             const struct footprint *footprint, enum rhw_texel_codec codec)
{
    const struct fixed_texels above = mix_fixed(texel[0], texel[1], footprint->weight_x, codec);
    const struct fixed_texels below = mix_fixed(texel[2], texel[3], footprint->weight_x, codec);
    return mix_fixed(above, below, footprint->weight_y, codec);
}

// Loads ---------------------------------------------------------------------------------------------

// Load the texels of a linear copy with these numbers, and their right neighbours.
RHW_INLINE void load_linear_pairs(const unsigned char *texels, const uint32_t at[RHW_LANES],
                                  struct fixed_texels pair[2])
{
    f32x4 row[RHW_LANES];
    for (int i = 0; i < RHW_LANES; i++) {
        memcpy(&row[i], texels + (size_t)at[i] * RHW_LINEAR_TEXEL, sizeof row[i]);
    }
    f32x8 column[4];
    f32x4_columns(row, column);
    pair[0] = (struct fixed_texels){(i32x8)column[0], (i32x8)column[1]};
    pair[1] = (struct fixed_texels){(i32x8)column[2], (i32x8)column[3]};
}

// Load the texels with these numbers, `offset` bytes on in the level, and their right neighbours.
RHW_INLINE void load_pairs(const struct rhw_mip *mip, size_t offset, const uint32_t at[RHW_LANES],
                           enum rhw_texel_codec codec, struct fixed_texels pair[2])
{
    if (codec == RHW_CODEC_SRGB8) {
        load_linear_pairs(mip->linear + (RHW_LINEAR_TEXEL / 4) * offset, at, pair);
    } else {
        i32x8 left, right;
        i32x8_load_pairs(mip->texels + offset, at, &left, &right);
        pair[0] = widen_texels(left);
        pair[1] = widen_texels(right);
    }
}

// Load texels (x, y). x stands in the upper and y in the lower half of a lane.
RHW_INLINE struct fixed_texels load_texels(const struct rhw_mip *mip, i32x8 xy, enum rhw_texel_codec codec)
{
    const i32x8 number = texel_number(xy, mip);
    if (codec == RHW_CODEC_SRGB8) {
        return (struct fixed_texels){i32x8_gather(mip->linear, number + number),
                                     i32x8_gather(mip->linear + 4, number + number)};
    }
    return widen_texels(i32x8_gather(mip->texels, number));
}

// Return true if both coordinates repeat, in a level whose sides are powers of two.
RHW_INLINE bool repeats_by_mask(const struct rhw_sampler_data *sampler, const struct rhw_mip *mip)
{
    return sampler->def.address_u == RHW_ADDRESS_REPEAT && sampler->def.address_v == RHW_ADDRESS_REPEAT &&
           ((mip->width & (mip->width - 1)) | (mip->height & (mip->height - 1))) == 0;
}

// Load the footprint's texels of a level that repeats_by_mask. A mask wraps both coordinates of a texel.
RHW_INLINE void load_masked_footprint(const struct rhw_mip *mip, i32x8 xy, enum rhw_texel_codec codec,
                                      struct fixed_texels texel[4])
{
    const i32x8 inside = i32x8_splat((mip->width - 1) << 16 | (mip->height - 1));
    const i32x8 low = xy & inside, high = (i32x8)((i16x16)xy + (i16x16)i32x8_splat(0x10001)) & inside;
    const i32x8 right = sample_constants()->upper_half, below = sample_constants()->lower_half;
    texel[0] = load_texels(mip, low, codec);
    texel[1] = load_texels(mip, (high & right) | (low & below), codec);
    texel[2] = load_texels(mip, (low & right) | (high & below), codec);
    texel[3] = load_texels(mip, high, codec);
}

// Load the footprint's texels where some lie across an edge.
static __attribute__((noinline)) void load_wrapped_footprint(const struct rhw_sampler_data *sampler,
                                                             const struct rhw_mip *mip, const i32x8 *xy,
                                                             enum rhw_texel_codec codec,
                                                             struct fixed_texels texel[4])
{
    // Where a load from a table is one instruction, four of them are a quarter of what follows.
    if (I8_PERMUTES && repeats_by_mask(sampler, mip)) {
        load_masked_footprint(mip, *xy, codec, texel);
        return;
    }
    const i32x8 x = *xy >> 16, y = (*xy << 16) >> 16;
    const i32x8 x0 = wrap_coordinate(sampler->def.address_u, x, mip->width) << 16;
    const i32x8 x1 = wrap_coordinate(sampler->def.address_u, x + 1, mip->width) << 16;
    const i32x8 y0 = wrap_coordinate(sampler->def.address_v, y, mip->height);
    const i32x8 y1 = wrap_coordinate(sampler->def.address_v, y + 1, mip->height);
    uint32_t above[RHW_LANES], below[RHW_LANES];
    spill_lanes(texel_number(x0 | y0, mip), above);
    spill_lanes(texel_number(x0 | y1, mip), below);
    load_pairs(mip, 0, above, codec, &texel[0]);
    load_pairs(mip, 0, below, codec, &texel[2]);
    // Some right neighbour is not next to its texel.
    if (i32x8_any_bit(x1 - x0 - 0x10000)) {
        texel[1] = load_texels(mip, x1 | y0, codec);
        texel[3] = load_texels(mip, x1 | y1, codec);
    }
}

// Load the footprint's texels where all lanes have theirs in one row, at most 7 apart. Most lanes do on a wall or a
// floor that is not turned against the screen. The row and the one below are loaded whole, from texel `first` on, and
// each lane picks its texels there, `offset` to the right.
RHW_INLINE void load_row_footprint(const struct rhw_mip *mip, i32x8 first, i32x8 offset,
                                   struct fixed_texels texel[4])
{
    const unsigned char *const above = mip->texels + 4 * (size_t)(uint32_t)texel_number(first, mip)[0];
    const unsigned char *const below = above + mip->row_pitch;
    texel[0] = widen_texels(i32x8_permute(i32x8_load(above), offset));
    texel[1] = widen_texels(i32x8_permute(i32x8_load(above + 4), offset));
    texel[2] = widen_texels(i32x8_permute(i32x8_load(below), offset));
    texel[3] = widen_texels(i32x8_permute(i32x8_load(below + 4), offset));
}

// Load the texels of a footprint that lies away from the edges.
RHW_INLINE void load_interior_footprint(const struct rhw_mip *mip, i32x8 xy, enum rhw_texel_codec codec,
                                        struct fixed_texels texel[4])
{
    uint32_t at[RHW_LANES];
    spill_lanes(texel_number(xy, mip), at);
    load_pairs(mip, 0, at, codec, &texel[0]);
    load_pairs(mip, mip->row_pitch, at, codec, &texel[2]);
}

// One level -----------------------------------------------------------------------------------------

// Filter a footprint that lies away from the edges.
RHW_INLINE struct fixed_texels filter_interior(const struct rhw_mip *mip, const struct footprint *footprint,
                                               enum rhw_texel_codec codec)
{
    struct fixed_texels texel[4];
    if (I8_PERMUTES && codec == RHW_CODEC_UNORM8) {
        const i32x8 apart = sample_constants()->not_in_row;
        i32x8 first = i32x8_splat_first(footprint->xy), offset = footprint->xy - first;
        // Perhaps the last lane lies leftmost.
        if (i32x8_any_of(offset, apart)) {
            first = i32x8_splat_last(footprint->xy);
            offset = footprint->xy - first;
        }
        if (!i32x8_any_of(offset, apart)) {
            load_row_footprint(mip, first, offset >> 16, texel);
            return mix_footprint(texel, footprint, codec);
        }
    }
    load_interior_footprint(mip, footprint->xy, codec, texel);
    return mix_footprint(texel, footprint, codec);
}

// Whether footprints away from the edges are told from others. It is a constant where a call names it.
enum footprint_path { FOOTPRINTS_WRAPPED, FOOTPRINTS_INTERIOR };

// Filter a footprint of a level.
RHW_INLINE struct fixed_texels filter_footprint(const struct rhw_sampler_data *sampler,
                                                const struct rhw_mip *mip, const struct footprint *footprint,
                                                enum rhw_texel_codec codec, enum footprint_path path)
{
    if (path == FOOTPRINTS_INTERIOR && mip->interior[0] >= 0 &&
        !i32x8_any_bit(i32x8_over_halves(footprint->xy, i32x8_load(mip->interior)))) {
        return filter_interior(mip, footprint, codec);
    }
    // This is a copy, so that the footprint in registers stays there.
    const i32x8 xy = footprint->xy;
    struct fixed_texels texel[4];
    load_wrapped_footprint(sampler, mip, &xy, codec, texel);
    return mix_footprint(texel, footprint, codec);
}

RHW_INLINE struct fixed_texels filter_fixed(const struct rhw_sampler_data *sampler, const struct rhw_mip *mip,
                                            f32x8 s, f32x8 t, enum rhw_texel_codec codec,
                                            enum footprint_path path)
{
    const struct footprint footprint = footprint_at(mip, s, t);
    return filter_footprint(sampler, mip, &footprint, codec, path);
}

// Return 8.7 fixed point / (255 · 128). A number without fraction gives c / 255 correctly rounded.
RHW_INLINE f32x8 fixed_to_float(i32x8 fixed)
{
    const f32x8 c = rhw_float_from_int(fixed);
    return c * sample_constants()->fixed_scale + c * sample_constants()->fixed_rest;
}

RHW_INLINE void unpack_fixed(struct fixed_texels fixed, f32x8 texel[4])
{
    texel[0] = fixed_to_float(fixed.rb & sample_constants()->lower_half);
    texel[1] = fixed_to_float(fixed.ga & sample_constants()->lower_half);
    texel[2] = fixed_to_float(fixed.rb >> 16);
    texel[3] = fixed_to_float(fixed.ga >> 16);
}

// Two levels ----------------------------------------------------------------------------------------

// Mix what two levels give, the second with this weight.
RHW_INLINE void mix_levels(struct fixed_texels a, struct fixed_texels b, i32x8 weight,
                           enum rhw_texel_codec codec, f32x8 texel[4])
{
    unpack_fixed(without_negation(mix_fixed(a, b, weight, codec), codec), texel);
}

// Filter any lanes: one level after the other, each with the next where a lane has a weight there. A weight of 0 leaves
// a lane as it is.
RHW_INLINE struct fixed_texels filter_fixed_levels(const struct rhw_binding_data *binding, f32x8 s, f32x8 t,
                                                   i32x8 lod, enum rhw_texel_codec codec,
                                                   enum footprint_path path)
{
    const i32x8 level = lod >> 16, weight = i32x8_halve_lower(lod);
    struct fixed_texels result = {i32x8_splat(0), i32x8_splat(0)};
    for (unsigned todo = 0xff; todo != 0;) {
        const int first = level[__builtin_ctz(todo)];
        const i32x8 same = rhw_equal_int(level, i32x8_splat(first));
        todo &= ~(unsigned)rhw_mask_bits(same);
        const struct rhw_mip *const mip = mip_at(binding->texture, first);
        struct fixed_texels fixed = filter_fixed(binding->sampler, mip, s, t, codec, path);
        if (i32x8_any_bit(weight & same)) {
            const struct fixed_texels next = filter_fixed(binding->sampler, mip + 1, s, t, codec, path);
            fixed = mix_fixed(fixed, next, weight, codec);
        }
        result.rb = rhw_select_int(same, fixed.rb, result.rb);
        result.ga = rhw_select_int(same, fixed.ga, result.ga);
    }
    return result;
}

RHW_INLINE void sample_fixed_levels(const struct rhw_binding_data *binding, f32x8 s, f32x8 t, i32x8 lod,
                                    enum rhw_texel_codec codec, enum footprint_path path, f32x8 texel[4])
{
    unpack_fixed(without_negation(filter_fixed_levels(binding, s, t, lod, codec, path), codec), texel);
}

// Sample lanes that the fast path of sample_fixed does not serve.
static __attribute__((noinline)) void sample_fixed_apart(const struct rhw_binding_data *binding, f32x8 s,
                                                         f32x8 t, i32x8 lod, enum rhw_texel_codec codec,
                                                         f32x8 texel[4])
{
    if (codec == RHW_CODEC_SRGB8) {
        sample_fixed_levels(binding, s, t, lod, RHW_CODEC_SRGB8, FOOTPRINTS_INTERIOR, texel);
    } else {
        sample_fixed_levels(binding, s, t, lod, RHW_CODEC_UNORM8, FOOTPRINTS_INTERIOR, texel);
    }
}

// Return the level of detail within the sampler's limits and the texture's levels, 16.16.
RHW_INLINE i32x8 fixed_level_of_detail(const struct rhw_binding_data *binding, const f32x8 *gradient,
                                       const f32x8 *lod)
{
    const struct rhw_texture_data *const texture = binding->texture;
    const struct rhw_sampler_data *const sampler = binding->sampler;
    if (last_level(texture, sampler) == 0) {
        return i32x8_splat(0);
    }
    const f32x8 limited = rhw_clamp(level_of_detail(texture, sampler, gradient, lod),
                                    f32x8_load(sampler->lod_least), f32x8_load(sampler->lod_most));
    return rhw_int_from_float_unchecked(rhw_min(limited, f32x8_load(texture->last_level)) *
                                        sample_constants()->one_16);
}

// Take the general path, whatever the lanes are: one level after the other, each texel wrapped.
RHW_INLINE void sample_fixed_general(const struct rhw_binding_data *binding,
                                     const struct rhw_sample_request *request, enum rhw_texel_codec codec,
                                     f32x8 texel[4])
{
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    sample_fixed_levels(binding, fold_coordinate(def->address_u, request->coordinates[0]),
                        fold_coordinate(def->address_v, request->coordinates[1]),
                        fixed_level_of_detail(binding, request->gradient, request->lod), codec,
                        FOOTPRINTS_WRAPPED, texel);
}

// Return true if all lanes filter the same two levels, and some have a weight in the second.
RHW_INLINE bool same_two_levels(i32x8 lod, i32x8 weight)
{
    const i32x8 apart = lod ^ i32x8_splat_first(lod);
    return !i32x8_any_of(apart, sample_constants()->upper_half) && i32x8_any_of(weight, weight);
}

// Find the footprints in a level and the next, for several textures that have them in common. Return false where some
// have texels across an edge. If the coarser level has no side of 1, the finer one has none.
RHW_INLINE bool interior_footprints(const struct rhw_mip *fine, f32x8 s, f32x8 t, struct footprint *near,
                                    struct footprint *far)
{
    const struct rhw_mip *const coarse = fine + 1;
    *near = footprint_at(fine, s, t);
    *far = footprint_at(coarse, s, t);
    const i32x8 over = i32x8_over_halves(near->xy, i32x8_load(fine->interior)) |
                       i32x8_over_halves(far->xy, i32x8_load(coarse->interior));
    return coarse->interior[0] >= 0 && !i32x8_any_of(over, over);
}

// Take the fast path, or turn to the other.
RHW_INLINE void sample_fixed(const struct rhw_binding_data *binding, const f32x8 uv[2], i32x8 lod,
                             enum rhw_texel_codec codec, f32x8 texel[4])
{
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    const f32x8 s = fold_coordinate(def->address_u, uv[0]);
    const f32x8 t = fold_coordinate(def->address_v, uv[1]);
    const i32x8 weight = i32x8_halve_lower(lod);
    if (same_two_levels(lod, weight)) {
        const struct rhw_mip *const fine = mip_at(binding->texture, lod[0] >> 16);
        const struct fixed_texels a = filter_fixed(binding->sampler, fine, s, t, codec, FOOTPRINTS_INTERIOR);
        const struct fixed_texels b =
            filter_fixed(binding->sampler, fine + 1, s, t, codec, FOOTPRINTS_INTERIOR);
        mix_levels(a, b, weight, codec, texel);
        return;
    }
    sample_fixed_apart(binding, s, t, lod, codec, texel);
}

#endif
