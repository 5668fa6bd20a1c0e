// SPDX-License-Identifier: MIT
// See streams.h.
#include "streams.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

void system_streams_start(int argc, char **argv)
{
    (void)argc, (void)argv;
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; stream++) {
        if (fcntl(stream, F_GETFD) <
            0) { // what is opened takes its number, in the direction that nobody uses
            (void)open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

bool system_streams_have_input(int milliseconds)
{
    struct pollfd input = {.fd = STDIN_FILENO, .events = POLLIN};
    return poll(&input, 1, milliseconds) != 0;
}

int system_streams_silence(void)
{
    const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
    const int silenced = nowhere >= 0 ? fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1) : -1;
    if (silenced >= 0) {
        dup2(nowhere, STDERR_FILENO);
    }
    if (nowhere >= 0) {
        close(nowhere);
    }
    return silenced;
}

void system_streams_restore(int silenced)
{
    if (silenced >= 0) {
        dup2(silenced, STDERR_FILENO);
        close(silenced);
    }
}
