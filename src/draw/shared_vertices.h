// SPDX-License-Identifier: MIT
// Shared vertices are shaded before the chunks that use them, once for all of them. A chunk usually shades what its
// triangles name. Where triangles lie in no order, as in scans, several chunks meet most of the vertices, and
// finding them again costs as much as shading them. A draw with triangles in no order therefore has all of its vertices
// shaded first, in every wave that draws some of it. run/vertex_sharing.h chooses the draws.
#ifndef RHW_SHARED_VERTICES_H
#define RHW_SHARED_VERTICES_H

#include "draw_list.h"

// These are the vertices of one instance, by index. There is room for a multiple of 8.
struct rhw_shared_vertices {
    struct rhw_segment segment;
    struct rhw_snapped_vertex *snapped;
    uint32_t count;
    // This is the index of each vertex (run/effect_vertices.h). NULL: the indices are 0 .. count − 1.
    const uint32_t *indices;
};

enum {
    // Chunks share the vertices of an instance only if it has at least this many triangles.
    RHW_SHARING_TRIANGLES = 2048,
    // At most this many vertices are shaded as one task. It is a multiple of 8, because the lanes behind the last
    // vertex are written too and must not belong to another task.
    RHW_SHARED_PART = 2048
};

struct rhw_shared_part {
    const struct rhw_shared_vertices *shared;
    uint32_t first, count;
};

#endif
