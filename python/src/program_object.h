// SPDX-License-Identifier: MIT
// Translated shaders that fit together, with what Python is told of them.
#ifndef PYTHON_PROGRAM_OBJECT_H
#define PYTHON_PROGRAM_OBJECT_H

#include "extension.h"

#include <rhw/spirv.h>

/// A buffer, image or sampler of the program. Where both stages name it, it is what serves both.
struct python_program_resource {
    enum rhw_shader_resource_kind kind;
    uint32_t set, binding, count;
    bool is_read_only;
};

/// A program that was linked. It lives as long as its object.
struct python_program {
    rhw_shader_program *handle;
    bool is_compute, has_fragment;
    struct rhw_attribute attributes[RHW_MAX_ATTRIBUTES]; ///< buffer b has input b of the vertex stage
    int attribute_count, buffer_count;
    int target_count;
    struct python_program_resource *resources;
    uint32_t resource_count;
};

/// Return the program of an object, or NULL with an exception where it is none.
const struct python_program *python_program_get(PyObject *object);

#endif
