// SPDX-License-Identifier: MIT
// See file.h.
#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

int system_file_open(const char *path, enum system_file_use use)
{
    return open(path, (use == SYSTEM_FILE_READ ? O_RDONLY | O_NONBLOCK : O_WRONLY) | O_CLOEXEC);
}

void system_file_permit_as(int descriptor, const char *path)
{
    struct stat status;
    if (stat(path, &status) == 0) {
        (void)fchmod(descriptor, status.st_mode & 07777);
    }
}

char *system_file_resolve(const char *path)
{
    return realpath(path, NULL);
}

bool system_file_is_same(const char *path, const char *other)
{
    struct stat one, two;
    return stat(path, &one) == 0 && stat(other, &two) == 0 && one.st_dev == two.st_dev &&
           one.st_ino == two.st_ino;
}

bool system_file_is_link(const char *path)
{
    struct stat status;
    return lstat(path, &status) == 0 && S_ISLNK(status.st_mode);
}

bool system_file_is_newer(const char *path, const char *other)
{
    struct stat one, two;
    if (stat(path, &one) != 0 || stat(other, &two) != 0) {
        return false;
    }
#if defined(__APPLE__)
    const struct timespec first = one.st_mtimespec, second = two.st_mtimespec;
#else
    const struct timespec first = one.st_mtim, second = two.st_mtim;
#endif
    return first.tv_sec > second.tv_sec || (first.tv_sec == second.tv_sec && first.tv_nsec >= second.tv_nsec);
}

bool system_folder_make(const char *path)
{
    return mkdir(path, 0777) == 0;
}

bool system_folder_make_unnamed(char *path, size_t size)
{
    const char *const folder = getenv("TMPDIR");
    return snprintf(path, size, "%s/rhw-XXXXXX", folder ? folder : "/tmp") < (int)size &&
           mkdtemp(path) != NULL;
}
