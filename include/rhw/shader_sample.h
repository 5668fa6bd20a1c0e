// SPDX-License-Identifier: MIT
// Shader functions sample and fetch textures with these functions. shader.h includes this header.
#ifndef RHW_SHADER_SAMPLE_H
#define RHW_SHADER_SAMPLE_H

#include "base.h"
#include "shader_vector.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

struct rhw_fragment;

struct rhw_bindings;

/// A request says what 8 lanes ask of a texture. Zero the struct, then set the members that are needed. A member that
/// is NULL asks for nothing, so later versions can add members. The request and what it points to are read during the
/// call.
struct rhw_sample_request {
    /// [component]: as many as the slot's texture asks for. A 2D texture takes u to the right and v downwards: (0,0) is
    /// the top left corner of the first texel in memory, (1,1) the bottom right corner of the last texel. A 1D texture
    /// takes u, and a 3D texture u, v and w. A CUBE takes a direction of any length but 0. An array takes one component
    /// more, the layer, which is rounded to the nearest whole number, ties to even, and clamped to the array. Every
    /// number is allowed. A number that is not finite samples somewhere in the texture.
    const rhw_float *coordinates;
    /// Derivatives of the coordinates per pixel, without the layer: first those by x, then those by y. For a 2D texture
    /// they are du/dx, dv/dx, du/dy, dv/dy. The level of detail is log2 of the longer axis of the footprint (OpenGL ES
    /// 3.0 §3.8.10). With max_anisotropy the samples lie along that axis. The gradient may be NULL.
    const rhw_float *gradient;
    /// [1]: the level of detail, read if `gradient` is NULL; NULL means 0.
    const rhw_float *lod;
    /// [1]: the number that a sampler compares texels with. It is clamped to 0..1 if texels are UNORM. NULL means 0.
    const rhw_float *reference;
    /// [component]: an offset for u, v and w as the texture has them, in texels of each level that is read. It is added
    /// before the address mode applies. Vulkan asks for −8..7; here it is clamped to ±32768. A cube has no offset and
    /// ignores it. The offset may be NULL.
    const rhw_int *offset;
    /// [1]: a number that is added to the level of detail of `gradient` or `lod`, beside the sampler's own bias and
    /// before the sampler's limits. The bias may be NULL.
    const rhw_float *bias;
};

/// Sample slot `slot`, 0..RHW_MAX_TEXTURES − 1, of the textures that a group has. Shader functions call this, on the
/// thread that runs them. The sampler's bias and limits apply to the level of detail. A slot without a texture gives 0,
/// 0, 0, 1. The texel of a lane does not depend on other lanes.
///
/// sRGB texels are decoded before they are filtered. In a plain 2D texture the decoded values have 15 bits if both
/// filters are LINEAR and no border is met: they are off by at most 1/20 of the distance between two codes, and 0 and
/// 255 are exact.
RHW_API void rhw_sample(const struct rhw_bindings *textures, int slot,
                        const struct rhw_sample_request *request, rhw_float texel[4]);

/// Gather channel `channel`, 0..3, of the four texels that a linear filter would mix in level 0 of a 2D texture, a
/// cube, or an array of these. Their order is below left, below right, above right, above left, where v grows downwards
/// (Vulkan 1.3, "Texel Gathering"). A sampler that compares gives 1 or 0 for each texel, whatever the channel. The
/// request's level and gradient do not matter. A texture of another kind gives zeros.
RHW_API void rhw_sample_gather(const struct rhw_bindings *textures, int slot,
                               const struct rhw_sample_request *request, int channel, rhw_float texel[4]);

/// Fetch the texel at whole coordinates of a level, unfiltered. `level` is [1]; NULL means level 0. `at` has x, y and z
/// as far as the kind of texture has them, and the layer of an array; for a cube it has x, y and 6 × cube + face.
/// Outside of the level, and if there is no such level, the texel is 0 in the channels that the format has
/// (robustImageAccess2). Channels that the format lacks are 0, 0, 0, 1.
RHW_API void rhw_sample_fetch(const struct rhw_bindings *textures, int slot, const rhw_int *at,
                              const rhw_int *level, rhw_float texel[4]);

/// Fetch the texel of one sample of a multisampled texture, unfiltered, in the channels that rhw_sample_fetch gives.
/// `at` has x and y, and the layer of an array. The texel is 0 if there is no such sample or layer. This function takes
/// a slot with another texture for a slot without one. All other functions but rhw_sample_size, rhw_sample_levels and
/// rhw_sample_samples take a slot with a multisampled texture for a slot without one.
RHW_API void rhw_sample_fetch_sample(const struct rhw_bindings *textures, int slot, const rhw_int *at,
                                     const rhw_int *sample, rhw_float texel[4]);

/// Set lod[0] to the level that rhw_sample would read for the request; a fraction lies between two levels. Set lod[1]
/// to the level of detail with the sampler's bias, before any limit (Vulkan 1.3, OpImageQueryLod). Both are 0 in a slot
/// without a texture.
RHW_API void rhw_sample_query_lod(const struct rhw_bindings *textures, int slot,
                                  const struct rhw_sample_request *request, rhw_float lod[2]);

/// Set `size` to the width, the height and the number of slices or layers of a level; a cube has six layers. `level` is
/// [1]; NULL means level 0. Dimensions that the kind of texture lacks are 1. All are 0 if there is no such level, and
/// in a slot without a texture.
RHW_API void rhw_sample_size(const struct rhw_bindings *textures, int slot, const rhw_int *level,
                             rhw_int size[3]);

/// Sample, by a sampler that compares, columns × rows footprints one texel apart, as percentage-closer filters do. Set
/// parts[row * columns + column] to the texel[0] of rhw_sample, for the request with (column, row) added to its offset;
/// a request without an offset has offset 0. The bits are those of single samples. A shadow map takes a fraction of the
/// time of single samples, because its footprints share texels and comparisons: one level of a plain 2D texture of
/// 32-bit floats with one channel, with linear filters and without a border. A slot without a texture gives zeros.
RHW_API void rhw_sample_compare_window(const struct rhw_bindings *textures, int slot,
                                       const struct rhw_sample_request *request, int columns, int rows,
                                       rhw_float *parts);

/// Sample as rhw_sample does, with a gradient.
static inline void rhw_sample_grad(const struct rhw_bindings *textures, int slot,
                                   const rhw_float *coordinates, const rhw_float *grad, rhw_float texel[4])
{
    const struct rhw_sample_request request = {coordinates,          grad,
                                               (const rhw_float *)0, (const rhw_float *)0,
                                               (const rhw_int *)0,   (const rhw_float *)0};
    rhw_sample(textures, slot, &request, texel);
}

/// Sample as rhw_sample does, at an explicit level of detail.
static inline void rhw_sample_lod(const struct rhw_bindings *textures, int slot, const rhw_float *coordinates,
                                  rhw_float lod, rhw_float texel[4])
{
    const struct rhw_sample_request request = {
        coordinates,          (const rhw_float *)0, &lod,
        (const rhw_float *)0, (const rhw_int *)0,   (const rhw_float *)0};
    rhw_sample(textures, slot, &request, texel);
}

/// Sample as rhw_sample_grad does, `bias` levels coarser, or finer if `bias` is negative (OpenGL, texture() with a
/// bias; Vulkan 1.3, "Level-of-Detail Operation").
static inline void rhw_sample_bias(const struct rhw_bindings *textures, int slot,
                                   const rhw_float *coordinates, const rhw_float *grad, rhw_float bias,
                                   rhw_float texel[4])
{
    const struct rhw_sample_request request = {
        coordinates, grad, (const rhw_float *)0, (const rhw_float *)0, (const rhw_int *)0, &bias};
    rhw_sample(textures, slot, &request, texel);
}

/// Return the part of the footprint, 0..1, for which `reference compare texel` holds. The sampler must compare. The
/// level of detail follows from `grad`, as in rhw_sample_grad. A slot without a texture gives 0.
static inline rhw_float rhw_sample_compare_grad(const struct rhw_bindings *textures, int slot,
                                                const rhw_float *coordinates, rhw_float reference,
                                                const rhw_float *grad)
{
    const struct rhw_sample_request request = {
        coordinates, grad, (const rhw_float *)0, &reference, (const rhw_int *)0, (const rhw_float *)0};
    rhw_float texel[4];
    rhw_sample(textures, slot, &request, texel);
    return texel[0];
}

/// Return the part of the footprint, 0..1, for which `reference compare texel` holds, at an explicit level of detail.
/// The sampler must compare. A slot without a texture gives 0.
static inline rhw_float rhw_sample_compare_lod(const struct rhw_bindings *textures, int slot,
                                               const rhw_float *coordinates, rhw_float reference,
                                               rhw_float lod)
{
    const struct rhw_sample_request request = {coordinates, (const rhw_float *)0, &lod,
                                               &reference,  (const rhw_int *)0,   (const rhw_float *)0};
    rhw_float texel[4];
    rhw_sample(textures, slot, &request, texel);
    return texel[0];
}

/// Sample several texture slots for all `count` groups, 1..RHW_MAX_GROUPS, of one call of a fragment function, as
/// rhw_sample_grad does. The coordinates are varyings with derivatives: the components `at` and `at + 1`, and those
/// behind them if a slot's texture asks for more. RHW_COMPONENT gives the component of a struct's member.
///
/// Bit n of `slots`, which has at least one bit, samples slot n of group g into texels[g * stride + n]. `stride` is
/// above the highest slot. No other texel is written. The bits are those of single samples. The function takes less
/// time than one group after the other: it computes the levels of detail of all groups together, and 8-bit textures of
/// one size with equal samplers, as a material usually has them, share their footprints, while the texels of all groups
/// are loaded at once. `texels` may be groups->color with a stride of RHW_MAX_COLOR_ATTACHMENTS; target n then gets the
/// texel of slot n.
RHW_API void rhw_sample_groups(const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                               rhw_float (*texels)[4], int stride);

RHW_QUIET_END

#endif

struct rhw_bindings;

/// Return the number of mip levels of a slot's texture, or 0 in a slot without one.
RHW_API int rhw_sample_levels(const struct rhw_bindings *textures, int slot);

/// Return the number of samples in a texel of a slot's texture: 1 if the texture is not multisampled, and 0 in a slot
/// without one (GLSL 4.60, textureSamples; SPIR-V, OpImageQuerySamples).
RHW_API int rhw_sample_samples(const struct rhw_bindings *textures, int slot);

#endif
