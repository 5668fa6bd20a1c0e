// SPDX-License-Identifier: MIT
// The rules that a dispatch keeps, beside those of what it sets in slots.
#ifndef RHW_DISPATCH_CHECK_H
#define RHW_DISPATCH_CHECK_H

#include "rhw/dispatch.h"

// Return true if the definition's program and uniforms keep the rules. Report misuse of `where` and return false if
// not.
bool rhw_dispatch_check(const struct rhw_context *context, const struct rhw_dispatch_def *def, uint32_t flaws,
                        const char *where);

// Return true if a dispatch can have these numbers of workgroups. Report misuse of `where` and return false if not.
bool rhw_dispatch_check_counts(const struct rhw_context *context, const struct rhw_dispatch_def *def,
                               const struct rhw_dispatch_command *counts, const char *where);

#endif
