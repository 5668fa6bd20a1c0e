// SPDX-License-Identifier: MIT
#include "signature.h"

#include <stdbool.h>
#include <string.h>

#define SIGNATURE(place, text) place, sizeof(text) - 1, text

static const struct signature {
    size_t place, length;
    const char *text;
    enum scene_image_format format;
    const char *refusal;
} signatures[] = {
    {SIGNATURE(0, "\x89PNG\r\n\x1a\n"), SCENE_FORMAT_PNG, NULL},
    {SIGNATURE(0, "\xff\xd8"), SCENE_FORMAT_JPEG, NULL},
    {SIGNATURE(8, "WEBP"), SCENE_FORMAT_WEBP, NULL},
    {SIGNATURE(0, "\xabKTX 20\xbb\r\n\x1a\n"), SCENE_FORMAT_KTX2, NULL},
    {SIGNATURE(0, "DDS "), SCENE_FORMAT_DDS, NULL},
    {SIGNATURE(0, "II*\0"), SCENE_FORMAT_TIFF, NULL},
    {SIGNATURE(0, "MM\0*"), SCENE_FORMAT_TIFF, NULL},
    {SIGNATURE(0, "II+\0"), SCENE_FORMAT_TIFF, NULL},
    {SIGNATURE(0, "MM\0+"), SCENE_FORMAT_TIFF, NULL},
    {SIGNATURE(0, "v/1\x01"), SCENE_FORMAT_EXR, NULL},
    {SIGNATURE(0, "GIF8"), SCENE_FORMAT_GIF, NULL},
    {SIGNATURE(4, "ftypavif"), SCENE_FORMAT_AVIF, NULL},
    {SIGNATURE(4, "ftypavis"), SCENE_FORMAT_AVIF, NULL},
    {SIGNATURE(4, "ftyphei"), SCENE_FORMAT_UNREAD, "an HEIC image, which is not read"},
    {SIGNATURE(4, "ftypmif1"), SCENE_FORMAT_UNREAD, "an HEIF image, which is not read"},
    {SIGNATURE(0, "\xff\x0a"), SCENE_FORMAT_UNREAD, "a JPEG XL image, which is not read"},
    {SIGNATURE(4, "JXL "), SCENE_FORMAT_UNREAD, "a JPEG XL image, which is not read"},
    {SIGNATURE(4, "jP  "), SCENE_FORMAT_UNREAD, "a JPEG 2000 image, which is not read"},
    {SIGNATURE(0, "\xff\x4f\xff\x51"), SCENE_FORMAT_UNREAD, "a JPEG 2000 image, which is not read"},
    {SIGNATURE(0, "\xabKTX 11\xbb"), SCENE_FORMAT_UNREAD, "a KTX 1 texture, which is not read"},
    {SIGNATURE(0, "VTF\0"), SCENE_FORMAT_UNREAD, "a VTF texture, which is not read"},
    {SIGNATURE(0, "PVR\x03"), SCENE_FORMAT_UNREAD, "a PVR texture, which is not read"},
    {SIGNATURE(0, "<svg"), SCENE_FORMAT_UNREAD, "an SVG drawing, which is not read"},
    {SIGNATURE(0, "\x01\xda"), SCENE_FORMAT_SGI, NULL},
    {SIGNATURE(0, "P5"), SCENE_FORMAT_PNM, NULL},
    {SIGNATURE(0, "P6"), SCENE_FORMAT_PNM, NULL},
    {SIGNATURE(0, "\x53\x80\xf6\x34"), SCENE_FORMAT_UNREAD, "a PIC image, which is not read"},
};

enum scene_image_format scene_image_format(const unsigned char *bytes, size_t size, const char **refusal)
{
    for (size_t i = 0; i < sizeof signatures / sizeof signatures[0]; i++) {
        const struct signature *const signature = &signatures[i];
        const bool fits = size >= signature->place + signature->length &&
                          memcmp(bytes + signature->place, signature->text, signature->length) == 0;
        const bool is_riff =
            signature->format != SCENE_FORMAT_WEBP || (fits && memcmp(bytes, "RIFF", 4) == 0);
        if (fits && is_riff) {
            *refusal = signature->refusal;
            return signature->format;
        }
    }
    return SCENE_FORMAT_OTHER;
}
