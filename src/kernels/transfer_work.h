// SPDX-License-Identifier: MIT
// What threads share while a region of a texture is made from another one: scaled, or resolved from samples.
#ifndef RHW_TRANSFER_WORK_H
#define RHW_TRANSFER_WORK_H

#include <stdbool.h>

#include "resource/texture.h"
#include "rhw/pass_def.h"

// For each texel along an axis of the target, where it lies in the source: between two texels, inside. Of nearest filters
// `low` alone counts.
struct rhw_blit_axis {
    const int32_t *low, *high;
    const float *weight; // of `high`
};

struct rhw_blit_job {
    const struct rhw_format_info *from_info, *to_info;
    struct rhw_mip from, to;          // the planes
    struct rhw_blit_axis axis[3];     // those of x go on with their last entry, to a whole group of 8
    bool is_linear, has_slice_filter; // the second: along z too
    bool is_copied;                   // bit for bit: nearest, of one format
    int x, y, z;                      // of the target's region
    int width, height, depth;
    int band; // rows of a task, of all slices one after the other
};

struct rhw_resolve_job {
    const struct rhw_format_info *info;
    enum rhw_resolve mode; // not DEFAULT
    const unsigned char *from;
    size_t from_row, from_slice, sample_stride;
    int samples;
    unsigned char *to;
    size_t to_row, to_slice;
    int width, height, depth;
    int band;
};

#endif
