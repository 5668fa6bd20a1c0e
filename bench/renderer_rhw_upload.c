// SPDX-License-Identifier: MIT
// The buffers, textures, samplers and pipelines of a scene, for rhw; see renderer_rhw.h.
#include "renderer_rhw.h"

#include "scene_pbr.h"
#include "shaders_bench.h"

#include <stdlib.h>
#include <string.h>

static const enum rhw_format formats[] = {
    [BENCH_RGBA8] = RHW_FORMAT_RGBA8_UNORM,    [BENCH_SRGB8_ALPHA8] = RHW_FORMAT_RGBA8_SRGB,
    [BENCH_RGBA16F] = RHW_FORMAT_RGBA16_FLOAT, [BENCH_R32F] = RHW_FORMAT_R32_FLOAT,
    [BENCH_D32F] = RHW_FORMAT_D32_FLOAT,       [BENCH_R8] = RHW_FORMAT_R8_UNORM,
    [BENCH_RG8] = RHW_FORMAT_RG8_UNORM,        [BENCH_BGRA8] = RHW_FORMAT_BGRA8_UNORM,
    [BENCH_R16] = RHW_FORMAT_R16_UNORM,        [BENCH_RG16] = RHW_FORMAT_RG16_UNORM,
    [BENCH_RGBA16] = RHW_FORMAT_RGBA16_UNORM,  [BENCH_RGB10A2] = RHW_FORMAT_RGB10A2_UNORM,
    [BENCH_RGB565] = RHW_FORMAT_RGB565_UNORM,  [BENCH_R16F] = RHW_FORMAT_R16_FLOAT,
    [BENCH_RG16F] = RHW_FORMAT_RG16_FLOAT,     [BENCH_RG32F] = RHW_FORMAT_RG32_FLOAT,
    [BENCH_RGBA32F] = RHW_FORMAT_RGBA32_FLOAT, [BENCH_RG11B10F] = RHW_FORMAT_RG11B10_FLOAT,
    [BENCH_RGBA4] = RHW_FORMAT_RGBA4_UNORM,    [BENCH_RGB5A1] = RHW_FORMAT_RGB5A1_UNORM,
    [BENCH_RGBA8S] = RHW_FORMAT_RGBA8_SNORM,   [BENCH_RGBA16S] = RHW_FORMAT_RGBA16_SNORM};

// Buffers and textures -------------------------------------------------------------------------------

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
        const size_t instance_size = bench_mesh_instance_stride(mesh) * sizeof *mesh->instances;
        if (!make_buffer(s->context, mesh->vertices, mesh->vertex_count * vertex_size, &s->vertices[i]) ||
            !make_buffer(s->context, mesh->indices, mesh->index_count * sizeof *mesh->indices,
                         &s->indices[i]) ||
            (mesh->instance_count && !make_buffer(s->context, mesh->instances,
                                                  mesh->instance_count * instance_size, &s->instances[i]))) {
            return false;
        }
    }
    return true;
}

static bool make_texture(struct bench_state *s, uint32_t i)
{
    const struct bench_texture *const texture = &s->scene->textures[i];
    if (!texture->target && !texture->texels[0]) {
        return true; // of a slot that no draw reads
    }
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = formats[texture->format];
    def.kind = texture->cube ? RHW_TEXTURE_CUBE : RHW_TEXTURE_2D;
    def.width = texture->width;
    def.height = texture->height;
    def.mip_levels = texture->levels;
    const bool made = rhw_texture_create(s->context, &def, &s->textures[i]) == RHW_OK;
    for (int level = 0; made && level < texture->levels && !texture->target; level++) {
        rhw_texture_write(s->context, s->textures[i], level, texture->texels[level], 0);
    }
    return made;
}

static bool make_textures(struct bench_state *s)
{
    bool made = true;
    for (uint32_t i = 0; made && i < s->scene->texture_count; i++) {
        made = make_texture(s, i);
    }
    return made;
}

static bool make_samplers(struct bench_state *s)
{
    for (int filter = 0; filter < BENCH_FILTERS; filter++) {
        struct rhw_sampler_def def = rhw_sampler_def_default();
        if (filter != BENCH_TRILINEAR) {
            def.address_u = def.address_v = RHW_ADDRESS_CLAMP;
        }
        if (filter > BENCH_LEVELS) {
            def.mip_filter = RHW_MIP_FILTER_NONE;
        }
        def.max_anisotropy = filter == BENCH_TRILINEAR ? (float)s->scene->max_anisotropy : 0.0f;
        def.compares = filter == BENCH_COMPARE;
        def.compare = def.compares ? RHW_COMPARE_LESS_EQUAL : RHW_COMPARE_LESS;
        if (rhw_sampler_create(s->context, &def, &s->samplers[filter]) != RHW_OK) {
            return false;
        }
    }
    return true;
}

bool bench_rhw_draws_surfaces(const struct bench_state *s)
{
    return s->scene->surfaces && !s->translated;
}

// Pictures of scenes with surfaces are in sRGB.
static enum rhw_format picture_format(const struct bench_scene *scene)
{
    return scene->surfaces ? RHW_FORMAT_RGBA8_SRGB : formats[scene->picture];
}

static bool make_picture(struct bench_state *s, enum rhw_format format, rhw_texture *target)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = s->width;
    def.height = s->height;
    return rhw_texture_create(s->context, &def, target) == RHW_OK;
}

// Pipelines ------------------------------------------------------------------------------------------

static void set_attributes(struct rhw_pipeline_def *def, const struct bench_mesh *mesh, uint32_t reads)
{
    static const enum rhw_vertex_format of_components[] = {
        [2] = RHW_VERTEX_FLOAT2, RHW_VERTEX_FLOAT3, RHW_VERTEX_FLOAT4};
    uint32_t offsets[2] = {0};
    for (int a = 0; a < BENCH_ATTRIBUTES; a++) {
        const int components = bench_attribute_components[a], buffer = a >= BENCH_VERTEX_ATTRIBUTES;
        if (reads >> a & 1) {
            def->attributes[def->attribute_count++] = (struct rhw_attribute){
                .format = of_components[components], .buffer = buffer, .offset = offsets[buffer]};
        }
        offsets[buffer] += mesh->has[a] ? (uint32_t)components * (uint32_t)sizeof(float) : 0;
    }
    def->buffers[0].stride = offsets[0];
    def->buffers[1] = (struct rhw_vertex_layout){.stride = offsets[1], .per_instance = true};
    def->buffer_count = mesh->instance_count ? 2 : 1;
}

static void set_depth_stencil(struct rhw_pipeline_def *def, const struct bench_draw *draw)
{
    def->depth_test = draw->depth != BENCH_DEPTH_OFF;
    def->depth_read_only = draw->depth > BENCH_DEPTH_LESS;
    def->depth_compare = draw->depth == BENCH_DEPTH_EQUAL ? RHW_COMPARE_EQUAL : RHW_COMPARE_LESS;
    def->stencil_test = draw->stencil != BENCH_STENCIL_OFF;
    if (draw->stencil == BENCH_STENCIL_COUNT) {
        def->stencil_front.depth_fail = RHW_STENCIL_DECREMENT_WRAP;
        def->stencil_back.depth_fail = RHW_STENCIL_INCREMENT_WRAP;
    } else if (draw->stencil == BENCH_STENCIL_ZERO) { // the reference is 0 unless it is set
        def->stencil_front = (struct rhw_stencil_face){.compares = true, .compare = RHW_COMPARE_EQUAL};
        def->stencil_back = def->stencil_front;
    }
}

static void set_targets(struct rhw_pipeline_def *def, const struct bench_scene *scene,
                        const struct bench_pass *pass, const struct bench_draw *draw)
{
    const enum rhw_blend_factor dst =
        draw->blend == BENCH_BLEND_OVER || draw->blend == BENCH_BLEND_PREMULTIPLIED
            ? RHW_BLEND_ONE_MINUS_SRC_ALPHA
            : RHW_BLEND_ONE;
    const enum rhw_blend_factor src = draw->blend == BENCH_BLEND_OVER ? RHW_BLEND_SRC_ALPHA : RHW_BLEND_ONE;
    def->target_count = pass->color_count;
    for (int i = 0; i < pass->color_count; i++) {
        struct rhw_color_target *const target = &def->targets[i];
        target->format = pass->colors[i] == BENCH_PICTURE ? picture_format(scene)
                                                          : formats[scene->textures[pass->colors[i]].format];
        target->blend = draw->blend != BENCH_BLEND_OFF;
        target->color = target->alpha = (struct rhw_blend_component){src, dst, RHW_BLEND_ADD};
        target->write_mask = draw->stencil == BENCH_STENCIL_COUNT ? RHW_WRITE_NONE : 0;
    }
}

static bool set_program(const struct bench_state *s, struct rhw_program *program, enum bench_shader shader)
{
    if (!s->translated) {
        bench_program(program, shader);
        return true;
    }
    const struct rhw_program *const made = s->translated(s->programs, shader);
    if (made) {
        *program = *made;
    }
    return made != NULL;
}

static bool make_pipeline(struct bench_state *s, const struct bench_pass *pass, const struct bench_draw *draw,
                          rhw_pipeline *pipeline)
{
    static const enum rhw_topology topologies[] = {[BENCH_TRIANGLE_LIST] = RHW_TRIANGLE_LIST,
                                                   [BENCH_LINE_LIST] = RHW_LINE_LIST,
                                                   [BENCH_POINT_LIST] = RHW_POINT_LIST};
    const struct bench_mesh *const mesh = &s->scene->meshes[draw->mesh];
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    if (!set_program(s, &def.program, draw->shader)) {
        return false;
    }
    set_attributes(&def, mesh, bench_shader_attributes[draw->shader]);
    set_depth_stencil(&def, draw);
    set_targets(&def, s->scene, pass, draw);
    def.topology = topologies[mesh->topology];
    def.depth_range = RHW_DEPTH_MINUS_ONE_TO_ONE;
    def.cull = draw->cull_back ? RHW_CULL_BACK : RHW_CULL_NONE;
    return rhw_pipeline_create(s->context, &def, pipeline) == RHW_OK;
}

// The meshes that a shader draws are laid out alike within a scene.
static bool share_pipeline(const struct bench_draw *a, const struct bench_draw *b)
{
    return a->shader == b->shader && a->depth == b->depth && a->blend == b->blend &&
           a->stencil == b->stencil && a->cull_back == b->cull_back;
}

// A pipeline serves any draws of a pass that ask for the same.
static bool make_pass_pipelines(struct bench_state *s, const struct bench_pass *pass)
{
    const uint32_t end = pass->first_draw + pass->draw_count;
    for (uint32_t i = pass->first_draw; i < end; i++) {
        const struct bench_draw *const draw = &s->scene->draws[i];
        uint32_t same = i;
        while (same > pass->first_draw && !share_pipeline(draw, &s->scene->draws[same - 1])) {
            same--;
        }
        if (same > pass->first_draw) {
            s->pipelines[i] = s->pipelines[same - 1];
        } else if (!make_pipeline(s, pass, draw, &s->pipelines[i])) {
            return false;
        }
    }
    return true;
}

static bool make_pipelines(struct bench_state *s)
{
    bool works = true;
    for (uint32_t i = 0; works && i < s->scene->pass_count; i++) {
        works = make_pass_pipelines(s, &s->scene->passes[i]);
    }
    return works;
}

// Frames of translated shaders --------------------------------------------------------------------------

// Bind memory that is read alone.
static bool bind_numbers(const void *numbers, size_t size, struct rhw_binding *binding)
{
    return rhw_binding_of_memory((void *)numbers, size, true, binding);
}

static bool bind_uniforms(const struct bench_scene *scene, uint32_t i, struct bench_draw_frame *frame)
{
    const struct bench_draw *const draw = &scene->draws[i];
    if (scene->surfaces) {
        return bind_numbers(&scene->surfaces->uniforms[i], sizeof *scene->surfaces->uniforms,
                            &frame->uniforms[0]) &&
               bind_numbers(&scene->surfaces->frame_uniforms, sizeof scene->surfaces->frame_uniforms,
                            &frame->uniforms[1]);
    }
    if (bench_shader_shared[draw->shader] == 0) {
        return bind_numbers(&draw->uniforms, sizeof draw->uniforms, &frame->uniforms[0]);
    }
    frame->numbers = calloc(BENCH_UNIFORMS_MAX, sizeof *frame->numbers);
    return frame->numbers &&
           bind_numbers(frame->numbers,
                        bench_uniforms_copy(scene, draw, frame->numbers) * sizeof *frame->numbers,
                        &frame->uniforms[0]);
}

static bool make_frame(struct bench_state *s, uint32_t i)
{
    const struct bench_draw *const draw = &s->scene->draws[i];
    struct bench_draw_frame *const frame = &s->frames[i];
    frame->frame.sets[0] = frame->uniforms;
    frame->frame.sets[1] = frame->textures;
    bool made = bind_uniforms(s->scene, i, frame);
    for (int t = 0; made && t < draw->texture_count; t++) {
        const uint32_t texture = draw->textures[t];
        made = rhw_binding_of_texture(s->context, s->textures[texture],
                                      s->samplers[s->scene->textures[texture].filter],
                                      &frame->textures[t]) == RHW_OK;
    }
    return made;
}

static bool make_frames(struct bench_state *s)
{
    bool made = true;
    if (s->translated) {
        s->frames = calloc((size_t)s->scene->draw_count + 1, sizeof *s->frames);
        made = s->frames != NULL;
    }
    for (uint32_t i = 0; s->translated && made && i < s->scene->draw_count; i++) {
        made = make_frame(s, i);
    }
    return made;
}

static void drop_frames(struct bench_state *s)
{
    for (uint32_t i = 0; s->frames && i < s->scene->draw_count; i++) {
        free(s->frames[i].numbers);
    }
    free(s->frames);
}

// Surfaces and scenes ---------------------------------------------------------------------------------

static bool make_map(struct bench_state *s)
{
    struct scene_shadow_map *const map = &s->scene->surfaces->map;
    if (!s->scene->surfaces->is_shadowed) {
        return true;
    }
    const bool made =
        scene_plane_create(s->context, RHW_FORMAT_D32_FLOAT, map->size, map->size, &s->map) == RHW_OK;
    map->depth = s->map.texels;
    map->pitch = s->map.pitch;
    return made;
}

// What a model has, scene/ uploads; what is drawn for it to be seen through is the scene's last texture.
static bool upload_surfaces(struct bench_state *s)
{
    const struct bench_scene *const scene = s->scene;
    if (scene->surfaces->is_glass) {
        s->textures = calloc(scene->texture_count, sizeof *s->textures);
        if (!s->textures || !make_samplers(s) || !make_texture(s, scene->texture_count - 1)) {
            return false;
        }
    }
    return make_picture(s, RHW_FORMAT_RGBA8_SRGB, &s->color) && make_map(s) &&
           scene_upload_create(s->context, scene->surfaces->model, &s->upload) == RHW_OK &&
           scene_triangle_order_make(&s->order, &s->upload, &scene->surfaces->frame) == RHW_OK;
}

bool bench_rhw_upload(struct bench_state *s)
{
    const struct bench_scene *const scene = s->scene;
    if (bench_rhw_draws_surfaces(s)) {
        return upload_surfaces(s);
    }
    s->vertices = calloc((size_t)scene->mesh_count + 1, sizeof *s->vertices);
    s->indices = calloc((size_t)scene->mesh_count + 1, sizeof *s->indices);
    s->instances = calloc((size_t)scene->mesh_count + 1, sizeof *s->instances);
    s->textures = calloc((size_t)scene->texture_count + 1, sizeof *s->textures);
    s->pipelines = calloc((size_t)scene->draw_count + 1, sizeof *s->pipelines);
    return s->vertices && s->indices && s->instances && s->textures && s->pipelines && make_samplers(s) &&
           (scene->has_color ? make_picture(s, picture_format(scene), &s->color)
                             : make_picture(s, RHW_FORMAT_D32_FLOAT, &s->depth)) &&
           make_meshes(s) && make_textures(s) && make_pipelines(s) && make_frames(s);
}

// Ids that are null are no misuse; what draws share goes with the first of them.
static void drop_pipelines(struct bench_state *s)
{
    for (uint32_t i = 0; s->pipelines && i < s->scene->draw_count; i++) {
        const rhw_pipeline mine = s->pipelines[i];
        for (uint32_t j = i; mine.generation && j < s->scene->draw_count; j++) {
            if (s->pipelines[j].index == mine.index && s->pipelines[j].generation == mine.generation) {
                s->pipelines[j] = (rhw_pipeline){0};
            }
        }
        rhw_pipeline_destroy(s->context, mine);
    }
}

void bench_rhw_drop(struct bench_state *s)
{
    rhw_recording_destroy(s->recording);
    rhw_context_destroy(s->recorder);
    for (uint32_t i = 0; s->vertices && s->indices && s->instances && i < s->scene->mesh_count; i++) {
        rhw_buffer_destroy(s->context, s->vertices[i]);
        rhw_buffer_destroy(s->context, s->indices[i]);
        rhw_buffer_destroy(s->context, s->instances[i]);
    }
    for (uint32_t i = 0; s->textures && i < s->scene->texture_count; i++) {
        rhw_texture_destroy(s->context, s->textures[i]);
    }
    drop_pipelines(s);
    drop_frames(s);
    for (int i = 0; i < BENCH_FILTERS; i++) {
        rhw_sampler_destroy(s->context, s->samplers[i]);
    }
    scene_surface_pipelines_destroy(s->context, &s->surface_pipelines);
    scene_plane_destroy(s->context, &s->map);
    scene_triangle_order_destroy(s->context, &s->order);
    if (s->upload.model) {
        scene_upload_destroy(&s->upload);
    }
    rhw_texture_destroy(s->context, s->color);
    rhw_texture_destroy(s->context, s->depth);
    free(s->vertices);
    free(s->indices);
    free(s->instances);
    free(s->textures);
    free(s->pipelines);
    *s = (struct bench_state){
        .context = s->context, .def = s->def, .translated = s->translated, .programs = s->programs};
}
