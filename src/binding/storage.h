// SPDX-License-Identifier: MIT
// What stands behind the storage functions of shaders: the buffers and images of a draw, by slot, for reading and
// writing.
#ifndef RHW_STORAGE_H
#define RHW_STORAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rhw/shader_storage.h"
#include "rhw/types.h"

// Words of 32 bits that shader functions may change on any thread, hence always atomically.
struct rhw_storage_words {
    uint32_t *words; // NULL: nothing is bound
    uint32_t count;
    bool is_read_only;
};

struct rhw_texture_data;

// A level of a texture, or a texel buffer in the shape of a texture of one row.
struct rhw_storage_image {
    const struct rhw_texture_data *texture; // NULL: nothing is bound
    int level;
    bool is_read_only;
};

// The storage of a draw.
struct rhw_storage {
    struct rhw_storage_words buffers[RHW_MAX_STORAGE_BUFFERS];
    struct rhw_storage_image images[RHW_MAX_STORAGE_IMAGES];
};

// Storage with no buffer in any slot.
extern const struct rhw_storage rhw_no_storage;

// Do the operation to a word and return what the word was. STORE returns 0.
int32_t rhw_storage_word(uint32_t *word, enum rhw_storage_operation operation, uint32_t value,
                         uint32_t comparand);

#endif
