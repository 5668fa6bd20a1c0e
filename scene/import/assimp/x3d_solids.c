// SPDX-License-Identifier: MIT
// Boxes, spheres, cones, cylinders, rectangles and disks of an X3D, with the texture as the standard lays it on them
// (ISO/IEC 19775-1 13.3 and 14.3). assimp 5.2.5 lays none on a box, and another one on others, lets cones stand on
// their tips, and gives disks ten corners. What it makes right without a texture is left to it.
#include "x3d_made.h"

#include "elementary.h"

#include <math.h>
#include <stdlib.h>

enum { SEGMENTS = 48, ROWS = 24 }; // around a solid, and up a sphere

// A circle around y on which the texture is at one height.
struct ring {
    double radius, y, outward, upward, v; // where it is, its normals and its texture
};

static bool is_number(double number)
{
    return fabs(number) < 1e30;
}

// Set a point on a unit circle, which runs around y counterclockwise as it is seen from above, and begins at the back.
static void find_direction(size_t segment, double *x, double *z)
{
    scene_sin_cos_degrees((double)segment * (360.0 / SEGMENTS), x, z);
    *x = -*x;
    *z = -*z;
}

static void add_vertex(struct scene_x3d_vertices *vertices, const double point[3], const double normal[3],
                       double u, double v)
{
    const size_t i = vertices->count++;
    for (int c = 0; c < 3; c++) {
        vertices->points[i][c] = (float)point[c];
        vertices->normals[i][c] = (float)normal[c];
    }
    vertices->places[i][0] = (float)u;
    vertices->places[i][1] = (float)v;
}

// Add the faces between rings, from the lowest to the highest. One of no radius is a tip.
static void add_sides(struct scene_x3d_vertices *vertices, const struct ring *rings, size_t count,
                      struct scene_x3d_made *made)
{
    const size_t columns = SEGMENTS + 1, first = vertices->count;
    for (size_t i = 0; i < count * columns; i++) {
        const struct ring *const ring = &rings[i / columns];
        double x, z;
        find_direction(i % columns, &x, &z);
        add_vertex(vertices, (double[3]){ring->radius * x, ring->y, ring->radius * z},
                   (double[3]){ring->outward * x, ring->upward, ring->outward * z},
                   (double)(i % columns) / SEGMENTS, ring->v);
    }
    for (size_t i = 0; i < (count - 1) * columns; i++) {
        if (i % columns == SEGMENTS) {
            continue;
        }
        const size_t here = first + i, above = here + columns;
        scene_x3d_add_index(made, here);
        if (rings[i / columns].radius > 0) {
            scene_x3d_add_index(made, here + 1);
        }
        scene_x3d_add_index(made, above + 1);
        if (rings[i / columns + 1].radius > 0) {
            scene_x3d_add_index(made, above);
        }
        scene_x3d_end_face(made);
    }
}

// Add a disk across y, which shows its front upward or downward, and its texture upright to who tilts it up.
static void add_disk(struct scene_x3d_vertices *vertices, double radius, double y, bool is_top,
                     struct scene_x3d_made *made)
{
    const double up = is_top ? 1 : -1;
    for (size_t i = 0; i < SEGMENTS; i++) {
        double x, z;
        find_direction(is_top ? i : SEGMENTS - i, &x, &z);
        scene_x3d_add_index(made, vertices->count);
        add_vertex(vertices, (double[3]){radius * x, y, radius * z}, (double[3]){0, up, 0}, 0.5 + x / 2,
                   0.5 - up * z / 2);
    }
    scene_x3d_end_face(made);
}

// Begin a solid of rings and of two disks.
static struct scene_x3d_vertices begin(struct scene_import *import, size_t rings, struct scene_x3d_made *made)
{
    const size_t most = (rings + 2) * (SEGMENTS + 1);
    made->index.list = scene_import_allocate(import, 5 * most, sizeof *made->index.list);
    return scene_x3d_allocate_vertices(import, most);
}

bool scene_x3d_make_box(struct scene_import *import, char *tag, char *close, struct scene_x3d_made *made)
{
    // The normal of each face, and where its texture goes: to the right, and up.
    static const signed char faces[6][3][3] = {
        {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
        {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
    };
    size_t count;
    double *const size = scene_x3d_numbers_of(import, tag, close, "size", "2 2 2", &count);
    const bool is_whole = count >= 3 && is_number(size[0]) && is_number(size[1]) && is_number(size[2]);
    if (is_whole) {
        struct scene_x3d_vertices vertices = begin(import, 0, made);
        for (size_t i = 0; i < 24; i++) {
            const signed char(*const face)[3] = faces[i / 4];
            const int right = i % 4 == 1 || i % 4 == 2, up = i % 4 >= 2;
            double point[3], normal[3];
            for (int c = 0; c < 3; c++) {
                normal[c] = face[0][c];
                point[c] =
                    size[c] / 2 * (face[0][c] + (2 * right - 1) * face[1][c] + (2 * up - 1) * face[2][c]);
            }
            scene_x3d_add_index(made, i);
            add_vertex(&vertices, point, normal, right, up);
            if (i % 4 == 3) {
                scene_x3d_end_face(made);
            }
        }
        scene_x3d_write_vertices(import, &vertices, true, made);
    }
    free(size);
    return is_whole;
}

bool scene_x3d_make_sphere(struct scene_import *import, char *tag, char *close, struct scene_x3d_made *made)
{
    const double radius = scene_x3d_number_of(tag, close, "radius", 1);
    struct ring rings[ROWS + 1];
    if (!(radius > 0 && is_number(radius))) {
        return false;
    }
    struct scene_x3d_vertices vertices = begin(import, ROWS + 1, made);
    for (size_t i = 0; i <= ROWS; i++) {
        double sine, cosine;
        scene_sin_cos_degrees((double)i * (180.0 / ROWS), &sine, &cosine);
        rings[i] = (struct ring){radius * sine, -radius * cosine, sine, -cosine, (double)i / ROWS};
    }
    add_sides(&vertices, rings, ROWS + 1, made);
    scene_x3d_write_vertices(import, &vertices, true, made);
    return true;
}

// Make the points and faces of a cone alone, as a file may have thousands.
static void make_plain_cone(struct scene_import *import, double radius, double height, bool has_side,
                            bool has_bottom, struct scene_x3d_made *made)
{
    struct scene_x3d_vertices vertices = begin(import, 1, made);
    for (size_t i = 0; i < SEGMENTS; i++) {
        double x, z;
        find_direction(SEGMENTS - i, &x, &z);
        add_vertex(&vertices, (double[3]){radius * x, -height / 2, radius * z}, (double[3]){0, 0, 0}, 0, 0);
    }
    for (size_t i = 0; i < SEGMENTS && has_bottom; i++) {
        scene_x3d_add_index(made, i);
    }
    scene_x3d_end_face(made);
    add_vertex(&vertices, (double[3]){0, height / 2, 0}, (double[3]){0, 0, 0}, 0, 0);
    for (size_t i = 0; i < SEGMENTS && has_side; i++) {
        scene_x3d_add_index(made, SEGMENTS);
        scene_x3d_add_index(made, (i + 1) % SEGMENTS);
        scene_x3d_add_index(made, i);
        scene_x3d_end_face(made);
    }
    scene_x3d_write_vertices(import, &vertices, false, made);
}

bool scene_x3d_make_cone(struct scene_import *import, char *tag, char *close, struct scene_x3d_made *made)
{
    const double radius = scene_x3d_number_of(tag, close, "bottomRadius", 1),
                 height = scene_x3d_number_of(tag, close, "height", 2),
                 slope = sqrt(radius * radius + height * height);
    if (!(radius > 0 && is_number(radius) && is_number(height))) {
        return false;
    }
    const struct ring rings[] = {{radius, -height / 2, height / slope, radius / slope, 0},
                                 {0, height / 2, height / slope, radius / slope, 1}};
    const bool has_side = !scene_x3d_is_false(tag, close, "side"),
               has_bottom = !scene_x3d_is_false(tag, close, "bottom");
    if (!made->is_textured) {
        make_plain_cone(import, radius, height, has_side, has_bottom, made);
        return has_side || has_bottom;
    }
    struct scene_x3d_vertices vertices = begin(import, 2, made);
    if (has_side) {
        add_sides(&vertices, rings, 2, made);
    }
    if (has_bottom) {
        add_disk(&vertices, radius, -height / 2, false, made);
    }
    scene_x3d_write_vertices(import, &vertices, true, made);
    return has_side || has_bottom;
}

bool scene_x3d_make_cylinder(struct scene_import *import, char *tag, char *close, struct scene_x3d_made *made)
{
    const double radius = scene_x3d_number_of(tag, close, "radius", 1),
                 height = scene_x3d_number_of(tag, close, "height", 2);
    if (!(radius > 0 && is_number(radius) && is_number(height))) {
        return false;
    }
    const struct ring rings[] = {{radius, -height / 2, 1, 0, 0}, {radius, height / 2, 1, 0, 1}};
    struct scene_x3d_vertices vertices = begin(import, 2, made);
    if (!scene_x3d_is_false(tag, close, "side")) {
        add_sides(&vertices, rings, 2, made);
    }
    if (!scene_x3d_is_false(tag, close, "top")) {
        add_disk(&vertices, radius, height / 2, true, made);
    }
    if (!scene_x3d_is_false(tag, close, "bottom")) {
        add_disk(&vertices, radius, -height / 2, false, made);
    }
    scene_x3d_write_vertices(import, &vertices, true, made);
    return made->index.count > 0;
}

bool scene_x3d_make_rectangle(struct scene_import *import, char *tag, char *close,
                              struct scene_x3d_made *made)
{
    size_t count;
    double *const size = scene_x3d_numbers_of(import, tag, close, "size", "2 2", &count);
    const bool is_whole = count >= 2 && is_number(size[0]) && is_number(size[1]);
    if (is_whole) {
        struct scene_x3d_vertices vertices = begin(import, 0, made);
        for (size_t i = 0; i < 4; i++) {
            const int right = i == 1 || i == 2, up = i >= 2;
            scene_x3d_add_index(made, i);
            add_vertex(&vertices, (double[3]){size[0] * (right - 0.5), size[1] * (up - 0.5), 0},
                       (double[3]){0, 0, 1}, right, up);
        }
        scene_x3d_write_vertices(import, &vertices, true, made);
    }
    free(size);
    return is_whole;
}

bool scene_x3d_make_disk(struct scene_import *import, char *tag, char *close, struct scene_x3d_made *made)
{
    const double outer = scene_x3d_number_of(tag, close, "outerRadius", 1),
                 inner = scene_x3d_number_of(tag, close, "innerRadius", 0);
    if (!(outer > 0 && inner >= 0 && inner < outer && is_number(outer))) {
        return false;
    }
    struct scene_x3d_vertices vertices = begin(import, 2, made);
    for (size_t i = 0; i < 2 * SEGMENTS; i++) {
        const double part = i < SEGMENTS ? 1 : inner / outer;
        double x, y;
        find_direction(i % SEGMENTS, &x, &y);
        x *= part;
        y *= -part;
        add_vertex(&vertices, (double[3]){outer * x, outer * y, 0}, (double[3]){0, 0, 1}, 0.5 + x / 2,
                   0.5 + y / 2);
    }
    for (size_t i = 0; i < SEGMENTS; i++) {
        const size_t next = (i + 1) % SEGMENTS;
        scene_x3d_add_index(made, i);
        if (inner > 0) {
            scene_x3d_add_index(made, next);
            scene_x3d_add_index(made, next + SEGMENTS);
            scene_x3d_add_index(made, i + SEGMENTS);
            scene_x3d_end_face(made);
        }
    }
    vertices.count = inner > 0 ? vertices.count : SEGMENTS;
    scene_x3d_write_vertices(import, &vertices, true, made);
    return true;
}
