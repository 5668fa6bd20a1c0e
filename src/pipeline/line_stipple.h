// SPDX-License-Identifier: MIT
// The stipple of lines: its rule, and what a pass sets in the place of the pipelines' own.
#ifndef RHW_LINE_STIPPLE_H
#define RHW_LINE_STIPPLE_H

#include <stdbool.h>

#include "rhw/types.h"

struct rhw_context;

// What the pass sets.
struct rhw_line_stipple_setting {
    bool is_set;
    struct rhw_line_stipple stipple;
};

// Return true if the stipple's factor is valid. Report misuse of the public function `where` and return false if not.
bool rhw_check_line_stipple(const struct rhw_context *context, const struct rhw_line_stipple *stipple,
                            const char *where);

#endif
