// SPDX-License-Identifier: MIT
// What deferred.c and its shaders agree on.
#ifndef DEFERRED_H
#define DEFERRED_H

#include <rhw/isa.h>
#include <rhw/shader.h>

// The uniforms of all passes.
struct view {
    float camera[16]; // world to clip coordinates
    float eye[3];
    float corner[3], right[3],
        down[3]; // what the eye sees at a depth of 1: the top left corner, a pixel's steps
    float near, far;
    float size[2]; // of the picture, in pixels
    float ambient;
};

// Slots of the textures that the later passes read.
enum { SLOT_ALBEDO, SLOT_NORMAL, SLOT_DEPTH, SLOT_LIGHT };

#if RHW_HAS_LANES
struct surface {
    rhw_float normal[3], albedo[3];
};

struct glow {
    rhw_float center[3], radius, color[3];
};
#endif

RHW_ISA_DECLARE(rhw_vertex_function, deferred_place);
RHW_ISA_DECLARE(rhw_fragment_function, deferred_store);
RHW_ISA_DECLARE(rhw_vertex_function, deferred_volume);
RHW_ISA_DECLARE(rhw_fragment_function, deferred_light);
RHW_ISA_DECLARE(rhw_vertex_function, deferred_screen);
RHW_ISA_DECLARE(rhw_fragment_function, deferred_resolve);

#endif
