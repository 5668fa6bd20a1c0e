// SPDX-License-Identifier: MIT
#include "diff_jobs.h"

#include <pthread.h>
#include <stdatomic.h>

enum { MAX_THREADS = 64 }; // as rhw_context_def.threads

struct jobs {
    atomic_size_t next; // the only thing that threads share; what they write is the functions'
    size_t count;
    void (*function)(void *data, size_t job);
    void *data;
};

static void *work(void *argument)
{
    struct jobs *jobs = argument;
    size_t job;
    while ((job = atomic_fetch_add(&jobs->next, 1)) < jobs->count) {
        jobs->function(jobs->data, job);
    }
    return NULL;
}

void diff_jobs_run(int threads, size_t count, void (*function)(void *data, size_t job), void *data)
{
    struct jobs jobs = {.count = count, .function = function, .data = data};
    pthread_t others[MAX_THREADS];
    int started = 0;
    while (started + 1 < threads && started + 1 < MAX_THREADS && (size_t)started + 1 < count &&
           pthread_create(&others[started], NULL, work, &jobs) == 0) {
        started++;
    }
    work(&jobs);
    for (int i = 0; i < started; i++) {
        pthread_join(others[i], NULL);
    }
}
