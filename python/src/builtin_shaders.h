// SPDX-License-Identifier: MIT
// The shaders that pipelines of Python are made of: one vertex and one fragment function, which do what the layout of a
// pipeline asks for. What a draw does not have, it does not pay for: the layout is the same for all of its lanes.
#ifndef PYTHON_BUILTIN_SHADERS_H
#define PYTHON_BUILTIN_SHADERS_H

#include "rhw/isa.h"

enum python_attribute { PYTHON_POSITIONS, PYTHON_COLORS, PYTHON_UV, PYTHON_NORMALS, PYTHON_ATTRIBUTES };

/// As the outputs of a model are, and in this order in rhw/pipeline.py.
enum python_output {
    PYTHON_COLOR, ///< of the vertices, times the texture, times the draw's
    PYTHON_DEPTH,
    PYTHON_DISTANCE, ///< W of the clip coordinates
    PYTHON_NORMAL,
    PYTHON_POSITION, ///< in the world
    PYTHON_UV_OUTPUT,
    PYTHON_BARYCENTRIC,
    PYTHON_OBJECT,
    PYTHON_TRIANGLE,
    PYTHON_OUTPUTS
};

enum python_varying {
    PYTHON_VARYING_COLOR,
    PYTHON_VARYING_UV,
    PYTHON_VARYING_NORMAL,
    PYTHON_VARYING_POSITION,
    PYTHON_VARYINGS
};

/// `user` of a pipeline's program. −1: there is none.
struct python_layout {
    int32_t attribute[PYTHON_ATTRIBUTES]; ///< place among the attributes
    int32_t varying[PYTHON_VARYINGS];     ///< first component
    int32_t target[PYTHON_OUTPUTS];
    bool is_textured;
};

/// Matrices column major.
struct python_uniforms {
    float clip[16]; ///< from the positions
    float world[16];
    float normal[9]; ///< carries normals to the world; of any length
    float color[4];
    uint32_t object, first_triangle;
};

RHW_ISA_DECLARE(rhw_vertex_function, python_vertex);
RHW_ISA_DECLARE(rhw_fragment_function, python_fragment);

#endif
