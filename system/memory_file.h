// SPDX-License-Identifier: MIT
// A file for bytes on their way: nobody else sees it, and it is gone when it is closed. In memory on Linux; elsewhere a
// file in the folder for such, which a process that is killed leaves there.
#ifndef SYSTEM_MEMORY_FILE_H
#define SYSTEM_MEMORY_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum { SYSTEM_MEMORY_FILE_PATH = 512 };

/// Zeroed: none. May be copied; one of the copies is closed.
struct system_memory_file {
    FILE *stream; ///< to write and read
    /// This process and its children may open the file by it to read, until it is closed.
    char path[SYSTEM_MEMORY_FILE_PATH];
};

/// `name` is for those who look at what processes have open. False with errno.
bool system_memory_file_open(struct system_memory_file *file, const char *name);
/// Harmless where there is none.
void system_memory_file_close(struct system_memory_file *file);

/// What has been written and flushed, as memory that may be changed without changing the file, and that outlives it.
/// NULL: there is none, or no room.
void *system_memory_file_map(const struct system_memory_file *file, size_t *size);
void system_memory_file_unmap(void *bytes, size_t size);

#endif
