// SPDX-License-Identifier: MIT
// Making a binding in memory of the program begins and ends here.
#ifndef RHW_BIND_ENTRY_H
#define RHW_BIND_ENTRY_H

#include "binding.h"

struct rhw_context;

// Put what a binding holds into it.
static inline void rhw_binding_put(const struct rhw_binding_data *data, struct rhw_binding *binding)
{
    memset(binding, 0, sizeof *binding);
    memcpy(binding, data, sizeof *data);
}

// Empty the binding and enter the context, to make a binding in it. The caller leaves the context. Report misuse and
// return false where either is NULL or a call is under way.
bool rhw_binding_enter(struct rhw_context *context, struct rhw_binding *binding, const char *where);

#endif
