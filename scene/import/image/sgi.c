// SPDX-License-Identifier: MIT
// Each channel of an SGI file has all of its rows, the lowest first. They stand one behind the other, or each is packed
// by itself and found by a table. All numbers begin with their highest byte.
#include "sgi.h"

#include <stdlib.h>
#include <string.h>

static const char damaged[] = "damaged SGI image";

enum { HEADER = 512, CHANNELS = 4 };

struct sgi {
    const unsigned char *bytes;
    size_t size;
    uint32_t width, height, channels;
    size_t depth; // bytes of a value, 1 or 2
    bool is_packed;
};

static uint32_t number_at(const unsigned char *bytes, size_t count)
{
    uint32_t number = 0;
    for (size_t i = 0; i < count; i++) {
        number = number << 8 | bytes[i];
    }
    return number;
}

bool scene_sgi_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    if (size < 12) {
        return false;
    }
    const uint32_t dimensions = number_at(bytes + 4, 2);
    *width = number_at(bytes + 6, 2);
    *height = dimensions < 2 ? 1 : number_at(bytes + 8, 2);
    return true;
}

// Read values that stand one behind the other. Return false if the file ends before.
static bool read_plain(const struct sgi *sgi, size_t row, uint16_t *values)
{
    const size_t length = sgi->width * sgi->depth, at = HEADER + row * length;
    if (at > sgi->size || sgi->size - at < length) {
        return false;
    }
    for (size_t i = 0; i < sgi->width; i++) {
        values[i] = (uint16_t)number_at(sgi->bytes + at + i * sgi->depth, sgi->depth);
    }
    return true;
}

// Unpack a row: counts, each before as many values, or before one that is repeated, up to a count of 0 or the end.
// Return false if there are more values or fewer than the image is wide.
static bool unpack(const struct sgi *sgi, size_t at, size_t end, uint16_t *values)
{
    size_t filled = 0;
    while (end - at >= sgi->depth) {
        const uint32_t code = number_at(sgi->bytes + at, sgi->depth), count = code & 127;
        const bool is_run = (code & 128) == 0;
        at += sgi->depth;
        if (count == 0) {
            break;
        }
        if (count > sgi->width - filled || (is_run ? 1 : count) * sgi->depth > end - at) {
            return false;
        }
        for (uint32_t i = 0; i < count; i++) {
            values[filled++] = (uint16_t)number_at(sgi->bytes + at, sgi->depth);
            at += is_run ? 0 : sgi->depth;
        }
        at += is_run ? sgi->depth : 0;
    }
    return filled == sgi->width;
}

// Read a row that the table says. Return false if it is not there.
static bool read_packed(const struct sgi *sgi, size_t row, uint16_t *values)
{
    const size_t rows = (size_t)sgi->height * sgi->channels, tables = HEADER + 8 * rows;
    if (sgi->size < tables) {
        return false;
    }
    const size_t start = number_at(sgi->bytes + HEADER + 4 * row, 4);
    const size_t length = number_at(sgi->bytes + HEADER + 4 * (rows + row), 4);
    return start <= sgi->size && length <= sgi->size - start && unpack(sgi, start, start + length, values);
}

// Read a row of a channel into the texels of its line.
static bool read_row(const struct sgi *sgi, uint32_t channel, uint32_t line, uint16_t *values, void *texels)
{
    const size_t row = (size_t)channel * sgi->height + (sgi->height - 1 - line);
    if (!(sgi->is_packed ? read_packed(sgi, row, values) : read_plain(sgi, row, values))) {
        return false;
    }
    const size_t first = CHANNELS * (size_t)line * sgi->width + channel;
    for (size_t i = 0; i < sgi->width; i++) {
        if (sgi->depth == 1) {
            ((uint8_t *)texels)[first + CHANNELS * i] = (uint8_t)values[i];
        } else {
            ((uint16_t *)texels)[first + CHANNELS * i] = values[i];
        }
    }
    return true;
}

// Make RGBA of the channels that were read: grey, grey and alpha, or colours without alpha.
static void complete(const struct sgi *sgi, void *texels)
{
    const size_t count = (size_t)sgi->width * sgi->height;
    for (size_t i = 0; i < count; i++) {
        for (uint32_t c = CHANNELS - 1; c > 0; c--) {
            const uint32_t source = sgi->channels >= 3 ? c : c == 3 ? 1 : 0;
            const bool is_opaque = c == 3 && sgi->channels % 2 == 1;
            if (sgi->depth == 1) {
                uint8_t *const texel = (uint8_t *)texels + CHANNELS * i;
                texel[c] = is_opaque ? UINT8_MAX : texel[source];
            } else {
                uint16_t *const texel = (uint16_t *)texels + CHANNELS * i;
                texel[c] = is_opaque ? UINT16_MAX : texel[source];
            }
        }
    }
}

const char *scene_image_decode_sgi(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    struct sgi sgi = {.bytes = bytes, .size = size};
    if (size < HEADER || !scene_sgi_size(bytes, size, &sgi.width, &sgi.height) || bytes[2] > 1 ||
        bytes[3] < 1 || bytes[3] > 2) {
        return damaged;
    }
    if (number_at(bytes + 104, 4) != 0) {
        return "an SGI image with a map of colours, which is not read";
    }
    const uint32_t channels = number_at(bytes + 4, 2) < 3 ? 1 : number_at(bytes + 10, 2);
    sgi.channels = channels;
    sgi.depth = bytes[3];
    sgi.is_packed = bytes[2] == 1;
    if (channels < 1 || channels > CHANNELS) {
        return "an SGI image that has not 1 to 4 channels";
    }
    const size_t texels = (size_t)sgi.width * sgi.height;
    void *const made = malloc(CHANNELS * sgi.depth * texels);
    uint16_t *const values = malloc(sgi.width * sizeof *values);
    bool is_whole = made != NULL && values != NULL;
    for (uint32_t c = 0; c < channels && is_whole; c++) {
        for (uint32_t line = 0; line < sgi.height && is_whole; line++) {
            is_whole = read_row(&sgi, c, line, values, made);
        }
    }
    const char *const problem = made == NULL || values == NULL ? "outofmem" : is_whole ? NULL : damaged;
    free(values);
    if (problem != NULL) {
        free(made);
        return problem;
    }
    complete(&sgi, made);
    image->type = sgi.depth == 1 ? SCENE_IMAGE_RGBA8 : SCENE_IMAGE_RGBA16;
    image->width = sgi.width;
    image->height = sgi.height;
    image->size = CHANNELS * sgi.depth * texels;
    image->texels = made;
    return NULL;
}
