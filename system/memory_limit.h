// SPDX-License-Identifier: MIT
// How much memory this process may take, and took.
#ifndef SYSTEM_MEMORY_LIMIT_H
#define SYSTEM_MEMORY_LIMIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Whether the system has the limits below. Windows has not: address space is not what it counts.
bool system_memory_limit_is_there(void);
/// Bytes of address space from now on, also of processes that are started, as far as the system allows that many. None
/// under a sanitizer, which takes terabytes, nor where there are no limits.
void system_memory_limit_set(size_t bytes);
/// Lowers a limit that there is already, and none where there is none. Returns what restore takes.
uint64_t system_memory_limit_lower(uint64_t bytes);
void system_memory_limit_restore(uint64_t before);

/// Bytes of address space that this process has, whether or not they are in memory; 0: the system does not say.
uint64_t system_memory_mapped(void);
/// The most bytes that this process has had in memory; 0: the system does not say.
uint64_t system_memory_peak(void);

#endif
