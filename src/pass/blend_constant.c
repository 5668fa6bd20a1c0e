// SPDX-License-Identifier: MIT
// Recording: the constant that blend factors name.
#include <string.h>

#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "enter.h"
#include "encoder.h"
#include "rhw/rhw.h"

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
