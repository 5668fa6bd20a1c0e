// SPDX-License-Identifier: MIT
// A wave is the part of a running pass that kernels see at once: chunks that go through the front end together and are
// drawn together, and the memory of the threads that run them. run/run.c makes waves.
#ifndef RHW_WAVE_H
#define RHW_WAVE_H

#include "recorded_pass.h"

struct rhw_context;
struct rhw_geometry_scratch;
struct rhw_tile_scratch;
struct rhw_sample_tile;

struct rhw_counters {
    uint64_t fragments, groups;
    uint64_t vertex_ns, setup_ns, bin_ns; // time of each part of the front end, as rhw_stats names them
};

// The texels of a tile of one attachment, in the largest format.
typedef unsigned char rhw_tile_colors[RHW_TILE * RHW_TILE * 16];

// A worker is what a thread needs to run kernels. The thread alone writes it, and no two threads share a cache line.
struct rhw_worker {
    // The front end makes its results here. The arena is reset when they have been drawn.
    _Alignas(RHW_CACHE_LINE) struct rhw_arena arena;
    struct rhw_counters counters;
    struct rhw_geometry_scratch *geometry;
    size_t triangle_room; // triangles of a chunk that `geometry` has room for
    struct rhw_tile_scratch *tile;
    struct rhw_sample_tile *sample_tiles; // tiles of all samples but the first, as many as any pass has needed
    int sample_tile_count;
    // Varyings of the groups of 8 vertices and 8 fragments that shader functions take at once, and derivatives of the
    // latter: of as many components as draws of passes have had.
    void *varyings;
    int component_room;
    // The colours of all samples of the tile: as many attachments of as many samples as passes have had.
    rhw_tile_colors *colors;
    int color_count;
};

struct rhw_wave {
    struct rhw_recorded_pass *pass;
    struct rhw_context *asked; // its program decides whether the pass goes on; NULL: nobody is asked
    // This is the target of the pass. From the second wave on, attachments that exist in tiles alone have memory here.
    struct rhw_target target;
    // The first wave of the pass has the load operations, and the last wave has the store operations.
    bool is_first, is_last;
    struct rhw_chunk *chunks;
    int chunk_count;
    uint32_t entries_most;      // most entries in the bins of a chunk; at least one for each tile
    struct rhw_worker *workers; // a worker for each thread
};

#endif
