// SPDX-License-Identifier: MIT
// Recording: set_ functions change `pending`, a draw copies it when it changed. Running lives in pass_run.c.
#include "pass.h"

#include <string.h>

#include "assembly.h"
#include "binding.h"
#include "buffer.h"
#include "context.h"
#include "cpu.h"
#include "format.h"
#include "hidden_surface.h"
#include "lookup.h"
#include "misuse.h"
#include "pass_run.h"
#include "pass_state.h"
#include "pipeline.h"
#include "rhw/rhw.h"
#include "sampler.h"
#include "shared_vertices.h"
#include "srgb_texture.h"
#include "thread.h"

enum rhw_result rhw_pass_state_create(struct rhw_context *context, struct rhw_pass_state **out)
{
    struct rhw_pass_state *const pass = rhw_memory_allocate(&context->memory, sizeof *pass, RHW_CACHE_LINE);
    *out = pass;
    if (!pass) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    memset(pass, 0, sizeof *pass);
    pass->context = context;
    pass->paths = context->paths;
    rhw_arena_init(&pass->arena, &context->memory);
    return RHW_OK;
}

void rhw_pass_state_destroy(struct rhw_context *context, struct rhw_pass_state *pass)
{
    if (!pass) {
        return;
    }
    rhw_pass_run_release(pass);
    rhw_draw_list_destroy(&context->memory, &pass->draws);
    rhw_arena_destroy(&pass->arena);
    rhw_memory_release(&context->memory, pass, sizeof *pass);
}

// The pass that `id` names, or NULL after reporting misuse.
static struct rhw_pass_state *pass_of(rhw_context *context, rhw_pass id, const char *where)
{
    if (!rhw_check(context, context != NULL, "%s: context is NULL", where)) {
        return NULL;
    }
    const bool live = context->pass_active && id.index == 1 && id.generation == context->pass_generation;
    return rhw_check(context, live, "%s: the pass id is null or its pass has ended", where) ? context->pass
                                                                                            : NULL;
}

static bool check_attachment(rhw_context *context, const char *name, int i, enum rhw_load load,
                             enum rhw_store store)
{
    return rhw_check(context, (unsigned)load <= RHW_LOAD_DISCARD,
                     "rhw_pass_begin: %s[%d].load is %d; not a load operation", name, i, (int)load) &&
           rhw_check(context, (unsigned)store <= RHW_STORE_DISCARD,
                     "rhw_pass_begin: %s[%d].store is %d; not a store operation", name, i, (int)store);
}

// Among the first `count` colours and, when `depth` is set, the depth attachment.
static bool is_attachment(const struct rhw_pass_state *pass, rhw_texture id, int count, bool depth)
{
    bool found = depth && pass->depth_id.index == id.index;
    for (int i = 0; i < count; i++) {
        found = found || pass->color_ids[i].index == id.index;
    }
    return found;
}

// Fills what an attachment with a texture has, and checks its size against the pass.
static enum rhw_result attach(struct rhw_pass_state *pass, rhw_texture id, const char *name, int i,
                              struct rhw_attachment *attachment)
{
    struct rhw_context *const context = pass->context;
    struct rhw_texture_data *const texture = rhw_context_texture(context, id, "rhw_pass_begin");
    if (!texture) {
        return RHW_ERROR_MISUSE;
    }
    const int width = texture->mip[0].width, height = texture->mip[0].height;
    if (pass->width == 0) {
        pass->width = width;
        pass->height = height;
    }
    if (!rhw_check(context, width == pass->width && height == pass->height,
                   "rhw_pass_begin: %s[%d].texture is %dx%d; the pass is %dx%d", name, i, width, height,
                   pass->width, pass->height)) {
        return RHW_ERROR_MISUSE;
    }
    texture->linear_is_current = false;
    attachment->format = texture->format;
    attachment->target = &texture->mip[0];
    if (!texture->clean) {
        texture->clean = rhw_clean_tiles_create(&context->memory, width, height);
    }
    if (!texture->clean) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    attachment->clean = texture->clean;
    attachment->texel_size = rhw_format_size(texture->format);
    return RHW_OK;
}

// What RHW_LOAD_DEFAULT stands for.
static enum rhw_load load_of(enum rhw_load load)
{
    return load == RHW_LOAD_DEFAULT ? RHW_LOAD_CLEAR : load;
}

static void set_clear(struct rhw_attachment *attachment, const unsigned char *texel)
{
    memset(attachment->clear, 0, sizeof attachment->clear);
    for (size_t i = 0; attachment->load == RHW_LOAD_CLEAR && i < sizeof attachment->clear;
         i += attachment->texel_size) {
        memcpy(attachment->clear + i, texel, attachment->texel_size);
    }
}

static enum rhw_result attach_color(struct rhw_pass_state *pass, const struct rhw_pass_def *def, int i)
{
    struct rhw_context *const context = pass->context;
    const struct rhw_color_attachment *const color = &def->colors[i];
    struct rhw_attachment *const attachment = &pass->colors[i];
    if (!check_attachment(context, "colors", i, color->load, color->store)) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_check(context, !is_attachment(pass, color->texture, i, false),
                   "rhw_pass_begin: colors[%d].texture is another attachment too; each needs its own", i)) {
        return RHW_ERROR_MISUSE;
    }
    const enum rhw_result result = attach(pass, color->texture, "colors", i, attachment);
    if (result != RHW_OK) {
        return result;
    }
    const struct rhw_format_info *const info = rhw_format_info(attachment->format);
    if (!rhw_check(context, rhw_format_has_role(info, RHW_ROLE_COLOR_TARGET),
                   "rhw_pass_begin: colors[%d].texture is %s; that is no colour target", i, info->name)) {
        return RHW_ERROR_MISUSE;
    }
    attachment->load = load_of(color->load);
    attachment->store = color->store;
    const uint64_t environment = rhw_cpu_float_enter();
    unsigned char texel[RHW_TEXEL_BYTES];
    rhw_clear_texel(info, color->clear, texel);
    rhw_cpu_float_leave(environment);
    set_clear(attachment, texel);
    pass->color_ids[i] = color->texture;
    return RHW_OK;
}

static enum rhw_result attach_depth(struct rhw_pass_state *pass, const struct rhw_pass_def *def)
{
    struct rhw_context *const context = pass->context;
    const struct rhw_depth_attachment *const depth = &def->depth;
    pass->has_depth = depth->enabled;
    pass->depth = (struct rhw_attachment){.format = RHW_FORMAT_D32_FLOAT, .texel_size = sizeof(float)};
    pass->depth_id = depth->texture;
    pass->depth_by_default = false;
    if (!depth->enabled) {
        return RHW_OK;
    }
    if (!check_attachment(context, "depth", 0, depth->load, depth->store)) {
        return RHW_ERROR_MISUSE;
    }
    if (depth->texture.index != 0) {
        const enum rhw_result result = attach(pass, depth->texture, "depth", 0, &pass->depth);
        if (result != RHW_OK) {
            return result;
        }
        if (!rhw_check(context,
                       rhw_format_has_role(rhw_format_info(pass->depth.format), RHW_ROLE_DEPTH_TARGET),
                       "rhw_pass_begin: depth.texture is %s; the depth attachment is RHW_FORMAT_D32_FLOAT",
                       rhw_format_info(pass->depth.format)->name)) {
            return RHW_ERROR_MISUSE;
        }
    } else if (!rhw_check(
                   context, load_of(depth->load) == RHW_LOAD_CLEAR && depth->store == RHW_STORE_DISCARD,
                   "rhw_pass_begin: depth.texture is null; without one depth is cleared and not stored")) {
        return RHW_ERROR_MISUSE;
    }
    if (!rhw_check(context, depth->clear >= 0 && depth->clear <= 1,
                   "rhw_pass_begin: depth.clear is %g; it is in 0..1", (double)depth->clear)) {
        return RHW_ERROR_MISUSE;
    }
    pass->depth.load = load_of(depth->load);
    pass->depth.store = depth->store;
    pass->depth_by_default = depth->load == RHW_LOAD_DEFAULT && depth->clear == 0;
    const float clear = pass->depth_by_default ? 1 : depth->clear;
    set_clear(&pass->depth, (const unsigned char *)&clear);
    return RHW_OK;
}

static void reset(struct rhw_pass_state *pass, const struct rhw_pass_def *def)
{
    rhw_arena_reset(&pass->arena);
    pass->begun_ns = rhw_time_ns();
    pass->width = def->width;
    pass->height = def->height;
    pass->draws.count = 0;
    pass->triangle_count = 0;
    pass->has_large_draws = false;
    pass->current = NULL;
    pass->out_of_memory = false;
    pass->color_count = def->color_count;
    memset(&pass->pending, 0, sizeof pass->pending);
    pass->pending_changed = true;
    pass->uniforms = NULL;
    pass->uniform_size = 0;
    rhw_bindings_init(&pass->pending_textures, pass->context->kernels);
    pass->textures_changed = true;
}

enum rhw_result rhw_pass_begin(rhw_context *context, const struct rhw_pass_def *def, rhw_pass *id)
{
    if (!rhw_check(context, context && def && id, "rhw_pass_begin: context, def and pass must not be NULL")) {
        return RHW_ERROR_MISUSE;
    }
    *id = (rhw_pass){0, 0};
    struct rhw_pass_state *const pass = context->pass;
    if (!rhw_check(context, !context->pass_active,
                   "rhw_pass_begin: a pass is being recorded; end it first") ||
        !rhw_check(context, def->color_count >= 0 && def->color_count <= RHW_MAX_COLOR_ATTACHMENTS,
                   "rhw_pass_begin: color_count is %d; it is in 0..%d", def->color_count,
                   RHW_MAX_COLOR_ATTACHMENTS) ||
        !rhw_check(context, def->color_count > 0 || def->depth.enabled,
                   "rhw_pass_begin: the pass has no attachment") ||
        !rhw_check(
            context, def->color_count > 0 || def->colors[0].texture.index == 0,
            "rhw_pass_begin: colors[0].texture is set and color_count is 0; it must be 1 or more, or the "
            "texture null")) {
        return RHW_ERROR_MISUSE;
    }
    reset(pass, def);
    enum rhw_result result = RHW_OK;
    for (int i = 0; i < def->color_count && result == RHW_OK; i++) {
        result = attach_color(pass, def, i);
    }
    if (result == RHW_OK) {
        result = attach_depth(pass, def);
    }
    if (result != RHW_OK) {
        return result;
    }
    if (!rhw_check(context,
                   pass->width >= 1 && pass->width <= RHW_MAX_TARGET_SIZE && pass->height >= 1 &&
                       pass->height <= RHW_MAX_TARGET_SIZE,
                   "rhw_pass_begin: the size is %dx%d; each is in 1..%d", pass->width, pass->height,
                   RHW_MAX_TARGET_SIZE)) {
        return RHW_ERROR_MISUSE;
    }
    pass->tiles_x = (pass->width + RHW_TILE - 1) / RHW_TILE;
    pass->tiles_y = (pass->height + RHW_TILE - 1) / RHW_TILE;
    pass->pending.viewport = (struct rhw_viewport){0, 0, (float)pass->width, (float)pass->height, 0, 1};
    pass->pending.scissor = (struct rhw_rect){0, 0, pass->width, pass->height};
    context->pass_active = true;
    context->pass_generation++;
    for (int i = 0; i < pass->color_count; i++) {
        rhw_pool_use(&context->textures, pass->color_ids[i].index, context->pass_generation);
    }
    if (pass->has_depth && pass->depth_id.index != 0) {
        rhw_pool_use(&context->textures, pass->depth_id.index, context->pass_generation);
    }
    *id = (rhw_pass){1, context->pass_generation};
    return RHW_OK;
}

// A pipeline draws into what it was made for.
static bool targets_match(const struct rhw_pass_state *pass, const struct rhw_pipeline_data *pipeline)
{
    struct rhw_context *const context = pass->context;
    if (!rhw_check(context, pipeline->def.target_count == pass->color_count,
                   "rhw_pass_set_pipeline: the pipeline has %d targets; the pass has %d colour attachments",
                   pipeline->def.target_count, pass->color_count)) {
        return false;
    }
    for (int i = 0; i < pass->color_count; i++) {
        if (!rhw_check(context, pipeline->def.targets[i].format == pass->colors[i].format,
                       "rhw_pass_set_pipeline: target %d is %s; the attachment is %s", i,
                       rhw_format_info(pipeline->def.targets[i].format)->name,
                       rhw_format_info(pass->colors[i].format)->name)) {
            return false;
        }
    }
    return rhw_check(context, pass->has_depth || !pipeline->def.depth_test,
                     "rhw_pass_set_pipeline: the pipeline tests depth; the pass has no depth attachment");
}

void rhw_pass_set_pipeline(rhw_context *context, rhw_pass id, rhw_pipeline pipeline_id)
{
    struct rhw_pass_state *const pass = pass_of(context, id, "rhw_pass_set_pipeline");
    const struct rhw_pipeline_data *const pipeline =
        pass ? rhw_context_pipeline(context, pipeline_id, "rhw_pass_set_pipeline") : NULL;
    if (pipeline && targets_match(pass, pipeline)) {
        rhw_pool_use(&context->pipelines, pipeline_id.index, context->pass_generation);
        pass->pending_changed |= pass->pending.pipeline != pipeline;
        pass->pending.pipeline = pipeline;
    }
}

void rhw_pass_set_vertex_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer_id,
                                size_t offset)
{
    struct rhw_pass_state *const pass = pass_of(context, id, "rhw_pass_set_vertex_buffer");
    const struct rhw_buffer_data *const buffer =
        pass ? rhw_context_buffer(context, buffer_id, "rhw_pass_set_vertex_buffer") : NULL;
    if (!buffer ||
        !rhw_check(context, slot >= 0 && slot < RHW_MAX_VERTEX_BUFFERS,
                   "rhw_pass_set_vertex_buffer: slot is %d; it is in 0..%d", slot,
                   RHW_MAX_VERTEX_BUFFERS - 1) ||
        !rhw_check(context, offset <= buffer->size,
                   "rhw_pass_set_vertex_buffer: offset is %zu; the buffer has %zu bytes", offset,
                   buffer->size)) {
        return;
    }
    rhw_pool_use(&context->buffers, buffer_id.index, context->pass_generation);
    struct rhw_vertex_stream *const stream = &pass->pending.streams[slot];
    const unsigned char *const bytes = buffer->bytes + offset;
    const size_t size = buffer->size - offset;
    pass->pending_changed |= stream->bytes != bytes || stream->size != size;
    *stream = (struct rhw_vertex_stream){bytes, size};
}

void rhw_pass_set_index_buffer(rhw_context *context, rhw_pass id, rhw_buffer buffer_id,
                               enum rhw_index_type type, size_t offset)
{
    struct rhw_pass_state *const pass = pass_of(context, id, "rhw_pass_set_index_buffer");
    const struct rhw_buffer_data *const buffer =
        pass ? rhw_context_buffer(context, buffer_id, "rhw_pass_set_index_buffer") : NULL;
    if (!buffer ||
        !rhw_check(context, (unsigned)type <= RHW_INDEX_UINT32,
                   "rhw_pass_set_index_buffer: type is %d; not an index type", (int)type) ||
        !rhw_check(context, offset <= buffer->size,
                   "rhw_pass_set_index_buffer: offset is %zu; the buffer has %zu bytes", offset,
                   buffer->size)) {
        return;
    }
    rhw_pool_use(&context->buffers, buffer_id.index, context->pass_generation);
    struct rhw_draw_state *const pending = &pass->pending;
    const unsigned char *const bytes = buffer->bytes + offset;
    const size_t size = buffer->size - offset;
    pass->pending_changed |=
        pending->indices != bytes || pending->index_bytes != size || pending->index_type != type;
    pending->indices = bytes;
    pending->index_bytes = size;
    pending->index_type = type;
}

void rhw_pass_set_uniforms(rhw_context *context, rhw_pass id, const void *data, size_t size)
{
    struct rhw_pass_state *const pass = pass_of(context, id, "rhw_pass_set_uniforms");
    if (!pass ||
        !rhw_check(context, data || size == 0, "rhw_pass_set_uniforms: data is NULL and size is %zu", size) ||
        !rhw_check(context, size <= RHW_MAX_UNIFORM_SIZE, "rhw_pass_set_uniforms: size is %zu; at most %d",
                   size, RHW_MAX_UNIFORM_SIZE)) {
        return;
    }
    void *const copy = rhw_arena_alloc(&pass->arena, size, RHW_CACHE_LINE);
    if (!copy) {
        pass->out_of_memory = true;
        return;
    }
    if (size != 0) {
        memcpy(copy, data, size);
    }
    pass->uniforms = copy;
    pass->uniform_size = (uint32_t)size;
}

void rhw_pass_set_texture(rhw_context *context, rhw_pass id, int slot, rhw_texture texture_id,
                          rhw_sampler sampler_id)
{
    struct rhw_pass_state *const pass = pass_of(context, id, "rhw_pass_set_texture");
    if (!pass || !rhw_check(context, slot >= 0 && slot < RHW_MAX_TEXTURES,
                            "rhw_pass_set_texture: slot is %d; it is in 0..%d", slot, RHW_MAX_TEXTURES - 1)) {
        return;
    }
    struct rhw_texture_data *texture = NULL;
    const struct rhw_sampler_data *sampler = NULL;
    if (texture_id.index != 0) {
        texture = rhw_context_texture(context, texture_id, "rhw_pass_set_texture");
        sampler = texture ? rhw_context_sampler(context, sampler_id, "rhw_pass_set_texture") : NULL;
        if (!sampler ||
            !rhw_check(context, rhw_format_has_role(texture->info, RHW_ROLE_SAMPLED),
                       "rhw_pass_set_texture: the texture is %s; it cannot be sampled",
                       texture->info->name) ||
            !rhw_check(context, !is_attachment(pass, texture_id, pass->color_count, pass->has_depth),
                       "rhw_pass_set_texture: the texture in slot %d is an attachment of this pass", slot)) {
            return;
        }
        pass->out_of_memory = !rhw_texture_linearize(context, texture) || pass->out_of_memory;
        rhw_pool_use(&context->textures, texture_id.index, context->pass_generation);
        rhw_pool_use(&context->samplers, sampler_id.index, context->pass_generation);
    }
    struct rhw_binding *const pending = &pass->pending_textures.slot[slot];
    if (pending->texture != texture || pending->sampler != sampler) {
        *pending = rhw_binding_of(context->kernels, context->paths, texture, sampler);
        pass->textures_changed = true;
        pass->pending_changed = true;
    }
}

void rhw_pass_set_viewport(rhw_context *context, rhw_pass id, const struct rhw_viewport *v)
{
    struct rhw_pass_state *const pass = pass_of(context, id, "rhw_pass_set_viewport");
    if (!pass || !rhw_check(context, v != NULL, "rhw_pass_set_viewport: viewport is NULL")) {
        return;
    }
    const float limit = RHW_MAX_TARGET_SIZE;
    if (!rhw_check(context, v->width > 0 && v->height > 0 && v->width <= limit && v->height <= limit,
                   "rhw_pass_set_viewport: the size is %gx%g; each is above 0 and at most %g",
                   (double)v->width, (double)v->height, (double)limit) ||
        !rhw_check(context, v->x >= -limit && v->x <= limit && v->y >= -limit && v->y <= limit,
                   "rhw_pass_set_viewport: the corner is %g,%g; each is within ±%g", (double)v->x,
                   (double)v->y, (double)limit) ||
        !rhw_check(
            context,
            v->depth_min >= 0 && v->depth_min <= 1 &&
                ((v->depth_max >= 0 && v->depth_max <= 1) || v->depth_max == -1),
            "rhw_pass_set_viewport: the depth range is %g..%g; each end is in 0..1, or depth_max is -1",
            (double)v->depth_min, (double)v->depth_max)) {
        return;
    }
    pass->pending.viewport = *v;
    const bool unset = v->depth_min == 0 && v->depth_max == 0;
    pass->pending.viewport.depth_max = unset ? 1 : v->depth_max > 0 ? v->depth_max : 0;
    pass->pending_changed = true;
}

void rhw_pass_set_scissor(rhw_context *context, rhw_pass id, const struct rhw_rect *scissor)
{
    struct rhw_pass_state *const pass = pass_of(context, id, "rhw_pass_set_scissor");
    if (!pass || !rhw_check(context, scissor != NULL, "rhw_pass_set_scissor: scissor is NULL") ||
        !rhw_check(context, scissor->width >= 0 && scissor->height >= 0,
                   "rhw_pass_set_scissor: the size is %dx%d; neither is negative", scissor->width,
                   scissor->height)) {
        return;
    }
    pass->pending.scissor = *scissor;
    pass->pending_changed = true;
}

void rhw_pass_set_blend_constant(rhw_context *context, rhw_pass id, const float constant[4])
{
    struct rhw_pass_state *const pass = pass_of(context, id, "rhw_pass_set_blend_constant");
    if (pass && rhw_check(context, constant != NULL, "rhw_pass_set_blend_constant: constant is NULL")) {
        memcpy(pass->pending.blend_constant, constant, sizeof pass->pending.blend_constant);
        pass->pending_changed = true;
    }
}

static int clamp_to(int64_t v, int low, int high)
{
    return v < low ? low : v > high ? high : (int)v;
}

// The first pixel whose centre is at or after `x`, which is within a few times ±RHW_MAX_TARGET_SIZE.
static int first_pixel(double x)
{
    const double edge = x - 0.5;
    const int towards_zero = (int)edge;
    return (double)towards_zero < edge ? towards_zero + 1 : towards_zero;
}

// The pixels whose centres are inside the viewport, the scissor and the target.
static struct rhw_rect clip_rect(const struct rhw_pass_state *pass, const struct rhw_viewport *v,
                                 const struct rhw_rect *scissor)
{
    const int vx0 = first_pixel(v->x), vx1 = first_pixel((double)v->x + (double)v->width);
    const int vy0 = first_pixel(v->y), vy1 = first_pixel((double)v->y + (double)v->height);
    const int sx0 = clamp_to(scissor->x, 0, pass->width), sy0 = clamp_to(scissor->y, 0, pass->height);
    const int sx1 = clamp_to((int64_t)scissor->x + scissor->width, 0, pass->width);
    const int sy1 = clamp_to((int64_t)scissor->y + scissor->height, 0, pass->height);
    const int x0 = vx0 > sx0 ? vx0 : sx0, y0 = vy0 > sy0 ? vy0 : sy0;
    const int x1 = vx1 < sx1 ? vx1 : sx1, y1 = vy1 < sy1 ? vy1 : sy1;
    return (struct rhw_rect){x0, y0, x1 > x0 ? x1 - x0 : 0, y1 > y0 ? y1 - y0 : 0};
}

// Sets what vertices and depth need of the viewport and of the pipeline's range of Z.
static void set_viewport_map(struct rhw_draw_state *state)
{
    const struct rhw_viewport *const v = &state->viewport;
    const bool symmetric = state->pipeline && state->pipeline->def.depth_range == RHW_DEPTH_MINUS_ONE_TO_ONE;
    const double span = (double)v->depth_max - (double)v->depth_min;
    state->depth_low = (double)v->depth_min + (symmetric ? span / 2 : 0);
    state->depth_span = symmetric ? span / 2 : span;
    state->depth_least = v->depth_min < v->depth_max ? v->depth_min : v->depth_max;
    state->depth_most = v->depth_min < v->depth_max ? v->depth_max : v->depth_min;
    state->half_width = (double)v->width / 2;
    state->half_height = (double)v->height / 2;
    state->center_x = (double)v->x + state->half_width;
    state->center_y = (double)v->y + state->half_height;
}

// An immutable copy of what the next draw uses, shared by the draws between two changes.
static const struct rhw_draw_state *snapshot(struct rhw_pass_state *pass)
{
    if (pass->current && !pass->pending_changed) {
        return pass->current;
    }
    struct rhw_draw_state *const state = rhw_arena_alloc(&pass->arena, sizeof *state, RHW_CACHE_LINE);
    if (!state) {
        return NULL;
    }
    if (pass->textures_changed) {
        struct rhw_bindings *const textures = rhw_arena_alloc(&pass->arena, sizeof *textures, RHW_CACHE_LINE);
        if (!textures) {
            return NULL;
        }
        *textures = pass->pending_textures;
        pass->pending.textures = textures;
        pass->textures_changed = false;
    }
    *state = pass->pending;
    state->scissor = clip_rect(pass, &state->viewport, &state->scissor);
    for (int i = 0; i < pass->color_count && state->pipeline; i++) {
        rhw_blend_state_init(&state->blend[i], &state->pipeline->def.targets[i], state->blend_constant);
        if (pass->paths == RHW_PATHS_GENERAL) {
            rhw_blend_state_generalize(&state->blend[i]);
        }
    }
    set_viewport_map(state);
    if (state->pipeline && pass->paths == RHW_PATHS_ALL) {
        state->hidden = rhw_hidden_rule_of(state->pipeline, state->blend, pass->color_count);
    }
    if (state->pipeline) {
        rhw_draw_plans_make(state->plans, state->pipeline, pass->paths);
    }
    pass->current = state;
    pass->pending_changed = false;
    return state;
}

// A first draw that nothing of can be seen: depth is 1 because nobody said what it is, as with reversed depth in a
// definition that was zeroed.
static bool faces_unset_depth(const struct rhw_pass_state *pass)
{
    const struct rhw_pipeline_def *const def = &pass->pending.pipeline->def;
    return pass->depth_by_default && pass->draws.count == 0 && def->depth_test &&
           (def->depth_compare == RHW_COMPARE_GREATER || def->depth_compare == RHW_COMPARE_GREATER_EQUAL);
}

static bool check_draw(const struct rhw_pass_state *pass, bool indexed, const char *where)
{
    struct rhw_context *const context = pass->context;
    const struct rhw_draw_state *const pending = &pass->pending;
    if (!rhw_check(context, pending->pipeline != NULL, "%s: no pipeline is set", where) ||
        !rhw_check(context, !indexed || pending->indices, "%s: no index buffer is set", where) ||
        !rhw_check(context, pass->uniform_size >= pending->pipeline->def.program.uniform_size,
                   "%s: %u bytes of uniforms are set; the program reads %u", where, pass->uniform_size,
                   pending->pipeline->def.program.uniform_size) ||
        !rhw_check(
            context, !faces_unset_depth(pass),
            "%s: the first draw asks for greater depth, which RHW_LOAD_DEFAULT cleared to 1; clear to 0 by "
            "RHW_LOAD_CLEAR",
            where)) {
        return false;
    }
    for (int i = 0; i < pending->pipeline->def.attribute_count; i++) {
        const int slot = pending->pipeline->def.attributes[i].buffer;
        if (!rhw_check(context, pending->streams[slot].bytes != NULL,
                       "%s: no vertex buffer is set in slot %d, which attribute %d reads", where, slot, i)) {
            return false;
        }
    }
    return true;
}

static void record(rhw_context *context, rhw_pass id, const struct rhw_draw *draw, uint32_t count,
                   const char *where)
{
    struct rhw_pass_state *const pass = pass_of(context, id, where);
    if (!pass || pass->out_of_memory || !check_draw(pass, draw->indexed, where)) {
        return;
    }
    const uint64_t environment = rhw_cpu_float_enter(); // viewport and blend constant are converted in it
    const struct rhw_draw_state *const state = snapshot(pass);
    rhw_cpu_float_leave(environment);
    struct rhw_draw *const slot = state ? rhw_draw_list_next(&context->memory, &pass->draws) : NULL;
    if (!slot) {
        pass->out_of_memory = true;
        return;
    }
    *slot = *draw;
    slot->state = state;
    slot->uniforms = pass->uniforms;
    slot->index = pass->draws.count;
    slot->first_triangle = pass->triangle_count;
    if (!rhw_assembly_prepare(slot, count, &pass->arena)) {
        pass->out_of_memory = true;
        return;
    }
    pass->draws.count++;
    pass->has_large_draws |= slot->indexed && slot->triangles_per_instance >= RHW_SHARING_TRIANGLES;
    pass->triangle_count += (uint64_t)slot->triangles_per_instance * slot->instances;
}

void rhw_pass_draw(rhw_context *context, rhw_pass id, uint32_t first, uint32_t count, uint32_t first_instance,
                   uint32_t instances)
{
    const struct rhw_draw draw = {.first = first, .first_instance = first_instance, .instances = instances};
    record(context, id, &draw, count, "rhw_pass_draw");
}

void rhw_pass_draw_indexed(rhw_context *context, rhw_pass id, uint32_t first, uint32_t count,
                           int32_t base_vertex, uint32_t first_instance, uint32_t instances)
{
    const struct rhw_draw draw = {.first = first,
                                  .base_vertex = (uint32_t)base_vertex,
                                  .first_instance = first_instance,
                                  .instances = instances,
                                  .indexed = true};
    record(context, id, &draw, count, "rhw_pass_draw_indexed");
}

enum rhw_result rhw_pass_end(rhw_context *context, rhw_pass id, struct rhw_stats *stats)
{
    struct rhw_pass_state *const pass = pass_of(context, id, "rhw_pass_end");
    if (!pass) {
        return RHW_ERROR_MISUSE;
    }
    context->pass_active = false;
    return pass->out_of_memory ? RHW_ERROR_OUT_OF_MEMORY : rhw_pass_run(pass, stats);
}
