// SPDX-License-Identifier: MIT
// Worker threads. A job is published by storing its number of tasks in `unclaimed`; a thread that lowers this number by
// one owns a task. The job's fields are plain. Only a thread that has claimed a task reads them, and they are written
// only when no task of the last job is unfinished. Thus no reader can meet a writer, and a late worker that wakes in
// the next job takes part in it.
//
// Frames follow each other closely, and a sleeping thread costs tens of microseconds to wake. So a worker that finds no
// task spins for a moment before it sleeps. It does not spin where threads share cores, because it would take the core
// from the thread it waits for.
//
// Linux may wake a worker on the core of the thread that wakes it, although another is idle: most often in virtual
// machines, whose idle cores look as if the host had taken them away, and where the program's other threads have just
// rested. There it stays for some milliseconds, which is as long as many frames take. So a worker that finds itself on
// the caller's core moves to another, and the caller lets it, after its first task, if it has not started by then.
#include "scheduler.h"

#include <assert.h>
#include <stdatomic.h>

#include "constants.h"
#include "cpu.h"
#include "memory.h"
#include "thread.h"

// Nanoseconds that a thread spins before it sleeps: about twice what falling asleep and waking cost.
static const uint64_t spin_ns = 80000;
// Nanoseconds between two calls of rhw_scheduler::idle.
static const uint32_t idle_ns = 10000000;

enum {
    // Spin steps between two looks at the clock, each of which costs as much as a few steps.
    RELAX_PER_CLOCK = 16,
    YIELDS_WHEN_CROWDED = 4
};

struct worker {
    struct rhw_scheduler *scheduler;
    struct rhw_thread thread;
    int number; // 1 .. threads − 1
};

struct rhw_scheduler {
    // Every thread that claims a task writes this, and all that wait for a task read it.
    _Alignas(RHW_CACHE_LINE) _Atomic uint32_t unclaimed;

    // Every thread writes this once per job, when it finds nothing more to claim. The caller waits for 0.
    _Alignas(RHW_CACHE_LINE) _Atomic uint32_t unfinished;
    // Nanoseconds of the job that threads had tasks. Every thread adds its own once per job.
    _Atomic uint64_t busy_ns;
    // Threads beside the caller that have had a task of the job, where it has fewer tasks than there are threads. Each
    // adds itself at its first task; the caller sets it to 0 between jobs.
    _Atomic int guests;

    // The caller writes the job's fields between jobs. Threads that go to sleep write `sleepers`.
    _Alignas(RHW_CACHE_LINE) rhw_task_function *task;
    void *user;
    uint32_t count;
    uint32_t left_asleep; // workers that the job does not wake
    int threads;
    bool crowded;      // more threads than cores
    uintptr_t process; // the process that has the workers
    _Atomic bool quit;
    _Atomic uint32_t sleepers;
    _Atomic bool caller_sleeps;
    // The caller sets these between jobs; see rhw_scheduler_set_idle.
    void (*idle)(void *user);
    void *idle_user;
    // The thread that runs a job, or 0 where none does. What is told to other threads depends on it.
    _Atomic uintptr_t caller;
    // The core that it ran on when it published the job, or -1 where that is not known.
    _Atomic int caller_core;

    struct rhw_mutex mutex;    // guards going to sleep, and nothing else
    struct rhw_condition work; // workers sleep here
    struct rhw_condition done; // the caller sleeps here
    struct worker workers[];   // threads − 1 of them
};

static size_t scheduler_size(int threads)
{
    return sizeof(struct rhw_scheduler) + (size_t)(threads - 1) * sizeof(struct worker);
}

// A worker that was woken and still sleeps may wait for the caller's core. It gets the core for long enough to move to
// another. Where it is on its way elsewhere this takes half a microsecond, unless another process wants the core, which
// it would get a little later anyway: beside a busy process for each core frames take no longer.
static void let_workers_start(const struct rhw_scheduler *scheduler)
{
    const uint32_t sleepers = atomic_load_explicit(&scheduler->sleepers, memory_order_relaxed);
    if (sleepers > scheduler->left_asleep && !scheduler->crowded) {
        rhw_thread_yield();
    }
}

// Return the number that a thread has in the job, of which it has claimed a task. Threads keep theirs from job to job,
// but for jobs of few tasks, where any thread may be the first: those number them in turn, so that few rooms suffice.
static int number_in_job(struct rhw_scheduler *scheduler, int worker)
{
    return worker == 0 || scheduler->count >= (uint32_t)scheduler->threads
               ? worker
               : 1 + atomic_fetch_add_explicit(&scheduler->guests, 1, memory_order_relaxed);
}

// Run tasks until none is left to claim.
static void run_tasks(struct rhw_scheduler *scheduler, int worker)
{
    int number = worker;
    uint32_t finished = 0;
    // The clock is read once per thread and job: a look at it costs as much as a small task.
    uint64_t start = 0;
    uint32_t unclaimed = atomic_load_explicit(&scheduler->unclaimed, memory_order_relaxed);
    while (unclaimed != 0) {
        // Acquire pairs with the release of the store that published the job, so that the fields read below are this
        // job's. Other claims in between continue its release sequence.
        if (!atomic_compare_exchange_weak_explicit(&scheduler->unclaimed, &unclaimed, unclaimed - 1,
                                                   memory_order_acquire, memory_order_relaxed)) {
            rhw_cpu_relax();
            continue;
        }
        if (finished == 0) {
            start = rhw_time_ns();
            number = number_in_job(scheduler, worker);
        }
        scheduler->task(scheduler->user, (int)(scheduler->count - unclaimed), number);
        finished++;
        if (worker == 0 && finished == 1) {
            let_workers_start(scheduler);
        }
        unclaimed = atomic_load_explicit(&scheduler->unclaimed, memory_order_relaxed);
    }
    if (finished == 0) {
        return;
    }
    atomic_fetch_add_explicit(&scheduler->busy_ns, rhw_time_ns() - start, memory_order_relaxed);
    // The job cannot end and no other can start until this thread reports, so all its tasks were of one job. The order
    // is sequentially consistent against the caller, which announces its sleep and then looks once more.
    if (atomic_fetch_sub(&scheduler->unfinished, finished) == finished &&
        atomic_load(&scheduler->caller_sleeps)) {
        rhw_mutex_lock(&scheduler->mutex);
        rhw_condition_signal(&scheduler->done);
        rhw_mutex_unlock(&scheduler->mutex);
    }
}

static bool work_waits(const struct rhw_scheduler *scheduler)
{
    return atomic_load(&scheduler->unclaimed) != 0 || atomic_load(&scheduler->quit);
}

static bool job_is_done(const struct rhw_scheduler *scheduler)
{
    return atomic_load(&scheduler->unfinished) == 0;
}

// Wait a moment for `ready`. Return false when it is time to sleep.
static bool spin_until(const struct rhw_scheduler *scheduler, bool (*ready)(const struct rhw_scheduler *))
{
    if (scheduler->crowded) {
        for (int i = 0; i < YIELDS_WHEN_CROWDED; i++) {
            if (ready(scheduler)) {
                return true;
            }
            rhw_thread_yield();
        }
        return ready(scheduler);
    }
    const uint64_t end = rhw_time_ns() + spin_ns;
    do {
        for (int i = 0; i < RELAX_PER_CLOCK; i++) {
            if (ready(scheduler)) {
                return true;
            }
            rhw_cpu_relax();
        }
    } while (rhw_time_ns() < end);
    return ready(scheduler);
}

static void sleep_until_work(struct rhw_scheduler *scheduler)
{
    rhw_mutex_lock(&scheduler->mutex);
    // The worker announces its sleep and then looks for a job; the caller publishes a job and then looks for sleepers.
    // Both orders are sequentially consistent, so that one of the two sees the other.
    atomic_fetch_add(&scheduler->sleepers, 1);
    while (!work_waits(scheduler)) {
        rhw_condition_wait(&scheduler->work, &scheduler->mutex);
    }
    atomic_fetch_sub(&scheduler->sleepers, 1);
    rhw_mutex_unlock(&scheduler->mutex);
    const int caller_core = atomic_load_explicit(&scheduler->caller_core, memory_order_relaxed);
    if (caller_core >= 0 && caller_core == rhw_cpu_core() && !scheduler->crowded) {
        rhw_cpu_leave(caller_core);
    }
}

static void *worker_main(void *user)
{
    struct worker *const worker = user;
    struct rhw_scheduler *const scheduler = worker->scheduler;
    (void)rhw_cpu_float_enter();
    while (!atomic_load(&scheduler->quit)) {
        run_tasks(scheduler, worker->number);
        if (!spin_until(scheduler, work_waits)) {
            sleep_until_work(scheduler);
        }
    }
    return NULL;
}

static void wake_workers(struct rhw_scheduler *scheduler, uint32_t wanted)
{
    const uint32_t sleepers = atomic_load(&scheduler->sleepers);
    scheduler->left_asleep = sleepers > wanted ? sleepers - wanted : 0;
    if (sleepers == 0) {
        return;
    }
    rhw_mutex_lock(&scheduler->mutex);
    if (wanted >= sleepers) {
        rhw_condition_broadcast(&scheduler->work);
    } else {
        for (uint32_t i = 0; i < wanted; i++) {
            rhw_condition_signal(&scheduler->work);
        }
    }
    rhw_mutex_unlock(&scheduler->mutex);
}

// Return true in the process that has the workers. A child that fork made has the calling thread alone (POSIX.1-2017,
// fork), and a lock that a worker of its parent held stays locked in it.
static bool has_workers(const struct rhw_scheduler *scheduler)
{
    return scheduler->threads > 1 && scheduler->process == rhw_process_id();
}

// Join the first `started` workers.
static void stop_workers(struct rhw_scheduler *scheduler, int started)
{
    atomic_store(&scheduler->quit, true);
    wake_workers(scheduler, UINT32_MAX);
    for (int i = 0; i < started; i++) {
        rhw_thread_join(&scheduler->workers[i].thread);
    }
}

static bool start_workers(struct rhw_scheduler *scheduler)
{
    for (int i = 0; i < scheduler->threads - 1; i++) {
        struct worker *const worker = &scheduler->workers[i];
        *worker = (struct worker){.scheduler = scheduler, .number = i + 1};
        if (!rhw_thread_create(&worker->thread, worker_main, worker)) {
            stop_workers(scheduler, i);
            return false;
        }
    }
    return true;
}

static bool init_locks(struct rhw_scheduler *scheduler)
{
    if (!rhw_mutex_init(&scheduler->mutex)) {
        return false;
    }
    if (!rhw_condition_init(&scheduler->work)) {
        rhw_mutex_destroy(&scheduler->mutex);
        return false;
    }
    if (!rhw_condition_init(&scheduler->done)) {
        rhw_condition_destroy(&scheduler->work);
        rhw_mutex_destroy(&scheduler->mutex);
        return false;
    }
    return true;
}

static void destroy_locks(struct rhw_scheduler *scheduler)
{
    rhw_condition_destroy(&scheduler->done);
    rhw_condition_destroy(&scheduler->work);
    rhw_mutex_destroy(&scheduler->mutex);
}

enum rhw_result rhw_scheduler_create(struct rhw_memory *memory, int threads, int cores,
                                     struct rhw_scheduler **scheduler)
{
    assert(threads >= 1 && threads <= RHW_MAX_THREADS);
    *scheduler = NULL;
    struct rhw_scheduler *const created =
        rhw_memory_allocate(memory, scheduler_size(threads), _Alignof(struct rhw_scheduler));
    if (created == NULL) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    *created = (struct rhw_scheduler){
        .threads = threads, .crowded = threads > cores, .process = rhw_process_id(), .caller_core = -1};
    if (!init_locks(created)) {
        rhw_memory_release(memory, created, scheduler_size(threads));
        return RHW_ERROR_THREAD;
    }
    if (!start_workers(created)) {
        destroy_locks(created);
        rhw_memory_release(memory, created, scheduler_size(threads));
        return RHW_ERROR_THREAD;
    }
    *scheduler = created;
    return RHW_OK;
}

void rhw_scheduler_destroy(struct rhw_memory *memory, struct rhw_scheduler *scheduler)
{
    if (scheduler == NULL) {
        return;
    }
    if (scheduler->threads == 1 || has_workers(scheduler)) {
        stop_workers(scheduler, scheduler->threads - 1);
        destroy_locks(scheduler);
    }
    rhw_memory_release(memory, scheduler, scheduler_size(scheduler->threads));
}

void rhw_scheduler_set_idle(struct rhw_scheduler *scheduler, void (*idle)(void *user), void *user)
{
    scheduler->idle = idle;
    scheduler->idle_user = user;
}

// Sleep until something happens, and do what the caller does meanwhile. The mutex is locked.
static void sleep_awhile(struct rhw_scheduler *scheduler)
{
    if (!scheduler->idle) {
        rhw_condition_wait(&scheduler->done, &scheduler->mutex);
        return;
    }
    rhw_condition_wait_for(&scheduler->done, &scheduler->mutex, idle_ns);
    if (!job_is_done(scheduler)) {
        rhw_mutex_unlock(&scheduler->mutex);
        scheduler->idle(scheduler->idle_user);
        rhw_mutex_lock(&scheduler->mutex);
    }
}

static void wait_for_job(struct rhw_scheduler *scheduler)
{
    if (spin_until(scheduler, job_is_done)) {
        return;
    }
    rhw_mutex_lock(&scheduler->mutex);
    atomic_store(&scheduler->caller_sleeps, true);
    while (!job_is_done(scheduler)) {
        sleep_awhile(scheduler);
    }
    atomic_store(&scheduler->caller_sleeps, false);
    rhw_mutex_unlock(&scheduler->mutex);
}

int rhw_scheduler_workers(const struct rhw_scheduler *scheduler, int count)
{
    return count <= 1 ? 1 : count < scheduler->threads ? count + 1 : scheduler->threads;
}

uint64_t rhw_scheduler_run(struct rhw_scheduler *scheduler, rhw_task_function *task, void *user, int count)
{
    if (count <= 0) {
        return 0;
    }
    atomic_store_explicit(&scheduler->caller, rhw_thread_id(), memory_order_relaxed);
    const uint64_t environment = rhw_cpu_float_enter();
    uint64_t busy_ns;
    if (count == 1 || !has_workers(scheduler)) {
        const uint64_t start = rhw_time_ns();
        for (int i = 0; i < count; i++) {
            task(user, i, 0);
        }
        busy_ns = rhw_time_ns() - start;
    } else {
        scheduler->task = task;
        scheduler->user = user;
        scheduler->count = (uint32_t)count;
        atomic_store_explicit(&scheduler->caller_core, rhw_cpu_core(), memory_order_relaxed);
        atomic_store_explicit(&scheduler->busy_ns, 0, memory_order_relaxed);
        atomic_store_explicit(&scheduler->guests, 0, memory_order_relaxed);
        atomic_store_explicit(&scheduler->unfinished, (uint32_t)count, memory_order_relaxed);
        atomic_store(&scheduler->unclaimed, (uint32_t)count);
        wake_workers(scheduler, (uint32_t)count - 1);
        run_tasks(scheduler, 0);
        wait_for_job(scheduler);
        busy_ns = atomic_load_explicit(&scheduler->busy_ns, memory_order_relaxed);
    }
    rhw_cpu_float_leave(environment);
    atomic_store_explicit(&scheduler->caller, 0, memory_order_relaxed);
    return busy_ns;
}

bool rhw_scheduler_is_caller(const struct rhw_scheduler *scheduler)
{
    return atomic_load_explicit(&scheduler->caller, memory_order_relaxed) == rhw_thread_id();
}

bool rhw_scheduler_runs_here(const struct rhw_scheduler *scheduler)
{
    const uintptr_t self = rhw_thread_id();
    bool works = false;
    for (int i = 0; i < scheduler->threads - 1; i++) {
        works |= scheduler->workers[i].thread.id == self;
    }
    // A thread of a child may have the number of a worker that stayed with the parent.
    return atomic_load_explicit(&scheduler->caller, memory_order_relaxed) == self ||
           (works && has_workers(scheduler));
}
