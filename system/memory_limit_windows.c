// SPDX-License-Identifier: MIT
// See memory_limit.h.
#include "memory_limit.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#define PSAPI_VERSION 2 // in kernel32
#include <psapi.h>

bool system_memory_limit_is_there(void)
{
    return false;
}

void system_memory_limit_set(size_t bytes)
{
    (void)bytes;
}

uint64_t system_memory_limit_lower(uint64_t bytes)
{
    (void)bytes;
    return 0;
}

void system_memory_limit_restore(uint64_t before)
{
    (void)before;
}

uint64_t system_memory_mapped(void)
{
    return 0; // nobody asks where there are no limits
}

uint64_t system_memory_peak(void)
{
    PROCESS_MEMORY_COUNTERS counters;
    return GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters) ? counters.PeakWorkingSetSize
                                                                                 : 0;
}
