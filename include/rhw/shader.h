// SPDX-License-Identifier: MIT
// Shaders are written with this header: 8-lane vectors, the groups that a shader function receives, texture sampling
// and maths. It is plain C on the compiler's vector types, so one source serves every instruction set.
//
// Compile shaders with -ffp-contract=off (the CMake and pkg-config packages add it). A fused multiply-add would make
// their bytes depend on the machine. rhw_pipeline_create reports where the flag is missing. shader_lanes.h refuses
// -ffast-math and flags like it.
#ifndef RHW_SHADER_H
#define RHW_SHADER_H

#include "shader_lanes.h"
#include "types.h"

/// The textures, samplers and storage that are bound at a draw, by slot. The library owns them. They are valid until
/// the shader function returns that received them. rhw_sample and functions like it read them.
struct rhw_bindings;

/// Return true if the program gives up the work that is under way (rhw_context_set_goes_on). A function that may take
/// long calls this now and then, and returns soon once it is true: what it has written is unspecified then. `bindings`
/// is the member of the group that the function received. A call takes some nanoseconds. On the thread that called the
/// library it asks the program, every 10 ms.
RHW_API bool rhw_work_is_given_up(const struct rhw_bindings *bindings);

#if RHW_HAS_LANES

/// 8 vertices. The library owns what the pointers point to, and the pointers are valid until the function returns. The
/// function reads the members up to `bindings` and `mask`, and writes the others.
struct rhw_vertex {
    const rhw_float (*attribute)[4];      ///< [attribute][component]
    rhw_int vertex_index, instance_index; ///< numbers that include the draw's base vertex and first instance
    const void *uniforms;
    const void *user;                     ///< rhw_program.user
    const struct rhw_bindings *bindings;
    rhw_float position[4];                ///< output: homogeneous clip coordinates X, Y, Z, W
    rhw_float *varying;                   ///< output: [component] of all varyings
    rhw_float *clip_distance, *cull_distance; ///< outputs: [distance], as many as the program has
    rhw_float point_size;                 ///< output if the program writes_point_size: pixels
    /// Input: −1. In a program with vertex_effects it is 0 in lanes that are no vertex of their own; effects of such
    /// lanes must not happen.
    rhw_int mask;
    rhw_int viewport_index, layer;        ///< outputs if the program writes_viewport_index, writes_layer
};

/// 8 fragments. Lanes outside of `mask` hold any values, finite or not, and the library ignores their results. The
/// library owns what the pointers point to, and the pointers are valid until the function returns.
struct rhw_fragment {
    const rhw_float *varying;        ///< [component] of all varyings
    const rhw_float *ddx, *ddy;      ///< [component]: d/dx and d/dy per pixel of varyings that asked for them
    const void *uniforms;
    const void *user;                ///< rhw_program.user
    const struct rhw_bindings *bindings;
    /// Output: [target][channel]. It is not initialized, but with RHW_USE_COLOR_INPUT it holds the targets' values on
    /// entry. The colours of the groups of one call stand one after the other, with RHW_MAX_COLOR_ATTACHMENTS targets
    /// each.
    rhw_float (*color)[4];
    rhw_int mask;                    ///< −1 for a live lane, 0 for a dead lane; clear lanes to discard them
    rhw_float depth;                 ///< output with RHW_USE_DEPTH; holds the interpolated depth on entry
    /// x and y in pixels from the top left, z, and 1/w. Centres of pixels are at .5, also if values are taken at a
    /// centroid. z is the depth that is tested, and that D32_FLOAT stores, bit for bit. Equal positions give equal z in
    /// every pipeline.
    rhw_float coord[4];
    rhw_int front_facing;            ///< −1 for a front face, 0 for a back face
    rhw_int primitive;               ///< number of the primitive in its draw and instance
    rhw_int instance;                ///< number of the instance, which includes first_instance
    rhw_int draw;                    ///< number of the draw in its pass
    rhw_float barycentric[3];        ///< a, b, c: weights of the vertices in space
    rhw_float barycentric_noperspective[3]; ///< r, s, t: weights of the vertices on the screen
    rhw_float barycentric_ddx[3], barycentric_ddy[3]; ///< change of a, b, c per pixel
    /// Input and output: the samples that are covered, one bit for each sample; bit 0 in a pass with one sample.
    /// Samples whose bits the function clears are not drawn.
    rhw_int sample_mask;
    rhw_int sample_id;
    rhw_float sample_position[2];    ///< place of the sample in the pixel, 0..1 from its top left
    /// Place in a point: 0, 0 at its top left corner and 1, 1 at the opposite corner. It is unspecified in lines and
    /// triangles.
    rhw_float point_coord[2];
    rhw_float depth_input;           ///< value of the depth attachment, with RHW_USE_DEPTH_INPUT
    rhw_int stencil_input;           ///< value of the stencil attachment, 0..255, with RHW_USE_STENCIL_INPUT
    rhw_int layer, viewport_index;   ///< layer and viewport of the primitive
    /// −1 if the triangle contains the square of the fragment's pixel, and 0 if not (Vulkan,
    /// VK_EXT_conservative_rasterization: FullyCoveredEXT). It is 0 for points, for lines, and without conservative
    /// rasterization. It is exact for the snapped triangle.
    rhw_int fully_covered;
};

#endif

/// One vertex, for the one-at-a-time form. Each member means what the member of struct rhw_vertex with the same name
/// means.
struct rhw_vertex1 {
    const float (*attribute)[4];
    int32_t vertex_index, instance_index;
    const void *uniforms;
    const void *user;
    const struct rhw_bindings *bindings;
    float position[4];
    float *varying;
    float *clip_distance, *cull_distance;
    float point_size;
    int32_t viewport_index, layer;
};

/// One fragment, for the one-at-a-time form. Each member means what the member of struct rhw_fragment with the same
/// name means, where a bool stands for lanes of 0 and −1. Setting `discard` does what clearing lanes of `mask` does.
struct rhw_fragment1 {
    const float *varying;
    const float *ddx, *ddy;
    const void *uniforms;
    const void *user;
    const struct rhw_bindings *bindings;
    float (*color)[4];
    bool discard; ///< output: true drops the fragment
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

#include "shader_binding.h"
#include "shader_bits_one.h"
#include "shader_compute.h"
#include "shader_one.h"
#include "shader_scalar.h"
#include "shader_varying.h"

#endif
