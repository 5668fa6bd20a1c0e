// SPDX-License-Identifier: MIT
// This file finds where in its pattern each line of a strip begins. The place is as far on as all earlier lines of the
// strip are long together, which chunks cannot know. The vertices of the draw are therefore shaded first
// (effect_vertices.h), and the lines are measured one after the other before the first wave. The places, which are
// called phases, do not depend on the number of threads.
#ifndef RHW_STRIP_STIPPLE_H
#define RHW_STRIP_STIPPLE_H

#include <stdbool.h>
#include <stdint.h>

struct rhw_arena;
struct rhw_draw;
struct rhw_recorded_pass;

// Return true if a draw has lines of strips with a stipple.
bool rhw_strip_stipple_needed(const struct rhw_draw *draw);

// Give an assembled draw of `count` vertices or indices room for its phases, in memory that lasts as long as the draw.
// Return false when out of memory.
bool rhw_strip_stipple_prepare(struct rhw_draw *draw, uint32_t count, struct rhw_arena *arena);

// Measure the lines of all draws of a pass that have room for phases. Their vertices must have been shaded.
void rhw_strip_stipple_measure(const struct rhw_recorded_pass *pass);

#endif
