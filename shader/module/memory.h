// SPDX-License-Identifier: MIT
// Memory of one translation: blocks that are given back together, a bound on all of them, and the place where
// translation ends when a rule is broken or memory is short.
#ifndef SHADER_MEMORY_H
#define SHADER_MEMORY_H

#include <setjmp.h>
#include <stdbool.h>
#include <stddef.h>

enum { SHADER_MESSAGE = 256 };

struct shader_memory {
    struct shader_block *blocks;
    size_t bound, left; // bytes that may be taken, and that still may
    bool is_short;      // the machine has no memory
    jmp_buf end;        // where shader_memory_end goes
    char message[SHADER_MESSAGE];
};

void shader_memory_init(struct shader_memory *memory, size_t bound);
void shader_memory_free(struct shader_memory *memory);
// Return zeroed memory, or end the translation where the machine has none or the bound is reached.
void *shader_take(struct shader_memory *memory, size_t count, size_t size);
// Return a larger copy of an array of `*room` elements, and set `*room`.
void *shader_grow(struct shader_memory *memory, const void *array, size_t *room, size_t size);
_Noreturn void shader_memory_end(struct shader_memory *memory);

#endif
