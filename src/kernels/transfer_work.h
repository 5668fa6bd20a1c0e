// SPDX-License-Identifier: MIT
// What threads share while a region of a texture is made from another one: scaled, or resolved from samples.
#ifndef RHW_TRANSFER_WORK_H
#define RHW_TRANSFER_WORK_H

#include <stdbool.h>

#include "resource/texture.h"
#include "rhw/pass_def.h"

// For each texel along an axis of the target, where it lies in the source: between two texels, inside. Nearest filters
// use `low` alone.
struct rhw_blit_axis {
    const int32_t *low, *high;
    const float *weight; // weight of `high`
};

struct rhw_blit_job {
    const struct rhw_format_info *from_info, *to_info;
    struct rhw_mip from, to; // levels of the regions
    // The axis of x goes on with its last entry, to a whole group of 8.
    struct rhw_blit_axis axis[3];
    bool is_linear, has_slice_filter; // has_slice_filter: the filter is linear along z too
    // Bits are copied: the filter is nearest, and both regions have one format.
    bool is_copied;
    int x, y, z; // place of the target's region
    int width, height, depth;
    int band; // rows of a task, of all slices one after the other
};

struct rhw_resolve_job {
    const struct rhw_format_info *info;
    enum rhw_resolve mode; // any but RHW_RESOLVE_DEFAULT
    const unsigned char *from;
    size_t from_row, from_slice, sample_stride;
    int samples;
    unsigned char *to;
    size_t to_row, to_slice;
    int width, height, depth;
    int band;
};

#endif
