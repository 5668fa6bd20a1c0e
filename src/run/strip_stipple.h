// SPDX-License-Identifier: MIT
// Where in its pattern each line of a strip begins: as far on as the lines before it in its strip are long, which chunks
// cannot know. So the vertices of such a draw are shaded first (effect_vertices.h), and the lines are measured one after
// the other before the first wave: the phases are the same for any number of threads.
#ifndef RHW_STRIP_STIPPLE_H
#define RHW_STRIP_STIPPLE_H

#include <stdbool.h>
#include <stdint.h>

struct rhw_arena;
struct rhw_draw;
struct rhw_recorded_pass;

// Whether a draw needs this.
bool rhw_strip_stipple_needed(const struct rhw_draw *draw);

// Gives a draw of `count` vertices or indices, which was assembled, room for its phases, in memory that lasts as long as
// it. False when out of memory.
bool rhw_strip_stipple_prepare(struct rhw_draw *draw, uint32_t count, struct rhw_arena *arena);

// Measures the lines of all such draws of a pass, whose vertices are shaded.
void rhw_strip_stipple_measure(const struct rhw_recorded_pass *pass);

#endif
