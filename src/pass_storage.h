// SPDX-License-Identifier: MIT
// What a pass sets of storage.
#ifndef RHW_PASS_STORAGE_H
#define RHW_PASS_STORAGE_H

#include <stdbool.h>

#include "rhw/types.h"

struct rhw_pass_state;
struct rhw_storage;

// The storage of the next draw, as its buffers are now; NULL when out of memory.
const struct rhw_storage *rhw_pass_storage_of(struct rhw_pass_state *pass);

// Notes that the pass reads the live buffer as vertices or indices; misuse, and false, where its shader functions write
// it: nothing says which of them comes first.
bool rhw_pass_fetches(struct rhw_context *context, rhw_buffer id, const char *where);

#endif
