// SPDX-License-Identifier: MIT
// Cameras as tuples of numbers.
#ifndef PYTHON_CAMERA_NUMBERS_H
#define PYTHON_CAMERA_NUMBERS_H

#include "extension.h"

/// Reads ((x, y, z) eye, target, up, orthographic, yfov, ymag, znear, zfar, stretch, (x, y) shift), the members of
/// struct scene_camera. False with an exception.
bool python_camera_read(PyObject *tuple, struct scene_camera *camera);

#endif
