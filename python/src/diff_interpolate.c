// SPDX-License-Identifier: MIT
// Attributes of vertices at pixels, A = u A0 + v A1 + (1 − u − v) A2, with slopes by the chain rule, and both
// backwards. Backwards a triangle goes through its pixels once, for the gradients of all three corners and of the pixels;
// then a vertex adds up what its corners got. Some images are worked on at a time, so that the sums of corners fit a
// cache.
#include "diff_mesh.h"
#include "picture_memory.h"

#include <stdlib.h>
#include <string.h>

struct work {
    struct diff_mesh mesh;
    const float *attributes; // [images or 1][vertices][channels]
    size_t attribute_stride; // floats from image to image; 0: all have the same
    size_t attribute_floats; // in all
    size_t channels, slope_channels;
    const uint32_t *selected;           // channels whose slopes are wanted
    const float *rast, *rast_db;        // rast_db: NULL without slopes
    float *values, *slopes;             // [pixel][channels], [pixel][slope_channels][2]
    const float *to_values, *to_slopes; // backwards their gradients
    float *attribute_gradient, *rast_gradient, *rast_db_gradient;
    struct diff_corners corners;
    struct diff_pixels pixels;
    size_t first_image, end_image; // that are worked on
    double *corner_sums;           // [end_image − first_image][triangles][3][channels]
    double *vertex_sums;           // [vertices][channels] of attributes that all images share; else NULL
};

static void find_corners(const struct work *work, size_t image, size_t triangle, const float *corner[3])
{
    for (int k = 0; k < 3; k++) {
        corner[k] = work->attributes + image * work->attribute_stride +
                    work->channels * work->mesh.corners[3 * triangle + (size_t)k];
    }
}

// Not read where no slopes are wanted.
static const float *slope_weights(const struct work *work, size_t place)
{
    return work->rast_db ? work->rast_db + 4 * place : NULL;
}

static void interpolate_pixel(const struct work *work, size_t image, size_t place)
{
    float *const values = work->values + place * work->channels;
    float *const slopes = work->slopes + 2 * place * work->slope_channels;
    const float *const rast = work->rast + 4 * place, *const db = slope_weights(work, place);
    size_t triangle;
    const float *corner[3];
    if (!diff_mesh_triangle(&work->mesh, rast[3], &triangle)) {
        memset(values, 0, work->channels * sizeof *values);
        memset(slopes, 0, 2 * work->slope_channels * sizeof *slopes);
        return;
    }
    find_corners(work, image, triangle, corner);
    const float u = rast[0], v = rast[1], w = 1.0f - u - v;
    for (size_t c = 0; c < work->channels; c++) {
        values[c] = u * corner[0][c] + v * corner[1][c] + w * corner[2][c];
    }
    for (size_t i = 0; i < work->slope_channels; i++) {
        const size_t c = work->selected[i];
        const float along_u = corner[0][c] - corner[2][c], along_v = corner[1][c] - corner[2][c];
        slopes[2 * i] = db[0] * along_u + db[2] * along_v;
        slopes[2 * i + 1] = db[1] * along_u + db[3] * along_v;
    }
}

static void interpolate_row(void *data, size_t row)
{
    const struct work *work = data;
    for (size_t x = 0; x < work->mesh.width; x++) {
        interpolate_pixel(work, row / work->mesh.height, row * work->mesh.width + x);
    }
}

enum { TRIANGLES_OF_JOB = 64, VERTICES_OF_JOB = 256, MAX_CHANNELS = 1024, MOST_SUM_BYTES = 1 << 23 };

// A triangle in an image, while its pixels are gone through.
struct facing {
    double along_u[MAX_CHANNELS], along_v[MAX_CHANNELS]; // what its attributes grow by: differences of floats
    double *sum; // [3][channels]: gradients of its corners' attributes
};

static void give_values(const struct work *work, const struct facing *facing, size_t place, double to_uv[2])
{
    const float *const rast = work->rast + 4 * place, *const values =
                                                          work->to_values + place * work->channels;
    const size_t channels = work->channels;
    const double u = rast[0], v = rast[1], w = 1.0f - rast[0] - rast[1];
    double *const sum = facing->sum, to_u = 0, to_v = 0;
    for (size_t c = 0; c < channels; c++) {
        const double value = values[c];
        sum[c] += u * value;
        sum[channels + c] += v * value;
        sum[2 * channels + c] += w * value;
        to_u += value * facing->along_u[c];
        to_v += value * facing->along_v[c];
    }
    to_uv[0] = to_u;
    to_uv[1] = to_v;
}

static void give_slopes(const struct work *work, const struct facing *facing, size_t place, double to_db[4])
{
    const float *const db = work->rast_db + 4 * place;
    for (size_t i = 0; i < work->slope_channels; i++) {
        const float *const slope = work->to_slopes + 2 * (place * work->slope_channels + i);
        const size_t c = work->selected[i];
        for (size_t k = 0; k < 3; k++) {
            const float dx = k == 2 ? -db[0] - db[2] : db[2 * k],
                        dy = k == 2 ? -db[1] - db[3] : db[2 * k + 1];
            facing->sum[k * work->channels + c] += (double)dx * slope[0] + (double)dy * slope[1];
        }
        for (int k = 0; k < 4; k++) {
            to_db[k] += (double)slope[k % 2] * (k < 2 ? facing->along_u : facing->along_v)[c];
        }
    }
}

static void give_pixel(const struct work *work, const struct facing *facing, size_t place)
{
    double to_uv[2], to_db[4] = {0};
    give_values(work, facing, place, to_uv);
    work->rast_gradient[4 * place] = (float)to_uv[0];
    work->rast_gradient[4 * place + 1] = (float)to_uv[1];
    if (work->rast_db) {
        give_slopes(work, facing, place, to_db);
    }
    for (size_t k = 0; work->rast_db_gradient && k < 4; k++) {
        work->rast_db_gradient[4 * place + k] = (float)to_db[k];
    }
}

static void give_triangle(const struct work *work, size_t image, size_t triangle, struct facing *facing)
{
    const struct diff_mesh *const mesh = &work->mesh;
    const size_t first_pixel = image * diff_mesh_pixels(mesh);
    const uint32_t *const first = work->pixels.first + image * (mesh->triangles + 2) + triangle;
    const uint32_t *const pixels = work->pixels.pixel + first_pixel;
    const float *corner[3];
    if (first[0] == first[1]) {
        return;
    }
    find_corners(work, image, triangle, corner);
    for (size_t c = 0; c < work->channels; c++) {
        const float along_u = corner[0][c] - corner[2][c], along_v = corner[1][c] - corner[2][c];
        facing->along_u[c] = along_u;
        facing->along_v[c] = along_v;
    }
    for (uint32_t i = first[0]; i < first[1]; i++) {
        give_pixel(work, facing, first_pixel + pixels[i]);
    }
}

static size_t jobs_of(size_t count, size_t of_job)
{
    return (count + of_job - 1) / of_job;
}

static void give_triangles(void *data, size_t job)
{
    const struct work *work = data;
    const size_t triangles = work->mesh.triangles, jobs = jobs_of(triangles, TRIANGLES_OF_JOB);
    const size_t image = job / jobs, start = job % jobs * TRIANGLES_OF_JOB, next = start + TRIANGLES_OF_JOB;
    const size_t end = next < triangles ? next : triangles, floats = 3 * work->channels;
    double *const sums = work->corner_sums + image * triangles * floats;
    struct facing facing;
    memset(sums + start * floats, 0, (end - start) * floats * sizeof *sums);
    for (size_t t = start; t < end; t++) {
        facing.sum = sums + t * floats;
        give_triangle(work, work->first_image + image, t, &facing);
    }
}

// Pixels without a triangle have no gradient.
static void clear_row(void *data, size_t row)
{
    const struct work *work = data;
    const size_t floats = 4 * work->mesh.width;
    memset(work->rast_gradient + row * floats, 0, floats * sizeof(float));
    if (work->rast_db_gradient) {
        memset(work->rast_db_gradient + row * floats, 0, floats * sizeof(float));
    }
}

static void add_corners(const struct work *work, size_t image, size_t vertex, double *sum)
{
    const double *const sums =
        work->corner_sums + (image - work->first_image) * work->mesh.triangles * 3 * work->channels;
    for (size_t i = work->corners.first[vertex]; i < work->corners.first[vertex + 1]; i++) {
        const double *const corner = sums + work->corners.corner[i] * work->channels;
        for (size_t c = 0; c < work->channels; c++) {
            sum[c] += corner[c];
        }
    }
}

static void put_vertex(const struct work *work, size_t image, size_t vertex, const double *sum)
{
    float *const result = work->attribute_gradient + image * work->attribute_stride + vertex * work->channels;
    for (size_t c = 0; c < work->channels; c++) {
        result[c] = (float)sum[c];
    }
}

// Attributes that all images share collect from one image after the other.
static void collect_vertices(void *data, size_t job)
{
    const struct work *work = data;
    const size_t jobs = jobs_of(work->mesh.vertices, VERTICES_OF_JOB);
    const size_t start = job % jobs * VERTICES_OF_JOB, end = start + VERTICES_OF_JOB;
    const size_t first_image = work->first_image + job / jobs;
    const size_t end_image = work->vertex_sums ? work->end_image : first_image + 1;
    double own[MAX_CHANNELS];
    for (size_t v = start; v < end && v < work->mesh.vertices; v++) {
        double *const sum = work->vertex_sums ? work->vertex_sums + v * work->channels : own;
        if (!work->vertex_sums) {
            memset(own, 0, work->channels * sizeof *own);
        }
        for (size_t image = first_image; image < end_image; image++) {
            add_corners(work, image, v, sum);
        }
        put_vertex(work, first_image * (work->vertex_sums == NULL), v, sum);
    }
}

// How many images' sums are there at a time. It depends on sizes alone.
static size_t images_at_once(const struct work *work, size_t sum_bytes)
{
    const size_t most = sum_bytes > 0 ? MOST_SUM_BYTES / sum_bytes : work->mesh.images;
    return most < 1 ? 1 : most < work->mesh.images ? most : work->mesh.images;
}

static void give_images(struct work *work, size_t at_once)
{
    struct diff_mesh *const mesh = &work->mesh;
    for (work->first_image = 0; work->first_image < mesh->images; work->first_image = work->end_image) {
        const size_t left = mesh->images - work->first_image, count = left < at_once ? left : at_once;
        work->end_image = work->first_image + count;
        diff_jobs_run(&mesh->crew, count * jobs_of(mesh->triangles, TRIANGLES_OF_JOB), give_triangles, work);
        diff_jobs_run(&mesh->crew, (work->vertex_sums ? 1 : count) * jobs_of(mesh->vertices, VERTICES_OF_JOB),
                      collect_vertices, work);
    }
}

static bool run_backwards(struct work *work)
{
    struct diff_mesh *const mesh = &work->mesh;
    const bool is_shared = work->attribute_stride == 0;
    const size_t sums = diff_times(mesh->triangles, 3 * work->channels);
    const size_t at_once = images_at_once(work, sums * sizeof(double));
    diff_jobs_run(&mesh->crew, mesh->images * mesh->height, clear_row, work);
    const size_t corner_bytes = (at_once * sums + 1) * sizeof *work->corner_sums;
    const size_t vertex_bytes = mesh->vertices * work->channels * sizeof *work->vertex_sums;
    work->corner_sums = python_picture_allocate(corner_bytes);
    work->vertex_sums = is_shared ? python_picture_allocate_zeroed(vertex_bytes) : NULL;
    const bool good = work->corner_sums && (work->vertex_sums || !is_shared) &&
                      diff_corners_make(mesh, &work->corners) &&
                      diff_pixels_make(mesh, work->rast, &work->pixels);
    if (good) {
        give_images(work, at_once);
    }
    diff_corners_free(&work->corners);
    diff_pixels_free(&work->pixels);
    python_picture_release(work->corner_sums, corner_bytes);
    python_picture_release(work->vertex_sums, vertex_bytes);
    return good;
}

// (mesh, attributes, channels, whether all images have the same, rast, rast_db or None, selected channels, values,
// slopes)
static bool read_work(PyObject *tuple, struct work *work, bool backwards)
{
    PyObject *mesh, *attributes, *rast, *rast_db, *selected, *values, *slopes;
    Py_ssize_t channels;
    int shared;
    struct python_array choice;
    if (!PyArg_ParseTuple(tuple, "OOnpOOOOO:diff_interpolate", &mesh, &attributes, &channels, &shared, &rast,
                          &rast_db, &selected, &values, &slopes) ||
        !diff_mesh_read(mesh, &work->mesh) || !python_array_read(selected, "diff_attrs", "<u4", &choice)) {
        return false;
    }
    bool good = channels >= 1 && channels <= MAX_CHANNELS && choice.count <= MAX_CHANNELS;
    work->selected = choice.data;
    for (Py_ssize_t i = 0; good && i < choice.count; i++) {
        good = work->selected[i] < (uint32_t)channels;
    }
    if (!good) {
        PyErr_Format(PyExc_ValueError,
                     "attr: there must be 1 to %d attributes, and diff_attrs be some of them", MAX_CHANNELS);
        return false;
    }
    work->channels = (size_t)channels;
    work->slope_channels = (size_t)choice.count;
    const size_t pixels = work->mesh.images * diff_mesh_pixels(&work->mesh);
    const size_t floats = diff_times(work->mesh.vertices, work->channels);
    const size_t all_values = diff_times(pixels, work->channels);
    const size_t all_slopes = diff_times(2 * pixels, work->slope_channels);
    work->attribute_stride = shared ? 0 : floats;
    work->attribute_floats = shared ? floats : diff_times(work->mesh.images, floats);
    return diff_floats(attributes, "attr", work->attribute_floats, &work->attributes) &&
           diff_floats(rast, "rast", 4 * pixels, &work->rast) &&
           (work->slope_channels ? diff_floats : diff_floats_optional)(rast_db, "rast_db", 4 * pixels,
                                                                       &work->rast_db) &&
           (backwards ? diff_floats(values, "to_values", all_values, &work->to_values) &&
                            diff_floats(slopes, "to_slopes", all_slopes, &work->to_slopes)
                      : diff_result(values, "values", all_values, &work->values) &&
                            diff_result(slopes, "slopes", all_slopes, &work->slopes));
}

static PyObject *interpolate(PyObject *module, PyObject *arguments)
{
    (void)module;
    struct work work = {0};
    if (!read_work(arguments, &work, false)) {
        return NULL;
    }
    diff_crew_begin(&work.mesh.crew);
    diff_jobs_run(&work.mesh.crew, work.mesh.images * work.mesh.height, interpolate_row, &work);
    return diff_crew_end(&work.mesh.crew, true);
}

// (the arguments of diff_interpolate, with gradients of values and slopes, gradients of attributes, of rast, of rast_db
// or None)
static PyObject *interpolate_grad(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *forward, *attributes, *rast, *rast_db;
    struct work work = {0};
    if (!PyArg_ParseTuple(arguments, "O!OOO:diff_interpolate_grad", &PyTuple_Type, &forward, &attributes,
                          &rast, &rast_db) ||
        !read_work(forward, &work, true)) {
        return NULL;
    }
    const size_t pixels = work.mesh.images * diff_mesh_pixels(&work.mesh);
    if (!diff_result(attributes, "result", work.attribute_floats, &work.attribute_gradient) ||
        !diff_result(rast, "result", 4 * pixels, &work.rast_gradient) ||
        !diff_result_optional(rast_db, "result", 4 * pixels, &work.rast_db_gradient)) {
        return NULL;
    }
    diff_crew_begin(&work.mesh.crew);
    const bool good = run_backwards(&work);
    return diff_crew_end(&work.mesh.crew, good);
}

PyMethodDef python_diff_interpolate_functions[] = {
    {"diff_interpolate", interpolate, METH_VARARGS, NULL},
    {"diff_interpolate_grad", interpolate_grad, METH_VARARGS, NULL},
    {0}};
