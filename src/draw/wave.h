// SPDX-License-Identifier: MIT
// A wave of a pass that runs, as kernels see it: the chunks that go through the front end together and are drawn
// together, and the memory of the threads that do it. run/run.c makes waves.
#ifndef RHW_WAVE_H
#define RHW_WAVE_H

#include "recorded_pass.h"

struct rhw_geometry_scratch;
struct rhw_tile_scratch;
struct rhw_sample_tile;

struct rhw_counters {
    uint64_t fragments, groups;
    uint64_t vertex_ns, setup_ns, bin_ns; // parts of the front end, as rhw_stats names them
};

// What a thread needs to run kernels. The thread alone writes it, and no two threads share a cache line.
struct rhw_worker {
    _Alignas(RHW_CACHE_LINE) struct rhw_arena arena; // what the front end made; reset when it was drawn
    struct rhw_counters counters;
    struct rhw_geometry_scratch *geometry;
    struct rhw_tile_scratch *tile;
    struct rhw_sample_tile *sample_tiles; // tiles of all samples but the first, as many as passes had yet
    int sample_tile_count;
};

struct rhw_wave {
    struct rhw_recorded_pass *pass;
    // The target of the pass. From the second wave on what exists in the tile alone has memory here.
    struct rhw_target target;
    bool is_first, is_last; // in the pass: load and store operations belong to these
    struct rhw_chunk *chunks;
    int chunk_count;
    uint32_t entries_most;      // entries in the bins of a chunk; at least one for each tile
    struct rhw_worker *workers; // one per thread
};

#endif
