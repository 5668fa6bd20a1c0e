// SPDX-License-Identifier: MIT
// Panoramas that light models.
#ifndef PYTHON_PANORAMA_OBJECT_H
#define PYTHON_PANORAMA_OBJECT_H

#include "extension.h"

#include "draw/panorama.h"

/// NULL with an exception where the object is none. Never changes, and lives as long as the object.
const struct scene_panorama *python_panorama_get(PyObject *object);

#endif
