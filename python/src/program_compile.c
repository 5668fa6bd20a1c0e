// SPDX-License-Identifier: MIT
// GLSL texts to SPIR-V.
#include "extension.h"

#include "glsl_names.h"

#include <string.h>

enum { MESSAGE = 1024 }; // bytes of an error

// (stage, text, name, whether files may be included): (SPIR-V or None, the first error or "", the log, whether the text
// is as OpenGL has it)
static PyObject *compile(PyObject *module, PyObject *arguments)
{
    (void)module;
    int stage, includes;
    const char *text;
    PyObject *name; // bytes, which end with a 0, as other buffers need not
    Py_ssize_t size;
    if (!PyArg_ParseTuple(arguments, "iy#Sp:compile", &stage, &text, &size, &name, &includes) ||
        !python_is_choice(stage, 0, RHW_SHADER_STAGE_COUNT - 1, "stage")) {
        return NULL;
    }
    char message[MESSAGE] = "";
    struct glsl_folders folders = {.count = 0};
    const struct glsl_options options = {
        .include = includes ? glsl_include_file : NULL, .user = &folders, .is_relaxed = true};
    struct glsl_code code = {.words = NULL};
    bool is_good;
    Py_BEGIN_ALLOW_THREADS is_good =
        glsl_compile((enum rhw_shader_stage)stage, text, (size_t)size, PyBytes_AsString(name), &options,
                     &code, message, sizeof message);
    Py_END_ALLOW_THREADS PyObject *const words =
        is_good ? PyBytes_FromStringAndSize((const char *)code.words, (Py_ssize_t)code.size) : NULL;
    const char *const log = code.log ? code.log : "";
    PyObject *const told = PyUnicode_DecodeUTF8(message, (Py_ssize_t)strlen(message), "replace");
    PyObject *const all = PyUnicode_DecodeUTF8(log, (Py_ssize_t)strlen(log), "replace");
    PyObject *result = NULL;
    if (told && all && (words || !is_good)) {
        result =
            Py_BuildValue("(OOOO)", words ? words : Py_None, told, all, code.is_relaxed ? Py_True : Py_False);
    }
    Py_XDECREF(words);
    Py_XDECREF(told);
    Py_XDECREF(all);
    glsl_code_free(&code);
    return result;
}

// (SPIR-V of a vertex shader, whether its text is as OpenGL has it, the same two of a fragment shader): both SPIR-V,
// fitted together by names. What `compile` returned is meant, and nothing else.
static PyObject *match(PyObject *module, PyObject *arguments)
{
    (void)module;
    const char *bytes[2];
    Py_ssize_t sizes[2];
    int is_relaxed[2];
    if (!PyArg_ParseTuple(arguments, "y#py#p:match", &bytes[0], &sizes[0], &is_relaxed[0], &bytes[1],
                          &sizes[1], &is_relaxed[1])) {
        return NULL;
    }
    char message[MESSAGE] = "";
    PyObject *result = NULL;
    PyObject *const made[2] = {PyBytes_FromStringAndSize(bytes[0], sizes[0]),
                               PyBytes_FromStringAndSize(bytes[1], sizes[1])};
    struct glsl_code codes[2] = {{0}};
    for (int i = 0; i < 2 && made[0] && made[1]; i++) {
        codes[i] = (struct glsl_code){.words = (uint32_t *)(void *)PyBytes_AsString(made[i]),
                                      .size = (size_t)sizes[i],
                                      .is_relaxed = is_relaxed[i] != 0};
    }
    if (made[0] && made[1] && !glsl_match(&codes[0], &codes[1], message, sizeof message)) {
        PyErr_SetString(PyExc_ValueError, message);
    } else if (made[0] && made[1]) {
        result = PyTuple_Pack(2, made[0], made[1]);
    }
    Py_XDECREF(made[0]);
    Py_XDECREF(made[1]);
    return result;
}

PyMethodDef python_compile_functions[] = {
    {"compile", compile, METH_VARARGS, NULL}, {"match", match, METH_VARARGS, NULL}, {0}};

int python_add_compiler(PyObject *module)
{
    return PyModule_AddIntConstant(module, "compiles", glsl_is_there());
}
