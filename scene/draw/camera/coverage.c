// SPDX-License-Identifier: MIT
// See coverage.h. Triangles are clipped at the near and the far plane and scanned row by row. A line covers the cells
// of points along it, and a point covers its own.
#include "coverage.h"

#include <string.h>

#include "camera_math.h"

// A plane adds a corner to a convex polygon, so two leave a triangle five. Compilers can only prove six.
enum { MOST_CORNERS = 6 };

struct grid {
    int width, height;
    uint32_t count, enough;
    bool cells[SCENE_COVERAGE_SIDE][SCENE_COVERAGE_SIDE];
};

static void size_grid(struct grid *grid, double aspect)
{
    const double width = aspect >= 1.0 ? SCENE_COVERAGE_SIDE : SCENE_COVERAGE_SIDE * aspect,
                 height = aspect >= 1.0 ? SCENE_COVERAGE_SIDE / aspect : SCENE_COVERAGE_SIDE;
    grid->width = width > 1.0 ? (int)(width + 0.5) : 1;
    grid->height = height > 1.0 ? (int)(height + 0.5) : 1;
}

uint32_t scene_coverage_cells(double aspect)
{
    struct grid grid;
    size_grid(&grid, aspect);
    return (uint32_t)(grid.width * grid.height);
}

static void cover(struct grid *grid, int x, int y)
{
    grid->count += !grid->cells[y][x];
    grid->cells[y][x] = true;
}

// Return a place along one side of the picture in cells.
static double cell_place(double ndc, int cells)
{
    return 0.5 * (ndc + 1.0) * cells;
}

static void cover_point(struct grid *grid, const double clip[4])
{
    if (!(clip[3] > 0.0 && clip[2] >= 0.0 && clip[2] <= clip[3])) {
        return;
    }
    const double x = cell_place(clip[0] / clip[3], grid->width),
                 y = cell_place(clip[1] / clip[3], grid->height);
    if (x >= 0.0 && y >= 0.0 && x < grid->width && y < grid->height) {
        cover(grid, (int)x, (int)y);
    }
}

// Cut the part of a line that lies on the negative side of a plane off. `a` and `b` say where its ends are.
static void cut_line(double a, double b, double *first, double *last)
{
    if (a < 0.0 && b < 0.0) {
        *last = -1.0;
    } else if (a < 0.0 || b < 0.0) {
        const double part = a / (a - b);
        *first = a < 0.0 && part > *first ? part : *first;
        *last = b < 0.0 && part < *last ? part : *last;
    }
}

// Find the first and the last of the places along a line, 0 to SCENE_COVERAGE_SIDE, that can be in the picture. If no
// place can be, `*last` is less than `*first`.
static void find_places(double clip[2][4], int *first, int *last)
{
    double from = 0.0, to = 1.0;
    for (int side = -1; side <= 1; side += 2) {
        for (int c = 0; c < 3; c++) {
            const double w = c == 2 && side > 0 ? 0.0 : 1.0; // depth is 0 at the near plane
            cut_line(w * clip[0][3] + side * clip[0][c], w * clip[1][3] + side * clip[1][c], &from, &to);
        }
    }
    // A place more at each end makes up for rounding.
    *first = from > 0.0 ? (int)(from * SCENE_COVERAGE_SIDE) - 1 : 0;
    *last = to < 0.0 ? -1 : (int)(to * SCENE_COVERAGE_SIDE) + 1;
    *first = *first > 0 ? *first : 0;
    *last = *last < SCENE_COVERAGE_SIDE ? *last : SCENE_COVERAGE_SIDE;
}

static void cover_line(struct grid *grid, double clip[2][4])
{
    int first, last;
    find_places(clip, &first, &last);
    for (int i = first; i <= last; i++) {
        const double part = (double)i / SCENE_COVERAGE_SIDE;
        double at[4];
        for (int c = 0; c < 4; c++) {
            at[c] = clip[0][c] + part * (clip[1][c] - clip[0][c]);
        }
        cover_point(grid, at);
    }
}

// Cut off what lies on the negative side of a plane, where `sign` · z + `offset` · w is below 0. Return the number of
// corners that are left.
static int clip_polygon(double corners[MOST_CORNERS][4], int count, double sign, double offset)
{
    double from[MOST_CORNERS][4];
    int left = 0;
    memcpy(from, corners, sizeof from);
    for (int i = 0; i < count; i++) {
        const double *a = from[i], *b = from[(i + 1) % count];
        const double side_a = sign * a[2] + offset * a[3], side_b = sign * b[2] + offset * b[3];
        if (side_a >= 0.0) {
            memcpy(corners[left++], a, sizeof from[0]);
        }
        if ((side_a >= 0.0) != (side_b >= 0.0)) {
            const double part = side_a / (side_a - side_b);
            for (int c = 0; c < 4; c++) {
                corners[left][c] = a[c] + part * (b[c] - a[c]);
            }
            left++;
        }
    }
    return left;
}

// Cover the cells of a row whose middle lies in a convex polygon.
static void cover_row(struct grid *grid, double (*places)[2], int count, int row)
{
    const double y = row + 0.5;
    double left = grid->width, right = -1.0;
    for (int i = 0; i < count; i++) {
        const double *a = places[i], *b = places[(i + 1) % count];
        if ((a[1] <= y) != (b[1] <= y)) {
            const double x = a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
            left = x < left ? x : left;
            right = x > right ? x : right;
        }
    }
    const int first = left > 0.5 ? (int)(left + 0.5) : 0; // at most the width
    for (int x = first; x < grid->width && x + 0.5 <= right; x++) {
        cover(grid, x, row);
    }
}

static void cover_triangle(struct grid *grid, double clip[3][4])
{
    double corners[MOST_CORNERS][4], places[MOST_CORNERS][2];
    memcpy(corners, clip, 3 * sizeof corners[0]);
    int count = clip_polygon(corners, 3, 1.0, 0.0); // the near plane
    count = clip_polygon(corners, count, -1.0, 1.0);
    double low = grid->height, high = 0.0;
    for (int i = 0; i < count; i++) {
        if (!(corners[i][3] > 0.0)) {
            return;
        }
        places[i][0] = cell_place(corners[i][0] / corners[i][3], grid->width);
        places[i][1] = cell_place(corners[i][1] / corners[i][3], grid->height);
        low = places[i][1] < low ? places[i][1] : low;
        high = places[i][1] > high ? places[i][1] : high;
    }
    const int first = low > 0.0 ? low < grid->height ? (int)low : grid->height : 0;
    for (int row = first; row < grid->height && row + 0.5 <= high; row++) {
        cover_row(grid, places, count, row);
    }
}

static void cover_instance(struct grid *grid, const struct scene_mesh *mesh, const double matrix[16])
{
    const uint32_t count = scene_mesh_corners(mesh);
    for (uint32_t i = 0; i + count <= mesh->index_count && grid->count < grid->enough; i += count) {
        double clip[3][4];
        for (uint32_t k = 0; k < count; k++) {
            const float *p = mesh->positions[mesh->indices[i + k]];
            for (int c = 0; c < 4; c++) {
                clip[k][c] = matrix[c] * (double)p[0] + matrix[4 + c] * (double)p[1] +
                             matrix[8 + c] * (double)p[2] + matrix[12 + c];
            }
        }
        if (count == 3) {
            cover_triangle(grid, clip);
        } else if (count == 2) {
            cover_line(grid, clip);
        } else {
            cover_point(grid, clip[0]);
        }
    }
}

uint32_t scene_coverage_count(const struct scene_model *model, const struct scene_camera *camera,
                              double aspect, uint32_t enough)
{
    double view[16], projection[16], both[16];
    const struct scene_camera own = scene_camera_from_origin(camera, model->origin);
    scene_camera_view(&own, view);
    scene_camera_projection(camera, aspect, projection);
    scene_matrix_multiply(projection, view, both);
    struct grid grid = {.enough = enough};
    size_grid(&grid, aspect);
    for (uint32_t i = 0; i < model->instance_count && grid.count < enough; i++) {
        const struct scene_instance *instance = &model->instances[i];
        double world[16], matrix[16];
        if (instance->unseen) {
            continue;
        }
        for (int k = 0; k < 16; k++) {
            world[k] = (double)instance->world[k];
        }
        scene_exact_place(instance->world + 12, instance->place, world + 12);
        scene_matrix_multiply(both, world, matrix);
        cover_instance(&grid, &model->meshes[instance->mesh], matrix);
    }
    return grid.count;
}
