// SPDX-License-Identifier: MIT
// Vertices of a draw that are shaded before the chunks that use them, once for all of them. A chunk shades what its
// triangles name; where these lie in no order, as those of scans do, most vertices are met by several chunks, and
// finding them again costs as much as shading them. All vertices of such a draw are shaded first, in every wave that
// draws some of it.
#ifndef RHW_SHARED_VERTICES_H
#define RHW_SHARED_VERTICES_H

#include "draw/draw_list.h"

struct rhw_pass_state;

// Those of one instance, by index; room for a multiple of 8.
struct rhw_shared_vertices {
    struct rhw_segment segment;
    struct rhw_snapped_vertex *snapped;
    uint32_t count;          // those of the draw's indices 0 .. count − 1
    const uint32_t *indices; // or of these (effect_vertices.h); NULL: as said
};

enum {
    RHW_SHARING_TRIANGLES = 2048, // of an instance whose vertices are shared, at least
    // Vertices that are shaded as one task, at most. Whole groups: the lanes behind the last vertex are written too,
    // and must not be another task's.
    RHW_SHARED_PART = 2048
};

struct rhw_shared_part {
    const struct rhw_shared_vertices *shared;
    uint32_t first, count;
};

// All that a wave shares.
struct rhw_shared_parts {
    struct rhw_shared_part *parts;
    int count;
    uint64_t vertices;
    size_t bytes;
};

// Parts of so many vertices, at least one.
uint32_t rhw_shared_parts_of(uint32_t count);
// Lists those of all instances of a draw, and gives the end of the list.
struct rhw_shared_part *rhw_shared_parts_list(struct rhw_shared_part *part, const struct rhw_draw *draw);

// Finds the draws of the wave's chunks whose vertices are shared, which is where the vertices from base_vertex to the
// end of the buffers are few beside the triangles, and these in no order; and gives them room, of `most` bytes
// together. False when out of memory.
bool rhw_shared_vertices_find(struct rhw_pass_state *pass, size_t most, struct rhw_shared_parts *wave);

#endif
