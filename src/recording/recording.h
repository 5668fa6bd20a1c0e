// SPDX-License-Identifier: MIT
// A recording as data: a recorded pass, what it uses, and the memory that all of it came from.
#ifndef RHW_RECORDING_DATA_H
#define RHW_RECORDING_DATA_H

#include "base/memory.h"
#include "context/use_table.h"
#include "draw/recorded_pass.h"
#include "rhw/recording.h"

struct rhw_clean_part;
struct rhw_kept_triangles;

struct rhw_recording {
    struct rhw_memory memory; // the recording is a block of it, too
    uint32_t number;          // number of its context
    struct rhw_recorded_pass *pass;
    struct rhw_use_table uses;          // in the arena of the pass
    struct rhw_clean_part *clean_parts; // a list, in the arena of the pass
    char label[RHW_LABEL_SIZE];
    struct rhw_kept_triangles *kept; // NULL: each run makes its triangles
    uint64_t writes;                 // to the buffers that it reads, when it made the triangles that are kept
};

// Return a recording without draws for the context of that number, or NULL when out of memory.
struct rhw_recording *rhw_recording_create(struct rhw_allocator allocator, uint32_t number);

#endif
