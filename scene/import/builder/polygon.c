// SPDX-License-Identifier: MIT
// Polygons become triangles, concave ones too, by cutting ears off (Meisters, Polygons have ears, 1975).
#include "polygon.h"

#include <math.h>
#include <string.h>

// The most corners of a polygon whose ears are cut, which takes time in the square of them. A polygon with more is
// drawn as a fan.
enum { MOST_CORNERS = 2048 };

struct polygon {
    double corners[MOST_CORNERS][3];
    double points[MOST_CORNERS][2]; // corners in the plane that shows most of the polygon, counter-clockwise
    uint32_t ring[MOST_CORNERS];    // corners that are left
    uint32_t count;
};

// Return twice the signed area of a triangle.
static double area(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

// Return true if floats of a polygon's corners would not tell them apart, so far is it from where they count from.
static bool needs_exact(const struct scene_mesh *mesh, const uint32_t *corners, uint32_t count)
{
    const double *const first = mesh->exact[corners[0]];
    double size = 0, far = 0;
    for (uint32_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            size = fmax(size, fabs(mesh->exact[corners[i]][c] - first[c]));
            far = fmax(far, fabs((double)mesh->positions[corners[i]][c]));
        }
    }
    return far > SCENE_REMOTE * size;
}

static void take_corners(struct polygon *polygon, const struct scene_mesh *mesh, const uint32_t *corners,
                         uint32_t count)
{
    const bool is_exact = mesh->exact != NULL && needs_exact(mesh, corners, count);
    polygon->count = count;
    for (uint32_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            polygon->corners[i][c] = is_exact ? mesh->exact[corners[i]][c] - mesh->exact[corners[0]][c]
                                              : (double)mesh->positions[corners[i]][c];
        }
    }
}

// Find Newell's normal, which is defined for polygons that are not quite flat, and for concave ones.
static void newell(const struct polygon *polygon, double normal[3])
{
    memset(normal, 0, 3 * sizeof *normal);
    for (uint32_t i = 0; i < polygon->count; i++) {
        const double *a = polygon->corners[i], *b = polygon->corners[(i + 1) % polygon->count];
        for (int c = 0; c < 3; c++) {
            const int u = (c + 1) % 3, v = (c + 2) % 3;
            normal[c] += (a[u] - b[u]) * (a[v] + b[v]);
        }
    }
}

static void flatten(struct polygon *polygon)
{
    double normal[3];
    newell(polygon, normal);
    int axis = 0;
    for (int c = 1; c < 3; c++) {
        axis = normal[c] * normal[c] > normal[axis] * normal[axis] ? c : axis;
    }
    const bool down = normal[axis] < 0;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (uint32_t i = 0; i < polygon->count; i++) {
        polygon->points[i][0] = polygon->corners[i][down ? v : u];
        polygon->points[i][1] = polygon->corners[i][down ? u : v];
        polygon->ring[i] = i;
    }
}

// Return true if the corner at place `i` of the ring can be cut off: it is convex and no other corner lies in it.
static bool is_ear(const struct polygon *polygon, uint32_t i)
{
    const uint32_t count = polygon->count, *ring = polygon->ring;
    const uint32_t before = ring[(i + count - 1) % count], here = ring[i], after = ring[(i + 1) % count];
    const double *a = polygon->points[before], *b = polygon->points[here], *c = polygon->points[after];
    if (!(area(a, b, c) > 0)) {
        return false;
    }
    for (uint32_t k = 0; k < count; k++) {
        const double *p = polygon->points[ring[k]];
        const bool corner = memcmp(p, a, sizeof polygon->points[0]) == 0 ||
                            memcmp(p, b, sizeof polygon->points[0]) == 0 ||
                            memcmp(p, c, sizeof polygon->points[0]) == 0;
        if (!corner && area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0) {
            return false;
        }
    }
    return true;
}

static void emit(uint32_t *out, uint32_t a, uint32_t b, uint32_t c)
{
    out[0] = a;
    out[1] = b;
    out[2] = c;
}

static void cut(struct polygon *polygon, uint32_t i, uint32_t *out)
{
    const uint32_t count = polygon->count;
    emit(out, polygon->ring[(i + count - 1) % count], polygon->ring[i], polygon->ring[(i + 1) % count]);
    memmove(polygon->ring + i, polygon->ring + i + 1, (count - i - 1) * sizeof *polygon->ring);
    polygon->count--;
}

static bool is_convex(const struct polygon *polygon)
{
    const uint32_t count = polygon->count;
    for (uint32_t i = 0; i < count; i++) {
        if (area(polygon->points[i], polygon->points[(i + 1) % count], polygon->points[(i + 2) % count]) <
            0) {
            return false;
        }
    }
    return true;
}

static void fan(uint32_t count, uint32_t *triangles)
{
    for (uint32_t i = 2; i < count; i++) {
        emit(triangles + 3 * (size_t)(i - 2), 0, i - 1, i);
    }
}

void scene_import_triangulate(const struct scene_mesh *mesh, const uint32_t *corners, uint32_t count,
                              uint32_t *triangles)
{
    struct polygon polygon;
    if (count <= 3 || count > MOST_CORNERS) {
        fan(count, triangles);
        return;
    }
    take_corners(&polygon, mesh, corners, count);
    flatten(&polygon);
    if (is_convex(&polygon)) {
        fan(count, triangles);
        return;
    }
    uint32_t next = 0;
    while (polygon.count > 3) {
        uint32_t ear = 0;
        while (ear < polygon.count && !is_ear(&polygon, ear)) {
            ear++;
        }
        // Without an ear the polygon crosses itself or has no area, and any corner will do.
        cut(&polygon, ear < polygon.count ? ear : 0, triangles + next);
        next += 3;
    }
    emit(triangles + next, polygon.ring[0], polygon.ring[1], polygon.ring[2]);
}

void scene_polygons_add(struct scene_import *import, struct scene_polygons *polygons, size_t triangles_before,
                        size_t triangles)
{
    if (polygons->of_triangle == NULL && triangles <= 1) {
        return;
    }
    const bool is_first = polygons->of_triangle == NULL;
    scene_import_reserve(import, &polygons->of_triangle, &polygons->capacity, triangles_before + triangles,
                         sizeof *polygons->of_triangle);
    for (size_t i = 0; i < triangles_before && is_first; i++) {
        polygons->of_triangle[i] = polygons->count++;
    }
    for (size_t i = 0; i < triangles; i++) {
        polygons->of_triangle[triangles_before + i] = polygons->count;
    }
    polygons->count++;
}
