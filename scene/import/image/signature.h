// SPDX-License-Identifier: MIT
// The format of an image file, by how it begins. What it is called says nothing.
#ifndef SCENE_IMAGE_SIGNATURE_H
#define SCENE_IMAGE_SIGNATURE_H

#include <stddef.h>

enum scene_image_format {
    SCENE_FORMAT_OTHER, ///< what stb_image reads, or nobody
    SCENE_FORMAT_PNG,
    SCENE_FORMAT_JPEG,
    SCENE_FORMAT_WEBP,
    SCENE_FORMAT_KTX2,
    SCENE_FORMAT_DDS,
    SCENE_FORMAT_TIFF,
    SCENE_FORMAT_EXR,
    SCENE_FORMAT_GIF,
    SCENE_FORMAT_AVIF,
    SCENE_FORMAT_SGI,
    SCENE_FORMAT_PNM,
    SCENE_FORMAT_UNREAD, ///< a format that is known and not read
};

/// Return the format of an image. Of one that is not read, set its refusal (static storage).
enum scene_image_format scene_image_format(const unsigned char *bytes, size_t size, const char **refusal);

#endif
