// SPDX-License-Identifier: MIT
// A few hostile draws for the checks of whole kernels: from plain numbers to a pass whose chunks go through the front
// end. Compiled once per instruction set, with the shader functions that its draws run.
#ifndef DRAW_SCENE_H
#define DRAW_SCENE_H

#include "draw/assembly.h"
#include "base/constants.h"
#include "draw/wave.h"
#include "kernels/geometry/geometry_scratch.h"
#include "kernels/kernels.h"
#include "kernels/tile_work.h"
#include "base/memory.h"
#include "pipeline/pipeline.h"
#include "base/simd.h"

#include "scene_input.h"

enum { SCENE_CHUNKS = 256 }; // one for every triangle, where bins hold few

// Shader functions -----------------------------------------------------------------------------------

// The pipeline is what they receive as `user`.
static void scene_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_pipeline_data *const pipeline = groups[g].user;
        memcpy(groups[g].position, groups[g].attribute[0], sizeof groups[g].position);
        for (int i = 0; i < pipeline->varying_components; i++) {
            groups[g].varying[i] = groups[g].attribute[1 + i / 4][i % 4];
        }
    }
}

// Everything that the draw asked for takes part in the colour.
static void add_builtins(const struct rhw_fragment *group, uint32_t uses, f32x8 sum[4])
{
    for (int i = 0; i < 4 && uses & RHW_USE_COORD; i++) {
        sum[i] += group->coord[i] * f32x8_splat(0x1p-7f);
    }
    if (uses & RHW_USE_FACING) {
        sum[1] += rhw_float_from_int(group->front_facing) * f32x8_splat(0.25f);
    }
    if (uses & RHW_USE_IDS) {
        sum[0] += rhw_float_from_int(group->primitive) * f32x8_splat(0.0625f);
        sum[2] += rhw_float_from_int(group->instance) * f32x8_splat(0.5f) + rhw_float_from_int(group->draw);
    }
    for (int i = 0; i < 3 && uses & RHW_USE_BARYCENTRIC; i++) {
        sum[i] += group->barycentric[i] - group->barycentric_noperspective[i] * f32x8_splat(0.5f);
    }
    for (int i = 0; i < 3 && uses & RHW_USE_BARYCENTRIC_DERIVATIVES; i++) {
        sum[i] += group->barycentric_ddx[i] - group->barycentric_ddy[i];
    }
}

// Within bounds, and a number.
static f32x8 bounded(f32x8 value)
{
    return f32x8_min(f32x8_max(value, f32x8_splat(-1024)), f32x8_splat(1024)); // the second where one is NaN
}

static void shade_group(struct rhw_fragment *group)
{
    const struct rhw_pipeline_data *const pipeline = group->user;
    const float *const uniforms = group->uniforms;
    const uint32_t uses = pipeline->def.program.uses;
    f32x8 sum[4];
    for (int i = 0; i < 4; i++) {
        sum[i] = f32x8_splat(uniforms[i]);
    }
    for (int i = 0; i < pipeline->varying_components; i++) {
        sum[i % 4] += group->varying[i] * f32x8_splat(0.5f);
        if (pipeline->component_derivatives[i]) {
            sum[(i + 1) % 4] += group->ddx[i] - group->ddy[i] * f32x8_splat(0.75f);
        }
    }
    add_builtins(group, uses, sum);
    for (int t = 0; t < pipeline->def.target_count; t++) {
        for (int i = 0; i < 4; i++) {
            group->color[t][i] = bounded(sum[(i + t) % 4]);
        }
    }
    if (uses & RHW_USE_DISCARD) {
        group->mask &= rhw_less(sum[0], f32x8_splat(0.75f));
    }
    if (uses & RHW_USE_DEPTH) {
        group->depth = bounded(group->depth * f32x8_splat(0.75f) + sum[1] * f32x8_splat(0.125f));
    }
}

static void scene_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        shade_group(&groups[g]);
    }
}

// The pass -------------------------------------------------------------------------------------------

// What a pass consists of, kept from one input to the next as a context keeps it.
struct scene {
    struct rhw_tile_scratch tile;
    _Alignas(RHW_CACHE_LINE) rhw_tile_colors colors[RHW_MAX_COLOR_ATTACHMENTS];
    struct bin bins[SCENE_CHUNKS];
    struct rhw_worker worker;
    struct rhw_memory memory;
    struct rhw_recorded_pass pass;
    struct rhw_wave wave;
    struct rhw_pipeline_data pipelines[SCENE_DRAWS];
    struct rhw_draw_state states[SCENE_DRAWS];
    struct rhw_draw draws[SCENE_DRAWS];
    struct rhw_draw *draw_block;
    struct rhw_chunk chunks[SCENE_CHUNKS];
    _Alignas(RHW_CACHE_LINE) unsigned char indices[4 * SCENE_INDICES];
    bool is_ready;
};

static struct scene the_scene;

// As the library prepares a worker.
static void start_scene(struct scene *scene)
{
    scene->memory.allocator = rhw_allocator_or_default((struct rhw_allocator){0});
    rhw_arena_init(&scene->worker.arena, &scene->memory);
    rhw_arena_init(&scene->pass.arena, &scene->memory);
    const struct rhw_geometry_room room = rhw_geometry_scratch_room(RHW_CHUNK_TRIANGLES);
    scene->worker.geometry = rhw_memory_allocate_zeroed(&scene->memory, room.size, 4096);
    if (scene->worker.geometry == NULL) {
        abort();
    }
    rhw_geometry_scratch_init(scene->worker.geometry, room);
    scene->worker.tile = &scene->tile;
    scene->tile.color = scene->colors;
    scene->tile.bins = scene->bins;
    for (int bits = 0; bits < 256; bits++) {
        int count = 0;
        for (int lane = 0; lane < 8; lane++) {
            scene->tile.collected.set_lanes[bits][count] = (uint8_t)lane;
            count += bits >> lane & 1;
        }
    }
    scene->draw_block = scene->draws;
    scene->pass.draws = (struct rhw_draw_list){.blocks = &scene->draw_block, .block_count = 1};
    scene->wave = (struct rhw_wave){.pass = &scene->pass,
                                    .is_first = true,
                                    .is_last = true,
                                    .chunks = scene->chunks,
                                    .workers = &scene->worker};
    scene->is_ready = true;
}

static struct rhw_pipeline_def pipeline_def_of(const struct scene_input *in, const struct scene_draw *draw,
                                               const struct rhw_pipeline_data *user)
{
    struct rhw_pipeline_def def = {
        .attribute_count = 1 + SCENE_COMPONENTS / 4,
        .buffers = {{.stride = sizeof in->vertices[0]}},
        .buffer_count = 1,
        .topology = (enum rhw_topology)draw->topology,
        .primitive_restart = draw->restarts != 0,
        .provoking = (enum rhw_provoking)draw->provoking,
        .cull = (enum rhw_cull)draw->cull,
        .front = (enum rhw_winding)draw->front,
        .depth_range = (enum rhw_depth_range)draw->depth_range,
        .depth_test = draw->depth_test != 0,
        .depth_compare = (enum rhw_compare)draw->depth_compare,
        .depth_read_only = draw->depth_write == 0,
        .target_count = in->target_count,
    };
    def.program.vertex[RHW_ISA_BASELINE] = scene_vertex;
    def.program.fragment[RHW_ISA_BASELINE] = draw->shades ? scene_fragment : NULL;
    def.program.varying_count = draw->varying_count;
    def.program.uses = draw->uses;
    def.program.user = user;
    memcpy(def.program.varyings, draw->varyings, sizeof draw->varyings);
    memcpy(def.targets, draw->targets, sizeof draw->targets);
    for (int i = 0; i < def.attribute_count; i++) {
        def.attributes[i] = (struct rhw_attribute){.format = RHW_VERTEX_FLOAT4, .offset = (uint32_t)(16 * i)};
    }
    return def;
}

// As pass_draw_state.c derives it when a draw is recorded.
static void set_draw_state(struct rhw_draw_state *state, const struct scene *scene,
                           const struct scene_input *in, const struct scene_draw *draw)
{
    const struct rhw_viewport *const v = &draw->viewport;
    const enum rhw_paths paths = scene->pass.paths;
    memset(state, 0, sizeof *state);
    state->pipeline = &scene->pipelines[draw - in->draws];
    state->streams[0] =
        (struct rhw_vertex_stream){(const unsigned char *)in->vertices, sizeof in->vertices, RHW_FETCH_BYTES};
    state->indices = scene->indices;
    state->index_type = (enum rhw_index_type)draw->index_type;
    state->index_bytes = (size_t)SCENE_INDICES << draw->index_type;
    state->viewport = *v;
    state->scissor = draw->scissor;
    for (int t = 0; t < in->target_count; t++) {
        rhw_blend_state_init(&state->blend[t], &draw->targets[t], RHW_LOGIC_OFF, draw->constant);
        if (paths == RHW_PATHS_GENERAL) {
            rhw_blend_state_generalize(&state->blend[t]);
        }
    }
    const double span = (double)v->depth_max - (double)v->depth_min;
    const bool symmetric = draw->depth_range == RHW_DEPTH_MINUS_ONE_TO_ONE;
    state->depth_low = (double)v->depth_min + (symmetric ? span / 2 : 0);
    state->depth_span = symmetric ? span / 2 : span;
    state->depth_least = v->depth_min < v->depth_max ? v->depth_min : v->depth_max;
    state->depth_most = v->depth_min < v->depth_max ? v->depth_max : v->depth_min;
    state->half_width = (double)v->width / 2;
    state->half_height = (double)v->height / 2;
    state->center_x = (double)v->x + state->half_width;
    state->center_y = (double)v->y + state->half_height;
    state->first_step = 127;
    state->past_step = 128;
    const struct rhw_depth_stencil_setting setting = {.bounds_most = 1};
    rhw_depth_stencil_init(&state->depth_stencil, &state->pipeline->def, &setting, 0);
    rhw_draw_plans_make(state->plans, state->pipeline, &state->depth_stencil, 1, paths);
    if (paths == RHW_PATHS_ALL) {
        state->hidden = rhw_hidden_rule_of(state, in->target_count);
    }
}

// The indices of all draws in the type of one of them: they have the same.
static void set_indices(struct scene *scene, const struct scene_input *in)
{
    for (int i = 0; i < SCENE_INDICES; i++) {
        const uint32_t index = in->indices[i];
        const int size = 1 << in->draws[0].index_type;
        memcpy(scene->indices + size * i, &index, (size_t)size); // little-endian
    }
}

static void set_draws(struct scene *scene, const struct scene_input *in)
{
    struct rhw_recorded_pass *const pass = &scene->pass;
    pass->draws.count = 0;
    pass->triangle_count = 0;
    pass->triangles_most = 1;
    set_indices(scene, in);
    for (int d = 0; d < in->draw_count; d++) {
        const struct scene_draw *const draw = &in->draws[d];
        const struct rhw_pipeline_def def = pipeline_def_of(in, draw, &scene->pipelines[d]);
        rhw_pipeline_data_init(&scene->pipelines[d], &def, RHW_ISA_BASELINE);
        set_draw_state(&scene->states[d], scene, in, draw);
        struct rhw_draw *const out = &scene->draws[d];
        *out = (struct rhw_draw){.state = &scene->states[d],
                                 .uniforms = draw->uniforms,
                                 .first = draw->first,
                                 .base_vertex = draw->base_vertex,
                                 .first_instance = (uint32_t)d,
                                 .instances = draw->instances,
                                 .index = (uint32_t)d,
                                 .first_triangle = pass->triangle_count,
                                 .indexed = draw->indexed != 0};
        rhw_assembly_prepare(out, draw->count, &pass->arena);
        pass->draws.count++;
        pass->triangle_count += (uint64_t)out->triangles_per_instance * out->instances;
    }
}

// The draw that triangle `first` of the line belongs to.
static uint32_t draw_of(const struct scene *scene, uint64_t first)
{
    uint32_t d = 0;
    while (d + 1 < scene->pass.draws.count && scene->draws[d + 1].first_triangle <= first) {
        d++;
    }
    return d;
}

static void set_attachments(struct rhw_target *target, const struct scene_input *in)
{
    target->width = in->width;
    target->height = in->height;
    target->tiles_x = (in->width + RHW_TILE - 1) / RHW_TILE;
    target->tiles_y = (in->height + RHW_TILE - 1) / RHW_TILE;
    target->color_count = in->target_count;
    for (int t = 0; t < in->target_count; t++) {
        struct rhw_attachment *const color = &target->colors[t];
        *color =
            (struct rhw_attachment){.format = (enum rhw_format)in->formats[t],
                                    .texel_size = rhw_format_info((enum rhw_format)in->formats[t])->size};
        memcpy(color->clear, in->clear[t], sizeof color->clear);
    }
    target->has_depth = true;
    target->depth = (struct rhw_attachment){.format = RHW_FORMAT_D32_FLOAT, .texel_size = sizeof(float)};
    memcpy(target->depth.clear, in->clear_depth, sizeof target->depth.clear);
}

// Records the draws and runs the front end over them; one that ends a chunk early gets another.
static struct scene *front_of_scene(const struct scene_input *in, enum rhw_paths paths)
{
    struct scene *const scene = &the_scene;
    struct rhw_recorded_pass *const pass = &scene->pass;
    struct rhw_wave *const wave = &scene->wave;
    if (!scene->is_ready) {
        start_scene(scene);
    }
    rhw_arena_reset(&scene->worker.arena);
    rhw_arena_reset(&pass->arena);
    pass->paths = paths;
    wave->target.pattern = rhw_sample_pattern_of(1);
    wave->target.layers = 1;
    wave->entries_most = in->entries_most;
    set_attachments(&wave->target, in);
    set_draws(scene, in);
    wave->chunk_count = 0;
    for (uint64_t at = 0; at < pass->triangle_count && wave->chunk_count < SCENE_CHUNKS;) {
        const uint64_t left = pass->triangle_count - at;
        const uint64_t count = at == 0 && in->split < left ? in->split : left;
        struct rhw_chunk *const chunk = &wave->chunks[wave->chunk_count++];
        *chunk = (struct rhw_chunk){.first = at, .count = count, .first_draw = draw_of(scene, at)};
        RHW_ISA_NAME(rhw_kernels).chunk(wave, chunk, 0);
        at += chunk->count;
    }
    return scene;
}

#endif
