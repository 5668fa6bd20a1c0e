// SPDX-License-Identifier: MIT
// The shaders that pipelines of Python are made of: one vertex and one fragment function, which do what the layout of a
// pipeline asks for. What a draw does not have, it does not pay for: the layout is the same for all of its lanes.
#ifndef PYTHON_BUILTIN_SHADERS_H
#define PYTHON_BUILTIN_SHADERS_H

#include "rhw/isa.h"

enum builtin_attribute { BUILTIN_POSITIONS, BUILTIN_COLORS, BUILTIN_UV, BUILTIN_NORMALS, BUILTIN_ATTRIBUTES };

/// As the outputs of a model are, and in this order in rhw/pipeline.py.
enum builtin_output {
    BUILTIN_COLOR, ///< of the vertices, times the texture, times the draw's
    BUILTIN_DEPTH,
    BUILTIN_DISTANCE, ///< W of the clip coordinates
    BUILTIN_NORMAL,
    BUILTIN_POSITION, ///< in the world
    BUILTIN_UV_OUTPUT,
    BUILTIN_BARYCENTRIC,
    BUILTIN_OBJECT,
    BUILTIN_TRIANGLE,
    BUILTIN_OUTPUTS
};

enum builtin_varying {
    BUILTIN_VARYING_COLOR,
    BUILTIN_VARYING_UV,
    BUILTIN_VARYING_NORMAL,
    BUILTIN_VARYING_POSITION,
    BUILTIN_VARYINGS
};

/// `user` of a pipeline's program. −1: there is none.
struct builtin_layout {
    int32_t attribute[BUILTIN_ATTRIBUTES]; ///< place among the attributes
    int32_t varying[BUILTIN_VARYINGS];     ///< first component
    int32_t target[BUILTIN_OUTPUTS];
    bool is_textured;
};

/// Matrices column major.
struct builtin_uniforms {
    float clip[16]; ///< from the positions
    float world[16];
    float normal[9]; ///< carries normals to the world; of any length
    float color[4];
    uint32_t object, first_triangle;
};

RHW_ISA_DECLARE(rhw_vertex_function, builtin_vertex);
RHW_ISA_DECLARE(rhw_fragment_function, builtin_fragment);

#endif
