// SPDX-License-Identifier: MIT
#include "given_up.h"

#include "base/scheduler.h"
#include "base/thread.h"

// A look at the clock costs as much as one group of a simple function. So as long as looks come soon one after the
// other, twice as many groups lie between the next two, up to this many. Functions that take long are looked at in each
// call.
enum { GROUPS_MOST = 64 };
static const uint64_t long_ns = 1000000, least_ns = 10000000;

void rhw_context_begin_work(struct rhw_context *context)
{
    atomic_store(&context->given_up, false);
    context->looked_ns = context->asked_ns = context->goes_on ? rhw_time_ns() : 0;
}

bool rhw_context_is_given_up(struct rhw_context *context, int worker)
{
    if (!context->goes_on) {
        return false;
    }
    if (atomic_load_explicit(&context->given_up, memory_order_relaxed)) {
        return true;
    }
    if (worker != 0) {
        return false;
    }
    context->groups_to_look = context->look_groups = 0;
    const bool given_up = !context->goes_on(context->goes_on_user);
    if (given_up) {
        atomic_store_explicit(&context->given_up, true, memory_order_relaxed);
    }
    return given_up;
}

bool rhw_context_is_given_up_within(struct rhw_context *context)
{
    if (!context->goes_on) {
        return false;
    }
    const int worker = rhw_scheduler_is_caller(context->scheduler) ? 0 : 1;
    return rhw_context_is_given_up_amid(context, worker, GROUPS_MOST);
}

bool rhw_context_is_given_up_amid(struct rhw_context *context, int worker, int groups)
{
    if (atomic_load_explicit(&context->given_up, memory_order_relaxed)) {
        return true;
    }
    if (worker != 0 || (context->groups_to_look -= groups) > 0) {
        return false;
    }
    const uint64_t now = rhw_time_ns();
    const bool is_quick = now - context->looked_ns < long_ns;
    const int twice = 2 * context->look_groups + 1, more = twice < GROUPS_MOST ? twice : GROUPS_MOST;
    context->looked_ns = now;
    if (now - context->asked_ns >= least_ns) {
        context->asked_ns = now;
        return rhw_context_is_given_up(context, 0);
    }
    context->groups_to_look = context->look_groups = is_quick ? more : 0;
    return false;
}
