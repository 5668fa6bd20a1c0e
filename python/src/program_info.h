// SPDX-License-Identifier: MIT
// What a shader tells about itself, as tuples. _rhw.pyi names their elements.
#ifndef PYTHON_PROGRAM_INFO_H
#define PYTHON_PROGRAM_INFO_H

#include "extension.h"

#include <rhw/spirv.h>

/// Return (inputs, outputs, push constants or None), or NULL with an exception. `told` is a dictionary, which keeps the
/// types that were told, so that a type of many places is told once.
PyObject *python_program_stage(const struct rhw_shader_info *info, PyObject *told);
/// Return (kind, set, binding, count, name, size, is read only, type or None, is a plain image, has whole numbers), or
/// NULL with an exception.
PyObject *python_program_resource(const struct rhw_shader_resource *resource, PyObject *told);

#endif
