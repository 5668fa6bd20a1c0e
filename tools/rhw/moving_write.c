// SPDX-License-Identifier: MIT
// See moving_write.h. An animated PNG (PNG, third edition, §11.3.6) is the chunks of ordinary ones: those of the first
// picture as they are, of the others their image data under another name, each behind a chunk that says when it is
// shown.
#include "moving_write.h"

#include "growing.h"
#include "image_webp.h"
#include "message.h"
#include "png_rows.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include <webp/mux.h>

static bool fail(const struct cli_moving *moving)
{
    cli_error(moving->file->path, "cannot be written: %s", strerror(errno ? errno : ENOMEM));
    return false;
}

// APNG ----------------------------------------------------------------------------------------------

static uint32_t load_big_endian(const unsigned char *from)
{
    return (uint32_t)from[0] << 24 | (uint32_t)from[1] << 16 | (uint32_t)from[2] << 8 | from[3];
}

static bool write_animation_control(const struct cli_moving *moving)
{
    unsigned char control[8] = {0}; // frames; 0: played without end
    cli_png_store(control, (uint32_t)moving->frame_count);
    return cli_png_chunk(moving->file->stream, "acTL", control, sizeof control, "", 0);
}

static bool write_frame_control(struct cli_moving *moving, const struct cli_raster *raster)
{
    enum { PARTS = 100 }; // of a second, per frame, in the fraction that is its delay
    unsigned char control[26] = {0};
    const unsigned divisor = (unsigned)(moving->rate * PARTS + 0.5);
    cli_png_store(control, moving->sequence++);
    cli_png_store(control + 4, (uint32_t)raster->width);
    cli_png_store(control + 8, (uint32_t)raster->height);
    control[21] = PARTS;
    control[22] = (unsigned char)(divisor >> 8);
    control[23] = (unsigned char)divisor; // disposal and blending 0: each picture takes the place of the last
    return cli_png_chunk(moving->file->stream, "fcTL", control, sizeof control, "", 0);
}

// One chunk of an ordinary PNG file.
static bool write_part(struct cli_moving *moving, const struct cli_raster *raster, const unsigned char *chunk,
                       size_t size, bool *begun)
{
    FILE *const stream = moving->file->stream;
    const bool is_data = memcmp(chunk + 4, "IDAT", 4) == 0, first = moving->frame == 0;
    bool written = true;
    if (is_data && !*begun) {
        *begun = true;
        written = (!first || write_animation_control(moving)) && write_frame_control(moving, raster);
    }
    if (!written || memcmp(chunk + 4, "IEND", 4) == 0) {
        return written;
    }
    if (first) {
        return fwrite(chunk, 1, size + 12, stream) == size + 12;
    }
    unsigned char number[4];
    cli_png_store(number, moving->sequence);
    moving->sequence += is_data;
    return !is_data || cli_png_chunk(stream, "fdAT", number, sizeof number, chunk + 8, size);
}

enum { SIGNATURE = 8 };

static bool encode_png(const struct cli_moving *moving, const struct cli_raster *raster,
                       struct cli_moving_frame *frame)
{
    struct cli_output_file memory = *moving->file;
    errno = 0;
    struct system_growing growing;
    if (!system_growing_open(&growing)) {
        return fail(moving);
    }
    memory.stream = growing.stream;
    const bool written = cli_png_write(&memory, raster);
    const bool closed = system_growing_close(&growing);
    frame->bytes = growing.bytes;
    frame->size = growing.size;
    return written && ((closed && frame->size > SIGNATURE) || fail(moving));
}

static bool add_png(struct cli_moving *moving, const struct cli_raster *raster,
                    const struct cli_moving_frame *frame)
{
    bool begun = false, stored = true;
    if (moving->frame == 0) {
        stored = fwrite(frame->bytes, 1, SIGNATURE, moving->file->stream) == SIGNATURE;
    }
    for (size_t at = SIGNATURE; stored && at + 12 <= frame->size;) {
        const unsigned char *const chunk = (const unsigned char *)frame->bytes + at;
        const size_t length = load_big_endian(chunk);
        stored = write_part(moving, raster, chunk, length, &begun);
        at += length + 12;
    }
    return stored || fail(moving);
}

// WebP ----------------------------------------------------------------------------------------------

static bool open_webp(struct cli_moving *moving, const struct cli_raster *raster)
{
    WebPAnimEncoderOptions options;
    if (!WebPAnimEncoderOptionsInit(&options)) {
        return false;
    }
    moving->webp = WebPAnimEncoderNew(raster->width, raster->height, &options);
    return moving->webp != NULL;
}

static int milliseconds(const struct cli_moving *moving)
{
    return (int)(moving->frame * 1000.0 / moving->rate + 0.5);
}

static bool add_webp(struct cli_moving *moving, const struct cli_raster *raster)
{
    WebPConfig config;
    WebPPicture picture;
    if ((!moving->webp && !open_webp(moving, raster)) ||
        !cli_webp_prepare(&config, &picture, raster, moving->quality)) {
        return fail(moving);
    }
    const bool added = WebPAnimEncoderAdd(moving->webp, &picture, milliseconds(moving), &config);
    WebPPictureFree(&picture);
    if (!added) {
        cli_error(moving->file->path, "cannot be written: %s", WebPAnimEncoderGetError(moving->webp));
    }
    return added;
}

static bool finish_webp(struct cli_moving *moving)
{
    WebPData data = {0};
    bool written = moving->webp && WebPAnimEncoderAdd(moving->webp, NULL, milliseconds(moving), NULL) &&
                   WebPAnimEncoderAssemble(moving->webp, &data);
    errno = 0;
    written = written && fwrite(data.bytes, 1, data.size, moving->file->stream) == data.size;
    WebPDataClear(&data);
    return written || fail(moving);
}

// Both ----------------------------------------------------------------------------------------------

void cli_moving_open(struct cli_moving *moving, struct cli_output_file *file, enum cli_picture_format format,
                     int frame_count, double rate, int quality)
{
    *moving = (struct cli_moving){
        .file = file, .format = format, .frame_count = frame_count, .rate = rate, .quality = quality};
}

bool cli_moving_encode(const struct cli_moving *moving, const struct cli_raster *raster,
                       struct cli_moving_frame *frame)
{
    *frame = (struct cli_moving_frame){0};
    return moving->format == CLI_PICTURE_WEBP || encode_png(moving, raster, frame);
}

void cli_moving_forget(struct cli_moving_frame *frame)
{
    free(frame->bytes);
    *frame = (struct cli_moving_frame){0};
}

bool cli_moving_add(struct cli_moving *moving, const struct cli_raster *raster,
                    const struct cli_moving_frame *frame)
{
    errno = 0;
    const bool added =
        moving->format == CLI_PICTURE_WEBP ? add_webp(moving, raster) : add_png(moving, raster, frame);
    moving->frame++;
    return added;
}

bool cli_moving_finish(struct cli_moving *moving)
{
    if (moving->format == CLI_PICTURE_WEBP) {
        return finish_webp(moving);
    }
    errno = 0;
    return cli_png_chunk(moving->file->stream, "IEND", "", 0, "", 0) || fail(moving);
}

void cli_moving_close(struct cli_moving *moving)
{
    WebPAnimEncoderDelete(moving->webp);
    moving->webp = NULL;
}
