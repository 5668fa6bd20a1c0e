// SPDX-License-Identifier: MIT
// Vertices whose function has effects, or of strips with a stipple (strip_stipple.h): each is shaded once in its pass,
// before its first wave, whatever chunks and waves there are. They are
// shared (draw/shared_vertices.h) for the whole pass, those alone that the draw's primitives name, in the order in which
// these name them.
#ifndef RHW_EFFECT_VERTICES_H
#define RHW_EFFECT_VERTICES_H

#include <stdbool.h>

struct rhw_arena;
struct rhw_draw;
struct rhw_recorded_pass;
struct rhw_shared_parts;

// Gives a draw that was assembled room for its vertices, in memory that lasts as long as it, and primitives that name
// them by slot. False when out of memory.
bool rhw_effect_vertices_prepare(struct rhw_draw *draw, struct rhw_arena *arena);

// Lists what the pass has of them, to be shaded before its first wave, in memory of `arena`. False when out of memory.
bool rhw_effect_vertices_find(const struct rhw_recorded_pass *pass, struct rhw_arena *arena,
                              struct rhw_shared_parts *parts);

#endif
