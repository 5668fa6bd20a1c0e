// SPDX-License-Identifier: MIT
// libspng reads the rows. Its checksums are not asked for, as those of smaller files are not.
#include "png.h"

#include <limits.h>
#include <spng.h>
#include <stdlib.h>
#include <string.h>

#include "reduce.h"

static uint32_t read_32(const unsigned char *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

// Return the data of IHDR, of 13 bytes (PNG, third edition, §11.2.1). Return NULL if it is not there. iPhones have a
// chunk of their own before it.
static const unsigned char *find_header(const unsigned char *bytes, size_t size)
{
    static const unsigned char signature[8] = {137, 80, 78, 71, 13, 10, 26, 10};
    enum { CHUNK = 12, HEADER = 13 };
    size_t at = sizeof signature;
    if (size < at || memcmp(bytes, signature, sizeof signature) != 0) {
        return NULL;
    }
    if (size - at >= CHUNK && memcmp(bytes + at + 4, "CgBI", 4) == 0) {
        const size_t length = read_32(bytes + at), left = size - at - CHUNK;
        at += CHUNK + (length < left ? length : left);
    }
    const bool found = size - at >= 8 + HEADER && memcmp(bytes + at + 4, "IHDR", 4) == 0;
    return found ? bytes + at + 8 : NULL;
}

bool scene_png_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    const unsigned char *const header = find_header(bytes, size);
    *width = header != NULL ? read_32(header) : 0;
    *height = header != NULL ? read_32(header + 4) : 0;
    return header != NULL;
}

const char *scene_png_problem(const unsigned char *bytes, size_t size)
{
    const unsigned char *const header = find_header(bytes, size);
    if (header == NULL) {
        return NULL;
    }
    const uint64_t width = read_32(header), height = read_32(header + 4);
    const uint32_t depth = header[8], color = header[9];
    const uint32_t samples = color == 3 ? 1u : (color & 2 ? 3u : 1u) + (color & 4 ? 1u : 0u);
    return (width * depth * samples / 8 + 1) * height > INT_MAX
               ? "a PNG of 2 GiB of samples, which is not read"
               : NULL;
}

bool scene_image_is_png_of_rows(const unsigned char *bytes, size_t size)
{
    // libspng wants the header to be the first chunk, whose data stands here.
    enum { FIRST_CHUNK = 16 };
    const unsigned char *const header = find_header(bytes, size);
    return header == bytes + FIRST_CHUNK && header[12] == 0;
}

static int read_rows(spng_ctx *png, struct scene_reducer *reducer)
{
    const size_t size = (size_t)reducer->width * 4;
    uint8_t *const row = malloc(size);
    if (!row) {
        return SPNG_EMEM;
    }
    int result = spng_decode_image(png, NULL, 0, SPNG_FMT_RGBA8, SPNG_DECODE_TRNS | SPNG_DECODE_PROGRESSIVE);
    for (uint32_t y = 0; y < reducer->height && result == 0; y++) {
        result = spng_decode_row(png, row, size); // SPNG_EOI with the last row
        if (result == 0 || (result == SPNG_EOI && y + 1 == reducer->height)) {
            scene_reducer_add(reducer, row);
        }
    }
    free(row);
    return result == SPNG_EOI ? 0 : result;
}

static int decode(spng_ctx *png, const unsigned char *bytes, size_t size, uint32_t side, bool is_color,
                  struct scene_image *image)
{
    struct spng_ihdr header;
    // What is not the picture, but colour profiles and texts, may be compressed a thousandfold.
    const size_t chunk = 64 << 20, all = 128 << 20;
    int result = spng_set_image_limits(png, RHW_MAX_TARGET_SIZE, RHW_MAX_TARGET_SIZE);
    if (result == 0) {
        result = spng_set_chunk_limits(png, chunk, all);
    }
    if (result == 0) {
        result = spng_set_crc_action(png, SPNG_CRC_USE, SPNG_CRC_USE);
    }
    if (result == 0) {
        result = spng_set_png_buffer(png, bytes, size);
    }
    if (result == 0) {
        result = spng_get_ihdr(png, &header);
    }
    struct scene_image reduced = *image;
    struct scene_reducer reducer;
    if (result != 0) {
        return result;
    }
    if (!scene_reducer_open(&reducer, header.width, header.height, side, is_color, &reduced)) {
        return SPNG_EMEM;
    }
    result = read_rows(png, &reducer);
    scene_reducer_close(&reducer);
    if (result != 0) {
        free(reduced.texels);
        return result;
    }
    *image = reduced;
    return 0;
}

const char *scene_image_decode_png_reduced(const unsigned char *bytes, size_t size, uint32_t side,
                                           bool is_color, struct scene_image *image)
{
    spng_ctx *const png = spng_ctx_new(0);
    if (!png) {
        return "outofmem";
    }
    const int result = decode(png, bytes, size, side, is_color, image);
    spng_ctx_free(png);
    return result == 0 ? NULL : result == SPNG_EMEM ? "outofmem" : spng_strerror(result);
}
