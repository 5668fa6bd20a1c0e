// SPDX-License-Identifier: MIT
// Storage images as shader functions reach them. A texel buffer is an image of a single row.
#include "binding.h"

#include "format/format.h"
#include "rhw/shader.h"
#include "resource/texture.h"
#include "binding/validation/validation.h"

// Return the image of a slot. Return no image where the slot has none or does not exist. Return no image to an
// operation that changes it where the slot is set for reading, or where validation finds that the program did not
// declare the effect.
static struct rhw_storage_image image_of(const struct rhw_bindings *textures, int slot,
                                         enum rhw_storage_operation operation)
{
    static const struct rhw_storage_image none;
    if (textures->site.validation) {
        rhw_validate_image(textures, slot, operation);
    }
    const struct rhw_storage_image *const image =
        (unsigned)slot < RHW_MAX_STORAGE_IMAGES ? &textures->storage->images[slot] : &none;
    const bool is_dropped = operation != RHW_STORAGE_LOAD && (textures->drops_effects || image->is_read_only);
    return is_dropped ? none : *image;
}

void rhw_image_load(const struct rhw_bindings *textures, int slot, const rhw_int *at, rhw_float texel[4])
{
    const struct rhw_storage_image image = image_of(textures, slot, RHW_STORAGE_LOAD);
    if (image.texture) {
        const struct rhw_binding binding = {.texture = image.texture};
        const rhw_int level = rhw_splat_int(image.level);
        textures->kernels->fetch(&binding, at, &level, texel);
        return;
    }
    texel[0] = texel[1] = texel[2] = rhw_splat(0);
    texel[3] = rhw_splat(1);
}

void rhw_image_store(const struct rhw_bindings *textures, int slot, const rhw_int *at, const rhw_int *mask,
                     const rhw_float texel[4])
{
    const struct rhw_storage_image image = image_of(textures, slot, RHW_STORAGE_STORE);
    if (image.texture && rhw_format_has_role(image.texture->info, RHW_ROLE_COLOR_TARGET)) {
        const rhw_int all = rhw_splat_int(-1);
        textures->kernels->image_store(&image, at, mask ? mask : &all, texel);
    }
}

// Return the number of coordinates that an image of the texture has.
static int coordinates_of(const struct rhw_texture_data *texture)
{
    const bool has_layer = texture->shape.is_array && texture->shape.kind != RHW_TEXTURE_CUBE;
    return rhw_texture_components(texture->shape.kind) + has_layer;
}

// Return the word at coordinates, of which a lane has every `stride`th number. Return NULL outside.
static uint32_t *word_at(const struct rhw_storage_image *image, const int32_t *at, int stride)
{
    const struct rhw_mip *const mip = &image->texture->mip[image->level];
    const bool has_y = image->texture->shape.kind != RHW_TEXTURE_1D;
    const bool has_slice = coordinates_of(image->texture) > 1 + has_y;
    const uint32_t x = (uint32_t)at[0], y = has_y ? (uint32_t)at[stride] : 0;
    const uint32_t slice = has_slice ? (uint32_t)at[stride * (1 + has_y)] : 0;
    const bool inside =
        x < (uint32_t)mip->width && y < (uint32_t)mip->height && slice < (uint32_t)mip->slices;
    unsigned char *const row = mip->texels + (inside ? slice * mip->slice_pitch + y * mip->row_pitch : 0);
    return inside ? (uint32_t *)(void *)row + x : NULL;
}

static bool has_atomics(const struct rhw_storage_image *image)
{
    return image->texture &&
           (image->texture->format == RHW_FORMAT_R32_UINT || image->texture->format == RHW_FORMAT_R32_SINT);
}

void rhw_image_atomic(const struct rhw_bindings *textures, int slot,
                      const struct rhw_storage_request *request, rhw_int *before)
{
    const struct rhw_storage_image image = image_of(textures, slot, request->operation);
    const rhw_int mask = request->mask ? *request->mask : rhw_splat_int(-1);
    unsigned left = has_atomics(&image) ? (unsigned)rhw_mask_bits(mask) : 0;
    rhw_int result = rhw_splat_int(0);
    for (; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        uint32_t *const word = word_at(&image, (const int32_t *)request->index + lane, RHW_LANES);
        const uint32_t value = request->value ? (uint32_t)(*request->value)[lane] : 0;
        const uint32_t comparand = request->comparand ? (uint32_t)(*request->comparand)[lane] : 0;
        result[lane] = word ? rhw_storage_word(word, request->operation, value, comparand) : 0;
    }
    if (before) {
        *before = result;
    }
}

void rhw_image_size(const struct rhw_bindings *textures, int slot, rhw_int size[3])
{
    const struct rhw_storage_image image = image_of(textures, slot, RHW_STORAGE_LOAD);
    size[0] = size[1] = size[2] = rhw_splat_int(0);
    if (image.texture) {
        const struct rhw_binding binding = {.texture = image.texture};
        const rhw_int level = rhw_splat_int(image.level);
        textures->kernels->query_size(&binding, &level, size);
    }
}

// One at a time ----------------------------------------------------------------------------------------

// Put as many coordinates as the slot's image has into all lanes.
static void widen(const struct rhw_bindings *textures, int slot, const int32_t *at, rhw_int lanes[3])
{
    const struct rhw_texture_data *const texture =
        (unsigned)slot < RHW_MAX_STORAGE_IMAGES ? textures->storage->images[slot].texture : NULL;
    for (int i = 0; i < 3; i++) {
        lanes[i] = rhw_splat_int(texture && i < coordinates_of(texture) ? at[i] : 0);
    }
}

void rhw_image_load1(const struct rhw_bindings *textures, int slot, const int32_t *at, float texel[4])
{
    rhw_int lanes[3];
    rhw_float texels[4];
    widen(textures, slot, at, lanes);
    rhw_image_load(textures, slot, lanes, texels);
    for (int c = 0; c < 4; c++) {
        texel[c] = texels[c][0];
    }
}

void rhw_image_store1(const struct rhw_bindings *textures, int slot, const int32_t *at, const float texel[4])
{
    const rhw_int first = rhw_equal_int(rhw_lane_numbers(), rhw_splat_int(0));
    rhw_int lanes[3];
    rhw_float texels[4];
    widen(textures, slot, at, lanes);
    for (int c = 0; c < 4; c++) {
        texels[c] = rhw_splat(texel[c]);
    }
    rhw_image_store(textures, slot, lanes, &first, texels);
}

int32_t rhw_image_atomic1(const struct rhw_bindings *textures, int slot, enum rhw_storage_operation operation,
                          const int32_t *at, int32_t value, int32_t comparand)
{
    const struct rhw_storage_image image = image_of(textures, slot, operation);
    uint32_t *const word = has_atomics(&image) ? word_at(&image, at, 1) : NULL;
    return word ? rhw_storage_word(word, operation, (uint32_t)value, (uint32_t)comparand) : 0;
}

void rhw_image_size1(const struct rhw_bindings *textures, int slot, int32_t size[3])
{
    rhw_int lanes[3];
    rhw_image_size(textures, slot, lanes);
    for (int i = 0; i < 3; i++) {
        size[i] = lanes[i][0];
    }
}
