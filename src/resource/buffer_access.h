// SPDX-License-Identifier: MIT
// Who may touch a buffer's bytes between draws. Bytes that a pass writes may be touched when it has ended. Bytes that
// recorded draws read stay as they are, so that a buffer in which they are written gets new memory. Mapped bytes are
// the program's. All other bytes are free.
#ifndef RHW_BUFFER_ACCESS_H
#define RHW_BUFFER_ACCESS_H

#include "buffer_use.h"

// Report bytes that are to be read and are not known before the pass being recorded has ended.
bool rhw_buffer_check_readable(const struct rhw_context *context, const struct rhw_buffer_part *part,
                               const char *where);

// Report bytes that are mapped. A part that is read may be mapped for reading.
bool rhw_buffer_check_unmapped(const struct rhw_context *context, const struct rhw_buffer_part *part,
                               const char *where);

// Report bytes that the program may not write now. Of a mapped buffer they are the bytes that the pass being recorded
// writes, and the bytes that its draws read where the buffer has to stay where it is.
bool rhw_buffer_check_writable(const struct rhw_context *context, const struct rhw_buffer_part *part,
                               const char *where);

// Make the live buffer one in which the bytes can be written now: draws that were recorded keep what it holds.
// `written` of the bytes will be written, all or some. Return false when out of memory.
bool rhw_buffer_to_write(struct rhw_context *context, const struct rhw_buffer_part *part, size_t written);

#endif
