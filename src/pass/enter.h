// SPDX-License-Identifier: MIT
// How calls that record reach the pass under way.
#ifndef RHW_PASS_ENTER_H
#define RHW_PASS_ENTER_H

#include "context/context.h"
#include "context/entry.h"

// Reports that an id names no pass under way.
__attribute__((cold)) void rhw_pass_report(const rhw_context *context, rhw_pass id, const char *where);

// Enters the context and gives the pass that `id` names, until rhw_context_leave; or reports misuse, leaves again, and
// gives NULL.
static inline struct rhw_encoder *rhw_pass_enter(rhw_context *context, rhw_pass id, const char *where)
{
    if (!rhw_context_enter(context, where)) {
        return NULL;
    }
    const struct rhw_recording *const recording = &context->recording;
    if (recording->active && id.generation == recording->generation && id.context == context->number) {
        return context->encoder;
    }
    rhw_pass_report(context, id, where);
    rhw_context_leave(context);
    return NULL;
}

#endif
