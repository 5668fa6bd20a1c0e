// SPDX-License-Identifier: MIT
// Vertex and fragment functions of a stage.
#ifndef STAGE_SHADERS_H
#define STAGE_SHADERS_H

#include "rhw/isa.h"
#include "rhw/shader.h"

/// A vertex as the pipeline gets it.
struct stage_vertex {
    float clip[4];
    float uv[2];
    float color[3];
};

/// What a fragment by way of the world puts out: its colour or, when its pixel is asked about, what that was made with.
enum stage_told {
    STAGE_TOLD_COLOR,
    STAGE_TOLD_POINT,   ///< x, y, z of P in the world
    STAGE_TOLD_WEIGHTS, ///< a, b, c
    STAGE_TOLD_VALUES,  ///< u, v, green
    STAGE_TOLD
};

/// Of a draw: one triangle.
struct stage_uniforms {
    float world_from_screen[4][4]; ///< rows; from (column, row, depth, 1), up to a factor
    float corner[3][3];            ///< in the world
    float corner_uv[3][2], corner_color[3][3];
    float largest_inverse_w;
    int32_t by_world; ///< weights are areas in the world
    int32_t pattern;  ///< enum stage_pattern
    int32_t told;     ///< enum stage_told
};

/// The varyings: u, v with derivatives, red, green, blue.
enum { STAGE_U, STAGE_V, STAGE_RED, STAGE_COMPONENTS = 5 };

RHW_ISA_DECLARE(rhw_vertex_function, stage_place);
RHW_ISA_DECLARE(rhw_fragment_function, stage_paint); ///< with RHW_USE_COORD by world, of depth and of 1/W

#endif
