// SPDX-License-Identifier: MIT
// PNG and PPM decoders and access to samples; see image_load.h. EXR stands in image_load_exr.c, WebP in
// image_load_webp.c. libspng expands every kind of PNG to RGBA; spng's choices for palettes and key colours are thus
// ours.
#include "image_load.h"

#include "file.h"
#include "image_load_exr.h"
#include "image_load_webp.h"
#include "message.h"
#include "rhw/types.h"

#include <errno.h>
#include <spng.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const rgba_names[4] = {"R", "G", "B", "A"};

static size_t sample_size(enum cli_sample_type type)
{
    return type == CLI_SAMPLE_U8 ? 1 : type == CLI_SAMPLE_U16 ? 2 : 4;
}

// Lays R, G, B, A over interleaved memory with 1 (grey), 3 or 4 samples per pixel.
static bool describe_rgba(struct cli_loaded_image *image, int samples, enum cli_sample_type type)
{
    image->channels = calloc(4, sizeof *image->channels);
    if (!image->channels) {
        return false;
    }
    image->channel_count = 4;
    image->encoded = true;
    const size_t size = sample_size(type);
    for (int i = 0; i < 4; i++) {
        struct cli_image_channel *channel = &image->channels[i];
        strcpy(channel->name, rgba_names[i]);
        channel->type = type;
        channel->pixel_stride = size * (size_t)samples;
        channel->row_stride = channel->pixel_stride * (size_t)image->width;
        if (i < 3 || samples == 4) {
            channel->first = (const uint8_t *)image->memory + (samples == 1 ? 0 : (size_t)i * size);
        }
    }
    return true;
}

bool cli_image_allocate(struct cli_loaded_image *image, const char *path, size_t count, size_t size)
{
    const size_t megabyte = 1 << 20;
    if (count > image->most / size) {
        cli_error(path, "takes %zu MiB of memory, more than the %zu MiB that a picture may",
                  count / megabyte * size + count % megabyte * size / megabyte, image->most / megabyte);
        return false;
    }
    image->memory = calloc(count, size);
    if (!image->memory) {
        cli_error(path, "out of memory");
    }
    return image->memory != NULL;
}

// What is not the picture, but colour profiles and texts, may take a small part of the memory: a compressed chunk can
// become a thousand times as large.
static int limit_png(spng_ctx *context)
{
    const size_t chunk = 64 << 20, all = 128 << 20;
    const int result = spng_set_image_limits(context, RHW_MAX_TARGET_SIZE, RHW_MAX_TARGET_SIZE);
    return result ? result : spng_set_chunk_limits(context, chunk, all);
}

// SPNG_OK, or what is wrong with the file; after *told has become true a line says it.
static int decode_png(struct cli_loaded_image *image, spng_ctx *context, const char *path, FILE *stream,
                      bool *told)
{
    struct spng_ihdr header;
    size_t size = 0;
    int result = limit_png(context);
    if (!result) {
        result = spng_set_png_file(context, stream);
    }
    if (!result) {
        result = spng_get_ihdr(context, &header);
    }
    if (result) {
        return result;
    }

    const int format = header.bit_depth == 16 ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
    result = spng_decoded_image_size(context, format, &size);
    if (result) {
        return result;
    }
    if (!cli_image_allocate(image, path, size, 1)) {
        *told = true;
        return SPNG_EMEM;
    }
    result = spng_decode_image(context, image->memory, size, format, SPNG_DECODE_TRNS);
    if (result) {
        return result;
    }
    image->width = (int)header.width;
    image->height = (int)header.height;
    image->full_scale = header.bit_depth == 16 ? 65535.0 : 255.0;
    return describe_rgba(image, 4, header.bit_depth == 16 ? CLI_SAMPLE_U16 : CLI_SAMPLE_U8) ? SPNG_OK
                                                                                            : SPNG_EMEM;
}

static bool load_png(struct cli_loaded_image *image, const char *path, FILE *stream)
{
    bool told = false;
    spng_ctx *context = spng_ctx_new(0);
    const int result = context ? decode_png(image, context, path, stream, &told) : SPNG_EMEM;
    spng_ctx_free(context);
    if (told) {
        return false;
    }
    if (result == SPNG_EUSER_WIDTH || result == SPNG_EUSER_HEIGHT) {
        cli_error(path, "larger than %d pixels", RHW_MAX_TARGET_SIZE);
    } else if (result == SPNG_IO_EOF || result == SPNG_EIDAT_TOO_SHORT) {
        cli_error(path, "the PNG file ends too early");
    } else if (result) {
        cli_error(path, "not a valid PNG file: %s", spng_strerror(result));
    }
    return result == SPNG_OK;
}

// The next number of a PPM header or of its text form; white space and # comments before it are skipped.
static bool read_number(FILE *stream, int most, int *number)
{
    int c = getc(stream);
    while (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '#') {
        while (c == '#' && (c = getc(stream)) != '\n' && c != EOF) {
            c = '#';
        }
        c = getc(stream);
    }
    long value = 0;
    int digits = 0;
    for (; c >= '0' && c <= '9' && value <= most; c = getc(stream), digits++) {
        value = value * 10 + (c - '0');
    }
    *number = (int)value; // the white space after the last digit has been read, as the format asks
    return digits > 0 && value <= most;
}

static bool read_ppm_samples(FILE *stream, bool text, int most, enum cli_sample_type type, void *memory,
                             size_t count)
{
    if (!text && fread(memory, sample_size(type), count, stream) != count) {
        return false;
    }
    uint8_t *bytes = memory;
    uint16_t *words = memory;
    for (size_t i = 0; i < count; i++) {
        int value = 0;
        if (text && !read_number(stream, most, &value)) {
            return false;
        }
        if (!text && type == CLI_SAMPLE_U8) {
            value = bytes[i];
        }
        if (!text && type == CLI_SAMPLE_U16) {
            value = ((const uint8_t *)&words[i])[0] << 8 | ((const uint8_t *)&words[i])[1];
        }
        if (value > most) {
            return false;
        }
        if (type == CLI_SAMPLE_U8) {
            bytes[i] = (uint8_t)value;
        } else {
            words[i] = (uint16_t)value;
        }
    }
    return true;
}

static bool load_ppm(struct cli_loaded_image *image, const char *path, FILE *stream)
{
    getc(stream);
    const int kind = getc(stream); // '2', '3' text, '5', '6' binary; grey, RGB in turn
    const int samples = kind == '3' || kind == '6' ? 3 : 1;
    int most;
    if (!read_number(stream, RHW_MAX_TARGET_SIZE, &image->width) ||
        !read_number(stream, RHW_MAX_TARGET_SIZE, &image->height) || !read_number(stream, 65535, &most) ||
        image->width < 1 || image->height < 1 || most < 1) {
        cli_error(path,
                  "not a valid PPM header: expected width and height of 1..%d and a maximum of 1..65535",
                  RHW_MAX_TARGET_SIZE);
        return false;
    }
    const enum cli_sample_type type = most > 255 ? CLI_SAMPLE_U16 : CLI_SAMPLE_U8;
    const size_t count = (size_t)image->width * (size_t)image->height * (size_t)samples;
    image->full_scale = most;
    if (!cli_image_allocate(image, path, count, sample_size(type))) {
        return false;
    }
    if (!describe_rgba(image, samples, type)) {
        cli_error(path, "out of memory");
        return false;
    }
    if (!read_ppm_samples(stream, kind < '5', most, type, image->memory, count)) {
        cli_error(path,
                  feof(stream) ? "the PPM file ends too early" : "a sample of the PPM file is out of range");
        return false;
    }
    return true;
}

static bool load_webp(struct cli_loaded_image *image, const char *path, FILE *stream)
{
    if (!cli_image_load_webp(image, path, stream)) {
        return false;
    }
    image->full_scale = 255.0;
    if (!describe_rgba(image, 4, CLI_SAMPLE_U8)) {
        cli_error(path, "out of memory");
        return false;
    }
    return true;
}

static bool load_stream(struct cli_loaded_image *image, const char *path, FILE *stream)
{
    static const uint8_t png_magic[] = {0x89, 'P', 'N', 'G'}, exr_magic[] = {0x76, 0x2F, 0x31, 0x01};
    uint8_t magic[12] = {0};
    const size_t got = fread(magic, 1, sizeof magic, stream);
    if (ferror(stream)) {
        cli_error(path, "%s", strerror(errno));
        return false;
    }
    if (got == 0) {
        cli_error(path, "the file is empty");
        return false;
    }
    if (fseek(stream, 0, SEEK_SET) != 0) {
        cli_error(path, "%s", strerror(errno));
        return false;
    }
    if (memcmp(magic, png_magic, sizeof png_magic) == 0) {
        return load_png(image, path, stream);
    }
    if (memcmp(magic, exr_magic, sizeof exr_magic) == 0) {
        return cli_image_load_exr(image, path);
    }
    if (memcmp(magic, "RIFF", 4) == 0 && memcmp(magic + 8, "WEBP", 4) == 0) {
        return load_webp(image, path, stream);
    }
    if (magic[0] == 'P' && magic[1] && strchr("2356", magic[1])) {
        return load_ppm(image, path, stream);
    }
    cli_error(path, "not a picture that rhw reads (PNG, WebP, EXR, PPM, PGM)");
    return false;
}

bool cli_image_load(struct cli_loaded_image *image, const char *path, size_t most)
{
    *image = (struct cli_loaded_image){.full_scale = 1.0, .most = most};
    const int descriptor = system_file_open_regular(path);
    FILE *const stream = descriptor >= 0 ? fdopen(descriptor, "rb") : NULL;
    if (!stream) {
        cli_error(path, "cannot be opened: %s", errno ? strerror(errno) : "it is no regular file");
        return false;
    }
    const bool loaded = load_stream(image, path, stream);
    fclose(stream);
    if (!loaded) {
        cli_image_unload(image);
    }
    return loaded;
}

void cli_image_unload(struct cli_loaded_image *image)
{
    free(image->channels);
    free(image->memory);
    *image = (struct cli_loaded_image){0};
}

static double read_sample(const uint8_t *sample, enum cli_sample_type type)
{
    uint16_t u16;
    uint32_t u32;
    float number;
    switch (type) {
    case CLI_SAMPLE_U8: return *sample;
    case CLI_SAMPLE_U16: memcpy(&u16, sample, sizeof u16); return u16;
    case CLI_SAMPLE_U32: memcpy(&u32, sample, sizeof u32); return u32;
    case CLI_SAMPLE_FLOAT: break;
    }
    memcpy(&number, sample, sizeof number);
    return (double)number;
}

void cli_image_row(const struct cli_loaded_image *image, int channel, int y, double *row)
{
    const struct cli_image_channel *source = &image->channels[channel];
    for (int x = 0; x < image->width; x++) {
        const uint8_t *first = source->first;
        row[x] = first
                     ? read_sample(first + (size_t)y * source->row_stride + (size_t)x * source->pixel_stride,
                                   source->type) /
                           image->full_scale
                     : 1.0;
    }
}

int cli_image_find_channel(const struct cli_loaded_image *image, const char *name)
{
    for (int i = 0; i < image->channel_count; i++) {
        if (strcmp(image->channels[i].name, name) == 0) {
            return i;
        }
    }
    return -1;
}
