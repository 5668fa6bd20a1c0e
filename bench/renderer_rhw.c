// SPDX-License-Identifier: MIT
// rhw under measurement. Textures and buffers are made when a scene is taken; a frame records and runs its
// passes, as a program does that draws a scene again and again.
#include "renderer.h"

#include "process.h"
#include "renderer_rhw.h"
#include "scene_pbr.h"
#include "draw/shadow.h"
#include "shaders_bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    return bench_rhw_upload(s);
}

// Depth that is not kept needs no memory of its own.
static struct rhw_pass_def describe(const struct bench_state *s, const struct bench_pass *pass)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    const bool to_picture = pass == &s->scene->passes[s->scene->pass_count - 1];
    def.width = s->width;
    def.height = s->height;
    bench_pass_size(s->scene, pass, &def.width, &def.height);
    def.color_count = pass->color_count;
    for (int i = 0; i < pass->color_count; i++) {
        struct rhw_color_attachment *const color = &def.colors[i];
        color->texture = pass->colors[i] == BENCH_PICTURE ? s->color : s->textures[pass->colors[i]];
        color->layer = i == 0 ? pass->face : 0;
        memcpy(color->clear, pass->clear, sizeof color->clear);
    }
    def.samples = to_picture ? s->scene->samples : 0;
    def.depth.enabled = pass->depth != BENCH_PASS_NO_DEPTH;
    def.depth.store = pass->depth == BENCH_PASS_DEPTH_KEPT ? RHW_STORE_STORE : RHW_STORE_DISCARD;
    def.depth.clear = s->scene->surfaces ? 0.0f : 1.0f; // surfaces: reversed
    if (pass->depth == BENCH_PASS_DEPTH_KEPT) {
        def.depth.texture =
            pass->depth_texture == BENCH_PICTURE ? s->depth : s->textures[pass->depth_texture];
    } else if (pass->depth == BENCH_PASS_DEPTH_STENCIL) {
        def.depth.format = RHW_FORMAT_D24_UNORM_S8_UINT;
        def.depth.stencil_store = RHW_STORE_DISCARD;
    }
    return def;
}

static bool open_and_close(const struct rhw_context_def *def)
{
    rhw_context *context;
    const enum rhw_result result = rhw_context_create(def, &context);
    rhw_context_destroy(context);
    return result == RHW_OK;
}

static enum rhw_result record_surfaces(struct bench_state *s, rhw_pass pass, bool to_picture)
{
    const struct bench_surfaces *const surfaces = s->scene->surfaces;
    struct scene_surface_pass def = {
        .frame = to_picture ? &surfaces->frame : &surfaces->light_frame,
        .solid = !to_picture,
        .order = &s->order,
        .formats = {to_picture ? RHW_FORMAT_RGBA8_SRGB : RHW_FORMAT_RGBA16_FLOAT},
        .format_count = 1};
    if (surfaces->is_glass && to_picture) {
        def.backdrop = s->textures[s->scene->texture_count - 1];
        def.backdrop_sampler = s->samplers[BENCH_LEVELS];
    }
    memcpy(def.view_projection, surfaces->view_projection, sizeof def.view_projection);
    return scene_surfaces_record(&s->upload, &s->surface_pipelines, &def, pass);
}

static void set_uniforms(const struct bench_state *s, rhw_context *context, rhw_pass pass,
                         const struct bench_draw *draw)
{
    float both[BENCH_UNIFORMS_MAX];
    if (bench_shader_shared[draw->shader] == 0) {
        rhw_pass_set_uniforms(context, pass, &draw->uniforms, sizeof draw->uniforms);
        return;
    }
    rhw_pass_set_uniforms(context, pass, both, bench_uniforms_copy(s->scene, draw, both) * sizeof *both);
}

// Records draws in the context of the scene, or in its recorder.
static void record_draws(const struct bench_state *s, rhw_context *context, rhw_pass pass, uint32_t first,
                         uint32_t count)
{
    const struct bench_scene *const scene = s->scene;
    for (uint32_t i = first; i < first + count; i++) {
        const struct bench_draw *const draw = &scene->draws[i];
        const struct bench_mesh *const mesh = &scene->meshes[draw->mesh];
        if (scene->writes_between) {
            rhw_buffer_write(s->context, s->vertices[draw->mesh], 0, mesh->vertices,
                             bench_mesh_stride(mesh) * sizeof *mesh->vertices);
        }
        rhw_pass_set_pipeline(context, pass, s->pipelines[i]);
        rhw_pass_set_vertex_buffer(context, pass, 0, s->vertices[draw->mesh], 0);
        if (mesh->instance_count) {
            rhw_pass_set_vertex_buffer(context, pass, 1, s->instances[draw->mesh], 0);
        }
        rhw_pass_set_index_buffer(context, pass, s->indices[draw->mesh], RHW_INDEX_UINT32, 0);
        set_uniforms(s, context, pass, draw);
        if (draw->has_scissor) {
            const struct rhw_rect scissor = {draw->scissor[0], draw->scissor[1], draw->scissor[2],
                                             draw->scissor[3]};
            rhw_pass_set_scissor(context, pass, &scissor);
        }
        for (int t = 0; t < draw->texture_count; t++) {
            const uint32_t texture = draw->textures[t];
            rhw_pass_set_texture(context, pass, t, s->textures[texture],
                                 s->samplers[scene->textures[texture].filter]);
        }
        rhw_pass_draw_indexed(context, pass, 0, mesh->index_count, 0, 0,
                              mesh->instance_count ? mesh->instance_count : 1);
    }
}

// Records the pass of a scene that is replayed, once.
static bool keep_pass(struct bench_state *s, const struct bench_pass *pass)
{
    const struct rhw_pass_def def = describe(s, pass);
    const struct rhw_recording_def kept = {.label = "replayed", .keeps_triangles = s->scene->keeps_triangles};
    rhw_pass id;
    if (rhw_recorder_create(s->context, &s->recorder) != RHW_OK ||
        rhw_pass_begin(s->recorder, &def, &id) != RHW_OK) {
        return false;
    }
    record_draws(s, s->recorder, id, pass->first_draw, pass->draw_count);
    return rhw_pass_keep(s->recorder, id, &kept, &s->recording) == RHW_OK;
}

static bool replay_pass(struct bench_state *s, const struct bench_pass *pass, struct rhw_stats *stats)
{
    return (s->recording || keep_pass(s, pass)) &&
           rhw_recording_run(s->context, s->recording, stats) == RHW_OK;
}

static void add_stats(struct bench_renderer *renderer, const struct rhw_stats *stats)
{
    renderer->fragments += stats->fragments_shaded;
    renderer->stages.front += stats->front_ms;
    renderer->stages.back += stats->back_ms;
    renderer->stages.front_busy += stats->front_busy_ms;
    renderer->stages.back_busy += stats->back_busy_ms;
}

static bool run_pass(struct bench_state *s, const struct bench_pass *pass, struct rhw_stats *stats)
{
    const struct bench_surfaces *const surfaces = s->scene->surfaces;
    if (surfaces && pass->color_count == 0) {
        return scene_shadow_draw(&s->upload, &s->surface_pipelines, &surfaces->light_frame, &surfaces->map,
                                 &s->map, stats) == RHW_OK;
    }
    if (s->scene->replays) {
        return replay_pass(s, pass, stats);
    }
    const struct rhw_pass_def def = describe(s, pass);
    rhw_pass id;
    if (rhw_pass_begin(s->context, &def, &id) != RHW_OK) {
        return false;
    }
    enum rhw_result recorded = RHW_OK;
    if (surfaces) {
        recorded = record_surfaces(s, id, pass->colors[0] == BENCH_PICTURE);
    } else {
        record_draws(s, s->context, id, pass->first_draw, pass->draw_count);
    }
    const enum rhw_result ended = rhw_pass_end(s->context, id, stats);
    return recorded == RHW_OK && ended == RHW_OK &&
           (!pass->makes_levels ||
            rhw_texture_generate_mips(s->context, s->textures[pass->colors[0]]) == RHW_OK);
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
    bool works = true;
    renderer->fragments = 0;
    renderer->stages = (struct bench_stages){0};
    for (uint32_t i = 0; works && i < scene->pass_count; i++) {
        struct rhw_stats stats;
        works = run_pass(s, &scene->passes[i], &stats);
        if (works) {
            add_stats(renderer, &stats);
        }
    }
    return works;
}

// Copies out a picture of any format as RGBA8.
static bool read_converted(const struct bench_state *s, uint8_t *color)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA8_UNORM;
    def.width = s->width;
    def.height = s->height;
    rhw_texture copy;
    if (rhw_texture_create(s->context, &def, &copy) != RHW_OK) {
        return false;
    }
    const struct rhw_blit_region all = {.x1 = s->width, .y1 = s->height, .z1 = 1};
    const bool made = rhw_texture_blit(s->context, s->color, &all, copy, &all, RHW_FILTER_NEAREST) == RHW_OK;
    rhw_texture_read(s->context, copy, 0, color, 0);
    rhw_texture_destroy(s->context, copy);
    return made;
}

static bool read_image(struct bench_renderer *renderer, struct bench_image *image)
{
    const struct bench_state *const s = renderer->state;
    if (image->color && s->scene->picture != BENCH_RGBA8) {
        return read_converted(s, image->color);
    }
    if (image->color) {
        rhw_texture_read(s->context, s->color, 0, image->color, 0);
    }
    if (image->depth) {
        rhw_texture_read(s->context, s->depth, 0, image->depth, 0);
    }
    return true;
}

static void release(struct bench_renderer *renderer)
{
    bench_rhw_drop(renderer->state);
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
