// SPDX-License-Identifier: MIT
// The built-in shaders that cover the whole picture: the background and the resolve of samples to pixels.
#include "color.h"
#include "scene_shaders.h"

#include <string.h>

// Place the triangle (−1, −1), (3, −1), (−1, 3). One triangle leaves no diagonal seam to shade twice. Depth 0 is far.
static void screen_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int i = groups[g].vertex_index;
        groups[g].position[0] = rhw_float_from_int((i & 1) * 4 - 1);
        groups[g].position[1] = rhw_float_from_int((i & 2) * 2 - 1);
        groups[g].position[2] = rhw_splat(0.0f);
        groups[g].position[3] = rhw_splat(1.0f);
    }
}

// Return a threshold, 0..1. Each of 64 levels occurs once in 8 × 8 pixels, and neighbours are far apart (B. Bayer
// 1973).
static rhw_float bayer(rhw_int x, rhw_int y)
{
    const rhw_int both = x ^ y;
    const rhw_int level =
        (both & 1) << 5 | (y & 1) << 4 | (both & 2) << 2 | (y & 2) << 1 | (both & 4) >> 1 | (y & 4) >> 2;
    return (rhw_float_from_int(level) + 0.5f) * (1.0f / 64.0f);
}

static void backdrop_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_backdrop *b = groups->uniforms;
    for (int g = 0; g < count; g++) {
        const rhw_int column = rhw_int_from_float_unchecked(groups[g].coord[0] * b->inverse_side);
        const rhw_int row =
            rhw_int_from_float_unchecked((groups[g].coord[1] + b->first_row) * b->inverse_side);
        const rhw_float down = (rhw_float_from_int(row) + 0.5f) * b->inverse_height,
                        threshold = bayer(column, row);
        for (int c = 0; c < 3; c++) {
            const rhw_float code = b->codes[0][c] + (b->codes[1][c] - b->codes[0][c]) * down;
            const rhw_int whole = rhw_int_from_float_unchecked(rhw_floor(code + threshold));
            groups[g].color[0][c] =
                b->smooth ? scene_color_decode8(code * (1.0f / 255.0f)) : rhw_gather(b->decode, 256, whole);
        }
        groups[g].color[0][3] = rhw_splat(1.0f);
    }
}

// Filter with a box: every sample of the pixel counts as much as every other. Samples hold tone-mapped light, each
// mapped on its own. An average of untouched light would let one bright sample of an edge outshine all others and leave
// the edge as jagged as without supersampling.
static void resolve_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_resolve *r = groups->uniforms;
    const float weight = 1.0f / (float)(r->side * r->side);
    const rhw_float level = rhw_splat(0.0f);
    for (int g = 0; g < count; g++) {
        const rhw_float left = (groups[g].coord[0] - 0.5f) * (float)r->side + 0.5f;
        const rhw_float top = (groups[g].coord[1] - 0.5f) * (float)r->side + 0.5f;
        rhw_float sum[4] = {level, level, level, level};
        for (int y = 0; y < r->side; y++) {
            for (int x = 0; x < r->side; x++) {
                const rhw_float uv[2] = {(left + (float)x) * r->inverse_size[0],
                                         (top + (float)y) * r->inverse_size[1]};
                rhw_float texel[4];
                rhw_sample_lod(groups[g].bindings, 0, uv, level, texel);
                for (int c = 0; c < 4; c++) {
                    sum[c] += texel[c];
                }
            }
        }
        rhw_float scale = rhw_splat(weight);
        groups[g].color[0][3] = sum[3] * scale;
        if (r->straight_alpha) {
            const rhw_int some = rhw_less(0.0f, sum[3]);
            scale = rhw_select(some, 1.0f / sum[3], 0.0f);
        }
        for (int c = 0; c < 3; c++) {
            groups[g].color[0][c] = sum[c] * scale;
        }
    }
}

static void layer_fragment(struct rhw_fragment *groups, int count)
{
    const struct scene_layer *layer = groups->uniforms;
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const rhw_int at[2] = {rhw_int_from_float_unchecked(f->coord[0]),
                               rhw_int_from_float_unchecked(f->coord[1])};
        for (int i = 0; i < layer->count; i++) {
            rhw_float texel[4];
            if (layer->samples > 1) {
                rhw_sample_fetch_sample(f->bindings, i, at, &f->sample_id, texel);
            } else {
                rhw_sample_fetch(f->bindings, i, at, NULL, texel);
            }
            memcpy(groups[g].color[i], texel, sizeof texel);
        }
    }
}

const struct scene_screen_shaders RHW_ISA_NAME(scene_screen_shaders) = {
    .vertex = screen_vertex,
    .fragment = {[SCENE_SCREEN_BACKDROP] = backdrop_fragment,
                 [SCENE_SCREEN_RESOLVE] = resolve_fragment,
                 [SCENE_SCREEN_LAYER] = layer_fragment},
};
