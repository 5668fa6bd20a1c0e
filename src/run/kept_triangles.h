// SPDX-License-Identifier: MIT
// What the front end made of a pass, kept for the next run of it: the chunks of its only wave, with their triangles and
// bins. A pass of several waves keeps nothing, nor does one whose vertex functions write.
#ifndef RHW_KEPT_TRIANGLES_H
#define RHW_KEPT_TRIANGLES_H

#include "base/arena.h"
#include "draw/wave.h"

struct rhw_kept_triangles {
    struct rhw_memory *memory;
    int threads;
    bool is_made;             // the chunks are those of the last run that made them
    bool is_used;             // the run under way draws them
    struct rhw_chunk *chunks; // in the first arena
    int chunk_count;
    struct rhw_chunk *borrowed; // what the wave had in place of the chunks, while it has these
    struct rhw_arena arenas[];  // an arena for each worker, which takes the place of its own
};

// Return a room for triangles of passes that run on so many threads, or NULL when out of memory.
struct rhw_kept_triangles *rhw_kept_triangles_create(struct rhw_memory *memory, int threads);
// Release it. Do nothing where it is NULL.
void rhw_kept_triangles_destroy(struct rhw_kept_triangles *kept);

// Begin a run of a pass, in the first wave: give it the chunks that were kept or, where there are none, the arenas.
void rhw_kept_triangles_begin(struct rhw_kept_triangles *kept, struct rhw_wave *wave);
// End the run. Where it made triangles, `keeps` says whether all of them are in the wave, which then stay.
void rhw_kept_triangles_end(struct rhw_kept_triangles *kept, struct rhw_wave *wave, bool keeps);

#endif
