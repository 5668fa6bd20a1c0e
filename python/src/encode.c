// SPDX-License-Identifier: MIT
// Pictures as the bytes of files, by the encoders of the program: what is written from Python is what `rhw render`
// writes.
#include "camera_numbers.h"
#include "memory_object.h"
#include "model_object.h"
#include "picture_fields.h"
#include "problem.h"

#include "outputs.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Encodes into memory without the interpreter's lock, and looks for signals meanwhile.
struct encoding {
    bool (*write)(struct cli_output_file *file, const void *user);
    const void *user;
};

static PyObject *encode(const struct encoding *encoding, const char *name)
{
    char *bytes = NULL;
    size_t size = 0;
    bool written = false;
    python_problem_forget();
    struct python_work work = python_work_begin();
    struct cli_output_file file = {
        .stream = open_memstream(&bytes, &size), .path = name, .goes_on = python_work_goes_on, .user = &work};
    if (file.stream) {
        written = encoding->write(&file, encoding->user);
        written = fclose(file.stream) == 0 && written;
    }
    PyEval_RestoreThread(work.state);
    PyObject *result = NULL;
    if (work.gave_up) {
        // The handler's exception is there.
    } else if (written) {
        result = PyBytes_FromStringAndSize(bytes, (Py_ssize_t)size);
    } else {
        const char *const problem = python_problem();
        PyErr_SetString(python_error, problem[0] ? problem : "there is not enough memory for the file");
    }
    free(bytes);
    return result;
}

static bool write_png(struct cli_output_file *file, const void *user)
{
    return cli_png_write(file, user);
}

// Whether samples of a file may have so many bits. False with an exception.
static bool is_depth(int bits, bool may_be_default)
{
    if (bits != 8 && bits != 16 && !(may_be_default && bits == 0)) {
        PyErr_Format(PyExc_ValueError, "bits: must be 8 or 16, not %d", bits);
        return false;
    }
    return true;
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
        !is_depth(bits, false) || !python_array_read(object, "image", bits == 16 ? "<u2" : "|u1", &texels)) {
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

static bool read_picture(PyObject *object, int kind, struct scene_pictures *p)
{
    struct python_array array;
    const char *const name = scene_outputs[kind].name;
    const int channels = scene_output_channels((enum scene_output_kind)kind);
    if (!python_array_read(object, name, python_output_type(kind), &array)) {
        return false;
    }
    if (array.count != (Py_ssize_t)p->width * p->height * channels) {
        PyErr_Format(PyExc_ValueError, "%s: must be of %d by %d pixels with %d channels", name, p->width,
                     p->height, channels);
        return false;
    }
    scene_picture_set(p, (enum scene_output_kind)kind, array.data);
    return true;
}

// A copy of the dictionary, which keeps its arrays alive whatever others do to the dictionary, as pictures of that
// size. NULL with an exception.
static PyObject *read_pictures(PyObject *dictionary, struct scene_pictures *p)
{
    if (p->width < 1 || p->height < 1 || p->width > RHW_MAX_TARGET_SIZE || p->height > RHW_MAX_TARGET_SIZE) {
        PyErr_Format(PyExc_ValueError, "size: width and height must lie between 1 and %d",
                     RHW_MAX_TARGET_SIZE);
        return NULL;
    }
    PyObject *const copy = PyDict_Copy(dictionary);
    for (int kind = 0; copy && kind < SCENE_KIND_COUNT; kind++) {
        PyObject *object =
            python_has_output(kind) ? PyDict_GetItemString(copy, scene_outputs[kind].name) : NULL;
        if (object && !read_picture(object, kind, p)) {
            Py_DECREF(copy);
            return NULL;
        }
    }
    return copy;
}

// Whether what those kinds are made of is there. False with an exception.
static bool has_pictures(struct scene_pictures *p, uint32_t needed)
{
    for (int kind = 0; kind < SCENE_KIND_COUNT; kind++) {
        if ((needed & scene_outputs[kind].output) && !scene_picture_get(p, (enum scene_output_kind)kind)) {
            PyErr_Format(PyExc_ValueError, "outputs: '%s', which the file is made of, was not drawn",
                         scene_outputs[kind].name);
            return false;
        }
    }
    return true;
}

// (name, pictures, (width, height), kind, bits or 0, transparent, bounds_min, bounds_max, origin): `kind` is an output
// of the program
static PyObject *encode_output(PyObject *module, PyObject *arguments)
{
    (void)module;
    const char *name;
    PyObject *dictionary, *kept, *bytes = NULL;
    int kind, bits, transparent;
    float low[3], high[3];
    struct scene_pictures pictures = {0};
    if (!PyArg_ParseTuple(arguments, "sO!(ii)iip(fff)(fff)(ddd):encode_output", &name, &PyDict_Type,
                          &dictionary, &pictures.width, &pictures.height, &kind, &bits, &transparent, &low[0],
                          &low[1], &low[2], &high[0], &high[1], &high[2], &pictures.origin[0],
                          &pictures.origin[1], &pictures.origin[2]) ||
        !python_is_choice(kind, SCENE_KIND_COLOR, SCENE_KIND_BARYCENTRIC, "output") ||
        !is_depth(bits, true) || !(kept = read_pictures(dictionary, &pictures))) {
        return NULL;
    }
    if (has_pictures(&pictures, cli_outputs_needed(1u << kind, CLI_PICTURE_PNG, bits))) {
        struct cli_output_raster output;
        cli_output_rasterize(&output, &pictures, (enum scene_output_kind)kind, bits, transparent != 0, low,
                             high);
        bytes = encode(&(struct encoding){write_png, &output.raster}, name);
    }
    Py_DECREF(kept);
    return bytes;
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
                         &exr->about, exr->threads);
}

// Whether those are outputs of a model, one at least. False with an exception.
static bool is_set(unsigned kinds)
{
    if (kinds == 0 || kinds >= 1u << (SCENE_KIND_BARYCENTRIC + 1)) {
        PyErr_SetString(PyExc_ValueError, "outputs: none, or unknown ones, asked for");
        return false;
    }
    return true;
}

// (name, pictures, (width, height), kinds, camera, model, threads, origin)
static PyObject *encode_exr(PyObject *module, PyObject *arguments)
{
    (void)module;
    const char *name;
    PyObject *dictionary, *camera_tuple, *object, *kept, *bytes = NULL;
    unsigned kinds;
    struct exr exr = {0};
    struct scene_camera camera;
    const struct scene_model *model;
    if (!PyArg_ParseTuple(arguments, "sO!(ii)IOOi(ddd):encode_exr", &name, &PyDict_Type, &dictionary,
                          &exr.pictures.width, &exr.pictures.height, &kinds, &camera_tuple, &object,
                          &exr.threads, &exr.pictures.origin[0], &exr.pictures.origin[1],
                          &exr.pictures.origin[2]) ||
        !python_is_choice(exr.threads, 0, RHW_MAX_THREADS, "threads") || !is_set(kinds) ||
        !python_camera_read(camera_tuple, &camera) || !(model = python_model_get(object)) ||
        !(kept = read_pictures(dictionary, &exr.pictures))) {
        return NULL;
    }
    if (has_pictures(&exr.pictures, cli_outputs_needed(kinds, CLI_PICTURE_EXR, 0))) {
        const double aspect = (double)exr.pictures.width / exr.pictures.height;
        float *positions;
        exr.channel_count = cli_outputs_exr_channels(&exr.pictures, kinds, exr.channels, &positions);
        bytes = exr.channel_count > 0 &&
                        cli_outputs_exr_describe(model, &camera, aspect, exr.pictures.origin, &exr.about)
                    ? encode(&(struct encoding){write_exr, &exr}, name)
                    : PyErr_NoMemory();
        free(exr.about.objects);
        free(positions);
    }
    Py_DECREF(kept);
    return bytes;
}

PyMethodDef python_encode_functions[] = {{"encode_png", encode_png, METH_VARARGS, NULL},
                                         {"encode_output", encode_output, METH_VARARGS, NULL},
                                         {"encode_exr", encode_exr, METH_VARARGS, NULL},
                                         {0}};
