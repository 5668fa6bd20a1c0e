// SPDX-License-Identifier: MIT
// rhw under measurement. Textures and buffers are made when a scene is taken; a frame records and runs one
// pass, as a program does that draws a scene again and again.
#include "renderer.h"

#include "process.h"
#include "rhw/rhw.h"
#include "scene_pbr.h"
#include "shaders_bench.h"
#include "surface.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct bench_state {
    rhw_context *context;
    struct rhw_context_def def;
    const struct bench_scene *scene;
    int width, height;
    rhw_buffer *vertices, *indices; // per mesh
    rhw_texture *textures;
    rhw_sampler sampler;
    rhw_pipeline pipelines[BENCH_SHADERS][2]; // [shader][culls back faces]
    rhw_texture color, depth;
    struct scene_upload upload; // of the model of a physically based scene, instead of the above
    struct scene_surface_pipelines surface_pipelines;
};

static bool make_buffer(rhw_context *context, const void *data, size_t size, rhw_buffer *buffer)
{
    const struct rhw_buffer_def def = {.size = size, .data = data};
    return rhw_buffer_create(context, &def, buffer) == RHW_OK;
}

static bool make_meshes(struct bench_state *s)
{
    for (uint32_t i = 0; i < s->scene->mesh_count; i++) {
        const struct bench_mesh *const mesh = &s->scene->meshes[i];
        const size_t vertex_size = bench_mesh_stride(mesh) * sizeof *mesh->vertices;
        if (!make_buffer(s->context, mesh->vertices, mesh->vertex_count * vertex_size, &s->vertices[i]) ||
            !make_buffer(s->context, mesh->indices, mesh->index_count * sizeof *mesh->indices,
                         &s->indices[i])) {
            return false;
        }
    }
    return true;
}

static bool make_textures(struct bench_state *s)
{
    for (uint32_t i = 0; i < s->scene->texture_count; i++) {
        const struct bench_texture *const texture = &s->scene->textures[i];
        if (!texture->texels[0]) {
            continue; // of a slot that no draw reads
        }
        struct rhw_texture_def def = rhw_texture_def_default();
        def.format = texture->srgb ? RHW_FORMAT_RGBA8_SRGB : RHW_FORMAT_RGBA8_UNORM;
        def.width = texture->width;
        def.height = texture->height;
        def.mip_levels = texture->levels;
        if (rhw_texture_create(s->context, &def, &s->textures[i]) != RHW_OK) {
            return false;
        }
        for (int level = 0; level < texture->levels; level++) {
            rhw_texture_write(s->context, s->textures[i], level, texture->texels[level], 0);
        }
    }
    return true;
}

static bool make_target(struct bench_state *s, enum rhw_format format, rhw_texture *target)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = s->width;
    def.height = s->height;
    return rhw_texture_create(s->context, &def, target) == RHW_OK;
}

static void set_attributes(struct rhw_pipeline_def *def, const struct bench_mesh *mesh, uint32_t reads)
{
    static const enum rhw_vertex_format formats[BENCH_ATTRIBUTES] = {
        RHW_VERTEX_FLOAT3, RHW_VERTEX_FLOAT3, RHW_VERTEX_FLOAT2, RHW_VERTEX_FLOAT4, RHW_VERTEX_FLOAT4};
    uint32_t offset = 0;
    for (int a = 0; a < BENCH_ATTRIBUTES; a++) {
        if (reads >> a & 1) {
            def->attributes[def->attribute_count++] =
                (struct rhw_attribute){.format = formats[a], .offset = offset};
        }
        offset += mesh->has[a] ? (uint32_t)rhw_vertex_format_size(formats[a]) : 0;
    }
    def->buffers[0].stride = offset;
    def->buffer_count = 1;
}

// The meshes that a shader draws are laid out alike within a scene, so one pipeline serves them.
static bool make_pipeline(struct bench_state *s, const struct bench_draw *draw)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    bench_program(&def.program, draw->shader);
    set_attributes(&def, &s->scene->meshes[draw->mesh], bench_shader_attributes[draw->shader]);
    def.topology = s->scene->meshes[draw->mesh].points ? RHW_POINT_LIST : RHW_TRIANGLE_LIST;
    def.depth_range = RHW_DEPTH_MINUS_ONE_TO_ONE;
    def.cull = draw->cull_back ? RHW_CULL_BACK : RHW_CULL_NONE;
    def.depth_test = s->scene->depth_test;
    def.target_count = s->scene->has_color;
    const struct rhw_blend_component over = {RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA,
                                             RHW_BLEND_ADD};
    def.targets[0].blend = s->scene->blends;
    def.targets[0].color = def.targets[0].alpha = over;
    return rhw_pipeline_create(s->context, &def, &s->pipelines[draw->shader][draw->cull_back]) == RHW_OK;
}

static bool make_pipelines(struct bench_state *s)
{
    for (uint32_t i = 0; i < s->scene->draw_count; i++) {
        const struct bench_draw *const draw = &s->scene->draws[i];
        if (s->pipelines[draw->shader][draw->cull_back].generation == 0 && !make_pipeline(s, draw)) {
            return false;
        }
    }
    return true;
}

// Paths are a matter of the context: another one takes its place where the scene asks for other paths.
static bool use_paths(struct bench_state *s, enum rhw_paths paths)
{
    if (s->def.paths == paths) {
        return true;
    }
    struct rhw_context_def def = s->def;
    def.paths = paths;
    rhw_context *context;
    if (rhw_context_create(&def, &context) != RHW_OK) {
        return false;
    }
    rhw_context_destroy(s->context);
    s->context = context;
    s->def = def;
    return true;
}

static bool take(struct bench_renderer *renderer, const struct bench_scene *scene, int width, int height)
{
    struct bench_state *const s = renderer->state;
    if (!use_paths(s, scene->shades_all ? RHW_PATHS_IN_ORDER : RHW_PATHS_ALL)) {
        return false;
    }
    s->scene = scene;
    s->width = width;
    s->height = height;
    s->vertices = calloc((size_t)scene->mesh_count + 1, sizeof *s->vertices);
    s->indices = calloc((size_t)scene->mesh_count + 1, sizeof *s->indices);
    s->textures = calloc((size_t)scene->texture_count + 1, sizeof *s->textures);
    struct rhw_sampler_def sampler = rhw_sampler_def_default();
    sampler.max_anisotropy = (float)scene->max_anisotropy;
    if (scene->surfaces) {
        return make_target(s, RHW_FORMAT_RGBA8_SRGB, &s->color) &&
               scene_upload_create(s->context, scene->surfaces->model, &s->upload) == RHW_OK;
    }
    return s->vertices && s->indices && s->textures &&
           rhw_sampler_create(s->context, &sampler, &s->sampler) == RHW_OK &&
           (!scene->has_color || make_target(s, RHW_FORMAT_RGBA8_UNORM, &s->color)) &&
           (scene->has_color || make_target(s, RHW_FORMAT_D32_FLOAT, &s->depth)) && make_meshes(s) &&
           make_textures(s) && make_pipelines(s);
}

// Depth is the result where there is no colour, and else nothing that anybody keeps.
static struct rhw_pass_def pass_of(const struct bench_state *s)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    def.width = s->width;
    def.height = s->height;
    def.color_count = s->scene->has_color;
    def.colors[0].texture = s->scene->has_color ? s->color : (rhw_texture){0};
    memcpy(def.colors[0].clear, s->scene->clear, sizeof def.colors[0].clear);
    def.samples = s->scene->samples;
    def.depth.enabled = true;
    def.depth.texture = s->depth;
    def.depth.store = s->scene->has_color ? RHW_STORE_DISCARD : RHW_STORE_STORE;
    def.depth.clear = s->scene->surfaces ? 0.0f : 1.0f; // surfaces: reversed
    return def;
}

static bool open_and_close(const struct rhw_context_def *def)
{
    rhw_context *context;
    const enum rhw_result result = rhw_context_create(def, &context);
    rhw_context_destroy(context);
    return result == RHW_OK;
}

static enum rhw_result record_surfaces(struct bench_state *s, rhw_pass pass)
{
    const struct bench_surfaces *const surfaces = s->scene->surfaces;
    struct scene_surface_pass def = {
        .frame = &surfaces->frame, .formats = {RHW_FORMAT_RGBA8_SRGB}, .format_count = 1};
    memcpy(def.view_projection, surfaces->view_projection, sizeof def.view_projection);
    return scene_surfaces_record(&s->upload, &s->surface_pipelines, &def, pass);
}

static void record_draws(const struct bench_state *s, rhw_pass pass)
{
    const struct bench_scene *const scene = s->scene;
    for (uint32_t i = 0; i < scene->draw_count; i++) {
        const struct bench_draw *const draw = &scene->draws[i];
        rhw_pass_set_pipeline(s->context, pass, s->pipelines[draw->shader][draw->cull_back]);
        rhw_pass_set_vertex_buffer(s->context, pass, 0, s->vertices[draw->mesh], 0);
        rhw_pass_set_index_buffer(s->context, pass, s->indices[draw->mesh], RHW_INDEX_UINT32, 0);
        rhw_pass_set_uniforms(s->context, pass, &draw->uniforms, sizeof draw->uniforms);
        for (int t = 0; t < draw->texture_count; t++) {
            rhw_pass_set_texture(s->context, pass, t, s->textures[draw->textures[t]], s->sampler);
        }
        rhw_pass_draw_indexed(s->context, pass, 0, scene->meshes[draw->mesh].index_count, 0, 0, 1);
    }
}

static bool open_texture(rhw_context *context)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA8_UNORM;
    def.width = def.height = 8192;
    rhw_texture texture;
    const enum rhw_result result = rhw_texture_create(context, &def, &texture);
    if (result == RHW_OK) {
        rhw_texture_destroy(context, texture);
    }
    return result == RHW_OK;
}

static bool frame(struct bench_renderer *renderer)
{
    struct bench_state *const s = renderer->state;
    const struct bench_scene *const scene = s->scene;
    struct rhw_stats stats;
    if (scene->opens_context) {
        return open_and_close(&s->def);
    }
    if (scene->opens_texture) {
        return open_texture(s->context);
    }
    if (scene->makes_mips) {
        return rhw_texture_generate_mips(s->context, s->textures[0]) == RHW_OK;
    }
    if (scene->renders_file) {
        return bench_render_process(scene->renders_file, s->width, s->height, renderer->threads,
                                    renderer->isa);
    }
    const struct rhw_pass_def def = pass_of(s);
    rhw_pass pass;
    if (rhw_pass_begin(s->context, &def, &pass) != RHW_OK) {
        return false;
    }
    enum rhw_result recorded = RHW_OK;
    if (scene->surfaces) {
        recorded = record_surfaces(s, pass);
    } else {
        record_draws(s, pass);
    }
    const enum rhw_result ended = rhw_pass_end(s->context, pass, &stats);
    const enum rhw_result result = recorded == RHW_OK ? ended : recorded;
    renderer->fragments = result == RHW_OK ? stats.fragments_shaded : 0;
    return result == RHW_OK;
}

static bool read_image(struct bench_renderer *renderer, struct bench_image *image)
{
    const struct bench_state *const s = renderer->state;
    if (image->color) {
        rhw_texture_read(s->context, s->color, 0, image->color, 0);
    }
    if (image->depth) {
        rhw_texture_read(s->context, s->depth, 0, image->depth, 0);
    }
    return true;
}

static void drop_texture(const struct bench_state *s, rhw_texture texture)
{
    if (texture.generation) {
        rhw_texture_destroy(s->context, texture);
    }
}

static void drop_buffer(const struct bench_state *s, rhw_buffer buffer)
{
    if (buffer.generation) {
        rhw_buffer_destroy(s->context, buffer);
    }
}

static void release(struct bench_renderer *renderer)
{
    struct bench_state *const s = renderer->state;
    for (uint32_t i = 0; s->vertices && s->indices && i < s->scene->mesh_count; i++) {
        drop_buffer(s, s->vertices[i]);
        drop_buffer(s, s->indices[i]);
    }
    for (uint32_t i = 0; s->textures && i < s->scene->texture_count; i++) {
        drop_texture(s, s->textures[i]);
    }
    for (int i = 0; i < 2 * BENCH_SHADERS; i++) {
        if (s->pipelines[i / 2][i % 2].generation) {
            rhw_pipeline_destroy(s->context, s->pipelines[i / 2][i % 2]);
        }
    }
    scene_surface_pipelines_destroy(s->context, &s->surface_pipelines);
    if (s->upload.model) {
        scene_upload_destroy(&s->upload);
    }
    drop_texture(s, s->color);
    drop_texture(s, s->depth);
    if (s->sampler.generation) {
        rhw_sampler_destroy(s->context, s->sampler);
    }
    free(s->vertices);
    free(s->indices);
    free(s->textures);
    *s = (struct bench_state){.context = s->context, .def = s->def};
}

static void close_rhw(struct bench_renderer *renderer)
{
    struct bench_state *const s = renderer->state;
    if (s) {
        rhw_context_destroy(s->context);
    }
    free(s);
    *renderer = (struct bench_renderer){0};
}

bool bench_open_rhw(struct bench_renderer *renderer, int threads, enum rhw_isa isa, const char **why)
{
    struct bench_state *const s = calloc(1, sizeof *s);
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    def.isa_limit = rhw_isa_up_to(isa);
    const enum rhw_result result = s ? rhw_context_create(&def, &s->context) : RHW_ERROR_OUT_OF_MEMORY;
    *why = rhw_result_string(result);
    if (result != RHW_OK) {
        free(s);
        return false;
    }
    s->def = def;
    *renderer = (struct bench_renderer){.state = s,
                                        .threads = rhw_context_threads(s->context),
                                        .isa = rhw_context_isa(s->context),
                                        .take = take,
                                        .frame = frame,
                                        .read = read_image,
                                        .release = release,
                                        .close = close_rhw};
    snprintf(renderer->name, sizeof renderer->name, "rhw %s %s, %d thread%s", rhw_version(),
             rhw_isa_name(rhw_context_isa(s->context)), rhw_context_threads(s->context),
             rhw_context_threads(s->context) == 1 ? "" : "s");
    return true;
}
