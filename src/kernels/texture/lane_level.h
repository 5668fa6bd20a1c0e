// SPDX-License-Identifier: MIT
// Texels where every lane may read another mip level, layer or slice. The general sampler numbers them from the
// texture's first one, with 31 bits (texture_shape.c keeps them there).
#ifndef RHW_LANE_LEVEL_H
#define RHW_LANE_LEVEL_H

#include "texel_fetch.h"

// The level of each lane.
struct lane_level {
    i32x8 size[3];           // texels along u, v, w
    i32x8 slices;            // slices of a 3D texture; layers of others
    i32x8 first, row, slice; // texels before the level; from row to row; from slice to slice
};

// Return the levels. `level` is one that the texture has, in every lane.
RHW_INLINE struct lane_level lane_level_at(const struct rhw_texture_data *texture, i32x8 level)
{
    const struct rhw_level_table *const table = &texture->table;
    const i32x8 slices = i32x8_gather(table->slices, level);
    return (struct lane_level){
        .size = {i32x8_gather(table->width, level), i32x8_gather(table->height, level), slices},
        .slices = slices,
        .first = i32x8_gather(table->first, level),
        .row = i32x8_gather(table->row, level),
        .slice = i32x8_gather(table->slice, level)};
}

// Load texels (x, y) of slices, all of them inside, as floats, colour linear.
RHW_INLINE void lane_texels(const struct rhw_texture_data *texture, const struct lane_level *level, i32x8 x,
                            i32x8 y, i32x8 slice, f32x8 texel[4])
{
    struct raw_texels raw;
    fetch_numbered_texels(texture->info->size, texture->mip[0].texels,
                          level->first + slice * level->slice + y * level->row + x, &raw);
    decode_texels(texture->info, &raw, texel);
}

#endif
