// SPDX-License-Identifier: MIT
// libavif is opened when there is an AVIF, because it brings every encoder and decoder of AV1 that Debian has. What it
// is asked for is of the version that it was compiled with here, which SCENE_AVIF_LIBRARY names.
#include "avif.h"

#include <avif/avif.h>
#include <stdlib.h>
#include <string.h>

#include "shared_library.h"

// The functions of the library that are used.
struct library {
    avifDecoder *(*decoderCreate)(void);
    void (*decoderDestroy)(avifDecoder *decoder);
    avifResult (*decoderSetIOMemory)(avifDecoder *decoder, const uint8_t *data, size_t size);
    avifResult (*decoderParse)(avifDecoder *decoder);
    avifResult (*decoderNextImage)(avifDecoder *decoder);
    void (*rgbImageSetDefaults)(avifRGBImage *rgb, const avifImage *image);
    avifResult (*imageYUVToRGB)(const avifImage *image, avifRGBImage *rgb);
    const char *(*codecName)(avifCodecChoice choice, avifCodecFlags flags);
};

static bool open_library(struct library *library)
{
    static const char *const names[] = {
        "avifDecoderCreate",    "avifDecoderDestroy",      "avifDecoderSetIOMemory", "avifDecoderParse",
        "avifDecoderNextImage", "avifRGBImageSetDefaults", "avifImageYUVToRGB",      "avifCodecName",
    };
    enum { FUNCTIONS = sizeof names / sizeof names[0] };
    void (*functions[FUNCTIONS])(void);
    void *const handle = system_shared_library_open(SCENE_AVIF_LIBRARY);
    bool found = handle != NULL;
    for (int i = 0; i < FUNCTIONS && found; i++) {
        found = system_shared_library_find(handle, names[i], &functions[i]);
    }
    _Static_assert(sizeof functions == sizeof *library, "every function has its name");
    if (found) {
        memcpy(library, functions, sizeof functions);
    }
    return found;
}

static const char damaged[] = "damaged AVIF";

static const char *convert(const struct library *library, const avifImage *picture, struct scene_image *image)
{
    const bool is_wide = picture->depth > 8;
    avifRGBImage rgb;
    image->type = is_wide ? SCENE_IMAGE_RGBA16 : SCENE_IMAGE_RGBA8;
    image->width = picture->width;
    image->height = picture->height;
    image->size = (size_t)image->width * image->height * (is_wide ? 8 : 4);
    image->texels = malloc(image->size);
    if (image->texels == NULL) {
        return "outofmem";
    }
    library->rgbImageSetDefaults(&rgb, picture);
    rgb.format = AVIF_RGB_FORMAT_RGBA;
    rgb.depth = is_wide ? 16 : 8;
    rgb.rowBytes = image->width * (is_wide ? 8 : 4);
    rgb.pixels = image->texels;
    if (library->imageYUVToRGB(picture, &rgb) != AVIF_RESULT_OK) {
        free(image->texels);
        return damaged;
    }
    return NULL;
}

static const char *decode(const struct library *library, avifDecoder *decoder, const unsigned char *bytes,
                          size_t size, struct scene_image *image)
{
    // All decoders of AV1 give the same samples. dav1d, which is taken first, writes to stderr of what is damaged.
    if (library->codecName(AVIF_CODEC_CHOICE_AOM, AVIF_CODEC_FLAG_CAN_DECODE) != NULL) {
        decoder->codecChoice = AVIF_CODEC_CHOICE_AOM;
    }
    decoder->ignoreExif = decoder->ignoreXMP = AVIF_TRUE;
    decoder->imageSizeLimit = RHW_MAX_TARGET_SIZE * RHW_MAX_TARGET_SIZE;
    decoder->imageDimensionLimit = RHW_MAX_TARGET_SIZE;
    decoder->strictFlags = AVIF_STRICT_DISABLED;
    if (library->decoderSetIOMemory(decoder, bytes, size) != AVIF_RESULT_OK) {
        return damaged;
    }
    avifResult result = library->decoderParse(decoder);
    if (result == AVIF_RESULT_OK) {
        result = library->decoderNextImage(decoder);
    }
    if (result != AVIF_RESULT_OK && strstr(decoder->diag.error, "dimensions are too large") != NULL) {
        return "width and height must be 1 to 16384";
    }
    if (result == AVIF_RESULT_OUT_OF_MEMORY) {
        return "outofmem";
    }
    if (result == AVIF_RESULT_NO_CODEC_AVAILABLE) {
        return "an AVIF image, and libavif has no decoder of AV1";
    }
    return result == AVIF_RESULT_OK ? convert(library, decoder->image, image) : damaged;
}

const char *scene_image_decode_avif(const unsigned char *bytes, size_t size, struct scene_image *image)
{
    struct library library;
    if (!open_library(&library)) {
        return "an AVIF image, and " SCENE_AVIF_LIBRARY " is not there";
    }
    avifDecoder *const decoder = library.decoderCreate();
    if (decoder == NULL) {
        return "outofmem";
    }
    struct scene_image made = *image;
    const char *const problem = decode(&library, decoder, bytes, size, &made);
    library.decoderDestroy(decoder);
    if (problem == NULL) {
        *image = made;
    }
    return problem;
}
