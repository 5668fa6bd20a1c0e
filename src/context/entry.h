// SPDX-License-Identifier: MIT
// The door of a context. Every public function that works with a context enters and leaves it. A second thread, or a
// shader function that calls the library, is refused here, and does not meet a state between two others.
#ifndef RHW_ENTRY_H
#define RHW_ENTRY_H

#include "context.h"

// Report that `context` is NULL, or that a call is under way in it. These are the slow paths; they return false.
bool rhw_context_refuse(const rhw_context *context, const char *where);

// Enter the context; the caller leaves it in the end. Report misuse of `where` and return false when the context is
// NULL or a call is under way in it.
static inline bool rhw_context_enter(rhw_context *context, const char *where)
{
    const char *nobody = NULL;
    return (context != NULL &&
            atomic_compare_exchange_strong_explicit(&context->entered, &nobody, where, memory_order_acquire,
                                                    memory_order_relaxed)) ||
           rhw_context_refuse(context, where);
}

// Enter the context, which may be a recorder, as rhw_context_enter does. It is for functions that recorders have.
static inline bool rhw_context_enter_any(rhw_context *context, const char *where)
{
    const char *nobody = context ? context->idle : NULL;
    return (context != NULL &&
            atomic_compare_exchange_strong_explicit(&context->entered, &nobody, where, memory_order_acquire,
                                                    memory_order_relaxed)) ||
           rhw_context_refuse(context, where);
}

static inline void rhw_context_leave(rhw_context *context)
{
    atomic_store_explicit(&context->entered, context->idle, memory_order_release);
}

// Return true if a function may look at the context, which needs no leaving. Report misuse of `where` and return false
// when the context is NULL or a call is under way in it.
static inline bool rhw_context_peek(const rhw_context *context, const char *where)
{
    return (context != NULL && atomic_load_explicit(&context->entered, memory_order_acquire) == NULL) ||
           rhw_context_refuse(context, where);
}

#endif
