// SPDX-License-Identifier: MIT
// Every binding is of the kind that the program says its resource is: what functions of the library do with one of
// another kind is not defined. The memory of the bindings is one block, which the pass keeps until it has ended.
#include "binding_reading.h"

#include "memory_object.h"
#include "resource_object.h"

#include <stdlib.h>
#include <string.h>

struct python_binding_request {
    const struct python_program_resource *resource;
    struct rhw_binding *binding;
    const struct python_item *item, *sampler; // or NULL
    struct python_array array;
    int format;
};

static bool keep(struct python_bindings *bindings, PyObject *object)
{
    return PyList_Append(bindings->kept, object) == 0;
}

static bool read_item(PyObject *context, PyObject *object, enum python_item_kind kind,
                      struct python_bindings *bindings, const struct python_item **item)
{
    *item = python_resource_get(object, context, kind, "bindings");
    return *item && keep(bindings, object);
}

static bool read_array(PyObject *object, struct python_bindings *bindings,
                       struct python_binding_request *request)
{
    if (!python_array_read(object, "bindings", "|u1", &request->array)) {
        return false;
    }
    if (request->array.is_read_only && !request->resource->is_read_only) {
        PyErr_SetString(PyExc_ValueError, "bindings: an array that the program writes to must be writable");
        return false;
    }
    if ((uintptr_t)request->array.data % sizeof(uint32_t) != 0) {
        PyErr_SetString(PyExc_ValueError, "bindings: an array must lie at a multiple of 4 bytes");
        return false;
    }
    return keep(bindings, object);
}

static bool read_object(PyObject *context, PyObject *object, PyObject *other,
                        struct python_bindings *bindings, struct python_binding_request *request)
{
    switch (request->resource->kind) {
    case RHW_SHADER_UNIFORM_BUFFER:
    case RHW_SHADER_STORAGE_BUFFER:
        return python_is_resource(object)
                   ? read_item(context, object, PYTHON_ITEM_BUFFER, bindings, &request->item)
                   : read_array(object, bindings, request);
    case RHW_SHADER_SAMPLED_TEXTURE:
        return read_item(context, object, PYTHON_ITEM_TEXTURE, bindings, &request->item) &&
               read_item(context, other, PYTHON_ITEM_SAMPLER, bindings, &request->sampler);
    case RHW_SHADER_TEXTURE:
    case RHW_SHADER_STORAGE_IMAGE:
        return read_item(context, object, PYTHON_ITEM_TEXTURE, bindings, &request->item);
    case RHW_SHADER_SAMPLER: return read_item(context, object, PYTHON_ITEM_SAMPLER, bindings, &request->item);
    case RHW_SHADER_TEXEL_BUFFER: {
        const long format = PyLong_AsLong(other);
        request->format = (int)format;
        return !PyErr_Occurred() && python_is_choice(request->format, 1, RHW_FORMAT_COUNT - 1, "bindings") &&
               read_array(object, bindings, request);
    }
    case RHW_SHADER_INPUT_ATTACHMENT: break;
    }
    PyErr_SetString(PyExc_ValueError, "bindings: there are no input attachments");
    return false;
}

static bool read_request(PyObject *context, const struct python_program *program, PyObject *tuple,
                         struct python_bindings *bindings, struct python_binding_request *request)
{
    unsigned place, element;
    PyObject *object, *other;
    if (!python_is_tuple(tuple, "bindings") ||
        !PyArg_ParseTuple(tuple, "IIOO", &place, &element, &object, &other)) {
        return false;
    }
    if (place >= program->resource_count || element >= program->resources[place].count) {
        PyErr_SetString(PyExc_ValueError, "bindings: the program has no such resource");
        return false;
    }
    const struct python_program_resource *const resource = &program->resources[place];
    const int first = rhw_shader_program_find(program->handle, resource->set, resource->binding);
    request->resource = resource;
    request->binding = (struct rhw_binding *)(uintptr_t)bindings->frame.sets[resource->set] + first + element;
    return read_object(context, object, other, bindings, request);
}

// Lay out the sets and the push constants in one block.
static bool take_memory(const struct python_program *program, const struct python_array *push,
                        struct python_bindings *bindings)
{
    size_t count = 0;
    for (uint32_t set = 0; set < RHW_SHADER_MAX_SETS; set++) {
        count += rhw_shader_program_set_size(program->handle, set);
    }
    void *data;
    const size_t bytes = (size_t)push->count;
    bindings->memory = python_memory_aligned(count * sizeof(struct rhw_binding) + bytes + 1, &data);
    if (!bindings->memory) {
        return false;
    }
    struct rhw_binding *next = data;
    for (uint32_t set = 0; set < RHW_SHADER_MAX_SETS; set++) {
        bindings->frame.sets[set] = next;
        next += rhw_shader_program_set_size(program->handle, set);
    }
    if (bytes > 0) {
        memcpy(next, push->data, bytes);
    }
    bindings->frame.push_constants = next;
    bindings->frame.push_size = (uint32_t)bytes;
    return true;
}

bool python_bindings_read(PyObject *context, const struct python_program *program, PyObject *tuple,
                          PyObject *push, struct python_bindings *bindings)
{
    struct python_array bytes;
    *bindings = (struct python_bindings){.kept = PyList_New(0)};
    if (!bindings->kept || !python_is_tuple(tuple, "bindings") ||
        !python_array_read(push, "push constants", "|u1", &bytes)) {
        return false;
    }
    if (bytes.count > UINT16_MAX) {
        PyErr_SetString(PyExc_ValueError, "push constants: must be fewer than 65536 bytes");
        return false;
    }
    const Py_ssize_t count = PyTuple_Size(tuple);
    bindings->requests = calloc((size_t)count + 1, sizeof *bindings->requests);
    if (!bindings->requests || !take_memory(program, &bytes, bindings)) {
        return PyErr_Occurred() ? false : PyErr_NoMemory() != NULL;
    }
    for (; bindings->count < count; bindings->count++) {
        if (!read_request(context, program, PyTuple_GetItem(tuple, bindings->count), bindings,
                          &bindings->requests[bindings->count])) {
            return false;
        }
    }
    return keep(bindings, bindings->memory);
}

static enum rhw_result make_buffer(rhw_context *context, const struct python_binding_request *request)
{
    const bool is_read_only = request->resource->is_read_only;
    if (request->item) {
        return rhw_binding_of_buffer(context, request->item->id.buffer, 0, 0, is_read_only, request->binding);
    }
    return rhw_binding_of_memory(request->array.data, (size_t)request->array.count, is_read_only,
                                 request->binding)
               ? RHW_OK
               : RHW_ERROR_MISUSE;
}

static enum rhw_result make_binding(rhw_context *context, const struct python_binding_request *request)
{
    static const rhw_sampler no_sampler;
    struct rhw_binding *const binding = request->binding;
    const struct python_item *const item = request->item, *const sampler = request->sampler;
    const bool is_read_only = request->resource->is_read_only;
    switch (request->resource->kind) {
    case RHW_SHADER_SAMPLED_TEXTURE:
    case RHW_SHADER_TEXTURE:
        return rhw_binding_of_texture(context, item->id.texture, sampler ? sampler->id.sampler : no_sampler,
                                      binding);
    case RHW_SHADER_SAMPLER: return rhw_binding_of_sampler(context, item->id.sampler, binding);
    case RHW_SHADER_STORAGE_IMAGE:
        return rhw_binding_of_image(context, item->id.texture, 0, is_read_only, binding);
    case RHW_SHADER_TEXEL_BUFFER:
        return rhw_binding_of_texel_memory(rhw_context_isa(context), request->array.data,
                                           (size_t)request->array.count, (enum rhw_format)request->format,
                                           is_read_only, binding)
                   ? RHW_OK
                   : RHW_ERROR_MISUSE;
    default: return make_buffer(context, request);
    }
}

enum rhw_result python_bindings_make(rhw_context *context, const struct python_bindings *bindings)
{
    enum rhw_result result = RHW_OK;
    for (Py_ssize_t i = 0; i < bindings->count && result == RHW_OK; i++) {
        result = make_binding(context, &bindings->requests[i]);
    }
    return result;
}

void python_bindings_free(struct python_bindings *bindings)
{
    free(bindings->requests);
    Py_XDECREF(bindings->memory);
    Py_XDECREF(bindings->kept);
}
