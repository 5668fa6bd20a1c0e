// SPDX-License-Identifier: MIT
// The room for draws is kept from pass to pass, so that a warm frame allocates nothing.
#include "draw_list.h"

#include <string.h>

#include "base/constants.h"
#include "base/memory.h"

// Double the room for blocks. Return false when out of memory.
static bool grow(struct rhw_memory *memory, struct rhw_draw_list *list)
{
    const uint32_t capacity = list->block_capacity == 0 ? 16 : 2 * list->block_capacity;
    struct rhw_draw **const blocks = rhw_memory_allocate(memory, capacity * sizeof *blocks, RHW_CACHE_LINE);
    if (!blocks) {
        return false;
    }
    if (list->blocks) {
        memcpy(blocks, list->blocks, list->block_count * sizeof *blocks);
        rhw_memory_release(memory, list->blocks, list->block_capacity * sizeof *blocks);
    }
    list->blocks = blocks;
    list->block_capacity = capacity;
    return true;
}

struct rhw_draw *rhw_draw_list_grow(struct rhw_memory *memory, struct rhw_draw_list *list)
{
    const uint32_t block = list->count / RHW_DRAW_BLOCK;
    if (block == list->block_capacity && !grow(memory, list)) {
        return NULL;
    }
    if (block == list->block_count) {
        list->blocks[block] =
            rhw_memory_allocate(memory, RHW_DRAW_BLOCK * sizeof(struct rhw_draw), RHW_CACHE_LINE);
        if (!list->blocks[block]) {
            return NULL;
        }
        list->block_count++;
    }
    return rhw_draw_list_at(list, list->count);
}

void rhw_draw_list_destroy(struct rhw_memory *memory, struct rhw_draw_list *list)
{
    for (uint32_t i = 0; i < list->block_count; i++) {
        rhw_memory_release(memory, list->blocks[i], RHW_DRAW_BLOCK * sizeof(struct rhw_draw));
    }
    rhw_memory_release(memory, list->blocks, list->block_capacity * sizeof *list->blocks);
    *list = (struct rhw_draw_list){0};
}
