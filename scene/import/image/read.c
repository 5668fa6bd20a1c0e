// SPDX-License-Identifier: MIT
// Image files are read by the file of their format beside this one, through libwebp, or through stb_image. The size is
// read first, so that a small file cannot ask for more memory than the largest texture takes. stb_image's decoders of
// GIF, PIC and PNM are left out, because its known faults lie there.
#include "read.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "avif.h"
#include "dds.h"
#include "elementary.h"
#include "exr.h"
#include "gif.h"
#include "jpeg.h"
#include "ktx2.h"
#include "png.h"
#include "pnm.h"
#include "radiance.h"
#include "reduce.h"
#include "sgi.h"
#include "signature.h"
#include "tiff.h"

// stb_image declares a function that it never defines. gcc says so at the end of the file.
#pragma GCC diagnostic ignored "-Wunused-function"
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_GIF
#define STBI_NO_PIC
#define STBI_NO_PNM
#define STBI_MAX_DIMENSIONS 16384
// What a damaged file leaves unwritten is 0, so that it is drawn alike everywhere and shows nothing of other memory.
#define STBI_MALLOC(size)          calloc(1, size)
#define STBI_REALLOC(memory, size) realloc(memory, size)
#define STBI_FREE(memory)          free(memory)
#define pow                        scene_pow // pow makes 8 bits of Radiance files
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
    } else {
        const float *alpha = (const float *)image->texels + 3;
        for (size_t i = 0; i < texels && !found; i++) {
            found = alpha[4 * i] < 1;
        }
    }
    image->has_alpha = found;
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

// What is said where stb_image fails without a reason, in place of the reason of an earlier failure.
static const char damaged[] = "damaged";

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
    stbi__g_failure_reason = damaged;
    float *texels = stbi_loadf_from_callbacks(&callbacks, &supply, width, height, &channels, 4);
    *problem = texels == NULL ? stbi_failure_reason() : NULL;
    if (texels != NULL && supply.ran_out) {
        free(texels);
        texels = NULL;
        *problem = "the Radiance HDR file ends too early";
    }
    return texels;
}

static bool webp_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    int across = 0, down = 0;
    const bool known = WebPGetInfo(bytes, size, &across, &down) != 0;
    *width = (uint32_t)across;
    *height = (uint32_t)down;
    return known;
}

static const char *decode_webp(const unsigned char *bytes, size_t size, struct scene_image *image)
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
    return NULL;
}

static const char unknown_marker[] = "unknown marker"; // as stb_image says it
static const char unknown[] = "not an image format that can be read";

// Decode by stb_image, which takes the bytes by `supply` unless that is NULL.
static const char *decode_by_stb(const unsigned char *bytes, size_t size, struct supply *supply,
                                 struct scene_image *image)
{
    const stbi_io_callbacks callbacks = {supply_read, supply_skip, supply_ended};
    if (size > INT_MAX) {
        return "the file is too large";
    }
    const char *problem = scene_jpeg_problem(bytes, size);
    if (problem != NULL) {
        return problem;
    }
    const int length = (int)size;
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(bytes, length, &width, &height, &channels)) {
        return unknown;
    }
    enum scene_image_type type = SCENE_IMAGE_RGBA8;
    size_t texel = 4;
    void *texels = NULL;
    if (stbi_is_hdr_from_memory(bytes, length)) {
        type = SCENE_IMAGE_RGBA32F;
        texel = 16;
        texels = decode_radiance(bytes, size, &width, &height, &problem);
        if (texels == NULL) {
            return problem;
        }
    } else if (stbi_is_16_bit_from_memory(bytes, length)) {
        type = SCENE_IMAGE_RGBA16;
        texel = 8;
        stbi__g_failure_reason = damaged;
        texels = supply != NULL
                     ? stbi_load_16_from_callbacks(&callbacks, supply, &width, &height, &channels, 4)
                     : stbi_load_16_from_memory(bytes, length, &width, &height, &channels, 4);
    } else {
        stbi__g_failure_reason = damaged;
        texels = supply != NULL ? stbi_load_from_callbacks(&callbacks, supply, &width, &height, &channels, 4)
                                : stbi_load_from_memory(bytes, length, &width, &height, &channels, 4);
    }
    if (texels == NULL) {
        return stbi_failure_reason();
    }
    image->type = type;
    image->width = (uint32_t)width;
    image->height = (uint32_t)height;
    image->size = (size_t)width * (size_t)height * texel;
    image->texels = texels;
    return NULL;
}

// Decode TGA, BMP, PSD and Radiance HDR. stb_image takes what is missing at the end of them for zeros.
static const char *decode_other(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    struct supply supply = {.bytes = bytes, .size = size};
    struct scene_image decoded = *image;
    const char *const problem = decode_by_stb(bytes, size, &supply, &decoded);
    if (problem == NULL && supply.ran_out) {
        free(decoded.texels);
        return "the file ends too early";
    }
    *image = decoded;
    return problem;
}

static const char *decode_png(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    const char *const too_many = scene_png_problem(bytes, size);
    const char *const problem = too_many != NULL ? too_many : decode_by_stb(bytes, size, NULL, image);
    return problem == unknown ? "damaged PNG" : problem;
}

// Decode a JPEG with some bytes and a mark at its end, which stb_image asks for.
static const char *decode_ended(const unsigned char *bytes, size_t size, unsigned char filling,
                                struct scene_image *image)
{
    enum { FILLED = 16, MARK = 0xff, END = 0xd9 };
    unsigned char *const ended = malloc(size + FILLED + 2);
    if (ended == NULL) {
        return "outofmem";
    }
    memcpy(ended, bytes, size);
    memset(ended + size, filling, FILLED);
    ended[size + FILLED] = MARK;
    ended[size + FILLED + 1] = END;
    const char *const problem = decode_by_stb(ended, size + FILLED + 2, NULL, image);
    free(ended);
    return problem;
}

// Return why a JPEG that no mark ends is not decoded. Without memory nobody knows whether it is whole.
static const char *reason_of_cut(const char *problem)
{
    return problem != NULL && strcmp(problem, "outofmem") == 0 ? problem : "the JPEG ends too early";
}

// Decode a JPEG that no mark ends. It is whole if it does not matter what follows it.
static const char *decode_endless(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    struct scene_image whole = *image, other = *image;
    while (size > 0 && bytes[size - 1] == 0xff) {
        size--; // the first half of a mark
    }
    const char *problem = decode_ended(bytes, size, 0, &whole);
    if (problem != NULL) {
        return reason_of_cut(problem);
    }
    problem = decode_ended(bytes, size, 0xfe, &other);
    const bool is_whole =
        problem == NULL && other.size == whole.size && memcmp(other.texels, whole.texels, whole.size) == 0;
    if (problem == NULL) {
        free(other.texels);
    }
    if (!is_whole) {
        free(whole.texels);
        return reason_of_cut(problem);
    }
    *image = whole;
    image->lacks_end = true;
    return NULL;
}

// Decode a JPEG some of whose scans have a last byte of 0xff that is not needed.
// stb_image before version 2.28 takes it for a mark. It is replaced where the rest cannot be decoded with it, which
// shows that nothing has read it. Each place is decoded once more, so that large images have fewer.
static const char *decode_tailed(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    enum { MOST = 16, MOST_TEXELS = 1 << 28, TAIL = 0xff, OTHER = 0xfe };
    uint32_t width = 1, height = 1;
    scene_jpeg_size(bytes, size, &width, &height);
    const size_t room = MOST_TEXELS / ((size_t)width * height + 1) + 1;
    size_t places[MOST];
    const size_t count = scene_jpeg_tails(bytes, size, room < MOST ? room : MOST, places);
    if (count == 0) {
        return unknown_marker;
    }
    unsigned char *const changed = malloc(size);
    if (changed == NULL) {
        return "outofmem";
    }
    memcpy(changed, bytes, size);
    for (size_t i = 0; i < count; i++) {
        changed[places[i]] = OTHER;
    }
    struct scene_image decoded = *image;
    const char *problem = decode_by_stb(changed, size, NULL, &decoded);
    for (size_t i = 0; i < count && problem == NULL; i++) {
        struct scene_image trial = *image;
        changed[places[i]] = TAIL;
        if (decode_by_stb(changed, size, NULL, &trial) == NULL) {
            free(decoded.texels);
            decoded = trial;
        } else {
            changed[places[i]] = OTHER;
        }
    }
    free(changed);
    if (problem == NULL) {
        *image = decoded;
    }
    return problem;
}

static const char *decode_jpeg(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    bool lacks_end;
    const char *const gap =
        size <= INT_MAX ? scene_jpeg_gap(bytes, size, &lacks_end) : "the file is too large";
    if (gap != NULL) {
        return gap;
    }
    const char *problem =
        lacks_end ? decode_endless(bytes, size, image) : decode_by_stb(bytes, size, NULL, image);
    if (problem != NULL && strcmp(problem, unknown_marker) == 0) {
        problem = decode_tailed(bytes, size, image);
    }
    // stb_image tries PNG first. The reason is that of the trial where JPEG fails without one.
    const bool lacks_reason = problem != NULL && (problem == unknown || strcmp(problem, "bad png sig") == 0);
    return lacks_reason ? "damaged JPEG" : problem;
}

static bool other_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    int across = 0, down = 0, channels;
    const bool known =
        size <= INT_MAX && stbi_info_from_memory(bytes, (int)size, &across, &down, &channels) != 0;
    *width = (uint32_t)across;
    *height = (uint32_t)(down < 0 && down > INT_MIN ? -down : down); // rows of a BMP from the top down
    return known;
}

static bool jpeg_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    return scene_jpeg_problem(bytes, size) == NULL && scene_jpeg_size(bytes, size, width, height);
}

// What reads a format. There is no `decode` where the build lacks the library of the format, and no `measure` where an
// image is best decoded alone, whatever its size.
struct reader {
    const char *lacking; // refusal of a build without the library
    const char *(*decode)(const unsigned char *bytes, size_t size, struct scene_image *image);
    bool (*measure)(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height);
};

static const struct reader *reader_of(const unsigned char *bytes, size_t size, const char **refusal)
{
    static const struct reader readers[] = {
        [SCENE_FORMAT_OTHER] = {NULL, decode_other, other_size},
        [SCENE_FORMAT_PNG] = {NULL, decode_png, scene_png_size},
        [SCENE_FORMAT_JPEG] = {NULL, decode_jpeg, jpeg_size},
        [SCENE_FORMAT_WEBP] = {NULL, decode_webp, webp_size},
        [SCENE_FORMAT_KTX2] = {NULL, scene_image_decode_ktx2, scene_ktx2_size},
        [SCENE_FORMAT_DDS] = {NULL, scene_image_decode_dds, scene_dds_size},
        [SCENE_FORMAT_TIFF] = {"a TIFF image, which this build does not read",
                               SCENE_TIFF ? scene_image_decode_tiff : NULL,
                               SCENE_TIFF ? scene_tiff_size : NULL},
        [SCENE_FORMAT_EXR] = {"an EXR image, which this build does not read",
                              SCENE_EXR ? scene_image_decode_exr : NULL, NULL},
        [SCENE_FORMAT_GIF] = {"a GIF image, which this build does not read",
                              SCENE_GIF ? scene_image_decode_gif : NULL, SCENE_GIF ? scene_gif_size : NULL},
        [SCENE_FORMAT_AVIF] = {"an AVIF image, which this build does not read",
                               SCENE_AVIF ? scene_image_decode_avif : NULL, NULL},
        [SCENE_FORMAT_SGI] = {NULL, scene_image_decode_sgi, scene_sgi_size},
        [SCENE_FORMAT_PNM] = {NULL, scene_image_decode_pnm, scene_pnm_size},
        [SCENE_FORMAT_UNREAD] = {NULL, NULL, NULL},
    };
    const struct reader *const reader = &readers[scene_image_format(bytes, size, refusal)];
    if (reader->lacking != NULL) {
        *refusal = reader->lacking;
    }
    return reader;
}

// Return false if the header says a size that is refused.
static bool fits(const struct reader *reader, const unsigned char *bytes, size_t size)
{
    uint32_t width, height;
    return reader->measure == NULL || !reader->measure(bytes, size, &width, &height) ||
           (width >= 1 && height >= 1 && width <= RHW_MAX_TARGET_SIZE && height <= RHW_MAX_TARGET_SIZE);
}

static const char *decode(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    if (size == 0) {
        return "the file is empty";
    }
    const char *refusal = NULL;
    const struct reader *const reader = reader_of(bytes, size, &refusal);
    if (reader->decode == NULL) {
        return refusal;
    }
    const char *const problem = fits(reader, bytes, size) ? reader->decode(bytes, size, image)
                                                          : "width and height must be 1 to 16384";
    if (problem == NULL) {
        scene_image_find_alpha(image);
    }
    return problem;
}

size_t scene_image_texels(const void *bytes, size_t size)
{
    uint32_t width = 0, height = 0;
    const char *refusal = NULL;
    const struct reader *const reader = reader_of(bytes, size, &refusal);
    if (reader->measure == NULL) {
        return reader->decode != NULL ? SIZE_MAX : 0;
    }
    return reader->measure(bytes, size, &width, &height) ? (size_t)width * height : 0;
}

bool scene_image_has_memory(const void *bytes, size_t size)
{
    // Decoders take up to 32 bytes for a texel, with their own buffers. DEFLATE, which packs most tightly, makes 1032
    // bytes of one, and of each eight texels.
    enum { TEXEL = 32, PACKED = 8 * 1032 };
    const uint64_t largest = (uint64_t)RHW_MAX_TARGET_SIZE * RHW_MAX_TARGET_SIZE,
                   by_size = (uint64_t)size * PACKED;
    const uint64_t texels = scene_image_texels(bytes, size);
    uint64_t needed = texels > 0 && texels < largest ? texels : largest;
    needed = TEXEL * (needed < by_size ? needed : by_size);
    void *volatile memory =
        needed <= SIZE_MAX ? malloc((size_t)needed) : NULL; // a compiler may leave out other tries
    free(memory);
    return memory != NULL;
}

// Decode an image, and reduce it while it is read or when it is there.
static const char *decode_within(const unsigned char *bytes, size_t size, uint32_t side, bool is_color,
                                 struct scene_image *image)
{
    uint32_t width, height;
    if (scene_image_is_png_of_rows(bytes, size) && scene_png_size(bytes, size, &width, &height) &&
        width <= RHW_MAX_TARGET_SIZE && height <= RHW_MAX_TARGET_SIZE &&
        scene_reduce_needed(width, height, side)) {
        const char *const problem = scene_image_decode_png_reduced(bytes, size, side, is_color, image);
        if (problem == NULL) {
            scene_image_find_alpha(image);
        }
        return problem;
    }
    const char *const problem = decode(bytes, size, image);
    if (problem != NULL || !scene_reduce_needed(image->width, image->height, side)) {
        return problem;
    }
    if (!scene_reduce_image(image, side, is_color)) {
        free(image->texels);
        return "outofmem";
    }
    return NULL;
}

const char *scene_image_decode_within(const void *bytes, size_t size, uint32_t side, bool is_color,
                                      struct scene_image *image)
{
    // Most libraries take a picture that there is no memory for to be damaged. Every allocator tells by errno.
    errno = 0;
    const char *const problem = decode_within(bytes, size, side, is_color, image);
    return problem != NULL && errno == ENOMEM ? "outofmem" : problem;
}

const char *scene_image_decode(const void *bytes, size_t size, struct scene_image *image)
{
    return scene_image_decode_within(bytes, size, 0, false, image);
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
