// SPDX-License-Identifier: MIT
// See upload_image.h.
#include "upload_image.h"

#include "draw/shading/color.h"

#include <stdlib.h>
#include <string.h>

// What a texture gets that differs from the texels of its image.
struct conversion {
    const struct scene_image *image;
    const unsigned char *red; // texels of 4 bytes that give their red to a combined image
    bool decode;
    size_t texel; // bytes of a texel of the texture
    void (*convert)(const struct conversion *conversion, size_t first, size_t count, void *out);
};

// 16-bit texels as floats: half floats would round them. The sRGB decoding of colours happens here, since
// only 8-bit textures decode when they are sampled.
static void widen_texels(const struct conversion *conversion, size_t first, size_t count, void *out)
{
    const uint16_t *in = (const uint16_t *)conversion->image->texels + 4 * first;
    float *const wide = out;
    for (size_t i = 0; i < count; i += 2) {
        const size_t lanes = count - i < 2 ? 4 : 8;
        rhw_float value = rhw_splat(0.0f);
        for (size_t k = 0; k < lanes; k++) {
            value[k] = (float)in[4 * i + k] / 65535.0f;
        }
        if (conversion->decode) {
            const rhw_int is_color = {-1, -1, -1, 0, -1, -1, -1, 0};
            value = rhw_select(is_color, scene_color_decode8(value), value);
        }
        memcpy(&wide[4 * i], &value, lanes * sizeof *wide);
    }
}

// Red of one image, the rest of another one.
static void combine_texels(const struct conversion *conversion, size_t first, size_t count, void *out)
{
    unsigned char *const texels = out;
    memcpy(texels, (const unsigned char *)conversion->image->texels + 4 * first, 4 * count);
    for (size_t i = 0; i < count; i++) {
        texels[4 * i] = conversion->red[4 * (first + i)];
    }
}

// Convert rows and write them, some at a time. Each write asks whether that goes on.
static enum rhw_result write_converted(rhw_context *context, rhw_texture texture,
                                       const struct conversion *conversion)
{
    enum { BAND_TEXELS = 1 << 16 };
    const int width = (int)conversion->image->width, height = (int)conversion->image->height;
    const int rows = 1 + BAND_TEXELS / width;
    void *const band = malloc((size_t)rows * (size_t)width * conversion->texel);
    enum rhw_result result = band ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
    for (int y = 0; y < height && result == RHW_OK; y += rows) {
        const int count = height - y < rows ? height - y : rows;
        const struct rhw_texture_region region = {.y = y, .width = width, .height = count};
        conversion->convert(conversion, (size_t)y * (size_t)width, (size_t)count * (size_t)width, band);
        result = rhw_texture_write_region(context, texture, &region, band, 0, 0);
    }
    free(band);
    return result;
}

// Make a texture of an image. `red` is NULL or replaces its red.
static enum rhw_result upload_texture(rhw_context *context, const struct scene_image *image,
                                      const struct scene_image *red, bool as_color, bool mips,
                                      rhw_texture *texture)
{
    const bool widens = image->type == SCENE_IMAGE_RGBA16;
    const struct conversion conversion = {.image = image,
                                          .red = red ? red->texels : NULL,
                                          .decode = as_color,
                                          .texel = widens ? 4 * sizeof(float) : 4,
                                          .convert = widens ? widen_texels : combine_texels};
    struct rhw_texture_def def = rhw_texture_def_default();
    def.width = (int)image->width;
    def.height = (int)image->height;
    def.mip_levels = mips ? RHW_MIP_LEVELS_ALL : 1;
    def.format = as_color ? RHW_FORMAT_RGBA8_SRGB : RHW_FORMAT_RGBA8_UNORM;
    if (image->type != SCENE_IMAGE_RGBA8) {
        def.format = RHW_FORMAT_RGBA32_FLOAT;
    }
    enum rhw_result result = rhw_texture_create(context, &def, texture);
    if (result == RHW_OK) {
        result = widens || red ? write_converted(context, *texture, &conversion)
                               : rhw_texture_write(context, *texture, 0, image->texels, 0);
    }
    return result == RHW_OK && mips ? rhw_texture_generate_mips(context, *texture) : result;
}

static bool same_place(const struct scene_texture_slot *a, const struct scene_texture_slot *b)
{
    return a->uv_set == b->uv_set && a->address_u == b->address_u && a->address_v == b->address_v &&
           a->min_filter == b->min_filter && a->mag_filter == b->mag_filter &&
           a->mip_filter == b->mip_filter && memcmp(a->transform, b->transform, sizeof a->transform) == 0 &&
           memcmp(a->border, b->border, sizeof a->border) == 0;
}

enum scene_occlusion scene_occlusion_of(const struct scene_model *model,
                                        const struct scene_material *material)
{
    const struct scene_texture_slot *const rough = &material->slots[SCENE_SLOT_METALLIC_ROUGHNESS];
    const struct scene_texture_slot *const occlusion = &material->slots[SCENE_SLOT_OCCLUSION];
    if (rough->image < 0 || occlusion->image < 0 || !same_place(rough, occlusion)) {
        return SCENE_OCCLUSION_APART;
    }
    if (rough->image == occlusion->image) {
        return SCENE_OCCLUSION_SHARED;
    }
    const struct scene_image *const a = &model->images[rough->image];
    const struct scene_image *const b = &model->images[occlusion->image];
    const bool alike = a->type == SCENE_IMAGE_RGBA8 && b->type == SCENE_IMAGE_RGBA8 && a->width == b->width &&
                       a->height == b->height;
    return alike ? SCENE_OCCLUSION_COMBINED : SCENE_OCCLUSION_APART;
}

// Which textures the materials want of an image.
struct image_wants {
    bool color, data, mips;
};

// Adds what a material wants to what is wanted of each image.
static void add_wants(const struct scene_model *model, const struct scene_material *material,
                      struct image_wants *wants)
{
    const bool combined = scene_occlusion_of(model, material) == SCENE_OCCLUSION_COMBINED;
    for (int s = 0; s < SCENE_SLOT_COUNT; s++) {
        const struct scene_texture_slot *const slot = &material->slots[s];
        if (slot->image < 0 ||
            (combined && (s == SCENE_SLOT_METALLIC_ROUGHNESS || s == SCENE_SLOT_OCCLUSION))) {
            continue;
        }
        struct image_wants *const of_image = &wants[slot->image];
        bool *const wanted = scene_slot_is_color((enum scene_slot)s) ? &of_image->color : &of_image->data;
        *wanted = true;
        of_image->mips = of_image->mips || slot->mip_filter != RHW_MIP_FILTER_NONE;
    }
}

static enum rhw_result upload_image(rhw_context *context, const struct scene_image *image,
                                    struct image_wants wants, struct scene_uploaded_image *uploaded)
{
    enum rhw_result result = RHW_OK;
    if (wants.color) {
        result = upload_texture(context, image, NULL, true, wants.mips, &uploaded->color);
    }
    if (wants.data && result == RHW_OK) {
        result = upload_texture(context, image, NULL, false, wants.mips, &uploaded->data);
    }
    return result;
}

enum rhw_result scene_upload_images(rhw_context *context, const struct scene_model *model,
                                    struct scene_uploaded_image *uploaded)
{
    struct image_wants *const wants = calloc((size_t)model->image_count + 1, sizeof *wants);
    enum rhw_result result = wants ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
    for (uint32_t m = 0; m < model->material_count && wants; m++) {
        add_wants(model, &model->materials[m], wants);
    }
    for (uint32_t i = 0; i < model->image_count && result == RHW_OK; i++) {
        result = upload_image(context, &model->images[i], wants[i], &uploaded[i]);
    }
    free(wants);
    return result;
}

enum rhw_result scene_upload_combined(rhw_context *context, const struct scene_model *model,
                                      const struct scene_material *material,
                                      struct scene_combined_images *combined, rhw_texture *texture)
{
    const struct scene_texture_slot *const slot = &material->slots[SCENE_SLOT_METALLIC_ROUGHNESS];
    const int32_t rough = slot->image, occlusion = material->slots[SCENE_SLOT_OCCLUSION].image;
    const bool mips = slot->mip_filter != RHW_MIP_FILTER_NONE;
    for (uint32_t i = 0; i < combined->count; i++) {
        const struct scene_combined_image *const known = &combined->images[i];
        if (known->rough == rough && known->occlusion == occlusion && known->mips == mips) {
            *texture = known->texture;
            return RHW_OK;
        }
    }
    struct scene_combined_image *const next = &combined->images[combined->count];
    *next = (struct scene_combined_image){rough, occlusion, mips, {0}};
    const enum rhw_result result = upload_texture(context, &model->images[rough], &model->images[occlusion],
                                                  false, mips, &next->texture);
    combined->count++; // counts a texture that is there without its mips, too
    *texture = next->texture;
    return result;
}
