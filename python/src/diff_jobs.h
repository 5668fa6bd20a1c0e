// SPDX-License-Identifier: MIT
// Work in jobs that any thread may take. Each job writes places that no other writes, in an order of its own, so that
// results do not depend on how many threads there are. Where several pixels add to one place, that place has one job,
// which adds them in the order of the pixels.
#ifndef PYTHON_DIFF_JOBS_H
#define PYTHON_DIFF_JOBS_H

#include <stdbool.h>
#include <stddef.h>

/// Calls function(data, 0..count − 1) on up to `threads` threads, the caller's among them, and returns when all are done.
/// Where the system gives fewer threads, those that there are do the work.
void diff_jobs_run(int threads, size_t count, void (*function)(void *data, size_t job), void *data);

#endif
