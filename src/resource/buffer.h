// SPDX-License-Identifier: MIT
// Buffers: bytes that draws read, and that shader functions and transform feedback write.
#ifndef RHW_BUFFER_H
#define RHW_BUFFER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/range_set.h"
#include "rhw/types.h"

struct rhw_context;
struct rhw_memory;

// Readable zero bytes after the end of every buffer: a kernel may load whole vectors at the last byte.
enum { RHW_BUFFER_PADDING = 64 };

// What a pass does with bytes of a buffer (buffer_use.h).
enum rhw_buffer_use {
    RHW_BUFFER_READ,     // as vertices, indices, commands, or by shader functions that cannot write it
    RHW_BUFFER_STORED,   // by shader functions
    RHW_BUFFER_CAPTURED, // by transform feedback
    RHW_BUFFER_USES,

    RHW_BUFFER_WRITTEN = RHW_BUFFER_USES // by the program, between draws
};

// The bytes that one use has of a buffer, in the last pass that had it.
struct rhw_used_bytes {
    uint32_t pass; // by generation
    struct rhw_range_set ranges;
};

struct rhw_buffer_data {
    unsigned char *bytes; // aligned to a cache line
    size_t size;          // as the user gave it, without padding
    // The pass in which it last got other memory, and the draws that were recorded before and read the old one.
    uint32_t renewed_pass, renewed_draws;
    bool is_callers;                // `bytes` is the program's memory
    bool is_mapped, is_map_written; // see rhw_buffer_map; the second: not for reading alone
    size_t map_first, map_end;      // the bytes that are
    struct rhw_used_bytes used[RHW_BUFFER_USES];
};

// Releases what the item owns.
void rhw_buffer_data_release(struct rhw_memory *memory, struct rhw_buffer_data *data);

// Reports bytes that the buffer does not have.
bool rhw_buffer_check_range(const struct rhw_context *context, rhw_buffer buffer,
                            const struct rhw_buffer_data *data, size_t offset, size_t size,
                            const char *where);

// Bytes and padding, zeroed, or undefined when something will be copied there; NULL when out of memory.
unsigned char *rhw_buffer_allocate(struct rhw_memory *memory, size_t size, bool zeroed);

#endif
