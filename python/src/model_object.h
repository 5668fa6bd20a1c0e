// SPDX-License-Identifier: MIT
// A model that was read or made.
#ifndef PYTHON_MODEL_OBJECT_H
#define PYTHON_MODEL_OBJECT_H

#include "extension.h"

/// The model of a Model, which keeps it alive; NULL with an exception where it is none.
const struct scene_model *python_model_get(PyObject *object);

#endif
