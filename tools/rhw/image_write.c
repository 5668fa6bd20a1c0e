// SPDX-License-Identifier: MIT
// PNG and PPM encoders; see image_write.h. Others stand in files of their own.
#include "image_write.h"

#include "message.h"

#include <errno.h>
#include <spng.h>
#include <stdlib.h>
#include <string.h>

// Level 2 with the Up filter, measured on rendered pictures and on photographs at 1920×1080: within 10% of the
// size of libspng's defaults (level 6, the best of five filters per row) at a quarter of the time.
enum { PNG_LEVEL = 2, PNG_FILTER = SPNG_FILTER_CHOICE_UP };

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
    if (!result) {
        result = spng_set_option(context, SPNG_IMG_COMPRESSION_LEVEL, PNG_LEVEL);
    }
    if (!result) {
        result = spng_set_option(context, SPNG_FILTER_CHOICE, PNG_FILTER);
    }
    if (!result) {
        result =
            spng_encode_image(context, NULL, 0, SPNG_FMT_PNG, SPNG_ENCODE_PROGRESSIVE | SPNG_ENCODE_FINALIZE);
    }
    return result;
}

// Sets `*gave_up` where the file is left unfinished, though nothing failed.
static int encode_png(spng_ctx *context, const struct cli_output_file *file, const struct cli_raster *raster,
                      void *row, bool *gave_up)
{
    int result = start_png(context, raster);
    for (int y = 0; !result && !*gave_up && y < raster->height; y++) {
        *gave_up = !cli_output_file_goes_on(file);
        raster->row(raster->user, y, row);
        result = spng_encode_row(context, row, row_size(raster));
    }
    return result == SPNG_EOI ? SPNG_OK : result; // the last row reports the end of the image
}

bool cli_png_write(struct cli_output_file *file, const struct cli_raster *raster)
{
    spng_ctx *context = spng_ctx_new(SPNG_CTX_ENCODER);
    void *row = malloc(row_size(raster));
    int result = context && row ? spng_set_png_stream(context, write_to_stream, file->stream) : SPNG_EMEM;
    bool gave_up = false;
    errno = 0;
    if (!result) {
        result = encode_png(context, file, raster, row, &gave_up);
    }
    if (result) {
        cli_error(file->path, "cannot be written: %s", errno ? strerror(errno) : spng_strerror(result));
    }
    spng_ctx_free(context);
    free(row);
    return result == SPNG_OK && !gave_up;
}

// PPM wants the more significant byte first.
static void swap_to_big_endian(uint16_t *samples, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const uint8_t bytes[2] = {(uint8_t)(samples[i] >> 8), (uint8_t)samples[i]};
        memcpy(&samples[i], bytes, sizeof bytes);
    }
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
