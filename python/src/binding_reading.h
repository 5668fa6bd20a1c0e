// SPDX-License-Identifier: MIT
// What Python gives a program for one draw or dispatch.
#ifndef PYTHON_BINDING_READING_H
#define PYTHON_BINDING_READING_H

#include "context_object.h"
#include "program_object.h"

#include <rhw/bind.h>

/// The bindings and push constants of a draw, with the objects that they need.
struct python_bindings {
    struct rhw_shader_frame frame;
    PyObject *memory; ///< what the frame points to
    PyObject *kept;   ///< list of what the bindings are made of
    struct python_binding_request *requests;
    Py_ssize_t count;
};

/// Read ((place of the resource, element, object, other), ...) and the push constants. It runs code of Python's, and
/// does not ask the context. Return false with an exception; the bindings are to be freed in either case.
///
/// Objects: a Resource or an array of "|u1" of buffers; a texture and a sampler of sampled textures; a texture or a
/// sampler of others; an array and the number of a format of texel buffers. `other` is None elsewhere.
bool python_bindings_read(PyObject *context, const struct python_program *program, PyObject *tuple,
                          PyObject *push, struct python_bindings *bindings);
/// Make the bindings, within the context.
enum rhw_result python_bindings_make(rhw_context *context, const struct python_bindings *bindings);
void python_bindings_free(struct python_bindings *bindings);

#endif
