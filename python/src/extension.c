// SPDX-License-Identifier: MIT
// The module rhw._rhw.
#include "extension.h"

#include "picture_fields.h"

#include <time.h>

PyObject *python_error;

PyTypeObject *python_add_type(PyObject *module, const char *name, PyType_Spec *spec)
{
    PyObject *type = PyType_FromSpec(spec);
    if (!type) {
        return NULL;
    }
    Py_INCREF(type); // one for us, one for the module
    if (name && PyModule_AddObject(module, name, type) < 0) {
        Py_DECREF(type);
        Py_DECREF(type);
        return NULL;
    }
    return (PyTypeObject *)type;
}

PyObject *python_refuse_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords)
{
    (void)arguments;
    (void)keywords;
    PyErr_Format(PyExc_TypeError, "%R: is made by functions of rhw alone", (PyObject *)type);
    return NULL;
}

bool python_is_tuple(PyObject *object, const char *name)
{
    if (!PyTuple_Check(object)) {
        PyErr_Format(PyExc_TypeError, "%s: must be a tuple", name);
        return false;
    }
    return true;
}

bool python_is_choice(int value, int least, int most, const char *name)
{
    if (value < least || value > most) {
        PyErr_Format(PyExc_ValueError, "%s: there is no %d", name, value);
        return false;
    }
    return true;
}

void python_free(PyObject *self)
{
    PyTypeObject *type = Py_TYPE(self);
    const freefunc release = (freefunc)(uintptr_t)PyType_GetSlot(type, Py_tp_free);
    release(self);
    Py_DECREF(type); // instances of types from specifications hold theirs
}

static uint64_t now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

struct python_work python_work_begin(void)
{
    const uint64_t now = now_ns();
    return (struct python_work){.state = PyEval_SaveThread(), .looked_ns = now};
}

bool python_work_goes_on(void *user)
{
    static const uint64_t look_ns = 50000000;
    struct python_work *work = user;
    if (!work->gave_up && now_ns() - work->looked_ns >= look_ns) {
        PyEval_RestoreThread(work->state);
        work->gave_up = PyErr_CheckSignals() != 0;
        work->state = PyEval_SaveThread();
        work->looked_ns = now_ns();
    }
    return !work->gave_up;
}

static int add_functions(PyObject *module)
{
    PyMethodDef *const tables[] = {python_model_functions,
                                   python_camera_functions,
                                   python_encode_functions,
                                   python_panorama_functions,
                                   python_resource_functions,
                                   python_compile_functions,
                                   python_dispatch_functions,
                                   python_diff_rasterize_functions,
                                   python_diff_rasterize_grad_functions,
                                   python_diff_interpolate_functions,
                                   python_diff_texture_functions,
                                   python_diff_antialias_functions,
                                   python_array_functions};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        if (PyModule_AddFunctions(module, tables[i]) < 0) {
            return -1;
        }
    }
    return 0;
}

static int fill(PyObject *module)
{
    python_error = PyErr_NewExceptionWithDoc("rhw.Error",
                                             "The work failed: one line that names the thing and the cause.",
                                             PyExc_RuntimeError, NULL);
    if (!python_error) {
        return -1;
    }
    Py_INCREF(python_error);
    if (PyModule_AddObject(module, "Error", python_error) < 0 ||
        PyModule_AddStringConstant(module, "version", rhw_version()) < 0 ||
        PyModule_AddIntConstant(module, "max_target_size", RHW_MAX_TARGET_SIZE) < 0) {
        return -1;
    }
    return add_functions(module) < 0 || python_add_memory(module) < 0 || python_add_contexts(module) < 0 ||
                   python_add_models(module) < 0 || python_add_scenes(module) < 0 ||
                   python_add_resources(module) < 0 || python_add_passes(module) < 0 ||
                   python_add_programs(module) < 0 || python_add_compiler(module) < 0 ||
                   python_add_panoramas(module) < 0 || python_add_outputs(module) < 0
               ? -1
               : 0;
}

PyMODINIT_FUNC PyInit__rhw(void);

PyMODINIT_FUNC PyInit__rhw(void)
{
    static struct PyModuleDef definition = {PyModuleDef_HEAD_INIT, .m_name = "rhw._rhw",
                                            .m_doc = "The extension below rhw.", .m_size = -1};
    PyObject *module = PyModule_Create(&definition);
    if (module && fill(module) < 0) {
        Py_DECREF(module);
        return NULL;
    }
    return module;
}
