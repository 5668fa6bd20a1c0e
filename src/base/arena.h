// SPDX-License-Identifier: MIT
// An arena holds memory that lives until the frame ends: a pointer moves up through chunks. Chunks come from the
// allocation hooks and stay on reset, until one is too small and a larger one takes its place, so that a warm frame
// allocates nothing. Every thread has an arena of its own.
#ifndef RHW_ARENA_H
#define RHW_ARENA_H

#include <stddef.h>
#include <stdint.h>

struct rhw_memory;
struct rhw_arena_chunk;

struct rhw_arena {
    // The next free byte. It is aligned to a cache line, so that arenas in an array do not share one.
    _Alignas(64) unsigned char *cursor;
    unsigned char *end; // end of the current chunk
    struct rhw_arena_chunk *first, *current;
    // Bytes that were handed out since the reset from the chunks before the current one.
    size_t used_before;
    struct rhw_memory *memory;
};

// Make an empty arena. This allocates nothing.
void rhw_arena_init(struct rhw_arena *arena, struct rhw_memory *memory);
// Release every chunk.
void rhw_arena_destroy(struct rhw_arena *arena);
// Forget everything that was handed out, and keep the chunks.
void rhw_arena_reset(struct rhw_arena *arena);
// Return the number of bytes that were handed out since the reset, gaps included.
size_t rhw_arena_used(const struct rhw_arena *arena);

// Take the slow path of rhw_arena_alloc: use the next chunk, or a new one in its place where it is too small.
void *rhw_arena_grow(struct rhw_arena *arena, size_t size, size_t align);

// Return `size` undefined bytes aligned to `align`, a power of two of at most 4096. Return NULL when out of memory.
static inline void *rhw_arena_alloc(struct rhw_arena *arena, size_t size, size_t align)
{
    const uintptr_t start = ((uintptr_t)arena->cursor + (align - 1)) & ~(uintptr_t)(align - 1);
    if (start <= (uintptr_t)arena->end && size <= (uintptr_t)arena->end - start) {
        unsigned char *const memory = arena->cursor + (start - (uintptr_t)arena->cursor);
        arena->cursor = memory + size;
        return memory;
    }
    return rhw_arena_grow(arena, size, align);
}

// Take back what lies behind `end`, which points into or just past the last thing that was handed out.
static inline void rhw_arena_trim(struct rhw_arena *arena, void *end)
{
    arena->cursor = end;
}

#endif
