// SPDX-License-Identifier: MIT
// Pictures as the bytes of files, by the encoders of the program: what is written from Python is what `rhw render`
// writes. They report failure through cli_error, which the program prints; here it becomes an exception.
#include "camera_numbers.h"
#include "memory_object.h"
#include "model_object.h"
#include "picture_fields.h"

#include "message.h"
#include "outputs.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static _Thread_local char problem[512]; // what an encoder reported on this thread; "" for nothing

void cli_error(const char *subject, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int used = snprintf(problem, sizeof problem, "%s: ", subject);
    if (used >= 0 && (size_t)used < sizeof problem) {
        vsnprintf(problem + used, sizeof problem - (size_t)used, format, arguments);
    }
    va_end(arguments);
}

// Encodes into memory without the interpreter's lock.
struct encoding {
    bool (*write)(struct cli_output_file *file, const void *user);
    const void *user;
};

static PyObject *encode(const struct encoding *encoding, const char *name)
{
    char *bytes = NULL;
    size_t size = 0;
    bool written = false;
    problem[0] = 0;
    Py_BEGIN_ALLOW_THREADS struct cli_output_file file = {.stream = open_memstream(&bytes, &size),
                                                          .path = name};
    if (file.stream) {
        written = encoding->write(&file, encoding->user);
        written = fclose(file.stream) == 0 && written;
    }
    Py_END_ALLOW_THREADS PyObject *result = NULL;
    if (written) {
        result = PyBytes_FromStringAndSize(bytes, (Py_ssize_t)size);
    } else {
        PyErr_SetString(python_error, problem[0] ? problem : "there is not enough memory for the file");
    }
    free(bytes);
    return result;
}

static bool write_png(struct cli_output_file *file, const void *user)
{
    return cli_png_write(file, user);
}

// Arrays as they are --------------------------------------------------------------------------------

struct plain {
    struct cli_raster raster;
    const uint8_t *texels;
    size_t row_bytes;
};

static void plain_row(const void *user, int y, void *row)
{
    const struct plain *plain = user;
    memcpy(row, plain->texels + (size_t)y * plain->row_bytes, plain->row_bytes);
}

// (name, texels, bits, srgb): rows of pixels of 1, 3 or 4 samples
static PyObject *encode_png(PyObject *module, PyObject *arguments)
{
    (void)module;
    const char *name;
    PyObject *object;
    int bits, srgb;
    struct python_array texels;
    if (!PyArg_ParseTuple(arguments, "sOip:encode_png", &name, &object, &bits, &srgb) ||
        !python_array_read(object, "image", bits == 16 ? "<u2" : "|u1", &texels)) {
        return NULL;
    }
    const Py_ssize_t channels = texels.dimensions == 3 ? texels.extent[2] : 0;
    if (texels.count == 0 || (channels != 1 && channels != 3 && channels != 4) ||
        texels.extent[0] > RHW_MAX_TARGET_SIZE || texels.extent[1] > RHW_MAX_TARGET_SIZE) {
        PyErr_Format(PyExc_ValueError, "image: must have 1 to %d rows and columns of 1, 3 or 4 channels",
                     RHW_MAX_TARGET_SIZE);
        return NULL;
    }
    struct plain plain = {.raster = {.width = (int)texels.extent[1],
                                     .height = (int)texels.extent[0],
                                     .channels = (int)channels,
                                     .bits = bits,
                                     .srgb = srgb != 0,
                                     .row = plain_row},
                          .texels = texels.data,
                          .row_bytes = (size_t)(texels.extent[1] * channels * (bits / 8))};
    plain.raster.user = &plain;
    return encode(&(struct encoding){write_png, &plain.raster}, name);
}

// Pictures of a render ------------------------------------------------------------------------------

// The arrays of the dictionary, which it keeps alive, as pictures of that size. False with an exception.
static bool read_pictures(PyObject *dictionary, struct scene_pictures *p)
{
    struct python_picture_field kinds[PYTHON_PICTURES];
    python_picture_fields(p, kinds);
    for (int i = 0; i < PYTHON_PICTURES; i++) {
        PyObject *object = PyDict_GetItemString(dictionary, kinds[i].name);
        struct python_array array;
        if (!object) {
            continue;
        }
        if (!python_array_read(object, kinds[i].name, kinds[i].type, &array)) {
            return false;
        }
        if (array.count != (Py_ssize_t)p->width * p->height * kinds[i].channels) {
            PyErr_Format(PyExc_ValueError, "%s: must be of %d by %d pixels with %d channels", kinds[i].name,
                         p->width, p->height, kinds[i].channels);
            return false;
        }
        *kinds[i].texels = array.data;
    }
    return true;
}

// Whether what those kinds are made of is there. False with an exception.
static bool has_pictures(struct scene_pictures *p, uint32_t needed)
{
    struct python_picture_field kinds[PYTHON_PICTURES];
    python_picture_fields(p, kinds);
    for (int i = 0; i < PYTHON_PICTURES; i++) {
        if ((needed & kinds[i].output) && !*kinds[i].texels) {
            PyErr_Format(PyExc_ValueError, "outputs: '%s', which the file is made of, was not drawn",
                         kinds[i].name);
            return false;
        }
    }
    return true;
}

// (name, pictures, (width, height), kind, bits or 0, transparent, bounds_min, bounds_max): `kind` is an output of the
// program
static PyObject *encode_output(PyObject *module, PyObject *arguments)
{
    (void)module;
    const char *name;
    PyObject *dictionary;
    int kind, bits, transparent;
    float low[3], high[3];
    struct scene_pictures pictures = {0};
    if (!PyArg_ParseTuple(arguments, "sO!(ii)iip(fff)(fff):encode_output", &name, &PyDict_Type, &dictionary,
                          &pictures.width, &pictures.height, &kind, &bits, &transparent, &low[0], &low[1],
                          &low[2], &high[0], &high[1], &high[2]) ||
        !read_pictures(dictionary, &pictures) ||
        !has_pictures(&pictures, cli_outputs_needed(1u << kind, CLI_PICTURE_PNG, bits))) {
        return NULL;
    }
    struct cli_output_raster output;
    cli_output_rasterize(&output, &pictures, (enum cli_output_kind)kind, bits, transparent != 0, low, high);
    return encode(&(struct encoding){write_png, &output.raster}, name);
}

struct exr {
    struct scene_pictures pictures;
    struct cli_exr_channel channels[CLI_EXR_CHANNELS_MAX];
    int channel_count, threads;
    struct cli_exr_about about;
};

static bool write_exr(struct cli_output_file *file, const void *user)
{
    const struct exr *exr = user;
    return cli_exr_write(file, exr->pictures.width, exr->pictures.height, exr->channels, exr->channel_count,
                         exr->about.objects ? &exr->about : NULL, exr->threads);
}

// (name, pictures, (width, height), kinds, camera, model, threads)
static PyObject *encode_exr(PyObject *module, PyObject *arguments)
{
    (void)module;
    const char *name;
    PyObject *dictionary, *camera_tuple, *object;
    unsigned kinds;
    struct exr exr = {0};
    struct scene_camera camera;
    const struct scene_model *model;
    if (!PyArg_ParseTuple(arguments, "sO!(ii)IOOi:encode_exr", &name, &PyDict_Type, &dictionary,
                          &exr.pictures.width, &exr.pictures.height, &kinds, &camera_tuple, &object,
                          &exr.threads) ||
        !read_pictures(dictionary, &exr.pictures) ||
        !has_pictures(&exr.pictures, cli_outputs_needed(kinds, CLI_PICTURE_EXR, 0)) ||
        !python_camera_read(camera_tuple, &camera) || !(model = python_model_get(object))) {
        return NULL;
    }
    exr.channel_count = cli_outputs_exr_channels(&exr.pictures, kinds, exr.channels);
    if (!cli_outputs_exr_describe(model, &camera, (double)exr.pictures.width / exr.pictures.height,
                                  &exr.about)) {
        return PyErr_NoMemory();
    }
    PyObject *bytes = encode(&(struct encoding){write_exr, &exr}, name);
    free(exr.about.objects);
    return bytes;
}

PyMethodDef python_encode_functions[] = {{"encode_png", encode_png, METH_VARARGS, NULL},
                                         {"encode_output", encode_output, METH_VARARGS, NULL},
                                         {"encode_exr", encode_exr, METH_VARARGS, NULL},
                                         {0}};
