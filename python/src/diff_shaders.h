// SPDX-License-Identifier: MIT
// The shaders that rhw.diff rasterizes with.
#ifndef PYTHON_DIFF_SHADERS_H
#define PYTHON_DIFF_SHADERS_H

#include "rhw/isa.h"

struct diff_uniforms {
    int32_t first_triangle; ///< of the draw among all
    int32_t peels;          ///< whether texture 0 holds the depths of the layer before
};

/// Positions are clip coordinates whose y points up while rows go down: row 0 is the lowest of the picture.
RHW_ISA_DECLARE(rhw_vertex_function, diff_vertex);
/// Target 0: u, v, z/w, triangle + 1; target 1: du/dx, du/dy, dv/dx, dv/dy per pixel.
RHW_ISA_DECLARE(rhw_fragment_function, diff_fragment);

#endif
