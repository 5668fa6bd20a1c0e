// SPDX-License-Identifier: MIT
// One type for what passes are made with. Buffers and textures stand on memory that NumPy sees too, so that what is
// drawn is read, and what is to be drawn is written, in place.
#include "resource_object.h"

#include "builtin_shaders.h"
#include "memory_object.h"
#include "program_object.h"

#include <stdlib.h>
#include <string.h>

struct resource {
    PyObject ob_base;
    PyObject *context;
    PyObject *memory; // of a buffer or texture; of a pipeline the program, which may be NULL
    size_t bytes;
    struct python_item *item;
};

static PyTypeObject *resource_type;

static void resource_free(PyObject *self)
{
    struct resource *resource = (struct resource *)self;
    python_context_destroy_item(resource->context, resource->item);
    Py_DECREF(resource->context);
    Py_XDECREF(resource->memory);
    python_free(self);
}

const struct python_item *python_resource_get(PyObject *object, PyObject *context, enum python_item_kind kind,
                                              const char *name)
{
    static const char *const names[] = {[PYTHON_ITEM_BUFFER] = "buffer",
                                        [PYTHON_ITEM_TEXTURE] = "texture",
                                        [PYTHON_ITEM_SAMPLER] = "sampler",
                                        [PYTHON_ITEM_PIPELINE] = "pipeline"};
    const struct resource *resource = (struct resource *)object;
    if (Py_TYPE(object) != resource_type || resource->item->kind != kind) {
        PyErr_Format(PyExc_TypeError, "%s: must be a %s", name, names[kind]);
    } else if (resource->context != context) {
        PyErr_Format(PyExc_ValueError, "%s: belongs to another context", name);
    } else {
        return resource->item;
    }
    return NULL;
}

bool python_is_resource(PyObject *object)
{
    return Py_TYPE(object) == resource_type;
}

size_t python_resource_bytes(PyObject *object)
{
    return ((struct resource *)object)->bytes;
}

// Makes an item by a call of the library, and the object that owns it. `memory` is given away, and so is `block`.
static PyObject *make(PyObject *context, enum python_item_kind kind, PyObject *memory, void *block,
                      enum rhw_result (*create)(rhw_context *, const void *def, struct python_item *),
                      const void *def)
{
    struct python_item *item = calloc(1, sizeof *item);
    struct resource *resource = item ? PyObject_New(struct resource, resource_type) : NULL;
    rhw_context *handle = resource ? python_context_enter(context) : NULL;
    bool created = false;
    if (handle) {
        item->kind = kind;
        const enum rhw_result result = create(handle, def, item);
        created = python_context_leave(context, result);
    }
    if (!created) {
        if (resource) {
            PyObject_Free(resource);
            Py_DECREF(resource_type);
        }
        free(item);
        free(block);
        Py_XDECREF(memory);
        return PyErr_Occurred() ? NULL : PyErr_NoMemory();
    }
    Py_XINCREF(memory);
    item->kept = memory; // also where the end of the item has to wait
    item->block = block;
    Py_INCREF(context);
    *resource =
        (struct resource){.ob_base = resource->ob_base, .context = context, .memory = memory, .item = item};
    return (PyObject *)resource;
}

static PyObject *get_memory(PyObject *self, void *closure)
{
    (void)closure;
    PyObject *memory = ((struct resource *)self)->memory;
    memory = memory ? memory : Py_None;
    Py_INCREF(memory);
    return memory;
}

// Buffers -------------------------------------------------------------------------------------------

static enum rhw_result create_buffer(rhw_context *context, const void *def, struct python_item *item)
{
    return rhw_buffer_create(context, def, &item->id.buffer);
}

// (context, bytes)
static PyObject *buffer(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *context;
    Py_ssize_t size;
    if (!PyArg_ParseTuple(arguments, "On:buffer", &context, &size) || !python_context_check(context)) {
        return NULL;
    }
    if (size < 1) {
        PyErr_SetString(PyExc_ValueError, "buffer: must have at least one byte");
        return NULL;
    }
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.size = (size_t)size;
    def.memory_size = def.size;
    PyObject *memory = python_memory_aligned(def.memory_size, &def.memory);
    PyObject *made = memory ? make(context, PYTHON_ITEM_BUFFER, memory, NULL, create_buffer, &def) : NULL;
    if (made) {
        ((struct resource *)made)->bytes = def.size;
    }
    return made;
}

// Textures ------------------------------------------------------------------------------------------

static const struct {
    const char *name;
    enum rhw_format format;
} formats[] = {{"r8_unorm", RHW_FORMAT_R8_UNORM},         {"rg8_unorm", RHW_FORMAT_RG8_UNORM},
               {"rgba8_unorm", RHW_FORMAT_RGBA8_UNORM},   {"rgba8_srgb", RHW_FORMAT_RGBA8_SRGB},
               {"r16_unorm", RHW_FORMAT_R16_UNORM},       {"rgba16_unorm", RHW_FORMAT_RGBA16_UNORM},
               {"r16_float", RHW_FORMAT_R16_FLOAT},       {"rgba16_float", RHW_FORMAT_RGBA16_FLOAT},
               {"r32_float", RHW_FORMAT_R32_FLOAT},       {"rg32_float", RHW_FORMAT_RG32_FLOAT},
               {"rgba32_float", RHW_FORMAT_RGBA32_FLOAT}, {"r32_uint", RHW_FORMAT_R32_UINT},
               {"d32_float", RHW_FORMAT_D32_FLOAT}};

// Their numbers by their names.
static PyObject *formats_dictionary(void)
{
    PyObject *dictionary = PyDict_New();
    for (size_t i = 0; dictionary && i < sizeof formats / sizeof *formats; i++) {
        PyObject *number = PyLong_FromLong(formats[i].format);
        if (!number || PyDict_SetItemString(dictionary, formats[i].name, number) < 0) {
            Py_CLEAR(dictionary);
        }
        Py_XDECREF(number);
    }
    return dictionary;
}

static enum rhw_result create_texture(rhw_context *context, const void *def, struct python_item *item)
{
    return rhw_texture_create(context, def, &item->id.texture);
}

// (context, format, width, height, has levels): (texture, bytes from row to row)
static PyObject *texture(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *context;
    int format, has_levels;
    struct rhw_texture_def def = rhw_texture_def_default();
    if (!PyArg_ParseTuple(arguments, "Oiiip:texture", &context, &format, &def.width, &def.height,
                          &has_levels) ||
        !python_context_check(context)) {
        return NULL;
    }
    def.format = (enum rhw_format)format;
    def.mip_levels = has_levels ? RHW_MIP_LEVELS_ALL : 1;
    struct rhw_texture_layout layout;
    rhw_context *handle = python_context_enter(context);
    if (!handle || !python_context_leave(context, rhw_texture_query_layout(handle, &def, &layout))) {
        return NULL;
    }
    PyObject *memory = python_memory_aligned(layout.size, &def.memory);
    def.memory_size = layout.size;
    PyObject *made = memory ? make(context, PYTHON_ITEM_TEXTURE, memory, NULL, create_texture, &def) : NULL;
    return made ? Py_BuildValue("(Nn)", made, (Py_ssize_t)layout.level[0].row_pitch) : NULL;
}

static PyObject *generate_mips(PyObject *module, PyObject *object)
{
    (void)module;
    if (Py_TYPE(object) != resource_type || ((struct resource *)object)->item->kind != PYTHON_ITEM_TEXTURE) {
        PyErr_SetString(PyExc_TypeError, "texture: must be a texture");
        return NULL;
    }
    const struct resource *resource = (struct resource *)object;
    rhw_context *handle = python_context_enter(resource->context);
    if (!handle) {
        return NULL;
    }
    struct python_work work = python_work_begin();
    rhw_context_set_goes_on(handle, python_work_goes_on, &work);
    const enum rhw_result result = rhw_texture_generate_mips(handle, resource->item->id.texture);
    rhw_context_set_goes_on(handle, NULL, NULL);
    PyEval_RestoreThread(work.state);
    if (!python_context_leave(resource->context, result)) {
        return NULL;
    }
    Py_INCREF(Py_None);
    return Py_None;
}

static enum rhw_result create_sampler(rhw_context *context, const void *def, struct python_item *item)
{
    return rhw_sampler_create(context, def, &item->id.sampler);
}

// (context, filter, address, anisotropy)
static PyObject *sampler(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *context;
    int filter, address;
    struct rhw_sampler_def def = rhw_sampler_def_default();
    if (!PyArg_ParseTuple(arguments, "Oiif:sampler", &context, &filter, &address, &def.max_anisotropy) ||
        !python_context_check(context)) {
        return NULL;
    }
    def.min_filter = def.mag_filter = (enum rhw_filter)filter;
    def.mip_filter = filter == RHW_FILTER_NEAREST ? RHW_MIP_FILTER_NEAREST : RHW_MIP_FILTER_LINEAR;
    def.address_u = def.address_v = (enum rhw_address)address;
    return make(context, PYTHON_ITEM_SAMPLER, NULL, NULL, create_sampler, &def);
}

// Pipelines -----------------------------------------------------------------------------------------

struct request {
    int attributes[PYTHON_ATTRIBUTES]; // enum rhw_vertex_format, or −1
    int is_textured, qualifier, topology, cull, depth_test, depth_compare, depth_write, blend;
    PyObject *outputs; // (enum python_output, enum rhw_format) of each target
};

// A colour is laid over what is there by its alpha.
static const struct rhw_blend_component over_color = {RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA,
                                                      RHW_BLEND_ADD};
static const struct rhw_blend_component over_alpha = {RHW_BLEND_ONE, RHW_BLEND_ONE_MINUS_SRC_ALPHA,
                                                      RHW_BLEND_ADD};

static void add_attributes(const struct request *request, struct rhw_pipeline_def *def,
                           struct python_layout *layout)
{
    for (int a = 0; a < PYTHON_ATTRIBUTES; a++) {
        layout->attribute[a] = -1;
        if (request->attributes[a] >= 0) {
            layout->attribute[a] = def->attribute_count;
            def->attributes[def->attribute_count++] = (struct rhw_attribute){
                .format = (enum rhw_vertex_format)request->attributes[a], .buffer = def->buffer_count++};
        }
    }
}

static void add_varyings(const struct request *request, struct rhw_pipeline_def *def,
                         struct python_layout *layout)
{
    static const int components[PYTHON_VARYINGS] = {4, 2, 3, 3};
    const bool wanted[PYTHON_VARYINGS] = {
        [PYTHON_VARYING_COLOR] = layout->target[PYTHON_COLOR] >= 0 && layout->attribute[PYTHON_COLORS] >= 0,
        [PYTHON_VARYING_UV] = request->is_textured || layout->target[PYTHON_UV_OUTPUT] >= 0,
        [PYTHON_VARYING_NORMAL] = layout->target[PYTHON_NORMAL] >= 0,
        [PYTHON_VARYING_POSITION] = layout->target[PYTHON_POSITION] >= 0};
    int next = 0;
    for (int v = 0; v < PYTHON_VARYINGS; v++) {
        layout->varying[v] = wanted[v] ? next : -1;
        if (wanted[v]) {
            next += components[v];
            def->program.varyings[def->program.varying_count++] =
                (struct rhw_varying){.components = components[v],
                                     .qualifier = (enum rhw_qualifier)request->qualifier,
                                     .derivatives = v == PYTHON_VARYING_UV && request->is_textured};
        }
    }
}

static bool add_targets(const struct request *request, struct rhw_pipeline_def *def,
                        struct python_layout *layout)
{
    const Py_ssize_t count = PyTuple_Size(request->outputs);
    for (int o = 0; o < PYTHON_OUTPUTS; o++) {
        layout->target[o] = -1;
    }
    if (count < 0 || count > RHW_MAX_COLOR_ATTACHMENTS) {
        PyErr_Format(PyExc_ValueError, "outputs: there may be %d at most", RHW_MAX_COLOR_ATTACHMENTS);
        return false;
    }
    for (int i = 0; i < count; i++) {
        int output, format;
        PyObject *const pair = PyTuple_GetItem(request->outputs, i);
        if (!python_is_tuple(pair, "outputs") || !PyArg_ParseTuple(pair, "ii", &output, &format)) {
            return false;
        }
        if (output < 0 || output >= PYTHON_OUTPUTS || layout->target[output] >= 0) {
            PyErr_Format(PyExc_ValueError, "outputs: there is no %d, or there are two", output);
            return false;
        }
        layout->target[output] = i;
        def->targets[i] = (struct rhw_color_target){.format = (enum rhw_format)format};
        if (request->blend && output == PYTHON_COLOR) {
            def->targets[i].blend = true;
            def->targets[i].color = over_color;
            def->targets[i].alpha = over_alpha;
        }
    }
    def->target_count = (int)count;
    return true;
}

static enum rhw_result create_pipeline(rhw_context *context, const void *def, struct python_item *item)
{
    return rhw_pipeline_create(context, def, &item->id.pipeline);
}

// Whether what the shaders read is there. False with an exception.
static bool has_attributes(const struct request *request, const struct python_layout *layout)
{
    const bool reads_uv = request->is_textured || layout->target[PYTHON_UV_OUTPUT] >= 0;
    if (layout->attribute[PYTHON_POSITIONS] < 0 || (reads_uv && layout->attribute[PYTHON_UV] < 0) ||
        (layout->target[PYTHON_NORMAL] >= 0 && layout->attribute[PYTHON_NORMALS] < 0)) {
        PyErr_SetString(PyExc_ValueError, "attributes: there are not all that the outputs are made of");
        return false;
    }
    return true;
}

static PyObject *make_pipeline(PyObject *context, const struct request *request)
{
    struct python_layout *layout = calloc(1, sizeof *layout);
    if (!layout) {
        return PyErr_NoMemory();
    }
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){.vertex = RHW_ISA_TABLE(python_vertex),
                                       .fragment = RHW_ISA_TABLE(python_fragment),
                                       .uniform_size = sizeof(struct python_uniforms),
                                       .user = layout};
    layout->is_textured = request->is_textured != 0;
    add_attributes(request, &def, layout);
    if (!add_targets(request, &def, layout) || !has_attributes(request, layout)) {
        free(layout);
        return NULL;
    }
    add_varyings(request, &def, layout);
    if (layout->target[PYTHON_DEPTH] >= 0 || layout->target[PYTHON_DISTANCE] >= 0) {
        def.program.uses |= RHW_USE_COORD;
    }
    if (layout->target[PYTHON_TRIANGLE] >= 0) {
        def.program.uses |= RHW_USE_IDS;
    }
    if (layout->target[PYTHON_BARYCENTRIC] >= 0) {
        def.program.uses |= RHW_USE_BARYCENTRIC;
    }
    if (def.target_count == 0) {
        memset(def.program.fragment, 0, sizeof def.program.fragment); // depth alone
    }
    def.topology = (enum rhw_topology)request->topology;
    def.cull = (enum rhw_cull)request->cull;
    def.depth_test = request->depth_test != 0;
    def.depth_compare = (enum rhw_compare)request->depth_compare;
    def.depth_read_only = def.depth_test && !request->depth_write;
    return make(context, PYTHON_ITEM_PIPELINE, NULL, layout, create_pipeline, &def);
}

// (context, (attribute formats), is textured, qualifier, topology, cull, depth test, compare, write, blend, outputs)
static PyObject *pipeline(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *context;
    struct request r;
    if (!PyArg_ParseTuple(arguments, "O(iiii)piiipippO!:pipeline", &context, &r.attributes[0],
                          &r.attributes[1], &r.attributes[2], &r.attributes[3], &r.is_textured, &r.qualifier,
                          &r.topology, &r.cull, &r.depth_test, &r.depth_compare, &r.depth_write, &r.blend,
                          &PyTuple_Type, &r.outputs) ||
        !python_context_check(context)) {
        return NULL;
    }
    return make_pipeline(context, &r);
}

// Pipelines of programs ------------------------------------------------------------------------------

struct program_request {
    int topology, cull, depth_test, depth_compare, depth_write, blend;
    PyObject *formats; // enum rhw_format of each target
};

static bool add_formats(const struct program_request *request, const struct python_program *program,
                        struct rhw_pipeline_def *def)
{
    def->target_count = (int)PyTuple_Size(request->formats);
    if (def->target_count != program->target_count) {
        PyErr_Format(PyExc_ValueError, "outputs: there must be %d", program->target_count);
        return false;
    }
    for (int i = 0; i < def->target_count; i++) {
        const long format = PyLong_AsLong(PyTuple_GetItem(request->formats, i));
        if (PyErr_Occurred() || !python_is_choice((int)format, 1, RHW_FORMAT_COUNT - 1, "outputs")) {
            return false;
        }
        def->targets[i] =
            (struct rhw_color_target){.format = (enum rhw_format)format,
                                      .blend = request->blend != 0 && format != RHW_FORMAT_R32_UINT,
                                      .color = over_color,
                                      .alpha = over_alpha};
    }
    return true;
}

static PyObject *make_program_pipeline(PyObject *context, PyObject *object,
                                       const struct program_request *request)
{
    const struct python_program *const program = python_program_get(object);
    if (!program) {
        return NULL;
    }
    if (program->is_compute) {
        PyErr_SetString(PyExc_ValueError, "program: computes, and draws nothing");
        return NULL;
    }
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = *rhw_shader_program_get(program->handle);
    memcpy(def.attributes, program->attributes, sizeof def.attributes);
    def.attribute_count = program->attribute_count;
    def.buffer_count = program->buffer_count;
    def.topology = (enum rhw_topology)request->topology;
    def.cull = (enum rhw_cull)request->cull;
    def.depth_test = request->depth_test != 0;
    def.depth_compare = (enum rhw_compare)request->depth_compare;
    def.depth_read_only = def.depth_test && !request->depth_write;
    if (!add_formats(request, program, &def)) {
        return NULL;
    }
    Py_INCREF(object);
    return make(context, PYTHON_ITEM_PIPELINE, object, NULL, create_pipeline, &def);
}

// (context, program, topology, cull, depth test, compare, write, blend, (format, ...))
static PyObject *program_pipeline(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *context, *program;
    struct program_request r;
    if (!PyArg_ParseTuple(arguments, "OOiipippO!:program_pipeline", &context, &program, &r.topology, &r.cull,
                          &r.depth_test, &r.depth_compare, &r.depth_write, &r.blend, &PyTuple_Type,
                          &r.formats) ||
        !python_context_check(context)) {
        return NULL;
    }
    return make_program_pipeline(context, program, &r);
}

PyMethodDef python_resource_functions[] = {{"buffer", buffer, METH_VARARGS, NULL},
                                           {"texture", texture, METH_VARARGS, NULL},
                                           {"generate_mips", generate_mips, METH_O, NULL},
                                           {"sampler", sampler, METH_VARARGS, NULL},
                                           {"pipeline", pipeline, METH_VARARGS, NULL},
                                           {"program_pipeline", program_pipeline, METH_VARARGS, NULL},
                                           {0}};

int python_add_resources(PyObject *module)
{
    static PyGetSetDef members[] = {{"memory", get_memory, NULL, NULL, NULL}, {0}};
    static PyType_Slot slots[] = {{Py_tp_dealloc, (void *)(uintptr_t)resource_free},
                                  {Py_tp_new, (void *)(uintptr_t)python_refuse_new},
                                  {Py_tp_getset, members},
                                  {0, NULL}};
    static PyType_Spec spec = {.name = "rhw._rhw.Resource",
                               .basicsize = sizeof(struct resource),
                               .flags = Py_TPFLAGS_DEFAULT,
                               .slots = slots};
    resource_type = python_add_type(module, "Resource", &spec);
    PyObject *names = resource_type ? formats_dictionary() : NULL;
    return names ? PyModule_AddObject(module, "formats", names) : -1;
}
