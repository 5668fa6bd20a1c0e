// SPDX-License-Identifier: MIT
// See upload_image.h.
#include "upload_image.h"

#include "draw/shading/color.h"

#include <stdlib.h>
#include <string.h>

// 16-bit texels as floats: half floats would round them. The sRGB decoding of colours happens here, since
// only 8-bit textures decode when they are sampled.
static float *widen_texels(const struct scene_image *image, bool decode)
{
    const size_t texels = (size_t)image->width * image->height;
    const uint16_t *in = image->texels;
    float *out = malloc(texels * 4 * sizeof *out);
    for (size_t i = 0; out && i < texels; i += 2) {
        const size_t count = texels - i < 2 ? 4 : 8;
        rhw_float value = rhw_splat(0.0f);
        for (size_t k = 0; k < count; k++) {
            value[k] = (float)in[4 * i + k] / 65535.0f;
        }
        if (decode) {
            const rhw_int is_color = {-1, -1, -1, 0, -1, -1, -1, 0};
            value = rhw_select(is_color, scene_color_decode8(value), value);
        }
        memcpy(&out[4 * i], &value, count * sizeof *out);
    }
    return out;
}

static enum rhw_result upload_texture(rhw_context *context, const struct scene_image *image, bool as_color,
                                      bool mips, rhw_texture *texture)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.width = (int)image->width;
    def.height = (int)image->height;
    def.mip_levels = mips ? RHW_MIP_LEVELS_ALL : 1;
    def.format = as_color ? RHW_FORMAT_RGBA8_SRGB : RHW_FORMAT_RGBA8_UNORM;
    const void *texels = image->texels;
    float *widened = NULL;
    if (image->type != SCENE_IMAGE_RGBA8) {
        def.format = RHW_FORMAT_RGBA32_FLOAT;
    }
    if (image->type == SCENE_IMAGE_RGBA16) {
        texels = widened = widen_texels(image, as_color);
        if (!widened) {
            return RHW_ERROR_OUT_OF_MEMORY;
        }
    }
    enum rhw_result result = rhw_texture_create(context, &def, texture);
    if (result == RHW_OK) {
        rhw_texture_write(context, *texture, 0, texels, 0);
        if (mips) {
            result = rhw_texture_generate_mips(context, *texture);
        }
    }
    free(widened);
    return result;
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
        result = upload_texture(context, image, true, wants.mips, &uploaded->color);
    }
    if (wants.data && result == RHW_OK) {
        result = upload_texture(context, image, false, wants.mips, &uploaded->data);
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

// Red of `occlusion`, the rest of `rough`.
static enum rhw_result combine(rhw_context *context, const struct scene_image *rough,
                               const struct scene_image *occlusion, bool mips, rhw_texture *texture)
{
    unsigned char *const texels = malloc(rough->size);
    if (!texels) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    memcpy(texels, rough->texels, rough->size);
    const unsigned char *const red = occlusion->texels;
    for (size_t i = 0; i < rough->size; i += 4) {
        texels[i] = red[i];
    }
    struct scene_image combined = *rough;
    combined.texels = texels;
    const enum rhw_result result = upload_texture(context, &combined, false, mips, texture);
    free(texels);
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
    const enum rhw_result result =
        combine(context, &model->images[rough], &model->images[occlusion], mips, &next->texture);
    combined->count++; // counts a texture that is there without its mips, too
    *texture = next->texture;
    return result;
}
