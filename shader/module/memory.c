// SPDX-License-Identifier: MIT
// See memory.h.
#include "memory.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK_SIZE = 1 << 16, ALIGNMENT = 16 };

struct shader_block {
    struct shader_block *next;
    size_t used, size;
    _Alignas(ALIGNMENT) unsigned char bytes[];
};

void shader_memory_init(struct shader_memory *memory, size_t bound)
{
    memory->blocks = NULL;
    memory->bound = memory->left = bound;
    memory->is_short = false;
    memory->message[0] = '\0';
}

void shader_memory_free(struct shader_memory *memory)
{
    while (memory->blocks) {
        struct shader_block *const next = memory->blocks->next;
        free(memory->blocks);
        memory->blocks = next;
    }
}

void shader_memory_end(struct shader_memory *memory)
{
    longjmp(memory->end, 1);
}

static _Noreturn void end_at_bound(struct shader_memory *memory)
{
    snprintf(memory->message, sizeof memory->message, "the translation takes more than %zu bytes of memory",
             memory->bound);
    shader_memory_end(memory);
}

static struct shader_block *add_block(struct shader_memory *memory, size_t least)
{
    const size_t size = least > BLOCK_SIZE ? least : BLOCK_SIZE;
    if (size > memory->left) {
        end_at_bound(memory);
    }
    struct shader_block *const block = calloc((sizeof *block + size + ALIGNMENT - 1) / ALIGNMENT, ALIGNMENT);
    if (!block) {
        memory->is_short = true;
        shader_memory_end(memory);
    }
    memory->left -= size;
    block->size = size;
    block->next = memory->blocks;
    memory->blocks = block;
    return block;
}

void *shader_take(struct shader_memory *memory, size_t count, size_t size)
{
    struct shader_block *block = memory->blocks;
    if (size != 0 && count > (SIZE_MAX / 4) / size) {
        end_at_bound(memory);
    }
    const size_t bytes = (count * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    if (!block || block->size - block->used < bytes) {
        block = add_block(memory, bytes);
    }
    void *const taken = block->bytes + block->used;
    block->used += bytes;
    return taken;
}

void *shader_grow(struct shader_memory *memory, const void *array, size_t *room, size_t size)
{
    const size_t old = *room, more = old ? 2 * old : 16;
    void *const grown = shader_take(memory, more, size);
    if (old) {
        memcpy(grown, array, old * size);
    }
    *room = more;
    return grown;
}
