// SPDX-License-Identifier: MIT
// What particles.c and its shaders agree on.
#ifndef PARTICLES_H
#define PARTICLES_H

#include <rhw/isa.h>
#include <rhw/shader.h>

// The uniforms of both passes.
struct lens {
    float camera[16]; // world to clip coordinates
    float scale[2];   // what a length of 1 in the plane of the picture is in clip coordinates
    float glow;       // the part of its colour that a particle adds to the picture
};

#if RHW_HAS_LANES
struct spark {
    rhw_float color[3], id; // the id's bits, not its value
};
#endif

RHW_ISA_DECLARE(rhw_vertex_function, particles_face);
RHW_ISA_DECLARE(rhw_fragment_function, particles_solid);
RHW_ISA_DECLARE(rhw_fragment_function, particles_glow);

#endif
