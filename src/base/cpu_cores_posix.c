// SPDX-License-Identifier: MIT
// Cores on POSIX: how many there are, which one a thread runs on, and another for it. On Linux they are the cores that
// the process may use, not all that the machine has.
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE // for sched_getaffinity and sched_getcpu
#endif
#include "cpu.h"

#if defined(__linux__)
#include <sched.h>

#include "cpu_quota.h"
#endif
#include <unistd.h>

int rhw_cpu_cores(void)
{
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
    return 1; // this build cannot make threads
#else
#if defined(__linux__)
    // Count what this process may use, not what the machine has: containers and taskset narrow it.
    const int most = rhw_cpu_quota("/proc/self/cgroup", "/sys/fs/cgroup");
    cpu_set_t set;
    if (sched_getaffinity(0, sizeof set, &set) == 0) {
        const int count = CPU_COUNT(&set);
        if (count > 0) {
            return count < most ? count : most;
        }
    }
#else
    const int most = 4096;
#endif
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online > 0 ? (int)(online < most ? online : most) : 1;
#endif
}

int rhw_cpu_core(void)
{
#if defined(__linux__)
    return sched_getcpu();
#else
    return -1;
#endif
}

// A thread whose affinity loses its core is moved at once, and is not moved back when the core is added again. Where
// the system refuses, as some sandboxes do, the thread stays on `core`.
void rhw_cpu_leave(int core)
{
#if defined(__linux__)
    cpu_set_t all;
    if (core < 0 || sched_getaffinity(0, sizeof all, &all) != 0) {
        return;
    }
    cpu_set_t others = all;
    CPU_CLR((size_t)core, &others);
    if (CPU_COUNT(&others) > 0 && sched_setaffinity(0, sizeof others, &others) == 0) {
        (void)sched_setaffinity(0, sizeof all, &all);
    }
#else
    (void)core;
#endif
}
