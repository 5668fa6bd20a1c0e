// SPDX-License-Identifier: MIT
// Cores on Windows are those of the process's affinity. A machine of more than 64 cores has them in groups, and a
// process that starts may use all groups.
#include "cpu.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

int rhw_cpu_cores(void)
{
    DWORD_PTR process, machine;
    int count = 0;
    if (GetActiveProcessorGroupCount() > 1) {
        count = (int)GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
    } else if (GetProcessAffinityMask(GetCurrentProcess(), &process, &machine)) {
        count = __builtin_popcountll(process);
    }
    return count > 0 ? count : 1;
}

// Windows puts threads that wake on cores that are idle.
int rhw_cpu_core(void)
{
    return -1;
}

void rhw_cpu_leave(int core)
{
    (void)core;
}
