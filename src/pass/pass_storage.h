// SPDX-License-Identifier: MIT
// What a pass sets of storage.
#ifndef RHW_PASS_STORAGE_H
#define RHW_PASS_STORAGE_H

#include "rhw/types.h"

struct rhw_encoder;
struct rhw_storage;

// The storage of the next draw, as its buffers are now; NULL when out of memory.
const struct rhw_storage *rhw_pass_storage_of(struct rhw_encoder *encoder);

#endif
