// SPDX-License-Identifier: MIT
// Images of 16 bits become images of 8, rounded to nearest, where they are computed with.
#include "rgba8.h"

#include <stdlib.h>

bool scene_import_make_rgba8(struct scene_import *import, struct scene_image *image)
{
    if (image->type != SCENE_IMAGE_RGBA16) {
        return image->type == SCENE_IMAGE_RGBA8;
    }
    const size_t values = (size_t)image->width * image->height * 4;
    const uint16_t *from = image->texels;
    uint8_t *to = scene_import_allocate(import, values, 1);
    for (size_t i = 0; i < values; i++) {
        to[i] = (uint8_t)((from[i] * 255u + 32767u) / 65535u);
    }
    free(image->texels);
    image->texels = to;
    image->size = values;
    image->type = SCENE_IMAGE_RGBA8;
    return true;
}
