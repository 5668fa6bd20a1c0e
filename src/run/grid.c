// SPDX-License-Identifier: MIT
// Workgroups know nothing of each other, so threads take them in batches of neighbours. A thread has one room, in which
// it runs one workgroup after the other: the lanes of its invocations, which change from workgroup to workgroup by
// their places alone, and the memory that they share.
#include "grid.h"

#include <string.h>

#include "base/scheduler.h"
#include "context/context.h"
#include "context/given_up.h"
#include "resource/bound_texels.h"
#include "executor.h"
#include "rhw/shader.h"

// A thread gets this many batches, so that no thread waits long for the last.
enum { BATCHES_OF_THREAD = 32 };

struct room {
    _Alignas(RHW_CACHE_LINE) bool is_made; // a room is written by its thread for every workgroup
    struct rhw_workgroup workgroup;
    struct rhw_invocations *groups;
    bool *is_done; // an element for each invocation of the one-at-a-time form
};

struct job {
    struct rhw_context *context;
    const struct rhw_grid *grid;
    struct room *rooms; // a room for each worker
    int invocations;
    uint64_t workgroups, batch; // workgroups of the grid, and of a batch
};

// Bytes from the memory of one invocation to that of the next, which is aligned for every type.
static size_t invocation_stride(const struct rhw_compute_program *program)
{
    return ((size_t)program->invocation_size + 15) & ~(size_t)15;
}

static int group_count(const struct job *job)
{
    return (job->invocations + RHW_LANES - 1) / RHW_LANES;
}

// Give a room its memory. Return false when out of memory.
static bool reserve(const struct job *job, struct rhw_arena *arena, struct room *room)
{
    const struct rhw_compute_program *const program = job->grid->program;
    const size_t groups = (size_t)group_count(job),
                 invocations = job->grid->function ? 0 : (size_t)job->invocations;
    rhw_arena_reset(arena);
    room->is_made = false;
    room->groups = rhw_arena_alloc(arena, groups * sizeof *room->groups, RHW_CACHE_LINE);
    room->workgroup.shared = rhw_arena_alloc(arena, program->shared_size, RHW_CACHE_LINE);
    room->workgroup.memory =
        rhw_arena_alloc(arena, groups * RHW_LANES * invocation_stride(program), RHW_CACHE_LINE);
    room->is_done = rhw_arena_alloc(arena, invocations * sizeof *room->is_done, 1);
    return room->groups && room->workgroup.shared && room->workgroup.memory && room->is_done;
}

// Set all that is the same for every workgroup. The thread of the room does it, which then has the memory in its cache.
static void make(const struct job *job, struct room *room)
{
    const struct rhw_grid *const grid = job->grid;
    struct rhw_workgroup *const workgroup = &room->workgroup;
    int32_t local[3] = {0, 0, 0};
    for (int i = 0; i < group_count(job) * RHW_LANES; i++) {
        struct rhw_invocations *const group = &room->groups[i / RHW_LANES];
        const int lane = i % RHW_LANES;
        for (int c = 0; c < 3; c++) {
            group->local[c][lane] = local[c];
        }
        group->index[lane] = i;
        group->mask[lane] = i < job->invocations ? -1 : 0;
        for (int c = 0; c < 3 && ++local[c] == grid->size[c]; c++) {
            local[c] = 0;
        }
    }
    workgroup->groups = room->groups;
    workgroup->count = group_count(job);
    workgroup->uniforms = grid->uniforms;
    workgroup->user = grid->program->user;
    workgroup->bindings = grid->bindings;
    memcpy(workgroup->counts, grid->count, sizeof workgroup->counts);
    memcpy(workgroup->size, grid->size, sizeof workgroup->size);
    room->is_made = true;
}

// Call the one-at-a-time function for all invocations, until all of them are done.
static void run_invocations(const struct job *job, const struct room *room)
{
    const struct rhw_compute_program *const program = job->grid->program;
    const struct rhw_workgroup *const workgroup = &room->workgroup;
    const size_t stride = invocation_stride(program);
    unsigned char *const memory = workgroup->memory;
    int left = job->invocations;
    struct rhw_invocation1 one = {.shared = workgroup->shared,
                                  .uniforms = workgroup->uniforms,
                                  .user = workgroup->user,
                                  .bindings = workgroup->bindings};
    for (int c = 0; c < 3; c++) {
        one.workgroup[c] = workgroup->id[c];
        one.counts[c] = workgroup->counts[c];
        one.size[c] = workgroup->size[c];
    }
    memset(memory, 0, (size_t)job->invocations * stride);
    memset(room->is_done, 0, (size_t)job->invocations * sizeof *room->is_done);
    for (; left > 0; one.step++) {
        for (int i = 0; i < job->invocations; i++) {
            if (room->is_done[i]) {
                continue;
            }
            const struct rhw_invocations *const group = &workgroup->groups[i / RHW_LANES];
            struct rhw_invocation1 call = one;
            for (int c = 0; c < 3; c++) {
                call.id[c] = group->id[c][i % RHW_LANES];
                call.local[c] = group->local[c][i % RHW_LANES];
            }
            call.index = i;
            call.memory = memory + (size_t)i * stride;
            room->is_done[i] = !program->invocation1(&call);
            left -= room->is_done[i];
        }
    }
}

static void run_workgroup(const struct job *job, struct room *room)
{
    const struct rhw_grid *const grid = job->grid;
    struct rhw_workgroup *const workgroup = &room->workgroup;
    for (int g = 0; g < workgroup->count; g++) {
        for (int c = 0; c < 3; c++) {
            room->groups[g].id[c] = room->groups[g].local[c] + workgroup->id[c] * grid->size[c];
        }
    }
    memset(workgroup->shared, 0, grid->program->shared_size);
    if (grid->function) {
        struct rhw_workgroup own = *workgroup; // the function may change its copy
        grid->function(&own);
    } else {
        run_invocations(job, room);
    }
}

static void run_batch(void *user, int index, int worker)
{
    const struct job *const job = user;
    const struct rhw_grid *const grid = job->grid;
    struct room *const room = &job->rooms[worker];
    const uint64_t first = (uint64_t)index * job->batch, left = job->workgroups - first,
                   x = (uint64_t)grid->count[0], y = (uint64_t)grid->count[1];
    int32_t *const id = room->workgroup.id;
    if (!room->is_made) {
        make(job, room);
    }
    const int32_t *const base = grid->base;
    id[0] = base[0] + (int32_t)(first % x);
    id[1] = base[1] + (int32_t)(first / x % y);
    id[2] = base[2] + (int32_t)(first / x / y);
    for (uint64_t i = 0; i < job->batch && i < left && !rhw_context_is_given_up(job->context, worker); i++) {
        run_workgroup(job, room);
        for (int c = 0; c < 3 && ++id[c] == base[c] + grid->count[c]; c++) {
            id[c] = base[c];
        }
    }
}

enum rhw_result rhw_executor_run_grid(struct rhw_executor *executor, const struct rhw_grid *grid)
{
    struct rhw_context *const context = executor->context;
    struct room rooms[RHW_MAX_THREADS];
    struct job job = {.context = context,
                      .grid = grid,
                      .rooms = rooms,
                      .invocations = grid->size[0] * grid->size[1] * grid->size[2],
                      .workgroups =
                          (uint64_t)grid->count[0] * (uint64_t)grid->count[1] * (uint64_t)grid->count[2]};
    const enum rhw_result prepared = rhw_bound_texels_prepare(context);
    if (prepared != RHW_OK) {
        return prepared;
    }
    if (!rhw_executor_arenas_ready(executor)) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    // One batch is one task, which runs on the calling thread.
    const uint64_t batches =
        grid->program->uses_atomic_results ? 1 : (uint64_t)context->threads * BATCHES_OF_THREAD;
    job.batch = (job.workgroups + batches - 1) / batches;
    const int tasks = job.batch == 0 ? 0 : (int)((job.workgroups + job.batch - 1) / job.batch);
    for (int i = 0; i < rhw_scheduler_workers(context->scheduler, tasks); i++) {
        if (!reserve(&job, &executor->wave.workers[i].arena, &rooms[i])) {
            return RHW_ERROR_OUT_OF_MEMORY;
        }
    }
    rhw_context_begin_work(context);
    if (rhw_context_is_given_up(context, 0)) {
        return RHW_ERROR_GIVEN_UP;
    }
    (void)rhw_scheduler_run(context->scheduler, run_batch, &job, tasks);
    return atomic_load(&context->given_up) ? RHW_ERROR_GIVEN_UP : RHW_OK;
}
