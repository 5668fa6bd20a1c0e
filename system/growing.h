// SPDX-License-Identifier: MIT
// Memory that is written like a file and grows with it.
#ifndef SYSTEM_GROWING_H
#define SYSTEM_GROWING_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "memory_file.h"

/// Zeroed: none.
struct system_growing {
    FILE *stream; ///< write here
    char *bytes;  ///< after close, with a 0 behind them; the caller frees them
    size_t size;  ///< without that 0
    // ---
    struct system_memory_file file;
};

/// It must not be moved until it is closed. False with errno.
bool system_growing_open(struct system_growing *growing);
/// False with errno where not everything was kept: there are no bytes then.
bool system_growing_close(struct system_growing *growing);

#endif
