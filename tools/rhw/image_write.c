// SPDX-License-Identifier: MIT
// PNG and PPM encoders; see image_write.h. Others stand in files of their own.
#include "image_write.h"

#include "message.h"
#include "png_rows.h"

#include <errno.h>
#include <spng.h>
#include <stdlib.h>
#include <string.h>

static size_t row_size(const struct cli_raster *raster)
{
    return (size_t)raster->width * (size_t)raster->channels * (size_t)(raster->bits / 8);
}

static int write_to_stream(spng_ctx *context, void *user, void *data, size_t size)
{
    (void)context;
    return fwrite(data, 1, size, user) == size ? SPNG_OK : SPNG_IO_ERROR;
}

static int set_texts(spng_ctx *context, const struct cli_raster *raster)
{
    struct spng_text texts[1 + CLI_RASTER_TEXTS_MAX] = {0};
    uint32_t count = 0;
    if (raster->comment[0]) {
        texts[count++] = (struct spng_text){.keyword = "Comment", .text = (char *)raster->comment};
    }
    for (int i = 0; i < raster->text_count; i++) {
        struct spng_text *const text = &texts[count++];
        text->text = (char *)raster->texts[i].text;
        snprintf(text->keyword, sizeof text->keyword, "%s", raster->texts[i].keyword);
    }
    for (uint32_t i = 0; i < count; i++) {
        texts[i].type = SPNG_TEXT;
        texts[i].length = strlen(texts[i].text);
    }
    return count > 0 ? spng_set_text(context, texts, count) : SPNG_OK;
}

static int start_png(spng_ctx *context, const struct cli_raster *raster)
{
    struct spng_ihdr header = {
        .width = (uint32_t)raster->width,
        .height = (uint32_t)raster->height,
        .bit_depth = (uint8_t)raster->bits,
        .color_type = raster->channels == 1   ? SPNG_COLOR_TYPE_GRAYSCALE
                      : raster->channels == 3 ? SPNG_COLOR_TYPE_TRUECOLOR
                                              : SPNG_COLOR_TYPE_TRUECOLOR_ALPHA,
    };
    int result = spng_set_ihdr(context, &header);
    if (!result && raster->srgb) {
        result = spng_set_srgb(context, 0); // perceptual
    }
    if (!result) {
        result = set_texts(context, raster);
    }
    return result != 0 ? result : spng_encode_chunks(context);
}

// PNG and PPM want the more significant byte first.
static void swap_to_big_endian(uint16_t *samples, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const uint8_t bytes[2] = {(uint8_t)(samples[i] >> 8), (uint8_t)samples[i]};
        memcpy(&samples[i], bytes, sizeof bytes);
    }
}

// Sets `*gave_up` where the file is left unfinished, though nothing failed.
static bool write_rows(struct cli_png_rows *rows, const struct cli_output_file *file,
                       const struct cli_raster *raster, bool *gave_up)
{
    for (int y = 0; y < raster->height; y++) {
        *gave_up = !cli_output_file_goes_on(file);
        if (*gave_up) {
            return true;
        }
        raster->row(raster->user, y, rows->row);
        if (raster->bits == 16) {
            swap_to_big_endian((uint16_t *)(void *)rows->row, rows->size / 2);
        }
        if (!cli_png_rows_add(rows)) {
            return false;
        }
    }
    return cli_png_rows_finish(rows);
}

bool cli_png_write(struct cli_output_file *file, const struct cli_raster *raster)
{
    struct cli_png_rows rows;
    spng_ctx *context = spng_ctx_new(SPNG_CTX_ENCODER);
    const bool is_ready = cli_png_rows_open(&rows, file->stream, row_size(raster)) && context;
    int result = is_ready ? spng_set_png_stream(context, write_to_stream, file->stream) : SPNG_EMEM;
    bool gave_up = false;
    errno = 0;
    if (!result) {
        result = start_png(context, raster);
    }
    if (!result && !write_rows(&rows, file, raster, &gave_up)) {
        result = SPNG_IO_ERROR;
    }
    if (result) {
        cli_error(file->path, "cannot be written: %s", errno ? strerror(errno) : spng_strerror(result));
    }
    spng_ctx_free(context);
    cli_png_rows_close(&rows);
    return result == SPNG_OK && !gave_up;
}

bool cli_ppm_write(struct cli_output_file *file, const struct cli_raster *raster)
{
    const size_t size = row_size(raster);
    void *row = malloc(size);
    errno = row ? 0 : ENOMEM;
    bool written = row && fprintf(file->stream, "P%d\n%d %d\n%d\n", raster->channels == 1 ? 5 : 6,
                                  raster->width, raster->height, raster->bits == 8 ? 255 : 65535) > 0;
    for (int y = 0; written && y < raster->height; y++) {
        raster->row(raster->user, y, row);
        if (raster->bits == 16) {
            swap_to_big_endian(row, size / 2);
        }
        written = fwrite(row, 1, size, file->stream) == size;
    }
    if (!written) {
        cli_error(file->path, "cannot be written: %s", strerror(errno ? errno : EIO));
    }
    free(row);
    return written;
}
