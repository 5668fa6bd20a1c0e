// SPDX-License-Identifier: MIT
// Texture sampling from shader functions. Included by shader.h.
#ifndef RHW_SHADER_SAMPLE_H
#define RHW_SHADER_SAMPLE_H

#include "base.h"
#include "shader_vector.h"

#if RHW_HAS_LANES

RHW_QUIET_BEGIN

struct rhw_fragment;

/// The textures and samplers of a draw, by slot: the library's own, and valid while the shader function runs that got
/// them.
struct rhw_bindings;

/// What 8 lanes ask of a texture. Zero the struct, then set what is needed: what is NULL is not asked for, and members
/// that come later will be NULL where a program is compiled anew.
struct rhw_sample_request {
    /// As many components as the slot's texture asks for. 2D: u right, v down. (0,0) is the top left corner of the
    /// first texel in memory, (1,1) the bottom right corner of the last. 1D: u. 3D: u, v, w. CUBE: a direction of any
    /// length but 0. An array has one more, the layer: rounded to the nearest whole number, ties to even, and held
    /// within the array. Any number is allowed; one that is not finite samples somewhere in the texture.
    const rhw_float *coordinates;
    /// Their derivatives per pixel without the layer's, those by x before those by y, of 2D du/dx, dv/dx, du/dy, dv/dy;
    /// from which the level of detail follows (OpenGL ES 3.0 §3.8.10: log2 of the longer of the two footprint axes),
    /// and with max_anisotropy the samples along that axis; or NULL.
    const rhw_float *gradient;
    const rhw_float *lod; ///< [1], read where `gradient` is NULL: the level of detail itself; NULL: 0
    /// [1], read by samplers that compare: what texels are compared with, held to 0..1 where texels are UNORM; NULL: 0
    const rhw_float *reference;
    /// In texels of each level that is read, added before the address mode applies; a component for u, v and w as the
    /// texture has them; cubes have none and do not read it. Vulkan asks for −8..7; held to ±32768 here. NULL
    const rhw_int *offset;
    /// [1]: added to the level of detail, that of the gradient or the one given, before limits; the sampler's own bias
    /// is added too. NULL
    const rhw_float *bias;
};

/// Samples slot `slot`, 0..RHW_MAX_TEXTURES − 1, of a group's `textures`; for shader functions, on the thread that runs
/// them. `request` is read during the call alone, with all it points at. The sampler's bias and limits apply to the
/// level of detail. sRGB texels are decoded before they are filtered; of plain 2D textures, where both filters are
/// LINEAR and no border is met, they are held to 15 bits: at most 1/20 of the distance between two codes off, with 0
/// and 255 exact. A slot without a texture gives 0, 0, 0, 1. A lane's texel does not depend on other lanes.
RHW_API void rhw_sample(const struct rhw_bindings *textures, int slot,
                        const struct rhw_sample_request *request, rhw_float texel[4]);

/// Channel `channel`, 0..3, of the four texels that a linear filter would mix in level 0 of a 2D texture, a cube or an
/// array of these: below left, below right, above right, above left as v grows downwards (Vulkan 1.3, "Texel
/// Gathering"). By a sampler that compares each is 1 or 0, whatever the channel. The request's level and gradient do
/// not matter. Textures of other kinds give zeros.
RHW_API void rhw_sample_gather(const struct rhw_bindings *textures, int slot,
                               const struct rhw_sample_request *request, int channel, rhw_float texel[4]);

/// The texel at whole coordinates of a level ([1]; NULL: 0), unfiltered: `at` has x, y and z as the kind has them, and
/// the layer of an array; of a cube x, y and 6 × cube + face. Outside of the level, or where there is no such level, it
/// is 0 in the channels that the format has (robustImageAccess2); those that it lacks are 0, 0, 0, 1 as ever.
RHW_API void rhw_sample_fetch(const struct rhw_bindings *textures, int slot, const rhw_int *at,
                              const rhw_int *level, rhw_float texel[4]);

/// The texel at x, y of `at`, and of an array the layer, in one sample of a multisampled texture, unfiltered, as
/// rhw_sample_fetch gives it; zeros where there is no such sample or layer. The other functions but rhw_sample_size,
/// rhw_sample_levels and rhw_sample_samples take a slot with a multisampled texture for one without, and this one a
/// slot with any other.
RHW_API void rhw_sample_fetch_sample(const struct rhw_bindings *textures, int slot, const rhw_int *at,
                                     const rhw_int *sample, rhw_float texel[4]);

/// The level that rhw_sample would read for the request, between two of them with a fraction, and the level of detail
/// with the sampler's bias, before any limit (Vulkan 1.3, OpImageQueryLod). Zeros in a slot without a texture.
RHW_API void rhw_sample_query_lod(const struct rhw_bindings *textures, int slot,
                                  const struct rhw_sample_request *request, rhw_float lod[2]);

/// Width, height and, of a 3D texture, slices of a level ([1]; NULL: 0), else layers, six for each cube. What the kind
/// lacks is 1. Zeros where there is no such level, and in a slot without a texture.
RHW_API void rhw_sample_size(const struct rhw_bindings *textures, int slot, const rhw_int *level,
                             rhw_int size[3]);

/// rhw_sample by a sampler that compares, of columns × rows footprints a texel apart, as percentage-closer filters take
/// them: parts[row * columns + column] is texel[0] of the request whose offset is (column, row) more, or that where it
/// has none. The same bits as one by one. Those of shadow maps share texels and what is compared, in a fraction of the
/// time: one level of 32-bit floats with one channel, plain 2D, linear filters, no border. A slot without a texture
/// gives zeros.
RHW_API void rhw_sample_compare_window(const struct rhw_bindings *textures, int slot,
                                       const struct rhw_sample_request *request, int columns, int rows,
                                       rhw_float *parts);

/// rhw_sample with a gradient.
static inline void rhw_sample_grad(const struct rhw_bindings *textures, int slot,
                                   const rhw_float *coordinates, const rhw_float *grad, rhw_float texel[4])
{
    const struct rhw_sample_request request = {coordinates,          grad,
                                               (const rhw_float *)0, (const rhw_float *)0,
                                               (const rhw_int *)0,   (const rhw_float *)0};
    rhw_sample(textures, slot, &request, texel);
}

/// rhw_sample at an explicit level of detail.
static inline void rhw_sample_lod(const struct rhw_bindings *textures, int slot, const rhw_float *coordinates,
                                  rhw_float lod, rhw_float texel[4])
{
    const struct rhw_sample_request request = {
        coordinates,          (const rhw_float *)0, &lod,
        (const rhw_float *)0, (const rhw_int *)0,   (const rhw_float *)0};
    rhw_sample(textures, slot, &request, texel);
}

/// rhw_sample_grad, `bias` levels coarser or, where it is negative, finer (OpenGL's texture() with a bias, Vulkan 1.3
/// "Level-of-Detail Operation").
static inline void rhw_sample_bias(const struct rhw_bindings *textures, int slot,
                                   const rhw_float *coordinates, const rhw_float *grad, rhw_float bias,
                                   rhw_float texel[4])
{
    const struct rhw_sample_request request = {
        coordinates, grad, (const rhw_float *)0, (const rhw_float *)0, (const rhw_int *)0, &bias};
    rhw_sample(textures, slot, &request, texel);
}

/// Sampling by a sampler that compares: the part of the footprint, 0..1, for which `reference compare texel` holds; 0
/// in a slot without a texture. The level of detail follows from `grad`, as in rhw_sample_grad.
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

/// The same at an explicit level of detail.
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

/// rhw_sample_grad of several texture slots for `count` groups (1..RHW_MAX_GROUPS) of one call of a fragment function,
/// at coordinates that are varyings with derivatives: components `at` (RHW_COMPONENT of a struct's member) and `at +
/// 1`, and those behind them where a slot's texture asks for more. Bit n of `slots` (at least one) samples slot n of
/// group g into texels[g * stride + n], the same bits as by itself; `stride` is above the highest slot, and no other
/// texel is written. In less time than one group after the other: levels of detail are worked out for all groups
/// together, and textures of 8 bits with the same size and equal samplers, as those of one material usually are, share
/// their footprints while the texels of all groups are on their way at once. groups->color with a stride of
/// RHW_MAX_COLOR_ATTACHMENTS is allowed: slot n is then what target n gets.
RHW_API void rhw_sample_groups(const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                               rhw_float (*texels)[4], int stride);

RHW_QUIET_END

#endif

struct rhw_bindings;

/// Mip levels of a slot's texture; 0 in a slot without one.
RHW_API int rhw_sample_levels(const struct rhw_bindings *textures, int slot);
/// Samples of a texel of a slot's texture, 1 where it is not multisampled; 0 in a slot without one (GLSL 4.60
/// textureSamples, SPIR-V OpImageQuerySamples).
RHW_API int rhw_sample_samples(const struct rhw_bindings *textures, int slot);

#endif
