// SPDX-License-Identifier: MIT
// What random programs read and leave, and how they run on it.
#ifndef RANDOM_WORLD_H
#define RANDOM_WORLD_H

#include <rhw/bind.h>
#include <rhw/spirv.h>

#include "harness.h"

enum {
    SIDE = 16,
    WORKGROUPS = 3,
    SOURCE = 64,
    OWN = 8 * 1024,
    COUNTERS = 16,
    CANVAS = 32,
    PICTURE = 8,
    BINDINGS = 9
};

// What a program reads and leaves.
struct world {
    float numbers[8][4];
    int32_t wholes[8][4];
    uint32_t source[SOURCE], own[OWN], counters[COUNTERS];
    float canvas[CANVAS][CANVAS][4];
    float color[SIDE * SIDE][4];
};

// What stands around programs.
struct stage {
    struct rig rig;
    rhw_texture picture, canvas, levels, shadow;
    rhw_sampler sampler, filtering, comparing;
    struct rhw_binding set[BINDINGS];
    struct rhw_shader_frame frame;
    int32_t push[2];
};

void open_stage(struct stage *stage);
// Fill a world with numbers: those of a `kind` above 0 have infinities, denormals and what is no number among them.
void fill_world(struct world *world, int kind);
rhw_shader *create_shader(const char *name, const uint32_t *words, size_t size, enum rhw_shader_stage stage);
// Run a program on a new world: `drawn` or `compute`, as it was linked or written otherwise.
void run_program(struct stage *stage, const struct rhw_program *drawn,
                 const struct rhw_compute_program *compute, const rhw_shader_program *linked,
                 struct world *world, int kind);
// Say where worlds differ. Return whether they do.
bool worlds_differ(const char *name, const struct world *a, const struct world *b, const char *other);

#endif
