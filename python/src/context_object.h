// SPDX-License-Identifier: MIT
// A context of the library, for any number of Python threads: they take turns.
#ifndef PYTHON_CONTEXT_OBJECT_H
#define PYTHON_CONTEXT_OBJECT_H

#include "extension.h"

enum python_item_kind {
    PYTHON_ITEM_BUFFER,
    PYTHON_ITEM_TEXTURE,
    PYTHON_ITEM_SAMPLER,
    PYTHON_ITEM_PIPELINE,
    PYTHON_ITEM_SCENE,
    PYTHON_ITEM_PASS, ///< that is recorded; destroyed: cancelled
    PYTHON_ITEM_RECORDING
};

/// Something in a context that a Python object owns.
struct python_item {
    struct python_item *next; ///< in the list of those that wait to be destroyed
    enum python_item_kind kind;
    union {
        rhw_buffer buffer;
        rhw_texture texture;
        rhw_sampler sampler;
        rhw_pipeline pipeline;
        struct scene *scene;
        rhw_pass pass;
        rhw_recording *recording;
    } id;
    rhw_context *recorder; ///< of a pass that is to be run again, destroyed with it; may be NULL
    PyObject *kept;        ///< lives until the item is destroyed; may be NULL
    PyObject *panorama;    ///< whose light a scene has: the same; may be NULL
    void *block;           ///< of malloc: the same
};

/// Whether it is a context; else with an exception.
bool python_context_check(PyObject *context);
/// Waits for the turn, without the interpreter's lock. NULL with an exception where it cannot come.
rhw_context *python_context_enter(PyObject *context);
/// Ends the turn. False with an exception where the library was misused meanwhile, or `result` is a failure.
bool python_context_leave(PyObject *context, enum rhw_result result);
/// Destroys the item now or, where another thread has its turn, when that ends. Of the calling process's contexts only.
void python_context_destroy_item(PyObject *context, struct python_item *item);

#endif
