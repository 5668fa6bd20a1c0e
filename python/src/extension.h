// SPDX-License-Identifier: MIT
// What the files of the extension share. The extension is thin: it has the objects that hold memory of the library, and
// functions that draw without the interpreter's lock. Names, defaults and the checks of arguments that a user sees
// stand in the Python modules above it, so that what is here says no more than which argument it cannot take. But it
// takes nothing on trust other than the address of an array, so that no call crashes, whoever makes it.
//
// It keeps to the limited API of CPython 3.9, so that one binary serves every later one. The buffer protocol joined
// that in 3.11; arrays therefore pass both ways by __array_interface__, a dictionary with an address, which NumPy
// gives and takes without a copy. DLPack and buffers of others are NumPy's to convert, in rhw/_arrays.py.
#ifndef PYTHON_EXTENSION_H
#define PYTHON_EXTENSION_H

#define PY_SSIZE_T_CLEAN
#include <Python.h>

#include "draw/draw.h"

extern PyObject *python_error; ///< rhw.Error

/// Makes a type of a specification and adds it to the module under a name, or not where that is NULL. NULL on failure.
PyTypeObject *python_add_type(PyObject *module, const char *name, PyType_Spec *spec);
/// The tp_new of types whose objects are made by functions of this module alone.
PyObject *python_refuse_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords);
/// Gives an object of such a type back, in its tp_dealloc.
void python_free(PyObject *self);

/// Whether it is a tuple, as PyArg_ParseTuple wants it; else with an exception that names it.
bool python_is_tuple(PyObject *object, const char *name);

/// Whether a number that stands for one of several things does; else with an exception that names the argument.
bool python_is_choice(int value, int least, int most, const char *name);

// Each file adds what it has; −1 on failure.
int python_add_memory(PyObject *module);
int python_add_contexts(PyObject *module);
int python_add_models(PyObject *module);
int python_add_scenes(PyObject *module);
int python_add_resources(PyObject *module);
int python_add_passes(PyObject *module);
int python_add_panoramas(PyObject *module);
int python_add_programs(PyObject *module);
int python_add_compiler(PyObject *module);

// Functions of the module, by file.
extern PyMethodDef python_model_functions[], python_camera_functions[], python_encode_functions[],
    python_panorama_functions[], python_resource_functions[], python_diff_rasterize_functions[],
    python_diff_rasterize_grad_functions[], python_diff_interpolate_functions[],
    python_diff_texture_functions[], python_diff_antialias_functions[], python_array_functions[],
    python_compile_functions[], python_dispatch_functions[];

/// Work without the interpreter's lock that looks for signals now and then.
struct python_work {
    PyThreadState *state;
    uint64_t looked_ns; ///< when it looked for signals
    bool gave_up;       ///< a handler raised an exception
};

/// Gives the interpreter's lock back; PyEval_RestoreThread of the state takes it again.
struct python_work python_work_begin(void);
/// The goes_on of struct scene_view and scene_model_options; `user` is a struct python_work whose state was saved.
/// False with an exception set where a handler raised one, as that of Ctrl-C does. It looks 20 times a second at most,
/// since it waits for another Python thread that runs.
bool python_work_goes_on(void *user);

#endif
