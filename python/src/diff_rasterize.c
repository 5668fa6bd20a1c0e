// SPDX-License-Identifier: MIT
// Rasterization for rhw.diff: the library draws every image in a pass of its own, and what it finds is copied out.
#include "context_object.h"
#include "diff_mesh.h"
#include "diff_shaders.h"

#include <stdlib.h>

struct work {
    struct diff_mesh mesh;
    const float *positions; // [images or 1][vertices][4]
    size_t position_stride; // floats from image to image; 0: all have the same
    const uint32_t *ranges; // [images][2]: first triangle and count; NULL: all of them
    float *values, *slopes; // [images][height][width][4]
    const float *before;    // [images][height][width]: depths of the layer before; NULL: nothing is peeled
    float *depths;          // the same of this layer; NULL: not asked for
};

// What a call makes in the context; null ids are ones that were not made.
struct items {
    rhw_buffer positions, corners;
    rhw_texture values, slopes, depths, before;
    rhw_sampler sampler;
    rhw_pipeline pipeline;
};

static void free_items(rhw_context *context, const struct items *items)
{
    rhw_pipeline_destroy(context, items->pipeline);
    rhw_sampler_destroy(context, items->sampler);
    rhw_texture_destroy(context, items->values);
    rhw_texture_destroy(context, items->slopes);
    rhw_texture_destroy(context, items->depths);
    rhw_texture_destroy(context, items->before);
    rhw_buffer_destroy(context, items->positions);
    rhw_buffer_destroy(context, items->corners);
}

static enum rhw_result make_texture(rhw_context *context, const struct diff_mesh *mesh,
                                    enum rhw_format format, rhw_texture *texture)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = (int)mesh->width;
    def.height = (int)mesh->height;
    return rhw_texture_create(context, &def, texture);
}

static enum rhw_result make_pipeline(rhw_context *context, bool peels, rhw_pipeline *pipeline)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){.vertex = RHW_ISA_TABLE(diff_vertex),
                                       .fragment = RHW_ISA_TABLE(diff_fragment),
                                       .varyings = {{.components = 1}},
                                       .varying_count = 1,
                                       .uses = RHW_USE_COORD | RHW_USE_IDS | RHW_USE_BARYCENTRIC |
                                               RHW_USE_BARYCENTRIC_DERIVATIVES |
                                               (peels ? (uint32_t)RHW_USE_DISCARD : 0),
                                       .uniform_size = sizeof(struct diff_uniforms)};
    def.attributes[0] = (struct rhw_attribute){.format = RHW_VERTEX_FLOAT4};
    def.attribute_count = def.buffer_count = 1;
    def.depth_range = RHW_DEPTH_MINUS_ONE_TO_ONE;
    def.depth_test = true;
    def.targets[0] = def.targets[1] = (struct rhw_color_target){.format = RHW_FORMAT_RGBA32_FLOAT};
    def.target_count = 2;
    return rhw_pipeline_create(context, &def, pipeline);
}

static enum rhw_result make_buffer(rhw_context *context, const void *data, size_t size, rhw_buffer *buffer)
{
    struct rhw_buffer_def def = rhw_buffer_def_default();
    def.data = data;
    def.size = size;
    return rhw_buffer_create(context, &def, buffer);
}

static enum rhw_result make_items(rhw_context *context, const struct work *work, struct items *items)
{
    const struct diff_mesh *const mesh = &work->mesh;
    const struct rhw_sampler_def sampler = {.min_filter = RHW_FILTER_NEAREST,
                                            .mag_filter = RHW_FILTER_NEAREST};
    enum rhw_result result = make_texture(context, mesh, RHW_FORMAT_RGBA32_FLOAT, &items->values);
    if (result == RHW_OK) {
        result = make_texture(context, mesh, RHW_FORMAT_RGBA32_FLOAT, &items->slopes);
    }
    if (result == RHW_OK) {
        result = make_texture(context, mesh, RHW_FORMAT_D32_FLOAT, &items->depths);
    }
    if (result == RHW_OK && work->before) {
        result = make_texture(context, mesh, RHW_FORMAT_R32_FLOAT, &items->before);
    }
    if (result == RHW_OK) {
        result = rhw_sampler_create(context, &sampler, &items->sampler);
    }
    if (result == RHW_OK) {
        result = make_pipeline(context, work->before != NULL, &items->pipeline);
    }
    const size_t copies = work->position_stride ? mesh->images : 1;
    if (result == RHW_OK) {
        result = make_buffer(context, work->positions, copies * mesh->vertices * 4 * sizeof(float),
                             &items->positions);
    }
    if (result == RHW_OK) {
        result = make_buffer(context, mesh->corners, mesh->triangles * 3 * sizeof(uint32_t), &items->corners);
    }
    return result;
}

static void record(rhw_context *context, rhw_pass pass, const struct work *work, const struct items *items,
                   size_t image)
{
    const size_t first = work->ranges ? work->ranges[2 * image] : 0;
    const size_t count = work->ranges ? work->ranges[2 * image + 1] : work->mesh.triangles;
    const struct diff_uniforms uniforms = {(int32_t)first, work->before != NULL};
    rhw_pass_set_pipeline(context, pass, items->pipeline);
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    rhw_pass_set_vertex_buffer(context, pass, 0, items->positions,
                               image * work->position_stride * sizeof(float));
    rhw_pass_set_index_buffer(context, pass, items->corners, RHW_INDEX_UINT32, 0);
    if (work->before) {
        rhw_pass_set_texture(context, pass, 0, items->before, items->sampler);
    }
    rhw_pass_draw_indexed(context, pass, (uint32_t)(3 * first), (uint32_t)(3 * count), 0, 0, 1);
}

static enum rhw_result draw_image(rhw_context *context, const struct work *work, const struct items *items,
                                  size_t image)
{
    const size_t pixels = diff_mesh_pixels(&work->mesh);
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 2;
    def.colors[0] = (struct rhw_color_attachment){.texture = items->values, .load = RHW_LOAD_CLEAR};
    def.colors[1] = (struct rhw_color_attachment){.texture = items->slopes, .load = RHW_LOAD_CLEAR};
    def.depth = (struct rhw_depth_attachment){
        .enabled = true, .texture = items->depths, .load = RHW_LOAD_CLEAR, .clear = 1.0f};
    enum rhw_result result = RHW_OK;
    if (work->before) {
        result = rhw_texture_write(context, items->before, 0, work->before + pixels * image, 0);
    }
    rhw_pass pass;
    if (result == RHW_OK) {
        result = rhw_pass_begin(context, &def, &pass);
    }
    if (result == RHW_OK) {
        record(context, pass, work, items, image);
        result = rhw_pass_end(context, pass, NULL);
    }
    if (result == RHW_OK) {
        result = rhw_texture_read(context, items->values, 0, work->values + 4 * pixels * image, 0);
    }
    if (result == RHW_OK) {
        result = rhw_texture_read(context, items->slopes, 0, work->slopes + 4 * pixels * image, 0);
    }
    if (result == RHW_OK && work->depths) {
        result = rhw_texture_read(context, items->depths, 0, work->depths + pixels * image, 0);
    }
    return result;
}

static enum rhw_result draw(rhw_context *context, struct work *work)
{
    struct items items = {0};
    enum rhw_result result = make_items(context, work, &items);
    for (size_t image = 0;
         result == RHW_OK && image < work->mesh.images && diff_crew_goes_on(&work->mesh.crew); image++) {
        result = draw_image(context, work, &items, image);
    }
    free_items(context, &items);
    return result;
}

static bool read_ranges(PyObject *object, struct work *work)
{
    struct python_array array;
    if (!python_array_read_optional(object, "ranges", "<u4", &array)) {
        return false;
    }
    work->ranges = array.data;
    bool good = !array.data || (size_t)array.count == 2 * work->mesh.images;
    for (size_t i = 0; good && array.data && i < work->mesh.images; i++) {
        good = (size_t)work->ranges[2 * i] + work->ranges[2 * i + 1] <= work->mesh.triangles;
    }
    if (!good) {
        PyErr_SetString(PyExc_ValueError, "ranges: names triangles that are not there");
    }
    return good;
}

// (context, mesh, positions, whether all images have the same, ranges or None, values, slopes, depths of the layer
// before or None, depths or None)
static PyObject *rasterize(PyObject *module, PyObject *arguments)
{
    (void)module;
    PyObject *context, *mesh, *positions, *ranges, *values, *slopes, *before, *depths;
    struct work work = {0};
    int shared;
    if (!PyArg_ParseTuple(arguments, "OOOpOOOOO:diff_rasterize", &context, &mesh, &positions, &shared,
                          &ranges, &values, &slopes, &before, &depths) ||
        !python_context_check(context) || !diff_mesh_read(mesh, &work.mesh)) {
        return NULL;
    }
    const size_t pixels = work.mesh.images * diff_mesh_pixels(&work.mesh), floats = 4 * work.mesh.vertices;
    work.position_stride = shared ? 0 : floats;
    if (!diff_floats(positions, "pos", shared ? floats : diff_times(work.mesh.images, floats),
                     &work.positions) ||
        !read_ranges(ranges, &work) || !diff_result(values, "rast", 4 * pixels, &work.values) ||
        !diff_result(slopes, "rast_db", 4 * pixels, &work.slopes) ||
        !diff_floats_optional(before, "before", pixels, &work.before) ||
        !diff_result_optional(depths, "depths", pixels, &work.depths)) {
        return NULL;
    }
    rhw_context *handle = python_context_enter(context);
    if (!handle) {
        return NULL;
    }
    diff_crew_begin(&work.mesh.crew);
    rhw_context_set_goes_on(handle, python_work_goes_on, &work.mesh.crew.python);
    const enum rhw_result result = draw(handle, &work);
    rhw_context_set_goes_on(handle, NULL, NULL);
    PyObject *const none = diff_crew_end(&work.mesh.crew, true);
    // Where a handler has raised an exception, that is told.
    if (!python_context_leave(context, result == RHW_ERROR_GIVEN_UP ? RHW_OK : result)) {
        Py_XDECREF(none);
        return NULL;
    }
    return none;
}

PyMethodDef python_diff_rasterize_functions[] = {{"diff_rasterize", rasterize, METH_VARARGS, NULL}, {0}};
