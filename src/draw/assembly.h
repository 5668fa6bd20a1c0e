// SPDX-License-Identifier: MIT
// From a draw's vertices or indices to points, lines and triangles: lists, strips, fans, restart.
#ifndef RHW_ASSEMBLY_H
#define RHW_ASSEMBLY_H

#include <stdbool.h>
#include <stdint.h>

struct rhw_arena;
struct rhw_draw;

// Fills triangles_per_instance (and expanded, for strips and fans with primitive restart) of a draw of
// `count` vertices or indices. False when out of memory.
bool rhw_assembly_prepare(struct rhw_draw *draw, uint32_t count, struct rhw_arena *arena);

// Vertices that such a draw, which was prepared, has for each instance: restart indices are none.
uint64_t rhw_assembly_vertices(const struct rhw_draw *draw, uint32_t count);

// Marks, of such a draw of strips, the first primitive of each.
void rhw_assembly_mark_strips(const struct rhw_draw *draw, uint32_t count, uint8_t *begins);

// Vertex indices, base vertex not included, of triangles first .. first + count − 1 of one instance: in the draw's
// index buffer where they stand there as they are needed, else in `room`.
const uint32_t (*rhw_assembly_fetch(const struct rhw_draw *draw, uint32_t first, uint32_t count,
                                    uint32_t (*room)[3]))[3];

#endif
