// SPDX-License-Identifier: MIT
// See memory_file.h.
#if defined(__linux__)
#define _GNU_SOURCE // memfd_create
#endif
#include "memory_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#if defined(__linux__)

static int create(const char *name, char path[SYSTEM_MEMORY_FILE_PATH])
{
    (void)path;
    return memfd_create(name, MFD_CLOEXEC);
}

static void set_path(struct system_memory_file *file, int descriptor)
{
    snprintf(file->path, sizeof file->path, "/proc/self/fd/%d", descriptor);
}

static void remove_path(const struct system_memory_file *file)
{
    (void)file; // it has no name in any folder
}

#else

static int create(const char *name, char path[SYSTEM_MEMORY_FILE_PATH])
{
    const char *const folder = getenv("TMPDIR");
    snprintf(path, SYSTEM_MEMORY_FILE_PATH, "%.400s/%.60s-XXXXXX", folder ? folder : "/tmp", name);
    const int descriptor = mkstemp(path);
    if (descriptor >= 0) {
        (void)fcntl(descriptor, F_SETFD, FD_CLOEXEC);
    }
    return descriptor;
}

static void set_path(struct system_memory_file *file, int descriptor)
{
    (void)file, (void)descriptor; // it was created by it
}

static void remove_path(const struct system_memory_file *file)
{
    unlink(file->path);
}

#endif

// It must not stand where a closed standard stream stood, which children silence.
static int move_up(int made)
{
    if (made < 0 || made > STDERR_FILENO) {
        return made;
    }
    const int moved = fcntl(made, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    close(made);
    return moved;
}

bool system_memory_file_open(struct system_memory_file *file, const char *name)
{
    *file = (struct system_memory_file){0};
    const int descriptor = move_up(create(name, file->path));
    if (descriptor < 0) {
        return false;
    }
    set_path(file, descriptor);
    file->stream = fdopen(descriptor, "w+b");
    if (!file->stream) {
        const int cause = errno;
        close(descriptor);
        remove_path(file);
        errno = cause;
    }
    return file->stream != NULL;
}

void system_memory_file_close(struct system_memory_file *file)
{
    if (file->stream) {
        fclose(file->stream);
        remove_path(file);
    }
    file->stream = NULL;
}

void *system_memory_file_map(const struct system_memory_file *file, size_t *size)
{
    struct stat status;
    if (fstat(fileno(file->stream), &status) != 0 || status.st_size <= 0) {
        return NULL;
    }
    *size = (size_t)status.st_size;
    void *const bytes = mmap(NULL, *size, PROT_READ | PROT_WRITE, MAP_PRIVATE, fileno(file->stream), 0);
    return bytes == MAP_FAILED ? NULL : bytes;
}

void system_memory_file_unmap(void *bytes, size_t size)
{
    munmap(bytes, size);
}
