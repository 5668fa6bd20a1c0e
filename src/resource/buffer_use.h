// SPDX-License-Identifier: MIT
// Which bytes of which buffers the pass being recorded reads and writes. Nothing says what would come first, so none
// are both: reading and writing of one buffer go together where they are of other bytes (Vulkan 1.3, "Synchronization
// and Cache Control": else each is a hazard; WebGPU, "usage scope").
#ifndef RHW_BUFFER_USE_H
#define RHW_BUFFER_USE_H

#include <stdbool.h>
#include <stddef.h>

#include "buffer.h"
#include "rhw/types.h"

struct rhw_arena;
struct rhw_context;

// Bytes `first` to `end` of a live buffer, for one use.
struct rhw_buffer_part {
    rhw_buffer id;
    struct rhw_buffer_data *data;
    enum rhw_buffer_use use;
    size_t first, end;
};

// Reports a part that shares bytes with another of the same buffer, `first` to `end`, which has that use.
bool rhw_buffer_check_apart(const struct rhw_context *context, const struct rhw_buffer_part *part,
                            enum rhw_buffer_use use, size_t first, size_t end, const char *where);

// Reports bytes that the pass being recorded has that use for.
bool rhw_buffer_check_unused(const struct rhw_context *context, const struct rhw_buffer_part *part,
                             enum rhw_buffer_use use, const char *where);

// Whether the pass being recorded reads some of the bytes, by vertices and in read-only slots that were set. Commands
// were read already.
bool rhw_buffer_is_read(const struct rhw_context *context, const struct rhw_buffer_part *part);

// Whether the pass being recorded may write some of the buffer.
bool rhw_buffer_is_written(const struct rhw_context *context, const struct rhw_buffer_data *data);

// Reports bytes that the pass has another use for, which does not go with this one.
bool rhw_buffer_check_use(const struct rhw_context *context, const struct rhw_buffer_part *part,
                          const char *where);

// Notes that the pass uses them. Gives the range that they are in: that of transform feedback is its own, and may
// become shorter. NULL when out of memory.
struct rhw_range *rhw_buffer_note_use(struct rhw_context *context, struct rhw_arena *arena,
                                      const struct rhw_buffer_part *part);

#endif
