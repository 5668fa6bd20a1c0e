// SPDX-License-Identifier: MIT
// What the machine has, whatever of it this process may use.
#ifndef SYSTEM_MACHINE_H
#define SYSTEM_MACHINE_H

#include <stddef.h>

/// Processors that run; at least 1.
int system_machine_processors(void);
/// Bytes of memory; 0 where the system does not say.
size_t system_machine_memory(void);

#endif
