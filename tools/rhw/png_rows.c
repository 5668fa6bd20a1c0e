// SPDX-License-Identifier: MIT
// See png_rows.h. The bytes are those of libspng with the same options, whose filter takes a byte at a time: a third of
// the time of a picture.
#include "png_rows.h"

#include <stdlib.h>
#include <string.h>

#include <zlib.h>

// Level 2 with the Up filter, measured on rendered pictures and on photographs at 1920×1080: within 10% of the
// size of libspng's defaults (level 6, the best of five filters per row) at a quarter of the time.
enum { LEVEL = 2, UP = 2, WINDOW_BITS = 15, MEMORY_LEVEL = 8 };

struct cli_png_deflate {
    z_stream stream;
    uint8_t out[CLI_PNG_CHUNK];
};

void cli_png_store(unsigned char to[4], uint32_t value)
{
    for (int i = 0; i < 4; i++) {
        to[i] = (unsigned char)(value >> (24 - 8 * i));
    }
}

bool cli_png_chunk(FILE *stream, const char name[4], const void *head, size_t head_size, const void *data,
                   size_t size)
{
    unsigned char start[8], end[4];
    cli_png_store(start, (uint32_t)(head_size + size));
    memcpy(start + 4, name, 4);
    uLong check = crc32(crc32(0, start + 4, 4), head, (uInt)head_size);
    check = size > 0 ? crc32(check, data, (uInt)size) : check;
    cli_png_store(end, (uint32_t)check);
    return fwrite(start, 1, sizeof start, stream) == sizeof start &&
           fwrite(head, 1, head_size, stream) == head_size && fwrite(data, 1, size, stream) == size &&
           fwrite(end, 1, sizeof end, stream) == sizeof end;
}

bool cli_png_rows_open(struct cli_png_rows *rows, FILE *stream, size_t size)
{
    *rows = (struct cli_png_rows){
        .stream = stream,
        .size = size,
        .row = malloc(size),
        .above = calloc(size, 1),
        .filtered = malloc(size + 1),
    };
    struct cli_png_deflate *const deflate = calloc(1, sizeof *deflate);
    const bool is_ready = deflate && deflateInit2(&deflate->stream, LEVEL, Z_DEFLATED, WINDOW_BITS,
                                                  MEMORY_LEVEL, Z_FILTERED) == Z_OK;
    if (!is_ready) {
        free(deflate);
    } else {
        rows->deflate = deflate;
        deflate->stream.next_out = deflate->out;
        deflate->stream.avail_out = sizeof deflate->out;
    }
    return is_ready && rows->row && rows->above && rows->filtered;
}

void cli_png_rows_close(struct cli_png_rows *rows)
{
    if (rows->deflate) {
        deflateEnd(&rows->deflate->stream);
    }
    free(rows->deflate);
    free(rows->row);
    free(rows->above);
    free(rows->filtered);
    *rows = (struct cli_png_rows){0};
}

// Write what is compressed so far as a chunk.
static bool flush(struct cli_png_rows *rows)
{
    struct cli_png_deflate *const deflate = rows->deflate;
    const size_t size = sizeof deflate->out - deflate->stream.avail_out;
    deflate->stream.next_out = deflate->out;
    deflate->stream.avail_out = sizeof deflate->out;
    return cli_png_chunk(rows->stream, "IDAT", "", 0, deflate->out, size);
}

bool cli_png_rows_add(struct cli_png_rows *rows)
{
    z_stream *const stream = &rows->deflate->stream;
    uint8_t *const filtered = rows->filtered;
    const uint8_t *const row = rows->row, *const above = rows->above;
    filtered[0] = UP;
    for (size_t i = 0; i < rows->size; i++) {
        filtered[1 + i] = (uint8_t)(row[i] - above[i]);
    }
    stream->next_in = filtered;
    stream->avail_in = (uInt)(rows->size + 1);
    while (stream->avail_in > 0) {
        if (deflate(stream, Z_NO_FLUSH) != Z_OK || (stream->avail_out == 0 && !flush(rows))) {
            return false;
        }
    }
    uint8_t *const last = rows->row;
    rows->row = rows->above;
    rows->above = last;
    return true;
}

bool cli_png_rows_finish(struct cli_png_rows *rows)
{
    int result = Z_OK;
    while (result == Z_OK) {
        result = deflate(&rows->deflate->stream, Z_FINISH);
        if ((result != Z_OK && result != Z_STREAM_END) || !flush(rows)) {
            return false;
        }
    }
    return cli_png_chunk(rows->stream, "IEND", "", 0, "", 0);
}
