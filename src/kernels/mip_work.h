// SPDX-License-Identifier: MIT
// What threads share while they make the levels of a texture: a job makes a few levels from one, in bands of rows.
#ifndef RHW_MIP_WORK_H
#define RHW_MIP_WORK_H

#include <stddef.h>

struct rhw_texture_data;

enum {
    // Levels of a job: so few that bands of odd sizes, which overlap, have few rows in common.
    RHW_MIP_STEPS = 3
};

// Levels as floats, unrounded, on the scale of texel/mip_codec.h. Each row has one channel after the other of the
// channels that the format has.
struct rhw_mip_job {
    const struct rhw_texture_data *texture;
    // The slice of each level that is made, and of level `base` where it is read. It is a layer of an array.
    int slice;
    int base, last;    // levels base + 1 .. last are made, RHW_MIP_STEPS at most
    const float *from; // level `base`; NULL: it is level 0, as the texture has it
    float *to;         // level `last`; NULL: no level follows
    int band;          // rows of level `last` that a task makes
    float *scratch;    // `scratch_size` zeros for each worker
    size_t scratch_size;
};

// One level of a 3D texture, made from the one above, which may be larger in depth. A task makes a slice.
struct rhw_mip_volume_job {
    const struct rhw_texture_data *texture;
    int base; // level base + 1 is made
    // Level `base`, with slices of rows as in rhw_mip_job. NULL: it is level 0, as the texture has it.
    const float *from;
    float *to; // level base + 1; NULL: no level follows
    // `scratch_size` zeros for each worker: a slice of level `base`, and what a band needs.
    float *scratch;
    size_t scratch_size;
};

// Return the floats from one channel to the next. The kernel computes whole groups of 8 lanes, of which the last reads
// up to 18 columns behind the row's last but one.
static inline size_t rhw_mip_stride(int width)
{
    return (((size_t)width + 15) & ~(size_t)15) + 16;
}

// Return the floats of a row: all channels.
static inline size_t rhw_mip_row(int width, int channels)
{
    return (size_t)channels * rhw_mip_stride(width);
}

#endif
