// SPDX-License-Identifier: MIT
// See shared_library.h.
#include "shared_library.h"

#include <dlfcn.h>
#include <stddef.h>
#include <string.h>

void *system_shared_library_open(const char *name)
{
    return dlopen(name, RTLD_NOW | RTLD_LOCAL);
}

bool system_shared_library_find(void *library, const char *name, void (**function)(void))
{
    void *const symbol = dlsym(library, name);
    memcpy(function, &symbol, sizeof symbol); // POSIX has both pointers of one kind, C has not
    return symbol != NULL;
}
