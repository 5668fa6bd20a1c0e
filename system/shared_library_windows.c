// SPDX-License-Identifier: MIT
// See shared_library.h.
#include "shared_library.h"

#include <string.h>
#include <windows.h>

void *system_shared_library_open(const char *name)
{
    return (void *)LoadLibraryA(name);
}

bool system_shared_library_find(void *library, const char *name, void (**function)(void))
{
    const FARPROC symbol = GetProcAddress((HMODULE)library, name);
    memcpy(function, &symbol, sizeof symbol);
    return symbol != NULL;
}
