// SPDX-License-Identifier: MIT
// Recording: what a pass sets of depth and stencil.
#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "enter.h"
#include "encoder.h"
#include "rhw/rhw.h"

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
