// SPDX-License-Identifier: MIT
// What a worker needs while it runs a chunk through the front end. It is allocated once per thread, sized by the limits
// of the API; a draw touches only what it uses of it.
#ifndef RHW_GEOMETRY_SCRATCH_H
#define RHW_GEOMETRY_SCRATCH_H

#include "base/constants.h"
#include "draw/draw_list.h"
#include "base/simd.h"
#include "tile_range.h"

enum {
    // Groups of 8 vertices per call of the vertex function: enough to hide the call, few enough that their attributes
    // and varyings stay in the first cache level. At most RHW_MAX_GROUPS.
    RHW_VERTEX_GROUPS = 8,
    // Triangles of an instance, at most, for its run to go on through the next instances. Larger instances fill groups
    // of 8 vertices and 8 triangles by themselves.
    RHW_SMALL_INSTANCE = 64,
    // Entries of the table that finds vertices again, a power of two. The table is direct mapped by vertex index: a
    // miss only shades a vertex twice.
    RHW_VERTEX_CACHE = 8192,
    // Triangles that a primitive may become, at most: three lines of two triangles each. RHW_CHUNK_TRIANGLES times this
    // is below 2^16, the numbers that bins hold.
    RHW_TRIANGLES_MOST = 6,
    // Vertices in a segment of vertices that clipping makes; see made_vertices.h. A chunk needs a segment for every
    // run, and another one whenever it is full. A triangle drawn as lines has up to 8 vertices: three cut edges and one
    // copied.
    RHW_MADE_VERTICES = 256,
    RHW_MADE_MOST = 8 * RHW_CHUNK_TRIANGLES / (RHW_MADE_VERTICES - 8) + 1,
    // Segments of runs, of runs for another viewport, and of vertices that are made after a change between runs. There
    // is at most one of each for a primitive.
    RHW_SEGMENTS_MOST = 3 * RHW_CHUNK_TRIANGLES + RHW_MADE_MOST
};

struct rhw_cache_entry {
    uint32_t index, stamp; // see look_up_slots
};

// The part of a chunk that becomes a segment.
struct rhw_run {
    // Indices of each triangle's vertices: in the draw's index buffer or in the scratch.
    const uint32_t (*indices)[3];
    // The vertex index whose slot is 0. The other slots follow in order.
    uint32_t first_slot;
    uint32_t count, first_primitive;
    const struct rhw_snapped_vertex *vertices; // snapped vertices by slot
};

// The triangles that a chunk draws. There is room for all that it has.
struct rhw_triangle_list {
    struct rhw_triangle *triangles;
    struct rhw_tile_range *ranges; // tiles of each triangle
    int count;
    const struct rhw_segment *segments; // segments that the triangles belong to
    const struct rhw_polygon *polygons; // polygons of clipped triangles
};

struct rhw_geometry_scratch {
    _Alignas(64) struct rhw_vertex groups[RHW_VERTEX_GROUPS];
    f32x8 attributes[RHW_VERTEX_GROUPS][RHW_MAX_ATTRIBUTES][4];
    f32x8 varyings[RHW_VERTEX_GROUPS * RHW_MAX_VARYING_COMPONENTS];
    f32x8 distances[RHW_VERTEX_GROUPS][RHW_MAX_CLIP_DISTANCES + RHW_MAX_CULL_DISTANCES];
    // Vertex index by slot, of the run under way.
    uint32_t unique[3 * RHW_CHUNK_TRIANGLES + 8];
    struct rhw_cache_entry cache[RHW_VERTEX_CACHE];
    uint32_t stamp;
    // Indices of all runs of the chunk. Each run's vertices fill up groups of 8.
    uint32_t indices[RHW_CHUNK_TRIANGLES][3];
    struct rhw_snapped_vertex vertices[(3 + 7) * RHW_CHUNK_TRIANGLES];
    // Runs, and runs for another viewport, which have the number of their segment.
    struct rhw_run runs[RHW_SEGMENTS_MOST];
    // Segments of the runs, then segments of made vertices and of other viewports.
    struct rhw_segment segments[RHW_SEGMENTS_MOST];
    struct rhw_polygon polygons[RHW_CHUNK_TRIANGLES];
    // Tiles of the triangles that are drawn.
    struct rhw_tile_range tile_ranges[RHW_TRIANGLES_MOST * RHW_CHUNK_TRIANGLES];
    // Number of triangles of `indices`, and number of vertices.
    uint32_t index_count, vertex_count;
    int run_count, polygon_count, segment_count;
    bool special_paths; // see rhw_pass_takes_special_paths
    // See cull_uncovered.h. NULL: nothing is culled there.
    const struct rhw_sample_pattern *uncovered_pattern;
    // Made vertices stand in the last segment, which has `made_count` of them, of run `made_run`; see made_vertices.h.
    struct rhw_arena *arena;
    uint32_t made_run, made_count;
    bool out_of_memory;
    int layers; // number of layers of the pass
    struct rhw_front_counters counters;
};

#endif
