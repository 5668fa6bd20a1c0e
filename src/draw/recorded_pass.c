// SPDX-License-Identifier: MIT
// A recorded pass is created, cleared and destroyed here. Its memory stays from pass to pass.
#include "recorded_pass.h"

#include <string.h>

#include "base/memory.h"

struct rhw_recorded_pass *rhw_recorded_pass_create(struct rhw_memory *memory)
{
    struct rhw_recorded_pass *const pass = rhw_memory_allocate(memory, sizeof *pass, RHW_CACHE_LINE);
    if (pass) {
        memset(pass, 0, sizeof *pass);
        rhw_arena_init(&pass->arena, memory);
    }
    return pass;
}

void rhw_recorded_pass_clear(struct rhw_recorded_pass *pass)
{
    rhw_arena_reset(&pass->arena);
    pass->explained.ask.fragment = NULL;
    pass->tile_reports = NULL;
    pass->queries = NULL;
    pass->kept = NULL;
    pass->draws.count = 0;
    pass->triangle_count = 0;
    pass->triangles_most = 1;
    pass->components_most = 0;
    pass->shades_first = false;
    pass->has_large_draws = false;
    pass->has_feedback = false;
    pass->shades_samples = false;
    pass->shows_order = false;
}

void rhw_recorded_pass_destroy(struct rhw_memory *memory, struct rhw_recorded_pass *pass)
{
    if (!pass) {
        return;
    }
    rhw_draw_list_destroy(memory, &pass->draws);
    rhw_arena_destroy(&pass->arena);
    rhw_memory_release(memory, pass, sizeof *pass);
}
