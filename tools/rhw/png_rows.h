// SPDX-License-Identifier: MIT
// The rows of a PNG: filtered, compressed and put into chunks.
#ifndef CLI_PNG_ROWS_H
#define CLI_PNG_ROWS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { CLI_PNG_CHUNK = 8192 }; // bytes of image data in a chunk

struct cli_png_rows {
    FILE *stream;
    size_t size;                     // bytes of a row
    uint8_t *row, *above, *filtered; // filtered begins with the number of the filter
    struct cli_png_deflate *deflate;
};

// Begins with rows of `size` bytes, of which the first is the highest. False without memory.
bool cli_png_rows_open(struct cli_png_rows *rows, FILE *stream, size_t size);
// Adds rows->row, whose samples of 16 bits have the more significant byte first. False with errno.
bool cli_png_rows_add(struct cli_png_rows *rows);
// Writes what is left. False with errno.
bool cli_png_rows_finish(struct cli_png_rows *rows);
void cli_png_rows_close(struct cli_png_rows *rows);

// Stores a number as PNG has them.
void cli_png_store(unsigned char to[4], uint32_t value);
// Writes a chunk of a PNG. `head` goes before `data`. False with errno.
bool cli_png_chunk(FILE *stream, const char name[4], const void *head, size_t head_size, const void *data,
                   size_t size);

#endif
