// SPDX-License-Identifier: MIT
// Threads on POSIX. Calls that can only fail by a bug of ours are asserted, not reported.
#include "thread.h"

#include <assert.h>
#include <errno.h>
#include <sched.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

// Bytes. Shaders are the user's code and run here, so the stack has room for them on every libc (musl's default is 128
// KiB). Only pages that are touched cost memory.
enum { STACK_SIZE = 4 << 20 };

bool rhw_mutex_init(struct rhw_mutex *mutex)
{
    return pthread_mutex_init(&mutex->handle, NULL) == 0;
}

void rhw_mutex_destroy(struct rhw_mutex *mutex)
{
    const int error = pthread_mutex_destroy(&mutex->handle);
    assert(error == 0);
    (void)error;
}

void rhw_mutex_lock(struct rhw_mutex *mutex)
{
    const int error = pthread_mutex_lock(&mutex->handle);
    assert(error == 0);
    (void)error;
}

void rhw_mutex_unlock(struct rhw_mutex *mutex)
{
    const int error = pthread_mutex_unlock(&mutex->handle);
    assert(error == 0);
    (void)error;
}

bool rhw_condition_init(struct rhw_condition *condition)
{
    return pthread_cond_init(&condition->handle, NULL) == 0;
}

void rhw_condition_destroy(struct rhw_condition *condition)
{
    const int error = pthread_cond_destroy(&condition->handle);
    assert(error == 0);
    (void)error;
}

void rhw_condition_wait(struct rhw_condition *condition, struct rhw_mutex *mutex)
{
    const int error = pthread_cond_wait(&condition->handle, &mutex->handle);
    assert(error == 0);
    (void)error;
}

// The default clock of a condition is that of the time of day, which all systems have.
void rhw_condition_wait_for(struct rhw_condition *condition, struct rhw_mutex *mutex, uint32_t ns)
{
    const long second = 1000000000;
    struct timespec time;
    clock_gettime(CLOCK_REALTIME, &time);
    time.tv_nsec += (long)ns;
    time.tv_sec += time.tv_nsec >= second;
    time.tv_nsec -= time.tv_nsec >= second ? second : 0;
    const int error = pthread_cond_timedwait(&condition->handle, &mutex->handle, &time);
    assert(error == 0 || error == ETIMEDOUT);
    (void)error;
}

void rhw_condition_signal(struct rhw_condition *condition)
{
    const int error = pthread_cond_signal(&condition->handle);
    assert(error == 0);
    (void)error;
}

void rhw_condition_broadcast(struct rhw_condition *condition)
{
    const int error = pthread_cond_broadcast(&condition->handle);
    assert(error == 0);
    (void)error;
}

// Create a thread that inherits a full signal mask: a signal of the program must find a thread of the program.
static bool create_with_signals_blocked(struct rhw_thread *thread, const pthread_attr_t *attributes,
                                        void *(*entry)(void *user), void *user)
{
    sigset_t all;
    sigset_t before;
    sigfillset(&all);
    // A fault in a shader must still end the program where it happened.
    sigdelset(&all, SIGSEGV);
    sigdelset(&all, SIGBUS);
    sigdelset(&all, SIGFPE);
    sigdelset(&all, SIGILL);
    sigdelset(&all, SIGTRAP);
    sigdelset(&all, SIGABRT);
    sigdelset(&all, SIGPROF); // for sampling profilers
    if (pthread_sigmask(SIG_SETMASK, &all, &before) != 0) {
        return false;
    }
    const bool created = pthread_create(&thread->handle, attributes, entry, user) == 0;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return created;
}

bool rhw_thread_create(struct rhw_thread *thread, void *(*entry)(void *user), void *user)
{
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0) {
        return false;
    }
    const bool created = pthread_attr_setstacksize(&attributes, STACK_SIZE) == 0 &&
                         create_with_signals_blocked(thread, &attributes, entry, user);
    pthread_attr_destroy(&attributes);
    thread->id = created ? (uintptr_t)thread->handle : 0;
    return created;
}

void rhw_thread_join(struct rhw_thread *thread)
{
    const int error = pthread_join(thread->handle, NULL);
    assert(error == 0);
    (void)error;
}

uintptr_t rhw_thread_id(void)
{
    return (uintptr_t)pthread_self();
}

uintptr_t rhw_process_id(void)
{
    return (uintptr_t)getpid();
}

void rhw_thread_yield(void)
{
    sched_yield();
}

uint64_t rhw_time_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}
