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
    /// [2]: u right, v down. (0,0) is the top left corner of the first texel in memory, (1,1) the bottom right corner
    /// of the last. Any number is allowed; one that is not finite samples somewhere in the texture. More components are
    /// reserved for textures of other dimensions: a direction, a depth, a layer.
    const rhw_float *coordinates;
    /// [4]: du/dx, dv/dx, du/dy, dv/dy per pixel, from which the level of detail follows (OpenGL ES 3.0 §3.8.10: log2
    /// of the longer of the two footprint axes), or NULL. More are reserved, by x before by y.
    const rhw_float *gradient;
    const rhw_float *lod; ///< [1], read where `gradient` is NULL: the level of detail itself; NULL: 0
    /// [1], read by samplers that compare: what texels are compared with, held to 0..1 where texels are UNORM; NULL: 0
    const rhw_float *reference;
    const rhw_int *offset; ///< [2], reserved for offsets in texels: not read; NULL
};

/// Samples slot `slot`, 0..RHW_MAX_TEXTURES − 1, of a group's `textures`; for shader functions, on the thread that runs
/// them. `request` is read during the call alone, with all it points at. The sampler's bias and limits apply to the
/// level of detail. sRGB texels are decoded before they are filtered, and where both filters are LINEAR and no border
/// is met they are held to 15 bits: at most 1/20 of the distance between two codes off, with 0 and 255 exact. A slot
/// without a texture gives 0, 0, 0, 1. A lane's texel does not depend on other lanes.
RHW_API void rhw_sample(const struct rhw_bindings *textures, int slot,
                        const struct rhw_sample_request *request, rhw_float texel[4]);

/// rhw_sample with a gradient.
static inline void rhw_sample_grad(const struct rhw_bindings *textures, int slot, const rhw_float uv[2],
                                   const rhw_float grad[4], rhw_float texel[4])
{
    const struct rhw_sample_request request = {uv, grad, (const rhw_float *)0, (const rhw_float *)0,
                                               (const rhw_int *)0};
    rhw_sample(textures, slot, &request, texel);
}

/// rhw_sample at an explicit level of detail.
static inline void rhw_sample_lod(const struct rhw_bindings *textures, int slot, const rhw_float uv[2],
                                  rhw_float lod, rhw_float texel[4])
{
    const struct rhw_sample_request request = {uv, (const rhw_float *)0, &lod, (const rhw_float *)0,
                                               (const rhw_int *)0};
    rhw_sample(textures, slot, &request, texel);
}

/// Sampling by a sampler that compares: the part of the footprint, 0..1, for which `reference compare texel` holds; 0 in
/// a slot without a texture. The level of detail follows from `grad`, as in rhw_sample_grad.
static inline rhw_float rhw_sample_compare_grad(const struct rhw_bindings *textures, int slot,
                                                const rhw_float uv[2], rhw_float reference,
                                                const rhw_float grad[4])
{
    const struct rhw_sample_request request = {uv, grad, (const rhw_float *)0, &reference,
                                               (const rhw_int *)0};
    rhw_float texel[4];
    rhw_sample(textures, slot, &request, texel);
    return texel[0];
}

/// The same at an explicit level of detail.
static inline rhw_float rhw_sample_compare_lod(const struct rhw_bindings *textures, int slot,
                                               const rhw_float uv[2], rhw_float reference, rhw_float lod)
{
    const struct rhw_sample_request request = {uv, (const rhw_float *)0, &lod, &reference,
                                               (const rhw_int *)0};
    rhw_float texel[4];
    rhw_sample(textures, slot, &request, texel);
    return texel[0];
}

/// rhw_sample_grad of several texture slots for `count` groups (1..RHW_MAX_GROUPS) of one call of a fragment function,
/// at coordinates that are varyings with derivatives: components `at` and `at + 1`. Bit n of `slots` (at least one)
/// samples slot n of group g into texels[g * stride + n], the same bits as by itself; `stride` is above the highest
/// slot, and no other texel is written. In less time than one group after the other: levels of detail are worked out
/// for all groups together, and textures of 8 bits with the same size and equal samplers, as those of one material
/// usually are, share their footprints while the texels of all groups are on their way at once. groups->color with a
/// stride of RHW_MAX_COLOR_ATTACHMENTS is allowed: slot n is then what target n gets.
RHW_API void rhw_sample_groups(const struct rhw_fragment *groups, int count, uint32_t slots, int at,
                               rhw_float (*texels)[4], int stride);

RHW_QUIET_END

#endif

#endif
