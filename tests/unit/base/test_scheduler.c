// SPDX-License-Identifier: MIT
// Tasks of a job: each is run once, and the threads that run them have numbers of their own, no more than the job may
// have workers.
#include "harness.h"

#include <stdatomic.h>

#include "base/memory.h"
#include "base/scheduler.h"
#include "base/thread.h"

enum { THREADS = 16, TASKS_MOST = 40, ROUNDS = 100 };

static const uint64_t task_ns = 50000; // long enough for a thread that was woken to get a task

struct job {
    int workers;
    atomic_int runs[TASKS_MOST];
    atomic_bool is_busy[THREADS];
    atomic_bool is_too_high, is_shared;
};

static void wait_a_moment(void)
{
    const uint64_t end = rhw_time_ns() + task_ns;
    while (rhw_time_ns() < end) {
        rhw_thread_yield();
    }
}

static void task(void *user, int index, int worker)
{
    struct job *const job = user;
    job->runs[index]++;
    if (worker < 0 || worker >= job->workers) {
        job->is_too_high = true;
        return;
    }
    if (atomic_exchange(&job->is_busy[worker], true)) {
        job->is_shared = true;
    }
    wait_a_moment();
    job->is_busy[worker] = false;
}

static void check_job(struct rhw_scheduler *scheduler, int count)
{
    struct job job = {.workers = rhw_scheduler_workers(scheduler, count)};
    (void)rhw_scheduler_run(scheduler, task, &job, count);
    for (int i = 0; i < count; i++) {
        assert_int_equal(job.runs[i], 1);
    }
    assert_false(job.is_too_high);
    assert_false(job.is_shared);
}

static void test_workers_of_jobs(void **state)
{
    (void)state;
    static const int counts[] = {2, 1, 3, TASKS_MOST, 7, THREADS - 1, THREADS};
    struct rhw_memory memory = {.allocator = rhw_allocator_or_default((struct rhw_allocator){0})};
    struct rhw_scheduler *scheduler;
    assert_int_equal(rhw_scheduler_create(&memory, THREADS, THREADS, &scheduler), RHW_OK);
    for (int round = 0; round < ROUNDS; round++) {
        for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
            check_job(scheduler, counts[i]);
        }
    }
    rhw_scheduler_destroy(&memory, scheduler);
}

static void test_few_tasks_have_few_workers(void **state)
{
    (void)state;
    struct rhw_memory memory = {.allocator = rhw_allocator_or_default((struct rhw_allocator){0})};
    struct rhw_scheduler *scheduler;
    assert_int_equal(rhw_scheduler_create(&memory, 8, 8, &scheduler), RHW_OK);
    assert_int_equal(rhw_scheduler_workers(scheduler, 0), 1);
    assert_int_equal(rhw_scheduler_workers(scheduler, 1), 1); // the caller has it
    assert_int_equal(rhw_scheduler_workers(scheduler, 2), 3); // the caller, and two that were quicker
    assert_int_equal(rhw_scheduler_workers(scheduler, 7), 8);
    assert_int_equal(rhw_scheduler_workers(scheduler, 8), 8);
    assert_int_equal(rhw_scheduler_workers(scheduler, 1000), 8);
    rhw_scheduler_destroy(&memory, scheduler);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_workers_of_jobs),
                                          cmocka_unit_test(test_few_tasks_have_few_workers)};

const struct unit_tests test_scheduler = UNIT_TESTS(tests, NULL, NULL);
