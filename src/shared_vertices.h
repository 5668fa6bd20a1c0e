// SPDX-License-Identifier: MIT
// Vertices of a draw that are shaded before the chunks that use them, once for all of them. A chunk shades what its
// triangles name; where these lie in no order, as those of scans do, most vertices are met by several chunks, and
// finding them again costs as much as shading them. All vertices of such a draw are shaded first, in every wave that
// draws some of it.
#ifndef RHW_SHARED_VERTICES_H
#define RHW_SHARED_VERTICES_H

#include "pass.h"

struct rhw_corner;

// Those of one instance, by index; room for a multiple of 8.
struct rhw_shared_vertices {
    struct rhw_segment segment;
    struct rhw_corner *corners;
    uint32_t count; // those of the draw's indices 0 .. count − 1
    struct rhw_shared_vertices *next;
};

enum {
    RHW_SHARING_TRIANGLES = 2048, // of an instance whose vertices are shared, at least
    RHW_SHARED_PART = 2048        // vertices that are shaded as one task
};

// Finds the draws of the wave's chunks whose vertices are shared and gives them room, one for each instance: a list
// from `first` on, and their bytes. `most`: bytes of all of them together. False when out of memory.
bool rhw_shared_vertices_find(struct rhw_pass_state *pass, size_t most, struct rhw_shared_vertices **first,
                              size_t *bytes);

#endif
