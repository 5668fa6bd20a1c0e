// SPDX-License-Identifier: MIT
// Strips and fans have closed forms for the vertices of triangle i. Its vertices stand in the order that keeps the
// winding and puts the provoking vertex where the convention wants it (Vulkan 1.3 §21.1.3 for the first vertex, OpenGL
// 4.6 table 10.1 for the last).
#include "assembly.h"

#include <string.h>

#include "base/arena.h"
#include "base/constants.h"
#include "draw_list.h"
#include "pipeline/pipeline.h"

// Primitive t has `span` elements from step·t on. Where all primitives of a topology take their vertices from equal
// places, `pick` names the places.
static const struct layout {
    uint8_t step, span, pick[3];
} layouts[] = {
    [RHW_TRIANGLE_LIST] = {3, 3, {0, 1, 2}},
    [RHW_TRIANGLE_STRIP] = {1, 3, {0}},
    [RHW_TRIANGLE_FAN] = {1, 3, {0}},
    [RHW_POINT_LIST] = {1, 1, {0, 0, 0}},
    [RHW_LINE_LIST] = {2, 2, {0, 1, 1}},
    [RHW_LINE_STRIP] = {1, 2, {0, 1, 1}},
    [RHW_LINE_LIST_ADJACENCY] = {4, 4, {1, 2, 2}},
    [RHW_LINE_STRIP_ADJACENCY] = {1, 4, {1, 2, 2}},
    [RHW_TRIANGLE_LIST_ADJACENCY] = {6, 6, {0, 2, 4}},
    [RHW_TRIANGLE_STRIP_ADJACENCY] = {2, 6, {0}},
    [RHW_LINE_LOOP] = {1, 2, {0, 1, 1}},
};

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

// Find where the vertices of triangle t stand within the strip, the fan or the list. A line has its second vertex
// twice, and a point has its one vertex three times.
static void elements(enum rhw_topology topology, enum rhw_provoking provoking, uint64_t t, uint64_t e[3])
{
    const bool first = provoking == RHW_PROVOKING_FIRST;
    const uint64_t odd = t & 1, step = topology == RHW_TRIANGLE_STRIP_ADJACENCY ? 2 : 1;
    switch (topology) {
    case RHW_TRIANGLE_STRIP:
    case RHW_TRIANGLE_STRIP_ADJACENCY:
        e[0] = step * (first ? t : t + odd);
        e[1] = step * (first ? t + 1 + odd : t + 1 - odd);
        e[2] = step * (first ? t + 2 - odd : t + 2);
        return;
    case RHW_TRIANGLE_FAN:
        e[0] = first ? t + 1 : 0;
        e[1] = first ? t + 2 : t + 1;
        e[2] = first ? 0 : t + 2;
        return;
    default: {
        const struct layout *const layout = &layouts[topology];
        for (int i = 0; i < 3; i++) {
            e[i] = layout->step * t + layout->pick[i];
        }
        return;
    }
    }
}

static uint32_t primitives_of(enum rhw_topology topology, uint64_t count)
{
    const struct layout *const layout = &layouts[topology];
    const uint64_t closing = topology == RHW_LINE_LOOP;
    return count < layout->span ? 0 : (uint32_t)((count - layout->span) / layout->step + 1 + closing);
}

// Make the last line of a loop end at its first vertex.
static void close_loop(uint32_t line[3], uint32_t first)
{
    line[1] = line[2] = first;
}

static bool has_restarts(const struct rhw_draw *draw)
{
    return draw->indexed && draw->state->pipeline->def.primitive_restart;
}

// Return the number of indices up to the next restart index or the end.
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

// List the vertices of all triangles: with restarts there is no closed form for triangle i. Return false when out of
// memory.
static bool expand(struct rhw_draw *draw, uint32_t count, struct rhw_arena *arena)
{
    const struct rhw_pipeline_def *const def = &draw->state->pipeline->def;
    const uint64_t most = primitives_of(def->topology, count);
    const uint64_t size = (most == 0 ? 1 : most) * 3 * sizeof(uint32_t);
    uint32_t(*const out)[3] = size > SIZE_MAX ? NULL : rhw_arena_alloc(arena, (size_t)size, RHW_CACHE_LINE);
    if (!out) {
        return false;
    }
    uint32_t triangles = 0;
    for (uint64_t at = 0; at < count;) {
        const uint64_t run = run_length(draw, at, count);
        const uint32_t whole = primitives_of(def->topology, run);
        for (uint32_t t = 0; t < whole; t++) {
            uint64_t e[3];
            elements(def->topology, def->provoking, t, e);
            for (int i = 0; i < 3; i++) {
                out[triangles][i] = index_at(draw->state, draw->first + at + e[i]);
            }
            triangles++;
        }
        if (def->topology == RHW_LINE_LOOP && whole != 0) {
            close_loop(out[triangles - 1], index_at(draw->state, draw->first + at));
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
    if (has_restarts(draw) && run_length(draw, 0, count) < count) {
        return expand(draw, count, arena);
    }
    // Ten thousand small draws are made of lists, and a division by a constant costs no division.
    draw->triangles_per_instance =
        def->topology == RHW_TRIANGLE_LIST ? count / 3 : primitives_of(def->topology, count);
    return true;
}

uint64_t rhw_assembly_vertices(const struct rhw_draw *draw, uint32_t count)
{
    uint64_t vertices = 0;
    const bool restarts = has_restarts(draw);
    for (uint64_t at = 0; restarts && at < count; at++) {
        const uint64_t run = run_length(draw, at, count);
        vertices += run;
        at += run;
    }
    return restarts ? vertices : count;
}

void rhw_assembly_mark_strips(const struct rhw_draw *draw, uint32_t count, uint8_t *begins)
{
    const enum rhw_topology topology = draw->state->pipeline->def.topology;
    const bool restarts = has_restarts(draw);
    uint32_t primitives = 0;
    for (uint64_t at = 0; at < count;) {
        const uint64_t run = restarts ? run_length(draw, at, count) : count;
        const uint32_t whole = primitives_of(topology, run);
        if (whole != 0) {
            begins[primitives] = 1;
        }
        primitives += whole;
        at += run + 1;
    }
}

// Read the elements at .. at + count − 1 of a draw. They are what its index buffer holds there, and 0 past its end.
// Without an index buffer the elements are the positions themselves.
static void read_elements(const struct rhw_draw *draw, uint64_t at, uint32_t count, uint32_t *out)
{
    const struct rhw_draw_state *const state = draw->state;
    if (!draw->indexed) {
        for (uint32_t i = 0; i < count; i++) {
            out[i] = (uint32_t)at + i;
        }
        return;
    }
    const size_t size = state->index_type == RHW_INDEX_UINT8    ? 1
                        : state->index_type == RHW_INDEX_UINT16 ? 2
                                                                : 4;
    const uint64_t held = state->index_bytes / size;
    const uint32_t inside = at >= held ? 0 : held - at < count ? (uint32_t)(held - at) : count;
    const unsigned char *const bytes = state->indices + (inside == 0 ? 0 : (size_t)at * size);
    switch (state->index_type) {
    case RHW_INDEX_UINT8:
        for (uint32_t i = 0; i < inside; i++) {
            out[i] = bytes[i];
        }
        break;
    case RHW_INDEX_UINT16:
        for (uint32_t i = 0; i < inside; i++) {
            uint16_t v;
            memcpy(&v, bytes + 2 * (size_t)i, sizeof v);
            out[i] = v;
        }
        break;
    default: memcpy(out, bytes, inside * sizeof *out); break;
    }
    memset(out + inside, 0, (count - inside) * sizeof *out);
}

// Fetch triangles of a strip or fan. Triangle t has the elements t + 1 and t + 2 and one more. Elements are read to the
// end of the room, so that a written triangle ends before the elements of the next one begin:
// 3·t + 2 < (2·count − 2) + t + 1 for all but the last.
static void fetch_connected(const struct rhw_draw *draw, uint32_t first, uint32_t count, uint32_t (*room)[3])
{
    const struct rhw_pipeline_def *const def = &draw->state->pipeline->def;
    uint32_t *const elements_read = &room[0][0] + (2 * (size_t)count - 2);
    read_elements(draw, (uint64_t)draw->first + first, count + 2, elements_read);
    uint32_t hub;
    read_elements(draw, draw->first, 1, &hub);
    for (uint32_t t = 0; t < count; t++) {
        const uint32_t near[3] = {elements_read[t], elements_read[t + 1], elements_read[t + 2]};
        uint64_t e[3];
        elements(def->topology, def->provoking, first + t, e);
        for (int i = 0; i < 3; i++) {
            room[t][i] = e[i] >= first + t ? near[e[i] - first - t] : hub;
        }
    }
}

// Pick the vertices of `count` primitives from the elements that were read for them. The topology's `pick` says where
// they stand.
static void pick(const struct layout *layout, const uint32_t *read, uint32_t count, uint32_t (*room)[3])
{
    const size_t step = layout->step, a = layout->pick[0], b = layout->pick[1], c = layout->pick[2];
    for (uint32_t t = 0; t < count; t++, read += step) {
        room[t][0] = read[a];
        room[t][1] = read[b];
        room[t][2] = read[c];
    }
}

// Fetch primitives of all other topologies, a few at a time.
static void fetch_picked(const struct rhw_draw *draw, uint32_t first, uint32_t count, uint32_t (*room)[3])
{
    enum { SOME = 64, LONGEST = 6 };
    const struct rhw_pipeline_def *const def = &draw->state->pipeline->def;
    const struct layout *const layout = &layouts[def->topology];
    for (uint32_t done = 0; done < count; done += SOME) {
        const uint32_t some = count - done < SOME ? count - done : SOME;
        const uint64_t at = (uint64_t)layout->step * (first + done);
        uint32_t read[SOME * LONGEST];
        read_elements(draw, draw->first + at, layout->step * (some - 1) + layout->span, read);
        if (def->topology != RHW_TRIANGLE_STRIP_ADJACENCY) {
            pick(layout, read, some, room + done);
            continue;
        }
        for (uint32_t t = 0; t < some; t++) {
            uint64_t e[3];
            elements(def->topology, def->provoking, (uint64_t)first + done + t, e);
            for (int i = 0; i < 3; i++) {
                room[done + t][i] = read[e[i] - at];
            }
        }
    }
    if (def->topology == RHW_LINE_LOOP && first + count == draw->triangles_per_instance) {
        uint32_t begin;
        read_elements(draw, draw->first, 1, &begin);
        close_loop(room[count - 1], begin);
    }
}

const uint32_t (*rhw_assembly_fetch(const struct rhw_draw *draw, uint32_t first, uint32_t count,
                                    uint32_t (*room)[3]))[3]
{
    if (draw->expanded) {
        return draw->expanded + first;
    }
    const struct rhw_draw_state *const state = draw->state;
    const struct rhw_pipeline_def *const def = &state->pipeline->def;
    if (def->topology == RHW_TRIANGLE_LIST) {
        const uint64_t at = (uint64_t)draw->first + 3 * (uint64_t)first;
        // The common case is that the indices stand in the buffer as they are needed.
        if (draw->indexed && state->index_type == RHW_INDEX_UINT32 &&
            at + 3 * (uint64_t)count <= state->index_bytes / 4) {
            const unsigned char *const bytes = state->indices + 4 * at;
            if ((uintptr_t)bytes % _Alignof(uint32_t) == 0) {
                return (const uint32_t(*)[3])(const void *)bytes;
            }
        }
        read_elements(draw, at, 3 * count, room[0]);
        return (const uint32_t(*)[3])room;
    }
    if (def->topology == RHW_TRIANGLE_STRIP || def->topology == RHW_TRIANGLE_FAN) {
        fetch_connected(draw, first, count, room);
    } else {
        fetch_picked(draw, first, count, room);
    }
    return (const uint32_t(*)[3])room;
}
