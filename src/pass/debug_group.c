// SPDX-License-Identifier: MIT
// Debug groups hold draws of a pass, and messages name them.
#include "context/context.h"
#include "context/entry.h"
#include "context/misuse.h"
#include "encoder.h"
#include "rhw/rhw.h"

void rhw_pass_push_debug_group(rhw_context *context, rhw_pass id, const char *label)
{
    static const char *const where = "rhw_pass_push_debug_group";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    if (rhw_check(context, label != NULL, "%s: label is NULL", where)) {
        struct rhw_debug_group *const group =
            rhw_arena_alloc(&encoder->pass->arena, sizeof *group, _Alignof(void *));
        if (group) {
            group->outer = context->recording.group;
            rhw_label_copy(group->label, label);
            context->recording.group = group;
        }
        encoder->out_of_memory |= !group;
    }
    rhw_context_leave(context);
}

void rhw_pass_pop_debug_group(rhw_context *context, rhw_pass id)
{
    static const char *const where = "rhw_pass_pop_debug_group";
    struct rhw_encoder *const encoder = rhw_pass_enter(context, id, where);
    if (!encoder) {
        return;
    }
    const struct rhw_debug_group *const group = context->recording.group;
    if (encoder->out_of_memory || rhw_check(context, group != NULL, "%s: no group was pushed", where)) {
        context->recording.group = group ? group->outer : NULL;
    }
    rhw_context_leave(context);
}
