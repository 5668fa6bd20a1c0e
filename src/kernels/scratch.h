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
    RHW_VERTEX_CACHE = 8192,
    // Groups of 8 fragments per call of the fragment function: two whole blocks; enough to hide the call, few enough
    // that their varyings stay in the first cache level.
    RHW_FRAGMENT_GROUPS = RHW_MAX_GROUPS,
    // Triangles of a tile whose visibility is remembered from the first phase to the second: 4 KiB of bits. A longer
    // run is drawn as submitted.
    RHW_DEFERRED_TRIANGLES = 32768,
    // Triangles whose fragments may wait for a group at the same time: 7 that wait, and the one that adds to them.
    RHW_PACKED_TRIANGLES = 8,
    // Fragments of one triangle that are collected before groups are made of them: those of two blocks.
    RHW_LOOSE_FRAGMENTS = 128
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

// Where the 8 fragments of each group stand. A texel of the tile has the number y·RHW_TILE + x. place_rows always
// writes 8 entries, so there is room for 8 from the last group on.
struct rhw_group_places {
    int32_t at[RHW_FRAGMENT_GROUPS + RHW_BLOCK];   // of 8 in a row: the first
    uint8_t bits[RHW_FRAGMENT_GROUPS + RHW_BLOCK]; // live lanes
    bool packed[RHW_FRAGMENT_GROUPS + RHW_BLOCK];  // from anywhere: `lanes_at` tells where
};

// Numerators of the derivatives of two quantities, see planes_slopes: of one by x and by y, of the other by x and by y.
struct rhw_slopes {
    d4 at, step; // at the anchor's centre; change per pixel down, to the right, down, to the right
};

// What is kept of a triangle until its last fragment has found a group.
struct rhw_packed_triangle {
    struct rhw_slopes slopes[RHW_MAX_VARYING_COMPONENTS / 2]; // see component_slopes
    const float *varyings[3];
    int anchor_x, anchor_y; // pixels, in the tile
    int32_t front_facing, primitive, instance, draw;
};

// The triangles that a chunk has for a tile: chunk->entries[first] .. chunk->entries[end − 1].
struct rhw_bin {
    const struct rhw_chunk *chunk;
    uint32_t first, end;
};

struct rhw_tile_scratch {
    _Alignas(64) unsigned char color[RHW_MAX_COLOR_ATTACHMENTS][RHW_TILE * RHW_TILE * 16];
    float depth[RHW_TILE * RHW_TILE];
    float hiz[RHW_TILE / RHW_BLOCK * (RHW_TILE / RHW_BLOCK)]; // by block: see hiz_tmpl.h
    uint64_t open[RHW_TILE];                                  // by row, a bit per pixel: see depth_tmpl.h
    // Bit i: triangle i of the run under way is drawn in the second phase.
    uint8_t seen[RHW_DEFERRED_TRIANGLES / 8];
    struct rhw_bin bins[RHW_WAVE_CHUNKS]; // of the tile, those that are not empty
    // The window, see window_tmpl.h.
    struct rhw_fragment groups[RHW_FRAGMENT_GROUPS];
    struct rhw_group_places places;
    int32_t lanes_at[RHW_FRAGMENT_GROUPS][8];
    // Texels of the triangle's fragments that are not in the window yet, and room for a vector that begins there.
    int32_t loose_at[RHW_LOOSE_FRAGMENTS + 8];
    uint8_t set_lanes[256][8]; // by bits: which are set, in order; behind them lanes of any number
    struct rhw_packed_triangle packed[RHW_PACKED_TRIANGLES];
    // Fragments that wait for a group: texel, triangle, and the four quantities.
    int32_t waiting_at[8];
    uint64_t waiting[RHW_TILE]; // by row, a bit per pixel: those that wait
    const struct rhw_packed_triangle *waiting_triangle[8];
    d4 waiting_value[8];
    // Pixels from the anchor, as struct rhw_slopes has them: down, to the right, down, to the right.
    d4 waiting_step[8];
    f8 varyings[RHW_FRAGMENT_GROUPS * RHW_MAX_VARYING_COMPONENTS];
    f8 ddx[RHW_FRAGMENT_GROUPS * RHW_MAX_VARYING_COMPONENTS];
    f8 ddy[RHW_FRAGMENT_GROUPS * RHW_MAX_VARYING_COMPONENTS];
    f8 outputs[RHW_FRAGMENT_GROUPS][RHW_MAX_COLOR_ATTACHMENTS][4];
    i8 constant[RHW_MAX_COLOR_ATTACHMENTS]; // see constant_tmpl.h: 8 texels of RGBA8 targets that are replaced
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
