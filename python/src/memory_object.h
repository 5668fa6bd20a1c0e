// SPDX-License-Identifier: MIT
// Memory that arrays stand on, out of the extension and into it.
#ifndef PYTHON_MEMORY_OBJECT_H
#define PYTHON_MEMORY_OBJECT_H

#include "extension.h"

enum { PYTHON_MAX_DIMENSIONS = 5 };

/// Elements as __array_interface__ has them.
struct python_shape {
    const char *type; ///< "<f4", "<u4", "|u1", ...; static storage
    int dimensions;
    Py_ssize_t extent[PYTHON_MAX_DIMENSIONS];
};

/// An object that owns `data`, of malloc, also on failure. NULL on failure, or where `data` is NULL.
PyObject *python_memory_take(void *data, struct python_shape shape);
/// The same of a picture's memory (picture_memory.h), which is kept for the next one.
PyObject *python_memory_take_picture(void *data, struct python_shape shape);
/// A part of what `owner` holds, which it keeps alive; arrays on it are read-only.
PyObject *python_memory_of(PyObject *owner, const void *data, struct python_shape shape);
/// Zeroed bytes at a multiple of RHW_MEMORY_ALIGNMENT, one-dimensional. `*data` is their address.
PyObject *python_memory_aligned(size_t size, void **data);

/// An array that was passed in.
struct python_array {
    void *data;       ///< valid while the object lives and is not resized; what calls into here holds it
    Py_ssize_t count; ///< of elements; their bytes fit Py_ssize_t
    bool is_none, is_read_only;
    int dimensions;
    Py_ssize_t extent[PYTHON_MAX_DIMENSIONS];
};

/// Reads an array of that element type whose elements lie one behind the other. False with an exception that names it.
bool python_array_read(PyObject *object, const char *name, const char *type, struct python_array *array);
/// The same where there may be none: None leaves `array` empty, at address 0.
bool python_array_read_optional(PyObject *object, const char *name, const char *type,
                                struct python_array *array);

#endif
