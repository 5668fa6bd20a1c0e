// SPDX-License-Identifier: MIT
// From gradients of weights, and of their slopes, to those of clip coordinates. A pixel centre (X, Y) of the image
// plane is r = (X, Y, 1), a corner p = (x, y, w). With n0 = p1 × p2, n1 = p2 × p0, n2 = p0 × p1 and N = n0 + n1 + n2,
// the weights in space are u = n0·r / N·r and v = n1·r / N·r, and their slopes ∂u/∂X = (n0.x − u N.x) / N·r and so on:
// Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997. What follows is that backwards,
// in doubles.
//
// First every pixel finds what it gives to its three corners, then every vertex adds up what it gets (diff_mesh.h).
#include "diff_mesh.h"
#include "picture_memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CORNER_FLOATS = 9 }; // x, y, w of three corners

struct work {
    struct diff_mesh mesh;
    const float *positions, *rast, *gradient; // as diff_rasterize.c has them; `gradient` of rast
    const float *slope_gradient;              // NULL: none
    float *result;                            // as positions
    size_t position_stride, image;
    struct diff_corners corners;
    struct diff_pixels pixels;
    float (*given)[CORNER_FLOATS]; // by the pixels of the image
    double (*sums)[3]; // by vertex: of x, y, w, from one image after the other where they share positions
};

static void cross(const double a[3], const double b[3], double product[3])
{
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// What a pixel at r gives to the x, y, w of its corners. `g` is the gradient of u and v, `h` that of their slopes along
// X and Y, in the order of rast_db.
static void give(double p[3][3], const double r[3], const double g[2], const double h[4], double gift[3][3])
{
    double n[3][3], sum[3];
    for (int k = 0; k < 3; k++) {
        cross(p[(k + 1) % 3], p[(k + 2) % 3], n[k]);
    }
    for (int c = 0; c < 3; c++) {
        sum[c] = n[0][c] + n[1][c] + n[2][c];
    }
    const double scale = 1.0 / dot(sum, r);
    double to_n[2][3] = {{0}}, to_sum[3] = {0}; // gradients of n0, n1 and N
    for (int k = 0; k < 2; k++) {
        const double weight = dot(n[k], r) * scale;
        double to_weight = g[k], to_divisor = 0;
        for (int axis = 0; axis < 2; axis++) {
            const double slope = (n[k][axis] - weight * sum[axis]) * scale, t = h[2 * k + axis] * scale;
            to_n[k][axis] += t;
            to_sum[axis] -= t * weight;
            to_weight -= t * sum[axis];
            to_divisor -= t * slope;
        }
        to_divisor -= to_weight * scale * weight;
        for (int c = 0; c < 3; c++) {
            to_n[k][c] += to_weight * scale * r[c];
            to_sum[c] += to_divisor * r[c];
        }
    }
    memset(gift, 0, 3 * sizeof *gift);
    for (int k = 0; k < 3; k++) { // n[k] = a × b
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        double to[3], to_a[3], to_b[3];
        for (int c = 0; c < 3; c++) {
            to[c] = to_sum[c] + (k < 2 ? to_n[k][c] : 0);
        }
        cross(p[b], to, to_a);
        cross(to, p[a], to_b);
        for (int c = 0; c < 3; c++) {
            gift[a][c] += to_a[c];
            gift[b][c] += to_b[c];
        }
    }
}

static void give_pixel(const struct work *work, size_t x, size_t y)
{
    const struct diff_mesh *const mesh = &work->mesh;
    const size_t pixel = y * mesh->width + x, place = work->image * diff_mesh_pixels(mesh) + pixel;
    size_t triangle;
    if (!diff_mesh_triangle(mesh, work->rast[4 * place + 3], &triangle)) {
        return;
    }
    const double per_x = 2.0 / (double)mesh->width, per_y = 2.0 / (double)mesh->height;
    const double r[3] = {((double)x + 0.5) * per_x - 1.0, ((double)y + 0.5) * per_y - 1.0, 1.0};
    const double g[2] = {work->gradient[4 * place], work->gradient[4 * place + 1]};
    double p[3][3], h[4] = {0}, gift[3][3];
    for (size_t k = 0; k < 3; k++) {
        const float *const position = work->positions + work->image * work->position_stride +
                                      4 * (size_t)mesh->corners[3 * triangle + k];
        p[k][0] = position[0];
        p[k][1] = position[1];
        p[k][2] = position[3];
    }
    for (size_t i = 0; work->slope_gradient && i < 4; i++) { // slopes are per pixel
        h[i] = work->slope_gradient[4 * place + i] * (i % 2 ? per_y : per_x);
    }
    give(p, r, g, h, gift);
    for (int i = 0; i < CORNER_FLOATS; i++) {
        const float value = (float)gift[i / 3][i % 3];
        work->given[pixel][i] = isfinite(value) ? value : 0.0f; // a triangle seen on edge has no gradient
    }
}

static void give_row(void *data, size_t y)
{
    const struct work *work = data;
    for (size_t x = 0; x < work->mesh.width; x++) {
        give_pixel(work, x, y);
    }
}

enum { VERTICES_OF_JOB = 512 };

static void collect_vertex(const struct work *work, size_t vertex)
{
    const uint32_t *const first = work->pixels.first + work->image * (work->mesh.triangles + 2);
    const uint32_t *const pixels = work->pixels.pixel + work->image * diff_mesh_pixels(&work->mesh);
    double *const sum = work->sums[vertex];
    if (work->position_stride) {
        memset(sum, 0, sizeof work->sums[vertex]);
    }
    for (size_t i = work->corners.first[vertex]; i < work->corners.first[vertex + 1]; i++) {
        const size_t triangle = work->corners.corner[i] / 3, corner = work->corners.corner[i] % 3;
        for (uint32_t j = first[triangle]; j < first[triangle + 1]; j++) {
            const float *const gift = &work->given[pixels[j]][3 * corner];
            for (int c = 0; c < 3; c++) {
                sum[c] += gift[c];
            }
        }
    }
    float *const result = work->result + work->image * work->position_stride + 4 * vertex;
    result[0] = (float)sum[0];
    result[1] = (float)sum[1];
    result[2] = 0.0f;
    result[3] = (float)sum[2];
}

static void collect_vertices(void *data, size_t job)
{
    const struct work *work = data;
    const size_t end = (job + 1) * VERTICES_OF_JOB;
    for (size_t v = job * VERTICES_OF_JOB; v < end && v < work->mesh.vertices; v++) {
        collect_vertex(work, v);
    }
}

static bool run(struct work *work)
{
    struct diff_mesh *const mesh = &work->mesh;
    const size_t given_bytes = diff_mesh_pixels(mesh) * sizeof *work->given;
    work->given = python_picture_allocate(given_bytes);
    work->sums = calloc(mesh->vertices, sizeof *work->sums);
    const bool good = work->given && work->sums && diff_corners_make(mesh, &work->corners) &&
                      diff_pixels_make(mesh, work->rast, &work->pixels);
    for (work->image = 0; good && work->image < mesh->images; work->image++) {
        diff_jobs_run(&mesh->crew, mesh->height, give_row, work);
        diff_jobs_run(&mesh->crew, (mesh->vertices + VERTICES_OF_JOB - 1) / VERTICES_OF_JOB, collect_vertices,
                      work);
    }
    diff_corners_free(&work->corners);
    diff_pixels_free(&work->pixels);
    python_picture_release(work->given, given_bytes);
    free(work->sums);
    return good;
}

// (mesh, positions, whether all images have the same, rast, gradient of rast, gradient of rast_db or None, gradient of
// positions)
static PyObject *rasterize_grad(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *mesh, *positions, *rast, *gradient, *slope_gradient, *result;
    struct work work = {0};
    int shared;
    if (!PyArg_ParseTuple(arguments, "OOpOOOO:diff_rasterize_grad", &mesh, &positions, &shared, &rast,
                          &gradient, &slope_gradient, &result) ||
        !diff_mesh_read(mesh, &work.mesh)) {
        return NULL;
    }
    const size_t values = 4 * work.mesh.images * diff_mesh_pixels(&work.mesh),
                 floats = 4 * work.mesh.vertices;
    const size_t all = shared ? floats : diff_times(work.mesh.images, floats);
    work.position_stride = shared ? 0 : floats;
    if (!diff_floats(positions, "pos", all, &work.positions) ||
        !diff_floats(rast, "rast", values, &work.rast) ||
        !diff_floats(gradient, "gradient", values, &work.gradient) ||
        !diff_floats_optional(slope_gradient, "gradient_db", values, &work.slope_gradient) ||
        !diff_result(result, "result", all, &work.result)) {
        return NULL;
    }
    diff_crew_begin(&work.mesh.crew);
    const bool good = run(&work);
    return diff_crew_end(&work.mesh.crew, good);
}

PyMethodDef python_diff_rasterize_grad_functions[] = {
    {"diff_rasterize_grad", rasterize_grad, METH_VARARGS, NULL}, {0}};
