// SPDX-License-Identifier: MIT
// Tone mapping on 8 lanes: from light without an upper end to what a display shows, 0..1, linear.
#ifndef SCENE_SHADERS_TONE_H
#define SCENE_SHADERS_TONE_H

#include "rhw/shader.h"
#include "scene_shaders.h"

/// Map tones by Khronos PBR Neutral (its specification, 2024). It is the identity for what is not bright, less the 4%
/// that a dielectric mirrors. Highlights are compressed towards white.
static inline void scene_tone_neutral(rhw_float color[3])
{
    const float start = 0.8f - 0.04f, desaturation = 0.15f, rest = 1.0f - start;
    const rhw_float low = rhw_min(color[0], rhw_min(color[1], color[2]));
    const rhw_float offset = rhw_select(rhw_less(low, 0.08f), low - 6.25f * low * low, 0.04f);
    for (int c = 0; c < 3; c++) {
        color[c] = color[c] - offset;
    }
    const rhw_float peak = rhw_max(color[0], rhw_max(color[1], color[2]));
    const rhw_int bright = rhw_less(start, peak);
    if (!rhw_any(bright)) {
        return;
    }
    const rhw_float top = rhw_max(peak, start);
    const rhw_float new_peak = 1.0f - rest * rest / (top + (rest - start));
    const rhw_float scale = new_peak / top;
    const rhw_float grey = 1.0f - 1.0f / (desaturation * (top - new_peak) + 1.0f);
    for (int c = 0; c < 3; c++) {
        color[c] = rhw_select(bright, rhw_mix(color[c] * scale, new_peak, grey), color[c]);
    }
}

static inline void scene_tone_matrix(const float m[3][3], rhw_float color[3])
{
    const rhw_float in[3] = {color[0], color[1], color[2]};
    for (int r = 0; r < 3; r++) {
        color[r] = m[r][0] * in[0] + m[r][1] * in[1] + m[r][2] * in[2];
    }
}

/// Map tones by ACES' reference rendering and output transforms for sRGB, as S. Hill fitted them (2016), at 1/0.6 of
/// the exposure, which leaves middle grey where it is.
static inline void scene_tone_aces(rhw_float color[3])
{
    static const float in[3][3] = {
        {0.59719f, 0.35458f, 0.04823f}, {0.07600f, 0.90834f, 0.01566f}, {0.02840f, 0.13383f, 0.83777f}};
    static const float out[3][3] = {
        {1.60475f, -0.53108f, -0.07367f}, {-0.10208f, 1.10813f, -0.00605f}, {-0.00327f, -0.07276f, 1.07602f}};
    for (int c = 0; c < 3; c++) {
        color[c] = color[c] * (1.0f / 0.6f);
    }
    scene_tone_matrix(in, color);
    for (int c = 0; c < 3; c++) {
        const rhw_float a = color[c] * (color[c] + 0.0245786f) - 0.000090537f;
        const rhw_float b = color[c] * (0.983729f * color[c] + 0.4329510f) + 0.238081f;
        color[c] = a / b;
    }
    scene_tone_matrix(out, color);
    for (int c = 0; c < 3; c++) {
        color[c] = rhw_saturate(color[c]);
    }
}

/// Map tones by T. Sobotka's AgX, base look, with B. Wrensch's polynomial for its curve (2023).
static inline void scene_tone_agx(rhw_float color[3])
{
    static const float in[3][3] = {{0.842479062253094f, 0.0784335999999992f, 0.0792237451477643f},
                                   {0.0423282422610123f, 0.878468636469772f, 0.0791661274605434f},
                                   {0.0423756549057051f, 0.0784336f, 0.879142973793104f}};
    static const float out[3][3] = {{1.19687900512017f, -0.0980208811401368f, -0.0990297440797205f},
                                    {-0.0528968517574562f, 1.15190312990417f, -0.0989611768448433f},
                                    {-0.0529716355144438f, -0.0980434501171241f, 1.15107367264116f}};
    static const float least = -12.47393f, most = 4.026069f; // stops
    scene_tone_matrix(in, color);
    for (int c = 0; c < 3; c++) {
        const rhw_float stops = rhw_clamp(rhw_log2(rhw_max(color[c], 1e-10f)), least, most);
        const rhw_float x = (stops - least) * (1.0f / (most - least)), x2 = x * x, x4 = x2 * x2;
        color[c] = 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 +
                   0.1191f * x - 0.00232f;
    }
    scene_tone_matrix(out, color);
    for (int c = 0; c < 3; c++) {
        color[c] = rhw_pow(rhw_saturate(color[c]), rhw_splat(2.2f)); // the curve of a display
    }
}

static inline void scene_tone_map(enum scene_tone tone, rhw_float color[3])
{
    switch (tone) {
    case SCENE_TONE_NEUTRAL: scene_tone_neutral(color); break;
    case SCENE_TONE_ACES: scene_tone_aces(color); break;
    case SCENE_TONE_AGX: scene_tone_agx(color); break;
    default:
        for (int c = 0; c < 3; c++) {
            color[c] = rhw_saturate(color[c]);
        }
    }
}

#endif
