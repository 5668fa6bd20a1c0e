// SPDX-License-Identifier: MIT
// Roughness and metallic of formats that keep them in images of their own become one image, as glTF has it.
#include "channels.h"

#include <string.h>

#include "import/image/read.h"
#include "rgba8.h"

// Return one of the two images. Return NULL if there is none that can be read.
static struct scene_image *find_image(struct scene_import *import, int32_t index)
{
    struct scene_image *image = index < 0 ? NULL : &import->model.images[index];
    return image != NULL && !image->missing ? image : NULL;
}

// Return the value of a channel at the nearest texel. Return the full value if the image is missing.
static uint8_t value_at(const struct scene_image *image, int channel, const struct scene_image *grid,
                        uint32_t x, uint32_t y)
{
    if (image == NULL) {
        return UINT8_MAX;
    }
    const size_t column = (size_t)x * image->width / grid->width,
                 row = (size_t)y * image->height / grid->height;
    return scene_import_value8(image, (row * image->width + column) * 4 + (size_t)channel);
}

bool scene_import_join_channels(struct scene_import *import, struct scene_image *image,
                                const struct scene_import_channels *channels)
{
    const struct scene_image *roughness = find_image(import, channels->roughness);
    const struct scene_image *metallic = find_image(import, channels->metallic);
    const struct scene_image *grid = roughness != NULL ? roughness : metallic;
    if (grid == NULL) {
        return false;
    }
    image->type = SCENE_IMAGE_RGBA8;
    image->width = grid->width;
    image->height = grid->height;
    image->size = (size_t)grid->width * grid->height * 4;
    uint8_t *texels = scene_import_allocate(import, image->size, 1);
    image->texels = texels;
    for (uint32_t y = 0; y < grid->height; y++) {
        for (uint32_t x = 0; x < grid->width; x++, texels += 4) {
            texels[0] = UINT8_MAX;
            texels[1] = value_at(roughness, channels->roughness_channel, grid, x, y);
            texels[2] = value_at(metallic, channels->metallic_channel, grid, x, y);
            texels[3] = UINT8_MAX;
        }
    }
    return true;
}
