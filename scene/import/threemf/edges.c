// SPDX-License-Identifier: MIT
// The edges that paintings cut in half. A triangle beside a cut one is cut there, too, as a corner in the middle of an
// edge leaves gaps: rounding moves it off the edge.
#include "threemf.h"

#include <stdlib.h>
#include <string.h>

// The two ends of an edge, in an order that does not depend on the triangle.
struct scene_3mf_edge {
    float ends[2][3];
    bool used;
};

static struct scene_3mf_edge make_edge(const float a[3], const float b[3])
{
    struct scene_3mf_edge edge = {.used = true};
    for (int c = 0; c < 3; c++) { // a sum with 0 makes −0 a 0
        edge.ends[0][c] = a[c] + 0.0f;
        edge.ends[1][c] = b[c] + 0.0f;
    }
    if (memcmp(edge.ends[0], edge.ends[1], sizeof edge.ends[0]) > 0) {
        float first[3];
        memcpy(first, edge.ends[0], sizeof first);
        memcpy(edge.ends[0], edge.ends[1], sizeof first);
        memcpy(edge.ends[1], first, sizeof first);
    }
    return edge;
}

// Return the place of an edge, or the free place where it belongs.
static struct scene_3mf_edge *find_place(const struct scene_3mf_edges *edges,
                                         const struct scene_3mf_edge *edge)
{
    unsigned char bytes[sizeof edge->ends];
    uint64_t hash = 14695981039346656037u; // FNV-1a
    memcpy(bytes, edge->ends, sizeof bytes);
    for (size_t i = 0; i < sizeof bytes; i++) {
        hash = (hash ^ bytes[i]) * 1099511628211u;
    }
    for (size_t at = (size_t)(hash ^ hash >> 32) & (edges->capacity - 1);;
         at = (at + 1) & (edges->capacity - 1)) {
        struct scene_3mf_edge *place = &edges->items[at];
        if (!place->used || memcmp(place->ends, edge->ends, sizeof edge->ends) == 0) {
            return place;
        }
    }
}

static void grow(struct scene_3mf *file)
{
    const struct scene_3mf_edges old = file->edges;
    file->edges.capacity = old.capacity == 0 ? 64 : 2 * old.capacity; // a power of two
    file->edges.items = scene_import_allocate(file->import, file->edges.capacity, sizeof *file->edges.items);
    for (size_t i = 0; i < old.capacity; i++) {
        if (old.items[i].used) {
            *find_place(&file->edges, &old.items[i]) = old.items[i];
        }
    }
    free(old.items);
}

void scene_3mf_add_edge(struct scene_3mf *file, const float a[3], const float b[3])
{
    if (2 * file->edges.count >= file->edges.capacity) {
        grow(file);
    }
    const struct scene_3mf_edge edge = make_edge(a, b);
    struct scene_3mf_edge *place = find_place(&file->edges, &edge);
    file->edges.count += !place->used;
    *place = edge;
}

bool scene_3mf_has_edge(const struct scene_3mf *file, const float a[3], const float b[3])
{
    const struct scene_3mf_edge edge = make_edge(a, b);
    return file->edges.count > 0 && find_place(&file->edges, &edge)->used;
}

void scene_3mf_clear_edges(struct scene_3mf *file)
{
    free(file->edges.items);
    file->edges = (struct scene_3mf_edges){0};
}
