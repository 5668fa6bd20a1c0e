// SPDX-License-Identifier: MIT
// A recorded pass is what it draws into and its draws, as a value that knows nothing of how it was recorded or is run.
// There may be as many as one likes. A context owns one, which each of its passes uses again. The encoder
// (pass/encoder.h) writes it. Running (run/run.h) reads it, and writes what its members say.
#ifndef RHW_RECORDED_PASS_H
#define RHW_RECORDED_PASS_H

#include "base/arena.h"
#include "draw_list.h"
#include "explained.h"
#include "rhw/stats.h"
#include "target.h"

struct rhw_kept_triangles;
struct rhw_used_query;

struct rhw_recorded_pass {
    uint64_t begun_ns; // time at which recording began
    struct rhw_target target;
    // These are the stencil aspects of the textures that the pass draws into and resolves into. The target points at
    // them, so a pass does not move.
    struct rhw_mip stencil_aspect, stencil_resolve;
    enum rhw_paths paths;           // paths of the context, or the general one
    struct rhw_explained explained; // written by the sample's tile while the pass runs
    // There is a report for each tile, which writes it. NULL: nobody asks.
    struct rhw_tile_report *tile_reports;

    struct rhw_arena arena;          // memory of states, uniforms and bindings that draws point at
    struct rhw_used_query *queries;  // a list, the last query first; running writes their counts
    struct rhw_draw_list draws;      // each wave sets the vertices that its draws share
    struct rhw_kept_triangles *kept; // run/kept_triangles.h; NULL: each run makes its triangles
    uint64_t triangle_count;
    int triangles_most;   // most triangles that tiles draw for a primitive of any draw
    int components_most;  // most components that varyings have together in any draw
    bool shades_first;    // some draw has vertices that are shaded before the first wave
    bool has_large_draws; // some indexed draw has at least RHW_SHARING_TRIANGLES
    bool has_feedback;    // some draw writes to buffers
    bool shades_samples;  // some draw is shaded at every sample of a pixel
    bool shows_order;     // the order of calls would show in what some draw writes
};

// Return a pass without draws, or NULL when out of memory.
struct rhw_recorded_pass *rhw_recorded_pass_create(struct rhw_memory *memory);
// Forget the draws and what they point at. The memory stays for the next ones.
void rhw_recorded_pass_clear(struct rhw_recorded_pass *pass);
// Release a pass. Do nothing where it is NULL.
void rhw_recorded_pass_destroy(struct rhw_memory *memory, struct rhw_recorded_pass *pass);

// Return true if special paths are taken. They are faster for some triangles or vertices; the general path takes all of
// them. Both draw the same bytes.
static inline bool rhw_pass_takes_special_paths(const struct rhw_recorded_pass *pass)
{
    return pass->paths != RHW_PATHS_GENERAL;
}

#endif
