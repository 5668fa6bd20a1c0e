// SPDX-License-Identifier: MIT
#include "line_stipple.h"

#include "context/misuse.h"

bool rhw_check_line_stipple(const struct rhw_context *context, const struct rhw_line_stipple *stipple,
                            const char *where)
{
    return rhw_check(context, stipple->factor >= 0 && stipple->factor <= RHW_MAX_LINE_STIPPLE_FACTOR,
                     "%s: line_stipple.factor is %d; it must be 1..%d, or 0 for no stipple", where,
                     stipple->factor, RHW_MAX_LINE_STIPPLE_FACTOR);
}
