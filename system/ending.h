// SPDX-License-Identifier: MIT
// What is to be done when the program is ended from outside: by a signal, by a closed window of a console, by a deadline.
#ifndef SYSTEM_ENDING_H
#define SYSTEM_ENDING_H

/// From now on `clean` is called before the program ends so: within a signal's handler, where hardly anything may be called,
/// or in another thread. A limit on the size of files is an error of writing. Again in a process that was copied, as `clean`
/// is not called in one that was not asked for it.
void system_ending_guard(void (*clean)(void));
/// Nothing ends the program so until system_ending_release: who would do that waits, up to a second. So `clean` finds what a
/// step has made together with the note of it. Once the program ends, it does not return. Of short steps, none within another.
void system_ending_hold(void);
void system_ending_release(void);
/// After so many seconds the program cleans up, says `line`, which has to stay, and ends with status 1.
void system_ending_deadline(double seconds, const char *line);

#endif
