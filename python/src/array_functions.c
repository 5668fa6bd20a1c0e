// SPDX-License-Identifier: MIT
// What NumPy would do with memory that it takes and gives back each time: rhw.diff makes results and looks through
// arguments at every step of a training, and a third of the time of a step went by in the system's clearing of pages.
#include "memory_object.h"

#include "picture_memory.h"

#include <string.h>

// An element is NaN or infinite where all bits of its exponent are set.
static bool are_finite_32(const void *data, size_t first, size_t end)
{
    const uint32_t *const bits = data, exponent = 0x7f800000;
    uint32_t found = 0;
    for (size_t i = first; i < end; i++) {
        found |= (bits[i] & exponent) == exponent;
    }
    return !found;
}

static bool are_finite_64(const void *data, size_t first, size_t end)
{
    const uint64_t *const bits = data, exponent = 0x7ff0000000000000;
    uint64_t found = 0;
    for (size_t i = first; i < end; i++) {
        found |= (bits[i] & exponent) == exponent;
    }
    return !found;
}

enum { ELEMENTS_OF_LOOK = 1 << 20 };

static PyObject *is_finite(PyObject *module, PyObject *object)
{
    (void)module;
    struct python_array array;
    bool (*are_finite)(const void *data, size_t first, size_t end) = are_finite_32;
    if (!python_array_read(object, "array", "<f4", &array)) {
        PyErr_Clear();
        are_finite = are_finite_64;
        if (!python_array_read(object, "array", "<f8", &array)) {
            return NULL;
        }
    }
    const size_t count = (size_t)array.count;
    struct python_work work = python_work_begin();
    bool good = true;
    for (size_t i = 0; good && i < count && python_work_goes_on(&work); i += ELEMENTS_OF_LOOK) {
        good = are_finite(array.data, i, count - i < ELEMENTS_OF_LOOK ? count : i + ELEMENTS_OF_LOOK);
    }
    PyEval_RestoreThread(work.state);
    return work.gave_up ? NULL : PyBool_FromLong(good);
}

static PyObject *empty(PyObject *module, PyObject *extents)
{
    (void)module;
    struct python_shape shape = {.type = "<f4"};
    size_t bytes = sizeof(float);
    const Py_ssize_t dimensions = python_is_tuple(extents, "shape") ? PyTuple_Size(extents) : -1;
    if (dimensions < 0 || !python_is_choice((int)dimensions, 0, PYTHON_MAX_DIMENSIONS, "shape")) {
        return NULL;
    }
    for (Py_ssize_t i = 0; i < dimensions; i++) {
        const Py_ssize_t extent = PyLong_AsSsize_t(PyTuple_GetItem(extents, i));
        if (PyErr_Occurred()) {
            return NULL;
        }
        if (extent < 0 || (extent > 0 && bytes > PY_SSIZE_T_MAX / (size_t)extent)) {
            return PyErr_NoMemory();
        }
        shape.extent[shape.dimensions++] = extent;
        bytes *= (size_t)extent;
    }
    return python_memory_take_picture(python_picture_allocate(bytes), shape);
}

PyMethodDef python_array_functions[] = {
    {"is_finite", is_finite, METH_O, NULL}, {"empty", empty, METH_O, NULL}, {0}};
