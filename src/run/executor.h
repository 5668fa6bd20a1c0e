// SPDX-License-Identifier: MIT
// The structure of an executor, and the memory that it keeps from pass to pass. run.h has what other rooms see.
#ifndef RHW_EXECUTOR_H
#define RHW_EXECUTOR_H

#include "base/thread.h"
#include "draw/wave.h"
#include "run.h"

// A transient keeps an attachment without a texture between waves.
struct transient {
    struct rhw_mip plane;
    size_t size; // bytes that plane.texels has
};

// These are the tiles that a worker begins with. The worker writes them, and so do others that have no tiles left of
// their own. The structure is padded so that no two workers share a cache line.
struct tile_share {
    _Alignas(RHW_CACHE_LINE) _Atomic int next;
    int end; // exclusive
};

struct rhw_executor {
    struct rhw_context *context;
    struct rhw_wave wave; // the wave under way
    int chunk_capacity;
    uint64_t chunk_size;       // most triangles of a chunk
    struct tile_share *shares; // a share for each worker
    struct transient colors[RHW_MAX_COLOR_ATTACHMENTS], depth, stencil;

    // Workers write these members for every chunk, and read them when they look for the next chunk.
    _Alignas(RHW_CACHE_LINE) _Atomic size_t geometry; // bytes that the wave's chunks took
    _Atomic int wave_end;                             // first chunk that waits for the next wave
    _Atomic bool failed;                              // a worker ran out of memory
};

// Give every worker an arena. Return false when out of memory.
bool rhw_executor_arenas_ready(struct rhw_executor *executor);
// Give the workers of so many tasks of the front end the memory that the wave's pass needs. Return false when out of
// memory.
bool rhw_executor_front_ready(struct rhw_executor *executor, int count);
// Give the workers that draw tiles the memory that the wave's pass needs, and room for the bins that a tile has of the
// wave's chunks. Return false when out of memory.
bool rhw_executor_tiles_ready(struct rhw_executor *executor);
// Give attachments without a texture memory that keeps them until the next wave. Return false when out of memory.
bool rhw_executor_transients_ready(struct rhw_executor *executor);

#endif
