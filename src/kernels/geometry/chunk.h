// SPDX-License-Identifier: MIT
// The front end over one chunk: its draws are assembled and their vertices shaded, its triangles are set up and binned,
// and what tiles read of them is kept.
#ifndef RHW_CHUNK_H
#define RHW_CHUNK_H

#include "draw/assembly.h"
#include "draw/wave.h"
#include "draw/shared_vertices.h"
#include "base/thread.h"
#include "binning.h"
#include "clipping_count.h"
#include "feedback.h"
#include "line_setup.h"
#include "point_setup.h"
#include "polygon_setup.h"
#include "triangle_setup.h"
#include "routing.h"
#include "vertex_reuse.h"
#include "vertex_shading.h"

// Let a run read the vertices that its draw shares. Return false where the draw shares none, or where the run names
// others.
static bool use_shared(struct rhw_run *run, struct rhw_segment *segment, const struct rhw_draw *draw,
                       uint32_t instance)
{
    uint32_t low, high;
    if (!draw->shared) {
        return false;
    }
    const struct rhw_shared_vertices *const shared = &draw->shared[instance];
    index_range(run, &low, &high);
    if (high >= shared->count) {
        return false;
    }
    run->first_slot = 0;
    run->vertices = shared->snapped;
    *segment = shared->segment;
    return true;
}

// What a run has of a draw: `count` primitives of an instance, or all primitives of several instances.
struct run_extent {
    uint32_t instance, instances;
    uint32_t first_primitive, count; // counted within an instance
};

// Assemble and shade a run. Return false when out of memory, or given up.
static bool start_run(struct rhw_worker *worker, const struct rhw_draw *draw, const struct run_extent *extent)
{
    struct rhw_geometry_scratch *const scratch = worker->geometry;
    struct rhw_segment *const segment = &scratch->segments[scratch->run_count];
    struct rhw_run *const run = &scratch->runs[scratch->run_count];
    uint32_t(*const room)[3] = scratch->indices + scratch->index_count;
    *run = (struct rhw_run){.indices = rhw_assembly_fetch(draw, extent->first_primitive, extent->count, room),
                            .count = extent->count,
                            .first_primitive = extent->first_primitive};
    scratch->run_count++;
    scratch->index_count += extent->count * extent->instances;
    if (use_shared(run, segment, draw, extent->instance)) {
        return true;
    }
    struct rhw_snapped_vertex *const snapped = scratch->vertices + scratch->vertex_count;
    const uint32_t each = list_vertices(scratch, run, draw, room), vertices = each * extent->instances;
    if (extent->instances > 1) {
        repeat_instance(scratch, run, room, each, extent->instances);
    }
    const uint32_t rounded_up = (vertices + 7) & ~7u;
    const struct rhw_pipeline_data *const pipeline = draw->state->pipeline;
    const int stride = rhw_vertex_stride(pipeline->varying_components + pipeline->extra_components);
    const size_t size = (size_t)rounded_up * (size_t)stride * sizeof(float);
    run->vertices = snapped;
    *segment = (struct rhw_segment){draw, extent->instance, stride,
                                    rhw_arena_alloc(&worker->arena, size, RHW_CACHE_LINE)};
    if (!segment->vertices) {
        return false;
    }
    if (!shade_vertices(scratch, segment, snapped, vertices, each)) {
        return false;
    }
    scratch->counters.vertices_shaded += vertices;
    scratch->vertex_count += rounded_up;
    return true;
}

// Return what comes next of a draw. `at` and `most` count triangles, of the draw and of the chunk.
static struct run_extent next_extent(const struct rhw_draw *draw, uint64_t at, uint64_t most)
{
    const uint32_t each = draw->triangles_per_instance;
    struct run_extent extent = {(uint32_t)(at / each), 1, (uint32_t)(at % each), 0};
    extent.count = each - extent.first_primitive;
    extent.count = most < extent.count ? (uint32_t)most : extent.count;
    if (extent.count == each && each <= RHW_SMALL_INSTANCE && !draw->shared) {
        const uint64_t fit = most / each, left = draw->instances - extent.instance;
        extent.instances = (uint32_t)(fit < left ? fit : left);
    }
    return extent;
}

// Assemble and shade what the chunk has of each draw. Return false when out of memory, or given up.
static bool start_runs(const struct rhw_wave *wave, const struct rhw_chunk *chunk, struct rhw_worker *worker)
{
    uint64_t at = chunk->first;
    const uint64_t end = chunk->first + chunk->count;
    for (uint32_t d = chunk->first_draw; at < end; d++) {
        const struct rhw_draw *const draw = rhw_draw_list_at(&wave->pass->draws, d);
        const uint64_t draw_end = rhw_draw_end(draw);
        while (at < end && at < draw_end) {
            const struct run_extent extent = next_extent(draw, at - draw->first_triangle, end - at);
            if (!start_run(worker, draw, &extent)) {
                return false;
            }
            at += (uint64_t)extent.count * extent.instances;
        }
    }
    return true;
}

// A function that sets up 8 primitives.
typedef void setup8_function(struct rhw_geometry_scratch *scratch, const struct run_slice *slice,
                             struct rhw_triangle_list *list);

// Set up the primitives from `i` to `end`, exclusive.
RHW_INLINE void setup_part(struct rhw_geometry_scratch *scratch, uint32_t run_index, uint32_t i, uint32_t end,
                           struct rhw_triangle_list *list, setup8_function *setup)
{
    const struct rhw_run *const run = &scratch->runs[run_index];
    for (; i + 8 < end; i += 8) {
        const struct run_slice slice = {run_index, run->indices + i, run->first_primitive + i, 0xff};
        setup(scratch, &slice, list);
    }
    // The last indices are repeated, so that `setup` reads no others behind them.
    uint32_t indices[9][3];
    const uint32_t left = end - i;
    for (uint32_t lane = 0; lane < 9; lane++) {
        memcpy(indices[lane], run->indices[i + (lane < left ? lane : left - 1)], sizeof *indices);
    }
    const struct run_slice slice = {run_index, (const uint32_t(*)[3])indices, run->first_primitive + i,
                                    0xffu >> (8 - left)};
    setup(scratch, &slice, list);
}

// Add what is drawn of a part of the run's primitives to the list, in submission order.
static void setup_primitives(struct rhw_geometry_scratch *scratch, uint32_t run, uint32_t first, uint32_t end,
                             struct rhw_triangle_list *list)
{
    const int before = list->count;
    switch (scratch->segments[run].draw->state->pipeline->primitive) {
    case RHW_PRIMITIVE_POINTS: setup_part(scratch, run, first, end, list, setup_points8); return;
    case RHW_PRIMITIVE_LINES: setup_part(scratch, run, first, end, list, setup_lines8); return;
    case RHW_PRIMITIVE_POLYGON_LINES:
    case RHW_PRIMITIVE_POLYGON_POINTS: setup_part(scratch, run, first, end, list, setup_polygons8); return;
    case RHW_PRIMITIVE_NOTHING: return;
    case RHW_PRIMITIVE_TRIANGLES: break;
    }
    setup_part(scratch, run, first, end, list, setup8);
    scratch->counters.rasterized += (uint64_t)(list->count - before);
}

// Add what is drawn of a run to the list where each primitive names its viewport and layer.
static void setup_routed(struct rhw_geometry_scratch *scratch, uint32_t run_index,
                         struct rhw_triangle_list *list)
{
    const struct rhw_run *const run = &scratch->runs[run_index];
    struct viewport_runs runs = {{0}};
    for (uint32_t i = 0, end; i < run->count && !scratch->out_of_memory; i = end) {
        const struct route route = route_of(scratch, run_index, i);
        for (end = i + 1; end < run->count && same_route(route, route_of(scratch, run_index, end)); end++) {
        }
        if (!is_drawn(scratch, route)) {
            scratch->counters.culled += end - i;
            continue;
        }
        const int before = list->count;
        const uint32_t number = run_of_viewport(scratch, run_index, route.viewport, &runs);
        if (!scratch->out_of_memory) {
            setup_primitives(scratch, number, i, end, list);
        }
        for (int t = before; t < list->count; t++) {
            list->triangles[t].layer = (uint16_t)route.layer;
        }
    }
}

// Make the vertices and triangles of a chunk. Return false when out of memory, or given up.
static bool make_triangles(const struct rhw_wave *wave, const struct rhw_chunk *chunk,
                           struct rhw_worker *worker, struct rhw_triangle_list *list)
{
    struct rhw_geometry_scratch *const scratch = worker->geometry;
    scratch->special_paths = rhw_pass_takes_special_paths(wave->pass);
    scratch->uncovered_pattern = scratch->special_paths && wave->target.pattern->count <= MOST_CULLED_SAMPLES
                                     ? wave->target.pattern
                                     : NULL;
    scratch->run_count = scratch->polygon_count = 0;
    scratch->index_count = scratch->vertex_count = 0;
    scratch->arena = &worker->arena;
    scratch->asked = wave->asked;
    scratch->worker = (int)(worker - wave->workers);
    scratch->made_run = UINT32_MAX;
    scratch->out_of_memory = false;
    scratch->layers = wave->target.layers;
    scratch->counters = (struct rhw_front_counters){0};
    const uint64_t start = rhw_time_ns();
    if (!start_runs(wave, chunk, worker)) {
        return false;
    }
    const uint64_t shaded = rhw_time_ns();
    // There is room for all triangles; what culling leaves of it goes back.
    const size_t room = (size_t)chunk->count * (size_t)wave->pass->triangles_most * sizeof *list->triangles;
    *list = (struct rhw_triangle_list){.triangles = rhw_arena_alloc(&worker->arena, room, RHW_CACHE_LINE),
                                       .ranges = scratch->tile_ranges,
                                       .segments = scratch->segments,
                                       .polygons = scratch->polygons};
    if (!list->triangles) {
        return false;
    }
    scratch->segment_count = scratch->run_count;
    for (int i = 0; i < scratch->run_count; i++) {
        if (scratch->segments[i].draw->state->pipeline->is_routed) {
            setup_routed(scratch, (uint32_t)i, list);
        } else {
            setup_primitives(scratch, (uint32_t)i, 0, scratch->runs[i].count, list);
        }
    }
    // Otherwise made vertices stand behind the triangles.
    if (scratch->segment_count == scratch->run_count) {
        rhw_arena_trim(&worker->arena, list->triangles + list->count);
    }
    worker->counters.vertex_ns += shaded - start;
    worker->counters.setup_ns += rhw_time_ns() - shaded;
    return !scratch->out_of_memory;
}

// Return where a triangle of the chunk stands in the line of all triangles.
static uint64_t place_in_line(const struct rhw_geometry_scratch *scratch, const struct rhw_triangle *t)
{
    const struct rhw_segment *const segment = &scratch->segments[t->segment];
    const struct rhw_draw *const draw = segment->draw;
    return draw->first_triangle + (uint64_t)segment->instance * draw->triangles_per_instance + t->primitive;
}

// Return how the chunk may be drawn: as its draws may, where they agree.
static struct rhw_hidden_rule shared_hidden_rule(const struct rhw_geometry_scratch *scratch)
{
    const struct rhw_hidden_rule first = scratch->segments[0].draw->state->hidden;
    for (int i = 1; i < scratch->run_count; i++) {
        if (!rhw_hidden_rule_equal(scratch->segments[i].draw->state->hidden, first)) {
            return (struct rhw_hidden_rule){RHW_HIDDEN_IN_ORDER, RHW_COMPARE_NEVER};
        }
    }
    return first;
}

// Copy what the chunk made out of the scratch, into memory that lasts until its tiles are drawn.
static void *keep(struct rhw_arena *arena, const void *from, size_t size)
{
    void *const to = rhw_arena_alloc(arena, size, RHW_CACHE_LINE);
    if (to && size != 0) {
        memcpy(to, from, size);
    }
    return to;
}

// Make a chunk: the entry make_chunk of rhw_kernels.
static bool make_chunk(const struct rhw_wave *wave, struct rhw_chunk *chunk, struct rhw_worker *worker)
{
    struct rhw_arena *const arena = &worker->arena;
    struct rhw_geometry_scratch *const scratch = worker->geometry;
    struct rhw_triangle_list list;
    if (!make_triangles(wave, chunk, worker, &list)) {
        return false;
    }
    // With large triangles on a large target, the chunk ends where its bins are full. Doing it again costs nothing
    // beside drawing that many entries, and its counters stay those of the triangles it has.
    bound_bins(chunk, &list, wave->target.layers);
    const int fit = triangles_that_fit(chunk, &list, wave->entries_most);
    if (fit < list.count) {
        const uint64_t place = place_in_line(scratch, &list.triangles[fit]) - chunk->first;
        chunk->count = place == 0 ? 1 : place; // a primitive that becomes several triangles is drawn whole
        if (!make_triangles(wave, chunk, worker, &list)) {
            return false;
        }
        bound_bins(chunk, &list, wave->target.layers);
    }
    const uint64_t start = rhw_time_ns();
    chunk->counters = scratch->counters;
    chunk->hidden = shared_hidden_rule(scratch);
    chunk->triangles = list.triangles;
    chunk->segments =
        keep(arena, scratch->segments, (size_t)scratch->segment_count * sizeof *chunk->segments);
    chunk->polygons =
        keep(arena, scratch->polygons, (size_t)scratch->polygon_count * sizeof *chunk->polygons);
    if (wave->pass->has_feedback) {
        capture_runs(scratch);
    }
    if (wave->pass->queries && !count_runs(chunk, worker)) {
        return false;
    }
    const bool binned = chunk->segments && chunk->polygons && bin(chunk, &list, arena);
    worker->counters.bin_ns += rhw_time_ns() - start;
    return binned;
}

_Static_assert(RHW_SHARED_PART % RHW_LANES == 0, "a part is whole groups");

// Shade some of the vertices that chunks share.
static void shade_shared_part(const struct rhw_wave *wave, const struct rhw_shared_part *part,
                              struct rhw_worker *worker)
{
    struct rhw_geometry_scratch *const scratch = worker->geometry;
    const uint64_t start = rhw_time_ns();
    struct rhw_segment segment = part->shared->segment;
    segment.vertices += (size_t)part->first * (size_t)segment.vertex_stride;
    scratch->asked = wave->asked;
    scratch->worker = (int)(worker - wave->workers);
    scratch->special_paths = rhw_pass_takes_special_paths(wave->pass);
    for (uint32_t i = 0; i < part->count; i++) {
        const uint32_t slot = part->first + i;
        scratch->unique[i] =
            segment.draw->base_vertex + (part->shared->indices ? part->shared->indices[slot] : slot);
    }
    (void)shade_vertices(scratch, &segment, part->shared->snapped + part->first, part->count, part->count);
    worker->counters.vertex_ns += rhw_time_ns() - start;
}

#endif
