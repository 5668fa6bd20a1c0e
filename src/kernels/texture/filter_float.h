// SPDX-License-Identifier: MIT
// The general path of the sampler for plain 2D textures: every format, filter and address mode, in floats. All lanes
// that read one mip level are served together, so that they have sizes and addresses in common and the arithmetic stays
// vector arithmetic; lanes next to each other on the screen nearly always read one level. A lane's result never depends
// on the other lanes.
//
// Coordinates are folded into 0..1 by the address mode before they meet the size of a level: the fold rounds to 2^-24
// at most, however large the coordinate, and what is not finite lands on an edge, so that no texel outside is touched.
#ifndef RHW_FILTER_FLOAT_H
#define RHW_FILTER_FLOAT_H

#include "binding/binding.h"
#include "base/compare.h"
#include "filter_fixed.h"
#include "filter_half.h"
#include "lod.h"
#include "depth_reference.h"
#include "texel_fetch.h"

// What one call needs at every level. s and t are folded coordinates; the nearest filter takes `nearest` in their
// place.
struct float_source {
    const struct rhw_texture_data *texture;
    const struct rhw_format_info *format; // format of the texture
    const struct rhw_sampler_data *sampler;
    bool border; // the texture has a border along u or v
    bool halves; // filter_half.h takes footprints
    f32x8 s, t, nearest[2];
    // The reference of a sampler that compares, or NULL: texels become 1 where the comparison holds, else 0.
    const f32x8 *reference;
};

// Put the border's colour where texels lie outside the level.
static inline void replace_outside(const struct float_source *source, const struct rhw_mip *mip, i32x8 x,
                                   i32x8 y, f32x8 texel[4])
{
    const struct rhw_sampler_data *const sampler = source->sampler;
    i32x8 outside = i32x8_splat(0);
    if (sampler->def.address_u == RHW_ADDRESS_BORDER) {
        outside = outside | is_outside(x, mip->width);
    }
    if (sampler->def.address_v == RHW_ADDRESS_BORDER) {
        outside = outside | is_outside(y, mip->height);
    }
    if (rhw_any(outside)) {
        for (int i = 0; i < 4; i++) {
            texel[i] = rhw_select(outside, border_channel(source->format, &sampler->def, i), texel[i]);
        }
    }
}

// Fetch texels (x, y) of a level as floats, colour linear. Coordinates may lie outside the level.
static inline void fetch_texels(const struct float_source *source, const struct rhw_mip *mip, i32x8 x,
                                i32x8 y, f32x8 texel[4])
{
    const struct rhw_sampler_data *const sampler = source->sampler;
    struct raw_texels raw;
    fetch_raw_texels(source->format->size, mip, wrap_coordinate(sampler->def.address_u, x, mip->width),
                     wrap_coordinate(sampler->def.address_v, y, mip->height), &raw);
    decode_texels(source->format, &raw, texel);
    if (source->border) {
        replace_outside(source, mip, x, y, texel);
    }
    if (source->reference) {
        const i32x8 holds = compare_lanes(sampler->def.compare, *source->reference, texel[0]);
        texel[0] = rhw_select(holds, rhw_splat(1.0f), rhw_splat(0.0f));
    }
}

static inline void filter_nearest(const struct float_source *source, const struct rhw_mip *mip,
                                  f32x8 texel[4])
{
    i32x8 x = rhw_int_from_float_unchecked(rhw_floor(source->nearest[0] * (float)mip->width));
    i32x8 y = rhw_int_from_float_unchecked(rhw_floor(source->nearest[1] * (float)mip->height));
    // s = 1 stands for a coordinate just below the edge where the texture repeats.
    if (source->sampler->def.address_u != RHW_ADDRESS_BORDER) {
        x = rhw_min_int(x, i32x8_splat(mip->width - 1));
    }
    if (source->sampler->def.address_v != RHW_ADDRESS_BORDER) {
        y = rhw_min_int(y, i32x8_splat(mip->height - 1));
    }
    fetch_texels(source, mip, x, y, texel);
}

static inline void filter_bilinear(const struct float_source *source, const struct rhw_mip *mip,
                                   f32x8 texel[4])
{
    const f32x8 x = source->s * (float)mip->width - 0.5f, y = source->t * (float)mip->height - 0.5f;
    const f32x8 left = rhw_floor(x), top = rhw_floor(y);
    const f32x8 weight_x = x - left, weight_y = y - top;
    const i32x8 x0 = rhw_int_from_float_unchecked(left), y0 = rhw_int_from_float_unchecked(top);
    if (source->halves && footprints_inside(mip, x0, y0)) {
        filter_halves(source->format, mip, x0, y0, weight_x, weight_y, texel);
        return;
    }
    f32x8 footprint[4][4];
    for (int i = 0; i < 4; i++) {
        fetch_texels(source, mip, x0 + (i & 1), y0 + (i >> 1), footprint[i]);
    }
    const int channels = source->reference ? 1 : 4;
    for (int i = 0; i < channels; i++) {
        const f32x8 above = rhw_mix(footprint[0][i], footprint[1][i], weight_x);
        const f32x8 below = rhw_mix(footprint[2][i], footprint[3][i], weight_x);
        texel[i] = rhw_mix(above, below, weight_y);
    }
    for (int i = channels; i < 4; i++) {
        texel[i] = rhw_splat(0.0f);
    }
}

// Levels --------------------------------------------------------------------------------------------

static inline void filter_level(const struct float_source *source, const struct rhw_mip *mip,
                                enum rhw_filter filter, f32x8 texel[4])
{
    if (filter == RHW_FILTER_LINEAR && source->format->path == RHW_TEXELS_RGBA8_SRGB && !source->border &&
        !source->reference) {
        // The linear copy is read here, as everywhere: its values differ a little from those that the table has.
        unpack_fixed(
            filter_fixed(source->sampler, mip, source->s, source->t, RHW_CODEC_SRGB8, FOOTPRINTS_INTERIOR),
            texel);
    } else if (filter == RHW_FILTER_LINEAR) {
        filter_bilinear(source, mip, texel);
    } else {
        filter_nearest(source, mip, texel);
    }
}

// Filter all lanes at the levels that `level` names, by one filter. Where `fraction` is above 0, it is the way to the
// next level.
static inline void filter_levels(const struct float_source *source, i32x8 level, f32x8 fraction,
                                 enum rhw_filter filter, f32x8 texel[4])
{
    const i32x8 between = rhw_less(rhw_splat(0.0f), fraction);
    texel[0] = texel[1] = texel[2] = texel[3] = rhw_splat(0.0f);
    for (unsigned todo = 0xff; todo != 0;) {
        const int first = level[__builtin_ctz(todo)];
        const i32x8 same = rhw_equal_int(level, i32x8_splat(first));
        todo &= ~(unsigned)rhw_mask_bits(same);
        const struct rhw_mip *const mip = mip_at(source->texture, first);
        f32x8 fine[4];
        filter_level(source, mip, filter, fine);
        if (rhw_any(same & between)) {
            f32x8 coarse[4];
            filter_level(source, mip + 1, filter, coarse);
            for (int i = 0; i < 4; i++) {
                fine[i] = rhw_select(between, rhw_mix(fine[i], coarse[i], fraction), fine[i]);
            }
        }
        for (int i = 0; i < 4; i++) {
            texel[i] = rhw_select(same, fine[i], texel[i]);
        }
    }
}

// Sample in floats. `halves`: filter_half.h serves the texture and its sampler.
static __attribute__((noinline)) void sample_float(const struct rhw_binding_data *binding,
                                                   const struct rhw_sample_request *request, bool halves,
                                                   f32x8 texel[4])
{
    const struct rhw_texture_data *const texture = binding->texture;
    const struct rhw_sampler_data *const sampler = binding->sampler;
    const struct rhw_sampler_def *const def = &sampler->def;
    const f32x8 reference = reference_of(texture->info, request);
    const f32x8 u = request->coordinates[0], v = request->coordinates[1];
    const f32x8 s = fold_coordinate(def->address_u, u), t = fold_coordinate(def->address_v, v);
    const struct float_source source = {
        .reference = def->compares ? &reference : NULL,
        .texture = texture,
        .format = texture->info,
        .sampler = sampler,
        .border = def->address_u == RHW_ADDRESS_BORDER || def->address_v == RHW_ADDRESS_BORDER,
        .halves = halves,
        .s = s,
        .t = t,
        .nearest = {nearest_coordinate(def->address_u, u, s), nearest_coordinate(def->address_v, v, t)}};
    const f32x8 zero = rhw_splat(0.0f);
    const f32x8 limited = rhw_clamp(level_of_detail(texture, sampler, request->gradient, request->lod),
                                    rhw_splat(def->lod_min), rhw_splat(def->lod_max));
    const f32x8 within = rhw_clamp(limited, zero, rhw_splat((float)last_level(texture, sampler)));
    const bool blended = def->mip_filter == RHW_MIP_FILTER_LINEAR;
    const f32x8 level = blended ? rhw_floor(within) : rhw_max(rhw_ceil(within - 0.5f), zero);
    const f32x8 fraction = blended ? within - level : zero;
    filter_levels(&source, rhw_int_from_float_unchecked(level), fraction, def->min_filter, texel);
    const i32x8 magnified = rhw_less_equal(limited, zero);
    if (def->mag_filter != def->min_filter && rhw_any(magnified)) {
        f32x8 large[4];
        filter_level(&source, &texture->mip[0], def->mag_filter, large);
        for (int i = 0; i < 4; i++) {
            texel[i] = rhw_select(magnified, large[i], texel[i]);
        }
    }
    if (def->compares) {
        texel[1] = texel[2] = zero;
        texel[3] = rhw_splat(1.0f);
    }
}

// Sample two or four halves a texel linearly. Where one level is read by one filter, the level of detail says nothing
// and is not worked out.
static inline void sample_halves(const struct rhw_binding_data *binding,
                                 const struct rhw_sample_request *request, f32x8 texel[4])
{
    const struct rhw_texture_data *const texture = binding->texture;
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    if (def->mag_filter != def->min_filter || last_level(texture, binding->sampler) > 0) {
        sample_float(binding, request, true, texel);
        return;
    }
    const struct rhw_mip *const mip = &texture->mip[0];
    const f32x8 x = fold_coordinate(def->address_u, request->coordinates[0]) * (float)mip->width - 0.5f,
                y = fold_coordinate(def->address_v, request->coordinates[1]) * (float)mip->height - 0.5f;
    const f32x8 left = rhw_floor(x), top = rhw_floor(y);
    const i32x8 x0 = rhw_int_from_float_unchecked(left), y0 = rhw_int_from_float_unchecked(top);
    if (footprints_inside(mip, x0, y0)) {
        filter_halves(texture->info, mip, x0, y0, x - left, y - top, texel);
    } else {
        sample_float(binding, request, true, texel);
    }
}

#endif
