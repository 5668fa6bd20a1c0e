// SPDX-License-Identifier: MIT
// A vertex that several triangles of a run name is shaded once where that is cheap.
//
// The general path finds each vertex again through a table. Two special paths need no table:
// - Where the indices of a run lie close together, every vertex between the least and the greatest is shaded. A closed
//   mesh has a vertex for every two triangles, so few are shaded in vain: 18 % fewer instructions in a grid of a
//   million triangles drawn as depth alone, 1 % in Sponza.
// - Small draws shade every vertex between the least and the greatest however far apart these lie; they may have hard
//   edges and several vertices at a point. They lose 6 groups of 8 vertices at most, and 10,000 draws of a cube take
//   9 % fewer instructions.
// Whole draws whose vertices stand in no order are shaded before the chunks: see shared_vertices.h.
#ifndef RHW_VERTEX_REUSE_H
#define RHW_VERTEX_REUSE_H

#include "geometry_scratch.h"

// Find the least and the greatest vertex index of a run.
static void index_range(const struct rhw_run *run, uint32_t *low, uint32_t *high)
{
    const uint32_t *const indices = &run->indices[0][0];
    uint32_t least = UINT32_MAX, most = 0;
    for (uint32_t i = 0; i < 3 * run->count; i++) { // compilers take 8 at a time
        least = indices[i] < least ? indices[i] : least;
        most = indices[i] > most ? indices[i] : most;
    }
    *low = least;
    *high = most;
}

// Give each vertex a slot at its first use, through a direct-mapped table, and write the slots of the run's triangles.
// An entry counts when this run made it: its stamp is this run's first stamp plus the slot.
static uint32_t look_up_slots(struct rhw_geometry_scratch *scratch, struct rhw_run *run, uint32_t base_vertex,
                              uint32_t (*slots)[3])
{
    // Every 2^32 vertices the stamps start anew.
    if (scratch->stamp > UINT32_MAX - 3 * RHW_CHUNK_TRIANGLES) {
        memset(scratch->cache, 0, sizeof scratch->cache);
        scratch->stamp = 1;
    }
    const uint32_t first_stamp = scratch->stamp;
    const uint32_t *const indices = &run->indices[0][0];
    uint32_t *const out = &slots[0][0];
    uint32_t count = 0;
    for (uint32_t i = 0; i < 3 * run->count; i++) {
        const uint32_t index = indices[i];
        struct rhw_cache_entry *const entry = &scratch->cache[index % RHW_VERTEX_CACHE];
        if (entry->index != index || entry->stamp < first_stamp) {
            *entry = (struct rhw_cache_entry){index, first_stamp + count};
            scratch->unique[count++] = index + base_vertex;
        }
        out[i] = entry->stamp - first_stamp;
    }
    scratch->stamp = first_stamp + count;
    run->indices = (const uint32_t(*)[3])slots;
    run->first_slot = 0;
    return count;
}

// Return how far apart the indices of a run may lie if all vertices between them are to be shaded.
static uint32_t range_most(const struct rhw_run *run, const struct rhw_draw *draw)
{
    enum { SMALL = 16 }; // triangles
    const bool is_closed = draw->indexed && run->count > SMALL;
    return is_closed ? 3 * run->count / 4 : 3 * run->count;
}

// List the vertices that a run shades in scratch->unique, in the order of their slots, and return their number. `slots`
// is room for the slots of the run's triangles.
static uint32_t list_vertices(struct rhw_geometry_scratch *scratch, struct rhw_run *run,
                              const struct rhw_draw *draw, uint32_t (*slots)[3])
{
    uint32_t low, high;
    index_range(run, &low, &high);
    if (!scratch->special_paths || high - low >= range_most(run, draw)) {
        return look_up_slots(scratch, run, draw->base_vertex, slots);
    }
    run->first_slot = low;
    const uint32_t count = high - low + 1;
    for (uint32_t i = 0; i < count; i++) {
        scratch->unique[i] = low + draw->base_vertex + i;
    }
    return count;
}

// Let a run of one instance, which has `vertices` listed, go on through the next instances, so that 8 vertices of small
// instances are shaded at once and 8 triangles set up: 100,000 quads take 27 % fewer instructions. `slots` is room for
// the slots of all triangles.
static void repeat_instance(struct rhw_geometry_scratch *scratch, struct rhw_run *run, uint32_t (*slots)[3],
                            uint32_t vertices, uint32_t instances)
{
    const uint32_t *const indices = &run->indices[0][0];
    uint32_t *const out = &slots[0][0];
    const uint32_t corners = 3 * run->count;
    for (uint32_t i = 0; i < corners; i++) {
        out[i] = indices[i] - run->first_slot;
    }
    for (uint32_t i = corners; i < corners * instances; i++) {
        out[i] = out[i - corners] + vertices;
    }
    for (uint32_t i = vertices; i < vertices * instances; i++) {
        scratch->unique[i] = scratch->unique[i - vertices];
    }
    run->indices = (const uint32_t(*)[3])slots;
    run->first_slot = 0;
    run->count *= instances;
}

#endif
