// SPDX-License-Identifier: MIT
// What is to be done when the program is ended from outside: by a signal, by a console window that is closed, by a
// deadline.
#ifndef SYSTEM_ENDING_H
#define SYSTEM_ENDING_H

#include <stdbool.h>

/// Makes the program call `clean` before it is ended from outside: within a signal's handler, where hardly anything may
/// be called, or in another thread. A limit on the size of files becomes an error of writing. A process that was forked
/// calls this again, as `clean` is not called there otherwise.
void system_ending_guard(void (*clean)(void));
/// Puts off the end of the program until system_ending_release, by a second at most, so that `clean` sees a step whole:
/// what it makes and the note of it. Does not return once the program ends. A step is short, and holds no second time.
void system_ending_hold(void);
void system_ending_release(void);
/// Whether the program ends: `clean` is called soon, or was. It sees what was written before this returned false.
bool system_ending_began(void);
/// Makes the program clean up after so many seconds, say `line`, which has to stay, and end with status 1.
void system_ending_deadline(double seconds, const char *line);

#endif
