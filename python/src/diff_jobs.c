// SPDX-License-Identifier: MIT
#include "diff_jobs.h"

#include "picture_memory.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

enum { CACHE_LINE = 64 };

struct jobs {
    // Written by every thread that takes a job; alone on its cache line, beside what all of them read.
    _Alignas(CACHE_LINE) atomic_size_t next;
    _Alignas(CACHE_LINE) size_t count;
    void (*function)(void *data, size_t job);
    void *data;
};

void diff_crew_begin(struct diff_crew *crew)
{
    crew->python = python_work_begin();
}

PyObject *diff_crew_end(struct diff_crew *crew, bool good)
{
    PyEval_RestoreThread(crew->python.state);
    if (crew->python.gave_up) {
        return NULL;
    }
    if (!good) {
        return PyErr_NoMemory();
    }
    Py_INCREF(Py_None);
    return Py_None;
}

bool diff_crew_goes_on(struct diff_crew *crew)
{
    return python_work_goes_on(&crew->python);
}

static bool take(struct jobs *jobs)
{
    const size_t job = atomic_fetch_add(&jobs->next, 1);
    if (job < jobs->count) {
        jobs->function(jobs->data, job);
    }
    return job < jobs->count;
}

static void *help(void *argument)
{
    struct jobs *jobs = argument;
    while (take(jobs)) {
    }
    return NULL;
}

void diff_jobs_run(struct diff_crew *crew, size_t count, void (*function)(void *data, size_t job), void *data)
{
    if (crew->python.gave_up) {
        return;
    }
    struct jobs jobs = {.count = count, .function = function, .data = data};
    pthread_t others[RHW_MAX_THREADS];
    int started = 0;
    while (started + 1 < crew->threads && started + 1 < RHW_MAX_THREADS && (size_t)started + 1 < count &&
           pthread_create(&others[started], NULL, help, &jobs) == 0) {
        started++;
    }
    while (take(&jobs)) {
        if (!diff_crew_goes_on(crew)) {
            atomic_store(&jobs.next, count); // the others finish what they have
        }
    }
    for (int i = 0; i < started; i++) {
        pthread_join(others[i], NULL);
    }
}

double *diff_sums(size_t rows, size_t columns, size_t *pitch)
{
    const size_t of_line = CACHE_LINE / sizeof(double), most = PY_SSIZE_T_MAX / sizeof(double);
    *pitch = (columns + of_line - 1) / of_line * of_line;
    if (*pitch == 0 || rows == 0 || *pitch > most / rows) {
        return NULL;
    }
    return python_picture_allocate_zeroed(rows * *pitch * sizeof(double));
}

void diff_sums_free(double *sums, size_t rows, size_t pitch)
{
    python_picture_release(sums, rows * pitch * sizeof *sums);
}
