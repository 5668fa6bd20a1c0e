// SPDX-License-Identifier: MIT
// See temporary_file.h. There are no files without a name, and whether a file is open is what tells that it is written.
#include "temporary_file.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stddef.h>
#include <stdint.h>

int system_temporary_file_open(const char *folder)
{
    (void)folder;
    errno = ENOSYS;
    return -1;
}

bool system_temporary_file_name(int descriptor, const char *path)
{
    (void)descriptor, (void)path;
    errno = ENOSYS;
    return false;
}

static int errno_of(DWORD error)
{
    switch (error) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME: return ENOENT;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS: return EEXIST;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL: return ENOSPC;
    case ERROR_TOO_MANY_OPEN_FILES: return EMFILE;
    default: return EACCES;
    }
}

// The C library opens files so that nobody can remove them.
int system_temporary_file_create(const char *path)
{
    const DWORD share = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    HANDLE const handle =
        CreateFileA(path, GENERIC_WRITE, share, NULL, CREATE_NEW, FILE_ATTRIBUTE_NORMAL, NULL);
    if (handle == INVALID_HANDLE_VALUE) {
        errno = errno_of(GetLastError());
        return -1;
    }
    const int descriptor = _open_osfhandle((intptr_t)handle, _O_WRONLY | _O_BINARY);
    if (descriptor < 0) {
        CloseHandle(handle);
        (void)DeleteFileA(path);
    }
    return descriptor;
}

// What somebody has open cannot be opened without sharing it.
bool system_temporary_file_remove(const char *path)
{
    HANDLE const handle = CreateFileA(path, GENERIC_WRITE | DELETE, 0, NULL, OPEN_EXISTING,
                                      FILE_ATTRIBUTE_NORMAL | FILE_FLAG_DELETE_ON_CLOSE, NULL);
    if (handle == INVALID_HANDLE_VALUE) {
        return false;
    }
    CloseHandle(handle);
    return true;
}

bool system_temporary_file_replace(int *descriptor, const char *from, const char *to)
{
    _close(*descriptor); // what is open is not renamed
    *descriptor = -1;
    if (MoveFileExA(from, to, MOVEFILE_REPLACE_EXISTING)) {
        return true;
    }
    errno = errno_of(GetLastError());
    return false;
}
