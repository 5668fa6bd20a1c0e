// SPDX-License-Identifier: MIT
// See streams.h.
#include "streams.h"

#include <fcntl.h>
#include <io.h>
#include <stdio.h>

void system_streams_start(int argc, char **argv)
{
    FILE *const streams[] = {stdin, stdout, stderr};
    for (int i = 0; i < 3; i++) {
        _setmode(_fileno(streams[i]), _O_BINARY);
    }
    for (int i = 1; i < argc; i++) {
        for (char *c = argv[i]; *c; c++) {
            *c = *c == '\\' ? '/' : *c;
        }
    }
}

bool system_streams_have_input(int milliseconds)
{
    (void)milliseconds;
    return true;
}

int system_streams_silence(void)
{
    return -1; // no library writes there
}

void system_streams_restore(int silenced)
{
    (void)silenced;
}
