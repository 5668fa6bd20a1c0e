// SPDX-License-Identifier: MIT
// Who may touch a buffer's bytes between draws: what a pass writes waits for its end, what recorded draws read stays as
// it is, so that a buffer in which that is written gets new memory, and what is mapped is the program's. Bytes beside
// those are free.
#ifndef RHW_BUFFER_ACCESS_H
#define RHW_BUFFER_ACCESS_H

#include "buffer_use.h"

// Reports bytes to be read that are not known before the pass being recorded has ended.
bool rhw_buffer_check_readable(const struct rhw_context *context, const struct rhw_buffer_part *part,
                               const char *where);

// Reports bytes that are mapped. A part that is read may be mapped for reading.
bool rhw_buffer_check_unmapped(const struct rhw_context *context, const struct rhw_buffer_part *part,
                               const char *where);

// Reports bytes that the program may not write now: of a mapped buffer, those that the pass being recorded writes, and
// those that its draws read where the buffer has to stay where it is.
bool rhw_buffer_check_writable(const struct rhw_context *context, const struct rhw_buffer_part *part,
                               const char *where);

// Makes the live buffer one in which the bytes are written now: draws that were recorded keep what it holds. `written`
// of them will be, all or some. False when out of memory.
bool rhw_buffer_to_write(struct rhw_context *context, const struct rhw_buffer_part *part, size_t written);

#endif
