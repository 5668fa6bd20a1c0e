// SPDX-License-Identifier: MIT
// What shaders ask of a texture beside a filtered sample: single texels, the four of a footprint, sizes, and which
// level a sample would read.
#ifndef RHW_TEXEL_QUERY_H
#define RHW_TEXEL_QUERY_H

#include "anisotropy.h"

// Move `i` into 0 .. count − 1 and clear lanes of the mask in which it was outside.
static inline i32x8 keep_inside(i32x8 i, i32x8 count, i32x8 *inside)
{
    *inside = *inside & ~(i >> 31) & rhw_less_int(i, count);
    return rhw_max_int(rhw_min_int(i, count - 1), i32x8_splat(0));
}

// Fetch texels. Outside they are zeros, except for what the format lacks (Vulkan 1.3, "Texel Replacement" with
// robustImageAccess2).
static inline void fetch(const struct rhw_texture_data *texture, const i32x8 *at, i32x8 number,
                         f32x8 texel[4])
{
    const enum rhw_texture_kind kind = texture->shape.kind;
    i32x8 inside = i32x8_splat(-1);
    const i32x8 existing = keep_inside(number, i32x8_splat(texture->levels), &inside);
    const struct lane_level level = lane_level_at(texture, existing);
    const bool has_y = kind != RHW_TEXTURE_1D;
    const bool has_slice = kind == RHW_TEXTURE_3D || kind == RHW_TEXTURE_CUBE || texture->shape.is_array;
    const i32x8 x = keep_inside(at[0], level.size[0], &inside);
    const i32x8 y = has_y ? keep_inside(at[1], level.size[1], &inside) : i32x8_splat(0);
    const i32x8 slice = has_slice ? keep_inside(at[1 + has_y], level.slices, &inside) : i32x8_splat(0);
    lane_texels(texture, &level, x, y, slice, texel);
    for (int c = 0; c < texture->info->channels; c++) {
        texel[c] = rhw_select(inside, texel[c], rhw_splat(0.0f));
    }
}

// Fetch texels of level 0 of a plain 2D texture, as passes read what others drew: nothing is looked up for each lane.
static inline void fetch_plain(const struct rhw_texture_data *texture, const i32x8 *at, f32x8 texel[4])
{
    const struct rhw_mip *const mip = &texture->mip[0];
    struct raw_texels raw;
    i32x8 inside = i32x8_splat(-1);
    const i32x8 x = keep_inside(at[0], i32x8_splat(mip->width), &inside);
    const i32x8 y = keep_inside(at[1], i32x8_splat(mip->height), &inside);
    // Groups come block by block: the texels of the row of blocks below are wanted next. Below the last row there are
    // none, where no pointer may stand, but a number may.
    __builtin_prefetch((const void *)((uintptr_t)mip->texels + (size_t)(y[0] + RHW_BLOCK) * mip->row_pitch +
                                      (size_t)x[0] * texture->info->size));
    fetch_raw_texels(texture->info->size, mip, x, y, &raw);
    decode_texels(texture->info, &raw, texel);
    for (int c = 0; c < texture->info->channels; c++) {
        texel[c] = rhw_select(inside, texel[c], rhw_splat(0.0f));
    }
}

// Fetch texels of a sample of a multisampled texture. Lanes of one sample and layer are read together: samples stand so
// far apart that texels of all of them are too many to number.
static inline void fetch_sample(const struct rhw_texture_data *texture, const i32x8 *at, i32x8 sample,
                                f32x8 texel[4])
{
    const struct rhw_mip *const mip = &texture->mip[0];
    const size_t size = texture->info->size;
    i32x8 inside = i32x8_splat(-1);
    const i32x8 x = keep_inside(at[0], i32x8_splat(mip->width), &inside);
    const i32x8 y = keep_inside(at[1], i32x8_splat(mip->height), &inside);
    const i32x8 existing = keep_inside(sample, i32x8_splat(texture->samples), &inside);
    const int layers = mip->slices;
    const i32x8 layer =
        texture->shape.is_array ? keep_inside(at[2], i32x8_splat(layers), &inside) : i32x8_splat(0);
    const i32x8 slice = existing * i32x8_splat(layers) + layer;
    const i32x8 number = y * i32x8_splat((int32_t)(mip->row_pitch / size)) + x;
    for (unsigned left = 0xff; left != 0;) {
        const int32_t p = slice[__builtin_ctz(left)];
        const size_t at_sample = (size_t)(p / layers) * texture->sample_stride,
                     at_layer = (size_t)(p % layers) * mip->slice_pitch;
        const i32x8 lanes = rhw_equal_int(slice, i32x8_splat(p));
        struct raw_texels raw;
        f32x8 value[4];
        fetch_numbered_texels(size, mip->texels + at_sample + at_layer, number, &raw);
        decode_texels(texture->info, &raw, value);
        for (int c = 0; c < 4; c++) {
            texel[c] = rhw_select(lanes, value[c], left == 0xff ? value[c] : texel[c]);
        }
        left &= ~i32x8_sign_bits(lanes);
    }
    for (int c = 0; c < texture->info->channels; c++) {
        texel[c] = rhw_select(inside, texel[c], rhw_splat(0.0f));
    }
}

// Gather one channel of the texels that a linear filter would mix in level 0: below left, below right, above right,
// above left, v down (Vulkan 1.3, "Texel Gathering"). The result is zeros where there are not four texels.
static inline void gather(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                          int channel, f32x8 texel[4])
{
    static const int order[4] = {2, 3, 1, 0};
    struct lookup lookup;
    struct texel_block block;
    look_up(binding, request, &lookup);
    const struct lane_level level = lane_level_at(binding->texture, i32x8_splat(0));
    if (lookup.axes == 2) {
        find_block(&lookup, &level, &block);
        load_block(&lookup, &level, &block);
    }
    const int compared = binding->sampler->def.compares ? 0 : channel;
    for (int n = 0; n < 4; n++) {
        texel[n] = lookup.axes == 2 ? block.texel[order[n]][compared] : rhw_splat(0.0f);
    }
}

// Return the level that a sample would read, and the level of detail before limits (Vulkan 1.3, "Image Level(s)
// Selection").
static inline void query_level(const struct rhw_binding_data *binding,
                               const struct rhw_sample_request *request, f32x8 lod[2])
{
    const struct rhw_sampler_data *const sampler = binding->sampler;
    f32x8 requested = requested_level(binding->texture, request);
    if (sampler->def.max_anisotropy > 1 && request->gradient) {
        struct long_axis axis;
        find_long_axis(binding, request, &axis);
        requested = axis.level;
    }
    const f32x8 within = limit_level(binding->texture, sampler, requested).within;
    f32x8 fraction;
    lod[0] = first_level(sampler, within, &fraction) + fraction;
    lod[1] = requested + sampler->def.lod_bias;
}

// Return texels along each axis, with slices or layers behind them. Axes that the kind lacks have 1, and all are 0
// where there is no such level.
static inline void query_size(const struct rhw_texture_data *texture, i32x8 number, i32x8 size[3])
{
    i32x8 inside = i32x8_splat(-1);
    const struct lane_level level =
        lane_level_at(texture, keep_inside(number, i32x8_splat(texture->levels), &inside));
    size[0] = level.size[0] & inside;
    size[1] = level.size[1] & inside;
    size[2] = level.slices & inside;
}

#endif
