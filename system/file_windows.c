// SPDX-License-Identifier: MIT
// See file.h.
#include "file.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <direct.h>
#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static void set_errno(void)
{
    switch (GetLastError()) {
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME: errno = ENOENT; break;
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS: errno = EEXIST; break;
    case ERROR_DISK_FULL:
    case ERROR_HANDLE_DISK_FULL: errno = ENOSPC; break;
    case ERROR_TOO_MANY_OPEN_FILES: errno = EMFILE; break;
    default: errno = EACCES;
    }
}

int system_file_open(const char *path, enum system_file_use use)
{
    const int access = use == SYSTEM_FILE_READ ? _O_RDONLY : _O_WRONLY;
    return _open(path, access | _O_BINARY | _O_NOINHERIT);
}

void system_file_permit_as(int descriptor, const char *path)
{
    (void)descriptor, (void)path;
}

// To ask about; INVALID_HANDLE_VALUE with errno.
static HANDLE look(const char *path)
{
    const DWORD share = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
    HANDLE const handle = CreateFileA(path, 0, share, NULL, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, NULL);
    if (handle == INVALID_HANDLE_VALUE) {
        set_errno();
    }
    return handle;
}

static bool look_at(const char *path, BY_HANDLE_FILE_INFORMATION *about)
{
    HANDLE const handle = look(path);
    const bool known = handle != INVALID_HANDLE_VALUE && GetFileInformationByHandle(handle, about);
    if (handle != INVALID_HANDLE_VALUE) {
        CloseHandle(handle);
    }
    return known;
}

char *system_file_resolve(const char *path)
{
    enum { SIZE = 32768 };
    // Which the system puts before such paths.
    static const char mark[] = "\\\\?\\", share_mark[] = "\\\\?\\UNC\\";
    HANDLE const handle = look(path);
    if (handle == INVALID_HANDLE_VALUE) {
        return NULL;
    }
    char *const text = malloc(SIZE);
    const DWORD length = text ? GetFinalPathNameByHandleA(handle, text, SIZE, FILE_NAME_NORMALIZED) : 0;
    CloseHandle(handle);
    if (length == 0 || length >= SIZE) {
        errno = text ? EACCES : ENOMEM;
        free(text);
        return NULL;
    }
    const bool is_shared = strncmp(text, share_mark, strlen(share_mark)) == 0;
    if (is_shared) { // \\server\share
        memmove(text + 1, text + strlen(share_mark) - 1, length + 2 - strlen(share_mark));
    } else if (strncmp(text, mark, strlen(mark)) == 0) {
        memmove(text, text + strlen(mark), length + 1 - strlen(mark));
    }
    for (char *c = text; *c; c++) {
        *c = *c == '\\' ? '/' : *c;
    }
    return text;
}

bool system_file_is_same(const char *path, const char *other)
{
    BY_HANDLE_FILE_INFORMATION one, two;
    return look_at(path, &one) && look_at(other, &two) &&
           one.dwVolumeSerialNumber == two.dwVolumeSerialNumber && one.nFileIndexHigh == two.nFileIndexHigh &&
           one.nFileIndexLow == two.nFileIndexLow;
}

bool system_file_is_link(const char *path)
{
    const DWORD attributes = GetFileAttributesA(path);
    return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0;
}

bool system_file_is_newer(const char *path, const char *other)
{
    BY_HANDLE_FILE_INFORMATION one, two;
    return look_at(path, &one) && look_at(other, &two) &&
           CompareFileTime(&one.ftLastWriteTime, &two.ftLastWriteTime) >= 0;
}

bool system_folder_make(const char *path)
{
    return _mkdir(path) == 0;
}

bool system_folder_make_unnamed(char *path, size_t size)
{
    char folder[MAX_PATH + 1];
    const DWORD length = GetTempPathA(sizeof folder, folder);
    for (unsigned attempt = 0; length > 0 && length <= MAX_PATH && attempt < 1000; attempt++) {
        if (snprintf(path, size, "%srhw-%lu-%u", folder, GetCurrentProcessId(), attempt) >= (int)size) {
            return false;
        }
        if (_mkdir(path) == 0) {
            return true;
        }
    }
    return false;
}
