// SPDX-License-Identifier: MIT
// Storage images and texel buffers as shader functions reach them.
#include "binding.h"

#include "binding/validation/validation.h"
#include "format/format.h"
#include "resource/texture.h"
#include "rhw/shader.h"
#include "sample_access.h"

struct rhw_storage_image rhw_storage_image_of_level(const struct rhw_texture_data *texture, int level,
                                                    bool is_read_only)
{
    return (struct rhw_storage_image){
        .texture = texture, .info = texture->info, .level = level, .is_read_only = is_read_only};
}

struct rhw_storage_image rhw_storage_image_of_texels(enum rhw_format format, void *bytes, size_t size,
                                                     bool is_read_only)
{
    const struct rhw_format_info *const info = rhw_format_info(format);
    const size_t count = size / info->size;
    return (struct rhw_storage_image){.info = info,
                                      .texels = bytes,
                                      .count = count < RHW_MAX_TEXEL_BUFFER ? (int32_t)count
                                                                            : RHW_MAX_TEXEL_BUFFER,
                                      .is_read_only = is_read_only};
}

void rhw_bound_image_load(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                          const rhw_int *at, rhw_float texel[4])
{
    if (image->info) {
        kernels->image_load(image, at, texel);
    } else {
        rhw_no_texel(texel);
    }
}

void rhw_bound_image_store(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                           const rhw_int *at, const rhw_int *mask, const rhw_float texel[4])
{
    if (image->info && rhw_format_has_role(image->info, RHW_ROLE_COLOR_TARGET)) {
        const rhw_int all = rhw_splat_int(-1);
        kernels->image_store(image, at, mask ? mask : &all, texel);
    }
}

// Return the number of coordinates that an image has.
static int coordinates_of(const struct rhw_storage_image *image)
{
    const struct rhw_texture_data *const texture = image->texture;
    if (!texture) {
        return image->info ? 1 : 0;
    }
    const bool has_layer = texture->shape.is_array && texture->shape.kind != RHW_TEXTURE_CUBE;
    return rhw_texture_components(texture->shape.kind) + has_layer;
}

// Return the word at coordinates of a level, of which a lane has every `stride`th number. Return NULL outside.
static uint32_t *word_of_level(const struct rhw_storage_image *image, const int32_t *at, int stride)
{
    const struct rhw_mip *const mip = &image->texture->mip[image->level];
    const bool has_y = image->texture->shape.kind != RHW_TEXTURE_1D;
    const bool has_slice = coordinates_of(image) > 1 + has_y;
    const uint32_t x = (uint32_t)at[0], y = has_y ? (uint32_t)at[stride] : 0;
    const uint32_t slice = has_slice ? (uint32_t)at[stride * (1 + has_y)] : 0;
    const bool inside =
        x < (uint32_t)mip->width && y < (uint32_t)mip->height && slice < (uint32_t)mip->slices;
    unsigned char *const row = mip->texels + (inside ? slice * mip->slice_pitch + y * mip->row_pitch : 0);
    return inside ? (uint32_t *)(void *)row + x : NULL;
}

// Return the word at coordinates, of which a lane has every `stride`th number. Return NULL outside.
static uint32_t *word_at(const struct rhw_storage_image *image, const int32_t *at, int stride)
{
    if (image->texture) {
        return word_of_level(image, at, stride);
    }
    const bool inside = (uint32_t)at[0] < (uint32_t)image->count;
    return inside ? (uint32_t *)(void *)image->texels + at[0] : NULL;
}

// Floats are moved, and not computed with.
static bool has_atomic(const struct rhw_storage_image *image, enum rhw_storage_operation operation)
{
    const bool moves =
        operation == RHW_STORAGE_LOAD || operation == RHW_STORAGE_STORE || operation == RHW_STORAGE_EXCHANGE;
    return image->info && (image->info == rhw_format_info(RHW_FORMAT_R32_UINT) ||
                           image->info == rhw_format_info(RHW_FORMAT_R32_SINT) ||
                           (moves && image->info == rhw_format_info(RHW_FORMAT_R32_FLOAT)));
}

void rhw_bound_image_atomic(const struct rhw_storage_image *image, const struct rhw_storage_request *request,
                            rhw_int *before)
{
    const rhw_int mask = request->mask ? *request->mask : rhw_splat_int(-1);
    unsigned left = has_atomic(image, request->operation) ? (unsigned)rhw_mask_bits(mask) : 0;
    rhw_int result = rhw_splat_int(0);
    for (; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        uint32_t *const word = word_at(image, (const int32_t *)request->index + lane, RHW_LANES);
        const uint32_t value = request->value ? (uint32_t)(*request->value)[lane] : 0;
        const uint32_t comparand = request->comparand ? (uint32_t)(*request->comparand)[lane] : 0;
        result[lane] = word ? rhw_storage_word(word, request->operation, value, comparand) : 0;
    }
    if (before) {
        *before = result;
    }
}

void rhw_bound_image_size(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                          rhw_int size[3])
{
    size[0] = rhw_splat_int(image->info ? image->count : 0);
    size[1] = size[2] = rhw_splat_int(image->info != NULL && image->count > 0);
    if (image->texture) {
        const struct rhw_binding_data binding = {.texture = image->texture};
        const rhw_int level = rhw_splat_int(image->level);
        kernels->query_size(&binding, &level, size);
    }
}

// One at a time ----------------------------------------------------------------------------------------

// Put as many coordinates as the image has into all lanes.
static void widen(const struct rhw_storage_image *image, const int32_t *at, rhw_int lanes[3])
{
    for (int i = 0; i < 3; i++) {
        lanes[i] = rhw_splat_int(i < coordinates_of(image) ? at[i] : 0);
    }
}

void rhw_bound_image_load1(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                           const int32_t *at, float texel[4])
{
    rhw_int lanes[3];
    rhw_float texels[4];
    widen(image, at, lanes);
    rhw_bound_image_load(kernels, image, lanes, texels);
    for (int c = 0; c < 4; c++) {
        texel[c] = texels[c][0];
    }
}

void rhw_bound_image_store1(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                            const int32_t *at, const float texel[4])
{
    const rhw_int first = rhw_equal_int(rhw_lane_numbers(), rhw_splat_int(0));
    rhw_int lanes[3];
    rhw_float texels[4];
    widen(image, at, lanes);
    for (int c = 0; c < 4; c++) {
        texels[c] = rhw_splat(texel[c]);
    }
    rhw_bound_image_store(kernels, image, lanes, &first, texels);
}

int32_t rhw_bound_image_atomic1(const struct rhw_storage_image *image, enum rhw_storage_operation operation,
                                const int32_t *at, int32_t value, int32_t comparand)
{
    uint32_t *const word = has_atomic(image, operation) ? word_at(image, at, 1) : NULL;
    return word ? rhw_storage_word(word, operation, (uint32_t)value, (uint32_t)comparand) : 0;
}

void rhw_bound_image_size1(const struct rhw_kernels *kernels, const struct rhw_storage_image *image,
                           int32_t size[3])
{
    rhw_int lanes[3];
    rhw_bound_image_size(kernels, image, lanes);
    for (int i = 0; i < 3; i++) {
        size[i] = lanes[i][0];
    }
}

// By slot ----------------------------------------------------------------------------------------------

// Return the image of a slot. Return no image where the slot has none or does not exist. Return no image to an
// operation that changes it where the slot is set for reading, or where validation finds that the program did not
// declare the effect.
static const struct rhw_storage_image *image_of(const struct rhw_bindings *bindings, int slot,
                                                enum rhw_storage_operation operation)
{
    static const struct rhw_storage_image none;
    if (bindings->site.validation) {
        rhw_validate_image(bindings, slot, operation);
    }
    const struct rhw_storage_image *const image =
        (unsigned)slot < RHW_MAX_STORAGE_IMAGES ? &bindings->storage->images[slot] : &none;
    const bool is_dropped = operation != RHW_STORAGE_LOAD && (bindings->drops_effects || image->is_read_only);
    return is_dropped ? &none : image;
}

void rhw_image_load(const struct rhw_bindings *bindings, int slot, const rhw_int *at, rhw_float texel[4])
{
    rhw_bound_image_load(bindings->kernels, image_of(bindings, slot, RHW_STORAGE_LOAD), at, texel);
}

void rhw_image_store(const struct rhw_bindings *bindings, int slot, const rhw_int *at, const rhw_int *mask,
                     const rhw_float texel[4])
{
    rhw_bound_image_store(bindings->kernels, image_of(bindings, slot, RHW_STORAGE_STORE), at, mask, texel);
}

void rhw_image_atomic(const struct rhw_bindings *bindings, int slot,
                      const struct rhw_storage_request *request, rhw_int *before)
{
    rhw_bound_image_atomic(image_of(bindings, slot, request->operation), request, before);
}

void rhw_image_size(const struct rhw_bindings *bindings, int slot, rhw_int size[3])
{
    rhw_bound_image_size(bindings->kernels, image_of(bindings, slot, RHW_STORAGE_LOAD), size);
}

void rhw_image_load1(const struct rhw_bindings *bindings, int slot, const int32_t *at, float texel[4])
{
    rhw_bound_image_load1(bindings->kernels, image_of(bindings, slot, RHW_STORAGE_LOAD), at, texel);
}

void rhw_image_store1(const struct rhw_bindings *bindings, int slot, const int32_t *at, const float texel[4])
{
    rhw_bound_image_store1(bindings->kernels, image_of(bindings, slot, RHW_STORAGE_STORE), at, texel);
}

int32_t rhw_image_atomic1(const struct rhw_bindings *bindings, int slot, enum rhw_storage_operation operation,
                          const int32_t *at, int32_t value, int32_t comparand)
{
    return rhw_bound_image_atomic1(image_of(bindings, slot, operation), operation, at, value, comparand);
}

void rhw_image_size1(const struct rhw_bindings *bindings, int slot, int32_t size[3])
{
    rhw_bound_image_size1(bindings->kernels, image_of(bindings, slot, RHW_STORAGE_LOAD), size);
}
