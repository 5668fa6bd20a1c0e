// SPDX-License-Identifier: MIT
// Worker threads of a context. One job at a time: `count` tasks, claimed one by one by the caller and the
// workers, so that uneven tasks (tiles, chunks) balance themselves.
#ifndef RHW_SCHEDULER_H
#define RHW_SCHEDULER_H

#include "rhw/base.h"

struct rhw_memory;
struct rhw_scheduler;

// `worker` is 0 for the caller's thread and 1 .. threads − 1 for the others: index per-thread data by it.
typedef void rhw_task_function(void *user, int index, int worker);

// `threads` counts the caller; 1 makes no thread at all. `cores` is what they run on.
enum rhw_result rhw_scheduler_create(struct rhw_memory *memory, int threads, int cores,
                                     struct rhw_scheduler **scheduler);
// Joins the workers. NULL is allowed.
void rhw_scheduler_destroy(struct rhw_memory *memory, struct rhw_scheduler *scheduler);

// Runs task(user, 0 .. count − 1, worker) and returns when all are done; what they wrote is then visible to
// the caller. Tasks run in any order and may not call this function. Indices are claimed in rising order.
// Returns the nanoseconds that threads had tasks, added up over the threads.
uint64_t rhw_scheduler_run(struct rhw_scheduler *scheduler, rhw_task_function *task, void *user, int count);

// Whether the calling thread is in a task of this scheduler.
bool rhw_scheduler_runs_here(const struct rhw_scheduler *scheduler);

#endif
