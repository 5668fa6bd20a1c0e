// SPDX-License-Identifier: MIT
// What stands behind the storage functions of shaders: the buffers of a draw, by slot, for reading and writing.
#ifndef RHW_STORAGE_H
#define RHW_STORAGE_H

#include <stddef.h>
#include <stdint.h>

#include "rhw/types.h"

// Words of 32 bits that shader functions may change on any thread, hence always atomically.
struct rhw_storage_words {
    uint32_t *words; // NULL: nothing is bound
    uint32_t count;
};

// Of a draw.
struct rhw_storage {
    struct rhw_storage_words buffers[RHW_MAX_STORAGE_BUFFERS];
};

// No buffer in any slot.
extern const struct rhw_storage rhw_no_storage;

#endif
