// SPDX-License-Identifier: MIT
// Which bytes of which buffers the pass being recorded reads and writes. Nothing says whether reading or writing would
// come first, so no byte is both read and written. Reading and writing of one buffer go together where their bytes are
// different ones (Vulkan 1.3, "Synchronization and Cache Control", calls it a hazard otherwise; WebGPU, "usage scope").
#ifndef RHW_BUFFER_USE_H
#define RHW_BUFFER_USE_H

#include <stdbool.h>
#include <stddef.h>

#include "buffer.h"
#include "rhw/types.h"

struct rhw_arena;
struct rhw_context;

// A part is the bytes from `first` to below `end` of a live buffer, for one use.
struct rhw_buffer_part {
    rhw_buffer id;
    struct rhw_buffer_data *data;
    enum rhw_buffer_use use;
    size_t first, end;
};

// Return the ranges of a use in the pass being recorded. Return NULL if there are none.
struct rhw_range_set *rhw_buffer_ranges(const struct rhw_context *context, struct rhw_buffer_data *data,
                                        enum rhw_buffer_use use);

// Report a part that shares bytes with another part of its buffer, `first` to `end`, which is for the use `use`.
bool rhw_buffer_check_apart(const struct rhw_context *context, const struct rhw_buffer_part *part,
                            enum rhw_buffer_use use, size_t first, size_t end, const char *where);

// Report bytes that the pass being recorded has the use `use` for.
bool rhw_buffer_check_unused(const struct rhw_context *context, const struct rhw_buffer_part *part,
                             enum rhw_buffer_use use, const char *where);

// Return true if the pass being recorded reads some of the bytes, as vertices or in read-only slots that were set.
// Commands have been read already.
bool rhw_buffer_is_read(const struct rhw_context *context, const struct rhw_buffer_part *part);

// Return true if the pass being recorded may write some of the buffer.
bool rhw_buffer_is_written(const struct rhw_context *context, struct rhw_buffer_data *data);

// Report bytes that the pass has another use for, which does not go with the part's use.
bool rhw_buffer_check_use(const struct rhw_context *context, const struct rhw_buffer_part *part,
                          const char *where);

// Note that the pass uses the bytes. Return the range that they are in. The range of transform feedback is its own, and
// may become shorter. Return NULL when out of memory.
struct rhw_range *rhw_buffer_note_use(struct rhw_context *context, struct rhw_arena *arena,
                                      const struct rhw_buffer_part *part);

#endif
