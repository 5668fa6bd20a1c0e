// SPDX-License-Identifier: MIT
// When a pass begins, its definition is checked, and everything of the last pass is reset. pass/attach.c takes the
// attachments. pass/pass.c and the files beside it record into the pass.
#include <string.h>

#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "attach.h"
#include "encoder.h"
#include "rhw/rhw.h"
#include "base/thread.h"

static const char *const where = "rhw_pass_begin";

static void reset(struct rhw_encoder *encoder, const struct rhw_pass_def *def)
{
    struct rhw_recorded_pass *const pass = encoder->pass;
    rhw_encoder_renew(encoder);
    pass->begun_ns = rhw_time_ns();
    pass->target.width = def->width;
    pass->target.height = def->height;
    pass->target.area = def->render_area;
    pass->target.color_count = def->color_count;
    encoder->names_size = def->width != 0;
    encoder->feedback = (struct rhw_feedback_state){0};
    encoder->current = NULL;
    encoder->refused_pipeline = false;
    memset(&encoder->pending, 0, sizeof encoder->pending);
    encoder->pending_changed = true;
    encoder->uniforms = NULL;
    encoder->uniform_size = 0;
}

static bool check_def(rhw_context *context, const struct rhw_pass_def *def, const rhw_pass *id)
{
    return rhw_check(context, def != NULL && id != NULL, "%s: def and pass must not be NULL", where) &&
           rhw_check(context, !context->recording.active, "%s: a pass is being recorded; end it first",
                     where) &&
           rhw_check(context, def->color_count >= 0 && def->color_count <= RHW_MAX_COLOR_ATTACHMENTS,
                     "%s: color_count is %d; it is in 0..%d", where, def->color_count,
                     RHW_MAX_COLOR_ATTACHMENTS) &&
           rhw_check(context, def->color_count > 0 || def->colors[0].texture.index == 0,
                     "%s: colors[0].texture is set and color_count is 0; it must be 1 or more, or the "
                     "texture null",
                     where) &&
           rhw_check(
               context, def->color_count == 0 || rhw_pass_def_has_color(def),
               "%s: colors[0].texture is null, and so are all others; give one of them a texture, or set "
               "color_count = 0",
               where) &&
           rhw_check(context,
                     def->color_count > 0 || def->depth.enabled || (def->width > 0 && def->height > 0),
                     "%s: the pass has no attachment, so width and height must be set", where) &&
           rhw_check(context, (def->width == 0) == (def->height == 0),
                     "%s: width is %d and height is %d; both are set, or both are 0", where, def->width,
                     def->height) &&
           rhw_check(
               context, def->layers == 0 || (def->color_count == 0 && !def->depth.enabled),
               "%s: layers is %d and the pass has an attachment; its layer_count says how many there are",
               where, def->layers);
}

// Set the render area of the pass, whose size is known. Return false where the definition's area is misuse.
static bool set_area(struct rhw_encoder *encoder)
{
    struct rhw_target *const target = &encoder->pass->target;
    struct rhw_rect *const area = &target->area;
    if (area->x == 0 && area->y == 0 && area->width == 0 && area->height == 0) {
        area->width = target->width;
        area->height = target->height;
    }
    return rhw_check(encoder->context,
                     area->x >= 0 && area->y >= 0 && area->width > 0 && area->height > 0 &&
                         area->width <= target->width - area->x && area->height <= target->height - area->y,
                     "%s: render_area is %d,%d %dx%d; it lies within the pass, which is %dx%d, or is all 0",
                     where, area->x, area->y, area->width, area->height, target->width, target->height);
}

static void begin_recording(struct rhw_context *context, const struct rhw_pass_def *def)
{
    struct rhw_recording_place *const recording = &context->recording;
    atomic_store_explicit(&context->refused, false, memory_order_relaxed);
    recording->active = true;
    if (context->owner) {
        atomic_fetch_add(&context->owner->open_recordings, 1);
    }
    recording->misused = false;
    recording->draw = 0;
    recording->group = NULL;
    rhw_label_copy(recording->label, def->label);
}

static enum rhw_result begin(rhw_context *context, const struct rhw_pass_def *def, rhw_pass *id)
{
    struct rhw_encoder *const encoder = context->encoder;
    struct rhw_target *const target = &encoder->pass->target;
    if (!check_def(context, def, id)) {
        return RHW_ERROR_MISUSE;
    }
    reset(encoder, def);
    const enum rhw_result result = rhw_pass_attach(encoder, def);
    if (result != RHW_OK) {
        return result;
    }
    if (!rhw_check(context,
                   target->width >= 1 && target->width <= RHW_MAX_TARGET_SIZE && target->height >= 1 &&
                       target->height <= RHW_MAX_TARGET_SIZE,
                   "%s: the size is %dx%d; each is in 1..%d", where, target->width, target->height,
                   RHW_MAX_TARGET_SIZE)) {
        return RHW_ERROR_MISUSE;
    }
    if (!set_area(encoder)) {
        return RHW_ERROR_MISUSE;
    }
    target->tiles_x = (target->width + RHW_TILE - 1) / RHW_TILE;
    target->tiles_y = (target->height + RHW_TILE - 1) / RHW_TILE;
    for (int i = 0; i < RHW_MAX_VIEWPORTS; i++) {
        encoder->viewports[i] =
            (struct rhw_viewport){0, 0, (float)target->width, (float)target->height, 0, 1};
        encoder->scissors[i] = (struct rhw_rect){0, 0, target->width, target->height};
    }
    encoder->pending.viewport = encoder->viewports[0];
    encoder->pending.scissor = encoder->scissors[0];
    encoder->pending.depth_setting.bounds_most = 1;
    begin_recording(context, def);
    if (context->validation && def->depth.texture.index != 0 && !def->depth.enabled) {
        rhw_context_log(context, RHW_LOG_WARNING, "%s: depth.texture is set and depth.enabled is false",
                        where);
    }
    *id = (rhw_pass){1, context->recording.generation, context->pass_number};
    return RHW_OK;
}

enum rhw_result rhw_pass_begin(rhw_context *context, const struct rhw_pass_def *def, rhw_pass *id)
{
    if (!rhw_context_enter_any(context, where)) {
        return RHW_ERROR_MISUSE;
    }
    // While a pass is being recorded, `id` may be its only name: it is kept, because that pass has to end.
    if (id != NULL && !context->recording.active) {
        *id = (rhw_pass){0};
    }
    context->definition = def != NULL ? def->label : NULL;
    const enum rhw_result result = begin(context, def, id);
    context->definition = NULL;
    rhw_context_leave(context);
    return result;
}
