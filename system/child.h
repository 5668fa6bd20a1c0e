// SPDX-License-Identifier: MIT
// Work that is done apart from the program, because it may crash, hang or ask for all memory: in a process that is a
// copy of this one. Windows copies no processes; there it is a thread, which shares the fate of the program, and whose
// memory is not limited. What it takes and never frees is then the program's loss.
//
// Nobody can end a thread: one that runs out of time goes on. What it uses is therefore its own: `user`, the reply and
// what is known of it here have two owners, the thread and who waits for it, and the last of them frees all three.
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
};

struct system_child_work {
    /// Runs in the child, its standard streams silenced where it is a process; what it returns is its status.
    int (*run)(void *user, struct system_child *child);
    /// All that `run` uses of the caller's memory has to be in it, or to live as long as the program.
    void *user;
    /// Frees `user`: called once, by the caller's thread or the child's, when neither uses it any more, also where the
    /// child did not start.
    void (*release)(void *user);
    /// `user` names memory of the caller, who will have it until the child has ended: a thread has no limit of time
    /// then.
    bool is_borrowing;
    unsigned cpu_seconds, wall_seconds; ///< the processor's time is looked at where the child is a process
    /// Bytes of address space that the child may take beyond what this process has, or in all where the system does
    /// not say what that is; 0: as much as there is.
    size_t memory;
    /// Asked many times a second; false gives the child up. NULL: nobody is asked. A thread is waited for all the same.
    bool (*goes_on)(void *user);
    void *goes_on_user;
};

struct system_child_result {
    enum system_child_end end;
    int number;
    struct system_memory_file reply; ///< what the child wrote; to be closed whatever came of it
};

/// Runs the work and waits for it; takes work->user, whatever comes of it. Any number of threads may do so at once.
struct system_child_result system_child_run(const struct system_child_work *work);

/// Ends the child from any depth of `run`, with what is written to the reply so far. The thread that called `run` alone
/// may do so, and has none left of those that it started: they would use what is not theirs.
_Noreturn void system_child_leave(struct system_child *child, int status);

/// Zeroed memory that children see change, and change. NULL where there is none.
void *system_child_share(size_t size);
void system_child_unshare(void *memory, size_t size);

#endif
