// SPDX-License-Identifier: MIT
// Models from arrays.
#ifndef PYTHON_MODEL_MAKE_H
#define PYTHON_MODEL_MAKE_H

#include "extension.h"

/// make(name, up, meshes, materials, images, instances): tuples of tuples, see model_make.c.
PyObject *python_model_make(PyObject *module, PyObject *arguments);
/// An object that owns the model, also on failure.
PyObject *python_model_take(struct scene_model *model);

#endif
