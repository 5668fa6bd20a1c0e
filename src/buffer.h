// SPDX-License-Identifier: MIT
// Storage of vertices and indices.
#ifndef RHW_BUFFER_H
#define RHW_BUFFER_H

#include <stddef.h>
#include <stdint.h>

struct rhw_memory;

// Readable zero bytes after the end of every buffer: a kernel may load whole vectors at the last byte.
enum { RHW_BUFFER_PADDING = 64 };

struct rhw_buffer_data {
    unsigned char *bytes; // aligned to a cache line
    size_t size;          // as the user gave it, without padding
    // The pass in which it last got other memory, and the draws that were recorded before and read the old one.
    uint32_t renewed_pass, renewed_draws;
    // The last passes that have it as a storage buffer, and that read it as vertices or indices, by generation.
    uint32_t stored_pass, fetched_pass;
    uint32_t captured_pass; // the last that writes it by transform feedback
};

// Releases what the item owns.
void rhw_buffer_data_release(struct rhw_memory *memory, struct rhw_buffer_data *data);

#endif
