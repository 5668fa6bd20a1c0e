// SPDX-License-Identifier: MIT
// Textures of rhw.diff, read at given coordinates, and that backwards.
#include "diff_jobs.h"
#include "diff_mesh.h"
#include "diff_reading.h"

struct work {
    struct diff_shape shape;
    size_t images, copies, pixels, channels; // copies: 1 or images; pixels of an image
    float *level[DIFF_MAX_LEVELS];           // [copies][6 of a cube][height][width][channels]
    float *uv, *uv_da, *bias;                // uv_da, bias: NULL: none
    float *values;                           // [images][pixels][channels]; backwards their gradient
    float *level_gradient[DIFF_MAX_LEVELS], *uv_gradient, *uv_da_gradient, *bias_gradient;
    int threads;
};

static size_t dimensions(const struct work *work)
{
    return work->shape.boundary == DIFF_CUBE ? 3 : 2;
}

static void find_texels(const struct work *work, size_t place, struct diff_reading *reading)
{
    const size_t n = dimensions(work);
    diff_read(&work->shape, work->uv + n * place, work->uv_da ? work->uv_da + 2 * n * place : NULL,
              work->bias ? work->bias[place] : 0.0f, reading);
}

// Floats to a tap's texel, of the texture of an image.
static size_t texel_offset(const struct work *work, int level, size_t image, const struct diff_tap *tap)
{
    const size_t width = diff_level_width(&work->shape, level);
    const size_t rows = diff_level_height(&work->shape, level) * (work->shape.boundary == DIFF_CUBE ? 6 : 1);
    const size_t copy = work->copies == 1 ? 0 : image;
    return ((copy * rows + tap->row) * width + tap->column) * work->channels;
}

static void sample_pixel(const struct work *work, size_t place)
{
    struct diff_reading reading;
    float *const values = work->values + place * work->channels;
    find_texels(work, place, &reading);
    for (size_t c = 0; c < work->channels; c++) {
        double sum = 0;
        for (int i = 0; i < reading.count; i++) {
            for (int k = 0; k < DIFF_TAPS; k++) {
                const struct diff_tap *const tap = &reading.tap[i][k];
                if (tap->is_there) {
                    const size_t offset = texel_offset(work, reading.level[i], place / work->pixels, tap);
                    sum += reading.part[i] * tap->weight * work->level[reading.level[i]][offset + c];
                }
            }
        }
        values[c] = (float)sum;
    }
}

static void give_pixel(const struct work *work, size_t place)
{
    struct diff_reading reading;
    const float *const gradient = work->values + place * work->channels;
    const size_t n = dimensions(work);
    double to_st[2] = {0}, value[2] = {0};
    find_texels(work, place, &reading);
    for (int i = 0; i < reading.count; i++) {
        for (int k = 0; k < DIFF_TAPS; k++) {
            const struct diff_tap *const tap = &reading.tap[i][k];
            if (!tap->is_there) {
                continue;
            }
            const float *const texel = work->level[reading.level[i]] +
                                       texel_offset(work, reading.level[i], place / work->pixels, tap);
            double sum = 0;
            for (size_t c = 0; c < work->channels; c++) {
                sum += (double)gradient[c] * texel[c];
            }
            value[i] += tap->weight * sum;
            to_st[0] += reading.part[i] * tap->along_s * sum;
            to_st[1] += reading.part[i] * tap->along_t * sum;
        }
    }
    const double to_level = reading.level_moves ? value[1] - value[0] : 0;
    diff_read_back(&work->shape, &reading, work->uv_da ? work->uv_da + 2 * n * place : NULL, to_st, to_level,
                   work->uv_gradient + n * place,
                   work->uv_da_gradient ? work->uv_da_gradient + 2 * n * place : NULL);
    if (work->bias_gradient) {
        work->bias_gradient[place] = (float)to_level;
    }
}

enum { PIXELS_OF_JOB = 2048 };

static void for_pixels(const struct work *work, size_t job,
                       void (*function)(const struct work *, size_t place))
{
    const size_t end = (job + 1) * PIXELS_OF_JOB, all = work->images * work->pixels;
    for (size_t place = job * PIXELS_OF_JOB; place < end && place < all; place++) {
        function(work, place);
    }
}

static void sample_pixels(void *data, size_t job)
{
    for_pixels(data, job, sample_pixel);
}

static void give_pixels(void *data, size_t job)
{
    for_pixels(data, job, give_pixel);
}

// Every thread goes through all pixels in order, and adds to the texels of its rows alone: to sort what is added by texels
// would take eight times the memory of the picture.
static void collect_rows(void *data, size_t owner)
{
    const struct work *work = data;
    for (size_t place = 0; place < work->images * work->pixels; place++) {
        struct diff_reading reading;
        find_texels(work, place, &reading);
        const float *const gradient = work->values + place * work->channels;
        for (int j = 0; j < reading.count * DIFF_TAPS; j++) {
            const int i = j / DIFF_TAPS;
            const struct diff_tap *const tap = &reading.tap[i][j % DIFF_TAPS];
            if (!tap->is_there || tap->row % (size_t)work->threads != owner) {
                continue;
            }
            const float weight = (float)(reading.part[i] * tap->weight);
            float *const texel = work->level_gradient[reading.level[i]] +
                                 texel_offset(work, reading.level[i], place / work->pixels, tap);
            for (size_t c = 0; c < work->channels; c++) {
                texel[c] += weight * gradient[c];
            }
        }
    }
}

static size_t pixel_jobs(const struct work *work)
{
    return (work->images * work->pixels + PIXELS_OF_JOB - 1) / PIXELS_OF_JOB;
}

// Arguments ------------------------------------------------------------------------------------------

static bool read_levels(PyObject *tuple, const struct work *work, float *level[DIFF_MAX_LEVELS])
{
    for (int l = 0; l < work->shape.levels; l++) {
        const size_t faces = work->shape.boundary == DIFF_CUBE ? 6 : 1;
        const size_t count = work->copies * faces * diff_level_height(&work->shape, l) *
                             diff_level_width(&work->shape, l) * work->channels;
        if (!diff_floats(PyTuple_GetItem(tuple, l), "tex", count, &level[l])) {
            return false;
        }
    }
    return true;
}

static bool check_sizes(const struct work *work, Py_ssize_t levels)
{
    const size_t most = (size_t)1 << 31, size = RHW_MAX_TARGET_SIZE;
    const bool fits = levels >= 1 && levels <= DIFF_MAX_LEVELS && work->shape.height - 1 < size &&
                      work->shape.width - 1 < size && work->channels - 1 < size && work->images - 1 < most &&
                      work->pixels - 1 < most && (work->copies == 1 || work->copies == work->images) &&
                      work->threads >= 1 && work->shape.filter <= DIFF_MIP_LINEAR &&
                      work->shape.boundary <= DIFF_ZERO &&
                      (work->shape.boundary != DIFF_CUBE || work->shape.height == work->shape.width);
    if (!fits) {
        PyErr_SetString(PyExc_ValueError, "tex: too large");
    }
    return fits;
}

// ((levels, copies, height, width, channels, filter, boundary, images, pixels of an image, threads), uv, uv_da or None,
// bias or None, values)
static bool read_work(PyObject *arguments, struct work *work)
{
    PyObject *levels, *uv, *uv_da, *bias, *values;
    Py_ssize_t copies, height, width, channels, images, pixels;
    int filter, boundary;
    if (!PyArg_ParseTuple(arguments, "(O!nnnniinni)OOOO:diff_texture", &PyTuple_Type, &levels, &copies,
                          &height, &width, &channels, &filter, &boundary, &images, &pixels, &work->threads,
                          &uv, &uv_da, &bias, &values)) {
        return false;
    }
    work->shape = (struct diff_shape){(size_t)height, (size_t)width, (int)PyTuple_Size(levels),
                                      (enum diff_filter)filter, (enum diff_boundary)boundary};
    work->copies = (size_t)copies;
    work->channels = (size_t)channels;
    work->images = (size_t)images;
    work->pixels = (size_t)pixels;
    if (!check_sizes(work, PyTuple_Size(levels))) {
        return false;
    }
    const size_t all = work->images * work->pixels, n = dimensions(work);
    return read_levels(levels, work, work->level) && diff_floats(uv, "uv", n * all, &work->uv) &&
           diff_floats_optional(uv_da, "uv_da", 2 * n * all, &work->uv_da) &&
           diff_floats_optional(bias, "mip_level_bias", all, &work->bias) &&
           diff_floats(values, "values", all * work->channels, &work->values);
}

static PyObject *texture(PyObject *module, PyObject *arguments)
{
    (void)module;
    struct work work = {0};
    if (!read_work(arguments, &work)) {
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS diff_jobs_run(work.threads, pixel_jobs(&work), sample_pixels, &work);
    Py_END_ALLOW_THREADS Py_INCREF(Py_None);
    return Py_None;
}

// (the arguments of diff_texture, with the gradient of values, gradients of levels, zeroed, of uv, of uv_da or None, of the
// bias or None)
static PyObject *texture_grad(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *forward, *levels, *uv, *uv_da, *bias;
    struct work work = {0};
    if (!PyArg_ParseTuple(arguments, "O!O!OOO:diff_texture_grad", &PyTuple_Type, &forward, &PyTuple_Type,
                          &levels, &uv, &uv_da, &bias) ||
        !read_work(forward, &work)) {
        return NULL;
    }
    const size_t all = work.images * work.pixels, n = dimensions(&work);
    if (PyTuple_Size(levels) != work.shape.levels || (uv_da != Py_None && !work.uv_da)) {
        PyErr_SetString(PyExc_ValueError, "result: must have what the texture has");
        return NULL;
    }
    if (!read_levels(levels, &work, work.level_gradient) ||
        !diff_floats(uv, "result", n * all, &work.uv_gradient) ||
        !diff_floats_optional(uv_da, "result", 2 * n * all, &work.uv_da_gradient) ||
        !diff_floats_optional(bias, "result", all, &work.bias_gradient)) {
        return NULL;
    }
    Py_BEGIN_ALLOW_THREADS diff_jobs_run(work.threads, pixel_jobs(&work), give_pixels, &work);
    diff_jobs_run(work.threads, (size_t)work.threads, collect_rows, &work);
    Py_END_ALLOW_THREADS Py_INCREF(Py_None);
    return Py_None;
}

PyMethodDef python_diff_texture_functions[] = {{"diff_texture", texture, METH_VARARGS, NULL},
                                               {"diff_texture_grad", texture_grad, METH_VARARGS, NULL},
                                               {0}};
