// SPDX-License-Identifier: MIT
// Standard streams, and the words of the command line.
#ifndef SYSTEM_STREAMS_H
#define SYSTEM_STREAMS_H

#include <stdbool.h>

/// First of all: standard streams carry bytes as they are, and names of files have slashes. On Windows a backslash in
/// an argument becomes one. A stream that is closed stays so, but its number is taken: a file that got it would get
/// messages. On Windows the C library has taken it before.
void system_streams_start(int argc, char **argv);

/// Waits so long, at most, for something to read from standard input, its end too. On Windows it does not wait: whether
/// there is something is seen by reading.
bool system_streams_have_input(int milliseconds);

/// Sends what is written to standard error nowhere, for libraries that write there, until it is restored. Returns what
/// restores it; −1: it goes where it went.
int system_streams_silence(void);
void system_streams_restore(int silenced);

#endif
