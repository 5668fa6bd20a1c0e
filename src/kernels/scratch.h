// SPDX-License-Identifier: MIT
// What a worker needs while it runs a chunk or a tile: allocated once per thread, sized by the limits of the
// API, of which a draw touches only what it uses.
#ifndef RHW_SCRATCH_H
#define RHW_SCRATCH_H

#include "../constants.h"
#include "../pass_state.h"
#include "../pipeline.h"
#include "../simd_layout.h"

enum {
    // Groups of 8 vertices per call of the vertex function: enough to hide the call, few enough that their
    // attributes and varyings stay in the first cache level. At most RHW_MAX_GROUPS.
    RHW_VERTEX_GROUPS = 8,
    // Entries of the table that finds vertices again, a power of two. Direct mapped by vertex index: a miss only
    // shades a vertex twice.
    RHW_VERTEX_CACHE = 8192
};

struct rhw_cache_entry {
    uint32_t index, stamp; // see look_up_slots
};

// What culling and setup read of a vertex: the first 16 bytes of its record, next to each other.
struct rhw_corner {
    int32_t x_24_8, y_24_8;
    float depth;
    uint32_t flags;
};

// The part of a chunk that belongs to one instance of one draw, on its way to a segment.
struct rhw_run {
    const uint32_t (*corners)[3]; // in the draw's index buffer or in the scratch
    uint32_t first_slot;          // the corner whose slot is 0; the others follow
    uint32_t count, first_primitive;
    const struct rhw_corner *vertices; // by slot
};

struct rhw_front_scratch {
    _Alignas(64) struct rhw_vertex groups[RHW_VERTEX_GROUPS];
    f8 attributes[RHW_VERTEX_GROUPS][RHW_MAX_ATTRIBUTES][4];
    f8 varyings[RHW_VERTEX_GROUPS * RHW_MAX_VARYING_COMPONENTS];
    uint32_t unique[3 * RHW_CHUNK_TRIANGLES + 8]; // vertex index by slot, of the run under way
    struct rhw_cache_entry cache[RHW_VERTEX_CACHE];
    uint32_t stamp;
    // Of all runs of the chunk. Each run's vertices fill up groups of 8.
    uint32_t corners[RHW_CHUNK_TRIANGLES][3];
    struct rhw_corner vertices[(3 + 7) * RHW_CHUNK_TRIANGLES];
    struct rhw_run runs[RHW_CHUNK_TRIANGLES];
    struct rhw_segment segments[RHW_CHUNK_TRIANGLES];
    struct rhw_polygon polygons[RHW_CHUNK_TRIANGLES];
    uint32_t spans[RHW_CHUNK_TRIANGLES]; // tiles of each triangle, see span_of
    uint32_t corner_count, vertex_count;
    int run_count, polygon_count;
    struct rhw_front_counters counters;
};

static inline const struct rhw_vertex_record *record_at(const struct rhw_segment *segment, uint32_t slot)
{
    return (const struct rhw_vertex_record *)(const void *)(segment->vertices +
                                                            (size_t)slot * (size_t)segment->vertex_stride);
}

static inline int min_int(int a, int b)
{
    return a < b ? a : b;
}

static inline int max_int(int a, int b)
{
    return a > b ? a : b;
}

#endif
