// SPDX-License-Identifier: MIT
// See growing.h. The C library of Windows has no such streams: a file in between.
#include "growing.h"

#include <errno.h>
#include <stdlib.h>

bool system_growing_open(struct system_growing *growing)
{
    *growing = (struct system_growing){0};
    const bool opened = system_memory_file_open(&growing->file, "rhw-growing");
    growing->stream = growing->file.stream;
    return opened;
}

bool system_growing_close(struct system_growing *growing)
{
    const bool flushed = fflush(growing->stream) == 0 && !ferror(growing->stream);
    const long long size =
        flushed && fseeko(growing->stream, 0, SEEK_END) == 0 ? ftello(growing->stream) : -1;
    growing->bytes = size >= 0 ? malloc((size_t)size + 1) : NULL;
    rewind(growing->stream);
    if (growing->bytes && fread(growing->bytes, 1, (size_t)size, growing->stream) == (size_t)size) {
        growing->size = (size_t)size;
        growing->bytes[size] = '\0';
    } else {
        free(growing->bytes);
        growing->bytes = NULL;
    }
    const int cause = size < 0 ? errno : ENOMEM;
    system_memory_file_close(&growing->file);
    growing->stream = NULL;
    errno = growing->bytes ? 0 : cause;
    return growing->bytes != NULL;
}
