// SPDX-License-Identifier: MIT
// Triangles from arrays to ids, depth and weights: the pipeline with nothing around it.
#include "web_module.h"

#include <emscripten.h>
#include <string.h>

#include "message.h"
#include "rhw/rhw.h"
#include "rhw/shader.h"

enum { IDS, BARYCENTRIC, TARGETS };

static bool fail(enum rhw_result result)
{
    if (result != RHW_OK) {
        cli_error("rasterize", "%s", rhw_result_string(result));
    }
    return result != RHW_OK;
}

// Bad input ----------------------------------------------------------------------------------------

static bool check(const struct web_triangles *t)
{
    if (t->width < 1 || t->height < 1 || t->width > RHW_MAX_TARGET_SIZE || t->height > RHW_MAX_TARGET_SIZE) {
        cli_error("rasterize", "size %dx%d: width and height must lie between 1 and %d", t->width, t->height,
                  RHW_MAX_TARGET_SIZE);
        return false;
    }
    if (t->index_count % 3 != 0) {
        cli_error("rasterize", "%u %s: a triangle takes three", t->index_count,
                  t->indices ? "indices" : "positions");
        return false;
    }
    for (uint32_t i = 0; i < t->index_count && t->indices; i++) {
        if (t->indices[i] >= t->vertex_count) {
            cli_error("rasterize", "index %u at %u: there are %u positions", t->indices[i], i,
                      t->vertex_count);
            return false;
        }
    }
    return true;
}

// Shaders ------------------------------------------------------------------------------------------

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const float *const m = groups[i].uniforms;
        const rhw_float *const p = groups[i].attribute[0];
        for (int row = 0; row < 4; row++) {
            groups[i].position[row] =
                m[row] * p[0] + m[row + 4] * p[1] + m[row + 8] * p[2] + m[row + 12] * p[3];
        }
    }
}

// Clip coordinates go through untouched: adding products with 0 would make NaN of what is infinite.
static void pass_on(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        memcpy(groups[i].position, groups[i].attribute[0], sizeof groups[i].position);
    }
}

static void identify(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        groups[i].color[IDS][0] = rhw_float_from_bits(groups[i].primitive + 1);
        for (int k = 0; k < 3; k++) {
            groups[i].color[BARYCENTRIC][k] = groups[i].barycentric[k];
        }
        groups[i].color[BARYCENTRIC][3] = rhw_splat(0);
    }
}

// Drawing ------------------------------------------------------------------------------------------

static enum rhw_result make_target(rhw_context *context, const struct web_triangles *t,
                                   enum rhw_format format, rhw_texture *texture)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = t->width;
    def.height = t->height;
    return rhw_texture_create(context, &def, texture);
}

static enum rhw_result make_buffer(rhw_context *context, const void *data, size_t size, rhw_buffer *buffer)
{
    return rhw_buffer_create(context, &(struct rhw_buffer_def){.size = size, .data = data}, buffer);
}

static enum rhw_result make_pipeline(rhw_context *context, const struct web_triangles *t,
                                     rhw_pipeline *pipeline)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){.vertex = {t->matrix ? place : pass_on},
                                       .fragment = {identify},
                                       .uniform_size = t->matrix ? 16 * sizeof(float) : 0,
                                       .uses = RHW_USE_IDS | RHW_USE_BARYCENTRIC};
    def.attributes[0].format = t->components == 4 ? RHW_VERTEX_FLOAT4 : RHW_VERTEX_FLOAT3;
    def.attribute_count = 1;
    def.buffer_count = 1;
    def.cull = (enum rhw_cull)t->cull;
    def.depth_range = (enum rhw_depth_range)t->depth_range;
    def.depth_test = true;
    def.targets[IDS].format = RHW_FORMAT_R32_UINT;
    def.targets[BARYCENTRIC].format = RHW_FORMAT_RGBA32_FLOAT;
    def.target_count = TARGETS;
    return rhw_pipeline_create(context, &def, pipeline);
}

static enum rhw_result record(rhw_context *context, rhw_pass pass, const struct web_triangles *t)
{
    rhw_pipeline pipeline;
    rhw_buffer positions, indices;
    enum rhw_result result = make_pipeline(context, t, &pipeline);
    if (result == RHW_OK) {
        const size_t size = (size_t)t->vertex_count * (size_t)t->components * sizeof *t->positions;
        result = make_buffer(context, t->positions, size, &positions);
    }
    if (result != RHW_OK) {
        return result;
    }
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, positions, 0);
    if (t->matrix) {
        rhw_pass_set_uniforms(context, pass, t->matrix, 16 * sizeof *t->matrix);
    }
    if (!t->indices) {
        rhw_pass_draw(context, pass, 0, t->index_count, 0, 1);
        return RHW_OK;
    }
    result = make_buffer(context, t->indices, t->index_count * sizeof *t->indices, &indices);
    if (result == RHW_OK) {
        rhw_pass_set_index_buffer(context, pass, indices, RHW_INDEX_UINT32, 0);
        rhw_pass_draw_indexed(context, pass, 0, t->index_count, 0, 0, 1);
    }
    return result;
}

static enum rhw_result draw(rhw_context *context, struct web_triangles *t)
{
    static const enum rhw_format formats[TARGETS] = {RHW_FORMAT_R32_UINT, RHW_FORMAT_RGBA32_FLOAT};
    struct rhw_pass_def def = rhw_pass_def_default();
    enum rhw_result result = make_target(context, t, RHW_FORMAT_D32_FLOAT, &def.depth.texture);
    for (int i = 0; i < TARGETS && result == RHW_OK; i++) {
        result = make_target(context, t, formats[i], &def.colors[i].texture);
    }
    def.color_count = TARGETS;
    def.depth.enabled = true;
    rhw_pass pass;
    if (result == RHW_OK) {
        result = rhw_pass_begin(context, &def, &pass);
    }
    if (result != RHW_OK) {
        return result;
    }
    result = t->index_count > 0 ? record(context, pass, t) : RHW_OK;
    struct rhw_stats stats = {0};
    const enum rhw_result ended = rhw_pass_end(context, pass, &stats);
    t->threads = stats.threads;
    result = result == RHW_OK ? ended : result;
    if (result == RHW_OK && t->ids) {
        result = rhw_texture_read(context, def.colors[IDS].texture, 0, t->ids, 0);
    }
    if (result == RHW_OK && t->barycentric) {
        result = rhw_texture_read(context, def.colors[BARYCENTRIC].texture, 0, t->barycentric, 0);
    }
    if (result == RHW_OK && t->depth) {
        result = rhw_texture_read(context, def.depth.texture, 0, t->depth, 0);
    }
    return result;
}

EMSCRIPTEN_KEEPALIVE bool web_rasterize(struct web_triangles *triangles)
{
    web_messages_clear();
    if (!check(triangles)) {
        return false;
    }
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = triangles->threads;
    rhw_context *context;
    if (fail(rhw_context_create(&def, &context))) {
        return false;
    }
    const bool failed = fail(draw(context, triangles));
    rhw_context_destroy(context); // and all that is in it
    return !failed;
}
