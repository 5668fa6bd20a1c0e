// SPDX-License-Identifier: MIT
// What pipeline statistics say of clipping: the primitives of a run that are not outside one side of the view volume as
// a whole. A second look at the primitives counts them, so that runs of which nothing is asked stay as they are.
#ifndef RHW_CLIPPING_COUNT_H
#define RHW_CLIPPING_COUNT_H

#include "draw/wave.h"
#include "draw/used_query.h"
#include "geometry_scratch.h"
#include "triangle8.h"

// Return the primitives of a run that clipping leaves. All three vertices of a point are its own; a line has one of
// them twice.
static uint64_t count_clipping(const struct rhw_run *run)
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < run->count; i += 8) {
        const uint32_t left = run->count - i;
        uint32_t indices[9][3];
        for (uint32_t lane = 0; lane < 9; lane++) {
            memcpy(indices[lane], run->indices[i + (lane < left ? lane : left - 1)], sizeof *indices);
        }
        const struct triangle8 t =
            load_triangle8(run->vertices, run->first_slot, (const uint32_t(*)[3])indices);
        const unsigned lost =
            flagged8(t.flags_any, RHW_VERTEX_NOT_FINITE) | flagged8(t.flags_all, RHW_VERTEX_OUTSIDE);
        const unsigned live = left < 8 ? 0xffu >> (8 - left) : 0xff;
        count += (uint64_t)__builtin_popcount(live & ~lost);
    }
    return count;
}

// Count the chunk's runs that queries ask about. Return false when out of memory.
static __attribute__((noinline)) bool count_runs(struct rhw_chunk *chunk, struct rhw_worker *worker)
{
    const struct rhw_geometry_scratch *const scratch = worker->geometry;
    const size_t most = (size_t)scratch->run_count * sizeof *chunk->counted;
    struct rhw_counted_run *const counted = rhw_arena_alloc(&worker->arena, most, RHW_CACHE_LINE);
    chunk->counted = counted;
    chunk->counted_count = 0;
    if (!counted) {
        return false;
    }
    for (int i = 0; i < scratch->run_count; i++) {
        const struct rhw_active_queries *const queries = scratch->segments[i].draw->state->queries;
        if (queries && queries->of[RHW_QUERY_STATISTICS]) {
            counted[chunk->counted_count++] =
                (struct rhw_counted_run){queries, count_clipping(&scratch->runs[i])};
        }
    }
    return true;
}

#endif
