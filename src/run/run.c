// SPDX-License-Identifier: MIT
// Waves: as many chunks as the bin memory holds go through the front end, then every tile draws them. Most
// passes are one wave; a pass that is larger than the bins loads and stores its tiles between waves, so that
// geometry stays bounded whatever is drawn: by the bin memory and a quarter of it for the bins of the last chunks, and
// a few megabytes per thread.
#include "run.h"

#include <string.h>

#include "context/context.h"
#include "effect_vertices.h"
#include "kernels/geometry/geometry_scratch.h"
#include "kernels/kernels.h"
#include "kernels/tile_work.h"
#include "pass/pass_state.h"
#include "pass/query.h"
#include "base/scheduler.h"
#include "shared_vertices.h"
#include "strip_stipple.h"
#include "base/thread.h"

static const size_t default_bin_memory = (size_t)512 << 20; // bytes

enum { CHUNK_LEAST = 128 }; // triangles: below, binning a chunk costs as much as its triangles

static double milliseconds(uint64_t ns)
{
    return (double)ns * 1e-6;
}

// Zero, but for the table of lanes, and what an empty queue says of its groups.
static void init_tile_scratch(struct rhw_tile_scratch *scratch)
{
    memset(scratch, 0, sizeof *scratch);
    scratch->queue.only_full_rows = true;
    for (int bits = 0; bits < 256; bits++) {
        int count = 0;
        for (int lane = 0; lane < 8; lane++) {
            scratch->collected.set_lanes[bits][count] = (uint8_t)lane;
            count += bits >> lane & 1;
        }
    }
}

// Memory for the samples of a tile but the first; what a pass does not draw into is never touched.
static bool planes_ready(const struct rhw_pass_state *pass, struct rhw_worker *worker)
{
    struct rhw_memory *const memory = &pass->context->memory;
    const int wanted = pass->pattern->count - 1;
    if (worker->sample_tile_count < wanted) {
        rhw_memory_release(memory, worker->sample_tiles,
                           (size_t)worker->sample_tile_count * sizeof *worker->sample_tiles);
        worker->sample_tile_count = 0;
        worker->sample_tiles =
            rhw_memory_allocate_zeroed(memory, (size_t)wanted * sizeof *worker->sample_tiles, 4096);
        if (!worker->sample_tiles) {
            return false;
        }
        worker->sample_tile_count = wanted;
    }
    worker->tile->sample_tiles = worker->sample_tiles;
    return true;
}

// What stays from frame to frame: an empty table of vertices, and where groups of vertices have their distances.
static void init_geometry_scratch(struct rhw_geometry_scratch *scratch)
{
    memset(scratch->cache, 0, sizeof scratch->cache);
    scratch->stamp = 1;
    for (int g = 0; g < RHW_VERTEX_GROUPS; g++) {
        scratch->groups[g].clip_distance = scratch->distances[g];
        scratch->groups[g].mask = rhw_splat_int(-1);
        scratch->groups[g].cull_distance = scratch->distances[g] + RHW_MAX_CLIP_DISTANCES;
    }
}

static bool workers_ready(struct rhw_pass_state *pass)
{
    struct rhw_context *const context = pass->context;
    if (!pass->workers) {
        pass->workers = rhw_memory_allocate(&context->memory,
                                            (size_t)context->threads * sizeof *pass->workers, RHW_CACHE_LINE);
        if (!pass->workers) {
            return false;
        }
        memset(pass->workers, 0, (size_t)context->threads * sizeof *pass->workers);
        for (int i = 0; i < context->threads; i++) {
            rhw_arena_init(&pass->workers[i].arena, &context->memory);
        }
    }
    for (int i = 0; i < context->threads; i++) {
        struct rhw_worker *const worker = &pass->workers[i];
        if (!worker->geometry) {
            worker->geometry = rhw_memory_allocate(&context->memory, sizeof *worker->geometry, 4096);
            if (!worker->geometry) {
                return false;
            }
            init_geometry_scratch(worker->geometry);
        }
        if (!worker->tile) {
            worker->tile = rhw_memory_allocate(&context->memory, sizeof *worker->tile, 4096);
            if (!worker->tile) {
                return false;
            }
            init_tile_scratch(worker->tile);
        }
        if (!planes_ready(pass, worker)) {
            return false;
        }
        worker->counters = (struct rhw_counters){0};
    }
    return true;
}

void rhw_pass_run_release(struct rhw_pass_state *pass)
{
    struct rhw_context *const context = pass->context;
    for (int i = 0; pass->workers && i < context->threads; i++) {
        rhw_arena_destroy(&pass->workers[i].arena);
        rhw_memory_release(&context->memory, pass->workers[i].geometry, sizeof *pass->workers[i].geometry);
        rhw_memory_release(&context->memory, pass->workers[i].tile, sizeof *pass->workers[i].tile);
        rhw_memory_release(&context->memory, pass->workers[i].sample_tiles,
                           (size_t)pass->workers[i].sample_tile_count *
                               sizeof *pass->workers[i].sample_tiles);
    }
    rhw_memory_release(&context->memory, pass->workers, (size_t)context->threads * sizeof *pass->workers);
    rhw_memory_release(&context->memory, pass->chunks, (size_t)pass->chunk_capacity * sizeof *pass->chunks);
    for (int i = 0; i < RHW_MAX_COLOR_ATTACHMENTS; i++) {
        rhw_memory_release(&context->memory, pass->transient_colors[i].plane.texels,
                           pass->transient_colors[i].size);
    }
    rhw_memory_release(&context->memory, pass->transient_depth.plane.texels, pass->transient_depth.size);
    rhw_memory_release(&context->memory, pass->transient_stencil.plane.texels, pass->transient_stencil.size);
}

static size_t bin_limit(const struct rhw_pass_state *pass)
{
    return pass->context->bin_memory ? pass->context->bin_memory : default_bin_memory;
}

// Triangles per chunk: at least four chunks for every thread, so that no thread waits long for the last.
static uint64_t chunk_size(const struct rhw_pass_state *pass)
{
    const uint64_t share = pass->triangle_count / (uint64_t)(4 * pass->context->threads) + 1;
    return share < CHUNK_LEAST ? CHUNK_LEAST : share < RHW_CHUNK_TRIANGLES ? share : RHW_CHUNK_TRIANGLES;
}

// Entries in the bins of one chunk. Chunks that are under way when the limit is reached pass it by this much each, all
// threads' together by a quarter. As many as there are tiles must be allowed: one triangle may fill them all.
static uint32_t entries_most(const struct rhw_pass_state *pass)
{
    const size_t share = bin_limit(pass) / (4 * (size_t)pass->context->threads * sizeof(uint16_t));
    const size_t tiles = (size_t)pass->tiles_x * (size_t)pass->tiles_y;
    return share < tiles ? (uint32_t)tiles : share < UINT32_MAX ? (uint32_t)share : UINT32_MAX;
}

static bool add_chunk(struct rhw_pass_state *pass, struct rhw_chunk chunk)
{
    if (pass->chunk_count == pass->chunk_capacity) {
        const int capacity = pass->chunk_capacity == 0 ? 64 : 2 * pass->chunk_capacity;
        struct rhw_chunk *const chunks =
            rhw_memory_allocate(&pass->context->memory, (size_t)capacity * sizeof *chunks, RHW_CACHE_LINE);
        if (!chunks) {
            return false;
        }
        if (pass->chunks) {
            memcpy(chunks, pass->chunks, (size_t)pass->chunk_count * sizeof *chunks);
            rhw_memory_release(&pass->context->memory, pass->chunks,
                               (size_t)pass->chunk_capacity * sizeof *chunks);
        }
        pass->chunks = chunks;
        pass->chunk_capacity = capacity;
    }
    pass->chunks[pass->chunk_count++] = chunk;
    return true;
}

// Where in the line of triangles the next wave starts.
struct position {
    uint64_t triangle;
    uint32_t draw;
};

// Triangles from `at` on that are hidden by the same rule, `most` at most: what differs in it, a background and the model
// before it, would be drawn in order if it were one chunk.
static uint64_t count_of_one_rule(const struct rhw_pass_state *pass, struct position at, uint64_t most)
{
    const struct rhw_draw *draw = rhw_pass_draw_at(pass, at.draw);
    const struct rhw_hidden_rule rule = draw->state->hidden;
    while (rhw_draw_end(draw) - at.triangle < most) {
        const struct rhw_draw *const next = rhw_pass_draw_at(pass, ++at.draw);
        if (!rhw_hidden_rule_equal(next->state->hidden, rule)) {
            return rhw_draw_end(draw) - at.triangle;
        }
        draw = next;
    }
    return most;
}

// Cuts what is left into chunks, as many as a wave takes at most. False when out of memory.
static bool cut_wave(struct rhw_pass_state *pass, struct position at)
{
    // By rules, in a wave: enough for a background, a model, its shadow and what is seen through, while draws of two rules in
    // turn, which would make a chunk each, cost no more than these.
    enum { CUTS = 16 };
    const uint64_t size = pass->chunk_size;
    int cuts = 0;
    pass->chunk_count = 0;
    while (at.triangle < pass->triangle_count && pass->chunk_count < RHW_WAVE_CHUNKS) {
        const uint64_t left = pass->triangle_count - at.triangle;
        const struct rhw_draw *draw = rhw_pass_draw_at(pass, at.draw);
        while (at.triangle >= rhw_draw_end(draw)) {
            draw = rhw_pass_draw_at(pass, ++at.draw);
        }
        const uint64_t most = left < size ? left : size;
        const uint64_t count = cuts < CUTS ? count_of_one_rule(pass, at, most) : most;
        const struct rhw_chunk chunk = {.first = at.triangle, .count = count, .first_draw = at.draw};
        cuts += count < most;
        if (!add_chunk(pass, chunk)) {
            return false;
        }
        at.triangle += chunk.count;
    }
    return true;
}

static void end_wave(struct rhw_pass_state *pass, int end)
{
    int old = atomic_load(&pass->wave_end);
    while (old > end && !atomic_compare_exchange_weak(&pass->wave_end, &old, end)) {
    }
}

// Asks the program on its own thread, worker 0; the others hear of it.
static bool is_given_up(rhw_context *context, int worker)
{
    if (!context->goes_on) {
        return false;
    }
    if (atomic_load_explicit(&context->given_up, memory_order_relaxed)) {
        return true;
    }
    const bool given_up = worker == 0 && !context->goes_on(context->goes_on_user);
    if (given_up) {
        atomic_store_explicit(&context->given_up, true, memory_order_relaxed);
    }
    return given_up;
}

// Chunks are claimed in order. The wave ends before the first that finds the memory used up, or behind the first whose
// bins were too large for all of its triangles; what others make of later chunks meanwhile is made again.
static void run_chunk(void *user, int index, int worker)
{
    struct rhw_pass_state *const pass = user;
    struct rhw_chunk *const chunk = &pass->chunks[index];
    const struct rhw_arena *const arena = &pass->workers[worker].arena;
    if (index >= atomic_load_explicit(&pass->wave_end, memory_order_relaxed) ||
        is_given_up(pass->context, worker)) {
        return;
    }
    if (index != 0 && atomic_load_explicit(&pass->geometry, memory_order_relaxed) >= bin_limit(pass)) {
        end_wave(pass, index);
        return;
    }
    const size_t used = rhw_arena_used(arena);
    const uint64_t count = chunk->count;
    if (!pass->context->kernels->chunk(pass, chunk, worker)) {
        pass->failed = true;
    }
    atomic_fetch_add_explicit(&pass->geometry, rhw_arena_used(arena) - used, memory_order_relaxed);
    if (chunk->count < count) {
        end_wave(pass, index + 1);
    }
}

struct parts_task {
    struct rhw_pass_state *pass;
    const struct rhw_shared_part *parts;
};

static void run_part(void *user, int index, int worker)
{
    const struct parts_task *const task = user;
    if (!is_given_up(task->pass->context, worker)) {
        task->pass->context->kernels->shared_part(task->pass, &task->parts[index], worker);
    }
}

static void run_parts(struct rhw_pass_state *pass, const struct rhw_shared_parts *parts,
                      struct rhw_stats *stats)
{
    struct parts_task task = {pass, parts->parts};
    stats->vertices_shaded += parts->vertices;
    if (parts->count != 0) {
        stats->front_busy_ms +=
            milliseconds(rhw_scheduler_run(pass->context->scheduler, run_part, &task, parts->count));
    }
}

// Shades the vertices that the wave's chunks share. False when out of memory.
static bool shade_shared_vertices(struct rhw_pass_state *pass, struct rhw_stats *stats)
{
    struct rhw_shared_parts wave;
    if (!rhw_shared_vertices_find(pass, bin_limit(pass) / 4, &wave)) {
        return false;
    }
    pass->geometry = wave.bytes;
    run_parts(pass, &wave, stats);
    return true;
}

// The same for vertices that are shaded first, of all waves, and what follows from them. False when out of memory or given
// up.
static bool shade_first_vertices(struct rhw_pass_state *pass, struct rhw_stats *stats)
{
    struct rhw_shared_parts parts;
    const uint64_t start = rhw_time_ns();
    if (!pass->shades_first) {
        return true;
    }
    if (!rhw_effect_vertices_find(pass, &parts)) {
        return false;
    }
    run_parts(pass, &parts, stats);
    if (atomic_load(&pass->context->given_up)) {
        return false;
    }
    rhw_strip_stipple_measure(pass);
    stats->front_ms += milliseconds(rhw_time_ns() - start);
    return true;
}

static void draw_tile(struct rhw_pass_state *pass, int tile, int worker)
{
    const uint64_t start = pass->tile_reports ? rhw_time_ns() : 0;
    pass->context->kernels->tile(pass, tile, worker);
    if (pass->tile_reports) {
        pass->tile_reports[tile].busy_ms += milliseconds(rhw_time_ns() - start);
    }
}

// Every worker has tiles of its own, the same in every frame, and takes those of others when it has none left: memory
// that the same core wrote last costs half as much to write again. There are as many calls as tiles, so each call finds
// one: what others took before it is less than all.
static void run_tile(void *user, int index, int worker)
{
    struct rhw_pass_state *const pass = user;
    const int threads = pass->context->threads;
    (void)index;
    if (is_given_up(pass->context, worker)) {
        return;
    }
    for (int i = 0; i < threads; i++) {
        struct rhw_worker *const owner = &pass->workers[(worker + i) % threads];
        if (atomic_load_explicit(&owner->next_tile, memory_order_relaxed) >= owner->end_tile) {
            continue;
        }
        const int tile = atomic_fetch_add_explicit(&owner->next_tile, 1, memory_order_relaxed);
        if (tile < owner->end_tile) {
            draw_tile(pass, tile, worker);
            return;
        }
    }
}

static uint64_t run_tiles(struct rhw_pass_state *pass)
{
    struct rhw_context *const context = pass->context;
    const int tiles = pass->tiles_x * pass->tiles_y * pass->layers;
    for (int i = 0; i < context->threads; i++) {
        pass->workers[i].next_tile = (int)((int64_t)tiles * i / context->threads);
        pass->workers[i].end_tile = (int)((int64_t)tiles * (i + 1) / context->threads);
    }
    return rhw_scheduler_run(context->scheduler, run_tile, pass, tiles);
}

static void sum_front(const struct rhw_pass_state *pass, struct rhw_stats *stats)
{
    for (int i = 0; i < pass->chunk_count; i++) {
        const struct rhw_front_counters *const c = &pass->chunks[i].counters;
        stats->vertices_shaded += c->vertices_shaded;
        stats->triangles_dropped += c->dropped;
        stats->triangles_clipped += c->clipped;
        stats->triangles_culled += c->culled;
        stats->triangles_rasterized += c->rasterized;
        stats->bin_entries += c->entries;
        for (int n = 0; n < pass->chunks[i].counted_count; n++) {
            const struct rhw_counted_run *const run = &pass->chunks[i].counted[n];
            run->queries->of[RHW_QUERY_STATISTICS]->counts.statistics.clipping_primitives +=
                run->clipping_primitives;
        }
    }
}

// Runs the front end over the next wave, which starts at `at` and moves it to where it ended. Where that is may depend
// on the threads; what is drawn does not depend on waves. False when out of memory or given up.
static bool run_front(struct rhw_pass_state *pass, struct position *at, struct rhw_stats *stats)
{
    struct rhw_context *const context = pass->context;
    for (int i = 0; i < context->threads; i++) {
        rhw_arena_reset(&pass->workers[i].arena);
    }
    if (!cut_wave(pass, *at) || !shade_shared_vertices(pass, stats)) {
        return false;
    }
    pass->wave_end = pass->chunk_count;
    pass->failed = false;
    stats->front_busy_ms +=
        milliseconds(rhw_scheduler_run(context->scheduler, run_chunk, pass, pass->chunk_count));
    if (pass->failed || atomic_load(&context->given_up)) {
        return false;
    }
    pass->chunk_count = pass->wave_end;
    if (pass->chunk_count != 0) {
        const struct rhw_chunk *const last = &pass->chunks[pass->chunk_count - 1];
        *at = (struct position){last->first + last->count, last->first_draw};
    }
    const size_t geometry = pass->geometry;
    stats->geometry_peak = geometry > stats->geometry_peak ? geometry : stats->geometry_peak;
    sum_front(pass, stats);
    return true;
}

// Memory for what has no texture, needed only when a second wave must find it again; nobody looks for what is left out.
// False when out of memory.
static bool transient_ready(struct rhw_pass_state *pass, struct rhw_attachment *attachment,
                            struct rhw_transient *transient)
{
    struct rhw_memory *const memory = &pass->context->memory;
    if (attachment->target || attachment->is_read_only || attachment->is_left_out) {
        return true;
    }
    const size_t row = (size_t)pass->width * attachment->texel_size;
    const size_t pitch = (row + RHW_CACHE_LINE - 1) & ~(size_t)(RHW_CACHE_LINE - 1);
    const uint64_t plane = (uint64_t)pitch * (uint64_t)pass->height,
                   slice = plane * (uint64_t)pass->pattern->count;
    const uint64_t all = slice * (uint64_t)pass->layers;
    if (all > SIZE_MAX) {
        return false;
    }
    const size_t size = (size_t)all;
    if (transient->size < size) {
        rhw_memory_release(memory, transient->plane.texels, transient->size);
        *transient =
            (struct rhw_transient){.plane.texels = rhw_memory_allocate(memory, size, RHW_CACHE_LINE)};
        if (!transient->plane.texels) {
            return false;
        }
        transient->size = size;
    }
    transient->plane.row_pitch = pitch;
    transient->plane.slice_pitch = (size_t)slice;
    attachment->target = &transient->plane;
    attachment->sample_stride = pass->pattern->count > 1 ? (size_t)plane : 0;
    return true;
}

static bool transients_ready(struct rhw_pass_state *pass)
{
    bool ready = true;
    for (int i = 0; i < pass->color_count; i++) {
        ready = ready && transient_ready(pass, &pass->colors[i], &pass->transient_colors[i]);
    }
    return ready && (!pass->has_depth || transient_ready(pass, &pass->depth, &pass->transient_depth)) &&
           (!pass->has_stencil || transient_ready(pass, &pass->stencil, &pass->transient_stencil));
}

static void sum_counters(const struct rhw_pass_state *pass, struct rhw_stats *stats)
{
    for (int i = 0; i < pass->context->threads; i++) {
        const struct rhw_counters *const c = &pass->workers[i].counters;
        stats->fragments_shaded += c->fragments;
        stats->fragment_groups += c->groups;
        stats->vertex_busy_ms += milliseconds(c->vertex_ns);
        stats->setup_busy_ms += milliseconds(c->setup_ns);
        stats->bin_busy_ms += milliseconds(c->bin_ns);
    }
}

static enum rhw_result failure(const rhw_context *context)
{
    return atomic_load(&context->given_up) ? RHW_ERROR_GIVEN_UP : RHW_ERROR_OUT_OF_MEMORY;
}

static void expect_clean(struct rhw_attachment *attachment)
{
    if (attachment->load != RHW_LOAD_LOAD) {
        rhw_clean_tiles_expect(attachment->clean, attachment->clear);
        rhw_clean_tiles_expect(attachment->resolve_clean, attachment->clear);
    }
}

// Draws the next wave, as run_front finds it. False when out of memory or given up.
static bool run_wave(struct rhw_pass_state *pass, struct position *at, struct rhw_stats *stats)
{
    struct rhw_context *const context = pass->context;
    const uint64_t start = rhw_time_ns();
    if (!run_front(pass, at, stats)) {
        return false;
    }
    pass->last_wave = at->triangle == pass->triangle_count;
    if (!pass->last_wave && !transients_ready(pass)) {
        return false;
    }
    const uint64_t middle = rhw_time_ns();
    if (is_given_up(context, 0)) { // the caller may get no tile, where others are quick
        return false;
    }
    stats->back_busy_ms += milliseconds(run_tiles(pass));
    if (atomic_load(&context->given_up)) {
        return false;
    }
    stats->front_ms += milliseconds(middle - start);
    stats->back_ms += milliseconds(rhw_time_ns() - middle);
    stats->flushes += !pass->last_wave;
    rhw_queries_stamp(pass, at->triangle);
    pass->first_wave = false;
    return true;
}

enum rhw_result rhw_pass_run(struct rhw_pass_state *pass, struct rhw_stats *stats)
{
    struct rhw_context *const context = pass->context;
    if (!workers_ready(pass)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    struct rhw_stats s = {.record_ms = milliseconds(rhw_time_ns() - pass->begun_ns),
                          .draws = pass->draws.count,
                          .triangles_in = pass->triangle_count,
                          .threads = context->threads,
                          .tiles = pass->tiles_x * pass->tiles_y * pass->layers,
                          .isa = context->isa};
    struct position at = {0, 0};
    pass->chunk_size = chunk_size(pass);
    pass->entries_most = entries_most(pass);
    for (int i = 0; i < pass->color_count; i++) {
        expect_clean(&pass->colors[i]);
    }
    expect_clean(&pass->depth);
    pass->first_wave = true;
    atomic_store(&context->given_up, false);
    rhw_queries_stamp(pass, 0);
    if (!shade_first_vertices(pass, &s)) {
        return failure(context);
    }
    do {
        if (!run_wave(pass, &at, &s)) {
            return failure(context);
        }
    } while (!pass->last_wave);
    sum_counters(pass, &s);
    s.memory_peak = context->memory.peak;
    if (stats) {
        *stats = s;
    }
    return RHW_OK;
}
