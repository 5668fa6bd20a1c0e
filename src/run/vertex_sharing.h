// SPDX-License-Identifier: MIT
// Which draws of a wave share their vertices (draw/shared_vertices.h), and room for these.
#ifndef RHW_VERTEX_SHARING_H
#define RHW_VERTEX_SHARING_H

#include "draw/shared_vertices.h"

struct rhw_wave;

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
// together. `chunk_size`: triangles of a chunk, at most. False when out of memory.
bool rhw_shared_vertices_find(const struct rhw_wave *wave, uint64_t chunk_size, size_t most,
                              struct rhw_shared_parts *parts);

#endif
