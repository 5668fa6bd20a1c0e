// SPDX-License-Identifier: MIT
// What a pass draws into: its size in pixels and tiles, and its attachments, as tiles load, change and store them.
#ifndef RHW_TARGET_H
#define RHW_TARGET_H

#include "base/constants.h"
#include "resource/clean_tiles.h"
#include "resource/sample_pattern.h"
#include "resource/texture.h"
#include "rhw/pass_def.h"

struct rhw_attachment {
    enum rhw_format format;
    enum rhw_load load;
    enum rhw_store store;
    const struct rhw_mip *target;  // NULL: exists in the tile alone
    int layer, level;              // of its texture that is drawn into; the first layer
    struct rhw_clean_tiles *clean; // of a texture; NULL where there is none
    size_t sample_stride;          // bytes from one sample of the target to the next; 0 where it has one
    // Where the samples of the tile are resolved into, if they are; NULL: nowhere.
    const struct rhw_mip *resolve;
    bool resolves;
    struct rhw_clean_tiles *resolve_clean;
    enum rhw_resolve resolve_mode;
    bool is_left_out;    // of colour; tiles have texels for it that nobody writes or wants
    bool is_read_only;   // loaded, and never stored: it is sampled meanwhile
    bool loads_resolved; // what is loaded are the texels of `resolve`, for all samples
    // What a tile starts from where nothing is loaded, texels side by side: the clear value, or 0, which is undefined
    // to the user and still the same bytes on every run.
    unsigned char clear[RHW_CLEAR_BYTES];
    size_t texel_size;
};

struct rhw_target {
    int width, height, tiles_x, tiles_y;
    int layers;                               // of every attachment
    struct rhw_rect area;                     // of rendering: pixels outside of it are not touched
    const struct rhw_sample_pattern *pattern; // samples of a pixel
    int color_count;
    struct rhw_attachment colors[RHW_MAX_COLOR_ATTACHMENTS];
    bool has_depth, has_stencil;
    struct rhw_attachment depth, stencil;
    double
        depth_steps; // of a UNORM format, which memory has and the tile has not: there depth is a float; else 0
};

static inline int rhw_target_tiles(const struct rhw_target *target)
{
    return target->tiles_x * target->tiles_y * target->layers;
}

#endif
