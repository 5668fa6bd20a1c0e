// SPDX-License-Identifier: MIT
// Antialiasing of silhouettes for rhw.diff, which makes what is seen change with the positions of vertices (Laine et
// al., "Modular primitives for high-performance differentiable rendering", 2020, section 3.6).
//
// Of two neighbouring pixels that see different triangles, the nearer triangle ends somewhere between their centres.
// Where it does at an edge that is a silhouette, and that runs more across the way from centre to centre than along it,
// the edge cuts the way at a part d of it, counted from the pixel that sees the triangle: the pixels are weighed as if
// each ended there instead of half way. One of the two is changed: with d above 1/2 the other gets d − 1/2 of the
// triangle's colour, else the triangle's pixel gets 1/2 − d of the other's.
#include "diff_mesh.h"
#include "picture_memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct work {
    struct diff_mesh mesh;
    const float *colors, *rast; // [images][height][width][channels], ...[4]
    const float *positions;     // as diff_rasterize.c has them
    size_t channels, position_stride, position_floats;
    const uint32_t *
        opposite; // [triangles][3]: of edge k, which lies across from corner k, the vertex beyond; UINT32_MAX
    float *result;          // as colors
    const float *to_result; // backwards the gradient of the result; else NULL
    float *color_gradient, *position_gradient;
    float (*share)
        [2]; // by pixels of all images: of the pairs with the pixel to the right and that in the row above
    double *sums; // [images][sum_pitch], of it [vertices][3]: gradients of x, y and w
    size_t sum_pitch;
    size_t first_row; // of each image, that a job begins with
};

// A triangle that ends between two pixels. `share` above 0: that much of the triangle's colour goes to the other pixel;
// below 0: −share of the other's to the triangle's pixel.
struct ending {
    size_t near, other; // pixels of all images: that which sees the triangle, and the other
    float share;
    bool is_free; // whether the share follows from where the edge lies, and was not held to the pixels' centres
    // The edge's ends: vertex, the way along the pair and across it, in pixels from the near centre. `sign` of along.
    size_t end[2];
    double along[2], across[2], part;
    int axis; // of the pair: 0: x, 1: y
    double sign;
};

// The vertex on the screen, in pixels from (x, y). False behind the eye.
static bool project(const struct work *work, size_t image, uint32_t vertex, const double center[2],
                    double at[2])
{
    const float *const p = work->positions + image * work->position_stride + 4 * (size_t)vertex;
    at[0] = (p[0] / (double)p[3] + 1) * 0.5 * (double)work->mesh.width - center[0];
    at[1] = (p[1] / (double)p[3] + 1) * 0.5 * (double)work->mesh.height - center[1];
    return p[3] > 0;
}

static double side(const double a[2], const double b[2], const double p[2])
{
    return (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
}

// Whether the surface ends at edge k as it is seen: there is nothing beyond, or it folds back.
static bool is_silhouette(const struct work *work, size_t image, size_t triangle, size_t k, double at[3][2],
                          const double center[2])
{
    const uint32_t beyond = work->opposite[3 * triangle + k];
    double other[2];
    if (beyond >= work->mesh.vertices || !project(work, image, beyond, center, other)) {
        return true;
    }
    const double *const a = at[(k + 1) % 3], *const b = at[(k + 2) % 3];
    return (side(a, b, at[k]) > 0) == (side(a, b, other) > 0);
}

// Where the way leaves the triangle: of the edges that it crosses, the one that it crosses last.
static bool find_edge(double at[3][2], struct ending *ending, size_t *edge, double *distance)
{
    bool found = false;
    for (size_t k = 0; k < 3; k++) {
        const double *const a = at[(k + 1) % 3], *const b = at[(k + 2) % 3];
        const double across[2] = {a[1 - ending->axis], b[1 - ending->axis]};
        const double along[2] = {ending->sign * a[ending->axis], ending->sign * b[ending->axis]};
        if ((across[0] > 0) == (across[1] > 0)) {
            continue;
        }
        const double part = -across[0] / (across[1] - across[0]);
        const double crossing = along[0] + part * (along[1] - along[0]);
        if (!found || crossing > *distance) {
            found = true;
            *edge = k;
            *distance = crossing;
            ending->part = part;
            memcpy(ending->along, along, sizeof along);
            memcpy(ending->across, across, sizeof across);
        }
    }
    return found;
}

// The sight of a triangle that ends between pixel `place` and the next along an axis. False where none does that
// counts.
static bool find_ending(const struct work *work, size_t place, int axis, struct ending *ending)
{
    const struct diff_mesh *const mesh = &work->mesh;
    const size_t step = axis ? mesh->width : 1, image = place / diff_mesh_pixels(mesh);
    const size_t x = place % mesh->width, y = place / mesh->width % mesh->height;
    if (axis ? y + 1 == mesh->height : x + 1 == mesh->width) {
        return false;
    }
    const float *const here = work->rast + 4 * place, *const there = here + 4 * step;
    if (here[3] == there[3]) {
        return false;
    }
    const bool is_here = here[3] > 0 && (!(there[3] > 0) || here[2] < there[2]);
    size_t triangle, edge = 0;
    if (!diff_mesh_triangle(mesh, is_here ? here[3] : there[3], &triangle)) {
        return false;
    }
    ending->near = is_here ? place : place + step;
    ending->other = is_here ? place + step : place;
    ending->axis = axis;
    ending->sign = is_here ? 1 : -1;
    const size_t near = ending->near % diff_mesh_pixels(mesh);
    const double center[2] = {(double)(near % mesh->width) + 0.5, (double)(near / mesh->width) + 0.5};
    double at[3][2], distance = 0;
    for (size_t k = 0; k < 3; k++) {
        if (!project(work, image, mesh->corners[3 * triangle + k], center, at[k])) {
            return false;
        }
    }
    const double slack = 1.0 / 16; // what is seen was rounded to 1/256 pixel, more along edges that lie askew
    if (!find_edge(at, ending, &edge, &distance) || !(distance > -slack && distance < 1 + slack) ||
        fabs(ending->across[1] - ending->across[0]) < fabs(ending->along[1] - ending->along[0]) ||
        !is_silhouette(work, image, triangle, edge, at, center)) {
        return false;
    }
    ending->is_free = distance >= 0 && distance <= 1;
    ending->share = (float)((distance < 0 ? 0 : distance > 1 ? 1 : distance) - 0.5);
    ending->end[0] = mesh->corners[3 * triangle + (edge + 1) % 3];
    ending->end[1] = mesh->corners[3 * triangle + (edge + 2) % 3];
    return true;
}

// Shares are kept with the sign of what the pixel itself, or the next, receives: above 0 the next one.
static void find_shares(void *data, size_t row)
{
    const struct work *work = data;
    const struct diff_mesh *const mesh = &work->mesh;
    for (size_t x = 0; x < mesh->width; x++) {
        const size_t place = row * mesh->width + x;
        for (int axis = 0; axis < 2; axis++) {
            struct ending ending;
            work->share[place][axis] = 0.0f;
            if (find_ending(work, place, axis, &ending)) {
                work->share[place][axis] = ending.near == place ? ending.share : -ending.share;
            }
        }
    }
}

// The pairs of a pixel, in a fixed order: the other pixel, and the share that the pixel takes of it (above 0) or gives.
static int find_pairs(const struct work *work, size_t place, size_t other[4], float taken[4])
{
    const struct diff_mesh *const mesh = &work->mesh;
    const size_t x = place % mesh->width, y = place / mesh->width % mesh->height;
    int count = 0;
    for (int axis = 0; axis < 2; axis++) {
        const size_t step = axis ? mesh->width : 1;
        if (axis ? y > 0 : x > 0) {
            other[count] = place - step;
            taken[count++] = work->share[place - step][axis];
        }
        if (axis ? y + 1 < mesh->height : x + 1 < mesh->width) {
            other[count] = place + step;
            taken[count++] = -work->share[place][axis];
        }
    }
    return count;
}

// Colours forwards. Backwards, where the shares are those of the transposed matrix: what a pixel took from another it
// owes to that, and what it gave away it does not have.
static void blend_row(void *data, size_t row)
{
    const struct work *work = data;
    const bool backwards = work->to_result != NULL;
    const float *const from = backwards ? work->to_result : work->colors;
    float *const to = backwards ? work->color_gradient : work->result;
    for (size_t x = 0; x < work->mesh.width; x++) {
        const size_t place = row * work->mesh.width + x;
        const float *const own = from + place * work->channels;
        float *const result = to + place * work->channels;
        size_t other[4];
        float taken[4];
        const int pairs = find_pairs(work, place, other, taken);
        memcpy(result, own, work->channels * sizeof *result);
        for (int i = 0; i < pairs; i++) {
            const float *const theirs = from + other[i] * work->channels;
            const float less = taken[i] > 0 ? taken[i] : 0, signed_more = backwards ? -taken[i] : taken[i];
            const float more = signed_more > 0 ? signed_more : 0;
            for (size_t c = 0; c < work->channels; c++) {
                result[c] += more * theirs[c] - less * own[c];
            }
        }
    }
}

// From the gradient of the way to the edge to those of its ends, on the screen and then in clip coordinates.
static void move_ends(const struct work *work, size_t image, const struct ending *ending, double gradient)
{
    const double lean = (ending->along[1] - ending->along[0]) / (ending->across[1] - ending->across[0]);
    const double half[2] = {0.5 * (double)work->mesh.width, 0.5 * (double)work->mesh.height};
    for (int i = 0; i < 2; i++) {
        const float *const p = work->positions + image * work->position_stride + 4 * ending->end[i];
        double *const sum = work->sums + image * work->sum_pitch + 3 * ending->end[i];
        const double w = p[3], weight = gradient * (i ? ending->part : 1 - ending->part);
        double on_screen[2];
        on_screen[ending->axis] = ending->sign * weight;
        on_screen[1 - ending->axis] = -lean * weight;
        for (int c = 0; c < 2; c++) {
            sum[c] += on_screen[c] * half[c] / w;
            sum[2] -= on_screen[c] * half[c] * p[c] / (w * w);
        }
    }
}

enum { PIXELS_OF_JOB = 1 << 18 };

static size_t rows_of_job(const struct diff_mesh *mesh)
{
    return PIXELS_OF_JOB / mesh->width; // not 0: widths end at 2^14
}

// Silhouettes are few pixels, so one thread has all of an image's rows that are at hand.
static void move_image(void *data, size_t image)
{
    const struct work *work = data;
    const struct diff_mesh *const mesh = &work->mesh;
    const size_t end_row = work->first_row + rows_of_job(mesh);
    const size_t first = image * diff_mesh_pixels(mesh);
    const size_t end = first + (end_row < mesh->height ? end_row : mesh->height) * mesh->width;
    for (size_t place = first + work->first_row * mesh->width; place < end; place++) {
        for (int axis = 0; axis < 2; axis++) {
            struct ending ending;
            if (!find_ending(work, place, axis, &ending) || !ending.is_free) { // a share of 0 moves too
                continue;
            }
            const size_t target = ending.share > 0 ? ending.other : ending.near;
            double gradient = 0;
            for (size_t c = 0; c < work->channels; c++) {
                gradient += (double)work->to_result[target * work->channels + c] *
                            (work->colors[ending.near * work->channels + c] -
                             work->colors[ending.other * work->channels + c]);
            }
            move_ends(work, image, &ending, gradient);
        }
    }
}

static void add_images(const struct work *work)
{
    const size_t vertices = work->mesh.vertices;
    const size_t copies = work->position_stride ? work->mesh.images : 1, images = work->mesh.images / copies;
    for (size_t i = 0; i < copies * vertices; i++) {
        double sum[3] = {0};
        for (size_t image = i / vertices; image < i / vertices + images; image++) {
            for (size_t c = 0; c < 3; c++) {
                sum[c] += work->sums[image * work->sum_pitch + 3 * (i % vertices) + c];
            }
        }
        float *const result = work->position_gradient + 4 * i;
        result[0] = (float)sum[0];
        result[1] = (float)sum[1];
        result[2] = 0.0f;
        result[3] = (float)sum[2];
    }
}

static bool run(struct work *work)
{
    struct diff_mesh *const mesh = &work->mesh;
    const bool backwards = work->to_result != NULL;
    const size_t rows = mesh->images * mesh->height;
    const size_t share_bytes = mesh->images * diff_mesh_pixels(mesh) * sizeof *work->share;
    work->share = python_picture_allocate(share_bytes);
    work->sums = backwards ? diff_sums(mesh->images, 3 * mesh->vertices, &work->sum_pitch) : NULL;
    const bool good = work->share && (work->sums || !backwards);
    if (good) {
        diff_jobs_run(&mesh->crew, rows, find_shares, work);
        diff_jobs_run(&mesh->crew, rows, blend_row, work);
    }
    if (good && backwards) {
        for (; work->first_row < mesh->height; work->first_row += rows_of_job(mesh)) {
            diff_jobs_run(&mesh->crew, mesh->images, move_image, work);
        }
        add_images(work);
    }
    python_picture_release(work->share, share_bytes);
    diff_sums_free(work->sums, mesh->images, work->sum_pitch);
    return good;
}

// (mesh, colours, channels, rast, positions, whether all images have the same, opposite vertices, result)
static bool read_work(PyObject *arguments, struct work *work, bool backwards)
{
    PyObject *mesh, *colors, *rast, *positions, *opposite, *result;
    Py_ssize_t channels;
    int shared;
    struct python_array array;
    if (!PyArg_ParseTuple(arguments, "OOnOOpOO:diff_antialias", &mesh, &colors, &channels, &rast, &positions,
                          &shared, &opposite, &result) ||
        !diff_mesh_read(mesh, &work->mesh) || !python_array_read(opposite, "topology_hash", "<u4", &array)) {
        return false;
    }
    if (channels < 1 || channels > RHW_MAX_TARGET_SIZE || (size_t)array.count != 3 * work->mesh.triangles) {
        PyErr_SetString(PyExc_ValueError, "topology_hash: must have three numbers for each triangle");
        return false;
    }
    const size_t pixels = work->mesh.images * diff_mesh_pixels(&work->mesh), floats = 4 * work->mesh.vertices;
    const size_t values = diff_times(pixels, (size_t)channels);
    work->opposite = array.data;
    work->channels = (size_t)channels;
    work->position_stride = shared ? 0 : floats;
    work->position_floats = shared ? floats : diff_times(work->mesh.images, floats);
    return diff_floats(colors, "color", values, &work->colors) &&
           diff_floats(rast, "rast", 4 * pixels, &work->rast) &&
           diff_floats(positions, "pos", work->position_floats, &work->positions) &&
           (backwards ? diff_floats(result, "to_result", values, &work->to_result)
                      : diff_result(result, "result", values, &work->result));
}

static PyObject *run_free(struct work *work)
{
    diff_crew_begin(&work->mesh.crew);
    const bool good = run(work);
    return diff_crew_end(&work->mesh.crew, good);
}

static PyObject *antialias(PyObject *module, PyObject *arguments)
{
    (void)module;
    struct work work = {0};
    return read_work(arguments, &work, false) ? run_free(&work) : NULL;
}

// (the arguments of diff_antialias, with the gradient of the result, gradients of colours, of positions)
static PyObject *antialias_grad(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *forward, *colors, *positions;
    struct work work = {0};
    if (!PyArg_ParseTuple(arguments, "O!OO:diff_antialias_grad", &PyTuple_Type, &forward, &colors,
                          &positions) ||
        !read_work(forward, &work, true)) {
        return NULL;
    }
    const size_t pixels = work.mesh.images * diff_mesh_pixels(&work.mesh);
    if (!diff_result(colors, "result", diff_times(pixels, work.channels), &work.color_gradient) ||
        !diff_result(positions, "result", work.position_floats, &work.position_gradient)) {
        return NULL;
    }
    return run_free(&work);
}

PyMethodDef python_diff_antialias_functions[] = {{"diff_antialias", antialias, METH_VARARGS, NULL},
                                                 {"diff_antialias_grad", antialias_grad, METH_VARARGS, NULL},
                                                 {0}};
