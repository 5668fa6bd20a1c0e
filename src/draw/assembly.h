// SPDX-License-Identifier: MIT
// Assembly makes points, lines and triangles of a draw's vertices or indices: from lists, strips and fans, with
// restarts.
#ifndef RHW_ASSEMBLY_H
#define RHW_ASSEMBLY_H

#include <stdbool.h>
#include <stdint.h>

struct rhw_arena;
struct rhw_draw;

// Set triangles_per_instance of a draw of `count` vertices or indices. Strips and fans with primitive restart get
// `expanded` too. Return false when out of memory.
bool rhw_assembly_prepare(struct rhw_draw *draw, uint32_t count, struct rhw_arena *arena);

// Return how many vertices a prepared draw of `count` vertices or indices has for each instance. Restart indices are
// not counted.
uint64_t rhw_assembly_vertices(const struct rhw_draw *draw, uint32_t count);

// Mark in `begins` the first primitive of each strip of a prepared draw of `count` vertices or indices.
void rhw_assembly_mark_strips(const struct rhw_draw *draw, uint32_t count, uint8_t *begins);

// Return the vertex indices, without the base vertex, of triangles first .. first + count − 1 of one instance. They lie
// in the draw's index buffer if they stand there as they are needed, and in `room` if not.
const uint32_t (*rhw_assembly_fetch(const struct rhw_draw *draw, uint32_t first, uint32_t count,
                                    uint32_t (*room)[3]))[3];

#endif
