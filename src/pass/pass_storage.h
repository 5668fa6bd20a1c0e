// SPDX-License-Identifier: MIT
// The storage that a pass sets becomes part of its draws.
#ifndef RHW_PASS_STORAGE_H
#define RHW_PASS_STORAGE_H

#include "rhw/types.h"

struct rhw_encoder;
struct rhw_storage;

// Return the storage of the next draw, with the bytes that its buffers have now, or NULL when out of memory.
const struct rhw_storage *rhw_pass_storage_of(struct rhw_encoder *encoder);

#endif
