// SPDX-License-Identifier: MIT
// What tests of multisampling draw with: a rig whose target has several samples, and its samples read back.
#ifndef SAMPLE_RIG_H
#define SAMPLE_RIG_H

#include "harness.h"

#include <string.h>

enum { SIZE = 72, PIXELS = SIZE * SIZE, COUNTS = 4 };

static const int counts[COUNTS] = {2, 4, 8, 16};

static inline rhw_texture make_texture(struct rig *rig, enum rhw_format format, int samples)
{
    rhw_texture texture;
    const struct rhw_texture_def def = {.format = format, .width = SIZE, .height = SIZE, .samples = samples};
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

// A rig whose target has that many samples, and depth too.
static inline void open_samples(struct rig *rig, int samples, enum rhw_paths paths)
{
    rig_open_with(rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig_set_depth(rig);
    rhw_texture_destroy(rig->context, rig->pass.colors[0].texture);
    rhw_texture_destroy(rig->context, rig->pass.depth.texture);
    rig->pass.colors[0].texture = make_texture(rig, RHW_FORMAT_RGBA32_FLOAT, samples);
    rig->pass.depth.texture = make_texture(rig, RHW_FORMAT_D32_FLOAT, samples);
}

static inline const float (*read_color(struct rig *rig, int sample))[4]
{
    static float pixels[PIXELS][4];
    assert_int_equal(rhw_texture_read_sample(rig->context, rig->pass.colors[0].texture, sample, pixels, 0),
                     RHW_OK);
    return (const float(*)[4])pixels;
}

static inline const float *read_depth(struct rig *rig, int sample)
{
    static float depth[PIXELS];
    assert_int_equal(rhw_texture_read_sample(rig->context, rig->pass.depth.texture, sample, depth, 0),
                     RHW_OK);
    return depth;
}

#endif
