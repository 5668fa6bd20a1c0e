// SPDX-License-Identifier: MIT
// Arenas grow by chunks. Each new chunk is twice as large as the last, up to a limit, so that a small frame costs
// little and a large frame makes few calls.
#include "arena.h"

#include "constants.h"
#include "memory.h"

enum {
    FIRST_CHUNK = 64 << 10, // bytes
    // Bytes. The limit is a whole number of huge pages. A larger request gets a chunk of its own.
    LARGEST_CHUNK = 8 << 20
};

// The header fills a cache line, so that the bytes behind it are aligned as the chunk is.
struct rhw_arena_chunk {
    _Alignas(RHW_CACHE_LINE) struct rhw_arena_chunk *next;
    size_t size; // bytes, this header included
};

static unsigned char *chunk_bytes(struct rhw_arena_chunk *chunk)
{
    return (unsigned char *)(chunk + 1);
}

// Leave the arena without a chunk: its range is empty and not NULL, so that 0 bytes can be handed out.
static void use_nothing(struct rhw_arena *arena)
{
    arena->current = NULL;
    arena->cursor = (unsigned char *)arena;
    arena->end = arena->cursor;
}

static void use_chunk(struct rhw_arena *arena, struct rhw_arena_chunk *chunk)
{
    arena->current = chunk;
    arena->cursor = chunk_bytes(chunk);
    arena->end = (unsigned char *)chunk + chunk->size;
}

void rhw_arena_init(struct rhw_arena *arena, struct rhw_memory *memory)
{
    *arena = (struct rhw_arena){.memory = memory};
    use_nothing(arena);
}

void rhw_arena_destroy(struct rhw_arena *arena)
{
    struct rhw_arena_chunk *chunk = arena->first;
    while (chunk != NULL) {
        struct rhw_arena_chunk *const next = chunk->next;
        rhw_memory_release(arena->memory, chunk, chunk->size);
        chunk = next;
    }
    rhw_arena_init(arena, arena->memory);
}

void rhw_arena_reset(struct rhw_arena *arena)
{
    arena->used_before = 0;
    if (arena->first != NULL) {
        use_chunk(arena, arena->first);
    }
}

size_t rhw_arena_used(const struct rhw_arena *arena)
{
    if (arena->current == NULL) {
        return 0;
    }
    return arena->used_before + (size_t)(arena->cursor - chunk_bytes(arena->current));
}

// Return a new chunk that holds `need` bytes behind its header. Return NULL when out of memory.
static struct rhw_arena_chunk *create_chunk(struct rhw_arena *arena, size_t need)
{
    if (need > SIZE_MAX - sizeof(struct rhw_arena_chunk)) {
        return NULL;
    }
    size_t size = FIRST_CHUNK;
    if (arena->current != NULL) {
        size = arena->current->size < LARGEST_CHUNK / 2 ? arena->current->size * 2 : LARGEST_CHUNK;
    }
    if (size < need + sizeof(struct rhw_arena_chunk)) {
        size = need + sizeof(struct rhw_arena_chunk);
    }
    struct rhw_arena_chunk *const chunk = rhw_memory_allocate(arena->memory, size, RHW_CACHE_LINE);
    if (chunk == NULL) {
        return NULL;
    }
    *chunk = (struct rhw_arena_chunk){.size = size};
    return chunk;
}

void *rhw_arena_grow(struct rhw_arena *arena, size_t size, size_t align)
{
    if (size > SIZE_MAX - align) {
        return NULL;
    }
    // The gap depends on where the chunk starts; this size always suffices.
    const size_t need = size + align;
    struct rhw_arena_chunk *const old = arena->current;
    const size_t used = rhw_arena_used(arena);

    // Take the next chunk of an earlier frame if it is large enough. If it is not, a new chunk takes its place, so that
    // requests which grow from frame to frame do not leave a chunk of every size behind.
    struct rhw_arena_chunk *chunk = old != NULL ? old->next : arena->first;
    if (chunk == NULL || chunk->size - sizeof *chunk < need) {
        struct rhw_arena_chunk *const created = create_chunk(arena, need);
        if (created == NULL) {
            return NULL;
        }
        if (chunk != NULL) {
            created->next = chunk->next;
            rhw_memory_release(arena->memory, chunk, chunk->size);
        }
        if (old != NULL) {
            old->next = created;
        } else {
            arena->first = created;
        }
        chunk = created;
    }
    use_chunk(arena, chunk);
    arena->used_before = used;
    return rhw_arena_alloc(arena, size, align);
}
