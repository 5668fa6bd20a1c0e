// SPDX-License-Identifier: MIT
// This file prepares vertices that are shaded once in their pass, before its first wave, however many chunks and waves
// there are. A vertex is one of them where its function has effects, or where it belongs to a strip with a stipple
// (strip_stipple.h). Its draw shares its vertices (draw/shared_vertices.h) for the whole pass. Only vertices that the
// draw's primitives name are shared, in the order in which the primitives name them.
#ifndef RHW_EFFECT_VERTICES_H
#define RHW_EFFECT_VERTICES_H

#include <stdbool.h>

struct rhw_arena;
struct rhw_draw;
struct rhw_recorded_pass;
struct rhw_shared_parts;

// Give an assembled draw room for its vertices, in memory that lasts as long as the draw, and primitives that name the
// vertices by slot. Return false when out of memory.
bool rhw_effect_vertices_prepare(struct rhw_draw *draw, struct rhw_arena *arena);

// List the parts of the pass's vertices that are shaded before its first wave, in memory of `arena`. Return false when
// out of memory.
bool rhw_effect_vertices_find(const struct rhw_recorded_pass *pass, struct rhw_arena *arena,
                              struct rhw_shared_parts *parts);

#endif
