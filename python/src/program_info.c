// SPDX-License-Identifier: MIT
#include "program_info.h"

#include <string.h>

static PyObject *name_of(const char *name)
{
    return PyUnicode_DecodeUTF8(name, (Py_ssize_t)strlen(name), "replace");
}

static PyObject *none(void)
{
    Py_INCREF(Py_None);
    return Py_None;
}

static PyObject *type_of(const struct rhw_shader_type *type, PyObject *told);

// Return ((name, offset, type), ...).
static PyObject *members_of(const struct rhw_shader_type *type, PyObject *told)
{
    PyObject *const members = PyTuple_New(type->kind == RHW_SHADER_STRUCT ? (Py_ssize_t)type->count : 0);
    for (uint32_t i = 0; members && type->kind == RHW_SHADER_STRUCT && i < type->count; i++) {
        const struct rhw_shader_member *const member = &type->members[i];
        PyObject *const name = name_of(member->name), *const kind = name ? type_of(member->type, told) : NULL;
        PyObject *const one = kind ? Py_BuildValue("(OIO)", name, member->offset, kind) : NULL;
        Py_XDECREF(name);
        Py_XDECREF(kind);
        if (!one) {
            Py_DECREF(members);
            return NULL;
        }
        PyTuple_SetItem(members, (Py_ssize_t)i, one);
    }
    return members;
}

static PyObject *new_type(const struct rhw_shader_type *type, PyObject *told)
{
    PyObject *const name = name_of(type->name), *const members = members_of(type, told);
    PyObject *const element = type->element ? type_of(type->element, told) : none();
    PyObject *made = NULL;
    if (name && members && element) {
        made = Py_BuildValue("(iIIIOIIIOOO)", (int)type->kind, type->bits, type->rows, type->columns,
                             type->is_row_major ? Py_True : Py_False, type->stride, type->count, type->size,
                             element, members, name);
    }
    Py_XDECREF(name);
    Py_XDECREF(members);
    Py_XDECREF(element);
    return made;
}

// Return (kind, bits, rows, columns, is row major, stride, count, size, element or None, members, name).
static PyObject *type_of(const struct rhw_shader_type *type, PyObject *told)
{
    PyObject *const key = PyLong_FromVoidPtr((void *)(uintptr_t)type);
    PyObject *found = key ? PyDict_GetItemWithError(told, key) : NULL;
    if (found) {
        Py_INCREF(found);
    } else if (key && !PyErr_Occurred()) {
        found = new_type(type, told);
        if (found && PyDict_SetItem(told, key, found) < 0) {
            Py_CLEAR(found);
        }
    }
    Py_XDECREF(key);
    return found;
}

// Return ((name, location, component, components, is integer), ...).
static PyObject *variables_of(const struct rhw_shader_variable *variables, uint32_t count)
{
    PyObject *const tuple = PyTuple_New((Py_ssize_t)count);
    for (uint32_t i = 0; tuple && i < count; i++) {
        const struct rhw_shader_variable *const v = &variables[i];
        PyObject *const name = name_of(v->name);
        PyObject *const one = name ? Py_BuildValue("(NIIIO)", name, v->location, v->component, v->components,
                                                   v->is_integer ? Py_True : Py_False)
                                   : NULL;
        if (!one) {
            Py_DECREF(tuple);
            return NULL;
        }
        PyTuple_SetItem(tuple, (Py_ssize_t)i, one);
    }
    return tuple;
}

PyObject *python_program_stage(const struct rhw_shader_info *info, PyObject *told)
{
    PyObject *const inputs = variables_of(info->inputs, info->input_count);
    PyObject *const outputs = variables_of(info->outputs, info->output_count);
    PyObject *const push = info->push_type ? type_of(info->push_type, told) : none();
    PyObject *const stage = inputs && outputs && push ? Py_BuildValue("(OOO)", inputs, outputs, push) : NULL;
    Py_XDECREF(inputs);
    Py_XDECREF(outputs);
    Py_XDECREF(push);
    return stage;
}

PyObject *python_program_resource(const struct rhw_shader_resource *resource, PyObject *told)
{
    PyObject *const name = name_of(resource->name);
    PyObject *const type = resource->type ? type_of(resource->type, told) : none();
    PyObject *made = NULL;
    if (name && type) {
        const bool is_flat = resource->texture_kind == RHW_TEXTURE_2D && !resource->is_array;
        made =
            Py_BuildValue("(iIIIOIOOOO)", (int)resource->kind, resource->set, resource->binding,
                          resource->count, name, resource->size, resource->is_read_only ? Py_True : Py_False,
                          type, is_flat && !resource->is_multisampled ? Py_True : Py_False,
                          resource->is_integer ? Py_True : Py_False);
    }
    Py_XDECREF(name);
    Py_XDECREF(type);
    return made;
}
