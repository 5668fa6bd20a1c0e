// SPDX-License-Identifier: MIT
// A target is what a pass draws into: its size in pixels and tiles, and its attachments, as tiles load, change and
// store them.
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
    const struct rhw_mip *target;  // NULL: the attachment exists in the tile alone
    int layer, level;              // first layer and level of the texture that are drawn into
    struct rhw_clean_tiles *clean; // clean tiles of the texture; NULL: it has none
    // This many bytes lie between one sample of the target and the next. 0: the target has one sample.
    size_t sample_stride;
    // The samples of the tile are resolved into this level where `resolves` is true. NULL: there is none.
    const struct rhw_mip *resolve;
    enum rhw_format resolve_format; // format of `resolve`; of depth with stencil, it may be that of one of both
    bool resolves;
    struct rhw_clean_tiles *resolve_clean;
    enum rhw_resolve resolve_mode;
    bool is_left_out;    // a colour attachment whose texels in tiles nobody writes or wants
    bool is_read_only;   // loaded, and never stored, because it is sampled meanwhile
    bool loads_resolved; // the texels of `resolve` are loaded, for all samples
    // A tile starts from this value where nothing is loaded, texels side by side. It is the clear value, or 0, which is
    // undefined to the user and still the same bytes on every run.
    unsigned char clear[RHW_CLEAR_BYTES];
    size_t texel_size;
};

struct rhw_target {
    int width, height, tiles_x, tiles_y;
    int layers;                               // layers of every attachment
    struct rhw_rect area;                     // the render area: pixels outside of it are not touched
    const struct rhw_sample_pattern *pattern; // samples of a pixel
    int color_count;
    struct rhw_attachment colors[RHW_MAX_COLOR_ATTACHMENTS];
    bool has_depth, has_stencil;
    struct rhw_attachment depth, stencil;
    // A UNORM format of depth has this many steps in memory, while depth in the tile is a float. 0: the format has
    // none.
    double depth_steps;
};

static inline int rhw_target_tiles(const struct rhw_target *target)
{
    return target->tiles_x * target->tiles_y * target->layers;
}

#endif
