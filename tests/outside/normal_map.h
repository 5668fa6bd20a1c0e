// SPDX-License-Identifier: MIT
// What normal_map.c and its shaders agree on.
#ifndef NORMAL_MAP_H
#define NORMAL_MAP_H

#include <rhw/isa.h>
#include <rhw/shader.h>

// Texture slots.
enum { ALBEDO, NORMALS };

struct material {
    float camera[16]; // world to clip coordinates
    float eye[3];
    float towards[3]; // the sun, of length 1
    float ambient, shine, sharpness;
};

// A normal map has the bytes 1..255 for −1..1, and 128 for 0.
static const float normal_scale = 255.0f / 127, normal_offset = -128.0f / 127;

// The varyings, for either form. `tangent` points where u grows; [3] is −1 where the texture is mirrored.
#if RHW_HAS_LANES
struct surface {
    rhw_float uv[2], world[3], normal[3], tangent[4];
};
#endif

struct surface1 {
    float uv[2], world[3], normal[3], tangent[4];
};

RHW_ISA_DECLARE(rhw_vertex_function, normal_map_place);
RHW_ISA_DECLARE(rhw_fragment_function, normal_map_light);

#endif
