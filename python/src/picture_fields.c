// SPDX-License-Identifier: MIT
#include "picture_fields.h"

bool python_has_output(int kind)
{
    return !scene_outputs[kind].is_of_work;
}

const char *python_output_type(int kind)
{
    static const char *const types[] = {
        [SCENE_ELEMENT_UINT8] = "|u1", [SCENE_ELEMENT_UINT32] = "<u4", [SCENE_ELEMENT_FLOAT] = "<f4"};
    return types[scene_output_element((enum scene_output_kind)kind)];
}

static PyObject *make_row(int kind)
{
    const struct scene_output_row *const row = &scene_outputs[kind];
    PyObject *const layer = PyList_New(0);
    bool added = layer != NULL;
    for (int i = 0; added && i < 4 && row->layer[i]; i++) {
        PyObject *const name = PyUnicode_FromString(row->layer[i]);
        added = name && PyList_Append(layer, name) == 0;
        Py_XDECREF(name);
    }
    PyObject *const made =
        added ? Py_BuildValue("(siisiOs)", row->name, (int)row->output, row->word ? kind : -1,
                              python_output_type(kind), scene_output_channels((enum scene_output_kind)kind),
                              layer, row->meaning)
              : NULL;
    Py_XDECREF(layer);
    return made;
}

int python_add_outputs(PyObject *module)
{
    PyObject *const rows = PyList_New(0);
    bool added = rows != NULL;
    for (int kind = 0; added && kind < SCENE_KIND_COUNT; kind++) {
        PyObject *const row = python_has_output(kind) ? make_row(kind) : NULL;
        added = !python_has_output(kind) || (row && PyList_Append(rows, row) == 0);
        Py_XDECREF(row);
    }
    if (!added || PyModule_AddObject(module, "outputs", rows) < 0) {
        Py_XDECREF(rows);
        return -1;
    }
    return 0;
}
