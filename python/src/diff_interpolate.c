// SPDX-License-Identifier: MIT
// Attributes of vertices at pixels, A = u A0 + v A1 + (1 − u − v) A2, with slopes by the chain rule, and both
// backwards. Backwards every thread goes through the pixels of an image in order, and adds what they give to the
// corners of the triangles that it owns; then a vertex adds up what its corners got. A few images are worked on at a
// time, so that the sums of corners fit a cache.
#include "diff_mesh.h"
#include "picture_memory.h"

#include <stdlib.h>
#include <string.h>

#define ALWAYS_INLINE static inline __attribute__((always_inline))

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
    size_t first_image, end_image; // that are worked on
    size_t first_row;              // of each image: jobs work on a block of rows from here on
    size_t owners;                 // how many jobs share the triangles of an image; a power of 2
    double *corner_sums; // [end_image − first_image][triangles][3][channels] of triangles that are seen
    bool *is_seen;       // [end_image − first_image][triangles]
    double *vertex_sums; // [vertices][channels] of attributes that all images share; else NULL
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

enum {
    TRIANGLES_OF_OWNER = 64, // in a row, then come the next owner's
    VERTICES_OF_JOB = 256,
    PIXELS_OF_BLOCK = 1 << 18, // so many that threads have work for milliseconds, between looks for signals
    MAX_CHANNELS = 1024,
    SUM_BYTES_OF_THREAD = 1 << 22
};

// A triangle in an image, while pixels of it are gone through.
struct facing {
    size_t triangle;
    double along_u[MAX_CHANNELS], along_v[MAX_CHANNELS]; // what its attributes grow by: differences of floats
    double *sum; // [3][channels]: gradients of its corners' attributes
};

// Inlined with few channels, whose number the compiler then knows.
ALWAYS_INLINE void give_values(const struct work *work, const struct facing *facing, size_t place,
                               size_t channels, float to_rast[4])
{
    const float *const rast = work->rast + 4 * place, *const values = work->to_values + place * channels;
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
    to_rast[0] = (float)to_u;
    to_rast[1] = (float)to_v;
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
    float to_rast[4] = {0};
    double to_db[4] = {0};
    switch (work->channels) {
    case 1: give_values(work, facing, place, 1, to_rast); break;
    case 2: give_values(work, facing, place, 2, to_rast); break;
    case 3: give_values(work, facing, place, 3, to_rast); break;
    case 4: give_values(work, facing, place, 4, to_rast); break;
    default: give_values(work, facing, place, work->channels, to_rast);
    }
    memcpy(work->rast_gradient + 4 * place, to_rast, sizeof to_rast);
    if (work->rast_db) {
        give_slopes(work, facing, place, to_db);
    }
    for (size_t k = 0; work->rast_db_gradient && k < 4; k++) {
        work->rast_db_gradient[4 * place + k] = (float)to_db[k];
    }
}

// A pixel without a triangle has no gradient.
static void clear_pixel(const struct work *work, size_t place)
{
    memset(work->rast_gradient + 4 * place, 0, 4 * sizeof(float));
    if (work->rast_db_gradient) {
        memset(work->rast_db_gradient + 4 * place, 0, 4 * sizeof(float));
    }
}

// Turns to a triangle. Its sums are zeroed when it is seen first: most triangles of many meshes never are.
static void face_triangle(const struct work *work, size_t image, size_t triangle, struct facing *facing)
{
    const size_t place = (image - work->first_image) * work->mesh.triangles + triangle;
    const size_t sums = 3 * work->channels;
    const float *corner[3];
    find_corners(work, image, triangle, corner);
    for (size_t c = 0; c < work->channels; c++) {
        const float along_u = corner[0][c] - corner[2][c], along_v = corner[1][c] - corner[2][c];
        facing->along_u[c] = along_u;
        facing->along_v[c] = along_v;
    }
    facing->triangle = triangle;
    facing->sum = work->corner_sums + place * sums;
    if (!work->is_seen[place]) {
        work->is_seen[place] = true;
        memset(facing->sum, 0, sums * sizeof *facing->sum);
    }
}

static size_t rows_of_block(const struct diff_mesh *mesh)
{
    return PIXELS_OF_BLOCK / mesh->width; // not 0: widths end at 2^14
}

// Pixels without a triangle belong to owners by rows.
static void give_block(void *data, size_t job)
{
    const struct work *work = data;
    const struct diff_mesh *const mesh = &work->mesh;
    const size_t image = work->first_image + job / work->owners;
    const size_t owner = job % work->owners, others = work->owners - 1;
    const size_t next_row = work->first_row + rows_of_block(mesh);
    const size_t end_row = next_row < mesh->height ? next_row : mesh->height;
    struct facing facing;
    facing.triangle = SIZE_MAX;
    for (size_t row = work->first_row; row < end_row; row++) {
        const size_t first = (image * mesh->height + row) * mesh->width;
        const bool clears = (row & others) == owner;
        for (size_t place = first; place < first + mesh->width; place++) {
            size_t triangle;
            if (!diff_mesh_triangle(mesh, work->rast[4 * place + 3], &triangle)) {
                if (clears) {
                    clear_pixel(work, place);
                }
            } else if ((triangle / TRIANGLES_OF_OWNER & others) == owner) {
                if (triangle != facing.triangle) {
                    face_triangle(work, image, triangle, &facing);
                }
                give_pixel(work, &facing, place);
            }
        }
    }
}

static void add_corners(const struct work *work, size_t image, size_t vertex, double *sum)
{
    const size_t first = (image - work->first_image) * work->mesh.triangles;
    for (size_t i = work->corners.first[vertex]; i < work->corners.first[vertex + 1]; i++) {
        const size_t corner = work->corners.corner[i];
        if (!work->is_seen[first + corner / 3]) {
            continue;
        }
        const double *const sums = work->corner_sums + (3 * first + corner) * work->channels;
        for (size_t c = 0; c < work->channels; c++) {
            sum[c] += sums[c];
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

static size_t jobs_of(size_t count, size_t of_job)
{
    return (count + of_job - 1) / of_job;
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

static size_t threads_of(const struct diff_crew *crew)
{
    return crew->threads < 1 ? 1 : crew->threads < RHW_MAX_THREADS ? (size_t)crew->threads : RHW_MAX_THREADS;
}

// How many images' sums are there at a time, which changes no result.
static size_t images_at_once(const struct work *work, size_t sum_bytes)
{
    const size_t bytes = threads_of(&work->mesh.crew) * SUM_BYTES_OF_THREAD;
    const size_t most = sum_bytes > 0 ? bytes / sum_bytes : work->mesh.images;
    return most < 1 ? 1 : most < work->mesh.images ? most : work->mesh.images;
}

static void give_images(struct work *work, size_t at_once)
{
    struct diff_mesh *const mesh = &work->mesh;
    for (work->first_image = 0; work->first_image < mesh->images; work->first_image = work->end_image) {
        const size_t left = mesh->images - work->first_image, count = left < at_once ? left : at_once;
        work->end_image = work->first_image + count;
        for (work->owners = 1; count * work->owners < threads_of(&mesh->crew);) {
            work->owners *= 2;
        }
        memset(work->is_seen, 0, count * mesh->triangles * sizeof *work->is_seen);
        for (work->first_row = 0; work->first_row < mesh->height; work->first_row += rows_of_block(mesh)) {
            diff_jobs_run(&mesh->crew, count * work->owners, give_block, work);
        }
        diff_jobs_run(&mesh->crew, (work->vertex_sums ? 1 : count) * jobs_of(mesh->vertices, VERTICES_OF_JOB),
                      collect_vertices, work);
    }
}

static bool run_backwards(struct work *work)
{
    struct diff_mesh *const mesh = &work->mesh;
    const bool is_shared = work->attribute_stride == 0;
    const size_t sums = diff_times(mesh->triangles, 3 * work->channels);
    const size_t sum_bytes = diff_times(sums, sizeof *work->corner_sums);
    const size_t at_once = images_at_once(work, sum_bytes);
    const size_t corner_bytes = diff_times(at_once, sum_bytes);
    const size_t seen_bytes = diff_times(at_once, mesh->triangles * sizeof *work->is_seen);
    const size_t vertex_bytes =
        diff_times(diff_times(mesh->vertices, work->channels), sizeof *work->vertex_sums);
    work->corner_sums = python_picture_allocate(corner_bytes);
    work->is_seen = python_picture_allocate(seen_bytes);
    work->vertex_sums = is_shared ? python_picture_allocate_zeroed(vertex_bytes) : NULL;
    const bool good = work->corner_sums && work->is_seen && (work->vertex_sums || !is_shared) &&
                      diff_corners_make(mesh, &work->corners);
    if (good) {
        give_images(work, at_once);
    }
    diff_corners_free(&work->corners);
    python_picture_release(work->corner_sums, corner_bytes);
    python_picture_release(work->is_seen, seen_bytes);
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
