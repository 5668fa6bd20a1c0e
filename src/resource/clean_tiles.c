// SPDX-License-Identifier: MIT
// A texture keeps a list of records, one for each part of it that passes have drawn into.
#include "clean_tiles.h"

#include <string.h>

#include "base/constants.h"
#include "base/memory.h"

static size_t tiles_along(int pixels)
{
    return ((size_t)pixels + RHW_TILE - 1) / RHW_TILE;
}

static size_t size_of(size_t count)
{
    return sizeof(struct rhw_clean_tiles) + count * sizeof(bool);
}

static struct rhw_clean_tiles *create(struct rhw_memory *memory, int width, int height)
{
    const size_t count = tiles_along(width) * tiles_along(height);
    struct rhw_clean_tiles *const clean = rhw_memory_allocate(memory, size_of(count), RHW_CACHE_LINE);
    if (clean) {
        memset(clean, 0, size_of(count));
        clean->count = count;
    }
    return clean;
}

struct rhw_clean_tiles *rhw_clean_tiles_of_part(struct rhw_memory *memory, struct rhw_clean_tiles **list,
                                                int layer, int level, int width, int height)
{
    for (struct rhw_clean_tiles *clean = *list; clean; clean = clean->next) {
        if (clean->layer == layer && clean->level == level) {
            return clean;
        }
    }
    struct rhw_clean_tiles *const clean = create(memory, width, height);
    if (clean) {
        clean->layer = layer;
        clean->level = level;
        clean->next = *list;
        *list = clean;
    }
    return clean;
}

void rhw_clean_tiles_destroy(struct rhw_memory *memory, struct rhw_clean_tiles *list)
{
    while (list) {
        struct rhw_clean_tiles *const next = list->next;
        rhw_memory_release(memory, list, size_of(list->count));
        list = next;
    }
}

static void forget_layer(struct rhw_clean_tiles *clean)
{
    memset(clean->is_clean, 0, clean->count * sizeof *clean->is_clean);
}

void rhw_clean_tiles_expect(struct rhw_clean_tiles *clean, const unsigned char texels[RHW_CLEAR_BYTES])
{
    if (clean && memcmp(clean->texels, texels, RHW_CLEAR_BYTES) != 0) {
        forget_layer(clean);
        memcpy(clean->texels, texels, RHW_CLEAR_BYTES);
    }
}

void rhw_clean_tiles_forget(struct rhw_clean_tiles *list)
{
    for (; list; list = list->next) {
        forget_layer(list);
    }
}

void rhw_clean_tiles_forget_part(struct rhw_clean_tiles *list, int level, int layer, int layer_count)
{
    for (; list; list = list->next) {
        if (list->level == level && list->layer >= layer && list->layer - layer < layer_count) {
            forget_layer(list);
        }
    }
}
