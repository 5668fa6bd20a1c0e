// SPDX-License-Identifier: MIT
// Textures of rhw.diff, read at given coordinates, and that backwards.
#include "diff_mesh.h"
#include "diff_reading.h"

#include <stdlib.h>

struct work {
    struct diff_shape shape;
    struct diff_crew crew;
    size_t images, copies, pixels, channels; // copies: 1 or images; pixels of an image
    const float *level[DIFF_MAX_LEVELS];     // [copies][6 of a cube][height][width][channels]
    const float *uv, *uv_da, *bias;          // uv_da, bias: NULL: none
    float *values;                           // [images][pixels][channels]
    const float *to_values;                  // backwards their gradient
    float *level_gradient[DIFF_MAX_LEVELS], *uv_gradient, *uv_da_gradient, *bias_gradient;
    double *sums[DIFF_MAX_LEVELS];     // as level_gradient, while they are collected
    size_t sum_pitch[DIFF_MAX_LEVELS]; // from row to row
    size_t owners, first_pixel;        // who collects, and the first of the pixels that they collect from
    int finished;                      // level whose sums are written out
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

// Rows of a level, those of a cube's faces one after the other, of one copy of the texture.
static size_t level_rows(const struct work *work, int level)
{
    return diff_level_height(&work->shape, level) * (work->shape.boundary == DIFF_CUBE ? 6 : 1);
}

static size_t row_floats(const struct work *work, int level)
{
    return diff_level_width(&work->shape, level) * work->channels;
}

// The row of a tap among those of all copies.
static size_t tap_row(const struct work *work, int level, size_t image, const struct diff_tap *tap)
{
    return (work->copies == 1 ? 0 : image) * level_rows(work, level) + tap->row;
}

// Floats to a tap's texel, of the texture of an image.
static size_t texel_offset(const struct work *work, int level, size_t image, const struct diff_tap *tap)
{
    return tap_row(work, level, image, tap) * row_floats(work, level) + tap->column * work->channels;
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
    const float *const gradient = work->to_values + place * work->channels;
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

enum {
    PIXELS_OF_BLOCK = 1 << 18
}; // so many that threads have work for milliseconds, between looks for signals

// Every thread goes through all pixels of the block in order, and adds to the texels of its rows alone: to sort what is
// added by texels would take eight times the memory of the picture. The sums are doubles: a float loses what is 2^-24
// of it.
static void collect_rows(void *data, size_t owner)
{
    const struct work *work = data;
    const size_t end = work->first_pixel + PIXELS_OF_BLOCK, all = work->images * work->pixels;
    for (size_t place = work->first_pixel; place < end && place < all; place++) {
        struct diff_reading reading;
        find_texels(work, place, &reading);
        const float *const gradient = work->to_values + place * work->channels;
        for (int j = 0; j < reading.count * DIFF_TAPS; j++) {
            const int i = j / DIFF_TAPS, level = reading.level[i];
            const struct diff_tap *const tap = &reading.tap[i][j % DIFF_TAPS];
            if (!tap->is_there || tap->row % work->owners != owner) {
                continue;
            }
            const double weight = reading.part[i] * tap->weight;
            double *const sum = work->sums[level] +
                                tap_row(work, level, place / work->pixels, tap) * work->sum_pitch[level] +
                                tap->column * work->channels;
            for (size_t c = 0; c < work->channels; c++) {
                sum[c] += weight * gradient[c];
            }
        }
    }
}

static void finish_row(void *data, size_t row)
{
    const struct work *work = data;
    const size_t count = row_floats(work, work->finished);
    const double *const sum = work->sums[work->finished] + row * work->sum_pitch[work->finished];
    float *const gradient = work->level_gradient[work->finished] + row * count;
    for (size_t i = 0; i < count; i++) {
        gradient[i] = (float)sum[i];
    }
}

// False without memory.
static bool collect(struct work *work)
{
    const int levels = work->shape.levels;
    bool good = true;
    for (int l = 0; good && l < levels; l++) {
        work->sums[l] =
            diff_sums(work->copies * level_rows(work, l), row_floats(work, l), &work->sum_pitch[l]);
        good = work->sums[l] != NULL;
    }
    const size_t threads = work->crew.threads > 1 ? (size_t)work->crew.threads : 1;
    work->owners = threads < RHW_MAX_THREADS ? threads : RHW_MAX_THREADS;
    for (; good && work->first_pixel < work->images * work->pixels; work->first_pixel += PIXELS_OF_BLOCK) {
        diff_jobs_run(&work->crew, work->owners, collect_rows, work);
    }
    for (work->finished = 0; good && work->finished < levels; work->finished++) {
        diff_jobs_run(&work->crew, work->copies * level_rows(work, work->finished), finish_row, work);
    }
    for (int l = 0; l < levels; l++) {
        diff_sums_free(work->sums[l], work->copies * level_rows(work, l), work->sum_pitch[l]);
    }
    return good;
}

static size_t pixel_jobs(const struct work *work)
{
    return (work->images * work->pixels + PIXELS_OF_JOB - 1) / PIXELS_OF_JOB;
}

// Arguments ------------------------------------------------------------------------------------------

static size_t level_floats(const struct work *work, int level)
{
    return diff_times(diff_times(work->copies, level_rows(work, level)), row_floats(work, level));
}

static bool check_sizes(const struct work *work, Py_ssize_t levels, int filter, int boundary)
{
    const size_t most = (size_t)1 << 31, size = RHW_MAX_TARGET_SIZE;
    const bool fits = levels >= 1 && levels <= DIFF_MAX_LEVELS && work->shape.height - 1 < size &&
                      work->shape.width - 1 < size && work->channels - 1 < size && work->images - 1 < most &&
                      work->pixels - 1 < most && (work->copies == 1 || work->copies == work->images) &&
                      filter >= DIFF_NEAREST && filter <= DIFF_MIP_LINEAR && boundary >= DIFF_CUBE &&
                      boundary <= DIFF_ZERO &&
                      (boundary != DIFF_CUBE || work->shape.height == work->shape.width);
    if (!fits) {
        PyErr_SetString(PyExc_ValueError, "tex: has sizes or modes that there are none of");
    }
    return fits;
}

// ((levels, copies, height, width, channels, filter, boundary, images, pixels of an image, threads), uv, uv_da or None,
// bias or None, values; backwards their gradient)
static bool read_work(PyObject *arguments, struct work *work, bool backwards)
{
    PyObject *levels, *uv, *uv_da, *bias, *values;
    Py_ssize_t copies, height, width, channels, images, pixels;
    int filter, boundary;
    if (!PyArg_ParseTuple(arguments, "(O!nnnniinni)OOOO:diff_texture", &PyTuple_Type, &levels, &copies,
                          &height, &width, &channels, &filter, &boundary, &images, &pixels,
                          &work->crew.threads, &uv, &uv_da, &bias, &values)) {
        return false;
    }
    work->shape = (struct diff_shape){(size_t)height, (size_t)width, (int)PyTuple_Size(levels),
                                      (enum diff_filter)filter, (enum diff_boundary)boundary};
    work->copies = (size_t)copies;
    work->channels = (size_t)channels;
    work->images = (size_t)images;
    work->pixels = (size_t)pixels;
    if (!check_sizes(work, PyTuple_Size(levels), filter, boundary)) {
        return false;
    }
    for (int l = 0; l < work->shape.levels; l++) {
        if (!diff_floats(PyTuple_GetItem(levels, l), "tex", level_floats(work, l), &work->level[l])) {
            return false;
        }
    }
    const size_t all = work->images * work->pixels, n = dimensions(work);
    const size_t count = diff_times(all, work->channels);
    return diff_floats(uv, "uv", diff_times(n, all), &work->uv) &&
           diff_floats_optional(uv_da, "uv_da", diff_times(2 * n, all), &work->uv_da) &&
           diff_floats_optional(bias, "mip_level_bias", all, &work->bias) &&
           (backwards ? diff_floats(values, "to_values", count, &work->to_values)
                      : diff_result(values, "values", count, &work->values));
}

static PyObject *texture(PyObject *module, PyObject *arguments)
{
    (void)module;
    struct work work = {0};
    if (!read_work(arguments, &work, false)) {
        return NULL;
    }
    diff_crew_begin(&work.crew);
    diff_jobs_run(&work.crew, pixel_jobs(&work), sample_pixels, &work);
    return diff_crew_end(&work.crew, true);
}

// (the arguments of diff_texture, with the gradient of values, gradients of levels, of uv, of uv_da or None, of the
// bias or None)
static PyObject *texture_grad(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *forward, *levels, *uv, *uv_da, *bias;
    struct work work = {0};
    if (!PyArg_ParseTuple(arguments, "O!O!OOO:diff_texture_grad", &PyTuple_Type, &forward, &PyTuple_Type,
                          &levels, &uv, &uv_da, &bias) ||
        !read_work(forward, &work, true)) {
        return NULL;
    }
    const size_t all = work.images * work.pixels, n = dimensions(&work);
    if (PyTuple_Size(levels) != work.shape.levels || (uv_da != Py_None && !work.uv_da)) {
        PyErr_SetString(PyExc_ValueError, "result: must have what the texture has");
        return NULL;
    }
    for (int l = 0; l < work.shape.levels; l++) {
        if (!diff_result(PyTuple_GetItem(levels, l), "result", level_floats(&work, l),
                         &work.level_gradient[l])) {
            return NULL;
        }
    }
    if (!diff_result(uv, "result", diff_times(n, all), &work.uv_gradient) ||
        !diff_result_optional(uv_da, "result", diff_times(2 * n, all), &work.uv_da_gradient) ||
        !diff_result_optional(bias, "result", all, &work.bias_gradient)) {
        return NULL;
    }
    diff_crew_begin(&work.crew);
    diff_jobs_run(&work.crew, pixel_jobs(&work), give_pixels, &work);
    const bool good = collect(&work);
    return diff_crew_end(&work.crew, good);
}

PyMethodDef python_diff_texture_functions[] = {{"diff_texture", texture, METH_VARARGS, NULL},
                                               {"diff_texture_grad", texture_grad, METH_VARARGS, NULL},
                                               {0}};
