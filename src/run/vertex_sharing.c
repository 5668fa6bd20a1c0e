// SPDX-License-Identifier: MIT
// Sharing pays where a draw's vertices are few in comparison with its triangles, and the triangles are in no order:
// several chunks would shade each vertex.
#include "vertex_sharing.h"

#include <limits.h>

#include "base/arena.h"
#include "draw/assembly.h"
#include "base/constants.h"
#include "format/format.h"
#include "draw/wave.h"
#include "pipeline/pipeline.h"

// Return how many elements lie wholly inside the buffers of a draw, at most UINT32_MAX.
static uint32_t elements_of(const struct rhw_draw_state *state)
{
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    uint64_t count = UINT32_MAX;
    for (int i = 0; i < def->attribute_count; i++) {
        const struct rhw_attribute *const attribute = &def->attributes[i];
        const struct rhw_vertex_layout *const layout = &def->buffers[attribute->buffer];
        const uint64_t size = state->streams[attribute->buffer].size;
        const uint64_t end = attribute->offset + (uint64_t)rhw_vertex_format_size(attribute->format);
        if (layout->per_instance || layout->constant || layout->stride == 0) {
            continue;
        }
        const uint64_t inside = size < end ? 0 : (size - end) / layout->stride + 1;
        count = inside < count ? inside : count;
    }
    return (uint32_t)count;
}

// Return true if a few triangles in the middle of the draw name vertices that lie further apart than the vertices of a
// whole chunk do where triangles have an order.
static bool is_scattered(const struct rhw_draw *draw, uint64_t chunk)
{
    enum { SAMPLES = 256 };
    uint32_t room[SAMPLES][3];
    const uint32_t samples = chunk < SAMPLES ? (uint32_t)chunk : SAMPLES;
    const uint32_t(*const indices)[3] =
        rhw_assembly_fetch(draw, draw->triangles_per_instance / 2, samples, room);
    uint32_t least = UINT32_MAX, most = 0;
    for (uint32_t i = 0; i < 3 * samples; i++) {
        const uint32_t index = indices[i / 3][i % 3];
        least = index < least ? index : least;
        most = index > most ? index : most;
    }
    return most - least >= 3 * chunk / 4;
}

// Return how many vertices the draw shares, or 0 where it shares none. A chunk has at most `chunk` triangles. Where
// triangles have no order, their chunks shade one to three vertices for each triangle and look up as many. Sharing
// costs less for up to three vertices for two triangles.
static uint32_t shared_count(const struct rhw_draw *draw, uint64_t chunk)
{
    const uint32_t triangles = draw->triangles_per_instance;
    if (!draw->indexed || triangles < RHW_SHARING_TRIANGLES || triangles < 2 * chunk) {
        return 0;
    }
    const uint32_t elements = elements_of(draw->state);
    const uint32_t count = draw->base_vertex < elements ? elements - draw->base_vertex : 0;
    return count / 3 <= triangles / 2 && is_scattered(draw, chunk) ? count : 0;
}

uint32_t rhw_shared_parts_of(uint32_t count)
{
    return (count - 1) / RHW_SHARED_PART + 1;
}

// Make room for the vertices of all instances of a draw. Return NULL when out of memory.
static struct rhw_shared_vertices *make_room(struct rhw_arena *arena, const struct rhw_draw *draw,
                                             uint32_t count, size_t room, int stride)
{
    struct rhw_shared_vertices *const shared =
        rhw_arena_alloc(arena, draw->instances * sizeof *shared, RHW_CACHE_LINE);
    for (uint32_t i = 0; shared && i < draw->instances; i++) {
        float *const records =
            rhw_arena_alloc(arena, room * (size_t)stride * sizeof *records, RHW_CACHE_LINE);
        struct rhw_snapped_vertex *const snapped =
            rhw_arena_alloc(arena, room * sizeof *snapped, RHW_CACHE_LINE);
        if (!records || !snapped) {
            return NULL;
        }
        shared[i] = (struct rhw_shared_vertices){{draw, i, stride, records}, snapped, count, NULL};
    }
    return shared;
}

// Make the draw share its vertices, if it should share them and there is room. Return false when out of memory.
static bool share(struct rhw_draw *draw, uint64_t chunk_size, size_t most, struct rhw_arena *arena,
                  struct rhw_shared_parts *parts)
{
    const uint32_t count = shared_count(draw, chunk_size);
    const uint64_t room = ((uint64_t)count + 7) & ~(uint64_t)7;
    const struct rhw_pipeline_data *const pipeline = draw->state->pipeline;
    const int stride = rhw_vertex_stride(pipeline->varying_components + pipeline->extra_components);
    const uint64_t size = room * ((uint64_t)stride * sizeof(float) + sizeof(struct rhw_snapped_vertex));
    draw->shared = NULL;
    if (count == 0 || draw->instances > (most - parts->bytes) / size ||
        draw->instances > (uint32_t)(INT_MAX - parts->count) / rhw_shared_parts_of(count)) {
        return true;
    }
    draw->shared = make_room(arena, draw, count, (size_t)room, stride);
    parts->count += (int)(draw->instances * rhw_shared_parts_of(count));
    parts->vertices += (uint64_t)draw->instances * count;
    parts->bytes += (size_t)(draw->instances * size);
    return draw->shared;
}

struct rhw_shared_part *rhw_shared_parts_list(struct rhw_shared_part *part, const struct rhw_draw *draw)
{
    for (uint32_t i = 0; draw->shared && i < draw->instances; i++) {
        const struct rhw_shared_vertices *const shared = &draw->shared[i];
        for (uint32_t first = 0; first < shared->count; first += RHW_SHARED_PART) {
            const uint32_t left = shared->count - first;
            *part++ =
                (struct rhw_shared_part){shared, first, left < RHW_SHARED_PART ? left : RHW_SHARED_PART};
        }
    }
    return part;
}

bool rhw_shared_vertices_find(const struct rhw_wave *wave, uint64_t chunk_size, size_t most,
                              struct rhw_shared_parts *parts)
{
    const struct rhw_recorded_pass *const pass = wave->pass;
    struct rhw_arena *const arena = &wave->workers[0].arena;
    *parts = (struct rhw_shared_parts){0};
    if (!pass->has_large_draws || wave->chunk_count == 0 || !rhw_pass_takes_special_paths(pass)) {
        return true;
    }
    const struct rhw_chunk *const last = &wave->chunks[wave->chunk_count - 1];
    const uint32_t first = wave->chunks[0].first_draw;
    uint32_t end = first;
    for (; end < pass->draws.count; end++) {
        struct rhw_draw *const draw = rhw_draw_list_at(&pass->draws, end);
        if (draw->first_triangle >= last->first + last->count) {
            break;
        }
        if (!draw->is_shaded_first && !share(draw, chunk_size, most, arena, parts)) {
            return false;
        }
    }
    if (parts->count == 0) {
        return true;
    }
    parts->parts = rhw_arena_alloc(arena, (size_t)parts->count * sizeof *parts->parts, RHW_CACHE_LINE);
    struct rhw_shared_part *part = parts->parts;
    for (uint32_t d = first; part && d < end; d++) {
        const struct rhw_draw *const draw = rhw_draw_list_at(&pass->draws, d);
        if (!draw->is_shaded_first) {
            part = rhw_shared_parts_list(part, draw);
        }
    }
    return part;
}
