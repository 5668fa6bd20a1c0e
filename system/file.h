// SPDX-License-Identifier: MIT
// Files and folders, as far as ISO C and what mingw-w64 has of POSIX do not reach.
#ifndef SYSTEM_FILE_H
#define SYSTEM_FILE_H

#include <stdbool.h>
#include <stddef.h>

enum system_file_use {
    SYSTEM_FILE_READ,  ///< opening a pipe does not wait for who writes into it
    SYSTEM_FILE_WRITE, ///< what is there already
};

/// A descriptor of bytes as they are, which programs that are started do not get; −1 with errno.
int system_file_open(const char *path, enum system_file_use use);
/// A descriptor for reading a regular file; −1 with errno. Anything else, of which a pipe would be waited for and a
/// device may do something, is not opened: errno is then 0.
int system_file_open_regular(const char *path);
/// Gives an open file the permissions of another, as far as it may have them. Windows has those of its folder.
void system_file_permit_as(int descriptor, const char *path);

/// The whole path without links and with slashes, to be freed; NULL with errno.
char *system_file_resolve(const char *path);
/// Whether both are there and one.
bool system_file_is_same(const char *path, const char *other);
/// Whether a name leads elsewhere.
bool system_file_is_link(const char *path);
/// Whether both are there, and the first was not changed before the second.
bool system_file_is_newer(const char *path, const char *other);

/// Makes a folder in one that is there. False with errno.
bool system_folder_make(const char *path);
/// Makes one that had no name before, and gives its path. False where there is none.
bool system_folder_make_unnamed(char *path, size_t size);

#endif
