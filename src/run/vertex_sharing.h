// SPDX-License-Identifier: MIT
// This file finds the draws of a wave that share their vertices (draw/shared_vertices.h), and makes room for them.
#ifndef RHW_VERTEX_SHARING_H
#define RHW_VERTEX_SHARING_H

#include "draw/shared_vertices.h"

struct rhw_wave;

// These are all parts of shared vertices that a wave has.
struct rhw_shared_parts {
    struct rhw_shared_part *parts;
    int count;
    uint64_t vertices;
    size_t bytes;
};

// Return how many parts `count` vertices have. `count` is at least 1.
uint32_t rhw_shared_parts_of(uint32_t count);
// List the parts of all instances of a draw from `part` on, and return the end of the list.
struct rhw_shared_part *rhw_shared_parts_list(struct rhw_shared_part *part, const struct rhw_draw *draw);

// Find the draws of the wave's chunks that share their vertices, and give them room of at most `most` bytes together. A
// draw shares them where the vertices from base_vertex to the end of the buffers are few in comparison with the
// triangles, and where the triangles are in no order. A chunk has at most `chunk_size` triangles. Return false when out
// of memory.
bool rhw_shared_vertices_find(const struct rhw_wave *wave, uint64_t chunk_size, size_t most,
                              struct rhw_shared_parts *parts);

#endif
