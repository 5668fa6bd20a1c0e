// SPDX-License-Identifier: MIT
// Anisotropic filtering (anisotropy.h) of textures that filter_fixed.h serves. What the samples of a footprint have in
// common is found once: the level of detail, and its two levels where all lanes have the same. Samples are added up as
// whole numbers and divided once, so that the average is rounded once, and equal samples leave it as they are.
#ifndef RHW_ANISOTROPY_FIXED_H
#define RHW_ANISOTROPY_FIXED_H

#include "anisotropy.h"
#include "filter_fixed.h"

// Red, green, blue and alpha of the samples so far. A channel has 15 bits, and there are at most 16 samples.
struct fixed_sums {
    i32x8 channel[4];
};

// Add a sample in the lanes of `counts`.
RHW_INLINE void add_fixed(struct fixed_sums *sums, struct fixed_texels sample, i32x8 counts)
{
    const i32x8 rb = sample.rb & counts, ga = sample.ga & counts;
    sums->channel[0] += rb & sample_constants()->lower_half;
    sums->channel[1] += ga & sample_constants()->lower_half;
    sums->channel[2] += rb >> 16;
    sums->channel[3] += ga >> 16;
}

// Where a footprint's samples stand, and in which levels.
struct fixed_axis {
    f32x8 change[2];    // change of coordinates along the axis
    f32x8 count, parts; // N of each lane, and N + 1, into which the samples divide the axis
    i32x8 lod;          // level of detail, 16.16
};

// Sample lanes that have more than two levels, or a texture where footprints are not told apart.
static __attribute__((noinline)) void sample_fixed_apart_levels(const struct rhw_binding_data *binding,
                                                                const f32x8 at[2], const i32x8 *lod,
                                                                enum rhw_texel_codec codec,
                                                                enum footprint_path path,
                                                                struct fixed_texels *sample)
{
    if (codec == RHW_CODEC_SRGB8) {
        *sample = filter_fixed_levels(binding, at[0], at[1], *lod, RHW_CODEC_SRGB8, path);
    } else {
        *sample = filter_fixed_levels(binding, at[0], at[1], *lod, RHW_CODEC_UNORM8, path);
    }
}

// Add up the samples of a footprint around `middle`.
RHW_INLINE void sample_fixed_axis(const struct rhw_binding_data *binding, const f32x8 middle[2],
                                  const struct fixed_axis *axis, enum rhw_texel_codec codec,
                                  enum footprint_path path, struct fixed_sums *sums)
{
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    const i32x8 weight = i32x8_halve_lower(axis->lod);
    const bool two_levels = path == FOOTPRINTS_INTERIOR && same_two_levels(axis->lod, weight);
    const struct rhw_mip *const fine = mip_at(binding->texture, two_levels ? axis->lod[0] >> 16 : 0);
    f32x8 number = rhw_splat(1.0f);
    i32x8 counts = i32x8_splat(-1);
    do {
        const f32x8 along = number / axis->parts - 0.5f;
        const f32x8 at[2] = {fold_coordinate(def->address_u, middle[0] + axis->change[0] * along),
                             fold_coordinate(def->address_v, middle[1] + axis->change[1] * along)};
        struct fixed_texels sample;
        if (two_levels) {
            const struct fixed_texels a = filter_fixed(binding->sampler, fine, at[0], at[1], codec, path);
            const struct fixed_texels b = filter_fixed(binding->sampler, fine + 1, at[0], at[1], codec, path);
            sample = mix_fixed(a, b, weight, codec);
        } else {
            sample_fixed_apart_levels(binding, at, &axis->lod, codec, path, &sample);
        }
        add_fixed(sums, without_negation(sample, codec), counts);
        counts = rhw_less(number, axis->count);
        number += 1.0f;
    } while (rhw_any(counts));
}

// Return 8.7 fixed point / (255 · 128) of an average. See fixed_to_float.
RHW_INLINE f32x8 average_to_float(i32x8 sum, f32x8 count)
{
    const f32x8 c = rhw_float_from_int(sum) / count;
    return c * sample_constants()->fixed_scale + c * sample_constants()->fixed_rest;
}

// Do what find_long_axis does, of a plain 2D texture.
RHW_INLINE void find_plain_axis(const struct rhw_binding_data *binding,
                                const struct rhw_sample_request *request, struct long_axis *axis)
{
    const float width = (float)binding->texture->shape.width, height = (float)binding->texture->shape.height;
    const f32x8 *const gradient = request->gradient;
    const f32x8 ux = gradient[0] * width, vx = gradient[1] * height;
    const f32x8 uy = gradient[2] * width, vy = gradient[3] * height;
    find_longer_axis(binding, request, ux * ux + vx * vx, uy * uy + vy * vy, 2, axis);
}

RHW_INLINE void find_fixed_axis(const struct rhw_binding_data *binding,
                                const struct rhw_sample_request *request, struct fixed_axis *fixed)
{
    struct long_axis axis;
    find_plain_axis(binding, request, &axis);
    *fixed = (struct fixed_axis){{axis.change[0], axis.change[1]},
                                 axis.count,
                                 axis.count + 1.0f,
                                 fixed_level_of_detail(binding, NULL, &axis.level)};
}

// Average the samples of a footprint around `middle`.
RHW_INLINE void average_fixed_axis(const struct rhw_binding_data *binding, const f32x8 middle[2],
                                   const struct fixed_axis *axis, enum rhw_texel_codec codec,
                                   enum footprint_path path, f32x8 texel[4])
{
    struct fixed_sums sums = {{i32x8_splat(0), i32x8_splat(0), i32x8_splat(0), i32x8_splat(0)}};
    sample_fixed_axis(binding, middle, axis, codec, path, &sums);
    for (int c = 0; c < 4; c++) {
        texel[c] = average_to_float(sums.channel[c], axis->count);
    }
}

RHW_INLINE void sample_fixed_anisotropic(const struct rhw_binding_data *binding,
                                         const struct rhw_sample_request *request, enum footprint_path path,
                                         f32x8 texel[4])
{
    if (!request->gradient || request->offset) {
        sample_anisotropic(binding, request, texel);
        return;
    }
    struct fixed_axis axis;
    find_fixed_axis(binding, request, &axis);
    if (binding->texture->info->codec == RHW_CODEC_SRGB8) {
        average_fixed_axis(binding, request->coordinates, &axis, RHW_CODEC_SRGB8, path, texel);
    } else {
        average_fixed_axis(binding, request->coordinates, &axis, RHW_CODEC_UNORM8, path, texel);
    }
}

// Sample several groups. The axis of a footprint takes a chain of operations, each of which waits for the one before:
// the chains of all groups come first, so that they wait together.
RHW_INLINE void sample_axis_groups(const struct rhw_binding_data *binding, const struct rhw_fragment *groups,
                                   int count, int at, enum rhw_texel_codec codec, f32x8 (*texels)[4],
                                   int stride)
{
    struct fixed_axis axis[RHW_MAX_GROUPS];
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const group = &groups[g];
        const f32x8 gradient[4] = {group->ddx[at], group->ddx[at + 1], group->ddy[at], group->ddy[at + 1]};
        const struct rhw_sample_request request = {.coordinates = &group->varying[at], .gradient = gradient};
        find_fixed_axis(binding, &request, &axis[g]);
    }
    for (int g = 0; g < count; g++) {
        average_fixed_axis(binding, &groups[g].varying[at], &axis[g], codec, FOOTPRINTS_INTERIOR,
                           texels[g * stride]);
    }
}

#endif
