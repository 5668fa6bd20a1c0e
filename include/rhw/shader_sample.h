// SPDX-License-Identifier: MIT
// Texture sampling from shader functions. Included by shader.h.
#ifndef RHW_SHADER_SAMPLE_H
#define RHW_SHADER_SAMPLE_H

/// What is bound to one texture slot: the function that samples it, chosen with the context's instruction
/// set, and its private data. Coordinates u right, v down: (0,0) is the top left corner of the first texel
/// in memory, (1,1) the bottom right corner of the last.
struct rhw_binding {
    /// `grad` = du/dx, dv/dx, du/dy, dv/dy per pixel, or NULL to sample at level `lod` (may be NULL: 0).
    void (*sample)(const struct rhw_binding *binding, const rhw_float uv[2], const rhw_float grad[4],
                   const rhw_float *lod, rhw_float texel[4]);
    const void *texture; ///< struct rhw_texture_data
    const void *sampler; ///< struct rhw_sampler_def
};

/// Samples with the level of detail that the derivatives give (OpenGL ES 3.0 §3.8.10: log2 of the longer
/// of the two footprint axes). sRGB texels are decoded before they are filtered.
static inline void rhw_sample_grad(const struct rhw_binding *binding, const rhw_float uv[2],
                                   const rhw_float grad[4], rhw_float texel[4])
{
    binding->sample(binding, uv, grad, (const rhw_float *)0, texel);
}

/// Samples at an explicit level of detail.
static inline void rhw_sample_lod(const struct rhw_binding *binding, const rhw_float uv[2], rhw_float lod,
                                  rhw_float texel[4])
{
    binding->sample(binding, uv, (const rhw_float *)0, &lod, texel);
}

#endif
