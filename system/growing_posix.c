// SPDX-License-Identifier: MIT
// See growing.h.
#include "growing.h"

#include <stdlib.h>

bool system_growing_open(struct system_growing *growing)
{
    *growing = (struct system_growing){0};
    growing->stream = open_memstream(&growing->bytes, &growing->size);
    return growing->stream != NULL;
}

bool system_growing_close(struct system_growing *growing)
{
    const bool kept = fclose(growing->stream) == 0;
    growing->stream = NULL;
    if (!kept) {
        free(growing->bytes);
        growing->bytes = NULL;
    }
    return kept;
}
