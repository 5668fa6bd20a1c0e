// SPDX-License-Identifier: MIT
// What main.c and the shaders agree on.
#ifndef SHADERS_H
#define SHADERS_H

#include <rhw/isa.h>
#include <rhw/shader.h>

// The uniforms.
struct ripple {
    float cosine, sine; // of the angle by which the square leans back
    float frequency, phase;
};

RHW_ISA_DECLARE(rhw_vertex_function, place);
RHW_ISA_DECLARE(rhw_fragment_function, paint);

#endif
