// SPDX-License-Identifier: MIT
// Polygons become triangles, concave ones too, by cutting ears off (Meisters, Polygons have ears, 1975). Polygons of
// files as people have them take some looks at each corner. A hostile one takes as many as it has corners, so that what
// all polygons of a file take beyond what is usual has a limit.
#include "polygon.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "large_polygon.h"

enum {
    // The most corners of a polygon whose ears are cut here, which takes time in the square of them. large_polygon.c
    // cuts one with more.
    MOST_CORNERS = 64,
    // Looks at each corner that a polygon may always take. Outlines of letters, parts and coasts take fewer.
    USUAL_LOOKS = 128,
    // Looks that all polygons of a file may take beyond the usual ones, which is half a second's.
    MORE_LOOKS = 200000000,
};

struct polygon {
    double points[MOST_CORNERS][2]; // corners in the plane that shows most of the polygon, counter-clockwise
    uint32_t ring[MOST_CORNERS];    // corners that are left
    uint32_t count;
    uint64_t looks; // looks at corners that it took
};

// Corners of a polygon of a mesh that has no more than positions yet.
struct outline {
    const struct scene_mesh *mesh;
    const uint32_t *corners;
    uint32_t count;
    bool is_exact; // floats would not tell the corners apart, so far is the polygon from where they count from
};

static struct outline outline_of(const struct scene_mesh *mesh, const uint32_t *corners, uint32_t count)
{
    struct outline outline = {mesh, corners, count, false};
    double size = 0, far = 0;
    for (uint32_t i = 0; i < count && mesh->exact != NULL; i++) {
        for (int c = 0; c < 3; c++) {
            size = fmax(size, fabs(mesh->exact[corners[i]][c] - mesh->exact[corners[0]][c]));
            far = fmax(far, fabs((double)mesh->positions[corners[i]][c]));
        }
    }
    outline.is_exact = far > SCENE_REMOTE * size;
    return outline;
}

static void place_corner(const struct outline *outline, uint32_t i, double place[3])
{
    const struct scene_mesh *const mesh = outline->mesh;
    const uint32_t corner = outline->corners[i];
    for (int c = 0; c < 3; c++) {
        place[c] = outline->is_exact ? mesh->exact[corner][c] - mesh->exact[outline->corners[0]][c]
                                     : (double)mesh->positions[corner][c];
    }
}

// Find Newell's normal, which is defined for polygons that are not quite flat, and for concave ones.
static void newell(const struct outline *outline, double normal[3])
{
    double a[3], b[3];
    memset(normal, 0, 3 * sizeof *normal);
    place_corner(outline, 0, b);
    for (uint32_t i = 0; i < outline->count; i++) {
        memcpy(a, b, sizeof a);
        place_corner(outline, (i + 1) % outline->count, b);
        for (int c = 0; c < 3; c++) {
            const int u = (c + 1) % 3, v = (c + 2) % 3;
            normal[c] += (a[u] - b[u]) * (a[v] + b[v]);
        }
    }
}

// Find the corners in the plane that shows most of the polygon, counter-clockwise.
static void flatten(const struct outline *outline, double (*points)[2])
{
    double normal[3];
    newell(outline, normal);
    int axis = 0;
    for (int c = 1; c < 3; c++) {
        axis = normal[c] * normal[c] > normal[axis] * normal[axis] ? c : axis;
    }
    const bool down = normal[axis] < 0;
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (uint32_t i = 0; i < outline->count; i++) {
        double place[3];
        place_corner(outline, i, place);
        points[i][0] = place[down ? v : u];
        points[i][1] = place[down ? u : v];
    }
}

// Return true if the corner at place `i` of the ring can be cut off: it is convex and no other corner lies in it.
static bool is_ear(struct polygon *polygon, uint32_t i)
{
    const uint32_t count = polygon->count, *ring = polygon->ring;
    const uint32_t before = ring[(i + count - 1) % count], here = ring[i], after = ring[(i + 1) % count];
    const double *a = polygon->points[before], *b = polygon->points[here], *c = polygon->points[after];
    polygon->looks++;
    if (!(scene_import_area(a, b, c) > 0)) {
        return false;
    }
    for (uint32_t k = 0; k < count; k++) {
        polygon->looks++;
        const double *p = polygon->points[ring[k]];
        const bool corner = memcmp(p, a, sizeof polygon->points[0]) == 0 ||
                            memcmp(p, b, sizeof polygon->points[0]) == 0 ||
                            memcmp(p, c, sizeof polygon->points[0]) == 0;
        if (!corner && scene_import_area(a, b, p) >= 0 && scene_import_area(b, c, p) >= 0 &&
            scene_import_area(c, a, p) >= 0) {
            return false;
        }
    }
    return true;
}

static void cut(struct polygon *polygon, uint32_t i, uint32_t *out)
{
    const uint32_t count = polygon->count;
    scene_import_emit(out, polygon->ring[(i + count - 1) % count], polygon->ring[i],
                      polygon->ring[(i + 1) % count]);
    memmove(polygon->ring + i, polygon->ring + i + 1, (count - i - 1) * sizeof *polygon->ring);
    polygon->count--;
}

// Return true if no corner turns clockwise, as in a convex polygon.
static bool is_convex(const double (*points)[2], uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (scene_import_area(points[i], points[(i + 1) % count], points[(i + 2) % count]) < 0) {
            return false;
        }
    }
    return true;
}

static void fan(uint32_t count, uint32_t *triangles)
{
    for (uint32_t i = 2; i < count; i++) {
        scene_import_emit(triangles + 3 * (size_t)(i - 2), 0, i - 1, i);
    }
}

// Cut the ears off. Return false if it takes more looks than these. The triangles are a fan from there on.
static bool cut_ears(struct polygon *polygon, uint64_t most_looks, uint32_t *triangles)
{
    while (polygon->count > 3) {
        uint32_t ear = 0;
        while (ear < polygon->count && polygon->looks < most_looks && !is_ear(polygon, ear)) {
            ear++;
        }
        // Without an ear the polygon crosses itself or has no area, and any corner will do.
        cut(polygon, ear < polygon->count ? ear : 0, triangles);
        triangles += 3;
    }
    scene_import_emit(triangles, polygon->ring[0], polygon->ring[1], polygon->ring[2]);
    return polygon->looks < most_looks;
}

static bool cut_small(const struct outline *outline, uint64_t most_looks, uint64_t *looks,
                      uint32_t *triangles)
{
    struct polygon polygon = {.count = outline->count, .looks = 0};
    flatten(outline, polygon.points);
    if (is_convex((const double(*)[2])polygon.points, polygon.count)) {
        fan(polygon.count, triangles);
        return true;
    }
    for (uint32_t i = 0; i < polygon.count; i++) {
        polygon.ring[i] = i;
    }
    const bool is_whole = cut_ears(&polygon, most_looks, triangles);
    *looks += polygon.looks;
    return is_whole;
}

static bool cut_large(const struct outline *outline, uint64_t most_looks, uint64_t *looks,
                      uint32_t *triangles)
{
    const uint32_t count = outline->count;
    double(*const points)[2] = malloc(count * sizeof *points);
    bool is_whole = points != NULL;
    if (is_whole) {
        flatten(outline, points);
    }
    if (!is_whole || is_convex((const double(*)[2])points, count)) {
        fan(count, triangles);
    } else {
        is_whole = scene_import_cut_large((const double(*)[2])points, count, most_looks, looks, triangles);
    }
    free(points);
    return is_whole;
}

void scene_import_triangulate(struct scene_import *import, const struct scene_mesh *mesh,
                              const uint32_t *corners, uint32_t count, uint32_t *triangles)
{
    if (count <= 3) {
        fan(count, triangles);
        return;
    }
    const struct outline outline = outline_of(mesh, corners, count);
    const uint64_t usual = (uint64_t)count * USUAL_LOOKS, most = usual + MORE_LOOKS - import->more_looks;
    uint64_t looks = 0;
    const bool is_whole = count > MOST_CORNERS ? cut_large(&outline, most, &looks, triangles)
                                               : cut_small(&outline, most, &looks, triangles);
    const uint64_t more = looks > usual ? looks - usual : 0, left = MORE_LOOKS - import->more_looks;
    import->more_looks += more < left ? more : left;
    import->fan_count += !is_whole;
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
