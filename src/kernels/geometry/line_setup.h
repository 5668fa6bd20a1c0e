// SPDX-License-Identifier: MIT
// The way from vertex indices to lines, 8 of a run at a time. Lines that cannot be seen are left out, and lines that a
// plane cuts become what is left of them.
#ifndef RHW_LINE_SETUP_H
#define RHW_LINE_SETUP_H

#include "draw/draw_list.h"
#include "clipped_line.h"
#include "line_rectangle.h"

// Return the bits of the lines of 8 that may be seen, and count the others. Lines that a plane cuts become what is left
// of them.
static unsigned seen_lines8(struct rhw_geometry_scratch *scratch, uint32_t run, struct lines8 *l,
                            i32x8 flags_any, i32x8 flags_all, unsigned live)
{
    const unsigned lost = live & flagged8(flags_any, RHW_VERTEX_NOT_FINITE);
    const unsigned outside = live & ~lost & flagged8(flags_all, RHW_VERTEX_OUTSIDE);
    unsigned seen = live & ~lost & ~outside;
    for (unsigned left = seen & flagged8(flags_any, RHW_VERTEX_CLIP); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        if (!clip_line_lane(scratch, run, l, lane)) {
            seen &= ~(1u << lane);
            scratch->counters.culled++;
        } else {
            scratch->counters.clipped++;
        }
    }
    scratch->counters.dropped += (unsigned)__builtin_popcount(lost);
    scratch->counters.culled += (unsigned)__builtin_popcount(outside);
    return seen;
}

// Return where in their pattern the lines begin.
static __attribute__((noinline)) i32x8 phases_of_slice(const struct rhw_segment *segment,
                                                       const struct run_slice *slice)
{
    const struct rhw_draw *const draw = segment->draw;
    i32x8 phase = i32x8_splat(0);
    for (unsigned left = draw->strip_stipple ? slice->live : 0; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        const size_t first = (size_t)segment->instance * draw->triangles_per_instance;
        phase[lane] = draw->strip_stipple->phases[first + slice->first_primitive + (unsigned)lane];
    }
    return phase;
}

// Set up 8 lines of a run.
static __attribute__((noinline)) void setup_lines8(struct rhw_geometry_scratch *scratch,
                                                   const struct run_slice *slice,
                                                   struct rhw_triangle_list *list)
{
    const struct rhw_run *const run = &scratch->runs[slice->run];
    const struct rhw_draw_state *const state = scratch->segments[slice->run].draw->state;
    const struct triangle8 t = load_triangle8(run->vertices, run->first_slot, slice->indices);
    const struct triangle_names8 names = names_of_slice(slice, run->first_slot);
    struct lines8 lines = {.x = {t.x[0], t.x[1]},
                           .y = {t.y[0], t.y[1]},
                           .flags = clamp_flags8(state, t.depth_min, t.depth_max),
                           .vertex = {names.vertex[0], names.vertex[1]},
                           .primitive = names.primitive,
                           .segment = names.segment};
    if (state->stipple.factor != 0) {
        lines.flags |= i32x8_splat(RHW_TRIANGLE_STIPPLE);
        lines.phase = phases_of_slice(&scratch->segments[slice->run], slice);
    }
    const unsigned seen = seen_lines8(scratch, slice->run, &lines, t.flags_any, t.flags_all, slice->live);
    const unsigned drawn = seen == 0 ? 0 : add_lines8(scratch, state, &lines, seen, list);
    scratch->counters.culled += (unsigned)__builtin_popcount(seen & ~drawn);
    scratch->counters.rasterized += (unsigned)__builtin_popcount(drawn);
}

#endif
