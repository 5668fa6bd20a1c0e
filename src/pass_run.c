// SPDX-License-Identifier: MIT
// Waves: as many chunks as the bin memory holds go through the front end, then every tile draws them. Most
// passes are one wave; a pass that is larger than the bins loads and stores its tiles between waves, so that
// memory stays bounded whatever is drawn.
#include "pass_run.h"

#include <string.h>

#include "context.h"
#include "kernels/kernels.h"
#include "kernels/scratch.h"
#include "pass.h"
#include "scheduler.h"
#include "thread.h"

static const size_t default_bin_memory = (size_t)512 << 20; // bytes

static double milliseconds(uint64_t ns)
{
    return (double)ns * 1e-6;
}

static bool workers_ready(struct rhw_pass_state *pass)
{
    struct rhw_context *const context = pass->context;
    if (!pass->workers) {
        pass->workers =
            rhw_context_allocate(context, (size_t)context->threads * sizeof *pass->workers, RHW_CACHE_LINE);
        if (!pass->workers) {
            return false;
        }
        memset(pass->workers, 0, (size_t)context->threads * sizeof *pass->workers);
        for (int i = 0; i < context->threads; i++) {
            rhw_arena_init(&pass->workers[i].arena, context);
        }
    }
    for (int i = 0; i < context->threads; i++) {
        struct rhw_worker *const worker = &pass->workers[i];
        if (!worker->front) {
            worker->front = rhw_context_allocate(context, sizeof *worker->front, 4096);
            if (!worker->front) {
                return false;
            }
            memset(worker->front->cache, 0, sizeof worker->front->cache);
            worker->front->stamp = 1;
        }
        if (!worker->tile) {
            worker->tile = rhw_context_allocate(context, sizeof *worker->tile, 4096);
            if (!worker->tile) {
                return false;
            }
            memset(worker->tile, 0, sizeof *worker->tile);
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
        rhw_context_release(context, pass->workers[i].front, sizeof *pass->workers[i].front);
        rhw_context_release(context, pass->workers[i].tile, sizeof *pass->workers[i].tile);
    }
    rhw_context_release(context, pass->workers, (size_t)context->threads * sizeof *pass->workers);
    rhw_context_release(context, pass->chunks, (size_t)pass->chunk_capacity * sizeof *pass->chunks);
    rhw_context_release(context, pass->transient_depth.texels,
                        pass->transient_depth.row_pitch * (size_t)pass->transient_depth.height);
}

// Triangles per chunk: at least four chunks for every thread, so that no thread waits long for the last; and so
// few on large targets that the bins of a chunk stay below 8 MiB even when every triangle covers every tile.
static uint64_t chunk_size(const struct rhw_pass_state *pass)
{
    const uint64_t share = pass->triangle_count / (uint64_t)(4 * pass->context->threads) + 1;
    const uint64_t size = share < 128 ? 128 : share < RHW_BATCH_TRIANGLES ? share : RHW_BATCH_TRIANGLES;
    const uint64_t most = ((uint64_t)4 << 20) / (uint64_t)(pass->tiles_x * pass->tiles_y);
    return size < most ? size : most;
}

// Bytes the front end makes of one triangle of this draw without reuse of vertices, bins apart.
static size_t triangle_bytes(const struct rhw_draw *draw)
{
    const int stride = rhw_vertex_stride(draw->state->pipeline->varying_components);
    return sizeof(struct rhw_triangle) + 16 + 3 * (size_t)stride * sizeof(float);
}

static bool add_chunk(struct rhw_pass_state *pass, struct rhw_chunk chunk)
{
    if (pass->chunk_count == pass->chunk_capacity) {
        const int capacity = pass->chunk_capacity == 0 ? 64 : 2 * pass->chunk_capacity;
        struct rhw_chunk *const chunks =
            rhw_context_allocate(pass->context, (size_t)capacity * sizeof *chunks, RHW_CACHE_LINE);
        if (!chunks) {
            return false;
        }
        if (pass->chunks) {
            memcpy(chunks, pass->chunks, (size_t)pass->chunk_count * sizeof *chunks);
            rhw_context_release(pass->context, pass->chunks, (size_t)pass->chunk_capacity * sizeof *chunks);
        }
        pass->chunks = chunks;
        pass->chunk_capacity = capacity;
    }
    pass->chunks[pass->chunk_count++] = chunk;
    return true;
}

static size_t bin_limit(const struct rhw_pass_state *pass)
{
    return pass->context->bin_memory ? pass->context->bin_memory : default_bin_memory;
}

// Where in the line of triangles the next wave starts.
struct position {
    uint64_t triangle;
    uint32_t draw;
};

// Cuts the next wave into chunks. False when out of memory.
static bool cut_wave(struct rhw_pass_state *pass, struct position *at)
{
    const size_t limit = bin_limit(pass);
    const uint64_t size = chunk_size(pass);
    size_t bytes = 0;
    pass->chunk_count = 0;
    while (at->triangle < pass->triangle_count && (bytes < limit || pass->chunk_count == 0)) {
        const uint64_t left = pass->triangle_count - at->triangle;
        const struct rhw_draw *draw = rhw_pass_draw_at(pass, at->draw);
        while (at->triangle >=
               draw->first_triangle + (uint64_t)draw->triangles_per_instance * draw->instances) {
            draw = rhw_pass_draw_at(pass, ++at->draw);
        }
        const struct rhw_chunk chunk = {
            .first = at->triangle, .count = left < size ? left : size, .first_draw = at->draw};
        if (!add_chunk(pass, chunk)) {
            return false;
        }
        bytes += chunk.count * triangle_bytes(draw);
        at->triangle += chunk.count;
    }
    return true;
}

static void run_chunk(void *user, int index, int worker)
{
    struct rhw_pass_state *const pass = user;
    if (!pass->context->kernels->chunk(pass, &pass->chunks[pass->round + index], worker)) {
        pass->failed = true;
    }
}

static void run_tile(void *user, int index, int worker)
{
    struct rhw_pass_state *const pass = user;
    pass->context->kernels->tile(pass, index, worker);
}

static size_t arenas_used(const struct rhw_pass_state *pass)
{
    size_t bytes = 0;
    for (int i = 0; i < pass->context->threads; i++) {
        bytes += rhw_arena_used(&pass->workers[i].arena);
    }
    return bytes;
}

// Runs the front end over the wave's chunks, in rounds whose size follows from what the chunks so far took: how
// many bins a triangle fills is known only then. When the memory is used up the wave ends early and `at` goes back
// to the first chunk left. Where a wave ends may depend on the threads; what is drawn does not depend on waves.
static bool run_front(struct rhw_pass_state *pass, struct position *at, struct rhw_stats *stats)
{
    struct rhw_context *const context = pass->context;
    const size_t limit = bin_limit(pass);
    const int least = context->threads;
    int round = least;
    for (int done = 0; done < pass->chunk_count; done += round) {
        const size_t used = arenas_used(pass);
        if (done != 0 && used >= limit) {
            at->triangle = pass->chunks[done].first;
            at->draw = pass->chunks[done].first_draw;
            pass->chunk_count = done;
            return true;
        }
        if (done != 0) {
            const size_t fits = (limit - used) / (2 * (used / (size_t)done + 1));
            round = fits < (size_t)least ? least : fits < INT32_MAX ? (int)fits : INT32_MAX;
        }
        const int left = pass->chunk_count - done;
        round = round < left ? round : left;
        pass->round = done;
        stats->front_busy_ms += milliseconds(rhw_scheduler_run(context->scheduler, run_chunk, pass, round));
        if (pass->failed) {
            return false;
        }
    }
    return true;
}

// Memory for depth that has no texture, needed only when a second wave must find it again.
static bool transient_depth_ready(struct rhw_pass_state *pass)
{
    if (!pass->has_depth || pass->depth.target) {
        return true;
    }
    struct rhw_mip *const mip = &pass->transient_depth;
    const size_t pitch =
        ((size_t)pass->width * sizeof(float) + RHW_CACHE_LINE - 1) & ~(size_t)(RHW_CACHE_LINE - 1);
    if (!mip->texels || mip->row_pitch * (size_t)mip->height < pitch * (size_t)pass->height) {
        rhw_context_release(pass->context, mip->texels, mip->row_pitch * (size_t)mip->height);
        mip->texels = rhw_context_allocate(pass->context, pitch * (size_t)pass->height, RHW_CACHE_LINE);
        if (!mip->texels) {
            *mip = (struct rhw_mip){0};
            return false;
        }
        mip->row_pitch = pitch;
        mip->height = pass->height;
    }
    pass->depth.target = mip;
    return true;
}

static void sum_counters(const struct rhw_pass_state *pass, struct rhw_stats *stats)
{
    for (int i = 0; i < pass->context->threads; i++) {
        const struct rhw_counters *const c = &pass->workers[i].counters;
        stats->vertices_shaded += c->vertices_shaded;
        stats->triangles_dropped += c->dropped;
        stats->triangles_clipped += c->clipped;
        stats->triangles_culled += c->culled;
        stats->triangles_rasterized += c->rasterized;
        stats->bin_entries += c->entries;
        stats->fragments_shaded += c->fragments;
        stats->fragment_groups += c->groups;
        stats->vertex_busy_ms += milliseconds(c->vertex_ns);
        stats->setup_busy_ms += milliseconds(c->setup_ns);
        stats->bin_busy_ms += milliseconds(c->bin_ns);
    }
}

enum rhw_result rhw_pass_run(struct rhw_pass_state *pass, struct rhw_stats *stats)
{
    struct rhw_context *const context = pass->context;
    if (!workers_ready(pass)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    struct rhw_stats s = {.record_ms = milliseconds(rhw_time_ns() - pass->begun_ns),
                          .draws = pass->draw_count,
                          .triangles_in = pass->triangle_count,
                          .threads = context->threads,
                          .tiles = pass->tiles_x * pass->tiles_y,
                          .isa = context->isa};
    struct position at = {0, 0};
    pass->first_wave = true;
    do {
        const uint64_t start = rhw_time_ns();
        pass->failed = false;
        for (int i = 0; i < context->threads; i++) {
            rhw_arena_reset(&pass->workers[i].arena);
        }
        if (!cut_wave(pass, &at)) {
            return RHW_ERROR_OUT_OF_MEMORY;
        }
        if (!run_front(pass, &at, &s)) {
            return RHW_ERROR_OUT_OF_MEMORY;
        }
        const size_t geometry = arenas_used(pass);
        s.geometry_peak = geometry > s.geometry_peak ? geometry : s.geometry_peak;
        pass->last_wave = at.triangle == pass->triangle_count;
        if (!pass->last_wave && !transient_depth_ready(pass)) {
            return RHW_ERROR_OUT_OF_MEMORY;
        }
        const uint64_t middle = rhw_time_ns();
        s.back_busy_ms += milliseconds(rhw_scheduler_run(context->scheduler, run_tile, pass, s.tiles));
        s.front_ms += milliseconds(middle - start);
        s.back_ms += milliseconds(rhw_time_ns() - middle);
        s.flushes += !pass->last_wave;
        pass->first_wave = false;
    } while (!pass->last_wave);
    sum_counters(pass, &s);
    s.memory_peak = context->memory_peak;
    if (stats) {
        *stats = s;
    }
    return RHW_OK;
}
