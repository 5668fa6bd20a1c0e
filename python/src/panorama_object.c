// SPDX-License-Identifier: MIT
// A panorama is read once and lights any number of pictures. A scene knows by its address whether it is lit by the same
// one as before, so an object never gets other texels.
#include "panorama_object.h"

#include "memory_object.h"
#include "panorama_reading.h"

#include "panorama_load.h"

#include <stdlib.h>
#include <string.h>

struct panorama {
    PyObject ob_base;
    struct scene_panorama panorama;
};

static PyTypeObject *panorama_type;

const struct scene_panorama *python_panorama_get(PyObject *object)
{
    if (Py_TYPE(object) == panorama_type) {
        return &((struct panorama *)object)->panorama;
    }
    PyErr_SetString(PyExc_TypeError, "environment: must be a panorama");
    return NULL;
}

static void panorama_free(PyObject *self)
{
    free(((struct panorama *)self)->panorama.texels);
    python_free(self);
}

static PyObject *take(struct scene_panorama panorama)
{
    struct panorama *object = PyObject_New(struct panorama, panorama_type);
    if (object) {
        object->panorama = panorama;
    } else {
        free(panorama.texels);
    }
    return (PyObject *)object;
}

// (path)
static PyObject *panorama_read(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *path;
    char *name;
    if (!PyArg_ParseTuple(arguments, "O!:panorama_read", &PyBytes_Type, &path) ||
        PyBytes_AsStringAndSize(path, &name, NULL) < 0) {
        return NULL;
    }
    struct scene_panorama panorama = {0};
    return python_panorama_load(name, &panorama) ? take(panorama) : NULL;
}

// (texels): rows, columns, R G B A in floats
static PyObject *panorama(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *object;
    struct python_array texels;
    if (!PyArg_ParseTuple(arguments, "O:panorama", &object) ||
        !python_array_read(object, "environment", "<f4", &texels)) {
        return NULL;
    }
    if (texels.count == 0 || texels.dimensions != 3 || texels.extent[2] != 4 ||
        texels.extent[0] > RHW_MAX_TARGET_SIZE || texels.extent[1] > RHW_MAX_TARGET_SIZE) {
        PyErr_Format(PyExc_ValueError, "environment: must have 1 to %d rows and columns of 4 channels",
                     RHW_MAX_TARGET_SIZE);
        return NULL;
    }
    const size_t size = (size_t)texels.count * sizeof(float);
    struct scene_panorama made = {(int)texels.extent[1], (int)texels.extent[0], malloc(size)};
    if (!made.texels) {
        return PyErr_NoMemory();
    }
    memcpy(made.texels, texels.data, size);
    cli_panorama_clean(&made);
    return take(made);
}

// (panorama): its texels
static PyObject *panorama_texels(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *object;
    const struct scene_panorama *p;
    if (!PyArg_ParseTuple(arguments, "O:panorama_texels", &object) || !(p = python_panorama_get(object))) {
        return NULL;
    }
    return python_memory_of(object, p->texels, (struct python_shape){"<f4", 3, {p->height, p->width, 4}});
}

PyMethodDef python_panorama_functions[] = {{"panorama", panorama, METH_VARARGS, NULL},
                                           {"panorama_read", panorama_read, METH_VARARGS, NULL},
                                           {"panorama_texels", panorama_texels, METH_VARARGS, NULL},
                                           {0}};

int python_add_panoramas(PyObject *module)
{
    static PyType_Slot slots[] = {{Py_tp_new, (void *)(uintptr_t)python_refuse_new},
                                  {Py_tp_dealloc, (void *)(uintptr_t)panorama_free},
                                  {0, NULL}};
    static PyType_Spec spec = {.name = "rhw._rhw.Panorama",
                               .basicsize = sizeof(struct panorama),
                               .flags = Py_TPFLAGS_DEFAULT,
                               .slots = slots};
    panorama_type = python_add_type(module, "Panorama", &spec);
    return panorama_type ? 0 : -1;
}
