// SPDX-License-Identifier: MIT
// Conservative coverage: the pixels whose square a triangle touches, or contains (VK_EXT_conservative_rasterization).
//
// Over a square an edge function is most, or least, at a corner: it differs from its value at the centre by |a|/2 +
// |b|/2, for a change of a and b per pixel. A triangle touches a square unless one of its edges, or one of the sides of
// the rectangle around it, stands between them. The rectangle is the one that struct rhw_triangle has. A triangle
// contains a square if all edges have it on their inner side. Borders belong to both.
#ifndef RHW_CONSERVATIVE_H
#define RHW_CONSERVATIVE_H

#include "coverage.h"

// The edges of a triangle, or of a clipped triangle's polygon, in groups of three. Edges that do not cross the tile are
// left out.
struct conservative_edges {
    int count;
    struct triangle_edges groups[(RHW_POLYGON_VERTICES + 2) / 3];
};

// Add the edge from one corner to the next. Return false if no pixel of the tile is on its inner side.
static bool add_conservative_edge(struct conservative_edges *edges, struct edge edge, int64_t e,
                                  int64_t reach)
{
    const int blocks = (RHW_TILE - 1) / (RHW_BLOCK - 1);
    edge.q =
        (e + reach * (((int64_t)max_int(edge.a, -edge.a) + max_int(edge.b, -edge.b)) * (RHW_SUBPIXEL / 2))) >>
        RHW_SUBPIXEL_BITS;
    if (edge.q + edge.high * blocks < 0) {
        return false;
    }
    if (edge.q + edge.low * blocks < 0) {
        if (edges->count == 0 || edges->groups[edges->count - 1].count == 3) {
            edges->groups[edges->count++].count = 0;
        }
        struct triangle_edges *const group = &edges->groups[edges->count - 1];
        group->edges[group->count++] = edge;
    }
    return true;
}

// Set the edges from at least 3 corners in their order on the screen. Return false if the triangle reaches no pixel of
// the tile.
static bool set_conservative_edges(struct conservative_edges *edges, const int32_t *x, const int32_t *y,
                                   int count, bool contains, struct sample_origin origin)
{
    int64_t area = 0;
    edges->count = 0;
    for (int i = 1; i + 1 < count; i++) {
        area += (int64_t)(x[i] - x[0]) * (y[i + 1] - y[0]) - (int64_t)(x[i + 1] - x[0]) * (y[i] - y[0]);
    }
    for (int i = 0; i < count; i++) {
        const int j = i + 1 < count ? i + 1 : 0;
        const int32_t sign = area < 0 ? -1 : 1;
        if (x[i] == x[j] && y[i] == y[j]) {
            continue;
        }
        const struct edge edge = make_edge(x[i], y[i], x[j], y[j], sign, origin);
        const int64_t e = edge.a * (origin.x - x[i]) + edge.b * (origin.y - y[i]);
        if (!add_conservative_edge(edges, edge, e, contains ? -1 : 1)) {
            return false;
        }
    }
    return true;
}

static bool conservative_setup(struct conservative_edges *edges, const struct rhw_chunk *chunk,
                               const struct rhw_triangle *t, bool contains, struct sample_origin origin)
{
    if (!(t->flags & RHW_TRIANGLE_POLYGON)) {
        return set_conservative_edges(edges, t->x_24_8, t->y_24_8, 3, contains, origin);
    }
    const struct rhw_polygon *const p = &chunk->polygons[t->polygon];
    return set_conservative_edges(edges, p->x_24_8, p->y_24_8, p->count, contains, origin);
}

// Return the pixels of the block at (x, y) of the tile that are covered: bit 8·row + column.
static uint64_t conservative_mask(const struct conservative_edges *edges, int x, int y)
{
    uint64_t mask = ~(uint64_t)0;
    for (int i = 0; i < edges->count; i++) {
        mask &= triangle_mask(&edges->groups[i], x, y);
    }
    return mask;
}

#endif
