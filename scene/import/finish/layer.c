// SPDX-License-Identifier: MIT
// Images over images, for formats that say that a texture lies over another texture and a colour. The renderer draws
// one image.
#include "layer.h"

#include "import/image/read.h"
#include "import/builder/numbers.h"
#include "rgba8.h"

// Return the byte whose decoded value is next to `linear`.
static uint8_t encode(const float decoded[256], float linear)
{
    int low = 0, high = 255;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (decoded[middle] / 2 + decoded[middle + 1] / 2 < linear) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return (uint8_t)low;
}

// Lay a texel over a linear colour, by the texel's alpha.
static void cover(const float decoded[256], const uint8_t *texel, float color[3])
{
    const float alpha = (float)texel[3] / 255;
    for (int c = 0; c < 3; c++) {
        color[c] = decoded[texel[c]] * alpha + color[c] * (1 - alpha);
    }
}

void scene_import_lay_image(struct scene_import *import, struct scene_image *image,
                            const struct scene_import_layer *layer)
{
    struct scene_image *below = layer->image < 0 ? NULL : &import->model.images[layer->image];
    const bool lower = below != NULL && !below->missing && below->type != SCENE_IMAGE_RGBA32F;
    if (image->missing || image->type == SCENE_IMAGE_RGBA32F || !image->has_alpha) {
        return;
    }
    scene_import_make_rgba8(import, image);
    if (lower) {
        scene_import_make_rgba8(import, below);
    }
    float decoded[256];
    for (int i = 0; i < 256; i++) {
        decoded[i] = scene_import_from_srgb((float)i / 255);
    }
    uint8_t *texels = image->texels;
    for (uint32_t y = 0; y < image->height; y++) {
        for (uint32_t x = 0; x < image->width; x++) {
            uint8_t *texel = texels + ((size_t)y * image->width + x) * 4;
            float color[3] = {layer->color[0], layer->color[1], layer->color[2]};
            if (lower) {
                const size_t column = (size_t)x * below->width / image->width;
                const size_t row = (size_t)y * below->height / image->height;
                cover(decoded, (const uint8_t *)below->texels + (row * below->width + column) * 4, color);
            }
            cover(decoded, texel, color);
            for (int c = 0; c < 3; c++) {
                texel[c] = encode(decoded, color[c]);
            }
            texel[3] = UINT8_MAX;
        }
    }
    image->has_alpha = false;
}
