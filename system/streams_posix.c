// SPDX-License-Identifier: MIT
// See streams.h.
#include "streams.h"

#include <poll.h>
#include <unistd.h>

void system_streams_start(int argc, char **argv)
{
    (void)argc, (void)argv;
}

bool system_streams_have_input(int milliseconds)
{
    struct pollfd input = {.fd = STDIN_FILENO, .events = POLLIN};
    return poll(&input, 1, milliseconds) != 0;
}
