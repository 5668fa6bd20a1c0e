// SPDX-License-Identifier: MIT
// Texture sampling from shader functions. Included by shader.h.
#ifndef RHW_SHADER_SAMPLE_H
#define RHW_SHADER_SAMPLE_H

#include "shader_vector.h"

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi" // 8 lanes stay inside inline functions; no ABI is crossed
#endif

struct rhw_fragment;

/// What is bound to one texture slot: the function that samples it, chosen with the context's instruction
/// set, and its private data. Coordinates u right, v down: (0,0) is the top left corner of the first texel
/// in memory, (1,1) the bottom right corner of the last.
struct rhw_binding {
    /// `grad` = du/dx, dv/dx, du/dy, dv/dy per pixel, or NULL to sample at level `lod` (may be NULL: 0).
    void (*sample)(const struct rhw_binding *binding, const rhw_float uv[2], const rhw_float grad[4],
                   const rhw_float *lod, rhw_float texel[4]);
    const void *texture; ///< private: struct rhw_texture_data
    const void *sampler; ///< private: struct rhw_sampler_data
    /// Bit n of `slots`, which is not 0: the sample with derivatives of bindings[n] for `count` groups,
    /// 1..RHW_MAX_GROUPS, at components `at` and `at + 1` of their varyings; of group g
    /// into texels[g * stride + n].
    void (*sample_groups)(const struct rhw_binding *bindings, uint32_t slots,
                          const struct rhw_fragment *groups, int count, int at, rhw_float (*texels)[4],
                          int stride);
};

/// Samples with the level of detail that the derivatives give (OpenGL ES 3.0 §3.8.10: log2 of the longer
/// of the two footprint axes), plus the sampler's bias, within its limits. sRGB texels are decoded before
/// they are filtered, and where both filters are LINEAR and no border is met they are held to 15 bits: at most
/// 1/20 of the distance between two codes off, with 0 and 255 exact. Any coordinate is allowed; one that is not
/// finite samples somewhere in the texture.
static inline void rhw_sample_grad(const struct rhw_binding *binding, const rhw_float uv[2],
                                   const rhw_float grad[4], rhw_float texel[4])
{
    binding->sample(binding, uv, grad, (const rhw_float *)0, texel);
}

/// Samples at an explicit level of detail, to which the sampler's bias and limits apply as well.
static inline void rhw_sample_lod(const struct rhw_binding *binding, const rhw_float uv[2], rhw_float lod,
                                  rhw_float texel[4])
{
    binding->sample(binding, uv, (const rhw_float *)0, &lod, texel);
}

/// rhw_sample_grad for one fragment: the same bits as a lane of it.
static inline void rhw_sample1_grad(const struct rhw_binding *binding, const float uv[2], const float grad[4],
                                    float texel[4])
{
    const rhw_float at[2] = {rhw_splat(uv[0]), rhw_splat(uv[1])};
    const rhw_float slope[4] = {rhw_splat(grad[0]), rhw_splat(grad[1]), rhw_splat(grad[2]),
                                rhw_splat(grad[3])};
    rhw_float lanes[4];
    rhw_sample_grad(binding, at, slope, lanes);
    for (int i = 0; i < 4; i++) {
        texel[i] = lanes[i][0];
    }
}

/// rhw_sample_lod for one fragment.
static inline void rhw_sample1_lod(const struct rhw_binding *binding, const float uv[2], float lod,
                                   float texel[4])
{
    const rhw_float at[2] = {rhw_splat(uv[0]), rhw_splat(uv[1])};
    rhw_float lanes[4];
    rhw_sample_lod(binding, at, rhw_splat(lod), lanes);
    for (int i = 0; i < 4; i++) {
        texel[i] = lanes[i][0];
    }
}

#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#endif
