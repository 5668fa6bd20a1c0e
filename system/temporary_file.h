// SPDX-License-Identifier: MIT
// Files that are being written, and what is left of one whose process was killed: nothing where the system has files
// without a name, else a file that tells, by a lock which ended with its process, that it belongs to nobody.
#ifndef SYSTEM_TEMPORARY_FILE_H
#define SYSTEM_TEMPORARY_FILE_H

#include <stdbool.h>

/// A descriptor for writing a new file without a name, which vanishes with the process; −1 with errno where the system
/// or the folder has none.
int system_temporary_file_open(const char *folder);
/// Gives a file of system_temporary_file_open a name. False with errno, EEXIST where there is a file of that name.
bool system_temporary_file_name(int descriptor, const char *path);
/// A descriptor for writing a new file, which others may rename and remove while it is open; −1 with errno, EEXIST
/// where there is a file of that name.
int system_temporary_file_create(const char *path);
/// Gives a file that has a name another one in its folder, at once, whether or not there is a file of that name. Where
/// a file has to be closed for that, *descriptor is −1 then. False with errno.
bool system_temporary_file_replace(int *descriptor, const char *from, const char *to);
/// Removes a file that the functions above gave its name, and whose process is gone. False where there is none.
bool system_temporary_file_remove(const char *path);

#endif
