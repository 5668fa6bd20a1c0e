// SPDX-License-Identifier: MIT
// A pass runs in waves: as many chunks as the bin memory holds go through the front end, then every tile draws them.
// Most passes are one wave. A pass that is larger than the bins loads and stores its tiles between waves. Its geometry
// therefore stays bounded whatever is drawn: by the bin memory, a quarter of it more for the bins of the last chunks,
// and a few megabytes per thread.
#include "run.h"

#include <string.h>

#include "base/scheduler.h"
#include "base/thread.h"
#include "context/context.h"
#include "context/given_up.h"
#include "resource/bound_texels.h"
#include "draw/used_query.h"
#include "draw/wave.h"
#include "effect_vertices.h"
#include "executor.h"
#include "kept_triangles.h"
#include "kernels/kernels.h"
#include "strip_stipple.h"
#include "vertex_sharing.h"

static const size_t default_bin_memory = (size_t)512 << 20; // bytes

// A chunk has at least this many triangles: binning a smaller one costs as much as its triangles.
enum { CHUNK_LEAST = 128 };

static double milliseconds(uint64_t ns)
{
    return (double)ns * 1e-6;
}

// Return the bytes that the bins of a wave may take. Where the order of a pass would show, its waves are the same in
// every context.
static size_t bin_limit(const struct rhw_executor *executor)
{
    const bool is_chosen = executor->context->bin_memory != 0 && !executor->wave.pass->shows_order;
    return is_chosen ? executor->context->bin_memory : default_bin_memory;
}

// Return how many threads run the pass. A pass whose order would show runs as it does in a context with one thread.
static int threads_of(const struct rhw_executor *executor)
{
    return executor->wave.pass->shows_order ? 1 : executor->context->threads;
}

struct serial_tasks {
    rhw_task_function *task;
    void *user;
    int count;
};

static void run_serially(void *user, int index, int worker)
{
    const struct serial_tasks *const tasks = user;
    (void)index;
    for (int i = 0; i < tasks->count; i++) {
        tasks->task(tasks->user, i, worker);
    }
}

// Run tasks on the threads of the pass. Return the nanoseconds that they took, summed over the threads.
static uint64_t run_tasks(const struct rhw_executor *executor, rhw_task_function *task, void *user, int count)
{
    struct rhw_scheduler *const scheduler = executor->context->scheduler;
    struct serial_tasks serial = {task, user, count};
    return executor->wave.pass->shows_order ? rhw_scheduler_run(scheduler, run_serially, &serial, 1)
                                            : rhw_scheduler_run(scheduler, task, user, count);
}

// Return the triangles of a chunk: every thread gets at least four chunks, so that no thread waits long for the last.
static uint64_t chunk_size(const struct rhw_executor *executor)
{
    const uint64_t share = executor->wave.pass->triangle_count / (uint64_t)(4 * threads_of(executor)) + 1;
    return share < CHUNK_LEAST ? CHUNK_LEAST : share < RHW_CHUNK_TRIANGLES ? share : RHW_CHUNK_TRIANGLES;
}

// Return how many entries the bins of one chunk may have. A chunk that is under way when the memory is used up exceeds
// the limit by this much, and the chunks of all threads together exceed it by a quarter. A chunk may always have as
// many entries as there are tiles, because one triangle may fill them all.
static uint32_t entries_most(const struct rhw_executor *executor)
{
    const size_t share = bin_limit(executor) / (4 * (size_t)threads_of(executor) * sizeof(uint16_t));
    const size_t tiles = (size_t)executor->wave.target.tiles_x * (size_t)executor->wave.target.tiles_y;
    return share < tiles ? (uint32_t)tiles : share < UINT32_MAX ? (uint32_t)share : UINT32_MAX;
}

static bool add_chunk(struct rhw_executor *executor, struct rhw_chunk chunk)
{
    struct rhw_memory *const memory = &executor->context->memory;
    struct rhw_wave *const wave = &executor->wave;
    if (wave->chunk_count == executor->chunk_capacity) {
        const int capacity = executor->chunk_capacity == 0 ? 64 : 2 * executor->chunk_capacity;
        struct rhw_chunk *const chunks =
            rhw_memory_allocate(memory, (size_t)capacity * sizeof *chunks, RHW_CACHE_LINE);
        if (!chunks) {
            return false;
        }
        if (wave->chunks) {
            memcpy(chunks, wave->chunks, (size_t)wave->chunk_count * sizeof *chunks);
            rhw_memory_release(memory, wave->chunks, (size_t)executor->chunk_capacity * sizeof *chunks);
        }
        wave->chunks = chunks;
        executor->chunk_capacity = capacity;
    }
    wave->chunks[wave->chunk_count++] = chunk;
    return true;
}

// This is where the next wave starts in the line of triangles.
struct position {
    uint64_t triangle;
    uint32_t draw;
};

// Return how many triangles from `at` on are hidden by one rule, `most` at most. A background and the model in front of
// it differ in their rule, and one chunk of both would be drawn in order.
static uint64_t count_of_one_rule(const struct rhw_draw_list *draws, struct position at, uint64_t most)
{
    const struct rhw_draw *draw = rhw_draw_list_at(draws, at.draw);
    const struct rhw_hidden_rule rule = draw->state->hidden;
    while (rhw_draw_end(draw) - at.triangle < most) {
        const struct rhw_draw *const next = rhw_draw_list_at(draws, ++at.draw);
        if (!rhw_hidden_rule_equal(next->state->hidden, rule)) {
            return rhw_draw_end(draw) - at.triangle;
        }
        draw = next;
    }
    return most;
}

// Cut the rest of the pass into chunks, as many as a wave takes at most. Return false when out of memory.
static bool cut_wave(struct rhw_executor *executor, struct position at)
{
    // A wave is cut by rules this many times at most. It is enough for a background, a model, its shadow and
    // transparent parts, while draws of two rules in turn, each of which would make a chunk, cost no more than a scene
    // like that.
    enum { CUTS = 16 };
    const struct rhw_recorded_pass *const pass = executor->wave.pass;
    const uint64_t size = executor->chunk_size;
    int cuts = 0;
    executor->wave.chunk_count = 0;
    while (at.triangle < pass->triangle_count && executor->wave.chunk_count < RHW_WAVE_CHUNKS) {
        const uint64_t left = pass->triangle_count - at.triangle;
        const struct rhw_draw *draw = rhw_draw_list_at(&pass->draws, at.draw);
        while (at.triangle >= rhw_draw_end(draw)) {
            draw = rhw_draw_list_at(&pass->draws, ++at.draw);
        }
        const uint64_t most = left < size ? left : size;
        const uint64_t count = cuts < CUTS ? count_of_one_rule(&pass->draws, at, most) : most;
        const struct rhw_chunk chunk = {.first = at.triangle, .count = count, .first_draw = at.draw};
        cuts += count < most;
        if (!add_chunk(executor, chunk)) {
            return false;
        }
        at.triangle += chunk.count;
    }
    return true;
}

static void end_wave(struct rhw_executor *executor, int end)
{
    int old = atomic_load(&executor->wave_end);
    while (old > end && !atomic_compare_exchange_weak(&executor->wave_end, &old, end)) {
    }
}

// Run the front end over one chunk. Chunks are claimed in order. The wave ends before the first chunk that finds the
// memory used up, or behind the first chunk whose bins were too large for all of its triangles. What other threads make
// of later chunks meanwhile is made again.
static void run_chunk(void *user, int index, int worker)
{
    struct rhw_executor *const executor = user;
    struct rhw_chunk *const chunk = &executor->wave.chunks[index];
    const struct rhw_arena *const arena = &executor->wave.workers[worker].arena;
    if (index >= atomic_load_explicit(&executor->wave_end, memory_order_relaxed) ||
        rhw_context_is_given_up(executor->context, worker)) {
        return;
    }
    if (index != 0 &&
        atomic_load_explicit(&executor->geometry, memory_order_relaxed) >= bin_limit(executor)) {
        end_wave(executor, index);
        return;
    }
    const size_t used = rhw_arena_used(arena);
    const uint64_t count = chunk->count;
    if (!executor->context->kernels->chunk(&executor->wave, chunk, worker)) {
        executor->failed = true;
    }
    atomic_fetch_add_explicit(&executor->geometry, rhw_arena_used(arena) - used, memory_order_relaxed);
    if (chunk->count < count) {
        end_wave(executor, index + 1);
    }
}

struct parts_task {
    struct rhw_executor *executor;
    const struct rhw_shared_part *parts;
};

static void run_part(void *user, int index, int worker)
{
    const struct parts_task *const task = user;
    if (!rhw_context_is_given_up(task->executor->context, worker)) {
        task->executor->context->kernels->shared_part(&task->executor->wave, &task->parts[index], worker);
    }
}

// Shade the vertices of the parts. Return false when out of memory.
static bool run_parts(struct rhw_executor *executor, const struct rhw_shared_parts *parts,
                      struct rhw_stats *stats)
{
    struct parts_task task = {executor, parts->parts};
    stats->vertices_shaded += parts->vertices;
    if (parts->count == 0) {
        return true;
    }
    if (!rhw_executor_front_ready(executor, parts->count)) {
        return false;
    }
    stats->front_busy_ms += milliseconds(run_tasks(executor, run_part, &task, parts->count));
    return true;
}

// Shade the vertices that the wave's chunks share. Return false when out of memory.
static bool shade_shared_vertices(struct rhw_executor *executor, struct rhw_stats *stats)
{
    struct rhw_shared_parts parts;
    if (!rhw_shared_vertices_find(&executor->wave, executor->chunk_size, bin_limit(executor) / 4, &parts)) {
        return false;
    }
    executor->geometry = parts.bytes;
    return run_parts(executor, &parts, stats);
}

// Shade the vertices of all waves that are shaded before the first, and measure the lines that wait for them. Return
// false when out of memory or given up.
static bool shade_first_vertices(struct rhw_executor *executor, struct rhw_stats *stats)
{
    const struct rhw_recorded_pass *const pass = executor->wave.pass;
    struct rhw_arena *const arena = &executor->wave.workers[0].arena;
    struct rhw_shared_parts parts;
    const uint64_t start = rhw_time_ns();
    if (!pass->shades_first) {
        return true;
    }
    rhw_arena_reset(arena);
    if (!rhw_effect_vertices_find(pass, arena, &parts) || !run_parts(executor, &parts, stats)) {
        return false;
    }
    if (atomic_load(&executor->context->given_up)) {
        return false;
    }
    rhw_strip_stipple_measure(pass);
    stats->front_ms += milliseconds(rhw_time_ns() - start);
    return true;
}

static void draw_tile(struct rhw_executor *executor, int tile, int worker)
{
    struct rhw_tile_report *const reports = executor->wave.pass->tile_reports;
    const uint64_t start = reports ? rhw_time_ns() : 0;
    executor->context->kernels->tile(&executor->wave, tile, worker);
    if (reports) {
        reports[tile].busy_ms += milliseconds(rhw_time_ns() - start);
    }
}

// Draw one tile. Every worker has its own tiles, which are the same in every frame that has a tile for each thread, and
// takes tiles of others when it has none left: memory that the same core wrote last costs half as much to write again.
// There are as many calls as tiles, so that each call finds a tile: fewer than all were taken before it.
static void run_tile(void *user, int index, int worker)
{
    struct rhw_executor *const executor = user;
    const int threads = threads_of(executor);
    (void)index;
    if (rhw_context_is_given_up(executor->context, worker)) {
        return;
    }
    for (int i = 0; i < threads; i++) {
        struct tile_share *const share = &executor->shares[(worker + i) % threads];
        if (atomic_load_explicit(&share->next, memory_order_relaxed) >= share->end) {
            continue;
        }
        const int tile = atomic_fetch_add_explicit(&share->next, 1, memory_order_relaxed);
        if (tile < share->end) {
            draw_tile(executor, tile, worker);
            return;
        }
    }
}

static uint64_t run_tiles(struct rhw_executor *executor)
{
    const int threads = threads_of(executor), tiles = rhw_target_tiles(&executor->wave.target);
    for (int i = 0; i < threads; i++) {
        executor->shares[i].next = (int)((int64_t)tiles * i / threads);
        executor->shares[i].end = (int)((int64_t)tiles * (i + 1) / threads);
    }
    return run_tasks(executor, run_tile, executor, tiles);
}

static void sum_front(const struct rhw_executor *executor, struct rhw_stats *stats)
{
    for (int i = 0; i < executor->wave.chunk_count; i++) {
        const struct rhw_front_counters *const c = &executor->wave.chunks[i].counters;
        stats->vertices_shaded += c->vertices_shaded;
        stats->triangles_dropped += c->dropped;
        stats->triangles_clipped += c->clipped;
        stats->triangles_culled += c->culled;
        stats->triangles_rasterized += c->rasterized;
        stats->bin_entries += c->entries;
        for (int n = 0; n < executor->wave.chunks[i].counted_count; n++) {
            const struct rhw_counted_run *const run = &executor->wave.chunks[i].counted[n];
            run->queries->of[RHW_QUERY_STATISTICS]->counts.statistics.clipping_primitives +=
                run->clipping_primitives;
        }
    }
}

// Run the front end over the next wave, which starts at `at`, and move `at` to where the wave ended. The threads may
// decide where it ends; the picture does not depend on waves. Return false when out of memory or given up.
static bool run_front(struct rhw_executor *executor, struct position *at, struct rhw_stats *stats)
{
    struct rhw_context *const context = executor->context;
    for (int i = 0; i < context->threads; i++) {
        rhw_arena_reset(&executor->wave.workers[i].arena);
    }
    if (!cut_wave(executor, *at) || !shade_shared_vertices(executor, stats) ||
        !rhw_executor_front_ready(executor, executor->wave.chunk_count)) {
        return false;
    }
    executor->wave_end = executor->wave.chunk_count;
    executor->failed = false;
    stats->front_busy_ms +=
        milliseconds(run_tasks(executor, run_chunk, executor, executor->wave.chunk_count));
    if (executor->failed || atomic_load(&context->given_up)) {
        return false;
    }
    executor->wave.chunk_count = executor->wave_end;
    if (executor->wave.chunk_count != 0) {
        const struct rhw_chunk *const last = &executor->wave.chunks[executor->wave.chunk_count - 1];
        *at = (struct position){last->first + last->count, last->first_draw};
    }
    const size_t geometry = executor->geometry;
    stats->geometry_peak = geometry > stats->geometry_peak ? geometry : stats->geometry_peak;
    sum_front(executor, stats);
    return true;
}

static void sum_counters(const struct rhw_executor *executor, struct rhw_stats *stats)
{
    for (int i = 0; i < executor->context->threads; i++) {
        const struct rhw_counters *const c = &executor->wave.workers[i].counters;
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

// Tell timestamps that `triangles` of the pass are drawn by now.
static void stamp_queries(const struct rhw_recorded_pass *pass, uint64_t triangles)
{
    for (struct rhw_used_query *query = pass->queries; query; query = query->next) {
        struct rhw_query_counts *const counts = &query->counts;
        if (query->kind == RHW_QUERY_TIMESTAMP && counts->timestamp_ns == 0 && query->place <= triangles) {
            counts->timestamp_ns = rhw_time_ns();
        }
    }
}

static void expect_clean(struct rhw_attachment *attachment)
{
    if (attachment->load != RHW_LOAD_LOAD) {
        rhw_clean_tiles_expect(attachment->clean, attachment->clear);
        rhw_clean_tiles_expect(attachment->resolve_clean, attachment->clear);
    }
}

// Return true if the wave has the triangles of all of the pass, which an earlier run made.
static bool takes_kept(struct rhw_executor *executor, struct position *at, struct rhw_stats *stats)
{
    const struct rhw_recorded_pass *const pass = executor->wave.pass;
    if (!pass->kept || !pass->kept->is_used) {
        return false;
    }
    for (int i = 0; i < executor->context->threads; i++) {
        rhw_arena_reset(&executor->wave.workers[i].arena);
    }
    *at = (struct position){pass->triangle_count, pass->draws.count};
    sum_front(executor, stats);
    stats->vertices_shaded = 0;
    return true;
}

// Draw the next wave, as run_front finds it. Return false when out of memory or given up.
static bool run_wave(struct rhw_executor *executor, struct position *at, struct rhw_stats *stats)
{
    struct rhw_context *const context = executor->context;
    const uint64_t start = rhw_time_ns();
    const bool is_made = executor->wave.is_first && takes_kept(executor, at, stats);
    if ((!is_made && !run_front(executor, at, stats)) || !rhw_executor_tiles_ready(executor)) {
        return false;
    }
    executor->wave.is_last = at->triangle == executor->wave.pass->triangle_count;
    if (!executor->wave.is_last && !rhw_executor_transients_ready(executor)) {
        return false;
    }
    const uint64_t middle = rhw_time_ns();
    // The caller may have got no tile, where other threads were quick.
    if (rhw_context_is_given_up(context, 0)) {
        return false;
    }
    stats->back_busy_ms += milliseconds(run_tiles(executor));
    if (atomic_load(&context->given_up)) {
        return false;
    }
    stats->front_ms += milliseconds(middle - start);
    stats->back_ms += milliseconds(rhw_time_ns() - middle);
    stats->flushes += !executor->wave.is_last;
    stamp_queries(executor->wave.pass, at->triangle);
    executor->wave.is_first = false;
    return true;
}

// Make the first wave of a pass, without chunks.
static void start_pass(struct rhw_executor *executor, struct rhw_recorded_pass *pass)
{
    struct rhw_wave *const wave = &executor->wave;
    wave->pass = pass;
    wave->asked = executor->context->goes_on ? executor->context : NULL;
    wave->target = pass->target;
    wave->is_first = true;
    wave->entries_most = entries_most(executor);
    executor->chunk_size = chunk_size(executor);
}

// Return the statistics that are known before anything runs.
static struct rhw_stats stats_of(const struct rhw_executor *executor)
{
    const struct rhw_context *const context = executor->context;
    const struct rhw_recorded_pass *const pass = executor->wave.pass;
    return (struct rhw_stats){.record_ms = milliseconds(rhw_time_ns() - pass->begun_ns),
                              .draws = pass->draws.count,
                              .triangles_in = pass->triangle_count,
                              .threads = threads_of(executor),
                              .tiles = rhw_target_tiles(&pass->target),
                              .isa = context->isa};
}

// Draw all waves of a pass. Return false when out of memory or given up.
static bool run_waves(struct rhw_executor *executor, struct rhw_stats *stats)
{
    struct position at = {0, 0};
    if (!shade_first_vertices(executor, stats)) {
        return false;
    }
    do {
        if (!run_wave(executor, &at, stats)) {
            return false;
        }
    } while (!executor->wave.is_last);
    return true;
}

enum rhw_result rhw_executor_run(struct rhw_executor *executor, struct rhw_recorded_pass *pass,
                                 struct rhw_stats *stats)
{
    struct rhw_context *const context = executor->context;
    struct rhw_wave *const wave = &executor->wave;
    start_pass(executor, pass);
    const enum rhw_result prepared = rhw_bound_texels_prepare(context);
    if (prepared != RHW_OK) {
        return prepared;
    }
    if (!rhw_executor_arenas_ready(executor)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    for (int i = 0; i < context->threads; i++) {
        wave->workers[i].counters = (struct rhw_counters){0};
    }
    struct rhw_stats s = stats_of(executor);
    for (int i = 0; i < wave->target.color_count; i++) {
        expect_clean(&wave->target.colors[i]);
    }
    expect_clean(&wave->target.depth);
    rhw_context_begin_work(context);
    stamp_queries(pass, 0);
    if (pass->kept) {
        rhw_kept_triangles_begin(pass->kept, wave);
    }
    const bool is_done = run_waves(executor, &s);
    if (pass->kept) {
        // Every wave but the last is a flush.
        rhw_kept_triangles_end(pass->kept, wave, is_done && s.flushes == 0);
    }
    if (!is_done) {
        return failure(context);
    }
    sum_counters(executor, &s);
    s.memory_peak = context->memory.peak;
    if (stats) {
        *stats = s;
    }
    return RHW_OK;
}
