// SPDX-License-Identifier: MIT
// A pass runs in waves: as many chunks as the bin memory holds go through the front end, then every tile draws them.
// Most passes are one wave. A pass that is larger than the bins loads and stores its tiles between waves. Its geometry
// therefore stays bounded whatever is drawn: by the bin memory, a quarter of it more for the bins of the last chunks,
// and a few megabytes per thread.
#include "run.h"

#include <string.h>

#include "context/context.h"
#include "effect_vertices.h"
#include "kernels/geometry/geometry_scratch.h"
#include "kernels/kernels.h"
#include "kernels/tile_work.h"
#include "draw/used_query.h"
#include "draw/wave.h"
#include "base/scheduler.h"
#include "vertex_sharing.h"
#include "strip_stipple.h"
#include "base/thread.h"

// A transient keeps an attachment without a texture between waves.
struct transient {
    struct rhw_mip plane;
    size_t size; // bytes that plane.texels has
};

// These are the tiles that a worker begins with. The worker writes them, and so do others that have no tiles left of
// their own. The structure is padded so that no two workers share a cache line.
struct tile_share {
    _Alignas(RHW_CACHE_LINE) _Atomic int next;
    int end; // exclusive
};

struct rhw_executor {
    struct rhw_context *context;
    struct rhw_wave wave; // the wave under way
    int chunk_capacity;
    uint64_t chunk_size;       // most triangles of a chunk
    struct tile_share *shares; // a share for each worker
    struct transient colors[RHW_MAX_COLOR_ATTACHMENTS], depth, stencil;

    // Workers write these members for every chunk, and read them when they look for the next chunk.
    _Alignas(RHW_CACHE_LINE) _Atomic size_t geometry; // bytes that the wave's chunks took
    _Atomic int wave_end;                             // first chunk that waits for the next wave
    _Atomic bool failed;                              // a worker ran out of memory
};

static const size_t default_bin_memory = (size_t)512 << 20; // bytes

// A chunk has at least this many triangles: binning a smaller one costs as much as its triangles.
enum { CHUNK_LEAST = 128 };

static double milliseconds(uint64_t ns)
{
    return (double)ns * 1e-6;
}

// Set the scratch to zero, except for the table of lanes and what an empty queue says of its groups.
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

// Give the worker memory for all samples of a tile but the first. Memory that a pass does not draw into is never
// touched. Return false when out of memory.
static bool sample_tiles_ready(const struct rhw_executor *executor, struct rhw_worker *worker)
{
    struct rhw_memory *const memory = &executor->context->memory;
    const int wanted = executor->wave.target.pattern->count - 1;
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

// Set what stays from frame to frame: an empty table of vertices, and where groups of vertices have their distances.
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

// Make the workers, with nothing but their arenas. Return false when out of memory.
static bool make_workers(struct rhw_executor *executor)
{
    struct rhw_memory *const memory = &executor->context->memory;
    const size_t threads = (size_t)executor->context->threads;
    if (!executor->shares) {
        executor->shares = rhw_memory_allocate(memory, threads * sizeof *executor->shares, RHW_CACHE_LINE);
    }
    struct rhw_worker *const workers =
        executor->shares ? rhw_memory_allocate(memory, threads * sizeof *workers, RHW_CACHE_LINE) : NULL;
    if (!workers) {
        return false;
    }
    memset(workers, 0, threads * sizeof *workers);
    for (size_t i = 0; i < threads; i++) {
        rhw_arena_init(&workers[i].arena, memory);
    }
    executor->wave.workers = workers;
    return true;
}

// Give a worker the memory that the wave's pass needs. Return false when out of memory.
static bool worker_ready(const struct rhw_executor *executor, struct rhw_worker *worker)
{
    struct rhw_memory *const memory = &executor->context->memory;
    if (!worker->geometry) {
        worker->geometry = rhw_memory_allocate(memory, sizeof *worker->geometry, 4096);
        if (!worker->geometry) {
            return false;
        }
        init_geometry_scratch(worker->geometry);
    }
    if (!worker->tile) {
        worker->tile = rhw_memory_allocate(memory, sizeof *worker->tile, 4096);
        if (!worker->tile) {
            return false;
        }
        init_tile_scratch(worker->tile);
    }
    worker->counters = (struct rhw_counters){0};
    return sample_tiles_ready(executor, worker);
}

static bool workers_ready(struct rhw_executor *executor)
{
    bool ready = executor->wave.workers || make_workers(executor);
    for (int i = 0; ready && i < executor->context->threads; i++) {
        ready = worker_ready(executor, &executor->wave.workers[i]);
    }
    return ready;
}

struct rhw_executor *rhw_executor_create(struct rhw_context *context)
{
    struct rhw_executor *const executor =
        rhw_memory_allocate(&context->memory, sizeof *executor, RHW_CACHE_LINE);
    if (executor) {
        memset(executor, 0, sizeof *executor);
        executor->context = context;
    }
    return executor;
}

static void release_worker(struct rhw_memory *memory, struct rhw_worker *worker)
{
    rhw_arena_destroy(&worker->arena);
    rhw_memory_release(memory, worker->geometry, sizeof *worker->geometry);
    rhw_memory_release(memory, worker->tile, sizeof *worker->tile);
    rhw_memory_release(memory, worker->sample_tiles,
                       (size_t)worker->sample_tile_count * sizeof *worker->sample_tiles);
}

static void release_transient(struct rhw_memory *memory, struct transient *transient)
{
    rhw_memory_release(memory, transient->plane.texels, transient->size);
}

void rhw_executor_destroy(struct rhw_executor *executor)
{
    if (!executor) {
        return;
    }
    struct rhw_memory *const memory = &executor->context->memory;
    struct rhw_wave *const wave = &executor->wave;
    const size_t threads = (size_t)executor->context->threads;
    for (size_t i = 0; wave->workers && i < threads; i++) {
        release_worker(memory, &wave->workers[i]);
    }
    rhw_memory_release(memory, wave->workers, threads * sizeof *wave->workers);
    rhw_memory_release(memory, executor->shares, threads * sizeof *executor->shares);
    rhw_memory_release(memory, wave->chunks, (size_t)executor->chunk_capacity * sizeof *wave->chunks);
    for (int i = 0; i < RHW_MAX_COLOR_ATTACHMENTS; i++) {
        release_transient(memory, &executor->colors[i]);
    }
    release_transient(memory, &executor->depth);
    release_transient(memory, &executor->stencil);
    rhw_memory_release(memory, executor, sizeof *executor);
}

static size_t bin_limit(const struct rhw_executor *executor)
{
    return executor->context->bin_memory ? executor->context->bin_memory : default_bin_memory;
}

// Return the triangles of a chunk: every thread gets at least four chunks, so that no thread waits long for the last.
static uint64_t chunk_size(const struct rhw_executor *executor)
{
    const uint64_t share =
        executor->wave.pass->triangle_count / (uint64_t)(4 * executor->context->threads) + 1;
    return share < CHUNK_LEAST ? CHUNK_LEAST : share < RHW_CHUNK_TRIANGLES ? share : RHW_CHUNK_TRIANGLES;
}

// Return how many entries the bins of one chunk may have. A chunk that is under way when the memory is used up exceeds
// the limit by this much, and the chunks of all threads together exceed it by a quarter. A chunk may always have as
// many entries as there are tiles, because one triangle may fill them all.
static uint32_t entries_most(const struct rhw_executor *executor)
{
    const size_t share = bin_limit(executor) / (4 * (size_t)executor->context->threads * sizeof(uint16_t));
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

// Return true if the program gives the pass up. Worker 0 asks it, on the program's own thread; the others hear of it.
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

// Run the front end over one chunk. Chunks are claimed in order. The wave ends before the first chunk that finds the
// memory used up, or behind the first chunk whose bins were too large for all of its triangles. What other threads make
// of later chunks meanwhile is made again.
static void run_chunk(void *user, int index, int worker)
{
    struct rhw_executor *const executor = user;
    struct rhw_chunk *const chunk = &executor->wave.chunks[index];
    const struct rhw_arena *const arena = &executor->wave.workers[worker].arena;
    if (index >= atomic_load_explicit(&executor->wave_end, memory_order_relaxed) ||
        is_given_up(executor->context, worker)) {
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
    if (!is_given_up(task->executor->context, worker)) {
        task->executor->context->kernels->shared_part(&task->executor->wave, &task->parts[index], worker);
    }
}

static void run_parts(struct rhw_executor *executor, const struct rhw_shared_parts *parts,
                      struct rhw_stats *stats)
{
    struct parts_task task = {executor, parts->parts};
    stats->vertices_shaded += parts->vertices;
    if (parts->count != 0) {
        stats->front_busy_ms +=
            milliseconds(rhw_scheduler_run(executor->context->scheduler, run_part, &task, parts->count));
    }
}

// Shade the vertices that the wave's chunks share. Return false when out of memory.
static bool shade_shared_vertices(struct rhw_executor *executor, struct rhw_stats *stats)
{
    struct rhw_shared_parts parts;
    if (!rhw_shared_vertices_find(&executor->wave, executor->chunk_size, bin_limit(executor) / 4, &parts)) {
        return false;
    }
    executor->geometry = parts.bytes;
    run_parts(executor, &parts, stats);
    return true;
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
    if (!rhw_effect_vertices_find(pass, arena, &parts)) {
        return false;
    }
    run_parts(executor, &parts, stats);
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

// Draw one tile. Every worker has its own tiles, which are the same in every frame, and takes tiles of others when it
// has none left: memory that the same core wrote last costs half as much to write again. There are as many calls as
// tiles, so that each call finds a tile: fewer than all were taken before it.
static void run_tile(void *user, int index, int worker)
{
    struct rhw_executor *const executor = user;
    const int threads = executor->context->threads;
    (void)index;
    if (is_given_up(executor->context, worker)) {
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
    struct rhw_context *const context = executor->context;
    const int tiles = rhw_target_tiles(&executor->wave.target);
    for (int i = 0; i < context->threads; i++) {
        executor->shares[i].next = (int)((int64_t)tiles * i / context->threads);
        executor->shares[i].end = (int)((int64_t)tiles * (i + 1) / context->threads);
    }
    return rhw_scheduler_run(context->scheduler, run_tile, executor, tiles);
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
    if (!cut_wave(executor, *at) || !shade_shared_vertices(executor, stats)) {
        return false;
    }
    executor->wave_end = executor->wave.chunk_count;
    executor->failed = false;
    stats->front_busy_ms +=
        milliseconds(rhw_scheduler_run(context->scheduler, run_chunk, executor, executor->wave.chunk_count));
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

// Make memory for an attachment without a texture. It is needed only when a second wave must find the texels again. An
// attachment that is left out needs none, because nobody reads it. Return false when out of memory.
static bool transient_ready(struct rhw_executor *executor, struct rhw_attachment *attachment,
                            struct transient *transient)
{
    const struct rhw_target *const target = &executor->wave.target;
    struct rhw_memory *const memory = &executor->context->memory;
    if (attachment->target || attachment->is_read_only || attachment->is_left_out) {
        return true;
    }
    const size_t row = (size_t)target->width * attachment->texel_size;
    const size_t pitch = (row + RHW_CACHE_LINE - 1) & ~(size_t)(RHW_CACHE_LINE - 1);
    const uint64_t plane = (uint64_t)pitch * (uint64_t)target->height,
                   slice = plane * (uint64_t)target->pattern->count;
    const uint64_t all = slice * (uint64_t)target->layers;
    if (all > SIZE_MAX) {
        return false;
    }
    const size_t size = (size_t)all;
    if (transient->size < size) {
        rhw_memory_release(memory, transient->plane.texels, transient->size);
        *transient = (struct transient){.plane.texels = rhw_memory_allocate(memory, size, RHW_CACHE_LINE)};
        if (!transient->plane.texels) {
            return false;
        }
        transient->size = size;
    }
    transient->plane.row_pitch = pitch;
    transient->plane.slice_pitch = (size_t)slice;
    attachment->target = &transient->plane;
    attachment->sample_stride = target->pattern->count > 1 ? (size_t)plane : 0;
    return true;
}

static bool transients_ready(struct rhw_executor *executor)
{
    struct rhw_target *const target = &executor->wave.target;
    bool ready = true;
    for (int i = 0; i < target->color_count; i++) {
        ready = ready && transient_ready(executor, &target->colors[i], &executor->colors[i]);
    }
    return ready && (!target->has_depth || transient_ready(executor, &target->depth, &executor->depth)) &&
           (!target->has_stencil || transient_ready(executor, &target->stencil, &executor->stencil));
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

// Draw the next wave, as run_front finds it. Return false when out of memory or given up.
static bool run_wave(struct rhw_executor *executor, struct position *at, struct rhw_stats *stats)
{
    struct rhw_context *const context = executor->context;
    const uint64_t start = rhw_time_ns();
    if (!run_front(executor, at, stats)) {
        return false;
    }
    executor->wave.is_last = at->triangle == executor->wave.pass->triangle_count;
    if (!executor->wave.is_last && !transients_ready(executor)) {
        return false;
    }
    const uint64_t middle = rhw_time_ns();
    // The caller may have got no tile, where other threads were quick.
    if (is_given_up(context, 0)) {
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
                              .threads = context->threads,
                              .tiles = rhw_target_tiles(&pass->target),
                              .isa = context->isa};
}

enum rhw_result rhw_executor_run(struct rhw_executor *executor, struct rhw_recorded_pass *pass,
                                 struct rhw_stats *stats)
{
    struct rhw_context *const context = executor->context;
    struct rhw_wave *const wave = &executor->wave;
    struct position at = {0, 0};
    start_pass(executor, pass);
    if (!workers_ready(executor)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    struct rhw_stats s = stats_of(executor);
    for (int i = 0; i < wave->target.color_count; i++) {
        expect_clean(&wave->target.colors[i]);
    }
    expect_clean(&wave->target.depth);
    atomic_store(&context->given_up, false);
    stamp_queries(pass, 0);
    if (!shade_first_vertices(executor, &s)) {
        return failure(context);
    }
    do {
        if (!run_wave(executor, &at, &s)) {
            return failure(context);
        }
    } while (!wave->is_last);
    sum_counters(executor, &s);
    s.memory_peak = context->memory.peak;
    if (stats) {
        *stats = s;
    }
    return RHW_OK;
}
