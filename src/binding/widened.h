// SPDX-License-Identifier: MIT
// What one lane asks of a texture, put into all lanes.
#ifndef RHW_WIDENED_H
#define RHW_WIDENED_H

#include "resource/texture.h"
#include "rhw/shader.h"

// A request of one lane, put into all lanes.
struct rhw_widened {
    rhw_float coordinates[4], gradient[6], lod, reference, bias;
    rhw_int offset[3];
    struct rhw_sample_request request;
};

// Return the number of components of a texture's coordinates, without the layer.
static inline int rhw_components_of(const struct rhw_texture_data *texture)
{
    return texture ? rhw_texture_components(texture->shape.kind) : 0;
}

static inline rhw_float *rhw_widen_floats(const float *from, int count, rhw_float *to)
{
    for (int i = 0; from && i < count; i++) {
        to[i] = rhw_splat(from[i]);
    }
    return from ? to : NULL;
}

// Widen a request to a texture. NULL stands for none, of which no coordinate is read.
static inline void rhw_widen_request(const struct rhw_texture_data *texture,
                                     const struct rhw_sample_request1 *one, struct rhw_widened *lanes)
{
    const int components = rhw_components_of(texture);
    const int layer = texture ? texture->shape.is_array : 0;
    const bool shifts = one->offset && texture && texture->shape.kind != RHW_TEXTURE_CUBE;
    for (int i = 0; shifts && i < components; i++) {
        lanes->offset[i] = rhw_splat_int(one->offset[i]);
    }
    lanes->request = (struct rhw_sample_request){
        .coordinates = rhw_widen_floats(one->coordinates, components + layer, lanes->coordinates),
        .gradient = rhw_widen_floats(one->gradient, 2 * components, lanes->gradient),
        .lod = rhw_widen_floats(one->lod, 1, &lanes->lod),
        .reference = rhw_widen_floats(one->reference, 1, &lanes->reference),
        .offset = shifts ? lanes->offset : NULL,
        .bias = rhw_widen_floats(one->bias, 1, &lanes->bias)};
}

static inline void rhw_first_lane(const rhw_float *lanes, int count, float *to)
{
    for (int i = 0; i < count; i++) {
        to[i] = lanes[i][0];
    }
}

// Put whole coordinates of a texture, with the layer, into all lanes.
static inline void rhw_widen_place(const struct rhw_texture_data *texture, const int32_t *at,
                                   rhw_int lanes[3])
{
    const bool has_layer = texture && texture->shape.is_array && texture->shape.kind != RHW_TEXTURE_CUBE;
    const int components = rhw_components_of(texture) + has_layer;
    for (int i = 0; i < 3; i++) {
        lanes[i] = rhw_splat_int(i < components ? at[i] : 0);
    }
}

// Put the request of one footprint of a window, whose coordinates are components of a texture, into `shifted`, with its
// offset.
static inline void rhw_shift_request(const struct rhw_texture_data *texture,
                                     const struct rhw_sample_request1 *request, int column, int row,
                                     int32_t offset[3], struct rhw_sample_request1 *shifted)
{
    const int axes = rhw_components_of(texture);
    for (int i = 0; i < 3; i++) {
        offset[i] = request->offset && i < axes ? request->offset[i] : 0;
    }
    offset[0] += column;
    offset[1] += row;
    *shifted = *request;
    shifted->offset = offset;
}

#endif
