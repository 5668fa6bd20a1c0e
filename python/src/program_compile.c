// SPDX-License-Identifier: MIT
// GLSL texts to SPIR-V.
#include "extension.h"

#include "glsl.h"

#include <string.h>

enum { MESSAGE = 1024 }; // bytes of an error

// (stage, text, name, whether files may be included): (SPIR-V or None, the first error or "", the log)
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
    const struct glsl_options options = {.include = includes ? glsl_include_file : NULL, .user = &folders};
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
        result = Py_BuildValue("(OOO)", words ? words : Py_None, told, all);
    }
    Py_XDECREF(words);
    Py_XDECREF(told);
    Py_XDECREF(all);
    glsl_code_free(&code);
    return result;
}

PyMethodDef python_compile_functions[] = {{"compile", compile, METH_VARARGS, NULL}, {0}};

int python_add_compiler(PyObject *module)
{
    return PyModule_AddIntConstant(module, "compiles", glsl_is_there());
}
