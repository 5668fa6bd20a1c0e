// SPDX-License-Identifier: MIT
// Vertices of a draw that are shaded before the chunks that use them, once for all of them. A chunk shades what its
// triangles name; where these lie in no order, as those of scans do, most vertices are met by several chunks, and
// finding them again costs as much as shading them. All vertices of such a draw are shaded first, in every wave that
// draws some of it. run/vertex_sharing.h chooses the draws.
#ifndef RHW_SHARED_VERTICES_H
#define RHW_SHARED_VERTICES_H

#include "draw_list.h"

// Those of one instance, by index; room for a multiple of 8.
struct rhw_shared_vertices {
    struct rhw_segment segment;
    struct rhw_snapped_vertex *snapped;
    uint32_t count;          // those of the draw's indices 0 .. count − 1
    const uint32_t *indices; // or of these (run/effect_vertices.h); NULL: as said
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

#endif
