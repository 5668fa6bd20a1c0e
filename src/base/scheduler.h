// SPDX-License-Identifier: MIT
// Worker threads of a context. They do one job at a time. A job has `count` tasks, which the caller and the workers
// claim one by one, so that uneven tasks (tiles, chunks) balance themselves.
#ifndef RHW_SCHEDULER_H
#define RHW_SCHEDULER_H

#include "rhw/base.h"

struct rhw_memory;
struct rhw_scheduler;

// A task. `worker` is 0 on the caller's thread. Another thread has one of the numbers 1 .. rhw_scheduler_workers − 1,
// the same in all tasks of a job. Per-thread data are indexed by it.
typedef void rhw_task_function(void *user, int index, int worker);

// Start the workers. `threads` counts the caller, so 1 starts none. `cores` is the number of cores that they run on.
enum rhw_result rhw_scheduler_create(struct rhw_memory *memory, int threads, int cores,
                                     struct rhw_scheduler **scheduler);
// Join the workers. `scheduler` may be NULL.
void rhw_scheduler_destroy(struct rhw_memory *memory, struct rhw_scheduler *scheduler);

// Run task(user, 0 .. count − 1, worker) and return when all are done. What the tasks wrote is then visible to the
// caller. Tasks run in any order and may not call this function. Indices are claimed in rising order. Return the
// nanoseconds that threads had tasks, summed over the threads.
uint64_t rhw_scheduler_run(struct rhw_scheduler *scheduler, rhw_task_function *task, void *user, int count);

// Return how many workers a job of so many tasks may have. It is at least 1.
int rhw_scheduler_workers(const struct rhw_scheduler *scheduler, int count);

// Set what the caller of rhw_scheduler_run does every 10 ms while it waits for the last tasks of others. NULL: nothing.
void rhw_scheduler_set_idle(struct rhw_scheduler *scheduler, void (*idle)(void *user), void *user);

// Return true if the calling thread is the one that called rhw_scheduler_run.
bool rhw_scheduler_is_caller(const struct rhw_scheduler *scheduler);

// Return true if the calling thread is in a task of this scheduler.
bool rhw_scheduler_runs_here(const struct rhw_scheduler *scheduler);

#endif
