// SPDX-License-Identifier: MIT
// What a worker needs while it runs a chunk through the front end. It is allocated once per thread, with arrays that
// are sized by the largest chunk so far; the rest is sized by the limits of the API, and a draw touches only what it
// uses of it.
#ifndef RHW_GEOMETRY_SCRATCH_H
#define RHW_GEOMETRY_SCRATCH_H

#include <string.h>

#include "base/constants.h"
#include "draw/draw_list.h"
#include "draw/shared_vertices.h"
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
    // Vertices in a segment of vertices that clipping makes; see made_vertices.h.
    RHW_MADE_VERTICES = 256
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
    f32x8 *varyings; // varyings of the groups, one group behind the other, as in struct fragment_queue
    f32x8 distances[RHW_VERTEX_GROUPS][RHW_MAX_CLIP_DISTANCES + RHW_MAX_CULL_DISTANCES];
    struct rhw_cache_entry cache[RHW_VERTEX_CACHE];
    uint32_t stamp;
    // The arrays from here on stand behind the structure, and rhw_geometry_scratch_room has their lengths.
    // Vertex index by slot, of the run under way or of a shared part.
    uint32_t *unique;
    // Indices of all runs of the chunk. Each run's vertices fill up groups of 8.
    uint32_t (*indices)[3];
    struct rhw_snapped_vertex *vertices;
    // Runs, and runs for another viewport, which have the number of their segment.
    struct rhw_run *runs;
    // Segments of the runs, then segments of made vertices and of other viewports.
    struct rhw_segment *segments;
    struct rhw_polygon *polygons;
    // Tiles of the triangles that are drawn.
    struct rhw_tile_range *tile_ranges;
    // Number of triangles of `indices`, and number of vertices.
    uint32_t index_count, vertex_count;
    int run_count, polygon_count, segment_count;
    // See rhw_wave, and the worker that has this scratch.
    struct rhw_context *asked;
    int worker;
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

// Bytes from the start of the scratch to its arrays, and of all together.
struct rhw_geometry_room {
    size_t unique, indices, vertices, runs, segments, polygons, tile_ranges, size;
};

// Return where the next array begins, and move `end` behind it.
static inline size_t rhw_geometry_array(size_t *end, size_t count, size_t size)
{
    const size_t begin = *end;
    *end += (count * size + RHW_CACHE_LINE - 1) & ~(size_t)(RHW_CACHE_LINE - 1);
    return begin;
}

// Return where arrays stand that take chunks of `triangles`.
static inline struct rhw_geometry_room rhw_geometry_scratch_room(size_t triangles)
{
    // A chunk needs a segment of made vertices for every run, and another one whenever it is full. A triangle drawn as
    // lines has up to 8 vertices: three cut edges and one copied. There are segments of runs, of runs for another
    // viewport, and of vertices that are made after a change between runs, at most one of each for a primitive.
    const size_t segments = 3 * triangles + 8 * triangles / (RHW_MADE_VERTICES - 8) + 1;
    const size_t slots = 3 * triangles < RHW_SHARED_PART ? RHW_SHARED_PART : 3 * triangles;
    struct rhw_geometry_room room;
    size_t end = sizeof(struct rhw_geometry_scratch);
    room.unique = rhw_geometry_array(&end, slots + 8, sizeof(uint32_t));
    room.indices = rhw_geometry_array(&end, triangles, 3 * sizeof(uint32_t));
    room.vertices = rhw_geometry_array(&end, (3 + 7) * triangles, sizeof(struct rhw_snapped_vertex));
    room.runs = rhw_geometry_array(&end, segments, sizeof(struct rhw_run));
    room.segments = rhw_geometry_array(&end, segments, sizeof(struct rhw_segment));
    room.polygons = rhw_geometry_array(&end, triangles, sizeof(struct rhw_polygon));
    room.tile_ranges =
        rhw_geometry_array(&end, RHW_TRIANGLES_MOST * triangles, sizeof(struct rhw_tile_range));
    room.size = end;
    return room;
}

// Set what stays from frame to frame, in `room.size` bytes: the arrays, an empty table of vertices, and where groups of
// vertices have their distances.
static inline void rhw_geometry_scratch_init(struct rhw_geometry_scratch *scratch,
                                             struct rhw_geometry_room room)
{
    unsigned char *const bytes = (unsigned char *)scratch;
    memset(scratch->cache, 0, sizeof scratch->cache);
    scratch->stamp = 1;
    for (int g = 0; g < RHW_VERTEX_GROUPS; g++) {
        scratch->groups[g].clip_distance = scratch->distances[g];
        scratch->groups[g].mask = rhw_splat_int(-1);
        scratch->groups[g].cull_distance = scratch->distances[g] + RHW_MAX_CLIP_DISTANCES;
    }
    scratch->unique = (void *)(bytes + room.unique);
    scratch->indices = (void *)(bytes + room.indices);
    scratch->vertices = (void *)(bytes + room.vertices);
    scratch->runs = (void *)(bytes + room.runs);
    scratch->segments = (void *)(bytes + room.segments);
    scratch->polygons = (void *)(bytes + room.polygons);
    scratch->tile_ranges = (void *)(bytes + room.tile_ranges);
}

#endif
