// SPDX-License-Identifier: MIT
// Programs that compute.
#include "binding_reading.h"

// The context has its turn. Return false with an exception.
static bool run(PyObject *object, rhw_context *context, const struct rhw_dispatch_def *def,
                const struct python_bindings *bindings, const unsigned groups[3])
{
    enum rhw_result result = python_bindings_make(context, bindings);
    if (result == RHW_OK) {
        struct python_work work = python_work_begin();
        rhw_context_set_goes_on(context, python_work_goes_on, &work);
        result = rhw_dispatch(context, def, groups[0], groups[1], groups[2]);
        rhw_context_set_goes_on(context, NULL, NULL);
        PyEval_RestoreThread(work.state);
    }
    // Where a handler of signals has raised an exception, that is told.
    return python_context_leave(object, result);
}

// (context, program, (x, y, z), bindings, push constants)
static PyObject *dispatch(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *context, *object, *tuple, *push;
    unsigned groups[3];
    if (!PyArg_ParseTuple(arguments, "OO(III)OO:dispatch", &context, &object, &groups[0], &groups[1],
                          &groups[2], &tuple, &push) ||
        !python_context_check(context)) {
        return NULL;
    }
    const struct python_program *const program = python_program_get(object);
    if (!program) {
        return NULL;
    }
    if (!program->is_compute) {
        PyErr_SetString(PyExc_ValueError, "program: draws, and has no compute shader");
        return NULL;
    }
    struct python_bindings bindings;
    bool is_good = python_bindings_read(context, program, tuple, push, &bindings);
    rhw_context *const handle = is_good ? python_context_enter(context) : NULL;
    if (handle) {
        const struct rhw_dispatch_def def = {.program = *rhw_shader_program_get_compute(program->handle),
                                             .uniforms = &bindings.frame,
                                             .uniform_bytes = sizeof bindings.frame};
        is_good = run(context, handle, &def, &bindings, groups);
    }
    python_bindings_free(&bindings);
    if (!handle || !is_good) {
        return NULL;
    }
    Py_INCREF(Py_None);
    return Py_None;
}

PyMethodDef python_dispatch_functions[] = {{"dispatch", dispatch, METH_VARARGS, NULL}, {0}};
