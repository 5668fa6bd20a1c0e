// SPDX-License-Identifier: MIT
// Work that is done apart from the program, because it may crash, hang or ask for all memory: in a process that is a copy of
// this one. Windows copies no processes; there it is a thread, which shares the fate of the program, and whose memory is not
// limited. What it takes and never frees is then the program's loss.
#ifndef SYSTEM_CHILD_H
#define SYSTEM_CHILD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "memory_file.h"

/// How a child ended.
enum system_child_end {
    SYSTEM_CHILD_LEFT,        ///< by itself, with `number` as its status
    SYSTEM_CHILD_SIGNAL,      ///< by the signal `number`
    SYSTEM_CHILD_KILLED,      ///< by the one that nothing can be done about
    SYSTEM_CHILD_CPU_TIME,    ///< it took more processor time
    SYSTEM_CHILD_WALL_TIME,   ///< or more time than it was given
    SYSTEM_CHILD_GIVEN_UP,    ///< nobody wanted it any more
    SYSTEM_CHILD_NOT_STARTED, ///< `number` is an errno
};

/// What the child has of it.
struct system_child {
    FILE *reply; ///< to be read by the parent
    // ---
    void *ended; ///< of a thread: an event
    long leaving;
    int status;
};

struct system_child_work {
    /// Runs in the child, its standard streams silenced where it is a process; what it returns is its status. `user` has to
    /// live as long as the program where children are threads and run out of time.
    int (*run)(const void *user, struct system_child *child);
    const void *user;
    unsigned cpu_seconds, wall_seconds; ///< the processor's time is looked at where the child is a process
    size_t memory;                      ///< bytes of address space; 0: as much as there is
    /// Asked many times a second; false gives the child up. NULL: nobody is asked. A thread is waited for all the same.
    bool (*goes_on)(void *user);
    void *goes_on_user;
};

struct system_child_result {
    enum system_child_end end;
    int number;
    struct system_memory_file reply; ///< what the child wrote; to be closed whatever came of it
};

/// Runs the work and waits for it. Any number of threads may do so at once.
struct system_child_result system_child_run(const struct system_child_work *work);

/// Ends the child from any place within it, its own threads too, with what is written to the reply so far.
_Noreturn void system_child_leave(struct system_child *child, int status);

/// Zeroed memory that children see change, and change. NULL where there is none.
void *system_child_share(size_t size);
void system_child_unshare(void *memory, size_t size);

#endif
