// SPDX-License-Identifier: MIT
// Anisotropic filtering (Vulkan 1.3, "Scale Factor Operation" and "Texel Anisotropic Filtering"). The footprint of a
// pixel is rho_max texels long and rho_min wide. η is min(rho_max / rho_min, the sampler's most), and N is η rounded
// up. N samples stand along the footprint's longer axis, i / (N + 1) − 1/2 of it from the middle for i = 1..N, at the
// level of detail log2(rho_max / η), and are averaged. Each is an isotropic sample by the way that the texture and the
// sampler have, fixed point included.
#ifndef RHW_ANISOTROPY_H
#define RHW_ANISOTROPY_H

#include "filter_general.h"

enum { MOST_COMPONENTS = 4 };

struct long_axis {
    f32x8 count; // N of each lane
    f32x8 level; // level of detail, before the sampler's bias and limits
    // Change of coordinates along the axis, per pixel. The layer's is 0.
    f32x8 change[MOST_COMPONENTS];
};

// Find the axis of footprints whose squared lengths in texels are x and y, of a texture with so many components.
RHW_INLINE void find_longer_axis(const struct rhw_binding_data *binding,
                                 const struct rhw_sample_request *request, f32x8 x, f32x8 y, int components,
                                 struct long_axis *axis)
{
    const f32x8 *const by_x = request->gradient, *const by_y = by_x + components;
    const i32x8 along_y = rhw_less(x, y);
    const f32x8 longer = rhw_select(along_y, y, x), shorter = rhw_select(along_y, x, y);
    // The ratio stays 1 where both are 0, equal or NaN.
    const f32x8 ratio = rhw_select(rhw_less(shorter, longer), rhw_sqrt(longer / shorter), rhw_splat(1.0f));
    const f32x8 eta = rhw_min(ratio, rhw_splat(binding->sampler->def.max_anisotropy));
    axis->count = rhw_ceil(eta);
    axis->level = half_log2(longer / (eta * eta)) + requested_bias(request);
    for (int i = 0; i < MOST_COMPONENTS; i++) {
        axis->change[i] = i < components ? rhw_select(along_y, by_y[i], by_x[i]) : rhw_splat(0.0f);
    }
}

static inline void find_long_axis(const struct rhw_binding_data *binding,
                                  const struct rhw_sample_request *request, struct long_axis *axis)
{
    const struct rhw_texture_data *const texture = binding->texture;
    const int components = spatial_components(texture);
    const f32x8 x = squared_length(texture, request->coordinates, request->gradient);
    const f32x8 y = squared_length(texture, request->coordinates, request->gradient + components);
    find_longer_axis(binding, request, x, y, components, axis);
}

// Return the largest of small whole numbers.
static inline int largest(f32x8 count)
{
    const i32x8 whole = rhw_int_from_float_unchecked(count);
    int most = 1;
    for (int i = 0; i < RHW_LANES; i++) {
        most = whole[i] > most ? whole[i] : most;
    }
    return most;
}

// Make an average of what n samples have come to and one more. It leaves equal samples as they are.
static inline void add_sample(const struct rhw_sampler_def *def, int n, i32x8 counts, const f32x8 sample[4],
                              f32x8 texel[4])
{
    const float part = 1.0f / (float)(n + 1);
    for (int c = 0; c < 4; c++) {
        const f32x8 both = def->reduction == RHW_REDUCTION_AVERAGE
                               ? texel[c] + (sample[c] - texel[c]) * part
                               : reduced(def->reduction, texel[c], sample[c]);
        texel[c] = rhw_select(counts, both, texel[c]);
    }
}

static void sample_anisotropic(const struct rhw_binding_data *binding,
                               const struct rhw_sample_request *request, f32x8 texel[4])
{
    rhw_sample_function *const sample = request->offset ? sample_general : binding->isotropic;
    if (!request->gradient) {
        sample(binding, request, texel);
        return;
    }
    const struct rhw_texture_data *const texture = binding->texture;
    const int components = spatial_components(texture) + texture->shape.is_array;
    struct long_axis axis;
    find_long_axis(binding, request, &axis);
    const int most = largest(axis.count);
    for (int n = 0; n < most; n++) {
        const f32x8 along = rhw_splat((float)(n + 1)) / (axis.count + 1.0f) - 0.5f;
        f32x8 at[MOST_COMPONENTS], next[4];
        for (int i = 0; i < components; i++) {
            at[i] = request->coordinates[i] + axis.change[i] * along;
        }
        struct rhw_sample_request one = *request;
        one.coordinates = at;
        one.gradient = NULL;
        one.lod = &axis.level;
        one.bias = NULL;
        sample(binding, &one, n == 0 ? texel : next);
        if (n > 0) {
            add_sample(&binding->sampler->def, n, rhw_less(rhw_splat((float)n), axis.count), next, texel);
        }
    }
}

// Sample a request with a bias: its level of detail is worked out and given.
static void sample_biased(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                          f32x8 texel[4])
{
    rhw_sample_function *const sample = request->offset ? binding->sample_offset : binding->sample;
    if (request->gradient && binding->sampler->def.max_anisotropy > 1) {
        sample(binding, request, texel); // the function finds the level for its long axis
        return;
    }
    const f32x8 level = requested_level(binding->texture, request);
    struct rhw_sample_request given = *request;
    given.gradient = given.bias = NULL;
    given.lod = &level;
    sample(binding, &given, texel);
}

#endif
