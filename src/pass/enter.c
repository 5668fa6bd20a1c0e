// SPDX-License-Identifier: MIT
// See pass/enter.h.
#include "enter.h"

#include "context/misuse.h"

void rhw_pass_report(const rhw_context *context, rhw_pass id, const char *where)
{
    const bool foreign = id.index != 0 && id.context != context->number;
    rhw_misuse(context, "%s: %s", where,
               foreign ? "the pass belongs to another context" : "the pass id is null or its pass has ended");
}
