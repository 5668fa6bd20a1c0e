// SPDX-License-Identifier: MIT
// See child.h.
#include "child.h"

#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif

#include "huge_pages.h"
#include "memory_limit.h"
#include "sanitizer.h"

// Child ---------------------------------------------------------------------------------------------

_Noreturn void system_child_leave(struct system_child *child, int status)
{
    fflush(child->reply);
    _exit(status);
}

// What is wanted, or what is allowed already where that is less.
static rlim_t soft_limit(rlim_t wanted, const struct rlimit *limit)
{
    rlim_t least = wanted;
    least = limit->rlim_max != RLIM_INFINITY && limit->rlim_max < least ? limit->rlim_max : least;
    return limit->rlim_cur != RLIM_INFINITY && limit->rlim_cur < least ? limit->rlim_cur : least;
}

static void limit_core(void)
{
    const struct rlimit none = {0, 0};
    setrlimit(RLIMIT_CORE, &none);
}

static void limit_time(const struct system_child_work *work)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_CPU, &limit) == 0) {
        limit.rlim_cur = soft_limit(work->cpu_seconds, &limit);
        setrlimit(RLIMIT_CPU, &limit);
    }
    alarm(work->wall_seconds);
}

static void limit_memory(size_t bytes)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) == 0) {
        limit.rlim_cur = soft_limit(system_memory_mapped() + bytes, &limit);
        setrlimit(RLIMIT_AS, &limit);
    }
}

static void restrict_child(const struct system_child_work *work)
{
#if defined(__linux__)
    prctl(PR_SET_PDEATHSIG, SIGKILL); // elsewhere a child whose parent is killed ends by its time
#endif
    limit_core();
    if (!SYSTEM_SANITIZED && work->memory > 0) {
        limit_memory(work->memory);
    }
    setlocale(LC_ALL, "C"); // numbers in files have points
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    static const int deadly[] = {SIGXCPU, SIGALRM, SIGABRT, SIGTERM, SIGINT};
    for (size_t i = 0; i < sizeof deadly / sizeof deadly[0]; i++) {
        signal(deadly[i], SIG_DFL);
    }
    limit_time(work);
}

// What the libraries print is not part of our one line. Under a sanitizer its report must be seen.
static void silence(void)
{
    const int null = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (null < 0) {
        return;
    }
    dup2(null, STDIN_FILENO);
    dup2(null, STDOUT_FILENO);
    if (!SYSTEM_SANITIZED) {
        dup2(null, STDERR_FILENO);
    }
}

// Parent --------------------------------------------------------------------------------------------

// A small part of a second: who waits and asks is not to take the child's processor, nor to add to its time.
static void rest(void)
{
    const struct timespec pause = {.tv_nsec = 2000000};
    nanosleep(&pause, NULL);
}

static struct system_child_result result_of(int status)
{
    if (WIFSIGNALED(status)) {
        const int number = WTERMSIG(status);
        return (struct system_child_result){.end = number == SIGXCPU   ? SYSTEM_CHILD_CPU_TIME
                                                   : number == SIGALRM ? SYSTEM_CHILD_WALL_TIME
                                                   : number == SIGKILL ? SYSTEM_CHILD_KILLED
                                                                       : SYSTEM_CHILD_SIGNAL,
                                            .number = number};
    }
    return (struct system_child_result){.end = SYSTEM_CHILD_LEFT, .number = WEXITSTATUS(status)};
}

// Waits for the child to end; kills it where nobody wants it any more.
static struct system_child_result wait_for(pid_t child, const struct system_child_work *work)
{
    bool goes_on = true;
    for (;;) {
        int status = 0;
        const pid_t waited = waitpid(child, &status, work->goes_on && goes_on ? WNOHANG : 0);
        if (waited == child) {
            return goes_on ? result_of(status) : (struct system_child_result){.end = SYSTEM_CHILD_GIVEN_UP};
        }
        if (waited < 0 && errno != EINTR) {
            return (struct system_child_result){.end = SYSTEM_CHILD_NOT_STARTED, .number = errno};
        }
        if (waited == 0) {
            rest();
            goes_on = work->goes_on(work->goes_on_user);
            if (!goes_on) {
                kill(child, SIGKILL);
            }
        }
    }
}

struct system_child_result system_child_run(const struct system_child_work *work)
{
    struct system_memory_file reply;
    if (!system_memory_file_open(&reply, "rhw-model")) {
        const int problem = errno;
        work->release(work->user);
        return (struct system_child_result){.end = SYSTEM_CHILD_NOT_STARTED, .number = problem};
    }
    const pid_t child = fork();
    if (child == 0) {
        restrict_child(work);
        silence();
        system_huge_pages_prefer_heap(work->memory > 0 ? work->memory / 8 : SIZE_MAX);
        struct system_child self = {.reply = reply.stream};
        system_child_leave(&self, work->run(work->user, &self));
    }
    struct system_child_result result =
        child < 0 ? (struct system_child_result){.end = SYSTEM_CHILD_NOT_STARTED, .number = errno}
                  : wait_for(child, work);
    work->release(work->user); // the child has its own copy
    result.reply = reply;
    return result;
}

void *system_child_share(size_t size)
{
    void *const memory = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? NULL : memory;
}

void system_child_unshare(void *memory, size_t size)
{
    munmap(memory, size);
}
