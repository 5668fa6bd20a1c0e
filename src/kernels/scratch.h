// SPDX-License-Identifier: MIT
// What a worker needs while it runs a chunk or a tile: allocated once per thread, sized by the limits of the
// API, of which a draw touches only what it uses.
#ifndef RHW_SCRATCH_H
#define RHW_SCRATCH_H

#include "../limits.h"
#include "../pass.h"
#include "../simd.h"

enum {
    // Groups of 8 vertices per call of the vertex function: enough to hide the call, few enough that their
    // attributes and varyings stay in the first cache level.
    RHW_VERTEX_GROUPS = 8,
    // Entries of the post-transform cache, a power of two. Direct mapped by vertex index: it holds a whole
    // batch of a mesh whose indices are local, and a miss only shades a vertex twice.
    RHW_VERTEX_CACHE = 8192,
    // Groups of 8 fragments per call of the fragment function.
    RHW_FRAGMENT_GROUPS = 16
};

struct rhw_cache_entry {
    uint32_t index, slot, epoch; // live when epoch is the scratch's
};

struct rhw_front_scratch {
    _Alignas(64) struct rhw_triangle triangles[RHW_BATCH_TRIANGLES];
    struct rhw_vertex groups[RHW_VERTEX_GROUPS];
    f8 attributes[RHW_VERTEX_GROUPS][RHW_MAX_ATTRIBUTES][4];
    f8 varyings[RHW_VERTEX_GROUPS * RHW_MAX_VARYING_COMPONENTS];
    uint32_t corners[RHW_BATCH_TRIANGLES + 8]
                    [3]; // vertex indices, then slots; 8 more so that a group may over-read
    uint32_t unique[3 * RHW_BATCH_TRIANGLES + 8]; // vertex index by slot
    struct rhw_segment segments[RHW_BATCH_TRIANGLES];
    struct rhw_polygon polygons[RHW_BATCH_TRIANGLES];
    struct rhw_cache_entry cache[RHW_VERTEX_CACHE];
    uint32_t epoch;
    int triangle_count, segment_count, polygon_count;
};

// Where the 8 fragments of a group stand, and what is needed of them after the fragment function.
struct rhw_group_place {
    int x, y;      // in the tile
    unsigned bits; // live lanes
};

struct rhw_tile_scratch {
    _Alignas(64) unsigned char color[RHW_MAX_COLOR_ATTACHMENTS][RHW_TILE * RHW_TILE * 16];
    float depth[RHW_TILE * RHW_TILE];
    struct rhw_fragment groups[RHW_FRAGMENT_GROUPS];
    struct rhw_group_place places[RHW_FRAGMENT_GROUPS];
    f8 varyings[RHW_FRAGMENT_GROUPS * RHW_MAX_VARYING_COMPONENTS];
    f8 ddx[RHW_FRAGMENT_GROUPS * RHW_MAX_VARYING_COMPONENTS];
    f8 ddy[RHW_FRAGMENT_GROUPS * RHW_MAX_VARYING_COMPONENTS];
    f8 outputs[RHW_FRAGMENT_GROUPS][RHW_MAX_COLOR_ATTACHMENTS][4];
};

#endif
