// SPDX-License-Identifier: MIT
// See child.h. A thread that leaves takes nothing back: what its readers have allocated stays until the program ends.
#include "child.h"

#include <errno.h>
#include <stdlib.h>

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <process.h>

enum {
    STACK = 16 << 20, // bytes; readers of nested files call themselves
    PATIENCE_MS = 20
};

struct thread {
    struct system_child child; // first: system_child_leave has its address
    struct system_child_work work;
    struct system_memory_file reply; // none once the result has it
    HANDLE ended;                    // an event
    int status;
    LONG owners; // the thread and who waits for it
};

static void disown(struct thread *thread)
{
    if (InterlockedDecrement(&thread->owners) > 0) {
        return;
    }
    thread->work.release(thread->work.user);
    system_memory_file_close(&thread->reply);
    if (thread->ended) {
        CloseHandle(thread->ended);
    }
    free(thread);
}

static void end(struct thread *thread, int status)
{
    fflush(thread->child.reply);
    thread->status = status;
    SetEvent(thread->ended);
    disown(thread);
}

_Noreturn void system_child_leave(struct system_child *child, int status)
{
    end((struct thread *)child, status);
    _endthreadex(0);
    abort(); // its declaration does not say that it never returns
}

static unsigned __stdcall run(void *user)
{
    struct thread *const thread = user;
    end(thread, thread->work.run(thread->work.user, &thread->child));
    return 0;
}

// Whether the child has ended in its time. Where nobody wants it any more it is not wanted, but waited for.
static bool wait_for(HANDLE ended, const struct system_child_work *work, bool *is_wanted)
{
    const ULONGLONG last = GetTickCount64() + 1000ull * work->wall_seconds;
    while (WaitForSingleObject(ended, PATIENCE_MS) != WAIT_OBJECT_0) {
        *is_wanted = *is_wanted && (!work->goes_on || work->goes_on(work->goes_on_user));
        if (!work->is_borrowing && GetTickCount64() >= last) {
            return false;
        }
    }
    return true;
}

// With the caller as its owner. NULL: the work is released, and `problem` is an errno.
static struct thread *make_thread(const struct system_child_work *work, int *problem)
{
    struct thread *const thread = calloc(1, sizeof *thread);
    *problem = EAGAIN;
    if (!thread) {
        work->release(work->user);
        return NULL;
    }
    *thread = (struct thread){.work = *work, .owners = 1};
    if (!system_memory_file_open(&thread->reply, "rhw-model")) {
        *problem = errno;
        disown(thread);
        return NULL;
    }
    thread->child.reply = thread->reply.stream;
    thread->ended = CreateEventA(NULL, TRUE, FALSE, NULL);
    if (!thread->ended) {
        disown(thread);
        return NULL;
    }
    return thread;
}

static bool start(struct thread *thread)
{
    thread->owners++;
    const uintptr_t handle =
        _beginthreadex(NULL, STACK, run, thread, STACK_SIZE_PARAM_IS_A_RESERVATION, NULL);
    if (handle == 0) {
        thread->owners--;
        return false;
    }
    CloseHandle((HANDLE)handle);
    return true;
}

// Takes the reply of a thread that has ended; one that has not may be writing to it.
static struct system_child_result wait_for_result(struct thread *thread)
{
    bool is_wanted = true;
    if (!wait_for(thread->ended, &thread->work, &is_wanted)) {
        return (struct system_child_result){.end = SYSTEM_CHILD_WALL_TIME};
    }
    const struct system_child_result result = {.end = is_wanted ? SYSTEM_CHILD_LEFT : SYSTEM_CHILD_GIVEN_UP,
                                               .number = thread->status,
                                               .reply = thread->reply};
    thread->reply = (struct system_memory_file){0};
    return result;
}

struct system_child_result system_child_run(const struct system_child_work *work)
{
    struct system_child_result result = {.end = SYSTEM_CHILD_NOT_STARTED, .number = EAGAIN};
    struct thread *const thread = make_thread(work, &result.number);
    if (!thread) {
        return result;
    }
    if (start(thread)) {
        result = wait_for_result(thread);
    }
    disown(thread);
    return result;
}

void *system_child_share(size_t size)
{
    return calloc(1, size);
}

void system_child_unshare(void *memory, size_t size)
{
    (void)size;
    free(memory);
}
