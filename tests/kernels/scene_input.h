// SPDX-License-Identifier: MIT
// A few hostile draws as plain numbers: what the checks of whole kernels are given. draw_scene.h makes a pass of them.
#ifndef SCENE_INPUT_H
#define SCENE_INPUT_H

#include "resource/clean_tiles.h"
#include "rhw/pass_def.h"

#include "kernel_check.h"

enum {
    SCENE_DRAWS = 3,
    SCENE_VERTICES = 36, // of the buffer, whose records have 16 floats each
    SCENE_INDICES = 36,
    SCENE_TARGETS = 2,
    SCENE_COMPONENTS = 12,
    SCENE_VARYINGS = 4,
    SCENE_SIZE = 150, // pixels, each way: the tiles at the end are parts
    SCENE_READ_BEHIND = 16
};

// What one draw has of its own.
struct scene_draw {
    struct rhw_color_target targets[SCENE_TARGETS];
    struct rhw_varying varyings[SCENE_VARYINGS];
    struct rhw_viewport viewport;
    struct rhw_rect scissor; // within the target
    float constant[4], uniforms[4];
    uint32_t uses, first, count, base_vertex, instances;
    int32_t varying_count, shades, topology, restarts, provoking, cull, front, depth_range;
    int32_t depth_test, depth_compare, depth_write, indexed, index_type;
};

struct scene_input {
    float vertices[SCENE_VERTICES][16]; // position, then varyings
    float read_behind[SCENE_READ_BEHIND / 4];
    uint32_t indices[SCENE_INDICES];
    struct scene_draw draws[SCENE_DRAWS];
    unsigned char clear[SCENE_TARGETS][RHW_CLEAR_BYTES];
    float clear_depth[RHW_CLEAR_BYTES / 4];
    int32_t formats[SCENE_TARGETS];
    int32_t draw_count, target_count, width, height, tile;
    uint32_t split, entries_most; // triangles of the first chunk, seldom all; see struct rhw_wave
};

// Fills a zeroed input; all draws have the same index type.
void make_scene(struct kernel_random *random, void *input);

#endif
