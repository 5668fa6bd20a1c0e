// SPDX-License-Identifier: MIT
// Whether memory is marked for huge pages, where Linux lists the marks.
#ifndef HUGE_PAGE_MARK_H
#define HUGE_PAGE_MARK_H

#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

// Return 1 if the mapping that holds `block` is marked, 0 if not, and -1 where the system has no huge pages or lists no
// marks.
static inline int huge_page_mark(const void *block)
{
    const bool has_huge_pages = access("/sys/kernel/mm/transparent_hugepage", F_OK) == 0;
    FILE *const maps = has_huge_pages ? fopen("/proc/self/smaps", "r") : NULL;
    char line[512];
    int marked = -1;
    bool is_inside = false;
    while (maps && fgets(line, sizeof line, maps)) {
        uintptr_t first, end;
        if (sscanf(line, "%" SCNxPTR "-%" SCNxPTR " ", &first, &end) == 2) {
            is_inside = (uintptr_t)block >= first && (uintptr_t)block < end;
        } else if (is_inside && strncmp(line, "VmFlags:", 8) == 0) {
            marked = strstr(line, " hg") != NULL;
        }
    }
    if (maps) {
        fclose(maps);
    }
    return marked;
}

#endif
