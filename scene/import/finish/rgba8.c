// SPDX-License-Identifier: MIT
// Images of 16 bits and of floats become images of 8, rounded to nearest, where they are computed with.
#include "rgba8.h"

#include <stdlib.h>

uint8_t scene_import_value8(const struct scene_image *image, size_t place)
{
    if (image->type == SCENE_IMAGE_RGBA8) {
        return ((const uint8_t *)image->texels)[place];
    }
    if (image->type == SCENE_IMAGE_RGBA16) {
        return (uint8_t)((((const uint16_t *)image->texels)[place] * 255u + 32767u) / 65535u);
    }
    const float value = ((const float *)image->texels)[place];
    return value >= 1 ? UINT8_MAX : value > 0 ? (uint8_t)(value * 255 + 0.5f) : 0; // NaN gives 0
}

void scene_import_set_value8(struct scene_image *image, size_t place, uint8_t value)
{
    if (image->type == SCENE_IMAGE_RGBA8) {
        ((uint8_t *)image->texels)[place] = value;
    } else if (image->type == SCENE_IMAGE_RGBA16) {
        ((uint16_t *)image->texels)[place] = (uint16_t)(value * 257);
    } else {
        ((float *)image->texels)[place] = (float)value / 255;
    }
}

void scene_import_make_rgba8(struct scene_import *import, struct scene_image *image)
{
    if (image->type == SCENE_IMAGE_RGBA8) {
        return;
    }
    const size_t values = (size_t)image->width * image->height * 4;
    uint8_t *to = scene_import_allocate(import, values, 1);
    for (size_t i = 0; i < values; i++) {
        to[i] = scene_import_value8(image, i);
    }
    free(image->texels);
    image->texels = to;
    image->size = values;
    image->type = SCENE_IMAGE_RGBA8;
}
