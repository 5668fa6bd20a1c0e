// SPDX-License-Identifier: MIT
// Recording: the constant that blend factors name.
#include <string.h>

#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "enter.h"
#include "pass_state.h"
#include "rhw/rhw.h"

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
