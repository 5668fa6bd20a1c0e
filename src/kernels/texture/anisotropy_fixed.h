// SPDX-License-Identifier: MIT
// Anisotropic filtering (anisotropy.h) of textures that filter_fixed.h serves. What the samples of a footprint have in
// common is found once: the level of detail, its two levels where all lanes have the same, and how texels lie there
// (axis_level.h). Samples are added up as whole numbers and divided once, so that the average is rounded once, and
// equal samples leave it as they are.
#ifndef RHW_ANISOTROPY_FIXED_H
#define RHW_ANISOTROPY_FIXED_H

#include "anisotropy.h"
#include "axis_level.h"

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

// The samples of a footprint in two levels.
struct axis_samples {
    int count;
    i32x8 counts[MOST_AXIS_SAMPLES]; // −1 in the lanes that have the sample
    struct axis_level near, far;
};

// Return the coordinates of a sample. The first has number 1.
RHW_INLINE void sample_coordinates(const struct rhw_sampler_def *def, const f32x8 middle[2],
                                   const struct fixed_axis *axis, f32x8 number, f32x8 at[2])
{
    const f32x8 along = number / axis->parts - 0.5f;
    at[0] = fold_coordinate(def->address_u, middle[0] + axis->change[0] * along);
    at[1] = fold_coordinate(def->address_v, middle[1] + axis->change[1] * along);
}

// Place the samples of a footprint around `middle` in the level `fine` and in the next.
RHW_INLINE void place_samples(const struct rhw_binding_data *binding, const f32x8 middle[2],
                              const struct fixed_axis *axis, const struct rhw_mip *fine,
                              struct axis_samples *samples)
{
    const i32x8 leftmost = i32x8_splat(middle[0][RHW_LANES - 1] < middle[0][0] ? RHW_LANES - 1 : 0);
    start_axis_level(&samples->near, leftmost);
    start_axis_level(&samples->far, leftmost);
    f32x8 number = rhw_splat(1.0f);
    i32x8 counts = i32x8_splat(-1);
    int n = 0;
    do {
        f32x8 at[2];
        sample_coordinates(&binding->sampler->def, middle, axis, number, at);
        samples->counts[n] = counts;
        place_in_level(fine, n, at, &samples->near);
        place_in_level(fine + 1, n, at, &samples->far);
        n++;
        counts = rhw_less(number, axis->count);
        number += 1.0f;
    } while (rhw_any(counts));
    samples->count = n;
}

// Add up samples in the level `fine` and in the next, which has this weight.
RHW_INLINE void add_placed_samples(const struct rhw_binding_data *binding, const struct rhw_mip *fine,
                                   const struct axis_samples *samples, i32x8 weight,
                                   enum rhw_texel_codec codec, struct fixed_sums *sums)
{
    struct fixed_texels near[MOST_AXIS_SAMPLES], far[MOST_AXIS_SAMPLES];
    filter_axis_level(binding->sampler, fine, &samples->near, samples->count, codec, near);
    filter_axis_level(binding->sampler, fine + 1, &samples->far, samples->count, codec, far);
    struct fixed_sums sum = *sums; // a copy stays in registers
    for (int n = 0; n < samples->count; n++) {
        const struct fixed_texels sample = mix_fixed(near[n], far[n], weight, codec);
        add_fixed(&sum, without_negation(sample, codec), samples->counts[n]);
    }
    *sums = sum;
}

// Add up the samples of a footprint around `middle`, where lanes have other levels than two, the same ones, or where
// footprints are not told apart.
static __attribute__((noinline)) void add_samples_apart(const struct rhw_binding_data *binding,
                                                        const f32x8 middle[2], const struct fixed_axis *axis,
                                                        enum rhw_texel_codec codec, enum footprint_path path,
                                                        struct fixed_sums *sums)
{
    f32x8 number = rhw_splat(1.0f);
    i32x8 counts = i32x8_splat(-1);
    do {
        f32x8 at[2];
        sample_coordinates(&binding->sampler->def, middle, axis, number, at);
        const struct fixed_texels sample =
            codec == RHW_CODEC_SRGB8
                ? filter_fixed_levels(binding, at[0], at[1], axis->lod, RHW_CODEC_SRGB8, path)
                : filter_fixed_levels(binding, at[0], at[1], axis->lod, RHW_CODEC_UNORM8, path);
        add_fixed(sums, without_negation(sample, codec), counts);
        counts = rhw_less(number, axis->count);
        number += 1.0f;
    } while (rhw_any(counts));
}

// Add up the samples of a footprint around `middle`.
RHW_INLINE void sample_fixed_axis(const struct rhw_binding_data *binding, const f32x8 middle[2],
                                  const struct fixed_axis *axis, enum rhw_texel_codec codec,
                                  enum footprint_path path, struct fixed_sums *sums)
{
    const i32x8 weight = i32x8_halve_lower(axis->lod);
    if (path != FOOTPRINTS_INTERIOR || !same_two_levels(axis->lod, weight)) {
        add_samples_apart(binding, middle, axis, codec, path, sums);
        return;
    }
    const struct rhw_mip *const fine = mip_at(binding->texture, axis->lod[0] >> 16);
    struct axis_samples samples;
    place_samples(binding, middle, axis, fine, &samples);
    add_placed_samples(binding, fine, &samples, weight, codec, sums);
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
