// SPDX-License-Identifier: MIT
// A pass: recorded by Python, run without the interpreter's lock. It holds what it draws with until it has ended, or as
// long as it lives where it can be run again.
#include "binding_reading.h"
#include "builtin_shaders.h"
#include "memory_object.h"
#include "resource_object.h"

#include <stdlib.h>
#include <string.h>

struct pass {
    PyObject ob_base;
    PyObject *context;
    struct python_item *item; // whose `kept` is a list of what the pass draws with; NULL: it has ended
                              // and cannot be run again
};

static PyTypeObject *pass_type;

static void pass_free(PyObject *self)
{
    struct pass *pass = (struct pass *)self;
    if (pass->item) {
        python_context_destroy_item(pass->context, pass->item);
    }
    Py_XDECREF(pass->context);
    python_free(self);
}

static bool has_item(const struct pass *pass, enum python_item_kind kind)
{
    return pass->item && pass->item->kind == kind;
}

static bool is_recorded(const struct pass *pass)
{
    const bool good = has_item(pass, PYTHON_ITEM_PASS);
    if (!good) {
        PyErr_SetString(PyExc_ValueError, "the pass has ended");
    }
    return good;
}

// The pass's context, to be left again. Threads wait for their turn, and one of them may have ended the pass meanwhile.
static rhw_context *enter(const struct pass *pass)
{
    rhw_context *context = is_recorded(pass) ? python_context_enter(pass->context) : NULL;
    if (context && !has_item(pass, PYTHON_ITEM_PASS)) {
        if (python_context_leave(pass->context, RHW_OK)) {
            is_recorded(pass); // says that it has ended
        }
        return NULL;
    }
    return context;
}

// What records the pass, of a context that was entered.
static rhw_context *recorder_of(const struct pass *pass, rhw_context *context)
{
    return pass->item->recorder ? pass->item->recorder : context;
}

// The item of a resource, which the pass keeps from now on.
static const struct python_item *keep(PyObject *context, PyObject *kept, PyObject *object,
                                      enum python_item_kind kind, const char *name)
{
    const struct python_item *item = python_resource_get(object, context, kind, name);
    return item && PyList_Append(kept, object) == 0 ? item : NULL;
}

// Beginning -----------------------------------------------------------------------------------------

// (texture, load, (r, g, b, a) or (integer, 0, 0, 0), is integer)
static bool read_color(PyObject *tuple, PyObject *context, PyObject *kept, struct rhw_color_attachment *color)
{
    PyObject *object;
    int load, is_integer;
    double clear[4];
    const struct python_item *item;
    if (!python_is_tuple(tuple, "targets") ||
        !PyArg_ParseTuple(tuple, "Op(dddd)p", &object, &load, &clear[0], &clear[1], &clear[2], &clear[3],
                          &is_integer) ||
        !(item = keep(context, kept, object, PYTHON_ITEM_TEXTURE, "targets"))) {
        return false;
    }
    if (is_integer && !(clear[0] >= 0 && clear[0] <= UINT32_MAX)) {
        PyErr_SetString(PyExc_ValueError, "clear: must be a number of 32 bits");
        return false;
    }
    color->texture = item->id.texture;
    color->load = load ? RHW_LOAD_LOAD : RHW_LOAD_CLEAR;
    if (is_integer) {
        color->clear_integer[0] = (int32_t)(uint32_t)clear[0];
    }
    for (int i = 0; !is_integer && i < 4; i++) {
        color->clear[i] = (float)clear[i];
    }
    return true;
}

static bool read_def(PyObject *arguments, PyObject **context, PyObject *kept, struct rhw_pass_def *def,
                     int *is_kept)
{
    PyObject *colors, *depth;
    int has_depth, loads_depth;
    *def = (struct rhw_pass_def){0};
    if (!PyArg_ParseTuple(arguments, "O(ii)iO!pOpfp:Pass", context, &def->width, &def->height, &def->samples,
                          &PyTuple_Type, &colors, &has_depth, &depth, &loads_depth, &def->depth.clear,
                          is_kept) ||
        !python_context_check(*context)) {
        return false;
    }
    def->color_count = (int)PyTuple_Size(colors);
    if (def->color_count > RHW_MAX_COLOR_ATTACHMENTS) {
        PyErr_Format(PyExc_ValueError, "targets: there may be %d at most", RHW_MAX_COLOR_ATTACHMENTS);
        return false;
    }
    for (int i = 0; i < def->color_count; i++) {
        if (!read_color(PyTuple_GetItem(colors, i), *context, kept, &def->colors[i])) {
            return false;
        }
    }
    def->depth.enabled = has_depth != 0;
    def->depth.load = loads_depth ? RHW_LOAD_LOAD : RHW_LOAD_CLEAR;
    def->depth.store = depth == Py_None ? RHW_STORE_DISCARD : RHW_STORE_STORE;
    if (depth != Py_None) {
        const struct python_item *item = keep(*context, kept, depth, PYTHON_ITEM_TEXTURE, "depth");
        def->depth.texture = item ? item->id.texture : (rhw_texture){0};
        return item != NULL;
    }
    return true;
}

static enum rhw_result begin_item(rhw_context *context, const struct rhw_pass_def *def, bool is_kept,
                                  struct python_item *item)
{
    item->kind = PYTHON_ITEM_PASS;
    enum rhw_result result = is_kept ? rhw_recorder_create(context, &item->recorder) : RHW_OK;
    if (result == RHW_OK) {
        result = rhw_pass_begin(is_kept ? item->recorder : context, def, &item->id.pass);
    }
    if (result != RHW_OK && item->recorder) {
        rhw_context_destroy(item->recorder);
    }
    return result;
}

static bool begin(struct pass *pass, PyObject *context, const struct rhw_pass_def *def, bool is_kept,
                  PyObject *kept)
{
    struct python_item *item = calloc(1, sizeof *item);
    rhw_context *handle = item ? python_context_enter(context) : NULL;
    if (!handle) {
        free(item);
        return PyErr_Occurred() ? false : PyErr_NoMemory() != NULL;
    }
    const enum rhw_result result = begin_item(handle, def, is_kept, item);
    if (!python_context_leave(context, result)) {
        free(item);
        return false;
    }
    Py_INCREF(kept);
    item->kept = kept;
    Py_INCREF(context);
    pass->context = context;
    pass->item = item;
    return true;
}

// (context, (width, height), samples, colours, has depth, depth texture or None, depth is loaded, depth's clear value,
// whether it can be run again)
static PyObject *pass_make(PyTypeObject *type, PyObject *arguments, PyObject *keywords)
{
    (void)keywords;
    PyObject *context, *kept = PyList_New(0);
    struct rhw_pass_def def;
    int is_kept;
    const allocfunc allocate = (allocfunc)(uintptr_t)PyType_GetSlot(type, Py_tp_alloc);
    PyObject *self = NULL;
    if (kept && read_def(arguments, &context, kept, &def, &is_kept)) {
        self = allocate(type, 0);
        if (self && !begin((struct pass *)self, context, &def, is_kept != 0, kept)) {
            Py_DECREF(self);
            self = NULL;
        }
    }
    Py_XDECREF(kept);
    return self;
}

// Drawing -------------------------------------------------------------------------------------------

struct draw {
    const struct python_item *pipeline, *indices, *texture, *sampler;
    rhw_buffer buffers[PYTHON_ATTRIBUTES];
    int buffer_count;
    unsigned count;
    struct python_uniforms uniforms;
};

static bool read_uniforms(PyObject *matrices, struct python_uniforms *uniforms)
{
    struct python_array array;
    if (!python_array_read(matrices, "matrices", "<f4", &array)) {
        return false;
    }
    if (array.count != 45) {
        PyErr_SetString(PyExc_ValueError, "matrices: must be 45 floats");
        return false;
    }
    const float *values = array.data;
    memcpy(uniforms->clip, values, sizeof uniforms->clip);
    memcpy(uniforms->world, values + 16, sizeof uniforms->world);
    memcpy(uniforms->normal, values + 32, sizeof uniforms->normal);
    memcpy(uniforms->color, values + 41, sizeof uniforms->color);
    return true;
}

// A pipeline of the shaders of this package, or of a program.
static const struct python_item *read_pipeline(const struct pass *pass, PyObject *object, bool has_program)
{
    const struct python_item *item =
        keep(pass->context, pass->item->kept, object, PYTHON_ITEM_PIPELINE, "pipeline");
    if (item && (item->kept != NULL) != has_program) {
        PyErr_SetString(PyExc_ValueError,
                        has_program ? "pipeline: has no program" : "pipeline: has a program of its own");
        return NULL;
    }
    return item;
}

static bool read_optional(PyObject *context, PyObject *kept, PyObject *object, enum python_item_kind kind,
                          const char *name, const struct python_item **item)
{
    *item = object == Py_None ? NULL : keep(context, kept, object, kind, name);
    return object == Py_None || *item;
}

// What runs code of Python's comes first, as that may end the pass.
static bool read_draw(const struct pass *pass, PyObject *arguments, struct draw *draw)
{
    PyObject *pipeline, *buffers, *indices, *texture, *sampler, *matrices;
    *draw = (struct draw){0};
    if (!PyArg_ParseTuple(arguments, "OO!OIOOOII:draw", &pipeline, &PyTuple_Type, &buffers, &indices,
                          &draw->count, &texture, &sampler, &matrices, &draw->uniforms.object,
                          &draw->uniforms.first_triangle) ||
        !read_uniforms(matrices, &draw->uniforms) || !is_recorded(pass)) {
        return false;
    }
    PyObject *const kept = pass->item->kept;
    if (!(draw->pipeline = read_pipeline(pass, pipeline, false)) ||
        !read_optional(pass->context, kept, indices, PYTHON_ITEM_BUFFER, "faces", &draw->indices) ||
        !read_optional(pass->context, kept, texture, PYTHON_ITEM_TEXTURE, "texture", &draw->texture) ||
        !read_optional(pass->context, kept, sampler, PYTHON_ITEM_SAMPLER, "sampler", &draw->sampler)) {
        return false;
    }
    if (PyTuple_Size(buffers) < 1 || PyTuple_Size(buffers) > PYTHON_ATTRIBUTES) {
        PyErr_Format(PyExc_ValueError, "attributes: there must be 1 to %d", (int)PYTHON_ATTRIBUTES);
        return false;
    }
    draw->buffer_count = (int)PyTuple_Size(buffers);
    for (int i = 0; i < draw->buffer_count; i++) {
        const struct python_item *item =
            keep(pass->context, kept, PyTuple_GetItem(buffers, i), PYTHON_ITEM_BUFFER, "attributes");
        if (!item) {
            return false;
        }
        draw->buffers[i] = item->id.buffer;
    }
    // What lies outside of buffers reads 0, and may be drawn for minutes.
    const size_t most = draw->indices ? python_resource_bytes(indices) / sizeof(uint32_t)
                                      : python_resource_bytes(PyTuple_GetItem(buffers, 0)) / sizeof(float);
    if (draw->count > most) {
        PyErr_Format(PyExc_ValueError, "count: must be at most %zu, as many as there are, not %u", most,
                     draw->count);
        return false;
    }
    return true;
}

static void record(rhw_context *context, rhw_pass pass, const struct draw *draw)
{
    rhw_pass_set_pipeline(context, pass, draw->pipeline->id.pipeline);
    for (int i = 0; i < draw->buffer_count; i++) {
        rhw_pass_set_vertex_buffer(context, pass, i, draw->buffers[i], 0);
    }
    rhw_pass_set_uniforms(context, pass, &draw->uniforms, sizeof draw->uniforms);
    if (draw->texture && draw->sampler) {
        rhw_pass_set_texture(context, pass, 0, draw->texture->id.texture, draw->sampler->id.sampler);
    }
    if (draw->indices) {
        rhw_pass_set_index_buffer(context, pass, draw->indices->id.buffer, RHW_INDEX_UINT32, 0);
        rhw_pass_draw_indexed(context, pass, 0, draw->count, 0, 0, 1);
    } else {
        rhw_pass_draw(context, pass, 0, draw->count, 0, 1);
    }
}

static PyObject *none_if(bool good)
{
    if (good) {
        Py_INCREF(Py_None);
    }
    return good ? Py_None : NULL;
}

// (pipeline, vertex buffers, index buffer or None, count, texture or None, sampler or None, matrices, object, first
// triangle)
static PyObject *pass_draw(PyObject *self, PyObject *arguments)
{
    struct pass *pass = (struct pass *)self;
    struct draw draw;
    if (!read_draw(pass, arguments, &draw)) {
        return NULL;
    }
    rhw_context *context = enter(pass);
    if (!context) {
        return NULL;
    }
    record(recorder_of(pass, context), pass->item->id.pass, &draw);
    return none_if(python_context_leave(pass->context, RHW_OK));
}

// Drawing with a program ----------------------------------------------------------------------------

// So many vertices without a buffer, instances, and vertices of all instances are drawn in seconds.
static const unsigned most_vertices = 1u << 26, most_instances = 1u << 20, most_in_all = 1u << 28;

struct program_draw {
    const struct python_item *pipeline, *indices;
    rhw_buffer buffers[RHW_MAX_ATTRIBUTES];
    int buffer_count;
    unsigned count, instances;
    struct python_bindings bindings;
};

static bool check_counts(const struct program_draw *draw, PyObject *indices)
{
    const size_t most =
        draw->indices ? python_resource_bytes(indices) / sizeof(uint32_t) : (size_t)most_vertices;
    if (draw->count > most) {
        PyErr_Format(PyExc_ValueError, "count: must be at most %zu, not %u", most, draw->count);
        return false;
    }
    if (draw->instances > most_instances || (uint64_t)draw->instances * draw->count > most_in_all) {
        PyErr_Format(PyExc_ValueError, "instances: must be at most %u, and %u vertices in all",
                     most_instances, most_in_all);
        return false;
    }
    return true;
}

static bool read_buffers(const struct pass *pass, PyObject *buffers, const struct python_program *program,
                         struct program_draw *draw)
{
    if (PyTuple_Size(buffers) != program->buffer_count) {
        PyErr_Format(PyExc_ValueError, "attributes: there must be %d", program->buffer_count);
        return false;
    }
    for (; draw->buffer_count < program->buffer_count; draw->buffer_count++) {
        const struct python_item *item =
            keep(pass->context, pass->item->kept, PyTuple_GetItem(buffers, draw->buffer_count),
                 PYTHON_ITEM_BUFFER, "attributes");
        if (!item) {
            return false;
        }
        draw->buffers[draw->buffer_count] = item->id.buffer;
    }
    return true;
}

// What runs code of Python's comes first, as that may end the pass.
static bool read_program_draw(const struct pass *pass, PyObject *arguments, struct program_draw *draw)
{
    PyObject *object, *pipeline, *buffers, *indices, *bindings, *push;
    *draw = (struct program_draw){0};
    if (!PyArg_ParseTuple(arguments, "OOO!OIIOO:draw_program", &object, &pipeline, &PyTuple_Type, &buffers,
                          &indices, &draw->count, &draw->instances, &bindings, &push)) {
        return false;
    }
    const struct python_program *const program = python_program_get(object);
    if (!program || !python_bindings_read(pass->context, program, bindings, push, &draw->bindings) ||
        !is_recorded(pass) || !(draw->pipeline = read_pipeline(pass, pipeline, true))) {
        return false;
    }
    if (draw->pipeline->kept != object) {
        PyErr_SetString(PyExc_ValueError, "pipeline: has another program");
        return false;
    }
    return read_optional(pass->context, pass->item->kept, indices, PYTHON_ITEM_BUFFER, "faces",
                         &draw->indices) &&
           check_counts(draw, indices) && read_buffers(pass, buffers, program, draw) &&
           PyList_Append(pass->item->kept, draw->bindings.kept) == 0;
}

static void record_program(rhw_context *context, rhw_pass pass, const struct program_draw *draw)
{
    rhw_pass_set_pipeline(context, pass, draw->pipeline->id.pipeline);
    for (int i = 0; i < draw->buffer_count; i++) {
        rhw_pass_set_vertex_buffer(context, pass, i, draw->buffers[i], 0);
    }
    rhw_pass_set_uniforms(context, pass, &draw->bindings.frame, sizeof draw->bindings.frame);
    if (draw->indices) {
        rhw_pass_set_index_buffer(context, pass, draw->indices->id.buffer, RHW_INDEX_UINT32, 0);
        rhw_pass_draw_indexed(context, pass, 0, draw->count, 0, 0, draw->instances);
    } else {
        rhw_pass_draw(context, pass, 0, draw->count, 0, draw->instances);
    }
}

// (program, pipeline, vertex buffers, index buffer or None, count, instances, bindings, push constants)
static PyObject *pass_draw_program(PyObject *self, PyObject *arguments)
{
    struct pass *pass = (struct pass *)self;
    struct program_draw draw;
    rhw_context *context = read_program_draw(pass, arguments, &draw) ? enter(pass) : NULL;
    bool is_good = context != NULL;
    if (context) {
        const enum rhw_result result = python_bindings_make(context, &draw.bindings);
        if (result == RHW_OK) {
            record_program(recorder_of(pass, context), pass->item->id.pass, &draw);
        }
        is_good = python_context_leave(pass->context, result);
    }
    python_bindings_free(&draw.bindings);
    return none_if(is_good);
}

// (x, y, width, height)
static PyObject *pass_viewport(PyObject *self, PyObject *arguments)
{
    struct pass *pass = (struct pass *)self;
    struct rhw_viewport viewport = {.depth_max = 1.0f};
    if (!PyArg_ParseTuple(arguments, "ffff:viewport", &viewport.x, &viewport.y, &viewport.width,
                          &viewport.height) ||
        !is_recorded(pass)) {
        return NULL;
    }
    rhw_context *context = enter(pass);
    if (!context) {
        return NULL;
    }
    rhw_pass_set_viewport(recorder_of(pass, context), pass->item->id.pass, &viewport);
    return none_if(python_context_leave(pass->context, RHW_OK));
}

// Ending --------------------------------------------------------------------------------------------

static PyObject *pass_cancel(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    struct pass *pass = (struct pass *)self;
    if (!is_recorded(pass)) {
        return NULL;
    }
    struct python_item *item = pass->item;
    pass->item = NULL;
    python_context_destroy_item(pass->context, item);
    return none_if(true);
}

// Draw what a pass or a recording has, without the interpreter's lock.
static enum rhw_result run_item(rhw_context *context, const struct python_item *item, struct rhw_stats *stats)
{
    struct python_work work = python_work_begin();
    rhw_context_set_goes_on(context, python_work_goes_on, &work);
    const enum rhw_result result = item->kind == PYTHON_ITEM_RECORDING
                                       ? rhw_recording_run(context, item->id.recording, stats)
                                       : rhw_pass_end(context, item->id.pass, stats);
    rhw_context_set_goes_on(context, NULL, NULL);
    PyEval_RestoreThread(work.state);
    return result;
}

// End a recorded pass as a recording.
static enum rhw_result keep_item(struct python_item *item)
{
    rhw_recording *recording;
    const enum rhw_result result = rhw_pass_keep(item->recorder, item->id.pass, NULL, &recording);
    rhw_context_destroy(item->recorder);
    item->recorder = NULL;
    item->kind = PYTHON_ITEM_RECORDING;
    item->id.recording = recording;
    return result;
}

// Misuse while it was recorded: the call that it was raised it, and the rest is drawn. Where a handler has raised an
// exception, that is told.
static PyObject *end_run(const struct pass *pass, enum rhw_result result, const struct rhw_stats *stats)
{
    const bool is_told = result == RHW_ERROR_MISUSE || result == RHW_ERROR_GIVEN_UP;
    if (!python_context_leave(pass->context, is_told ? RHW_OK : result)) {
        return NULL;
    }
    return Py_BuildValue("{s:K,s:K,s:K}", "triangles_in", (unsigned long long)stats->triangles_in,
                         "triangles_rasterized", (unsigned long long)stats->triangles_rasterized,
                         "fragments_shaded", (unsigned long long)stats->fragments_shaded);
}

static PyObject *pass_end(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    struct pass *pass = (struct pass *)self;
    rhw_context *context = enter(pass);
    if (!context) {
        return NULL;
    }
    struct python_item *item = pass->item;
    struct rhw_stats stats = {0};
    enum rhw_result result = item->recorder ? keep_item(item) : RHW_OK;
    if (item->kind == PYTHON_ITEM_PASS) {
        pass->item = NULL;
    }
    if (result == RHW_OK) {
        result = run_item(context, item, &stats);
    }
    if (!pass->item) {
        Py_DECREF(item->kept);
        free(item);
    }
    return end_run(pass, result, &stats);
}

static PyObject *pass_run(PyObject *self, PyObject *nothing)
{
    (void)nothing;
    struct pass *pass = (struct pass *)self;
    if (!has_item(pass, PYTHON_ITEM_RECORDING) || !pass->item->id.recording) {
        PyErr_SetString(PyExc_ValueError, "the pass cannot be run again: keep it, and end it first");
        return NULL;
    }
    rhw_context *context = python_context_enter(pass->context);
    if (!context) {
        return NULL;
    }
    struct rhw_stats stats = {0};
    const enum rhw_result result = run_item(context, pass->item, &stats);
    return end_run(pass, result, &stats);
}

int python_add_passes(PyObject *module)
{
    static PyMethodDef methods[] = {{"draw", pass_draw, METH_VARARGS, NULL},
                                    {"draw_program", pass_draw_program, METH_VARARGS, NULL},
                                    {"viewport", pass_viewport, METH_VARARGS, NULL},
                                    {"end", pass_end, METH_NOARGS, NULL},
                                    {"run", pass_run, METH_NOARGS, NULL},
                                    {"cancel", pass_cancel, METH_NOARGS, NULL},
                                    {0}};
    static PyType_Slot slots[] = {{Py_tp_new, (void *)(uintptr_t)pass_make},
                                  {Py_tp_dealloc, (void *)(uintptr_t)pass_free},
                                  {Py_tp_methods, methods},
                                  {0, NULL}};
    static PyType_Spec spec = {.name = "rhw._rhw.Pass",
                               .basicsize = sizeof(struct pass),
                               .flags = Py_TPFLAGS_DEFAULT,
                               .slots = slots};
    pass_type = python_add_type(module, "Pass", &spec);
    return pass_type ? 0 : -1;
}
