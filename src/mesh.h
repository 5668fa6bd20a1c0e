// SPDX-License-Identifier: MIT
// Vertices of a draw that are shaded before the chunks that use them. A chunk shades what its triangles name; where
// these lie in no order, as those of scans do, most vertices are met by several chunks, and finding them again costs as
// much as shading them. All vertices of such a draw are shaded once, in every wave that draws some of it.
#ifndef RHW_MESH_H
#define RHW_MESH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rhw_corner;
struct rhw_draw;
struct rhw_pass_state;

// The vertices of one instance.
struct rhw_mesh {
    const struct rhw_draw *draw;
    uint32_t instance;
    uint32_t count;             // vertices; those of the draw's indices 0 .. count − 1
    int stride;                 // floats of a record
    float *records;             // rhw_vertex_record by index; room for a multiple of 8
    struct rhw_corner *corners; // likewise
    struct rhw_mesh *next;
};

enum {
    RHW_MESH_TRIANGLES = 2048, // of an instance, at least
    RHW_MESH_PART = 2048       // vertices that are shaded as one task
};

// Gives the draws of the wave's chunks their meshes, one for each instance, without the vertices: the first of a list in
// `first`, and their bytes. `most`: bytes of all of them together. False when out of memory.
bool rhw_meshes_find(struct rhw_pass_state *pass, size_t most, struct rhw_mesh **first, size_t *bytes);

#endif
