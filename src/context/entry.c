// SPDX-License-Identifier: MIT
// What a call is told when it finds its context in use.
#include "entry.h"

#include "misuse.h"
#include "base/scheduler.h"

bool rhw_context_refuse(const rhw_context *context, const char *where)
{
    if (context == NULL) {
        return rhw_check(NULL, false, "%s: context is NULL", where);
    }
    // Functions that only look are refused, too.
    atomic_store_explicit(&((rhw_context *)context)->refused, true, memory_order_relaxed);
    if (rhw_scheduler_runs_here(context->scheduler)) {
        rhw_misuse_outside(context,
                           "%s: called by a function that the library called, such as a shader function; it "
                           "must not use the context",
                           where);
        return false;
    }
    if (context->owner && atomic_load_explicit(&context->entered, memory_order_relaxed) == context->idle) {
        rhw_misuse_outside(context,
                           "%s: the context is a recorder, which records passes alone; call the "
                           "function with the context that it was created for",
                           where);
        return false;
    }
    const char *const other = atomic_load_explicit(&context->entered, memory_order_relaxed);
    rhw_misuse_outside(
        context, "%s: called while %s is under way in this context; one thread at a time may use a context",
        where, other != NULL ? other : "another call");
    return false;
}
