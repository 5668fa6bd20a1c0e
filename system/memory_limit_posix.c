// SPDX-License-Identifier: MIT
// See memory_limit.h.
#include "memory_limit.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include "sanitizer.h"

bool system_memory_limit_is_there(void)
{
    return true;
}

void system_memory_limit_set(size_t bytes)
{
    struct rlimit limit;
    if (!SYSTEM_SANITIZED && getrlimit(RLIMIT_AS, &limit) == 0 &&
        (limit.rlim_max == RLIM_INFINITY || limit.rlim_max > bytes)) {
        limit.rlim_cur = bytes;
        setrlimit(RLIMIT_AS, &limit);
    }
}

uint64_t system_memory_limit_lower(uint64_t bytes)
{
    struct rlimit limit;
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) {
        return 0;
    }
    const uint64_t before = limit.rlim_cur;
    if (bytes < before) {
        limit.rlim_cur = (rlim_t)bytes;
        setrlimit(RLIMIT_AS, &limit);
    }
    return before;
}

void system_memory_limit_restore(uint64_t before)
{
    struct rlimit limit;
    if (before != 0 && getrlimit(RLIMIT_AS, &limit) == 0) {
        limit.rlim_cur = (rlim_t)before;
        setrlimit(RLIMIT_AS, &limit);
    }
}

uint64_t system_memory_mapped(void)
{
#if defined(__linux__)
    char text[64];
    const int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    const ssize_t length = file >= 0 ? read(file, text, sizeof text - 1) : -1;
    if (file >= 0) {
        close(file);
    }
    text[length > 0 ? length : 0] = 0;
    return (uint64_t)strtoull(text, NULL, 10) * (uint64_t)sysconf(_SC_PAGESIZE);
#else
    return 0;
#endif
}

uint64_t system_memory_peak(void)
{
#if defined(__APPLE__)
    const uint64_t unit = 1; // bytes
#else
    const uint64_t unit = 1024;
#endif
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (uint64_t)usage.ru_maxrss * unit : 0;
}
