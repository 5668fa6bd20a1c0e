// SPDX-License-Identifier: MIT
// Processes that are this program, or another.
#ifndef SYSTEM_SUBPROCESS_H
#define SYSTEM_SUBPROCESS_H

#include <stdbool.h>

/// Starts a process that ends with what `run` returns: a copy of this one, except on Windows, which copies none. There
/// it is this program started anew, whose main has to do the same for those arguments. False with errno.
bool system_subprocess_start(int (*run)(int count, char **arguments), int count, char **arguments);
/// Waits for one of them to end, whichever is first. Its status, or −1 where it crashed.
int system_subprocess_wait(void);

/// Whether this program can be started anew.
bool system_subprocess_can_restart(void);
/// Starts it anew, with arguments that end with a NULL, the program's name first, and waits for its end. Its status, or
/// −1.
int system_subprocess_restart(const char *const *arguments);

/// Ends this program in favour of another one: that beside it or, where there is none, that which the system finds.
/// Returns where it cannot be run, with errno.
void system_subprocess_become(const char *name, char **arguments);

/// Sets a variable of the environment, for libraries that are loaded later.
void system_subprocess_set_variable(const char *name, const char *value);

#endif
