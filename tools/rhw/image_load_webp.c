// SPDX-License-Identifier: MIT
// Still WebP pictures by libwebp, which takes a file as a whole. A picture that moves has no one raster to compare.
#include "image_load_webp.h"

#include "message.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <webp/decode.h>

// All of the stream, which begins at its start; NULL after a line on stderr.
static uint8_t *read_all(const struct cli_loaded_image *image, const char *path, FILE *stream, size_t *size)
{
    const long length = fseek(stream, 0, SEEK_END) == 0 ? ftell(stream) : -1;
    if (length < 0 || fseek(stream, 0, SEEK_SET) != 0) {
        cli_error(path, "%s", strerror(errno));
        return NULL;
    }
    uint8_t *const bytes = (size_t)length < image->most ? malloc((size_t)length + 1) : NULL;
    if (!bytes) {
        cli_error(path, "out of memory");
        return NULL;
    }
    *size = fread(bytes, 1, (size_t)length, stream);
    return bytes;
}

static bool decode(struct cli_loaded_image *image, const char *path, const uint8_t *bytes, size_t size)
{
    WebPBitstreamFeatures features; // a side has at most 16383 pixels
    const VP8StatusCode status = WebPGetFeatures(bytes, size, &features);
    if (status == VP8_STATUS_OK && features.has_animation) {
        cli_error(path, "moves; 'rhw render' with a {frame} in OUT writes pictures that can be compared");
        return false;
    }
    if (status != VP8_STATUS_OK) {
        cli_error(path, status == VP8_STATUS_NOT_ENOUGH_DATA ? "the WebP file ends too early"
                                                             : "not a valid WebP file");
        return false;
    }
    image->width = features.width;
    image->height = features.height;
    const size_t row = (size_t)features.width * 4, total = row * (size_t)features.height;
    if (!cli_image_allocate(image, path, total, 1)) {
        return false;
    }
    if (!WebPDecodeRGBAInto(bytes, size, image->memory, total, (int)row)) {
        cli_error(path, "the WebP file ends too early, or is damaged");
        return false;
    }
    return true;
}

bool cli_image_load_webp(struct cli_loaded_image *image, const char *path, FILE *stream)
{
    size_t size = 0;
    uint8_t *const bytes = read_all(image, path, stream, &size);
    const bool loaded = bytes && decode(image, path, bytes, size);
    free(bytes);
    return loaded;
}
