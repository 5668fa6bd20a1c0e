// SPDX-License-Identifier: MIT
// Ears of large polygons. A corner that turns clockwise is all that can lie in an ear (Meisters, Polygons have ears,
// 1975). A grid holds these corners, so that an ear of the usual size looks at a few of them. The search for the next
// ear goes on behind the last one. A hostile polygon, all of whose ears are long, still takes time in the square of its
// corners, so that the caller gives a limit.
#include "large_polygon.h"

#include <stdlib.h>

struct ring {
    const double (*points)[2];
    uint32_t *before, *after; // neighbours of each corner that is left
    uint32_t *cells;          // first corner in each cell, plus 1; 0 where there is none
    uint32_t *in_cell;        // next corner in the same cell, plus 1
    bool *turns_back;         // whether a corner that is left turns clockwise, or not at all
    double low[2], scale[2];  // cell = (point - low) * scale
    uint32_t side;            // cells along each side of the grid
    uint64_t looks;
};

static bool turns_back(const struct ring *ring, uint32_t i)
{
    return !(scene_import_area(ring->points[ring->before[i]], ring->points[i], ring->points[ring->after[i]]) >
             0);
}

static uint32_t cell_of(const struct ring *ring, double value, int axis)
{
    const double cell = (value - ring->low[axis]) * ring->scale[axis];
    return cell > 0 ? cell < (double)ring->side ? (uint32_t)cell : ring->side - 1 : 0;
}

static void find_bounds(struct ring *ring, uint32_t count)
{
    for (int axis = 0; axis < 2; axis++) {
        double low = ring->points[0][axis], high = low;
        for (uint32_t i = 1; i < count; i++) {
            low = ring->points[i][axis] < low ? ring->points[i][axis] : low;
            high = ring->points[i][axis] > high ? ring->points[i][axis] : high;
        }
        ring->low[axis] = low;
        ring->scale[axis] = high > low ? (double)ring->side / (high - low) : 0;
    }
}

static bool make_ring(struct ring *ring, uint32_t count)
{
    ring->side = 1;
    while (ring->side * ring->side < count && ring->side < 1024) {
        ring->side *= 2;
    }
    ring->before = malloc(count * sizeof *ring->before);
    ring->after = malloc(count * sizeof *ring->after);
    ring->in_cell = calloc(count, sizeof *ring->in_cell);
    ring->turns_back = calloc(count, sizeof *ring->turns_back);
    ring->cells = calloc((size_t)ring->side * ring->side, sizeof *ring->cells);
    if (ring->before == NULL || ring->after == NULL || ring->in_cell == NULL || ring->turns_back == NULL ||
        ring->cells == NULL) {
        return false;
    }
    find_bounds(ring, count);
    for (uint32_t i = 0; i < count; i++) {
        ring->before[i] = (i + count - 1) % count;
        ring->after[i] = (i + 1) % count;
    }
    for (uint32_t i = 0; i < count; i++) {
        ring->turns_back[i] = turns_back(ring, i);
        if (ring->turns_back[i]) {
            uint32_t *const cell = &ring->cells[cell_of(ring, ring->points[i][1], 1) * ring->side +
                                                cell_of(ring, ring->points[i][0], 0)];
            ring->in_cell[i] = *cell;
            *cell = i + 1;
        }
    }
    return true;
}

static void free_ring(struct ring *ring)
{
    free(ring->before);
    free(ring->after);
    free(ring->in_cell);
    free(ring->turns_back);
    free(ring->cells);
}

static bool is_same(const double a[2], const double b[2])
{
    return !(a[0] < b[0] || a[0] > b[0] || a[1] < b[1] || a[1] > b[1]);
}

// Return true if a corner of a cell lies in a triangle.
static bool holds_corner(struct ring *ring, uint32_t cell, const double a[2], const double b[2],
                         const double c[2])
{
    for (uint32_t k = ring->cells[cell]; k != 0; k = ring->in_cell[k - 1]) {
        const double *const p = ring->points[k - 1];
        ring->looks++;
        if (ring->turns_back[k - 1] && scene_import_area(a, b, p) >= 0 && scene_import_area(b, c, p) >= 0 &&
            scene_import_area(c, a, p) >= 0 && !is_same(p, a) && !is_same(p, b) && !is_same(p, c)) {
            return true;
        }
    }
    return false;
}

static double least(double a, double b, double c)
{
    const double ab = a < b ? a : b;
    return ab < c ? ab : c;
}

// Return true if a corner can be cut off: it turns counter-clockwise and no other corner lies in its triangle.
static bool is_ear(struct ring *ring, uint32_t i)
{
    const double *const a = ring->points[ring->before[i]], *const b = ring->points[i];
    const double *const c = ring->points[ring->after[i]];
    ring->looks++;
    if (turns_back(ring, i)) {
        return false;
    }
    uint32_t first[2], last[2];
    for (int axis = 0; axis < 2; axis++) {
        first[axis] = cell_of(ring, least(a[axis], b[axis], c[axis]), axis);
        last[axis] = cell_of(ring, -least(-a[axis], -b[axis], -c[axis]), axis);
    }
    for (uint32_t y = first[1]; y <= last[1]; y++) {
        ring->looks += last[0] - first[0] + 1;
        for (uint32_t x = first[0]; x <= last[0]; x++) {
            if (holds_corner(ring, y * ring->side + x, a, b, c)) {
                return false;
            }
        }
    }
    return true;
}

// Cut a corner off. A neighbour that turned back may not do so from now on.
static void cut(struct ring *ring, uint32_t i, uint32_t *out)
{
    const uint32_t before = ring->before[i], after = ring->after[i];
    scene_import_emit(out, before, i, after);
    ring->after[before] = after;
    ring->before[after] = before;
    ring->turns_back[i] = false;
    ring->turns_back[before] = ring->turns_back[before] && turns_back(ring, before);
    ring->turns_back[after] = ring->turns_back[after] && turns_back(ring, after);
}

bool scene_import_cut_large(const double (*points)[2], uint32_t count, uint64_t most_looks, uint64_t *looks,
                            uint32_t *triangles)
{
    struct ring ring = {.points = points};
    uint32_t left = count, place = 0, passed = 0;
    const bool is_made = make_ring(&ring, count);
    while (is_made && left > 3 && ring.looks < most_looks) {
        // Where no ear was found all around, the polygon crosses itself or has no area, and any corner will do.
        if (passed >= left || is_ear(&ring, place)) {
            cut(&ring, place, triangles);
            triangles += 3;
            left--;
            passed = 0;
        } else {
            passed++;
        }
        place = ring.after[place];
    }
    uint32_t second = is_made ? ring.after[place] : 1;
    for (uint32_t i = 2; i < left; i++) {
        const uint32_t third = is_made ? ring.after[second] : i;
        scene_import_emit(triangles, place, second, third);
        triangles += 3;
        second = third;
    }
    free_ring(&ring);
    *looks += ring.looks;
    return is_made && left <= 3;
}
