// SPDX-License-Identifier: MIT
// Grey and RGB samples of 8 and 16 bits and of floats are read as they are. libtiff's own conversion to RGBA8, which
// multiplies colours by alpha and has no more than 8 bits, reads what else there is: palettes, CMYK, YCbCr, few bits.
#include "tiff.h"

#include <stdlib.h>
#include <string.h>
#include <tiffio.h>

enum { MOST_SAMPLES = 32 };

// The file in memory.
struct source {
    const unsigned char *bytes;
    tmsize_t size, at;
};

static tmsize_t read_source(thandle_t handle, void *buffer, tmsize_t count)
{
    struct source *const source = handle;
    const tmsize_t left = source->at < source->size ? source->size - source->at : 0;
    const tmsize_t got = count < left ? count : left;
    if (got > 0) {
        memcpy(buffer, source->bytes + source->at, (size_t)got);
        source->at += got;
    }
    return got;
}

static tmsize_t write_nothing(thandle_t handle, void *buffer, tmsize_t count)
{
    (void)handle, (void)buffer, (void)count;
    return 0;
}

static toff_t seek_source(thandle_t handle, toff_t offset, int whence)
{
    struct source *const source = handle;
    const toff_t from = whence == SEEK_SET ? 0 : (toff_t)(whence == SEEK_CUR ? source->at : source->size);
    const toff_t place = from + offset; // an offset backwards is modulo 2^64
    source->at = place < (toff_t)source->size ? (tmsize_t)place : source->size;
    return place;
}

static int close_nothing(thandle_t handle)
{
    (void)handle;
    return 0;
}

static toff_t size_of_source(thandle_t handle)
{
    const struct source *const source = handle;
    return (toff_t)source->size;
}

static int ignore_message(TIFF *tiff, void *user, const char *module, const char *format, va_list arguments)
{
    (void)tiff, (void)user, (void)module, (void)format, (void)arguments;
    return 1;
}

static TIFF *open_tiff(struct source *source)
{
    TIFFOpenOptions *const options = TIFFOpenOptionsAlloc();
    if (options == NULL) {
        return NULL;
    }
    // What a picture of the largest size takes at once is more than what a row or a tile of it takes.
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, (tmsize_t)1 << 30);
    TIFFOpenOptionsSetErrorHandlerExtR(options, ignore_message, NULL);
    TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_message, NULL);
    // The file is not mapped, so that libtiff reads no further than it is told.
    TIFF *const tiff = TIFFClientOpenExt("texture", "rm", source, read_source, write_nothing, seek_source,
                                         close_nothing, size_of_source, NULL, NULL, options);
    TIFFOpenOptionsFree(options);
    return tiff;
}

bool scene_tiff_size(const unsigned char *bytes, size_t size, uint32_t *width, uint32_t *height)
{
    struct source source = {bytes, (tmsize_t)size, 0};
    TIFF *const tiff = open_tiff(&source);
    *width = *height = 0;
    if (tiff == NULL) {
        return false;
    }
    const bool known = TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, width) != 0 &&
                       TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, height) != 0;
    TIFFClose(tiff);
    return known;
}

// What the samples of a picture are.
struct picture {
    TIFF *tiff;
    uint32_t width, height;
    uint16_t bits, samples, sample_format, photometric, orientation;
    bool is_planar;     // each sample of the pixels has rows of its own
    bool is_multiplied; // colours are multiplied by alpha
    struct scene_image *image;
};

static bool read_tags(struct picture *picture)
{
    TIFF *const tiff = picture->tiff;
    uint16_t planar = PLANARCONFIG_CONTIG, extra_count = 0, *extras = NULL;
    if (!TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &picture->width) ||
        !TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &picture->height) ||
        !TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &picture->photometric)) {
        return false;
    }
    TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &picture->bits);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &picture->samples);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &picture->sample_format);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &picture->orientation);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planar);
    TIFFGetFieldDefaulted(tiff, TIFFTAG_EXTRASAMPLES, &extra_count, &extras);
    picture->is_planar = planar == PLANARCONFIG_SEPARATE && picture->samples > 1;
    picture->is_multiplied = extra_count > 0 && extras[0] == EXTRASAMPLE_ASSOCALPHA;
    return true;
}

static bool is_grey(const struct picture *picture)
{
    return picture->photometric == PHOTOMETRIC_MINISBLACK || picture->photometric == PHOTOMETRIC_MINISWHITE;
}

// Return true if the samples can be taken as they are.
static bool is_direct(const struct picture *picture)
{
    const bool is_float = picture->sample_format == SAMPLEFORMAT_IEEEFP;
    const bool is_word = picture->sample_format == SAMPLEFORMAT_UINT;
    return (is_grey(picture) || (picture->photometric == PHOTOMETRIC_RGB && picture->samples >= 3)) &&
           picture->samples >= 1 && picture->samples <= MOST_SAMPLES &&
           ((is_word && (picture->bits == 8 || picture->bits == 16)) ||
            (is_float && (picture->bits == 16 || picture->bits == 32)));
}

// Samples ------------------------------------------------------------------------------------------------

// Return a float of 16 bits (IEEE 754) as one of 32.
static float widen_half(uint16_t half)
{
    const uint32_t sign = (uint32_t)(half & 0x8000) << 16, exponent = half >> 10 & 31, fraction = half & 1023;
    float value = (float)fraction * 0x1p-24f; // below 2^-14
    if (exponent > 0) {
        const uint32_t code = exponent == 31 ? 255 : exponent + 112;
        const uint32_t bits = code << 23 | fraction << 13;
        memcpy(&value, &bits, sizeof value);
    }
    return sign != 0 ? -value : value;
}

// Write a sample into a channel of a texel.
static void put_sample(const struct picture *picture, const uint8_t *sample, size_t texel, int channel)
{
    uint16_t word;
    float number;
    const size_t place = 4 * texel + (size_t)channel;
    const bool inverted = picture->photometric == PHOTOMETRIC_MINISWHITE && channel < 3;
    switch (picture->image->type) {
    case SCENE_IMAGE_RGBA8:
        ((uint8_t *)picture->image->texels)[place] = (uint8_t)(inverted ? ~*sample : *sample);
        break;
    case SCENE_IMAGE_RGBA16:
        memcpy(&word, sample, sizeof word);
        ((uint16_t *)picture->image->texels)[place] = (uint16_t)(inverted ? ~word : word);
        break;
    case SCENE_IMAGE_RGBA32F:
        if (picture->bits == 16) {
            memcpy(&word, sample, sizeof word);
            number = widen_half(word);
        } else {
            memcpy(&number, sample, sizeof number);
        }
        ((float *)picture->image->texels)[place] = inverted ? 1 - number : number;
        break;
    }
}

static void put_opaque(const struct scene_image *image, size_t texel)
{
    switch (image->type) {
    case SCENE_IMAGE_RGBA8: ((uint8_t *)image->texels)[4 * texel + 3] = UINT8_MAX; break;
    case SCENE_IMAGE_RGBA16: ((uint16_t *)image->texels)[4 * texel + 3] = UINT16_MAX; break;
    case SCENE_IMAGE_RGBA32F: ((float *)image->texels)[4 * texel + 3] = 1; break;
    }
}

// Write a sample of a pixel into the channels that it is for. Grey is for three of them. Samples behind alpha have no
// place in a texture. Alpha comes behind the first sample, if it comes.
static void put(const struct picture *picture, const uint8_t *sample, size_t texel, uint32_t number)
{
    const uint32_t colors = is_grey(picture) ? 1 : 3;
    if (number > colors) {
        return;
    }
    if (number == colors) {
        put_sample(picture, sample, texel, 3);
        return;
    }
    if (number == 0) {
        put_opaque(picture->image, texel);
    }
    put_sample(picture, sample, texel, (int)number);
    for (int c = 1; c < 3 && colors == 1; c++) {
        put_sample(picture, sample, texel, c);
    }
}

// Write `count` pixels that stand side by side. `plane` is the sample that they have, if they are planar.
static void put_pixels(const struct picture *picture, const uint8_t *bytes, uint32_t count, size_t texel,
                       uint32_t plane)
{
    const size_t size = picture->bits / 8;
    for (uint32_t x = 0; x < count; x++) {
        if (picture->is_planar) {
            put(picture, bytes + x * size, texel + x, plane);
            continue;
        }
        for (uint32_t s = 0; s < picture->samples; s++) {
            put(picture, bytes + (x * (size_t)picture->samples + s) * size, texel + x, s);
        }
    }
}

static bool read_rows(const struct picture *picture, uint32_t plane)
{
    const tmsize_t size = TIFFScanlineSize(picture->tiff);
    const uint32_t samples = picture->is_planar ? 1 : picture->samples;
    if (size < (tmsize_t)((size_t)picture->width * samples * (picture->bits / 8))) {
        return false;
    }
    uint8_t *const row = malloc((size_t)size);
    bool fine = row != NULL;
    for (uint32_t y = 0; y < picture->height && fine; y++) {
        fine = TIFFReadScanline(picture->tiff, row, y, (uint16_t)plane) == 1;
        if (fine) {
            put_pixels(picture, row, picture->width, (size_t)y * picture->width, plane);
        }
    }
    free(row);
    return fine;
}

static bool read_tiles(const struct picture *picture, uint32_t plane)
{
    uint32_t across = 0, down = 0;
    const tmsize_t size = TIFFTileSize(picture->tiff), row_size = TIFFTileRowSize(picture->tiff);
    TIFFGetField(picture->tiff, TIFFTAG_TILEWIDTH, &across);
    TIFFGetField(picture->tiff, TIFFTAG_TILELENGTH, &down);
    const uint32_t samples = picture->is_planar ? 1 : picture->samples;
    if (across < 1 || down < 1 || across > RHW_MAX_TARGET_SIZE || down > RHW_MAX_TARGET_SIZE ||
        row_size < (tmsize_t)((size_t)across * samples * (picture->bits / 8)) ||
        size < row_size * (tmsize_t)down) {
        return false;
    }
    uint8_t *const tile = malloc((size_t)size);
    bool fine = tile != NULL;
    for (uint32_t y = 0; y < picture->height && fine; y += down) {
        for (uint32_t x = 0; x < picture->width && fine; x += across) {
            fine = TIFFReadTile(picture->tiff, tile, x, y, 0, (uint16_t)plane) > 0;
            const uint32_t columns = picture->width - x < across ? picture->width - x : across;
            for (uint32_t row = 0; row < down && y + row < picture->height && fine; row++) {
                put_pixels(picture, tile + row * (size_t)row_size, columns,
                           (size_t)(y + row) * picture->width + x, plane);
            }
        }
    }
    free(tile);
    return fine;
}

// Pictures -----------------------------------------------------------------------------------------------

// Divide colours by the alpha that they were multiplied with.
static void unmultiply(struct scene_image *image)
{
    const size_t count = (size_t)image->width * image->height;
    for (size_t i = 0; i < 4 * count; i++) {
        const size_t alpha = i | 3;
        if (i == alpha) {
            continue;
        }
        if (image->type == SCENE_IMAGE_RGBA8) {
            uint8_t *const texels = image->texels;
            const uint32_t most = texels[alpha], value = texels[i] < most ? texels[i] : most;
            texels[i] = (uint8_t)(most > 0 ? (value * UINT8_MAX + most / 2) / most : 0);
        } else if (image->type == SCENE_IMAGE_RGBA16) {
            uint16_t *const texels = image->texels;
            const uint32_t most = texels[alpha], value = texels[i] < most ? texels[i] : most;
            texels[i] = (uint16_t)(most > 0 ? (value * UINT16_MAX + most / 2) / most : 0);
        } else {
            float *const texels = image->texels;
            texels[i] = texels[alpha] > 0 ? texels[i] / texels[alpha] : texels[i];
        }
    }
}

static const char damaged[] = "damaged TIFF";

static const char *read_direct(const struct picture *picture)
{
    const bool is_tiled = TIFFIsTiled(picture->tiff) != 0;
    const uint32_t planes = picture->is_planar ? picture->samples : 1;
    for (uint32_t plane = 0; plane < planes; plane++) {
        if (!(is_tiled ? read_tiles(picture, plane) : read_rows(picture, plane))) {
            return damaged;
        }
    }
    if (picture->is_multiplied) {
        unmultiply(picture->image);
    }
    return NULL;
}

// Have libtiff convert the picture. It gives words of A, B, G and R from the highest byte on.
static const char *read_converted(const struct picture *picture)
{
    char reason[1024];
    uint32_t *const words = picture->image->texels;
    if (!TIFFRGBAImageOK(picture->tiff, reason)) {
        return "a TIFF file of samples that are not read";
    }
    if (!TIFFReadRGBAImageOriented(picture->tiff, picture->width, picture->height, words, ORIENTATION_TOPLEFT,
                                   1)) {
        return damaged;
    }
    for (size_t i = 0; i < (size_t)picture->width * picture->height; i++) {
        const uint32_t word = words[i];
        const uint8_t texel[4] = {(uint8_t)TIFFGetR(word), (uint8_t)TIFFGetG(word), (uint8_t)TIFFGetB(word),
                                  (uint8_t)TIFFGetA(word)};
        memcpy(&words[i], texel, sizeof texel);
    }
    unmultiply(picture->image);
    return NULL;
}

static void swap_texels(struct scene_image *image, size_t a, size_t b)
{
    const size_t texel = image->size / ((size_t)image->width * image->height);
    uint8_t held[16], *const texels = image->texels;
    memcpy(held, texels + a * texel, texel);
    memcpy(texels + a * texel, texels + b * texel, texel);
    memcpy(texels + b * texel, held, texel);
}

// Turn a picture whose rows were stored from the bottom or from the right. One that was stored by columns stays as it
// is.
static void turn(struct scene_image *image, uint16_t orientation)
{
    const bool from_right = orientation == ORIENTATION_TOPRIGHT || orientation == ORIENTATION_BOTRIGHT,
               from_bottom = orientation == ORIENTATION_BOTLEFT || orientation == ORIENTATION_BOTRIGHT;
    const size_t width = image->width;
    for (size_t y = 0; y < image->height && from_right; y++) {
        for (size_t x = 0; x < width / 2; x++) {
            swap_texels(image, y * width + x, y * width + width - 1 - x);
        }
    }
    for (size_t y = 0; y < image->height / 2 && from_bottom; y++) {
        for (size_t x = 0; x < width; x++) {
            swap_texels(image, y * width + x, (image->height - 1 - y) * width + x);
        }
    }
}

static const char *read_picture(struct picture *picture)
{
    if (!read_tags(picture)) {
        return damaged;
    }
    const bool direct = is_direct(picture);
    struct scene_image *const image = picture->image;
    image->width = picture->width;
    image->height = picture->height;
    image->type = !direct                                         ? SCENE_IMAGE_RGBA8
                  : picture->sample_format == SAMPLEFORMAT_IEEEFP ? SCENE_IMAGE_RGBA32F
                  : picture->bits == 16                           ? SCENE_IMAGE_RGBA16
                                                                  : SCENE_IMAGE_RGBA8;
    const size_t texel = image->type == SCENE_IMAGE_RGBA8 ? 4 : image->type == SCENE_IMAGE_RGBA16 ? 8 : 16;
    image->size = (size_t)image->width * image->height * texel;
    image->texels = calloc(image->size, 1); // what a damaged file does not fill takes no memory
    if (image->texels == NULL) {
        return "outofmem";
    }
    const char *const problem = direct ? read_direct(picture) : read_converted(picture);
    if (problem != NULL) {
        free(image->texels);
    } else if (direct) {
        turn(image, picture->orientation);
    }
    return problem;
}

const char *scene_image_decode_tiff(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    struct source source = {bytes, (tmsize_t)size, 0};
    struct scene_image made = *image;
    struct picture picture = {.tiff = open_tiff(&source), .image = &made};
    if (picture.tiff == NULL) {
        return damaged;
    }
    const char *const problem = read_picture(&picture);
    TIFFClose(picture.tiff);
    if (problem == NULL) {
        *image = made;
    }
    return problem;
}
