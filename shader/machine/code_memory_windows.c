// SPDX-License-Identifier: MIT
// Code on Windows. perf is no program of this system.
#include "code_memory.h"

#include <string.h>
#include <windows.h>

void *shader_code_map(const void *bytes, size_t size)
{
    DWORD old;
    void *const code = VirtualAlloc(NULL, size, MEM_COMMIT | MEM_RESERVE, PAGE_READWRITE);
    if (!code) {
        return NULL;
    }
    memcpy(code, bytes, size);
    if (!VirtualProtect(code, size, PAGE_EXECUTE_READ, &old)) {
        (void)VirtualFree(code, 0, MEM_RELEASE);
        return NULL;
    }
    (void)FlushInstructionCache(GetCurrentProcess(), code, size);
    return code;
}

void shader_code_unmap(void *code, size_t size)
{
    (void)size;
    (void)VirtualFree(code, 0, MEM_RELEASE);
}

bool shader_code_name(const void *code, size_t size, const char *name)
{
    (void)code;
    (void)size;
    (void)name;
    return false;
}
