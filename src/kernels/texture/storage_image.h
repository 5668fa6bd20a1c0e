// SPDX-License-Identifier: MIT
// Texels that shaders read and write at whole coordinates, of a level of a texture or of a texel buffer.
#ifndef RHW_STORAGE_IMAGE_H
#define RHW_STORAGE_IMAGE_H

#include "binding/storage.h"
#include "texel_query.h"

// Write a texel of 1, 2, 4, 8 or 16 bytes. Other threads may be at this texel, so each word is written in one step.
static inline void store_texel(unsigned char *place, const uint32_t *word, size_t size)
{
    if (size == 1) {
        __atomic_store_n(place, (unsigned char)word[0], __ATOMIC_RELAXED);
    } else if (size == 2) {
        __atomic_store_n((uint16_t *)(void *)place, (uint16_t)word[0], __ATOMIC_RELAXED);
    } else {
        for (size_t i = 0; i < size / 4; i++) {
            __atomic_store_n((uint32_t *)(void *)place + i, word[i], __ATOMIC_RELAXED);
        }
    }
}

// Read texels of a texel buffer, as `fetch` reads them. Nothing is loaded from one without texels.
static inline void load_row(const struct rhw_storage_image *image, i32x8 at, f32x8 texel[4])
{
    struct raw_texels raw = {{{0}}};
    i32x8 inside = i32x8_splat(-1);
    const i32x8 x = keep_inside(at, i32x8_splat(image->count), &inside);
    if (image->count > 0) {
        fetch_numbered_texels(image->info->size, image->texels, x, &raw);
    }
    decode_texels(image->info, &raw, texel);
    for (int c = 0; c < image->info->channels; c++) {
        texel[c] = rhw_select(inside, texel[c], rhw_splat(0.0f));
    }
}

static inline void image_load(const struct rhw_storage_image *image, const i32x8 *at, f32x8 texel[4])
{
    if (image->texture) {
        fetch(image->texture, at, i32x8_splat(image->level), texel);
    } else {
        load_row(image, at[0], texel);
    }
}

// Return the place of each lane's texel. Lanes of `inside` whose texel lies outside of the image are cleared there.
static inline void find_texels(const struct rhw_storage_image *image, const i32x8 *at, i32x8 *inside,
                               unsigned char *place[RHW_LANES])
{
    const struct rhw_texture_data *const texture = image->texture;
    const size_t size = image->info->size;
    if (!texture) {
        const i32x8 x = keep_inside(at[0], i32x8_splat(image->count), inside);
        for (int lane = 0; lane < RHW_LANES; lane++) {
            place[lane] = image->count > 0 ? image->texels + (size_t)x[lane] * size : NULL;
        }
        return;
    }
    const struct rhw_mip *const mip = &texture->mip[image->level];
    const enum rhw_texture_kind kind = texture->shape.kind;
    const bool has_y = kind != RHW_TEXTURE_1D;
    const bool has_slice = kind == RHW_TEXTURE_3D || kind == RHW_TEXTURE_CUBE || texture->shape.is_array;
    const i32x8 x = keep_inside(at[0], i32x8_splat(mip->width), inside);
    const i32x8 y = has_y ? keep_inside(at[1], i32x8_splat(mip->height), inside) : i32x8_splat(0);
    const i32x8 slice =
        has_slice ? keep_inside(at[1 + has_y], i32x8_splat(mip->slices), inside) : i32x8_splat(0);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        place[lane] = mip->texels + (size_t)slice[lane] * mip->slice_pitch +
                      (size_t)y[lane] * mip->row_pitch + (size_t)x[lane] * size;
    }
}

// Write the texels of lanes of `mask` that lie inside.
static inline void image_store(const struct rhw_storage_image *image, const i32x8 *at, i32x8 mask,
                               const f32x8 texel[4])
{
    unsigned char *place[RHW_LANES];
    i32x8 inside = mask;
    find_texels(image, at, &inside, place);
    struct raw_texels raw = {{{0}}};
    encode_texels(image->info, texel, &raw);
    for (unsigned left = i32x8_sign_bits(inside); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        uint32_t word[4];
        for (int w = 0; w < 4; w++) {
            word[w] = (uint32_t)raw.word[w][lane];
        }
        store_texel(place[lane], word, image->info->size);
    }
}

#endif
