// SPDX-License-Identifier: MIT
// Image files are read through stb_image, through libwebp, and by ktx2.c. The size is read first, so that a small file
// cannot ask for more memory than the largest texture takes. GIF and PIC are left out: no model format that is read
// here uses them, and their decoders are where stb_image's known faults lie.
#include "read.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "elementary.h"
#include "ktx2.h"
#include "png.h"
#include "radiance.h"
#include "reduce.h"

// stb_image declares a function that it never defines. gcc says so at the end of the file.
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_GIF
#define STBI_NO_PIC
#define STBI_MAX_DIMENSIONS 16384
#define pow                 scene_pow // pow makes 8 bits of Radiance files
#include <stb_image.h>
#undef pow
#include <webp/decode.h>

_Static_assert(STBI_MAX_DIMENSIONS == RHW_MAX_TARGET_SIZE, "a texture takes what can be decoded");

void scene_image_find_alpha(struct scene_image *image)
{
    const size_t texels = (size_t)image->width * image->height;
    bool found = false;
    if (image->type == SCENE_IMAGE_RGBA8) {
        const uint8_t *alpha = (const uint8_t *)image->texels + 3;
        for (size_t i = 0; i < texels && !found; i++) {
            found = alpha[4 * i] != UINT8_MAX;
        }
    } else if (image->type == SCENE_IMAGE_RGBA16) {
        const uint16_t *alpha = (const uint16_t *)image->texels + 3;
        for (size_t i = 0; i < texels && !found; i++) {
            found = alpha[4 * i] != UINT16_MAX;
        }
    }
    image->has_alpha = found; // Radiance HDR has no alpha
}

// Bytes that stb_image asks for as it goes. Only in this way can it be told that there were too few.
struct supply {
    const unsigned char *bytes;
    size_t size, at;
    bool ran_out;
};

static int supply_read(void *user, char *data, int size)
{
    // The number of bytes that stb_image asks for ahead. It needs what it asks for in other numbers.
    enum { BUFFERED = 128 };
    struct supply *supply = user;
    const size_t left = supply->size - supply->at;
    const size_t got = left < (size_t)size ? left : (size_t)size;
    memcpy(data, supply->bytes + supply->at, got);
    supply->at += got;
    supply->ran_out = supply->ran_out || got == 0 || (got < (size_t)size && size != BUFFERED);
    return (int)got;
}

static void supply_skip(void *user, int count)
{
    struct supply *supply = user;
    const size_t left = supply->size - supply->at;
    supply->at += count > 0 && (size_t)count < left ? (size_t)count : count > 0 ? left : 0;
}

static int supply_ended(void *user)
{
    const struct supply *supply = user;
    return supply->at == supply->size;
}

// Decode a Radiance file. stb_image takes what is missing at the end for black.
static float *decode_radiance(const void *bytes, size_t size, int *width, int *height, const char **problem)
{
    *problem = scene_radiance_problem(bytes, size);
    if (*problem != NULL) {
        return NULL;
    }
    const stbi_io_callbacks callbacks = {supply_read, supply_skip, supply_ended};
    struct supply supply = {.bytes = bytes, .size = size};
    int channels = 0;
    float *texels = stbi_loadf_from_callbacks(&callbacks, &supply, width, height, &channels, 4);
    *problem = texels == NULL ? stbi_failure_reason() : NULL;
    if (texels != NULL && supply.ran_out) {
        free(texels);
        texels = NULL;
        *problem = "the Radiance HDR file ends too early";
    }
    return texels;
}

static bool is_webp(const unsigned char *bytes, size_t size)
{
    return size >= 12 && memcmp(bytes, "RIFF", 4) == 0 && memcmp(bytes + 8, "WEBP", 4) == 0;
}

static const char *decode_webp(const void *bytes, size_t size, struct scene_image *image)
{
    WebPBitstreamFeatures features;
    if (WebPGetFeatures(bytes, size, &features) != VP8_STATUS_OK) { // WebP has at most 16383 texels each way
        return "damaged WebP";
    }
    if (features.has_animation) {
        return "an animated WebP";
    }
    image->type = SCENE_IMAGE_RGBA8;
    image->width = (uint32_t)features.width;
    image->height = (uint32_t)features.height;
    image->size = (size_t)image->width * image->height * 4;
    image->texels = malloc(image->size);
    if (image->texels == NULL) {
        return "outofmem";
    }
    if (WebPDecodeRGBAInto(bytes, size, image->texels, image->size, 4 * features.width) == NULL) {
        free(image->texels);
        return "damaged WebP";
    }
    scene_image_find_alpha(image);
    return NULL;
}

const char *scene_image_decode(const void *bytes, size_t size, struct scene_image *image)
{
    if (size == 0) {
        return "the file is empty";
    }
    if (is_webp(bytes, size)) {
        return decode_webp(bytes, size, image);
    }
    if (scene_image_is_ktx2(bytes, size)) {
        const char *const problem = scene_image_decode_ktx2(bytes, size, image);
        if (problem == NULL) {
            scene_image_find_alpha(image);
        }
        return problem;
    }
    if (size > INT_MAX) {
        return "the file is too large";
    }
    const int length = (int)size;
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes, length, &width, &height, &channels)) {
        const char *reason = stbi_failure_reason();
        return strcmp(reason, "unknown image type") == 0 ? "not an image format that can be read" : reason;
    }
    if (width < 1 || height < 1 || width > RHW_MAX_TARGET_SIZE || height > RHW_MAX_TARGET_SIZE) {
        return "width and height must be 1 to 16384";
    }
    enum scene_image_type type = SCENE_IMAGE_RGBA8;
    size_t texel = 4;
    void *texels = NULL;
    if (stbi_is_hdr_from_memory(bytes, length)) {
        type = SCENE_IMAGE_RGBA32F;
        texel = 16;
        const char *problem;
        texels = decode_radiance(bytes, size, &width, &height, &problem);
        if (texels == NULL) {
            return problem;
        }
    } else if (stbi_is_16_bit_from_memory(bytes, length)) {
        type = SCENE_IMAGE_RGBA16;
        texel = 8;
        texels = stbi_load_16_from_memory(bytes, length, &width, &height, &channels, 4);
    } else {
        texels = stbi_load_from_memory(bytes, length, &width, &height, &channels, 4);
    }
    if (texels == NULL) {
        return stbi_failure_reason();
    }
    image->type = type;
    image->width = (uint32_t)width;
    image->height = (uint32_t)height;
    image->size = (size_t)width * (size_t)height * texel;
    image->texels = texels;
    scene_image_find_alpha(image);
    return NULL;
}

size_t scene_image_texels(const void *bytes, size_t size)
{
    int width = 0, height = 0, channels;
    if (is_webp(bytes, size)) {
        WebPGetInfo(bytes, size, &width, &height);
    } else if (size <= INT_MAX) {
        stbi_info_from_memory(bytes, (int)size, &width, &height, &channels);
    }
    return width > 0 && height > 0 ? (size_t)width * (size_t)height : 0;
}

const char *scene_image_decode_within(const void *bytes, size_t size, uint32_t side, bool is_color,
                                      struct scene_image *image)
{
    int width, height, channels;
    if (size <= INT_MAX && scene_image_is_png_of_rows(bytes, size) &&
        stbi_info_from_memory(bytes, (int)size, &width, &height, &channels) &&
        scene_reduce_needed((uint32_t)width, (uint32_t)height, side)) {
        const char *const problem = scene_image_decode_png_reduced(bytes, size, side, is_color, image);
        if (problem == NULL) {
            scene_image_find_alpha(image);
        }
        return problem;
    }
    const char *const problem = scene_image_decode(bytes, size, image);
    if (problem != NULL || !scene_reduce_needed(image->width, image->height, side)) {
        return problem;
    }
    if (!scene_reduce_image(image, side, is_color)) {
        free(image->texels);
        return "outofmem";
    }
    return NULL;
}

bool scene_image_stand_in(struct scene_image *image)
{
    enum { SIDE = 8 };
    uint8_t(*texels)[4] = malloc(SIDE * SIDE * sizeof *texels);
    if (texels == NULL) {
        return false;
    }
    for (int i = 0; i < SIDE * SIDE; i++) {
        const bool magenta = (i / SIDE + i) % 2 == 0;
        // The dark shade is not black, so that a part that shows one field alone is no shadow.
        const uint8_t shade = magenta ? 255 : 96;
        const uint8_t texel[4] = {shade, 0, shade, 255};
        memcpy(texels[i], texel, sizeof texel);
    }
    image->type = SCENE_IMAGE_RGBA8;
    image->width = image->height = SIDE;
    image->size = SIDE * SIDE * sizeof *texels;
    image->texels = texels;
    image->has_alpha = false;
    image->missing = true;
    return true;
}
