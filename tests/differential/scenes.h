// SPDX-License-Identifier: MIT
// The scenes, by subject, and how far the two pictures of each may lie apart. A rule is true where somebody has looked at
// the pixels that differ and found why.
#ifndef DIFFERENTIAL_SCENES_H
#define DIFFERENTIAL_SCENES_H

#include "frame.h"

struct scene {
    const char *name;
    void (*describe)(struct frame *frame);
    const char *why; // pixels may differ by more than one unit; NULL: none may
    long pixels;     // how many
    double most;     // units, of any
};

struct scene_list {
    const struct scene *scenes;
    int count;
};

struct scene_list raster_scenes(void);
struct scene_list primitive_scenes(void);
struct scene_list test_scenes(void); // depth, stencil, queries
struct scene_list output_scenes(void);
struct scene_list texture_scenes(void);
struct scene_list shadow_scenes(void);
struct scene_list filter_scenes(void);
struct scene_list sample_scenes(void);
struct scene_list storage_scenes(void);
// The value as colour, smooth and flat.
extern const struct shader_pair smooth_color, flat_color;

#endif
