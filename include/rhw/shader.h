// SPDX-License-Identifier: MIT
// What a shader is written with: 8-lane vectors, the groups a shader function receives, texture sampling
// and maths. Plain C on the compiler's vector types, so one source serves every instruction set.
//
// Compile shaders with -ffp-contract=off (the CMake and pkg-config packages add it): a fused multiply-add
// would make their bytes depend on the machine. rhw_pipeline_create tells where it is missing; -ffast-math and the like
// are errors here (arithmetic.h).
#ifndef RHW_SHADER_H
#define RHW_SHADER_H

#include "shader_lanes.h"
#include "types.h"

/// The bound textures and samplers; opaque to the shader, see rhw_sample.
struct rhw_bindings;

#if RHW_HAS_LANES

/// 8 vertices. Pointers stay valid for the call only.
struct rhw_vertex {
    const rhw_float (*attribute)[4]; ///< [attribute][component]
    rhw_int vertex_index, instance_index; ///< as the draw counts them: base vertex / first instance included
    const void *uniforms;
    const void *user; ///< of the program
    const struct rhw_bindings *textures; ///< see rhw_sample
    rhw_float position[4]; ///< out: homogeneous clip coordinates X, Y, Z, W
    rhw_float *varying;    ///< out: [component]
    rhw_float *clip_distance, *cull_distance; ///< out: [distance], as many as the program has
    rhw_float point_size;  ///< out, where the program writes_point_size: pixels
    rhw_int mask;          ///< −1; with vertex_effects 0 in lanes that are no vertex of their own: they have no effects
    rhw_int viewport_index, layer; ///< out, where the program writes_viewport_index, writes_layer
};

/// 8 fragments. Lanes outside `mask` carry finite or non-finite rubbish and their results are ignored.
struct rhw_fragment {
    const rhw_float *varying;        ///< [component]
    const rhw_float *ddx, *ddy;      ///< [component]: d/dx, d/dy per pixel, of varyings that asked for them
    const void *uniforms;
    const void *user;                ///< of the program
    const struct rhw_bindings *textures; ///< see rhw_sample
    rhw_float (*color)[4];           ///< out: [target][channel]; not initialized but with RHW_USE_COLOR_INPUT. Groups of one call have theirs
                                     ///< one after the other, RHW_MAX_COLOR_ATTACHMENTS targets each
    rhw_int mask;                    ///< −1 live, 0 dead; clear lanes to discard them
    rhw_float depth;                 ///< out, with RHW_USE_DEPTH; holds the interpolated depth on entry
    /// x, y in pixels from the top left (centres at .5, also where values are a centroid's), z, 1/w. z is the depth that is
    /// tested and, in D32_FLOAT, stored, bit for bit; equal positions give equal z in every pipeline.
    rhw_float coord[4];
    rhw_int front_facing;            ///< −1 or 0
    rhw_int primitive;               ///< triangle in its draw, of the instance
    rhw_int instance, draw;          ///< instance, first_instance included; draw in its pass
    rhw_float barycentric[3];        ///< a, b, c: weights in space
    rhw_float barycentric_noperspective[3]; ///< r, s, t: weights on the screen
    rhw_float barycentric_ddx[3], barycentric_ddy[3]; ///< of a, b, c per pixel
    rhw_int sample_mask;             ///< samples that are covered, a bit each, of one sample bit 0; what is cleared is not
                                     ///< drawn
    rhw_int sample_id;
    rhw_float sample_position[2];    ///< in the pixel: 0..1 from its top left
    rhw_float point_coord[2]; ///< on a point: 0, 0 at its top left corner, 1, 1 at the opposite; elsewhere rubbish
    rhw_float depth_input;    ///< with RHW_USE_DEPTH_INPUT: the depth attachment's value
    rhw_int stencil_input;    ///< with RHW_USE_STENCIL_INPUT: the stencil attachment's value, 0..255
    rhw_int layer, viewport_index; ///< of the primitive
    /// −1 where the triangle contains the square of the fragment's pixel, else 0; 0 without conservative rasterization, of
    /// points and of lines (Vulkan, VK_EXT_conservative_rasterization: FullyCoveredEXT). Exact for the snapped triangle.
    rhw_int fully_covered;
};

#endif

/// One vertex and one fragment, for the one-at-a-time form; fields as above.
struct rhw_vertex1 {
    const float (*attribute)[4];
    int32_t vertex_index, instance_index;
    const void *uniforms;
    const void *user;
    const struct rhw_bindings *textures;
    float position[4];
    float *varying;
    float *clip_distance, *cull_distance;
    float point_size;
    int32_t viewport_index, layer;
};

struct rhw_fragment1 {
    const float *varying;
    const float *ddx, *ddy;
    const void *uniforms;
    const void *user;
    const struct rhw_bindings *textures;
    float (*color)[4];
    bool discard; ///< out
    float depth;
    float coord[4];
    bool front_facing;
    int32_t primitive, instance, draw;
    float barycentric[3], barycentric_noperspective[3];
    float barycentric_ddx[3], barycentric_ddy[3];
    int32_t sample_mask, sample_id;
    float sample_position[2];
    float point_coord[2];
    float depth_input;
    int32_t stencil_input;
    int32_t layer, viewport_index;
    bool fully_covered;
};

#include "shader_one.h"
#include "shader_scalar.h"
#include "shader_varying.h"

#endif
