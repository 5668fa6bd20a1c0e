// SPDX-License-Identifier: MIT
// libspng reads the rows. Its checksums are not asked for, as those of smaller files are not.
#include "png.h"

#include <spng.h>
#include <stdlib.h>
#include <string.h>

#include "reduce.h"

bool scene_image_is_png_of_rows(const unsigned char *bytes, size_t size)
{
    // The place of the method in a file: it follows the signature and most of IHDR (PNG, third edition, §11.2.1).
    enum { INTERLACE_METHOD = 28 };
    static const unsigned char signature[8] = {137, 80, 78, 71, 13, 10, 26, 10};
    return size > INTERLACE_METHOD && memcmp(bytes, signature, sizeof signature) == 0 &&
           bytes[INTERLACE_METHOD] == 0;
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
    return result == 0 ? NULL : spng_strerror(result);
}
