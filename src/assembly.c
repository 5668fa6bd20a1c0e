// SPDX-License-Identifier: MIT
// Triangle i of a strip or fan has its vertices in the order that keeps the winding and puts the provoking
// vertex where the convention wants it (Vulkan 1.3 §21.1.3 first vertex, OpenGL 4.6 table 10.1 last vertex).
#include "assembly.h"

#include <string.h>

#include "arena.h"
#include "pass.h"

static uint32_t index_at(const struct rhw_draw_state *state, uint64_t i)
{
    switch (state->index_type) {
    case RHW_INDEX_UINT8: return i < state->index_bytes ? state->indices[i] : 0;
    case RHW_INDEX_UINT16: {
        uint16_t v = 0;
        if (i < state->index_bytes / 2) {
            memcpy(&v, state->indices + 2 * i, sizeof v);
        }
        return v;
    }
    default: {
        uint32_t v = 0;
        if (i < state->index_bytes / 4) {
            memcpy(&v, state->indices + 4 * i, sizeof v);
        }
        return v;
    }
    }
}

// Positions within the strip or fan, or within the list, of triangle t's vertices.
static void elements(enum rhw_topology topology, enum rhw_provoking provoking, uint32_t t, uint32_t e[3])
{
    const bool first = provoking == RHW_PROVOKING_FIRST;
    const uint32_t odd = t & 1;
    switch (topology) {
    case RHW_TRIANGLE_LIST:
        e[0] = 3 * t;
        e[1] = 3 * t + 1;
        e[2] = 3 * t + 2;
        return;
    case RHW_TRIANGLE_STRIP:
        e[0] = first ? t : t + odd;
        e[1] = first ? t + 1 + odd : t + 1 - odd;
        e[2] = first ? t + 2 - odd : t + 2;
        return;
    default:
        e[0] = first ? t + 1 : 0;
        e[1] = first ? t + 2 : t + 1;
        e[2] = first ? 0 : t + 2;
        return;
    }
}

// Number of indices up to the next restart index or the end.
static uint64_t run_length(const struct rhw_draw *draw, uint64_t at, uint64_t count)
{
    const uint32_t restart = draw->state->index_type == RHW_INDEX_UINT8    ? UINT8_MAX
                             : draw->state->index_type == RHW_INDEX_UINT16 ? UINT16_MAX
                                                                           : UINT32_MAX;
    uint64_t n = 0;
    while (at + n < count && index_at(draw->state, draw->first + at + n) != restart) {
        n++;
    }
    return n;
}

// Strips and fans with restart have no closed form for triangle i: they become a list here.
static bool expand(struct rhw_draw *draw, uint32_t count, struct rhw_arena *arena)
{
    const struct rhw_pipeline_def *const def = &draw->state->pipeline->def;
    const uint64_t size = (uint64_t)(count < 3 ? 1 : count - 2) * 3 * sizeof(uint32_t);
    uint32_t(*const out)[3] = size > SIZE_MAX ? NULL : rhw_arena_alloc(arena, (size_t)size, RHW_CACHE_LINE);
    if (!out) {
        return false;
    }
    uint32_t triangles = 0;
    for (uint64_t at = 0; at < count;) {
        const uint64_t run = run_length(draw, at, count);
        for (uint32_t t = 0; t + 2 < run; t++) {
            uint32_t e[3];
            elements(def->topology, def->provoking, t, e);
            for (int i = 0; i < 3; i++) {
                out[triangles][i] = index_at(draw->state, draw->first + at + e[i]) + draw->base_vertex;
            }
            triangles++;
        }
        at += run + 1;
    }
    draw->expanded = (const uint32_t(*)[3])out;
    draw->triangles_per_instance = triangles;
    return true;
}

bool rhw_assembly_prepare(struct rhw_draw *draw, uint32_t count, struct rhw_arena *arena)
{
    const struct rhw_pipeline_def *const def = &draw->state->pipeline->def;
    draw->expanded = NULL;
    if (def->topology == RHW_TRIANGLE_LIST) {
        draw->triangles_per_instance = count / 3;
        return true;
    }
    if (draw->indexed && def->primitive_restart) {
        return expand(draw, count, arena);
    }
    draw->triangles_per_instance = count < 3 ? 0 : count - 2;
    return true;
}

void rhw_assembly_fetch(const struct rhw_draw *draw, uint32_t first, uint32_t count, uint32_t (*triangles)[3])
{
    if (draw->expanded) {
        memcpy(triangles, draw->expanded + first, count * sizeof *triangles);
        return;
    }
    const struct rhw_draw_state *const state = draw->state;
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    const uint64_t end = (uint64_t)draw->first + 3 * ((uint64_t)first + count);
    if (draw->indexed && def->topology == RHW_TRIANGLE_LIST && state->index_type == RHW_INDEX_UINT32 &&
        end <= state->index_bytes / 4) { // the common case, without a branch per index
        memcpy(triangles, state->indices + 4 * ((uint64_t)draw->first + 3 * (uint64_t)first),
               count * sizeof *triangles);
        for (uint32_t t = 0; draw->base_vertex != 0 && t < count; t++) {
            for (int i = 0; i < 3; i++) {
                triangles[t][i] += draw->base_vertex;
            }
        }
        return;
    }
    for (uint32_t t = 0; t < count; t++) {
        uint32_t e[3];
        elements(def->topology, def->provoking, first + t, e);
        for (int i = 0; i < 3; i++) {
            triangles[t][i] = draw->indexed
                                  ? index_at(state, (uint64_t)draw->first + e[i]) + draw->base_vertex
                                  : draw->first + e[i];
        }
    }
}
