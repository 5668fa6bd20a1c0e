// SPDX-License-Identifier: MIT
// See child.h. When a child leaves, it and the threads that it has started may be anywhere: the first to leave says how the
// child ended, and then sleeps, as all do that come later. Nothing is taken from them, so what they use stays until the
// program ends.
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
    struct system_child child;
    int (*run)(const void *user, struct system_child *child);
    const void *user;
};

static void end(struct system_child *child, int status)
{
    fflush(child->reply);
    child->status = status;
    SetEvent(child->ended);
}

_Noreturn void system_child_leave(struct system_child *child, int status)
{
    if (InterlockedExchange(&child->leaving, 1) == 0) {
        end(child, status);
    }
    for (;;) {
        Sleep(INFINITE);
    }
}

static unsigned __stdcall run(void *user)
{
    struct thread *const thread = user;
    const int status = thread->run(thread->user, &thread->child);
    if (InterlockedExchange(&thread->child.leaving, 2) == 0) {
        end(&thread->child, status);
    }
    return 0;
}

// Whether the child has ended in its time. Where nobody wants it any more it is not wanted, but waited for.
static bool wait_for(HANDLE ended, const struct system_child_work *work, bool *is_wanted)
{
    const ULONGLONG last = GetTickCount64() + 1000ull * work->wall_seconds;
    while (WaitForSingleObject(ended, PATIENCE_MS) != WAIT_OBJECT_0) {
        *is_wanted = *is_wanted && (!work->goes_on || work->goes_on(work->goes_on_user));
        if (GetTickCount64() >= last) {
            return false;
        }
    }
    return true;
}

static struct system_child_result no_start(struct thread *thread, struct system_memory_file *reply)
{
    if (thread && thread->child.ended) {
        CloseHandle(thread->child.ended);
    }
    free(thread);
    system_memory_file_close(reply);
    return (struct system_child_result){.end = SYSTEM_CHILD_NOT_STARTED, .number = EAGAIN};
}

struct system_child_result system_child_run(const struct system_child_work *work)
{
    struct system_memory_file reply;
    if (!system_memory_file_open(&reply, "rhw-model")) {
        return (struct system_child_result){.end = SYSTEM_CHILD_NOT_STARTED, .number = errno};
    }
    struct thread *const thread = calloc(1, sizeof *thread);
    HANDLE ended = thread ? CreateEventA(NULL, TRUE, FALSE, NULL) : NULL;
    if (!ended) {
        return no_start(thread, &reply);
    }
    *thread = (struct thread){
        .child = {.reply = reply.stream, .ended = ended}, .run = work->run, .user = work->user};
    const uintptr_t handle =
        _beginthreadex(NULL, STACK, run, thread, STACK_SIZE_PARAM_IS_A_RESERVATION, NULL);
    if (handle == 0) {
        return no_start(thread, &reply);
    }
    CloseHandle((HANDLE)handle);
    bool is_wanted = true;
    if (!wait_for(ended, work, &is_wanted)) {
        return (struct system_child_result){.end = SYSTEM_CHILD_WALL_TIME}; // it may be writing to its reply
    }
    const struct system_child_result result = {.end = is_wanted ? SYSTEM_CHILD_LEFT : SYSTEM_CHILD_GIVEN_UP,
                                               .number = thread->child.status,
                                               .reply = reply};
    if (thread->child.leaving == 2) { // by its end, with all threads that it had
        CloseHandle(ended);
        free(thread);
    }
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
