// SPDX-License-Identifier: MIT
// The triangles of rhw.diff, and who adds to whom when gradients go from pixels back to vertices. A vertex collects
// from its corners, one after the other, and a corner from the pixels of its triangle, row by row: every sum has one
// owner and one order, whatever the threads.
#ifndef PYTHON_DIFF_MESH_H
#define PYTHON_DIFF_MESH_H

#include "diff_jobs.h"
#include "memory_object.h"

/// Sizes that are at least 1 (but for `triangles`), and whose products were found to fit by diff_mesh_read.
struct diff_mesh {
    const uint32_t *corners; ///< [triangles][3], each below `vertices`
    size_t triangles, vertices;
    size_t images, height, width;
    struct diff_crew crew;
};

/// Corners by vertex: corner 3 · triangle + k of all triangles, those of vertex v at first[v] .. first[v + 1] − 1,
/// ascending.
struct diff_corners {
    size_t *first, *corner;
};

/// Pixels by triangle and image: those of triangle t in image i at first[i · (triangles + 2) + t] ..
/// first[… + 1] − 1, numbered in the image and ascending.
struct diff_pixels {
    uint32_t *first, *pixel;
    size_t first_bytes, pixel_bytes;
};

/// (corners, vertices, images, height, width, threads). False with an exception.
bool diff_mesh_read(PyObject *tuple, struct diff_mesh *mesh);
size_t diff_mesh_pixels(const struct diff_mesh *mesh); ///< of an image
/// The triangle of a pixel by the fourth number of the rasterizer's output. False where there is none, or nonsense.
static inline bool diff_mesh_triangle(const struct diff_mesh *mesh, float id, size_t *triangle)
{
    if (!(id >= 1.0f && id < 2147483648.0f)) {
        return false;
    }
    *triangle = (size_t)id - 1;
    return *triangle < mesh->triangles;
}

/// False without memory, with nothing to free.
bool diff_corners_make(const struct diff_mesh *mesh, struct diff_corners *corners);
void diff_corners_free(struct diff_corners *corners);
/// `rast`: [images][height][width][4]. The same.
bool diff_pixels_make(struct diff_mesh *mesh, const float *rast, struct diff_pixels *pixels);
void diff_pixels_free(struct diff_pixels *pixels);

/// The product; SIZE_MAX, which no array has, where it does not fit.
size_t diff_times(size_t a, size_t b);
/// Reads an array of so many floats; one that is optional may be None, which gives NULL. False with an exception.
bool diff_floats(PyObject *object, const char *name, size_t count, const float **values);
bool diff_floats_optional(PyObject *object, const char *name, size_t count, const float **values);
/// The same of one that is written to.
bool diff_result(PyObject *object, const char *name, size_t count, float **values);
bool diff_result_optional(PyObject *object, const char *name, size_t count, float **values);

#endif
