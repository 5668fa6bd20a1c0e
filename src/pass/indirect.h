// SPDX-License-Identifier: MIT
// Parameters that stand in buffers.
#ifndef RHW_INDIRECT_H
#define RHW_INDIRECT_H

#include <stdint.h>

#include "rhw/types.h"

// Return the bytes at an offset of a buffer, `size` of which are read. `name` stands before the word offset in
// messages. Report misuse and return NULL where the bytes cannot be read.
const unsigned char *rhw_indirect_bytes(const rhw_context *context, rhw_buffer id, size_t offset,
                                        uint64_t size, const char *name, const char *where);

#endif
