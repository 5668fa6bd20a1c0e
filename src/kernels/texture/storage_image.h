// SPDX-License-Identifier: MIT
// Texels that shaders write at whole coordinates. texel_query.h's fetch reads them.
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

// Write the texels of lanes of `mask` that lie inside.
static inline void image_store(const struct rhw_storage_image *image, const i32x8 *at, i32x8 mask,
                               const f32x8 texel[4])
{
    const struct rhw_texture_data *const texture = image->texture;
    const struct rhw_mip *const mip = &texture->mip[image->level];
    const enum rhw_texture_kind kind = texture->shape.kind;
    const bool has_y = kind != RHW_TEXTURE_1D;
    const bool has_slice = kind == RHW_TEXTURE_3D || kind == RHW_TEXTURE_CUBE || texture->shape.is_array;
    i32x8 inside = mask;
    const i32x8 x = keep_inside(at[0], i32x8_splat(mip->width), &inside);
    const i32x8 y = has_y ? keep_inside(at[1], i32x8_splat(mip->height), &inside) : i32x8_splat(0);
    const i32x8 slice =
        has_slice ? keep_inside(at[1 + has_y], i32x8_splat(mip->slices), &inside) : i32x8_splat(0);
    struct raw_texels raw = {{{0}}};
    encode_texels(texture->info, texel, &raw);
    const size_t size = texture->info->size;
    for (unsigned left = i32x8_sign_bits(inside); left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        uint32_t word[4];
        for (int w = 0; w < 4; w++) {
            word[w] = (uint32_t)raw.word[w][lane];
        }
        store_texel(mip->texels + (size_t)slice[lane] * mip->slice_pitch + (size_t)y[lane] * mip->row_pitch +
                        (size_t)x[lane] * size,
                    word, size);
    }
}

#endif
