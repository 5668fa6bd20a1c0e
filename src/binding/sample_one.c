// SPDX-License-Identifier: MIT
// Sampling one at a time is a lane of the functions on 8. These functions know how many components a slot's texture
// asks for, which the caller's pointers do not say.
#include "binding.h"
#include "resource/texture.h"

#include <string.h>

// A request of one lane, put into all lanes.
struct widened {
    rhw_float coordinates[4], gradient[6], lod, reference, bias;
    rhw_int offset[3];
    struct rhw_sample_request request;
};

// Return the texture of a slot. Return NULL where the slot has none or does not exist.
static const struct rhw_texture_data *texture_of(const struct rhw_bindings *bindings, int slot)
{
    return (unsigned)slot < (unsigned)bindings->slot_count ? bindings->slot[slot].texture : NULL;
}

// Return the number of components of a texture's coordinates, without the layer.
static int components_of(const struct rhw_texture_data *texture)
{
    return texture ? rhw_texture_components(texture->shape.kind) : 0;
}

static rhw_float *widen_floats(const float *from, int count, rhw_float *to)
{
    for (int i = 0; from && i < count; i++) {
        to[i] = rhw_splat(from[i]);
    }
    return from ? to : NULL;
}

static void widen(const struct rhw_bindings *bindings, int slot, const struct rhw_sample_request1 *one,
                  struct widened *lanes)
{
    const struct rhw_texture_data *const texture = texture_of(bindings, slot);
    const int components = components_of(texture);
    const int layer = texture ? texture->shape.is_array : 0;
    const bool shifts = one->offset && texture && texture->shape.kind != RHW_TEXTURE_CUBE;
    for (int i = 0; shifts && i < components; i++) {
        lanes->offset[i] = rhw_splat_int(one->offset[i]);
    }
    lanes->request = (struct rhw_sample_request){
        .coordinates = widen_floats(one->coordinates, components + layer, lanes->coordinates),
        .gradient = widen_floats(one->gradient, 2 * components, lanes->gradient),
        .lod = widen_floats(one->lod, 1, &lanes->lod),
        .reference = widen_floats(one->reference, 1, &lanes->reference),
        .offset = shifts ? lanes->offset : NULL,
        .bias = widen_floats(one->bias, 1, &lanes->bias)};
}

static void first_lane(const rhw_float *lanes, int count, float *to)
{
    for (int i = 0; i < count; i++) {
        to[i] = lanes[i][0];
    }
}

void rhw_sample1(const struct rhw_bindings *bindings, int slot, const struct rhw_sample_request1 *request,
                 float texel[4])
{
    struct widened lanes;
    rhw_float texels[4];
    widen(bindings, slot, request, &lanes);
    rhw_sample(bindings, slot, &lanes.request, texels);
    first_lane(texels, 4, texel);
}

void rhw_sample_compare_window1(const struct rhw_bindings *bindings, int slot,
                                const struct rhw_sample_request1 *request, int columns, int rows,
                                float *parts)
{
    struct rhw_sample_request1 shifted = *request;
    const int axes = components_of(texture_of(bindings, slot));
    int32_t first[3] = {0}, offset[3];
    for (int i = 0; request->offset && i < axes; i++) {
        first[i] = request->offset[i];
    }
    memcpy(offset, first, sizeof offset);
    shifted.offset = offset;
    for (int i = 0; i < columns * rows; i++) {
        float texel[4];
        offset[0] = first[0] + i % columns;
        offset[1] = first[1] + i / columns;
        rhw_sample1(bindings, slot, &shifted, texel);
        parts[i] = texel[0];
    }
}

void rhw_sample_gather1(const struct rhw_bindings *bindings, int slot,
                        const struct rhw_sample_request1 *request, int channel, float texel[4])
{
    struct widened lanes;
    rhw_float texels[4];
    widen(bindings, slot, request, &lanes);
    rhw_sample_gather(bindings, slot, &lanes.request, channel, texels);
    first_lane(texels, 4, texel);
}

void rhw_sample_fetch1(const struct rhw_bindings *bindings, int slot, const int32_t *at, int32_t level,
                       float texel[4])
{
    const struct rhw_texture_data *const texture = texture_of(bindings, slot);
    const bool has_layer = texture && texture->shape.is_array && texture->shape.kind != RHW_TEXTURE_CUBE;
    const int components = components_of(texture) + has_layer;
    rhw_int lanes[3];
    rhw_float texels[4];
    for (int i = 0; i < components; i++) {
        lanes[i] = rhw_splat_int(at[i]);
    }
    const rhw_int levels = rhw_splat_int(level);
    rhw_sample_fetch(bindings, slot, lanes, &levels, texels);
    first_lane(texels, 4, texel);
}

void rhw_sample_fetch_sample1(const struct rhw_bindings *bindings, int slot, const int32_t *at,
                              int32_t sample, float texel[4])
{
    const bool has_layer = (unsigned)slot < (unsigned)bindings->slot_count &&
                           bindings->slot[slot].kind == RHW_BINDING_MULTISAMPLED &&
                           bindings->slot[slot].multisampled->shape.is_array;
    const rhw_int lanes[3] = {rhw_splat_int(at[0]), rhw_splat_int(at[1]),
                              rhw_splat_int(has_layer ? at[2] : 0)};
    const rhw_int samples = rhw_splat_int(sample);
    rhw_float texels[4];
    rhw_sample_fetch_sample(bindings, slot, lanes, &samples, texels);
    first_lane(texels, 4, texel);
}

void rhw_sample_query_lod1(const struct rhw_bindings *bindings, int slot,
                           const struct rhw_sample_request1 *request, float lod[2])
{
    struct widened lanes;
    rhw_float lods[2];
    widen(bindings, slot, request, &lanes);
    rhw_sample_query_lod(bindings, slot, &lanes.request, lods);
    first_lane(lods, 2, lod);
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
        const int components = components_of(texture_of(fragment->bindings, slot));
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
