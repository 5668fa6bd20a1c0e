// SPDX-License-Identifier: MIT
// The dynamic state of a pass is what its functions set beside the pipeline: viewports, scissors, lines, depth, stencil
// and the blend constant. This file records it, and finds what follows from it for a draw.
#include "dynamic_state.h"

#include <string.h>

#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "encoder.h"
#include "pipeline/pipeline.h"
#include "rhw/rhw.h"

static bool is_within(float v, float limit)
{
    return v >= -limit && v <= limit;
}

static void set_viewport(struct rhw_encoder *encoder, int index, const struct rhw_viewport *v,
                         const char *where)
{
    rhw_context *const context = encoder->context;
    const float limit = RHW_MAX_TARGET_SIZE;
    if (!rhw_check(context, v != NULL, "%s: viewport is NULL", where) ||
        !rhw_check(context, v->width > 0 && v->width <= limit && v->height >= -limit && v->height <= limit,
                   "%s: the size is %gx%g; the width is above 0, and neither is beyond %g", where,
                   (double)v->width, (double)v->height, (double)limit) ||
        !rhw_check(context,
                   v->x >= -2 * limit && v->x + v->width <= 2 * limit && is_within(v->y, 2 * limit) &&
                       is_within(v->y + v->height, 2 * limit),
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
    struct rhw_viewport *const viewport = &encoder->viewports[index];
    *viewport = *v;
    const bool unset = v->depth_min == 0 && v->depth_max == 0;
    viewport->depth_max = unset ? 1 : v->depth_max > 0 ? v->depth_max : 0;
    encoder->pending.viewport = encoder->viewports[0];
    encoder->pending_changed = true;
}

void rhw_pass_set_viewport(rhw_context *context, rhw_pass id, const struct rhw_viewport *viewport)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_set_viewport");
    if (encoder) {
        set_viewport(encoder, 0, viewport, "rhw_pass_set_viewport");
        rhw_context_leave(context);
    }
}

// Check that the `count` viewports or scissors from `first` on exist. `name` is the name of the array.
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
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check_viewports(context, first, count, viewports, "viewports", where)) {
        for (int i = 0; i < count; i++) {
            set_viewport(encoder, first + i, &viewports[i], where);
        }
    }
    rhw_context_leave(context);
}

static void set_scissor(struct rhw_encoder *encoder, int index, const struct rhw_rect *scissor,
                        const char *where)
{
    rhw_context *const context = encoder->context;
    if (rhw_check(context, scissor != NULL, "%s: scissor is NULL", where) &&
        rhw_check(context, scissor->width >= 0 && scissor->height >= 0,
                  "%s: the size is %dx%d; neither is negative", where, scissor->width, scissor->height)) {
        encoder->scissors[index] = *scissor;
        encoder->pending.scissor = encoder->scissors[0];
        encoder->pending_changed = true;
    }
}

void rhw_pass_set_scissors(rhw_context *context, rhw_pass id, int first, int count,
                           const struct rhw_rect *scissors)
{
    static const char *const where = "rhw_pass_set_scissors";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (check_viewports(context, first, count, scissors, "scissors", where)) {
        for (int i = 0; i < count; i++) {
            set_scissor(encoder, first + i, &scissors[i], where);
        }
    }
    rhw_context_leave(context);
}

void rhw_pass_set_scissor(rhw_context *context, rhw_pass id, const struct rhw_rect *scissor)
{
    static const char *const where = "rhw_pass_set_scissor";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (encoder) {
        set_scissor(encoder, 0, scissor, where);
        rhw_context_leave(context);
    }
}

void rhw_pass_set_line_width(rhw_context *context, rhw_pass id, float width)
{
    static const char *const where = "rhw_pass_set_line_width";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (rhw_check(context, width == 0 || (width >= 1 && width <= RHW_MAX_LINE_WIDTH),
                  "%s: width is %g; it must be 1..%d, or 0 for the pipelines' own", where, (double)width,
                  RHW_MAX_LINE_WIDTH)) {
        encoder->pending.line_width_setting = width;
        encoder->pending_changed = true;
    }
    rhw_context_leave(context);
}

void rhw_pass_set_line_stipple(rhw_context *context, rhw_pass id, const struct rhw_line_stipple *stipple)
{
    static const char *const where = "rhw_pass_set_line_stipple";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (!stipple || rhw_check_line_stipple(context, stipple, where)) {
        encoder->pending.stipple_setting.is_set = stipple != NULL;
        encoder->pending.stipple_setting.stipple = stipple ? *stipple : (struct rhw_line_stipple){0};
        encoder->pending_changed = true;
    }
    rhw_context_leave(context);
}

void rhw_pass_set_stencil_reference(rhw_context *context, rhw_pass id, uint8_t front, uint8_t back)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_set_stencil_reference");
    if (encoder) {
        encoder->pending.depth_setting.reference[0] = front;
        encoder->pending.depth_setting.reference[1] = back;
        encoder->pending_changed = true;
        rhw_context_leave(context);
    }
}

void rhw_pass_set_stencil_masks(rhw_context *context, rhw_pass id, const struct rhw_stencil_masks *masks)
{
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, "rhw_pass_set_stencil_masks");
    if (encoder) {
        encoder->pending.depth_setting.has_masks = masks != NULL;
        encoder->pending.depth_setting.masks = masks ? *masks : (struct rhw_stencil_masks){0};
        encoder->pending_changed = true;
        rhw_context_leave(context);
    }
}

void rhw_pass_set_depth_bias(rhw_context *context, rhw_pass id, const struct rhw_depth_bias *bias)
{
    static const char *const where = "rhw_pass_set_depth_bias";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (!bias || rhw_check_depth_bias(context, bias, where)) {
        encoder->pending.depth_setting.has_bias = bias != NULL;
        encoder->pending.depth_setting.bias = bias ? *bias : (struct rhw_depth_bias){0};
        encoder->pending_changed = true;
    }
    rhw_context_leave(context);
}

void rhw_pass_set_depth_bounds(rhw_context *context, rhw_pass id, float least, float most)
{
    static const char *const where = "rhw_pass_set_depth_bounds";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (rhw_check(context, least >= 0 && least <= most && most <= 1,
                  "%s: the bounds are %g..%g; they rise within 0..1", where, (double)least, (double)most)) {
        encoder->pending.depth_setting.bounds_least = least;
        encoder->pending.depth_setting.bounds_most = most;
        encoder->pending_changed = true;
    }
    rhw_context_leave(context);
}

void rhw_pass_set_blend_constant(rhw_context *context, rhw_pass id, const float constant[4])
{
    static const char *const where = "rhw_pass_set_blend_constant";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (rhw_check(context, constant != NULL, "%s: constant is NULL", where)) {
        memcpy(encoder->pending.blend_constant, constant, sizeof encoder->pending.blend_constant);
        encoder->pending_changed = true;
    }
    rhw_context_leave(context);
}

static int clamp_to(int64_t v, int low, int high)
{
    return v < low ? low : v > high ? high : (int)v;
}

// Return the first pixel whose centre is at or after `x`. `x` is within a few times ±RHW_MAX_TARGET_SIZE.
static int first_pixel(double x)
{
    const double edge = x - 0.5;
    const int towards_zero = (int)edge;
    return (double)towards_zero < edge ? towards_zero + 1 : towards_zero;
}

// Return the pixels whose centres are inside the viewport, the scissor and the render area. Points may reach over the
// edge of the viewport.
static struct rhw_rect clip_rect(const struct rhw_encoder *encoder, const struct rhw_viewport *v,
                                 const struct rhw_rect *scissor, bool is_points)
{
    const int vx0 = first_pixel(v->x), vx1 = first_pixel((double)v->x + (double)v->width);
    // Where the height is negative, `end` lies above `y`.
    const double y = (double)v->y, end = y + (double)v->height;
    const int vy0 = first_pixel(y < end ? y : end), vy1 = first_pixel(y < end ? end : y);
    const struct rhw_rect *const area = &encoder->pass->target.area;
    const int ax1 = area->x + area->width, ay1 = area->y + area->height;
    const int sx0 = clamp_to(scissor->x, area->x, ax1), sy0 = clamp_to(scissor->y, area->y, ay1);
    const int sx1 = clamp_to((int64_t)scissor->x + scissor->width, area->x, ax1);
    const int sy1 = clamp_to((int64_t)scissor->y + scissor->height, area->y, ay1);
    if (is_points) {
        return (struct rhw_rect){sx0, sy0, sx1 > sx0 ? sx1 - sx0 : 0, sy1 > sy0 ? sy1 - sy0 : 0};
    }
    const int x0 = vx0 > sx0 ? vx0 : sx0, y0 = vy0 > sy0 ? vy0 : sy0;
    const int x1 = vx1 < sx1 ? vx1 : sx1, y1 = vy1 < sy1 ? vy1 : sy1;
    return (struct rhw_rect){x0, y0, x1 > x0 ? x1 - x0 : 0, y1 > y0 ? y1 - y0 : 0};
}

void rhw_pass_clip_scissor(const struct rhw_encoder *encoder, struct rhw_draw_state *state)
{
    const bool any_sample =
        state->pipeline->def.sample_mask & ((1u << encoder->pass->target.pattern->count) - 1);
    state->scissor = any_sample ? clip_rect(encoder, &state->viewport, &state->scissor,
                                            state->pipeline->primitive == RHW_PRIMITIVE_POINTS ||
                                                state->pipeline->primitive == RHW_PRIMITIVE_POLYGON_POINTS)
                                : (struct rhw_rect){0};
}

void rhw_draw_state_map_viewport(struct rhw_draw_state *state)
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

void rhw_draw_state_set_lines(struct rhw_draw_state *state)
{
    const struct rhw_pipeline_data *const pipeline = state->pipeline;
    const bool is_lines =
        pipeline->primitive == RHW_PRIMITIVE_LINES || pipeline->primitive == RHW_PRIMITIVE_POLYGON_LINES;
    state->stipple = !is_lines                       ? (struct rhw_line_stipple){0}
                     : state->stipple_setting.is_set ? state->stipple_setting.stipple
                                                     : pipeline->def.line_stipple;
    const float width = state->line_width_setting != 0 ? state->line_width_setting : pipeline->def.line_width;
    state->line_pixels = (int)(width + 0.5f);
    state->half_width_24_8 = (double)width * (RHW_SUBPIXEL / 2);
}
