// SPDX-License-Identifier: MIT
// What game_loop.c and its shaders agree on.
#ifndef GAME_LOOP_H
#define GAME_LOOP_H

#include <rhw/isa.h>
#include <rhw/shader.h>

// Uniforms of a mesh: those of the frame, then those of the draw.
struct mesh_uniforms {
    float clip[16], sun[3]; // world to clip coordinates; towards the sun, of length 1
    float model[16], tint[3];
};

struct spark_uniforms {
    float clip[16], right[3], up[3]; // those of the camera: sparks face it
};

struct hud_uniforms {
    float window[2], texture[2]; // their sizes
};

#if RHW_HAS_LANES
struct surface {
    rhw_float normal[3], uv[2];
};

struct sprite {
    rhw_float uv[2], color[4];
};
#endif

RHW_ISA_DECLARE(rhw_vertex_function, game_mesh_place);
RHW_ISA_DECLARE(rhw_fragment_function, game_mesh_paint);
RHW_ISA_DECLARE(rhw_vertex_function, game_spark_place);
RHW_ISA_DECLARE(rhw_fragment_function, game_spark_paint);
RHW_ISA_DECLARE(rhw_vertex_function, game_hud_place);
RHW_ISA_DECLARE(rhw_fragment_function, game_hud_paint);

#endif
