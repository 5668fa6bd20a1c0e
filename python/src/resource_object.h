// SPDX-License-Identifier: MIT
// Buffers, textures, samplers and pipelines.
#ifndef PYTHON_RESOURCE_OBJECT_H
#define PYTHON_RESOURCE_OBJECT_H

#include "context_object.h"

/// The item of a Resource of that kind and context; NULL with an exception that names the argument where it is none.
const struct python_item *python_resource_get(PyObject *object, PyObject *context, enum python_item_kind kind,
                                              const char *name);

/// Whether it is a Resource.
bool python_is_resource(PyObject *object);

/// Of a buffer.
size_t python_resource_bytes(PyObject *resource);

#endif
