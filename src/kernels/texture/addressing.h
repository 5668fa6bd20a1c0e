// SPDX-License-Identifier: MIT
// The front of the general sampler: which layer, face and coordinates a request names in a texture of any kind, and how
// fast they change over the screen.
#ifndef RHW_ADDRESSING_H
#define RHW_ADDRESSING_H

#include "binding/binding.h"
#include "resource/sampler.h"
#include "resource/texture.h"
#include "cube.h"
#include "lod.h"
#include "depth_reference.h"
#include "wrap.h"

// What one request asks for, at any level.
struct lookup {
    const struct rhw_texture_data *texture;
    const struct rhw_sampler_data *sampler;
    int axes; // number of axes that are filtered along: u, v, w
    bool is_cube, border;
    enum rhw_address address[3];
    // Normalized coordinates in one period; those of a cube are on the face. They are in texels where the sampler says
    // so.
    f32x8 at[3];
    i32x8 slice; // the layer; of a cube the layer of its first face
    i32x8 face;  // face of a cube
    i32x8 offset[3];
    f32x8 reference;
};

// Return the components of a direction or a place, without the layer.
RHW_INLINE int spatial_components(const struct rhw_texture_data *texture)
{
    return rhw_texture_components(texture->shape.kind);
}

// Return the layer: the nearest one, of two the even one, and within the array (Vulkan 1.3, "(s,t,r,q,a) to (u,v,w,a)
// Transformation" and "Layer Selection"). NaN gives layer 0.
static inline i32x8 layer_of(const struct rhw_texture_data *texture, const f32x8 *coordinates)
{
    if (!texture->shape.is_array) {
        return i32x8_splat(0);
    }
    const int faces = texture->shape.kind == RHW_TEXTURE_CUBE ? 6 : 1;
    const int count = texture->shape.layers / faces;
    const f32x8 layer =
        rhw_clamp(coordinates[spatial_components(texture)], rhw_splat(0.0f), rhw_splat((float)(count - 1)));
    return faces * rhw_int_from_float_unchecked(rhw_round(layer));
}

static inline void look_up_cube(struct lookup *lookup, const f32x8 *direction)
{
    const struct cube_face face = face_of(direction);
    const struct face_axes axes = on_face(&face, direction);
    f32x8 st[2];
    face_coordinates(&axes, st);
    lookup->at[0] = rhw_saturate(st[0]);
    lookup->at[1] = rhw_saturate(st[1]);
    lookup->face = face.number;
}

static inline void look_up_place(struct lookup *lookup, const f32x8 *coordinates)
{
    const bool unnormalized = lookup->sampler->def.unnormalized;
    for (int i = 0; i < lookup->axes; i++) {
        lookup->at[i] = unnormalized ? coordinates[i] : fold_period(lookup->address[i], coordinates[i]);
    }
}

static inline void set_offsets(struct lookup *lookup, const i32x8 *offset)
{
    for (int i = 0; offset && !lookup->is_cube && i < lookup->axes; i++) {
        lookup->offset[i] = rhw_max_int(rhw_min_int(offset[i], i32x8_splat(0x8000)), i32x8_splat(-0x8000));
    }
}

static inline void look_up(const struct rhw_binding_data *binding, const struct rhw_sample_request *request,
                           struct lookup *lookup)
{
    const struct rhw_sampler_def *const def = &binding->sampler->def;
    const struct rhw_texture_data *const texture = binding->texture;
    const bool is_cube = texture->shape.kind == RHW_TEXTURE_CUBE;
    *lookup = (struct lookup){.texture = texture,
                              .sampler = binding->sampler,
                              .axes = is_cube ? 2 : spatial_components(texture),
                              .is_cube = is_cube,
                              .address = {def->address_u, def->address_v, def->address_w},
                              .slice = layer_of(texture, request->coordinates),
                              .reference = reference_of(texture->info, request)};
    for (int i = 0; i < lookup->axes; i++) {
        lookup->border |= !is_cube && lookup->address[i] == RHW_ADDRESS_BORDER;
    }
    set_offsets(lookup, request->offset);
    if (is_cube) {
        look_up_cube(lookup, request->coordinates);
    } else {
        look_up_place(lookup, request->coordinates);
    }
}

// Level of detail ------------------------------------------------------------------------------------

// Return the squared length, in texels of level 0, of the change of place along x or along y. `change` is by
// components.
static inline f32x8 squared_length(const struct rhw_texture_data *texture, const f32x8 *coordinates,
                                   const f32x8 *change)
{
    const float size[3] = {(float)texture->shape.width, (float)texture->shape.height,
                           (float)texture->shape.depth};
    if (texture->shape.kind == RHW_TEXTURE_CUBE) {
        const struct cube_face face = face_of(coordinates);
        const struct face_axes axes = on_face(&face, coordinates);
        f32x8 st[2];
        face_gradient(&face, &axes, change, st);
        const f32x8 s = st[0] * size[0], t = st[1] * size[0];
        return s * s + t * t;
    }
    f32x8 sum = rhw_splat(0.0f);
    for (int i = 0; i < spatial_components(texture); i++) {
        const f32x8 length = change[i] * size[i];
        sum += length * length;
    }
    return sum;
}

static inline f32x8 requested_bias(const struct rhw_sample_request *request)
{
    return request->bias ? *request->bias : rhw_splat(0.0f);
}

// Return the level of detail that the request names, before the sampler's bias and limits.
static inline f32x8 requested_level(const struct rhw_texture_data *texture,
                                    const struct rhw_sample_request *request)
{
    if (!request->gradient) {
        return (request->lod ? *request->lod : rhw_splat(0.0f)) + requested_bias(request);
    }
    const f32x8 *const gradient = request->gradient;
    const f32x8 x = squared_length(texture, request->coordinates, gradient);
    const f32x8 y = squared_length(texture, request->coordinates, gradient + spatial_components(texture));
    return half_log2(rhw_max(x, y)) + requested_bias(request);
}

// The level of detail as a sampler reads it: `limited` by the sampler's own limits, `within` these and the levels there
// are.
struct lane_lod {
    f32x8 limited, within;
};

static inline struct lane_lod limit_level(const struct rhw_texture_data *texture,
                                          const struct rhw_sampler_data *sampler, f32x8 requested)
{
    const struct rhw_sampler_def *const def = &sampler->def;
    const f32x8 limited =
        rhw_clamp(requested + def->lod_bias, rhw_splat(def->lod_min), rhw_splat(def->lod_max));
    return (struct lane_lod){
        limited, rhw_clamp(limited, rhw_splat(0.0f), rhw_splat((float)last_level(texture, sampler)))};
}

// Return the level that is read, or the finer one of two, and the weight of the next.
static inline f32x8 first_level(const struct rhw_sampler_data *sampler, f32x8 within, f32x8 *fraction)
{
    const bool blended = sampler->def.mip_filter == RHW_MIP_FILTER_LINEAR;
    const f32x8 zero = rhw_splat(0.0f);
    const f32x8 level = blended ? rhw_floor(within) : rhw_max(rhw_ceil(within - 0.5f), zero);
    *fraction = blended ? within - level : zero;
    return level;
}

#endif
