// SPDX-License-Identifier: MIT
// A panorama becomes a cube whose levels show it as rougher and rougher surfaces mirror it. A panorama is the
// background too.
#include "rhw/shader.h"
#include "scene_shaders.h"
#include "tone.h"

#define ALWAYS_INLINE static inline __attribute__((always_inline))

static const float inverse_pi = 0.31830988618f;

// Find where a pixel of the pass looks, in the world.
ALWAYS_INLINE void look(const struct rhw_fragment *f, const struct scene_panorama_pass *p,
                        rhw_float direction[3])
{
    const rhw_float u = f->coord[0] * p->scale[0] + p->offset[0],
                    v = f->coord[1] * p->scale[1] + p->offset[1];
    for (int c = 0; c < 3; c++) {
        direction[c] = u * p->axes[0][c] + v * p->axes[1][c] + p->axes[2][c];
    }
    rhw_normalize3(direction, direction);
}

// Sample an equirectangular picture. Its middle column looks along +X, the column a quarter further along +Z, and its
// first row up.
ALWAYS_INLINE void sample_panorama(const struct rhw_fragment *f, const struct scene_panorama_pass *p,
                                   rhw_float color[3])
{
    rhw_float direction[3], turned[3], texel[4];
    look(f, p, direction);
    for (int r = 0; r < 3; r++) {
        turned[r] =
            p->turn[r][0] * direction[0] + p->turn[r][1] * direction[1] + p->turn[r][2] * direction[2];
    }
    const rhw_float uv[2] = {rhw_atan2(turned[2], turned[0]) * (0.5f * inverse_pi) + 0.5f,
                             rhw_acos(rhw_clamp(turned[1], -1.0f, 1.0f)) * inverse_pi};
    rhw_sample_lod(f->bindings, 0, uv, rhw_splat(p->level), texel);
    for (int c = 0; c < 3; c++) {
        color[c] = texel[c] * p->strength;
    }
}

static void panorama_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        sample_panorama(&groups[g], groups->uniforms, groups[g].color[0]);
        groups[g].color[0][3] = rhw_splat(1.0f);
    }
}

static void surroundings_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_panorama_pass *p = groups->uniforms;
    for (int g = 0; g < count; g++) {
        sample_panorama(&groups[g], p, groups[g].color[0]);
        scene_tone_map(p->tone, groups[g].color[0]);
        groups[g].color[0][3] = rhw_splat(1.0f);
    }
}

// Take the mean of the cube's light in directions around the pixel's, weighted by their cosine (J. Křivánek, M.
// Colbert, "Real-time shading with filtered importance sampling", 2008; B. Karis, "Real shading in Unreal Engine 4",
// 2013).
static void prefilter_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_panorama_pass *p = groups->uniforms;
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *f = &groups[g];
        rhw_float n[3], sum[3] = {rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(0.0f)};
        look(f, p, n);
        // `x` and `y` are two axes across (T. Duff et al., "Building an orthonormal basis, revisited", 2017).
        const rhw_float sign = rhw_copysign(rhw_splat(1.0f), n[2]);
        const rhw_float a = -1.0f / (sign + n[2]), b = n[0] * n[1] * a;
        const rhw_float x[3] = {1.0f + sign * n[0] * n[0] * a, sign * b, -sign * n[0]};
        const rhw_float y[3] = {b, sign + n[1] * n[1] * a, -n[1]};
        float weights = 0.0f;
        for (int i = 0; i < p->sample_count; i++) {
            const float *s = p->samples[i];
            rhw_float direction[3], texel[4];
            for (int c = 0; c < 3; c++) {
                direction[c] = x[c] * s[0] + y[c] * s[1] + n[c] * s[2];
            }
            rhw_sample_lod(f->bindings, 0, direction, rhw_splat(s[3]), texel);
            for (int c = 0; c < 3; c++) {
                sum[c] += texel[c] * s[2];
            }
            weights += s[2];
        }
        for (int c = 0; c < 3; c++) {
            f->color[0][c] = sum[c] * (1.0f / weights);
        }
        f->color[0][3] = rhw_splat(1.0f);
    }
}

const struct scene_panorama_shaders RHW_ISA_NAME(scene_panorama_shaders) = {
    .fragment = {panorama_fragment, prefilter_fragment, surroundings_fragment},
};
