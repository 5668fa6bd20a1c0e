// SPDX-License-Identifier: MIT
// See machine.h.
#include "machine.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

int system_machine_processors(void)
{
    const DWORD count = GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
    return count > 0 ? (int)count : 1;
}

size_t system_machine_memory(void)
{
    MEMORYSTATUSEX status = {.dwLength = sizeof status};
    return GlobalMemoryStatusEx(&status) ? (size_t)status.ullTotalPhys : 0;
}
