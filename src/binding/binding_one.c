// SPDX-License-Identifier: MIT
// Sampling bindings in memory one at a time is a lane of the functions on 8, as sample_one.c does it for slots.
#include "sample_access.h"
#include "widened.h"

// Return the texture of a binding, of one sample or more. Return NULL where it is of none.
static const struct rhw_texture_data *texture_of(const struct rhw_binding *binding)
{
    return rhw_bound_texture(rhw_binding_textured(binding));
}

void rhw_binding_sample1(const struct rhw_binding *binding, const struct rhw_sample_request1 *request,
                         float texel[4])
{
    struct rhw_widened lanes;
    rhw_float texels[4];
    rhw_widen_request(texture_of(binding), request, &lanes);
    rhw_binding_sample(binding, &lanes.request, texels);
    rhw_first_lane(texels, 4, texel);
}

void rhw_binding_sample_compare_window1(const struct rhw_binding *binding,
                                        const struct rhw_sample_request1 *request, int columns, int rows,
                                        float *parts)
{
    for (int i = 0; i < columns * rows; i++) {
        struct rhw_sample_request1 shifted;
        int32_t offset[3];
        float texel[4];
        rhw_shift_request(texture_of(binding), request, i % columns, i / columns, offset, &shifted);
        rhw_binding_sample1(binding, &shifted, texel);
        parts[i] = texel[0];
    }
}

void rhw_binding_sample_gather1(const struct rhw_binding *binding, const struct rhw_sample_request1 *request,
                                int channel, float texel[4])
{
    struct rhw_widened lanes;
    rhw_float texels[4];
    rhw_widen_request(texture_of(binding), request, &lanes);
    rhw_binding_sample_gather(binding, &lanes.request, channel, texels);
    rhw_first_lane(texels, 4, texel);
}

void rhw_binding_sample_fetch1(const struct rhw_binding *binding, const int32_t *at, int32_t level,
                               float texel[4])
{
    const rhw_int levels = rhw_splat_int(level);
    rhw_int lanes[3];
    rhw_float texels[4];
    rhw_widen_place(texture_of(binding), at, lanes);
    rhw_binding_sample_fetch(binding, lanes, &levels, texels);
    rhw_first_lane(texels, 4, texel);
}

void rhw_binding_sample_fetch_sample1(const struct rhw_binding *binding, const int32_t *at, int32_t sample,
                                      float texel[4])
{
    const rhw_int samples = rhw_splat_int(sample);
    rhw_int lanes[3];
    rhw_float texels[4];
    rhw_widen_place(texture_of(binding), at, lanes);
    rhw_binding_sample_fetch_sample(binding, lanes, &samples, texels);
    rhw_first_lane(texels, 4, texel);
}

void rhw_binding_sample_query_lod1(const struct rhw_binding *binding,
                                   const struct rhw_sample_request1 *request, float lod[2])
{
    struct rhw_widened lanes;
    rhw_float lods[2];
    rhw_widen_request(texture_of(binding), request, &lanes);
    rhw_binding_sample_query_lod(binding, &lanes.request, lods);
    rhw_first_lane(lods, 2, lod);
}

void rhw_binding_sample_size1(const struct rhw_binding *binding, int32_t level, int32_t size[3])
{
    const rhw_int levels = rhw_splat_int(level);
    rhw_int lanes[3];
    rhw_binding_sample_size(binding, &levels, lanes);
    for (int i = 0; i < 3; i++) {
        size[i] = lanes[i][0];
    }
}
