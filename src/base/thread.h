// SPDX-License-Identifier: MIT
// The little of threads that the library uses. thread_posix.c and thread_windows.c implement it.
#ifndef RHW_THREAD_H
#define RHW_THREAD_H

#include <stdbool.h>
#include <stdint.h>
#if !defined(_WIN32)
#include <pthread.h>
#endif

#if defined(_WIN32)
struct rhw_mutex {
    void *handle; // an SRWLOCK
};
struct rhw_condition {
    void *handle; // a CONDITION_VARIABLE
};
struct rhw_thread {
    void *handle;
    uintptr_t id; // what rhw_thread_id gives in the thread
    void *(*entry)(void *user);
    void *user;
};
#else
struct rhw_mutex {
    pthread_mutex_t handle;
};
struct rhw_condition {
    pthread_cond_t handle;
};
struct rhw_thread {
    pthread_t handle;
    uintptr_t id; // what rhw_thread_id gives in the thread
};
#endif

bool rhw_mutex_init(struct rhw_mutex *mutex);
void rhw_mutex_destroy(struct rhw_mutex *mutex);
void rhw_mutex_lock(struct rhw_mutex *mutex);
void rhw_mutex_unlock(struct rhw_mutex *mutex);

bool rhw_condition_init(struct rhw_condition *condition);
void rhw_condition_destroy(struct rhw_condition *condition);
void rhw_condition_wait(struct rhw_condition *condition, struct rhw_mutex *mutex);
// Wait, and go on after `ns` nanoseconds, less than a second, at the latest.
void rhw_condition_wait_for(struct rhw_condition *condition, struct rhw_mutex *mutex, uint32_t ns);
void rhw_condition_signal(struct rhw_condition *condition);
void rhw_condition_broadcast(struct rhw_condition *condition);

// Start a thread. Return false when the operating system refuses it. Signals of the program are blocked in it.
// `*thread` stays where it is until the thread is joined.
bool rhw_thread_create(struct rhw_thread *thread, void *(*entry)(void *user), void *user);
void rhw_thread_join(struct rhw_thread *thread);

// Return a number that tells the calling thread from all others that run. It is never 0.
uintptr_t rhw_thread_id(void);

// Return a number that tells the process from its children.
uintptr_t rhw_process_id(void);

// Give the core to another thread.
void rhw_thread_yield(void);

// Return monotonic time in nanoseconds, for spin limits and statistics.
uint64_t rhw_time_ns(void);

// Tell the core that this is a spin loop.
static inline void rhw_cpu_relax(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

#endif
