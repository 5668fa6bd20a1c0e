// SPDX-License-Identifier: MIT
// Attributes of vertices at pixels, A = u A0 + v A1 + (1 − u − v) A2, with slopes by the chain rule, and both
// backwards.
#include "diff_mesh.h"

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

static void give_pixel(const struct work *work, size_t image, size_t place)
{
    const float *const values = work->to_values + place * work->channels;
    const float *const slopes = work->to_slopes + 2 * place * work->slope_channels;
    double to_uv[2] = {0}, to_db[4] = {0};
    size_t triangle;
    const float *corner[3];
    if (diff_mesh_triangle(&work->mesh, work->rast[4 * place + 3], &triangle)) {
        find_corners(work, image, triangle, corner);
        for (size_t c = 0; c < work->channels; c++) {
            to_uv[0] += (double)values[c] * (corner[0][c] - corner[2][c]);
            to_uv[1] += (double)values[c] * (corner[1][c] - corner[2][c]);
        }
        for (size_t i = 0; i < work->slope_channels; i++) {
            const size_t c = work->selected[i];
            for (int k = 0; k < 4; k++) {
                to_db[k] += (double)slopes[2 * i + (size_t)(k % 2)] * (corner[k / 2][c] - corner[2][c]);
            }
        }
    }
    float *const rast_gradient = work->rast_gradient + 4 * place;
    rast_gradient[0] = (float)to_uv[0];
    rast_gradient[1] = (float)to_uv[1];
    rast_gradient[2] = rast_gradient[3] = 0.0f;
    for (int k = 0; work->rast_db_gradient && k < 4; k++) {
        work->rast_db_gradient[4 * place + (size_t)k] = (float)to_db[k];
    }
}

static void interpolate_row(void *data, size_t row)
{
    const struct work *work = data;
    for (size_t x = 0; x < work->mesh.width; x++) {
        interpolate_pixel(work, row / work->mesh.height, row * work->mesh.width + x);
    }
}

static void give_row(void *data, size_t row)
{
    const struct work *work = data;
    for (size_t x = 0; x < work->mesh.width; x++) {
        give_pixel(work, row / work->mesh.height, row * work->mesh.width + x);
    }
}

// Adds what a pixel gives to corner k of its triangle.
static void collect_pixel(const struct work *work, size_t place, size_t k, double *sum)
{
    const float *const rast = work->rast + 4 * place, *const db = slope_weights(work, place);
    const float weights[3] = {rast[0], rast[1], 1.0f - rast[0] - rast[1]};
    const float *const values = work->to_values + place * work->channels;
    for (size_t c = 0; c < work->channels; c++) {
        sum[c] += (double)weights[k] * values[c];
    }
    for (size_t i = 0; i < work->slope_channels; i++) {
        const float *const slope = work->to_slopes + 2 * (place * work->slope_channels + i);
        const float dx = k == 2 ? -db[0] - db[2] : db[2 * k], dy = k == 2 ? -db[1] - db[3] : db[2 * k + 1];
        sum[work->selected[i]] += (double)dx * slope[0] + (double)dy * slope[1];
    }
}

enum { VERTICES_OF_JOB = 256, MAX_CHANNELS = 1024 };

// Attributes that all images share collect from one image after the other.
static void collect_vertex(const struct work *work, size_t vertex, size_t first_image, size_t end_image)
{
    const struct diff_mesh *const mesh = &work->mesh;
    double sum[MAX_CHANNELS];
    memset(sum, 0, work->channels * sizeof *sum);
    for (size_t image = first_image; image < end_image; image++) {
        const uint32_t *const first = work->pixels.first + image * (mesh->triangles + 2);
        const uint32_t *const pixels = work->pixels.pixel + image * diff_mesh_pixels(mesh);
        for (size_t i = work->corners.first[vertex]; i < work->corners.first[vertex + 1]; i++) {
            const size_t triangle = work->corners.corner[i] / 3, k = work->corners.corner[i] % 3;
            for (uint32_t j = first[triangle]; j < first[triangle + 1]; j++) {
                collect_pixel(work, image * diff_mesh_pixels(mesh) + pixels[j], k, sum);
            }
        }
    }
    float *const result =
        work->attribute_gradient + first_image * work->attribute_stride + vertex * work->channels;
    for (size_t c = 0; c < work->channels; c++) {
        result[c] = (float)sum[c];
    }
}

static size_t jobs_of_image(const struct work *work)
{
    return (work->mesh.vertices + VERTICES_OF_JOB - 1) / VERTICES_OF_JOB;
}

static void collect_vertices(void *data, size_t job)
{
    const struct work *work = data;
    const size_t image = job / jobs_of_image(work), start = job % jobs_of_image(work) * VERTICES_OF_JOB;
    const size_t end_image = work->attribute_stride ? image + 1 : work->mesh.images;
    for (size_t v = start; v < start + VERTICES_OF_JOB && v < work->mesh.vertices; v++) {
        collect_vertex(work, v, image, end_image);
    }
}

static bool run_backwards(struct work *work)
{
    struct diff_mesh *const mesh = &work->mesh;
    diff_jobs_run(&mesh->crew, mesh->images * mesh->height, give_row, work);
    const bool good =
        diff_corners_make(mesh, &work->corners) && diff_pixels_make(mesh, work->rast, &work->pixels);
    if (good) {
        const size_t copies = work->attribute_stride ? mesh->images : 1;
        diff_jobs_run(&mesh->crew, copies * jobs_of_image(work), collect_vertices, work);
    }
    diff_corners_free(&work->corners);
    diff_pixels_free(&work->pixels);
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
