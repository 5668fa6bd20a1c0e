// SPDX-License-Identifier: MIT
// Code on POSIX. Where a process may not make pages executable that it has written (PR_SET_MDWE, systemd's
// MemoryDenyWriteExecute, SELinux's execmem), Linux has files without a name: what was written to one may be mapped.
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE // for memfd_create
#endif
#include "code_memory.h"

#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/types.h>
#include <unistd.h>

#if !defined(MAP_ANONYMOUS) && defined(MAP_ANON)
#define MAP_ANONYMOUS MAP_ANON // macOS
#endif

#if defined(RHW_GUARDS)

// Pages that nobody may touch stand around code and around what it keeps on the stack. Code ends within 64 bytes of
// them.
enum { GUARD = 1 << 16, STACK = 1 << 20, BREAKPOINT = 0xcc };

static size_t whole_pages(size_t size)
{
    return (size + GUARD - 1) / GUARD * GUARD;
}

// Map memory with a guard on either side. Return where it begins, or NULL.
static char *map_guarded(size_t size)
{
    char *const all = mmap(NULL, size + 2 * GUARD, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED) {
        return NULL;
    }
    if (mprotect(all + GUARD, size, PROT_READ | PROT_WRITE) != 0) {
        (void)munmap(all, size + 2 * GUARD);
        return NULL;
    }
    return all + GUARD;
}

void *shader_guarded_stack(void)
{
    static _Thread_local char *stack;
    stack = stack ? stack : map_guarded(STACK);
    if (!stack) {
        abort();
    }
    return stack + STACK;
}

void *shader_code_map(const void *bytes, size_t size)
{
    const size_t room = whole_pages(size), before = (room - size) / 64 * 64;
    char *const begin = map_guarded(room);
    if (!begin) {
        return NULL;
    }
    memset(begin, BREAKPOINT, room);
    memcpy(begin + before, bytes, size);
    if (mprotect(begin, room, PROT_READ | PROT_EXEC) != 0) {
        (void)munmap(begin - GUARD, room + 2 * GUARD);
        return NULL;
    }
    return begin + before;
}

void shader_code_unmap(void *code, size_t size)
{
    const size_t room = whole_pages(size), before = (room - size) / 64 * 64;
    (void)munmap((char *)code - before - GUARD, room + 2 * GUARD);
}

#else

static void *map_own(const void *bytes, size_t size)
{
    void *const code = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (code == MAP_FAILED) {
        return NULL;
    }
    memcpy(code, bytes, size);
    if (mprotect(code, size, PROT_READ | PROT_EXEC) != 0) {
        (void)munmap(code, size);
        return NULL;
    }
    return code;
}

#if defined(__linux__)
static bool write_all(int file, const char *bytes, size_t size)
{
    while (size > 0) {
        const ssize_t written = write(file, bytes, size);
        if (written <= 0) {
            return false;
        }
        bytes += written;
        size -= (size_t)written;
    }
    return true;
}

static void *map_file(const void *bytes, size_t size)
{
    const int file = memfd_create("rhw-shader", MFD_CLOEXEC);
    if (file < 0) {
        return NULL;
    }
    void *const code = write_all(file, bytes, size)
                           ? mmap(NULL, size, PROT_READ | PROT_EXEC, MAP_PRIVATE, file, 0)
                           : MAP_FAILED;
    (void)close(file);
    return code == MAP_FAILED ? NULL : code;
}
#else
static void *map_file(const void *bytes, size_t size)
{
    (void)bytes;
    (void)size;
    return NULL;
}
#endif

void *shader_code_map(const void *bytes, size_t size)
{
    void *const code = map_own(bytes, size);
    return code ? code : map_file(bytes, size);
}

void shader_code_unmap(void *code, size_t size)
{
    (void)munmap(code, size);
}

#endif

bool shader_code_name(const void *code, size_t size, const char *name)
{
    char line[256];
    const char *const value = getenv("RHW_PERF_MAP");
    if (!value || strcmp(value, "1") != 0) {
        return false;
    }
    snprintf(line, sizeof line, "/tmp/perf-%ld.map", (long)getpid());
    // Whoever put a link there does not get what it leads to written.
    const int file = open(line, O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (file < 0) {
        return false;
    }
    const int head = snprintf(line, sizeof line, "%jx %zx ", (uintmax_t)(uintptr_t)code, size);
    size_t length = (size_t)head;
    for (const char *c = name; *c != '\0' && length + 1 < sizeof line; c++) {
        line[length++] = *c >= ' ' && *c < 0x7f ? *c : '?';
    }
    line[length++] = '\n';
    // One write is appended as a whole, whichever threads write beside it.
    const bool is_written = write(file, line, length) == (ssize_t)length;
    (void)close(file);
    return is_written;
}
