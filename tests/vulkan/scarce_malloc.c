// SPDX-License-Identifier: MIT
#define _GNU_SOURCE
#include "scarce_malloc.h"

#include <dlfcn.h>
#include <errno.h>
#include <link.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static atomic_bool counts;
static atomic_int calls;
static int first_failure;
static bool stays_failing;
static uintptr_t driver_begin, driver_end; // addresses of the driver

static int find_driver(struct dl_phdr_info *info, size_t size, void *unused)
{
    (void)size;
    (void)unused;
    if (!strstr(info->dlpi_name, "librhw_vulkan")) {
        return 0;
    }
    driver_begin = UINTPTR_MAX;
    driver_end = 0;
    for (int i = 0; i < info->dlpi_phnum; i++) {
        const ElfW(Phdr) *const part = &info->dlpi_phdr[i];
        if (part->p_type == PT_LOAD) {
            const uintptr_t begin = info->dlpi_addr + part->p_vaddr;
            driver_begin = begin < driver_begin ? begin : driver_begin;
            driver_end = begin + part->p_memsz > driver_end ? begin + part->p_memsz : driver_end;
        }
    }
    return 1;
}

void scarce_malloc_begin(int fail_at, bool stays)
{
    dl_iterate_phdr(find_driver, NULL);
    first_failure = fail_at;
    stays_failing = stays;
    atomic_store(&calls, 0);
    atomic_store(&counts, true);
}

int scarce_malloc_end(void)
{
    atomic_store(&counts, false);
    return atomic_load(&calls);
}

static bool fails(const void *caller)
{
    const uintptr_t address = (uintptr_t)caller;
    if (!atomic_load(&counts) || address < driver_begin || address >= driver_end) {
        return false;
    }
    const int call = atomic_fetch_add(&calls, 1);
    const bool does =
        first_failure >= 0 && (call == first_failure || (stays_failing && call > first_failure));
    if (does) {
        errno = ENOMEM;
    }
    return does;
}

// Set the function at `place` to the next one of a name, which a sanitizer or the C library has.
static void find(const char *name, void *place)
{
    void *const found = dlsym(RTLD_NEXT, name);
    memcpy(place, &found, sizeof found);
}

// The driver finds these before those of the C library.
#pragma GCC visibility push(default)

void *malloc(size_t size)
{
    static void *(*next)(size_t);
    if (!next) {
        find("malloc", &next);
    }
    return fails(__builtin_return_address(0)) ? NULL : next(size);
}

void *calloc(size_t count, size_t size)
{
    static void *(*next)(size_t, size_t);
    if (!next) {
        find("calloc", &next);
    }
    return fails(__builtin_return_address(0)) ? NULL : next(count, size);
}

void *realloc(void *memory, size_t size)
{
    static void *(*next)(void *, size_t);
    if (!next) {
        find("realloc", &next);
    }
    return fails(__builtin_return_address(0)) ? NULL : next(memory, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    static void *(*next)(size_t, size_t);
    if (!next) {
        find("aligned_alloc", &next);
    }
    return fails(__builtin_return_address(0)) ? NULL : next(alignment, size);
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    static int (*next)(void **, size_t, size_t);
    if (!next) {
        find("posix_memalign", &next);
    }
    return fails(__builtin_return_address(0)) ? ENOMEM : next(memory, alignment, size);
}

#pragma GCC visibility pop
