// SPDX-License-Identifier: MIT
#include "given_up.h"

bool rhw_context_is_given_up(struct rhw_context *context, int worker)
{
    if (!context->goes_on) {
        return false;
    }
    if (atomic_load_explicit(&context->given_up, memory_order_relaxed)) {
        return true;
    }
    const bool given_up = worker == 0 && !context->goes_on(context->goes_on_user);
    if (given_up) {
        atomic_store_explicit(&context->given_up, true, memory_order_relaxed);
    }
    return given_up;
}
