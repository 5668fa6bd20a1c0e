// SPDX-License-Identifier: MIT
#include "diff_mesh.h"

#include "picture_memory.h"

#include <stdlib.h>

// Below 2^31 pixels in all, of at most 2^14 by 2^14 each, so that numbers of pixels fit 32 bits, and of floats size_t.
static bool check_sizes(const struct diff_mesh *mesh, Py_ssize_t count)
{
    const size_t most = (size_t)INT32_MAX;
    const bool fits = mesh->vertices >= 1 && mesh->vertices <= most && mesh->images >= 1 &&
                      mesh->images <= most && mesh->height >= 1 && mesh->height <= RHW_MAX_TARGET_SIZE &&
                      mesh->width >= 1 && mesh->width <= RHW_MAX_TARGET_SIZE && count % 3 == 0 &&
                      mesh->triangles <= most / 3 && mesh->images <= most / (mesh->height * mesh->width);
    if (!fits) {
        PyErr_SetString(PyExc_ValueError,
                        "resolution: there may be 2147483647 pixels, vertices and corners at most");
    }
    return fits;
}

bool diff_mesh_read(PyObject *tuple, struct diff_mesh *mesh)
{
    PyObject *object;
    Py_ssize_t vertices, images, height, width;
    struct python_array corners;
    if (!python_is_tuple(tuple, "mesh") ||
        !PyArg_ParseTuple(tuple, "Onnnni:mesh", &object, &vertices, &images, &height, &width,
                          &mesh->crew.threads) ||
        !python_array_read(object, "tri", "<u4", &corners)) {
        return false;
    }
    mesh->corners = corners.data;
    mesh->triangles = (size_t)corners.count / 3;
    mesh->vertices = (size_t)vertices;
    mesh->images = (size_t)images;
    mesh->height = (size_t)height;
    mesh->width = (size_t)width;
    if (!check_sizes(mesh, corners.count)) {
        return false;
    }
    for (size_t i = 0; i < 3 * mesh->triangles; i++) {
        if (mesh->corners[i] >= mesh->vertices) {
            PyErr_SetString(PyExc_ValueError, "tri: names a vertex that is not there");
            return false;
        }
    }
    return true;
}

size_t diff_mesh_pixels(const struct diff_mesh *mesh)
{
    return mesh->height * mesh->width;
}

bool diff_corners_make(const struct diff_mesh *mesh, struct diff_corners *corners)
{
    const size_t count = 3 * mesh->triangles;
    corners->first = calloc(mesh->vertices + 2, sizeof *corners->first);
    corners->corner = malloc((count + 1) * sizeof *corners->corner);
    if (!corners->first || !corners->corner) {
        diff_corners_free(corners);
        return false;
    }
    // Counted two places ahead, so that filling moves every start to its place.
    for (size_t i = 0; i < count; i++) {
        corners->first[mesh->corners[i] + 2]++;
    }
    for (size_t v = 2; v < mesh->vertices + 2; v++) {
        corners->first[v] += corners->first[v - 1];
    }
    for (size_t i = 0; i < count; i++) {
        corners->corner[corners->first[mesh->corners[i] + 1]++] = i;
    }
    return true;
}

void diff_corners_free(struct diff_corners *corners)
{
    free(corners->first);
    free(corners->corner);
    *corners = (struct diff_corners){0};
}

struct sorting {
    const struct diff_mesh *mesh;
    const float *rast;
    struct diff_pixels *pixels;
    uint32_t
        *triangle; // of every pixel, UINT32_MAX: none: `rast` is read once, as another thread may write to it
};

static void sort_image(void *data, size_t image)
{
    const struct sorting *sorting = data;
    const struct diff_mesh *const mesh = sorting->mesh;
    const size_t count = diff_mesh_pixels(mesh);
    const float *const rast = sorting->rast + 4 * count * image;
    uint32_t *const first = sorting->pixels->first + image * (mesh->triangles + 2);
    uint32_t *const pixel = sorting->pixels->pixel + image * count;
    uint32_t *const triangle = sorting->triangle + image * count;
    for (size_t i = 0; i < count; i++) {
        size_t t;
        const bool is_there = diff_mesh_triangle(mesh, rast[4 * i + 3], &t);
        triangle[i] = is_there ? (uint32_t)t : UINT32_MAX;
        if (is_there) {
            first[t + 2]++;
        }
    }
    for (size_t t = 2; t < mesh->triangles + 2; t++) {
        first[t] += first[t - 1];
    }
    for (size_t i = 0; i < count; i++) {
        if (triangle[i] != UINT32_MAX) {
            pixel[first[triangle[i] + 1]++] = (uint32_t)i;
        }
    }
}

bool diff_pixels_make(struct diff_mesh *mesh, const float *rast, struct diff_pixels *pixels)
{
    pixels->first_bytes = mesh->images * (mesh->triangles + 2) * sizeof *pixels->first;
    pixels->pixel_bytes = mesh->images * diff_mesh_pixels(mesh) * sizeof *pixels->pixel;
    pixels->first = python_picture_allocate_zeroed(pixels->first_bytes);
    pixels->pixel = python_picture_allocate(pixels->pixel_bytes);
    struct sorting sorting = {mesh, rast, pixels, python_picture_allocate(pixels->pixel_bytes)};
    const bool good = pixels->first && pixels->pixel && sorting.triangle;
    if (good) {
        diff_jobs_run(&mesh->crew, mesh->images, sort_image, &sorting);
    }
    python_picture_release(sorting.triangle, pixels->pixel_bytes);
    if (!good) {
        diff_pixels_free(pixels);
    }
    return good;
}

void diff_pixels_free(struct diff_pixels *pixels)
{
    python_picture_release(pixels->first, pixels->first_bytes);
    python_picture_release(pixels->pixel, pixels->pixel_bytes);
    *pixels = (struct diff_pixels){0};
}

size_t diff_times(size_t a, size_t b)
{
    return b != 0 && a > SIZE_MAX / b ? SIZE_MAX : a * b;
}

static bool read_floats(PyObject *object, const char *name, size_t count, struct python_array *array)
{
    if (!python_array_read(object, name, "<f4", array)) {
        return false;
    }
    if ((size_t)array->count != count) {
        PyErr_Format(PyExc_ValueError, "%s: must have %zu numbers, not %zd", name, count, array->count);
        return false;
    }
    return true;
}

bool diff_floats(PyObject *object, const char *name, size_t count, const float **values)
{
    struct python_array array;
    const bool read = read_floats(object, name, count, &array);
    *values = read ? array.data : NULL;
    return read;
}

bool diff_floats_optional(PyObject *object, const char *name, size_t count, const float **values)
{
    *values = NULL;
    return object == Py_None || diff_floats(object, name, count, values);
}

bool diff_result(PyObject *object, const char *name, size_t count, float **values)
{
    struct python_array array;
    if (!read_floats(object, name, count, &array)) {
        return false;
    }
    if (array.is_read_only) {
        PyErr_Format(PyExc_ValueError, "%s: must not be read-only", name);
        return false;
    }
    *values = array.data;
    return true;
}

bool diff_result_optional(PyObject *object, const char *name, size_t count, float **values)
{
    *values = NULL;
    return object == Py_None || diff_result(object, name, count, values);
}
