// SPDX-License-Identifier: MIT
// The workers make triangles in arenas of the one who keeps them, so that nothing is copied but the chunks themselves.
#include "kept_triangles.h"

#include <string.h>

#include "base/memory.h"

static size_t size_of(int threads)
{
    return sizeof(struct rhw_kept_triangles) + (size_t)threads * sizeof(struct rhw_arena);
}

struct rhw_kept_triangles *rhw_kept_triangles_create(struct rhw_memory *memory, int threads)
{
    struct rhw_kept_triangles *const kept = rhw_memory_allocate(memory, size_of(threads), RHW_CACHE_LINE);
    if (kept) {
        *kept = (struct rhw_kept_triangles){.memory = memory, .threads = threads};
        for (int i = 0; i < threads; i++) {
            rhw_arena_init(&kept->arenas[i], memory);
        }
    }
    return kept;
}

void rhw_kept_triangles_destroy(struct rhw_kept_triangles *kept)
{
    if (!kept) {
        return;
    }
    for (int i = 0; i < kept->threads; i++) {
        rhw_arena_destroy(&kept->arenas[i]);
    }
    rhw_memory_release(kept->memory, kept, size_of(kept->threads));
}

static void swap_arenas(struct rhw_kept_triangles *kept, struct rhw_wave *wave)
{
    for (int i = 0; i < kept->threads; i++) {
        const struct rhw_arena own = wave->workers[i].arena;
        wave->workers[i].arena = kept->arenas[i];
        kept->arenas[i] = own;
    }
}

void rhw_kept_triangles_begin(struct rhw_kept_triangles *kept, struct rhw_wave *wave)
{
    kept->is_used = kept->is_made;
    if (kept->is_used) {
        kept->borrowed = wave->chunks;
        wave->chunks = kept->chunks;
        wave->chunk_count = kept->chunk_count;
    } else {
        swap_arenas(kept, wave);
    }
}

void rhw_kept_triangles_end(struct rhw_kept_triangles *kept, struct rhw_wave *wave, bool keeps)
{
    if (kept->is_used) {
        wave->chunks = kept->borrowed;
        return;
    }
    swap_arenas(kept, wave);
    const size_t size = (size_t)wave->chunk_count * sizeof *kept->chunks;
    kept->chunks = keeps ? rhw_arena_alloc(&kept->arenas[0], size, RHW_CACHE_LINE) : NULL;
    kept->is_made = kept->chunks != NULL;
    kept->chunk_count = wave->chunk_count;
    if (kept->is_made && size != 0) {
        memcpy(kept->chunks, wave->chunks, size);
    }
}
