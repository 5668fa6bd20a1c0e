// SPDX-License-Identifier: MIT
// Recording: set_ functions change `bound` and `pending`, a draw copies what it needs of them when they changed.
// pass_begin.c begins a pass, pass_run.c runs it.
#include "pass.h"

#include <string.h>

#include "assembly.h"
#include "binding.h"
#include "buffer.h"
#include "context.h"
#include "cpu.h"
#include "draw_range.h"
#include "effect_vertices.h"
#include "entry.h"
#include "format.h"
#include "hidden_surface.h"
#include "lookup.h"
#include "misuse.h"
#include "pass_enter.h"
#include "pass_line_stipple.h"
#include "pass_run.h"
#include "pass_state.h"
#include "pass_storage.h"
#include "pipeline.h"
#include "query.h"
#include "rhw/rhw.h"
#include "sampler.h"
#include "shared_texels.h"
#include "shared_vertices.h"
#include "srgb_texture.h"
#include "strip_stipple.h"
#include "texture_access.h"
#include "transform_feedback.h"
#include "watch.h"

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

// A definition whose targets are those of another, for depth alone, is right; but a reason to look at first.
static bool forgets_count(const struct rhw_pipeline_def *def)
{
    return def->target_count == 0 && def->targets[0].format != RHW_FORMAT_NONE;
}

// A pipeline draws into what it was made for.
static bool targets_match(const struct rhw_pass_state *pass, rhw_pipeline id,
                          const struct rhw_pipeline_data *pipeline, const char *where)
{
    struct rhw_context *const context = pass->context;
    if (!rhw_check(context, pipeline->def.target_count == pass->color_count,
                   "%s: %s has %d targets%s; the pass has %d colour attachments", where,
                   rhw_name_of(&context->pipelines, id.index).text, pipeline->def.target_count,
                   forgets_count(&pipeline->def) ? " (targets[0] is set and target_count is 0)" : "",
                   pass->color_count)) {
        return false;
    }
    for (int i = 0; i < pass->color_count; i++) {
        if (!rhw_check(context, pipeline->def.targets[i].format == pass->colors[i].format,
                       "%s: target %d of %s is %s; the attachment is %s", where, i,
                       rhw_name_of(&context->pipelines, id.index).text,
                       rhw_format_info(pipeline->def.targets[i].format)->name,
                       rhw_format_info(pass->colors[i].format)->name)) {
            return false;
        }
    }
    return rhw_check(context,
                     pass->has_depth || !(pipeline->def.depth_test || pipeline->def.depth_bounds_test),
                     "%s: %s tests depth; the pass has no depth attachment", where,
                     rhw_name_of(&context->pipelines, id.index).text) &&
           rhw_check(context, pass->has_depth || !(pipeline->def.program.uses & RHW_USE_DEPTH_INPUT),
                     "%s: %s reads depth_input; the pass has no depth attachment", where,
                     rhw_name_of(&context->pipelines, id.index).text) &&
           rhw_check(context, pass->has_stencil || !pipeline->def.stencil_test,
                     "%s: %s tests stencil; the pass has no stencil attachment", where,
                     rhw_name_of(&context->pipelines, id.index).text);
}

// Under validation: what a pass of one sample has no use for. The pipeline may be meant for others too, hence no misuse.
static void warn_of_samples(const struct rhw_pass_state *pass, rhw_pipeline id,
                            const struct rhw_pipeline_def *def, const char *where)
{
    const char *const name = def->alpha_to_coverage           ? "alpha_to_coverage"
                             : def->alpha_to_one              ? "alpha_to_one"
                             : def->sample_mask != UINT32_MAX ? "sample_mask"
                                                              : NULL;
    if (name != NULL && pass->pattern->count == 1) {
        rhw_context_log(pass->context, RHW_LOG_WARNING,
                        "%s: %s has %s set and the pass has one sample a pixel; it has no effect", where,
                        rhw_name_of(&pass->context->pipelines, id.index).text, name);
    }
}

void rhw_pass_set_pipeline(rhw_context *context, rhw_pass id, rhw_pipeline pipeline_id)
{
    static const char *const where = "rhw_pass_set_pipeline";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    const struct rhw_pipeline_data *const pipeline = rhw_context_pipeline(context, pipeline_id, where);
    if (pipeline &&
        rhw_check(context, !pass->feedback.is_active, "%s: transform feedback is under way; end it first",
                  where) &&
        targets_match(pass, pipeline_id, pipeline, where)) {
        rhw_pool_use(&context->pipelines, pipeline_id.index, context->recording.generation);
        if (context->findings && pass->pending.pipeline != pipeline) {
            warn_of_samples(pass, pipeline_id, &pipeline->def, where);
        }
        pass->pending_changed |= pass->pending.pipeline != pipeline;
        pass->pending.pipeline = pipeline;
        pass->bound.pipeline = pipeline_id;
    } else {
        pass->refused_pipeline = true;
    }
    rhw_context_leave(context);
}

// Nothing says what would come first, reading or writing.
static __attribute__((cold)) void report_written(const rhw_context *context, rhw_buffer id,
                                                 const struct rhw_buffer_data *buffer, const char *where)
{
    const bool is_stored = buffer->stored_pass == context->recording.generation;
    rhw_misuse(context, "%s: %s is %s", where, rhw_name_of(&context->buffers, id.index).text,
               is_stored ? "a storage buffer of this pass, which may write it"
                         : "written by the transform feedback of this pass");
}

// A buffer that draws will read from `offset` on; its data is NULL when the call was misuse.
static inline struct rhw_bound_buffer bind_buffer(rhw_context *context, rhw_buffer id, size_t offset,
                                                  const char *where)
{
    const uint32_t generation = context->recording.generation;
    struct rhw_buffer_data *const buffer = rhw_context_buffer(context, id, where);
    if (!buffer || !rhw_check(context, offset <= buffer->size, "%s: offset is %zu; %s has %zu bytes", where,
                              offset, rhw_name_of(&context->buffers, id.index).text, buffer->size)) {
        return (struct rhw_bound_buffer){.data = NULL};
    }
    if (buffer->stored_pass == generation || buffer->captured_pass == generation) {
        report_written(context, id, buffer, where);
        return (struct rhw_bound_buffer){.data = NULL};
    }
    if (buffer->is_map_written && !rhw_buffer_check_drawable(context, id, buffer, where)) {
        return (struct rhw_bound_buffer){.data = NULL};
    }
    buffer->fetched_pass = generation;
    rhw_pool_use(&context->buffers, id.index, generation);
    return (struct rhw_bound_buffer){buffer, offset, id.index};
}

static bool same_buffer(struct rhw_bound_buffer a, struct rhw_bound_buffer b)
{
    return a.data == b.data && a.offset == b.offset;
}

void rhw_pass_set_vertex_buffer(rhw_context *context, rhw_pass id, int slot, rhw_buffer buffer, size_t offset)
{
    static const char *const where = "rhw_pass_set_vertex_buffer";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (rhw_check(context, slot >= 0 && slot < RHW_MAX_VERTEX_BUFFERS, "%s: slot is %d; it is in 0..%d",
                  where, slot, RHW_MAX_VERTEX_BUFFERS - 1)) {
        const struct rhw_bound_buffer bound = bind_buffer(context, buffer, offset, where);
        if (bound.data) {
            pass->pending_changed |= !same_buffer(pass->bound.vertices[slot], bound);
            pass->bound.vertices[slot] = bound;
        }
    }
    rhw_context_leave(context);
}

void rhw_pass_set_index_buffer(rhw_context *context, rhw_pass id, rhw_buffer buffer, enum rhw_index_type type,
                               size_t offset)
{
    static const char *const where = "rhw_pass_set_index_buffer";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (rhw_check(context, (unsigned)type <= RHW_INDEX_UINT32, "%s: type is %d; not an index type", where,
                  (int)type)) {
        const struct rhw_bound_buffer bound = bind_buffer(context, buffer, offset, where);
        if (bound.data) {
            pass->pending_changed |=
                !same_buffer(pass->bound.indices, bound) || pass->pending.index_type != type;
            pass->bound.indices = bound;
            pass->pending.index_type = type;
        }
    }
    rhw_context_leave(context);
}

static void set_uniforms(struct rhw_pass_state *pass, const void *data, size_t size)
{
    static const char *const where = "rhw_pass_set_uniforms";
    rhw_context *const context = pass->context;
    if (!rhw_check(context, data || size == 0, "%s: data is NULL and size is %zu", where, size) ||
        !rhw_check(context, size <= RHW_MAX_UNIFORM_SIZE, "%s: size is %zu; at most %d", where, size,
                   RHW_MAX_UNIFORM_SIZE)) {
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

void rhw_pass_set_uniforms(rhw_context *context, rhw_pass id, const void *data, size_t size)
{
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, "rhw_pass_set_uniforms");
    if (pass) {
        set_uniforms(pass, data, size);
        rhw_context_leave(context);
    }
}

static bool check_sampled(const rhw_context *context, rhw_texture id, int slot, const char *where)
{
    const struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    return texture &&
           rhw_check(context, rhw_format_has_role(texture->info, RHW_ROLE_SAMPLED),
                     "%s: %s is %s; it cannot be sampled", where,
                     rhw_name_of(&context->textures, id.index).text, texture->info->name) &&
           rhw_check(context, !rhw_texture_is_attached(context, texture),
                     "%s: %s, for slot %d, is an attachment of this pass", where,
                     rhw_name_of(&context->textures, id.index).text, slot);
}

// Whether a sampler gives texels as they are.
static bool takes_texels(const struct rhw_texture_data *texture, const struct rhw_sampler_data *sampler)
{
    const struct rhw_sampler_def *const def = &sampler->def;
    return def->min_filter == RHW_FILTER_NEAREST && def->mag_filter == RHW_FILTER_NEAREST &&
           (def->mip_filter != RHW_MIP_FILTER_LINEAR || texture->levels == 1) && !def->compares &&
           def->max_anisotropy <= 1 && def->reduction == RHW_REDUCTION_AVERAGE;
}

// Formats that are not filtered give their texels. Coordinates in texels are those of a single 1D or 2D image (Vulkan 1.3, VkSamplerCreateInfo).
static bool check_sampler(const rhw_context *context, rhw_texture id, rhw_sampler sampler_id,
                          const struct rhw_sampler_data *sampler, const char *where)
{
    const struct rhw_texture_data *const texture = rhw_context_texture(context, id, where);
    const struct rhw_texture_shape *const shape = &texture->shape;
    return rhw_check(context,
                     rhw_format_has_role(texture->info, RHW_ROLE_FILTERED) || takes_texels(texture, sampler),
                     "%s: %s is %s, which is not filtered; %s must have nearest filters, and no comparison, "
                     "anisotropy or reduction",
                     where, rhw_name_of(&context->textures, id.index).text, texture->info->name,
                     rhw_name_of(&context->samplers, sampler_id.index).text) &&
           rhw_check(context,
                     !sampler->def.unnormalized || (!shape->is_array && (shape->kind == RHW_TEXTURE_1D ||
                                                                         shape->kind == RHW_TEXTURE_2D)),
                     "%s: %s is unnormalized and %s has kind %d, layers %d; it must be 1D or 2D and no array",
                     where, rhw_name_of(&context->samplers, sampler_id.index).text,
                     rhw_name_of(&context->textures, id.index).text, (int)shape->kind, shape->layers);
}

// Single samples are not filtered. False when out of memory.
static bool linearize(struct rhw_context *context, struct rhw_texture_data *texture)
{
    return texture->samples > 1 || rhw_texture_linearize(context, texture);
}

static void set_texture(struct rhw_pass_state *pass, int slot, rhw_texture texture, rhw_sampler sampler)
{
    static const char *const where = "rhw_pass_set_texture";
    rhw_context *const context = pass->context;
    struct rhw_bound_texture bound = {NULL, NULL};
    if (!rhw_check(context, slot >= 0 && slot < RHW_MAX_TEXTURES, "%s: slot is %d; it is in 0..%d", where,
                   slot, RHW_MAX_TEXTURES - 1)) {
        return;
    }
    if (texture.index != 0) {
        bound.sampler = check_sampled(context, texture, slot, where)
                            ? rhw_context_sampler(context, sampler, where)
                            : NULL;
        if (!bound.sampler || !check_sampler(context, texture, sampler, bound.sampler, where)) {
            return;
        }
        bound.texture = rhw_pool_get(&context->textures, texture.index, texture.generation);
        rhw_texture_note_sampled(*bound.texture, context->recording.generation);
        pass->out_of_memory |= !linearize(context, *bound.texture);
        rhw_pool_use(&context->textures, texture.index, context->recording.generation);
        rhw_pool_use(&context->samplers, sampler.index, context->recording.generation);
    }
    struct rhw_bound_texture *const current = &pass->bound.textures[slot];
    pass->textures_changed |= current->texture != bound.texture || current->sampler != bound.sampler;
    *current = bound;
}

void rhw_pass_set_texture(rhw_context *context, rhw_pass id, int slot, rhw_texture texture,
                          rhw_sampler sampler)
{
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, "rhw_pass_set_texture");
    if (pass) {
        set_texture(pass, slot, texture, sampler);
        rhw_context_leave(context);
    }
}

static void set_viewport(struct rhw_pass_state *pass, int index, const struct rhw_viewport *v,
                         const char *where)
{
    rhw_context *const context = pass->context;
    const float limit = RHW_MAX_TARGET_SIZE;
    if (!rhw_check(context, v != NULL, "%s: viewport is NULL", where) ||
        !rhw_check(context, v->width > 0 && v->height > 0 && v->width <= limit && v->height <= limit,
                   "%s: the size is %gx%g; each is above 0 and at most %g", where, (double)v->width,
                   (double)v->height, (double)limit) ||
        !rhw_check(context,
                   v->x >= -2 * limit && v->x + v->width <= 2 * limit && v->y >= -2 * limit &&
                       v->y + v->height <= 2 * limit,
                   "%s: the corners are %g,%g and %g,%g; each is within ±%g", where, (double)v->x,
                   (double)v->y, (double)(v->x + v->width), (double)(v->y + v->height),
                   (double)(2 * limit)) ||
        !rhw_check(context,
                   v->depth_min >= 0 && v->depth_min <= 1 &&
                       ((v->depth_max >= 0 && v->depth_max <= 1) || v->depth_max == -1),
                   "%s: the depth range is %g..%g; each end is in 0..1, or depth_max is -1", where,
                   (double)v->depth_min, (double)v->depth_max)) {
        return;
    }
    struct rhw_viewport *const viewport = &pass->viewports[index];
    *viewport = *v;
    const bool unset = v->depth_min == 0 && v->depth_max == 0;
    viewport->depth_max = unset ? 1 : v->depth_max > 0 ? v->depth_max : 0;
    pass->pending.viewport = pass->viewports[0];
    pass->pending_changed = true;
}

void rhw_pass_set_viewport(rhw_context *context, rhw_pass id, const struct rhw_viewport *viewport)
{
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, "rhw_pass_set_viewport");
    if (pass) {
        set_viewport(pass, 0, viewport, "rhw_pass_set_viewport");
        rhw_context_leave(context);
    }
}

// Whether `count` viewports or scissors from `first` on exist. `name`: of the array.
static bool check_viewports(const rhw_context *context, int first, int count, const void *array,
                            const char *name, const char *where)
{
    return rhw_check(context, first >= 0 && count >= 0 && first <= RHW_MAX_VIEWPORTS - count,
                     "%s: first is %d and count %d; there are %d", where, first, count, RHW_MAX_VIEWPORTS) &&
           rhw_check(context, array != NULL || count == 0, "%s: %s is NULL", where, name);
}

void rhw_pass_set_viewports(rhw_context *context, rhw_pass id, int first, int count,
                            const struct rhw_viewport *viewports)
{
    static const char *const where = "rhw_pass_set_viewports";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (check_viewports(context, first, count, viewports, "viewports", where)) {
        for (int i = 0; i < count; i++) {
            set_viewport(pass, first + i, &viewports[i], where);
        }
    }
    rhw_context_leave(context);
}

static void set_scissor(struct rhw_pass_state *pass, int index, const struct rhw_rect *scissor,
                        const char *where)
{
    rhw_context *const context = pass->context;
    if (rhw_check(context, scissor != NULL, "%s: scissor is NULL", where) &&
        rhw_check(context, scissor->width >= 0 && scissor->height >= 0,
                  "%s: the size is %dx%d; neither is negative", where, scissor->width, scissor->height)) {
        pass->scissors[index] = *scissor;
        pass->pending.scissor = pass->scissors[0];
        pass->pending_changed = true;
    }
}

void rhw_pass_set_scissors(rhw_context *context, rhw_pass id, int first, int count,
                           const struct rhw_rect *scissors)
{
    static const char *const where = "rhw_pass_set_scissors";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (check_viewports(context, first, count, scissors, "scissors", where)) {
        for (int i = 0; i < count; i++) {
            set_scissor(pass, first + i, &scissors[i], where);
        }
    }
    rhw_context_leave(context);
}

void rhw_pass_set_scissor(rhw_context *context, rhw_pass id, const struct rhw_rect *scissor)
{
    static const char *const where = "rhw_pass_set_scissor";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (pass) {
        set_scissor(pass, 0, scissor, where);
        rhw_context_leave(context);
    }
}

void rhw_pass_set_blend_constant(rhw_context *context, rhw_pass id, const float constant[4])
{
    static const char *const where = "rhw_pass_set_blend_constant";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (rhw_check(context, constant != NULL, "%s: constant is NULL", where)) {
        memcpy(pass->pending.blend_constant, constant, sizeof pass->pending.blend_constant);
        pass->pending_changed = true;
    }
    rhw_context_leave(context);
}

void rhw_pass_push_debug_group(rhw_context *context, rhw_pass id, const char *label)
{
    static const char *const where = "rhw_pass_push_debug_group";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    if (rhw_check(context, label != NULL, "%s: label is NULL", where)) {
        struct rhw_debug_group *const group = rhw_arena_alloc(&pass->arena, sizeof *group, _Alignof(void *));
        if (group) {
            group->outer = context->recording.group;
            rhw_label_copy(group->label, label);
            context->recording.group = group;
        }
        pass->out_of_memory |= !group;
    }
    rhw_context_leave(context);
}

void rhw_pass_pop_debug_group(rhw_context *context, rhw_pass id)
{
    static const char *const where = "rhw_pass_pop_debug_group";
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (!pass) {
        return;
    }
    const struct rhw_debug_group *const group = context->recording.group;
    if (pass->out_of_memory || rhw_check(context, group != NULL, "%s: no group was pushed", where)) {
        context->recording.group = group ? group->outer : NULL;
    }
    rhw_context_leave(context);
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

// The pixels whose centres are inside the viewport, the scissor and the target. Points may reach over the viewport.
static struct rhw_rect clip_rect(const struct rhw_pass_state *pass, const struct rhw_viewport *v,
                                 const struct rhw_rect *scissor, bool is_points)
{
    const int vx0 = first_pixel(v->x), vx1 = first_pixel((double)v->x + (double)v->width);
    const int vy0 = first_pixel(v->y), vy1 = first_pixel((double)v->y + (double)v->height);
    const int sx0 = clamp_to(scissor->x, 0, pass->width), sy0 = clamp_to(scissor->y, 0, pass->height);
    const int sx1 = clamp_to((int64_t)scissor->x + scissor->width, 0, pass->width);
    const int sy1 = clamp_to((int64_t)scissor->y + scissor->height, 0, pass->height);
    if (is_points) {
        return (struct rhw_rect){sx0, sy0, sx1 > sx0 ? sx1 - sx0 : 0, sy1 > sy0 ? sy1 - sy0 : 0};
    }
    const int x0 = vx0 > sx0 ? vx0 : sx0, y0 = vy0 > sy0 ? vy0 : sy0;
    const int x1 = vx1 < sx1 ? vx1 : sx1, y1 = vy1 < sy1 ? vy1 : sy1;
    return (struct rhw_rect){x0, y0, x1 > x0 ? x1 - x0 : 0, y1 > y0 ? y1 - y0 : 0};
}

// Holds the state's scissor within its viewport and the target.
static void clip_scissor(const struct rhw_pass_state *pass, struct rhw_draw_state *state)
{
    state->scissor = clip_rect(pass, &state->viewport, &state->scissor,
                               state->pipeline->primitive == RHW_PRIMITIVE_POINTS ||
                                   state->pipeline->primitive == RHW_PRIMITIVE_POLYGON_POINTS);
}

// Sets what vertices and depth need of the viewport and of the pipeline's range of Z.
static void set_viewport_map(struct rhw_draw_state *state)
{
    const struct rhw_viewport *const v = &state->viewport;
    const bool symmetric = state->pipeline->def.depth_range == RHW_DEPTH_MINUS_ONE_TO_ONE;
    const double span = (double)v->depth_max - (double)v->depth_min;
    state->depth_low = (double)v->depth_min + (symmetric ? span / 2 : 0);
    state->depth_span = symmetric ? span / 2 : span;
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    const bool leaves_range = def->depth_clip_disabled || state->depth_stencil.is_biased;
    if (leaves_range && !def->depth_clamp) {
        state->depth_least = 0;
        state->depth_most = 1;
    } else {
        state->depth_least = v->depth_min < v->depth_max ? v->depth_min : v->depth_max;
        state->depth_most = v->depth_min < v->depth_max ? v->depth_max : v->depth_min;
    }
    state->half_width = (double)v->width / 2;
    state->half_height = (double)v->height / 2;
    state->center_x = (double)v->x + state->half_width;
    state->center_y = (double)v->y + state->half_height;
}

static struct rhw_vertex_stream stream_of(struct rhw_bound_buffer bound)
{
    return bound.data
               ? (struct rhw_vertex_stream){bound.data->bytes + bound.offset, bound.data->size - bound.offset}
               : (struct rhw_vertex_stream){NULL, 0};
}

// The bytes that buffers have now: one that is written after a draw of this pass gets new ones.
static void resolve_buffers(struct rhw_pass_state *pass)
{
    struct rhw_draw_state *const pending = &pass->pending;
    for (int i = 0; i < RHW_MAX_VERTEX_BUFFERS; i++) {
        pending->streams[i] = stream_of(pass->bound.vertices[i]);
    }
    const struct rhw_vertex_stream indices = stream_of(pass->bound.indices);
    pending->indices = indices.bytes;
    pending->index_bytes = indices.size;
}

// The same for textures. False when out of memory.
static bool resolve_textures(struct rhw_pass_state *pass)
{
    struct rhw_context *const context = pass->context;
    struct rhw_bindings *const bindings = rhw_arena_alloc(&pass->arena, sizeof *bindings, RHW_CACHE_LINE);
    if (!bindings) {
        return false;
    }
    rhw_bindings_init(bindings, context->kernels);
    for (int i = 0; i < RHW_MAX_TEXTURES; i++) {
        const struct rhw_bound_texture *const bound = &pass->bound.textures[i];
        if (bound->texture) {
            if (!linearize(context, *bound->texture)) {
                return false;
            }
            bindings->slot[i] =
                rhw_binding_of(context->kernels, context->paths, *bound->texture, bound->sampler);
        }
    }
    bindings->storage = rhw_pass_storage_of(pass);
    pass->pending.textures = bindings;
    return bindings->storage != NULL;
}

// Brings `pending` up to date with what is bound. False when out of memory.
static bool resolve(struct rhw_pass_state *pass)
{
    const uint32_t rewrites = pass->context->recording.rewrites;
    const bool rewritten = rewrites != pass->rewrites_seen;
    if (!rewritten && !pass->textures_changed && !pass->pending_changed) {
        return true;
    }
    if (pass->textures_changed || rewritten) {
        if (!resolve_textures(pass)) {
            return false;
        }
        pass->textures_changed = false;
        pass->pending_changed = true;
    }
    resolve_buffers(pass);
    pass->rewrites_seen = rewrites;
    return true;
}

// An immutable copy of what the next draw uses, shared by the draws between two changes.
static const struct rhw_draw_state *snapshot(struct rhw_pass_state *pass)
{
    if (!resolve(pass)) {
        return NULL;
    }
    if (pass->current && !pass->pending_changed) {
        return pass->current;
    }
    struct rhw_draw_state *const state = rhw_arena_alloc(&pass->arena, sizeof *state, RHW_CACHE_LINE);
    if (!state) {
        return NULL;
    }
    *state = pass->pending;
    clip_scissor(pass, state);
    for (int i = 0; i < pass->color_count; i++) {
        rhw_blend_state_init(&state->blend[i], &state->pipeline->def.targets[i], state->pipeline->def.logic,
                             state->blend_constant);
        if (pass->paths == RHW_PATHS_GENERAL) {
            rhw_blend_state_generalize(&state->blend[i]);
        }
    }
    rhw_depth_stencil_init(&state->depth_stencil, &state->pipeline->def, &state->depth_setting,
                           pass->depth_steps);
    set_viewport_map(state);
    state->stipple = rhw_line_stipple_of(&state->stipple_setting, state->pipeline);
    state->first_step = RHW_SUBPIXEL - pass->pattern->most_0_8 - 1;
    state->past_step = RHW_SUBPIXEL - pass->pattern->least_0_8;
    if (state->pipeline->is_conservative) { // borders of pixels instead
        state->first_step = -1;
        state->past_step = RHW_SUBPIXEL;
    }
    rhw_draw_plans_make(state->plans, state->pipeline, &state->depth_stencil, pass->pattern->count,
                        pass->paths);
    if (pass->paths == RHW_PATHS_ALL) {
        state->hidden = rhw_hidden_rule_of(state, pass->color_count);
    }
    pass->current = state;
    memset(pass->routed, 0, sizeof pass->routed);
    pass->pending_changed = false;
    return state;
}

// The state of the draw in viewport `i`. NULL when out of memory.
static const struct rhw_draw_state *routed_state(struct rhw_pass_state *pass, int i)
{
    if (i == 0 || pass->routed[i]) {
        return i == 0 ? pass->current : pass->routed[i];
    }
    struct rhw_draw_state *const state = rhw_arena_alloc(&pass->arena, sizeof *state, RHW_CACHE_LINE);
    if (!state) {
        return NULL;
    }
    *state = *pass->current;
    state->viewport = pass->viewports[i];
    state->scissor = pass->scissors[i];
    state->viewport_index = i;
    clip_scissor(pass, state);
    set_viewport_map(state);
    pass->routed[i] = state;
    return state;
}

// Gives a draw whose vertices name their viewport the same draw in each. False when out of memory.
static bool route_draw(struct rhw_pass_state *pass, struct rhw_draw *draw)
{
    if (!draw->state->pipeline->def.program.writes_viewport_index) {
        return true;
    }
    struct rhw_draw *const draws =
        rhw_arena_alloc(&pass->arena, RHW_MAX_VIEWPORTS * sizeof *draws, RHW_CACHE_LINE);
    if (!draws) {
        return false;
    }
    const uint64_t environment = rhw_cpu_float_enter();
    bool made = true;
    for (int i = 0; i < RHW_MAX_VIEWPORTS && made; i++) {
        draws[i] = *draw;
        draws[i].state = routed_state(pass, i);
        made = draws[i].state != NULL;
    }
    rhw_cpu_float_leave(environment);
    draw->viewports = draws;
    return made;
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
    const struct rhw_pipeline_data *const pipeline = pass->pending.pipeline;
    if (!rhw_check(context, pipeline != NULL, "%s: no pipeline is set%s", where,
                   pass->refused_pipeline ? ", as the one that was to be was refused" : "") ||
        !rhw_check(context, !indexed || pass->bound.indices.data, "%s: no index buffer is set", where) ||
        !rhw_check(context, pass->uniform_size >= pipeline->def.program.uniform_size,
                   "%s: %u bytes of uniforms are set; the program of %s reads %u", where, pass->uniform_size,
                   rhw_name_of(&context->pipelines, pass->bound.pipeline.index).text,
                   pipeline->def.program.uniform_size) ||
        !rhw_check(
            context, !faces_unset_depth(pass),
            "%s: the first draw asks for greater depth, which RHW_LOAD_DEFAULT cleared to 1; clear to 0 by "
            "RHW_LOAD_CLEAR",
            where)) {
        return false;
    }
    for (int i = 0; i < pipeline->def.attribute_count; i++) {
        const int slot = pipeline->def.attributes[i].buffer;
        if (!rhw_check(context, pass->bound.vertices[slot].data != NULL,
                       "%s: no vertex buffer is set in slot %d, which attribute %d of %s reads", where, slot,
                       i, rhw_name_of(&context->pipelines, pass->bound.pipeline.index).text)) {
            return false;
        }
    }
    return true;
}

// The uniforms of the next draw, as its pipeline's functions or their watch want them.
static const void *uniforms_of(struct rhw_pass_state *pass)
{
    const struct rhw_pipeline_data *const pipeline = pass->pending.pipeline;
    if (!pipeline->watch) {
        return pass->uniforms;
    }
    const void *const watched = rhw_watched_uniforms(&pass->arena, pass->uniforms,
                                                     pipeline->def.program.uniform_size, pass->draws.count);
    pass->out_of_memory |= !watched;
    return watched;
}

static void append_draw(struct rhw_pass_state *pass, const struct rhw_draw *draw, uint32_t count)
{
    const uint64_t environment = rhw_cpu_float_enter(); // viewport and blend constant are converted in it
    const struct rhw_draw_state *const state = snapshot(pass);
    rhw_cpu_float_leave(environment);
    struct rhw_draw *const slot = state ? rhw_draw_list_next(&pass->context->memory, &pass->draws) : NULL;
    if (!slot) {
        pass->out_of_memory = true;
        return;
    }
    *slot = *draw;
    slot->state = state;
    slot->uniforms = uniforms_of(pass);
    slot->index = pass->draws.count;
    slot->group = pass->context->recording.group;
    slot->first_triangle = pass->triangle_count;
    const bool stipples = rhw_strip_stipple_needed(slot);
    slot->is_shaded_first = stipples || state->pipeline->def.program.vertex_effects;
    if (pass->out_of_memory || !rhw_assembly_prepare(slot, count, &pass->arena) ||
        (stipples && !rhw_strip_stipple_prepare(slot, count, &pass->arena)) ||
        (slot->is_shaded_first && !rhw_effect_vertices_prepare(slot, &pass->arena)) ||
        (pass->feedback.is_active && !rhw_feedback_add_draw(pass, slot)) || !route_draw(pass, slot)) {
        pass->out_of_memory = true;
        return;
    }
    pass->shades_first |= slot->is_shaded_first;
    pass->draws.count++;
    pass->context->recording.draw = pass->draws.count;
    pass->has_large_draws |= slot->indexed && slot->triangles_per_instance >= RHW_SHARING_TRIANGLES;
    const int triangles_most = state->pipeline->triangles_most;
    pass->triangles_most = triangles_most > pass->triangles_most ? triangles_most : pass->triangles_most;
    pass->triangle_count += (uint64_t)slot->triangles_per_instance * slot->instances;
    if (state->queries) {
        rhw_queries_count_draw(slot, count);
    }
}

void rhw_pass_record(struct rhw_pass_state *pass, const struct rhw_draw *draw, uint32_t count,
                     const char *where)
{
    if (!pass->out_of_memory && check_draw(pass, draw->indexed, where) &&
        (!pass->context->findings || rhw_draw_range_check(pass, draw, count, where))) {
        append_draw(pass, draw, count);
    }
}

static void record(rhw_context *context, rhw_pass id, const struct rhw_draw *draw, uint32_t count,
                   const char *where)
{
    struct rhw_pass_state *const pass = rhw_pass_enter(context, id, where);
    if (pass) {
        rhw_pass_record(pass, draw, count, where);
        rhw_context_leave(context);
    }
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
