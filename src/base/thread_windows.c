// SPDX-License-Identifier: MIT
// Threads on Windows. The system's locks and conditions are a pointer each and need not be destroyed.
#include "thread.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <assert.h>
#include <process.h>

// Bytes. Shaders are the user's code and run here. Only pages that are touched cost memory.
enum { STACK_SIZE = 4 << 20 };

static_assert(sizeof(SRWLOCK) == sizeof(struct rhw_mutex), "a mutex is one pointer");
static_assert(sizeof(CONDITION_VARIABLE) == sizeof(struct rhw_condition), "a condition is one pointer");

static SRWLOCK *lock_of(struct rhw_mutex *mutex)
{
    return (SRWLOCK *)&mutex->handle;
}

static CONDITION_VARIABLE *variable_of(struct rhw_condition *condition)
{
    return (CONDITION_VARIABLE *)&condition->handle;
}

bool rhw_mutex_init(struct rhw_mutex *mutex)
{
    InitializeSRWLock(lock_of(mutex));
    return true;
}

void rhw_mutex_destroy(struct rhw_mutex *mutex)
{
    (void)mutex;
}

void rhw_mutex_lock(struct rhw_mutex *mutex)
{
    AcquireSRWLockExclusive(lock_of(mutex));
}

void rhw_mutex_unlock(struct rhw_mutex *mutex)
{
    ReleaseSRWLockExclusive(lock_of(mutex));
}

bool rhw_condition_init(struct rhw_condition *condition)
{
    InitializeConditionVariable(variable_of(condition));
    return true;
}

void rhw_condition_destroy(struct rhw_condition *condition)
{
    (void)condition;
}

void rhw_condition_wait(struct rhw_condition *condition, struct rhw_mutex *mutex)
{
    const BOOL woken = SleepConditionVariableSRW(variable_of(condition), lock_of(mutex), INFINITE, 0);
    assert(woken);
    (void)woken;
}

void rhw_condition_wait_for(struct rhw_condition *condition, struct rhw_mutex *mutex, uint32_t ns)
{
    const BOOL woken = SleepConditionVariableSRW(variable_of(condition), lock_of(mutex), ns / 1000000 + 1, 0);
    assert(woken || GetLastError() == ERROR_TIMEOUT);
    (void)woken;
}

void rhw_condition_signal(struct rhw_condition *condition)
{
    WakeConditionVariable(variable_of(condition));
}

void rhw_condition_broadcast(struct rhw_condition *condition)
{
    WakeAllConditionVariable(variable_of(condition));
}

static unsigned __stdcall run_entry(void *user)
{
    const struct rhw_thread *const thread = user;
    (void)thread->entry(thread->user);
    return 0;
}

bool rhw_thread_create(struct rhw_thread *thread, void *(*entry)(void *user), void *user)
{
    thread->entry = entry;
    thread->user = user;
    unsigned id;
    const uintptr_t handle =
        _beginthreadex(NULL, STACK_SIZE, run_entry, thread, STACK_SIZE_PARAM_IS_A_RESERVATION, &id);
    thread->handle = (void *)handle;
    thread->id = handle != 0 ? id : 0;
    return handle != 0;
}

void rhw_thread_join(struct rhw_thread *thread)
{
    const DWORD ended = WaitForSingleObject(thread->handle, INFINITE);
    assert(ended == WAIT_OBJECT_0);
    (void)ended;
    CloseHandle(thread->handle);
}

uintptr_t rhw_thread_id(void)
{
    return GetCurrentThreadId();
}

uintptr_t rhw_process_id(void)
{
    return GetCurrentProcessId();
}

void rhw_thread_yield(void)
{
    SwitchToThread();
}

uint64_t rhw_time_ns(void)
{
    LARGE_INTEGER now, frequency;
    QueryPerformanceCounter(&now);
    QueryPerformanceFrequency(&frequency);
    const uint64_t ticks = (uint64_t)now.QuadPart, per_second = (uint64_t)frequency.QuadPart;
    // Whole seconds are converted apart from the rest, so that no product overflows.
    return ticks / per_second * 1000000000u + ticks % per_second * 1000000000u / per_second;
}
