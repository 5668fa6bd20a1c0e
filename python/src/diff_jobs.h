// SPDX-License-Identifier: MIT
// Work in jobs that any thread may take. Each job writes places that no other writes, in an order of its own, so that
// results do not depend on how many threads there are. Where several pixels add to one place, that place has one job,
// which adds them in the order of the pixels.
#ifndef PYTHON_DIFF_JOBS_H
#define PYTHON_DIFF_JOBS_H

#include "extension.h"

/// Who works for a call of Python, without the interpreter's lock. The caller takes that between jobs now and then, to
/// see whether a signal's handler wants to end the call, as that of Ctrl-C does.
struct diff_crew {
    int threads; ///< the caller's among them; beyond RHW_MAX_THREADS they are not started
    struct python_work python;
};

/// Gives the interpreter's lock back until diff_crew_end.
void diff_crew_begin(struct diff_crew *crew);
/// None; NULL with an exception where a handler raised one, or where not `good`: without memory.
PyObject *diff_crew_end(struct diff_crew *crew, bool good);
/// Whether no handler has ended the call. Of the caller's thread.
bool diff_crew_goes_on(struct diff_crew *crew);

/// Calls function(data, 0..count − 1) on the crew, and returns when all are done; of a call that was given up, not all
/// are. Where the system gives fewer threads, those that there are do the work. Jobs should take milliseconds: a call
/// ends at the end of one.
void diff_jobs_run(struct diff_crew *crew, size_t count, void (*function)(void *data, size_t job),
                   void *data);

/// Sums for jobs to add to, zeroed: so many rows, each of which begins on a cache line of its own, so that no two
/// threads write to one. `*pitch`: doubles from row to row. Freed by diff_sums_free; NULL without memory.
double *diff_sums(size_t rows, size_t columns, size_t *pitch);
void diff_sums_free(double *sums, size_t rows, size_t pitch);

#endif
