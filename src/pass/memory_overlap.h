// SPDX-License-Identifier: MIT
// Which bytes of memory the pass being recorded reads and writes, by address, so that memory of the program that is set
// as input and as output is found. Buffers know their own bytes without it (resource/buffer_use.h). It costs a look-up
// for everything that is set, so a context that does not validate keeps nothing here.
#ifndef RHW_MEMORY_OVERLAP_H
#define RHW_MEMORY_OVERLAP_H

#include <stdbool.h>
#include <stddef.h>

#include "base/range_set.h"

struct rhw_context;
struct rhw_mip;
struct rhw_recorded_pass;

// The ranges count from address 0. Ranges of one set may be united, but for those of transform feedback.
struct rhw_used_memory {
    const struct rhw_context *context;
    struct rhw_recorded_pass *pass; // what it draws into, and the memory of the sets
    bool *out_of_memory;            // set where something could not be noted
    struct rhw_range_set
        read; // as vertices, indices and uniforms, and by shader functions that cannot write them
    struct rhw_range_set stored, captured; // written by shader functions, and by transform feedback
};

// Note bytes that draws read. Report misuse and return false where the pass writes some of them.
bool rhw_memory_note_read(struct rhw_used_memory *used, const void *bytes, size_t size, const char *where);
// Note bytes that shader functions write. Report misuse and return false where the pass uses some of them otherwise.
bool rhw_memory_note_stored(struct rhw_used_memory *used, const void *bytes, size_t size, const char *where);
// Note the texels of a level, `texel_size` bytes each, that shader functions write. See rhw_memory_note_stored.
bool rhw_memory_note_stored_level(struct rhw_used_memory *used, const struct rhw_mip *mip, size_t texel_size,
                                  const char *where);
// Note bytes that transform feedback writes, as `*range`, which may become shorter. Report misuse and return false
// where the pass uses some of them already.
bool rhw_memory_note_captured(struct rhw_used_memory *used, const void *bytes, size_t size, const char *where,
                              struct rhw_range **range);

#endif
