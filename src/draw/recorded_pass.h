// SPDX-License-Identifier: MIT
// A recorded pass: what it draws into and its draws, as a value that knows nothing of how it was recorded or is run. There
// may be as many as one likes; a context owns one, which every pass of it uses again. The encoder (pass/encoder.h) writes
// it. Running (run/run.h) reads it, and writes what its members say.
#ifndef RHW_RECORDED_PASS_H
#define RHW_RECORDED_PASS_H

#include "base/arena.h"
#include "draw_list.h"
#include "explained.h"
#include "rhw/stats.h"
#include "target.h"

struct rhw_used_query;

struct rhw_recorded_pass {
    uint64_t begun_ns;        // when recording began
    struct rhw_target target; // the planes of stencil stand in here: it does not move while it is in use
    // The planes of stencil of textures, as a target and to resolve into.
    struct rhw_mip stencil_plane, stencil_resolve;
    enum rhw_paths paths;                 // of the context, or the general one
    struct rhw_explained explained;       // while the pass runs the sample's tile writes it
    struct rhw_tile_report *tile_reports; // of all tiles, which write them; NULL: nobody asks

    struct rhw_arena arena;         // what draws point at: states, uniforms, bindings
    struct rhw_used_query *queries; // a list, the last one first; running writes their counts
    struct rhw_draw_list draws;     // every wave sets the vertices that its draws share
    uint64_t triangle_count;
    int triangles_most;   // that tiles draw of a primitive of any draw
    bool shades_first;    // vertices of some draw, before the first wave
    bool has_large_draws; // indexed, of RHW_SHARING_TRIANGLES at least
    bool has_feedback;    // of some draw
};

// Return a pass without draws, or NULL when out of memory.
struct rhw_recorded_pass *rhw_recorded_pass_create(struct rhw_memory *memory);
// Forgets the draws and what they point at. The memory stays for the next ones.
void rhw_recorded_pass_clear(struct rhw_recorded_pass *pass);
void rhw_recorded_pass_destroy(struct rhw_memory *memory,
                               struct rhw_recorded_pass *pass); // which may be NULL

// Special paths are faster for some triangles or vertices; the general path takes all of them. Both draw the same bytes.
static inline bool rhw_pass_takes_special_paths(const struct rhw_recorded_pass *pass)
{
    return pass->paths != RHW_PATHS_GENERAL;
}

#endif
