// SPDX-License-Identifier: MIT
// See temporary_file.h. The lock belongs to the open file, so that it lasts until the last process that has it open is
// gone.
#if defined(__linux__)
#define _GNU_SOURCE // O_TMPFILE
#endif
#include "temporary_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

// False where another process has the lock; true, without one, where the folder has no locks.
static bool lock(int descriptor)
{
    return flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

// Whether a file is still what its name leads to.
static bool is_named(int descriptor, const char *path)
{
    struct stat open_file, named_file;
    return fstat(descriptor, &open_file) == 0 && lstat(path, &named_file) == 0 &&
           open_file.st_dev == named_file.st_dev && open_file.st_ino == named_file.st_ino;
}

#if defined(O_TMPFILE)
static void write_place(int descriptor, char place[32])
{
    snprintf(place, 32, "/proc/self/fd/%d", descriptor);
}

int system_temporary_file_open(const char *folder)
{
    const int descriptor = open(folder, O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    char place[32];
    write_place(descriptor, place);
    // It can get a name where /proc is there alone.
    if (descriptor >= 0 && (!lock(descriptor) || access(place, F_OK) != 0)) {
        close(descriptor);
        errno = ENOTSUP;
        return -1;
    }
    return descriptor;
}

bool system_temporary_file_name(int descriptor, const char *path)
{
    char place[32];
    write_place(descriptor, place);
    return linkat(AT_FDCWD, place, AT_FDCWD, path, AT_SYMLINK_FOLLOW) == 0;
}
#else
int system_temporary_file_open(const char *folder)
{
    (void)folder;
    errno = ENOTSUP;
    return -1;
}

bool system_temporary_file_name(int descriptor, const char *path)
{
    (void)descriptor, (void)path;
    errno = ENOTSUP;
    return false;
}
#endif

int system_temporary_file_create(const char *path)
{
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    // Until it is locked, another process may take it for a leftover.
    if (descriptor >= 0 && (!lock(descriptor) || !is_named(descriptor, path))) {
        close(descriptor);
        errno = EEXIST;
        return -1;
    }
    return descriptor;
}

bool system_temporary_file_remove(const char *path)
{
    const int descriptor = open(path, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    struct stat status;
    // Only who has the lock removes it, so that it cannot be the new file of another process meanwhile.
    const bool removed = descriptor >= 0 && fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) &&
                         flock(descriptor, LOCK_EX | LOCK_NB) == 0 && is_named(descriptor, path) &&
                         unlink(path) == 0;
    if (descriptor >= 0) {
        close(descriptor);
    }
    return removed;
}

bool system_temporary_file_replace(int *descriptor, const char *from, const char *to)
{
    (void)descriptor;
    return rename(from, to) == 0;
}
