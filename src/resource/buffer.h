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

// Zero bytes that can be read behind the end of a buffer of the library's: a kernel may load whole vectors at the last
// byte. Buffers on memory of the program have none.
enum { RHW_BUFFER_PADDING = 64 };

// What a pass does with bytes of a buffer (buffer_use.h).
enum rhw_buffer_use {
    // Bytes are read as vertices, indices and commands, or by shader functions that cannot write them.
    RHW_BUFFER_READ,
    RHW_BUFFER_STORED,   // written by shader functions
    RHW_BUFFER_CAPTURED, // written by transform feedback
    RHW_BUFFER_USES,

    RHW_BUFFER_WRITTEN = RHW_BUFFER_USES // written by the program, between draws
};

// The bytes of a buffer that one use has, in the last pass that had the use.
struct rhw_used_bytes {
    uint32_t pass; // generation of the pass
    struct rhw_range_set ranges;
};

struct rhw_buffer_data {
    unsigned char *bytes; // aligned to a cache line
    size_t size;          // what the user gave, without padding
    // The pass in which the buffer was last written between draws, and the number of draws that were recorded before
    // and read other memory since.
    uint32_t renewed_pass, renewed_draws;
    uint32_t bound_pass; // generation of the last pass in which the buffer was in a read-only slot
    uint32_t moves;      // times that the buffer got other memory
    uint32_t writes;     // times that something may have written the bytes
    bool is_callers;     // `bytes` is the program's memory
    bool is_bound;       // a binding in memory of the program points at `bytes`, which stay there
    bool has_stores;     // shader functions may write the bytes through a binding, in any pass
    // See rhw_buffer_map. The second is true where the buffer is mapped for more than reading.
    bool is_mapped, is_map_written;
    size_t map_first, map_end; // the bytes that are mapped
    struct rhw_used_bytes used[RHW_BUFFER_USES];
};

// Release what the item owns.
void rhw_buffer_data_release(struct rhw_memory *memory, struct rhw_buffer_data *data);

// Report bytes that the buffer does not have.
bool rhw_buffer_check_range(const struct rhw_context *context, rhw_buffer buffer,
                            const struct rhw_buffer_data *data, size_t offset, size_t size,
                            const char *where);

// Return bytes and padding, zeroed, or undefined when something will be copied there. Return NULL when out of memory.
unsigned char *rhw_buffer_allocate(struct rhw_memory *memory, size_t size, bool zeroed);

#endif
