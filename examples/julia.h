// SPDX-License-Identifier: MIT
// What lesson 8 and its shaders agree on.
#ifndef JULIA_H
#define JULIA_H

#include <rhw/isa.h>
#include <rhw/shader.h>

enum { PALETTE = 12 };

/// The uniforms.
struct julia {
    float clip[16];            ///< from the floor to clip coordinates, column by column
    float c[2];                ///< of z² + c
    float escape;              ///< |z|² beyond which a point has left for good
    int steps;                 ///< at most; who is still there by then never leaves
    int duals;                 ///< 0: the gradient of the floor, as if the texture lay on it
    float sky[3];              ///< what the floor fades into
    float palette[PALETTE][3]; ///< by the number of steps
};

/// The varyings.
struct floor_point {
    rhw_float at[2]; ///< on the floor
    rhw_float far;   ///< 0 near, 1 where it has faded
};

RHW_ISA_DECLARE(rhw_vertex_function, julia_vertex);
RHW_ISA_DECLARE(rhw_fragment_function, julia_fragment);
/// The texture coordinates u, v and du/dx, dv/dy instead of a colour; −1 where a point never leaves.
RHW_ISA_DECLARE(rhw_fragment_function, julia_numbers);

#endif
