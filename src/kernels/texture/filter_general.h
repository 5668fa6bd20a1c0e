// SPDX-License-Identifier: MIT
// The general filter serves textures of every kind and format, and all that a sampler and a request may ask for, in
// floats. Every lane has a level, a layer and a face of its own, so that no lane waits for another; looking their sizes
// up costs little beside the texels. Plain 2D textures come here for what filter_float.h and filter_fixed.h do not do.
#ifndef RHW_FILTER_GENERAL_H
#define RHW_FILTER_GENERAL_H

#include "base/compare.h"
#include "lane_level.h"
#include "addressing.h"

enum { MOST_TEXELS = 8 };

// The texels of one footprint, and the weight of the upper ones along each axis.
struct texel_block {
    i32x8 low[3];
    f32x8 weight[3];
    // Bit i of a texel's number says that it is the upper one along axis i.
    f32x8 texel[MOST_TEXELS][4];
};

// Load texels that may lie outside, along the axes. Compare them where the sampler does.
static inline void general_texels(const struct lookup *lookup, const struct lane_level *level,
                                  const i32x8 at[3], i32x8 slice, f32x8 texel[4])
{
    const struct rhw_sampler_def *const def = &lookup->sampler->def;
    i32x8 inside[3] = {i32x8_splat(0), i32x8_splat(0), slice}, outside = i32x8_splat(0);
    for (int i = 0; i < lookup->axes; i++) {
        inside[i] = lookup->is_cube ? at[i] : wrap_texel(lookup->address[i], at[i], level->size[i]);
        if (!lookup->is_cube && lookup->address[i] == RHW_ADDRESS_BORDER) {
            outside = outside | ~rhw_equal_int(inside[i], at[i]);
        }
    }
    lane_texels(lookup->texture, level, inside[0], inside[1], inside[2], texel);
    for (int c = 0; lookup->border && c < 4; c++) {
        texel[c] = rhw_select(outside, border_channel(lookup->texture->info, def, c), texel[c]);
    }
    if (def->compares) {
        const i32x8 holds = compare_lanes(def->compare, lookup->reference, texel[0]);
        texel[0] = rhw_select(holds, rhw_splat(1.0f), rhw_splat(0.0f));
    }
}

// Return the coordinate along an axis in texels of the level.
static inline f32x8 texel_coordinate(const struct lookup *lookup, const struct lane_level *level, int axis)
{
    const bool unnormalized = lookup->sampler->def.unnormalized;
    return unfolded_texels(lookup->at[axis],
                           unnormalized ? rhw_splat(1.0f) : rhw_float_from_int(level->size[axis]));
}

static inline void general_nearest(const struct lookup *lookup, const struct lane_level *level,
                                   f32x8 texel[4])
{
    i32x8 at[3];
    for (int i = 0; i < lookup->axes; i++) {
        i32x8 last = level->size[i] - 1;
        at[i] = rhw_int_from_float_unchecked(rhw_floor(texel_coordinate(lookup, level, i)));
        if (lookup->address[i] == RHW_ADDRESS_MIRROR) {
            last = last + level->size[i];
        }
        // The end of a period stands for a coordinate just below it.
        if (lookup->is_cube || lookup->address[i] <= RHW_ADDRESS_MIRROR) {
            at[i] = rhw_min_int(at[i], last);
        }
        at[i] = at[i] + lookup->offset[i];
    }
    general_texels(lookup, level, at, lookup->slice + lookup->face, texel);
}

// Find the 2, 4 or 8 texels around the place.
static inline void find_block(const struct lookup *lookup, const struct lane_level *level,
                              struct texel_block *block)
{
    for (int i = 0; i < lookup->axes; i++) {
        const f32x8 at = texel_coordinate(lookup, level, i) - 0.5f;
        const f32x8 low = rhw_floor(at);
        block->weight[i] = at - low;
        block->low[i] = rhw_int_from_float_unchecked(low) + lookup->offset[i];
    }
}

// Fill in the texel at a corner of a cube, which has no place on any face: it is the average of the three others.
static inline void fill_corner(struct texel_block *block, int corner, i32x8 is_corner)
{
    for (int c = 0; c < 4 && rhw_any(is_corner); c++) {
        f32x8 sum = rhw_splat(0.0f);
        for (int i = 0; i < 4; i++) {
            sum += i == corner ? rhw_splat(0.0f) : block->texel[i][c];
        }
        block->texel[corner][c] = rhw_select(is_corner, sum / 3.0f, block->texel[corner][c]);
    }
}

static inline void load_cube_block(const struct lookup *lookup, const struct lane_level *level,
                                   struct texel_block *block)
{
    i32x8 is_corner[4];
    const i32x8 size = level->size[0];
    for (int n = 0; n < 4; n++) {
        i32x8 at[3] = {block->low[0] + (n & 1), block->low[1] + (n >> 1), i32x8_splat(0)};
        const i32x8 outside_x = (at[0] >> 31) | ~rhw_less_int(at[0], size),
                    outside_y = (at[1] >> 31) | ~rhw_less_int(at[1], size);
        is_corner[n] = outside_x & outside_y;
        i32x8 face = lookup->face;
        if (rhw_any(outside_x | outside_y)) {
            cross_edge(size, &at[0], &at[1], &face);
        }
        general_texels(lookup, level, at, lookup->slice + face, block->texel[n]);
    }
    for (int n = 0; n < 4; n++) {
        fill_corner(block, n, is_corner[n]);
    }
}

static inline void load_block(const struct lookup *lookup, const struct lane_level *level,
                              struct texel_block *block)
{
    if (lookup->is_cube) {
        load_cube_block(lookup, level, block);
        return;
    }
    for (int n = 0; n < 1 << lookup->axes; n++) {
        i32x8 at[3];
        for (int i = 0; i < lookup->axes; i++) {
            at[i] = block->low[i] + (n >> i & 1);
        }
        general_texels(lookup, level, at, lookup->slice, block->texel[n]);
    }
}

// Return the weighted average: along u first, then v, then w.
static inline void average_block(const struct texel_block *block, int axes, f32x8 texel[4])
{
    for (int c = 0; c < 4; c++) {
        f32x8 value[MOST_TEXELS];
        for (int n = 0; n < 1 << axes; n++) {
            value[n] = block->texel[n][c];
        }
        for (int i = 0; i < axes; i++) {
            for (int n = 0; n < 1 << (axes - 1 - i); n++) {
                value[n] = rhw_mix(value[2 * n], value[2 * n + 1], block->weight[i]);
            }
        }
        texel[c] = value[0];
    }
}

static inline f32x8 reduced(enum rhw_reduction reduction, f32x8 a, f32x8 b)
{
    return reduction == RHW_REDUCTION_MIN ? rhw_min(a, b) : rhw_max(a, b);
}

// Return the least or greatest of the texels that have a weight.
static inline void reduce_block(const struct texel_block *block, int axes, enum rhw_reduction reduction,
                                f32x8 texel[4])
{
    const f32x8 zero = rhw_splat(0.0f);
    i32x8 found = i32x8_splat(0);
    texel[0] = texel[1] = texel[2] = texel[3] = zero;
    for (int n = 0; n < 1 << axes; n++) {
        i32x8 has_weight = i32x8_splat(-1);
        for (int i = 0; i < axes; i++) {
            const f32x8 weight = n >> i & 1 ? block->weight[i] : 1.0f - block->weight[i];
            has_weight = has_weight & rhw_less(zero, weight);
        }
        for (int c = 0; c < 4; c++) {
            const f32x8 both =
                rhw_select(found, reduced(reduction, texel[c], block->texel[n][c]), block->texel[n][c]);
            texel[c] = rhw_select(has_weight, both, texel[c]);
        }
        found = found | has_weight;
    }
}

static inline void general_linear(const struct lookup *lookup, const struct lane_level *level, f32x8 texel[4])
{
    const enum rhw_reduction reduction = lookup->sampler->def.reduction;
    struct texel_block block;
    find_block(lookup, level, &block);
    load_block(lookup, level, &block);
    if (reduction == RHW_REDUCTION_AVERAGE) {
        average_block(&block, lookup->axes, texel);
    } else {
        reduce_block(&block, lookup->axes, reduction, texel);
    }
}

// Levels --------------------------------------------------------------------------------------------

static inline void general_level(const struct lookup *lookup, i32x8 number, enum rhw_filter filter,
                                 f32x8 texel[4])
{
    const struct lane_level level = lane_level_at(lookup->texture, number);
    if (filter == RHW_FILTER_LINEAR) {
        general_linear(lookup, &level, texel);
    } else {
        general_nearest(lookup, &level, texel);
    }
}

// Add the next level where it has a weight.
static inline void mix_next_level(const struct lookup *lookup, i32x8 number, f32x8 fraction, f32x8 texel[4])
{
    const struct rhw_sampler_def *const def = &lookup->sampler->def;
    const i32x8 between = rhw_less(rhw_splat(0.0f), fraction);
    if (!rhw_any(between)) {
        return;
    }
    f32x8 next[4];
    general_level(lookup, rhw_min_int(number + 1, i32x8_splat(lookup->texture->levels - 1)), def->min_filter,
                  next);
    for (int c = 0; c < 4; c++) {
        const f32x8 both = def->reduction == RHW_REDUCTION_AVERAGE
                               ? rhw_mix(texel[c], next[c], fraction)
                               : reduced(def->reduction, texel[c], next[c]);
        texel[c] = rhw_select(between, both, texel[c]);
    }
}

static __attribute__((noinline)) void sample_general(const struct rhw_binding_data *binding,
                                                     const struct rhw_sample_request *request, f32x8 texel[4])
{
    struct lookup lookup;
    look_up(binding, request, &lookup);
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    const struct lane_lod lod =
        limit_level(binding->texture, binding->sampler, requested_level(binding->texture, request));
    f32x8 fraction;
    const i32x8 number = rhw_int_from_float_unchecked(first_level(binding->sampler, lod.within, &fraction));
    general_level(&lookup, number, def->min_filter, texel);
    mix_next_level(&lookup, number, fraction, texel);
    const i32x8 magnified = rhw_less_equal(lod.limited, rhw_splat(0.0f));
    if (def->mag_filter != def->min_filter && rhw_any(magnified)) {
        f32x8 large[4];
        general_level(&lookup, i32x8_splat(0), def->mag_filter, large);
        for (int c = 0; c < 4; c++) {
            texel[c] = rhw_select(magnified, large[c], texel[c]);
        }
    }
    if (def->compares) {
        texel[1] = texel[2] = rhw_splat(0.0f);
        texel[3] = rhw_splat(1.0f);
    }
}

#endif
