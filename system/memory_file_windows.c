// SPDX-License-Identifier: MIT
// See memory_file.h. The file is not marked to be deleted when it is closed: the C library could not open it a second
// time.
#include "memory_file.h"

#define WIN32_LEAN_AND_MEAN
#include <windows.h>

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>

bool system_memory_file_open(struct system_memory_file *file, const char *name)
{
    (void)name;
    *file = (struct system_memory_file){0};
    char folder[MAX_PATH + 1];
    const DWORD length = GetTempPathA(sizeof folder, folder);
    if (length == 0 || length > MAX_PATH || GetTempFileNameA(folder, "rhw", 0, file->path) == 0) {
        errno = ENOENT;
        return false;
    }
    for (char *c = file->path; *c; c++) {
        *c = *c == '\\' ? '/' : *c;
    }
    const int descriptor = _open(file->path, _O_RDWR | _O_BINARY | _O_NOINHERIT | _O_SHORT_LIVED);
    file->stream = descriptor >= 0 ? _fdopen(descriptor, "w+b") : NULL;
    if (!file->stream) {
        const int cause = errno;
        if (descriptor >= 0) {
            _close(descriptor);
        }
        (void)DeleteFileA(file->path);
        errno = cause;
    }
    return file->stream != NULL;
}

void system_memory_file_close(struct system_memory_file *file)
{
    if (file->stream) {
        fclose(file->stream);
        (void)DeleteFileA(file->path);
    }
    file->stream = NULL;
}

void *system_memory_file_map(const struct system_memory_file *file, size_t *size)
{
    const HANDLE handle = (HANDLE)_get_osfhandle(_fileno(file->stream));
    LARGE_INTEGER length;
    if (!GetFileSizeEx(handle, &length) || length.QuadPart <= 0) {
        return NULL;
    }
    *size = (size_t)length.QuadPart;
    // Memory of our own, not the file: one that is mapped cannot be deleted.
    char *const bytes = VirtualAlloc(NULL, *size, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE);
    if (!bytes) {
        return NULL;
    }
    rewind(file->stream);
    if (fread(bytes, 1, *size, file->stream) != *size) {
        (void)VirtualFree(bytes, 0, MEM_RELEASE);
        return NULL;
    }
    return bytes;
}

void system_memory_file_unmap(void *bytes, size_t size)
{
    (void)size;
    (void)VirtualFree(bytes, 0, MEM_RELEASE);
}
