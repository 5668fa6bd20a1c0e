// SPDX-License-Identifier: MIT
// What shadow_map.c and its shaders agree on.
#ifndef SHADOW_MAP_H
#define SHADOW_MAP_H

#include <rhw/isa.h>
#include <rhw/shader.h>

// The uniforms of both passes.
struct sun {
    float camera[16], light[16]; // world to clip coordinates
    float towards[3];            // the sun, of length 1
    float ambient;
    float texel; // of the map, in its coordinates
    float bias;  // in depth of the map
};

#if RHW_HAS_LANES
struct ground {
    rhw_float world[3], normal[3], albedo[3];
};
#endif

RHW_ISA_DECLARE(rhw_vertex_function, shadow_cast);
RHW_ISA_DECLARE(rhw_vertex_function, shadow_place);
RHW_ISA_DECLARE(rhw_fragment_function, shadow_light);

#endif
