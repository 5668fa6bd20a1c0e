// SPDX-License-Identifier: MIT
// A texture of the format decodes the texels, and a blit converts them where the format is not one that images have.
// Numbers are those of Vulkan 1.3, VkFormat. Images hold 0..1, or light: signed numbers of −1..1 become 0..1, which is
// how an unsigned normal map has them.
#include "vulkan_format.h"

#include <stdlib.h>
#include <string.h>

#include "rhw/rhw.h"

enum {
    R8G8B8_UNORM = 23, // the library has no format of three channels
    R8G8B8_SRGB = 29,
    BC1_RGB_UNORM = 131, // formats from here on stand in the library's order
    ASTC_12X12_SRGB = 184
};

static enum rhw_format format_of(uint32_t format)
{
    if (format >= BC1_RGB_UNORM && format <= ASTC_12X12_SRGB) {
        return (enum rhw_format)(RHW_FORMAT_BC1_RGB_UNORM + (int)(format - BC1_RGB_UNORM));
    }
    switch (format) {
    case 9: return RHW_FORMAT_R8_UNORM;
    case 15: return RHW_FORMAT_R8_SRGB;
    case 16: return RHW_FORMAT_RG8_UNORM;
    case 22: return RHW_FORMAT_RG8_SRGB;
    case R8G8B8_UNORM:
    case 37: return RHW_FORMAT_RGBA8_UNORM;
    case R8G8B8_SRGB:
    case 43: return RHW_FORMAT_RGBA8_SRGB;
    case 44: return RHW_FORMAT_BGRA8_UNORM;
    case 50: return RHW_FORMAT_BGRA8_SRGB;
    case 70: return RHW_FORMAT_R16_UNORM;
    case 76: return RHW_FORMAT_R16_FLOAT;
    case 77: return RHW_FORMAT_RG16_UNORM;
    case 83: return RHW_FORMAT_RG16_FLOAT;
    case 91: return RHW_FORMAT_RGBA16_UNORM;
    case 97: return RHW_FORMAT_RGBA16_FLOAT;
    case 100: return RHW_FORMAT_R32_FLOAT;
    case 103: return RHW_FORMAT_RG32_FLOAT;
    case 109: return RHW_FORMAT_RGBA32_FLOAT;
    case 122: return RHW_FORMAT_RG11B10_FLOAT;
    case 123: return RHW_FORMAT_RGB9E5_FLOAT;
    default: return RHW_FORMAT_NONE;
    }
}

static bool lacks_alpha(uint32_t format)
{
    return format == R8G8B8_UNORM || format == R8G8B8_SRGB;
}

_Static_assert(ASTC_12X12_SRGB - BC1_RGB_UNORM == RHW_FORMAT_ASTC_12X12_SRGB - RHW_FORMAT_BC1_RGB_UNORM,
               "both count the same formats");

// Return the format of an image that a texture becomes. It has bytes as they are or as blocks decode to, 16 bits where
// bytes would round, or floats for light.
static enum rhw_format image_format(enum rhw_format format)
{
    switch (format) {
    case RHW_FORMAT_R8_SRGB:
    case RHW_FORMAT_RG8_SRGB:
    case RHW_FORMAT_BGRA8_SRGB: return RHW_FORMAT_RGBA8_SRGB;
    case RHW_FORMAT_R8_UNORM:
    case RHW_FORMAT_RG8_UNORM:
    case RHW_FORMAT_BGRA8_UNORM: return RHW_FORMAT_RGBA8_UNORM;
    case RHW_FORMAT_R16_UNORM:
    case RHW_FORMAT_RG16_UNORM:
    case RHW_FORMAT_RGBA16_UNORM:
    case RHW_FORMAT_BC4_UNORM:
    case RHW_FORMAT_BC5_UNORM:
    case RHW_FORMAT_EAC_R11_UNORM:
    case RHW_FORMAT_EAC_RG11_UNORM: return RHW_FORMAT_RGBA16_UNORM;
    case RHW_FORMAT_R16_FLOAT:
    case RHW_FORMAT_RG16_FLOAT:
    case RHW_FORMAT_RGBA16_FLOAT:
    case RHW_FORMAT_R32_FLOAT:
    case RHW_FORMAT_RG32_FLOAT:
    case RHW_FORMAT_RGBA32_FLOAT:
    case RHW_FORMAT_RG11B10_FLOAT:
    case RHW_FORMAT_RGB9E5_FLOAT:
    case RHW_FORMAT_BC6H_UFLOAT:
    case RHW_FORMAT_BC6H_SFLOAT:
    case RHW_FORMAT_BC4_SNORM:
    case RHW_FORMAT_BC5_SNORM:
    case RHW_FORMAT_EAC_R11_SNORM:
    case RHW_FORMAT_EAC_RG11_SNORM: return RHW_FORMAT_RGBA32_FLOAT;
    case RHW_FORMAT_NONE: return RHW_FORMAT_NONE;
    default: return format; // read as RGBA8
    }
}

size_t scene_vulkan_size(uint32_t format, uint32_t width, uint32_t height)
{
    const enum rhw_format known = format_of(format);
    if (image_format(known) == RHW_FORMAT_NONE) {
        return 0;
    }
    const uint32_t across = (uint32_t)rhw_format_block_width(known),
                   down = (uint32_t)rhw_format_block_height(known);
    const size_t bytes = lacks_alpha(format) ? 3 : rhw_format_block_bytes(known);
    return (size_t)((width + across - 1) / across) * ((height + down - 1) / down) * bytes;
}

static void widen_rgb(const uint8_t *from, struct scene_image *image)
{
    uint8_t *to = image->texels;
    for (size_t i = 0; i < (size_t)image->width * image->height; i++) {
        memcpy(to + 4 * i, from + 3 * i, 3);
        to[4 * i + 3] = UINT8_MAX;
    }
}

static bool is_signed(enum rhw_format format)
{
    return format == RHW_FORMAT_BC4_SNORM || format == RHW_FORMAT_BC5_SNORM ||
           format == RHW_FORMAT_EAC_R11_SNORM || format == RHW_FORMAT_EAC_RG11_SNORM;
}

// Move floats of −1..1 to 16 bits of 0..1, in place. Alpha is 1 already.
static void make_unsigned(struct scene_image *image)
{
    const size_t count = (size_t)image->width * image->height * 4;
    uint8_t *const bytes = image->texels; // a number is written where all before it were read
    for (size_t i = 0; i < count; i++) {
        float number;
        memcpy(&number, bytes + i * sizeof number, sizeof number);
        const uint16_t code = (uint16_t)((i % 4 == 3 ? number : number * 0.5f + 0.5f) * 65535.0f + 0.5f);
        memcpy(bytes + i * sizeof code, &code, sizeof code);
    }
    image->type = SCENE_IMAGE_RGBA16;
    image->size = count * sizeof(uint16_t);
}

static enum rhw_result make_texture(rhw_context *context, enum rhw_format format,
                                    const struct scene_image *image, rhw_texture *texture)
{
    const struct rhw_texture_def def = {
        .format = format, .width = (int)image->width, .height = (int)image->height};
    return rhw_texture_create(context, &def, texture);
}

static enum rhw_result convert(rhw_context *context, enum rhw_format format, const void *bytes,
                               struct scene_image *image)
{
    rhw_texture stored, made;
    enum rhw_result result = make_texture(context, format, image, &stored);
    if (result == RHW_OK) {
        result = rhw_texture_write(context, stored, 0, bytes, 0);
    }
    const enum rhw_format wanted = image_format(format);
    if (result != RHW_OK || wanted == format) {
        return result != RHW_OK ? result : rhw_texture_read(context, stored, 0, image->texels, 0);
    }
    result = make_texture(context, wanted, image, &made);
    if (result == RHW_OK) {
        result = rhw_texture_blit(context, stored, NULL, made, NULL, RHW_FILTER_NEAREST);
    }
    return result != RHW_OK ? result : rhw_texture_read(context, made, 0, image->texels, 0);
}

const char *scene_vulkan_decode(uint32_t format, const void *bytes, struct scene_image *image)
{
    const enum rhw_format known = format_of(format), wanted = image_format(known);
    image->type = wanted == RHW_FORMAT_RGBA16_UNORM   ? SCENE_IMAGE_RGBA16
                  : wanted == RHW_FORMAT_RGBA32_FLOAT ? SCENE_IMAGE_RGBA32F
                                                      : SCENE_IMAGE_RGBA8;
    const size_t texel = image->type == SCENE_IMAGE_RGBA8 ? 4 : image->type == SCENE_IMAGE_RGBA16 ? 8 : 16;
    image->size = texel * image->width * image->height;
    image->texels = malloc(image->size);
    if (image->texels == NULL) {
        return "outofmem";
    }
    enum rhw_result result = RHW_OK;
    if (lacks_alpha(format)) {
        widen_rgb(bytes, image);
    } else {
        const struct rhw_context_def def = {.threads = 1}; // images are decoded side by side
        rhw_context *context = NULL;
        result = rhw_context_create(&def, &context);
        if (result == RHW_OK) {
            result = convert(context, known, bytes, image);
            rhw_context_destroy(context);
        }
    }
    if (result != RHW_OK) {
        free(image->texels);
        image->texels = NULL;
        return "outofmem";
    }
    if (is_signed(known)) {
        make_unsigned(image);
    }
    return NULL;
}
