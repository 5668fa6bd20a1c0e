// SPDX-License-Identifier: MIT
// The draw's vertex indices become slots: each vertex that its primitives name gets the next one when it is first
// named. The vertices of all slots are shaded once.
#include "effect_vertices.h"

#include <limits.h>
#include <string.h>

#include "base/arena.h"
#include "draw/assembly.h"
#include "base/constants.h"
#include "draw/recorded_pass.h"
#include "pipeline/pipeline.h"
#include "vertex_sharing.h"

// This table finds the slot of a vertex index by open addressing. An entry holds a slot plus 1, or 0 where it is free.
struct slot_table {
    uint32_t *entries;
    uint32_t mask;     // entries − 1
    uint32_t *indices; // the vertex index of each slot
    uint32_t count;
};

static uint32_t slot_of(struct slot_table *table, uint32_t index)
{
    uint32_t at = (index * 0x9e3779b1u) & table->mask;
    for (; table->entries[at] != 0; at = (at + 1) & table->mask) {
        if (table->indices[table->entries[at] - 1] == index) {
            return table->entries[at] - 1;
        }
    }
    table->indices[table->count++] = index;
    table->entries[at] = table->count;
    return table->count - 1;
}

// Make room in the table for `corners` indices. Return false when out of memory.
static bool make_table(struct slot_table *table, uint64_t corners, struct rhw_arena *arena)
{
    uint64_t size = 16;
    while (size < 2 * corners) {
        size *= 2;
    }
    if (size > UINT32_MAX || size > SIZE_MAX / sizeof *table->entries) {
        return false;
    }
    const size_t bytes = (size_t)size * sizeof *table->entries;
    table->indices = rhw_arena_alloc(arena, (size_t)corners * sizeof *table->indices, RHW_CACHE_LINE);
    table->entries = rhw_arena_alloc(arena, bytes, RHW_CACHE_LINE);
    table->mask = (uint32_t)size - 1;
    table->count = 0;
    if (!table->indices || !table->entries) {
        return false;
    }
    memset(table->entries, 0, bytes);
    return true;
}

// Write the draw's primitives by slot, and list in the table which vertex each slot stands for.
static void name_slots(const struct rhw_draw *draw, struct slot_table *table, uint32_t (*slots)[3])
{
    enum { SOME = 256 };
    for (uint32_t first = 0; first < draw->triangles_per_instance; first += SOME) {
        uint32_t room[SOME][3];
        const uint32_t left = draw->triangles_per_instance - first;
        const uint32_t count = left < SOME ? left : SOME;
        const uint32_t(*const indices)[3] = rhw_assembly_fetch(draw, first, count, room);
        for (uint32_t i = 0; i < 3 * count; i++) {
            slots[first + i / 3][i % 3] = slot_of(table, indices[i / 3][i % 3]);
        }
    }
}

// Make room for the vertices of all instances. Return NULL when out of memory.
static const struct rhw_shared_vertices *share(const struct rhw_draw *draw, const struct slot_table *table,
                                               struct rhw_arena *arena)
{
    const struct rhw_pipeline_data *const pipeline = draw->state->pipeline;
    const int stride = rhw_vertex_stride(pipeline->varying_components + pipeline->extra_components);
    const uint64_t room = ((uint64_t)table->count + 7) & ~(uint64_t)7;
    const uint64_t record = (uint64_t)stride * sizeof(float) + sizeof(struct rhw_snapped_vertex);
    if (room * record + sizeof(struct rhw_shared_vertices) > SIZE_MAX / 2 / draw->instances) {
        return NULL;
    }
    struct rhw_shared_vertices *const shared =
        rhw_arena_alloc(arena, draw->instances * sizeof *shared, RHW_CACHE_LINE);
    for (uint32_t i = 0; shared && i < draw->instances; i++) {
        float *const records =
            rhw_arena_alloc(arena, (size_t)room * (size_t)stride * sizeof *records, RHW_CACHE_LINE);
        struct rhw_snapped_vertex *const snapped =
            rhw_arena_alloc(arena, (size_t)room * sizeof *snapped, RHW_CACHE_LINE);
        if (!records || !snapped) {
            return NULL;
        }
        shared[i] =
            (struct rhw_shared_vertices){{draw, i, stride, records}, snapped, table->count, table->indices};
    }
    return shared;
}

bool rhw_effect_vertices_prepare(struct rhw_draw *draw, struct rhw_arena *arena)
{
    const uint64_t corners = 3 * (uint64_t)draw->triangles_per_instance;
    struct slot_table table;
    if (corners == 0 || draw->instances == 0) {
        return true;
    }
    uint32_t(*const slots)[3] =
        corners > SIZE_MAX / sizeof(uint32_t)
            ? NULL
            : rhw_arena_alloc(arena, (size_t)corners * sizeof(uint32_t), RHW_CACHE_LINE);
    if (!slots || !make_table(&table, corners, arena)) {
        return false;
    }
    name_slots(draw, &table, slots);
    rhw_arena_trim(arena, table.entries);
    draw->expanded = (const uint32_t(*)[3])slots;
    draw->shared = share(draw, &table, arena);
    return draw->shared != NULL;
}

bool rhw_effect_vertices_find(const struct rhw_recorded_pass *pass, struct rhw_arena *arena,
                              struct rhw_shared_parts *parts)
{
    uint64_t count = 0;
    *parts = (struct rhw_shared_parts){0};
    for (uint32_t d = 0; pass->shades_first && d < pass->draws.count; d++) {
        const struct rhw_draw *const draw = rhw_draw_list_at(&pass->draws, d);
        if (draw->is_shaded_first && draw->shared) {
            count += (uint64_t)draw->instances * rhw_shared_parts_of(draw->shared->count);
            parts->vertices += (uint64_t)draw->instances * draw->shared->count;
        }
    }
    if (count > INT_MAX || count > SIZE_MAX / sizeof *parts->parts) {
        return false;
    }
    parts->count = (int)count;
    parts->parts = rhw_arena_alloc(arena, (size_t)count * sizeof *parts->parts, RHW_CACHE_LINE);
    struct rhw_shared_part *part = parts->parts;
    for (uint32_t d = 0; part && count != 0 && d < pass->draws.count; d++) {
        const struct rhw_draw *const draw = rhw_draw_list_at(&pass->draws, d);
        if (draw->is_shaded_first) {
            part = rhw_shared_parts_list(part, draw);
        }
    }
    return parts->parts != NULL;
}
