// SPDX-License-Identifier: MIT
// See executor.h. Memory is made when a pass needs it first, and released with the executor.
#include "executor.h"

#include <string.h>

#include "base/scheduler.h"
#include "context/context.h"
#include "kernels/geometry/geometry_scratch.h"
#include "kernels/tile_work.h"

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

// Give the worker tiles of all samples but the first. Memory that a pass does not draw into is never touched. Return
// false when out of memory.
static bool sample_tiles_ready(struct rhw_memory *memory, struct rhw_worker *worker, int wanted)
{
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

// Give the tile and its samples a room for the colours of each attachment. Return false when out of memory.
static bool colors_ready(struct rhw_memory *memory, struct rhw_worker *worker,
                         const struct rhw_target *target)
{
    const int each = target->color_count, wanted = each * target->pattern->count;
    if (wanted == 0) {
        return true;
    }
    if (worker->color_count < wanted) {
        rhw_memory_release(memory, worker->colors, (size_t)worker->color_count * sizeof *worker->colors);
        worker->color_count = 0;
        worker->colors = rhw_memory_allocate_zeroed(memory, (size_t)wanted * sizeof *worker->colors, 4096);
        if (!worker->colors) {
            return false;
        }
        worker->color_count = wanted;
    }
    worker->tile->color = worker->colors;
    for (int s = 1; s < target->pattern->count; s++) {
        worker->sample_tiles[s - 1].color = worker->colors + s * each;
    }
    return true;
}

// Give the worker memory for chunks of the pass. It grows in powers of two, so that a scene which grows from frame to
// frame makes few calls. Return false when out of memory.
static bool geometry_ready(struct rhw_memory *memory, struct rhw_worker *worker, uint64_t chunk_size)
{
    if (worker->triangle_room >= chunk_size) {
        return true;
    }
    size_t triangles = RHW_CHUNK_TRIANGLES;
    while (triangles / 2 >= chunk_size) {
        triangles /= 2;
    }
    const struct rhw_geometry_room room = rhw_geometry_scratch_room(triangles);
    rhw_memory_release(memory, worker->geometry, rhw_geometry_scratch_room(worker->triangle_room).size);
    worker->triangle_room = 0;
    worker->geometry = rhw_memory_allocate(memory, room.size, 4096);
    if (!worker->geometry) {
        return false;
    }
    worker->triangle_room = triangles;
    rhw_geometry_scratch_init(worker->geometry, room);
    return true;
}

// Return the bytes of the varyings of all groups, of so many components, and of the derivatives.
static size_t varyings_size(int components)
{
    return (size_t)components * (RHW_VERTEX_GROUPS + 3 * RHW_FRAGMENT_GROUPS) * sizeof(f32x8);
}

// Give the worker room for varyings of so many components, in what it has of the front end and of tiles. Return false
// when out of memory.
static bool varyings_ready(struct rhw_memory *memory, struct rhw_worker *worker, int components)
{
    enum { STEP = 8 };
    const int wanted = components < STEP ? STEP : (components + STEP - 1) / STEP * STEP;
    if (worker->component_room < wanted) {
        rhw_memory_release(memory, worker->varyings, varyings_size(worker->component_room));
        worker->component_room = 0;
        worker->varyings = rhw_memory_allocate_zeroed(memory, varyings_size(wanted), RHW_CACHE_LINE);
        if (!worker->varyings) {
            return false;
        }
        worker->component_room = wanted;
    }
    f32x8 *const of_vertices = worker->varyings;
    if (worker->geometry) {
        worker->geometry->varyings = of_vertices;
    }
    if (worker->tile) {
        const size_t each = (size_t)worker->component_room * RHW_FRAGMENT_GROUPS;
        struct fragment_queue *const queue = &worker->tile->queue;
        queue->varyings = of_vertices + (size_t)worker->component_room * RHW_VERTEX_GROUPS;
        queue->ddx = queue->varyings + each;
        queue->ddy = queue->ddx + each;
    }
    return true;
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

bool rhw_executor_arenas_ready(struct rhw_executor *executor)
{
    return executor->wave.workers || make_workers(executor);
}

bool rhw_executor_front_ready(struct rhw_executor *executor, int count)
{
    struct rhw_memory *const memory = &executor->context->memory;
    const int workers = rhw_scheduler_workers(executor->context->scheduler, count);
    bool ready = true;
    for (int i = 0; ready && i < workers; i++) {
        struct rhw_worker *const worker = &executor->wave.workers[i];
        ready = geometry_ready(memory, worker, executor->chunk_size) &&
                varyings_ready(memory, worker, executor->wave.pass->components_most);
    }
    return ready;
}

// Give a worker the memory that tiles of the wave's pass need. Return false when out of memory.
static bool tile_ready(const struct rhw_executor *executor, struct rhw_worker *worker)
{
    struct rhw_memory *const memory = &executor->context->memory;
    const struct rhw_target *const target = &executor->wave.target;
    if (!worker->tile) {
        worker->tile = rhw_memory_allocate(memory, sizeof *worker->tile, 4096);
        if (!worker->tile) {
            return false;
        }
        init_tile_scratch(worker->tile);
    }
    return varyings_ready(memory, worker, executor->wave.pass->components_most) &&
           sample_tiles_ready(memory, worker, target->pattern->count - 1) &&
           colors_ready(memory, worker, target);
}

bool rhw_executor_tiles_ready(struct rhw_executor *executor)
{
    const struct rhw_wave *const wave = &executor->wave;
    const int workers = rhw_scheduler_workers(executor->context->scheduler, rhw_target_tiles(&wave->target));
    bool ready = true;
    for (int i = 0; ready && i < workers; i++) {
        struct rhw_worker *const worker = &wave->workers[i];
        ready = tile_ready(executor, worker);
        if (ready) {
            const size_t size = (size_t)wave->chunk_count * sizeof *worker->tile->bins;
            worker->tile->bins = rhw_arena_alloc(&worker->arena, size, _Alignof(struct bin));
            ready = worker->tile->bins != NULL;
        }
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
    rhw_memory_release(memory, worker->geometry, rhw_geometry_scratch_room(worker->triangle_room).size);
    rhw_memory_release(memory, worker->tile, sizeof *worker->tile);
    rhw_memory_release(memory, worker->varyings, varyings_size(worker->component_room));
    rhw_memory_release(memory, worker->colors, (size_t)worker->color_count * sizeof *worker->colors);
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

bool rhw_executor_transients_ready(struct rhw_executor *executor)
{
    struct rhw_target *const target = &executor->wave.target;
    bool ready = true;
    for (int i = 0; i < target->color_count; i++) {
        ready = ready && transient_ready(executor, &target->colors[i], &executor->colors[i]);
    }
    return ready && (!target->has_depth || transient_ready(executor, &target->depth, &executor->depth)) &&
           (!target->has_stencil || transient_ready(executor, &target->stencil, &executor->stencil));
}
