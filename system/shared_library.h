// SPDX-License-Identifier: MIT
// Libraries that few runs need, and that take longer to start than the others together: they are opened when they are
// needed.
#ifndef SYSTEM_SHARED_LIBRARY_H
#define SYSTEM_SHARED_LIBRARY_H

#include <stdbool.h>

/// Opens a shared library by its name. It stays open to the end of the process. NULL where there is none.
void *system_shared_library_open(const char *name);
/// Sets a pointer to a function of an open library; false where it has none of that name.
bool system_shared_library_find(void *library, const char *name, void (**function)(void));

#endif
