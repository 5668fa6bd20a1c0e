// SPDX-License-Identifier: MIT
// Sampling one at a time is a lane of the functions on 8. These functions know how many components a texture asks for,
// which the caller's pointers do not say.
#include "sample_access.h"
#include "widened.h"

// Return the texture of a slot. Return NULL where the slot has none or does not exist.
static const struct rhw_texture_data *texture_of(const struct rhw_bindings *bindings, int slot)
{
    return (unsigned)slot < (unsigned)bindings->slot_count ? bindings->slot[slot].texture : NULL;
}

void rhw_sample1(const struct rhw_bindings *bindings, int slot, const struct rhw_sample_request1 *request,
                 float texel[4])
{
    struct rhw_widened lanes;
    rhw_float texels[4];
    rhw_widen_request(texture_of(bindings, slot), request, &lanes);
    rhw_sample(bindings, slot, &lanes.request, texels);
    rhw_first_lane(texels, 4, texel);
}

void rhw_sample_compare_window1(const struct rhw_bindings *bindings, int slot,
                                const struct rhw_sample_request1 *request, int columns, int rows,
                                float *parts)
{
    const struct rhw_texture_data *const texture = texture_of(bindings, slot);
    for (int i = 0; i < columns * rows; i++) {
        struct rhw_sample_request1 shifted;
        int32_t offset[3];
        float texel[4];
        rhw_shift_request(texture, request, i % columns, i / columns, offset, &shifted);
        rhw_sample1(bindings, slot, &shifted, texel);
        parts[i] = texel[0];
    }
}

void rhw_sample_gather1(const struct rhw_bindings *bindings, int slot,
                        const struct rhw_sample_request1 *request, int channel, float texel[4])
{
    struct rhw_widened lanes;
    rhw_float texels[4];
    rhw_widen_request(texture_of(bindings, slot), request, &lanes);
    rhw_sample_gather(bindings, slot, &lanes.request, channel, texels);
    rhw_first_lane(texels, 4, texel);
}

void rhw_sample_fetch1(const struct rhw_bindings *bindings, int slot, const int32_t *at, int32_t level,
                       float texel[4])
{
    rhw_int lanes[3];
    rhw_float texels[4];
    rhw_widen_place(texture_of(bindings, slot), at, lanes);
    const rhw_int levels = rhw_splat_int(level);
    rhw_sample_fetch(bindings, slot, lanes, &levels, texels);
    rhw_first_lane(texels, 4, texel);
}

void rhw_sample_fetch_sample1(const struct rhw_bindings *bindings, int slot, const int32_t *at,
                              int32_t sample, float texel[4])
{
    const bool is_there = (unsigned)slot < (unsigned)bindings->slot_count;
    rhw_int lanes[3];
    rhw_widen_place(rhw_bound_texture(is_there ? &bindings->slot[slot] : NULL), at, lanes);
    const rhw_int samples = rhw_splat_int(sample);
    rhw_float texels[4];
    rhw_sample_fetch_sample(bindings, slot, lanes, &samples, texels);
    rhw_first_lane(texels, 4, texel);
}

void rhw_sample_query_lod1(const struct rhw_bindings *bindings, int slot,
                           const struct rhw_sample_request1 *request, float lod[2])
{
    struct rhw_widened lanes;
    rhw_float lods[2];
    rhw_widen_request(texture_of(bindings, slot), request, &lanes);
    rhw_sample_query_lod(bindings, slot, &lanes.request, lods);
    rhw_first_lane(lods, 2, lod);
}

void rhw_sample_size1(const struct rhw_bindings *bindings, int slot, int32_t level, int32_t size[3])
{
    rhw_int lanes[3];
    const rhw_int levels = rhw_splat_int(level);
    rhw_sample_size(bindings, slot, &levels, lanes);
    for (int i = 0; i < 3; i++) {
        size[i] = lanes[i][0];
    }
}

void rhw_sample_groups1(const struct rhw_fragment1 *fragment, uint32_t slots, int at, float (*texels)[4])
{
    for (uint32_t todo = slots; todo != 0; todo &= todo - 1) {
        const int slot = __builtin_ctz(todo);
        const int components = rhw_components_of(texture_of(fragment->bindings, slot));
        float gradient[6];
        for (int i = 0; i < components; i++) {
            gradient[i] = fragment->ddx[at + i];
            gradient[components + i] = fragment->ddy[at + i];
        }
        const struct rhw_sample_request1 request = {.coordinates = &fragment->varying[at],
                                                    .gradient = gradient};
        rhw_sample1(fragment->bindings, slot, &request, texels[slot]);
    }
}
