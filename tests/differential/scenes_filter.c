// SPDX-License-Identifier: MIT
// Levels of detail: from derivatives, gradients, biases and limits, and what filters make of levels.
#include <string.h>

#include "scenes.h"

static void paint_implicit(struct rhw_fragment1 *f)
{
    const float gradient[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
    rhw_sample_grad1(f->bindings, 0, f->varying, gradient, f->color[0]);
}

static const struct shader_pair implicit = {
    .fragment =
        "uniform sampler2D texture0; out vec4 color; void main() { color = texture(texture0, values.xy); }",
    .fragment1 = paint_implicit,
    .derivatives = true};

static void paint_bias(struct rhw_fragment1 *f)
{
    const float gradient[4] = {f->ddx[0], f->ddx[1], f->ddy[0], f->ddy[1]};
    rhw_sample_bias1(f->bindings, 0, f->varying, gradient, 1.25f, f->color[0]);
}

static const struct shader_pair bias = {.fragment = "uniform sampler2D texture0; out vec4 color; void main() "
                                                    "{ color = texture(texture0, values.xy, 1.25); }",
                                        .fragment1 = paint_bias,
                                        .derivatives = true};

static void paint_lod(struct rhw_fragment1 *f)
{
    rhw_sample_lod1(f->bindings, 0, f->varying, f->varying[2], f->color[0]);
}

static const struct shader_pair lod = {
    .fragment = "uniform sampler2D texture0; out vec4 color;\n"
                "void main() { color = textureLod(texture0, values.xy, values.z); }",
    .fragment1 = paint_lod};

// One gradient for all: 1/32, and 1/64 the other way.
static void paint_gradient(struct rhw_fragment1 *f)
{
    static const float gradient[4] = {1.0f / 32, 0, 0, 1.0f / 64};
    rhw_sample_grad1(f->bindings, 0, f->varying, gradient, f->color[0]);
}

static const struct shader_pair gradient = {
    .fragment =
        "uniform sampler2D texture0; out vec4 color;\n"
        "void main() { color = textureGrad(texture0, values.xy, vec2(1.0 / 32.0, 0), vec2(0, 1.0 / 64.0)); }",
    .fragment1 = paint_gradient};

static struct frame_texture *begin(struct frame *f, enum rhw_filter filter, enum rhw_mip_filter mip)
{
    frame_begin(f, 256, 256);
    struct frame_texture *const t = &f->textures[f->texture_count++];
    t->def = (struct rhw_texture_def){
        .format = RHW_FORMAT_RGBA8_UNORM, .width = 64, .height = 64, .mip_levels = 7};
    t->sampler = (struct rhw_sampler_def){.min_filter = filter, .mag_filter = filter, .mip_filter = mip};
    return t;
}

// Cells of 32 pixels, in each of which the coordinates run at another rate; no level is half way between two.
static void add_rates(struct frame *f, const struct shader_pair *shaders)
{
    for (int i = 0; i < 64; i++) {
        const float from = 0.0131f + 0.017f * (float)i, rate = (float)(1 + i) / 8;
        const float low[4] = {from, from, 0.03f + 0.1f * (float)(i % 61), 0};
        const float high[4] = {from + rate, from + rate * 0.7f, 0.03f + 0.1f * (float)(i % 61), 1};
        frame_add_quad(f, 32 * (i % 8), 32 * (i / 8), 32, 32, 0, low, high);
    }
    frame_add_draw(f, frame_draw_default(f, shaders));
}

static void lod_nearest(struct frame *f)
{
    begin(f, RHW_FILTER_NEAREST, RHW_MIP_FILTER_NEAREST);
    add_rates(f, &lod);
}

static void lod_bilinear(struct frame *f)
{
    begin(f, RHW_FILTER_LINEAR, RHW_MIP_FILTER_NEAREST);
    add_rates(f, &lod);
}

static void lod_trilinear(struct frame *f)
{
    begin(f, RHW_FILTER_LINEAR, RHW_MIP_FILTER_LINEAR);
    add_rates(f, &lod);
}

static void lod_halves(struct frame *f)
{
    begin(f, RHW_FILTER_LINEAR, RHW_MIP_FILTER_LINEAR)->def.format = RHW_FORMAT_RGBA16_FLOAT;
    add_rates(f, &lod);
}

static void lod_limits(struct frame *f)
{
    struct frame_texture *const t = begin(f, RHW_FILTER_LINEAR, RHW_MIP_FILTER_NEAREST);
    t->sampler.lod_min = 1.3f;
    t->sampler.lod_max = 3.2f;
    add_rates(f, &lod);
}

static void implicit_nearest(struct frame *f)
{
    begin(f, RHW_FILTER_NEAREST, RHW_MIP_FILTER_NEAREST);
    add_rates(f, &implicit);
}

static void implicit_trilinear(struct frame *f)
{
    begin(f, RHW_FILTER_LINEAR, RHW_MIP_FILTER_LINEAR)->plain = true;
    add_rates(f, &implicit);
}

static void implicit_halves(struct frame *f)
{
    struct frame_texture *const t = begin(f, RHW_FILTER_LINEAR, RHW_MIP_FILTER_LINEAR);
    t->def.format = RHW_FORMAT_RGBA16_FLOAT;
    t->plain = true;
    add_rates(f, &implicit);
}

static void biased(struct frame *f)
{
    begin(f, RHW_FILTER_NEAREST, RHW_MIP_FILTER_NEAREST);
    add_rates(f, &bias);
}

static void gradients(struct frame *f)
{
    begin(f, RHW_FILTER_LINEAR, RHW_MIP_FILTER_NEAREST);
    add_rates(f, &gradient);
}

// Cells in which v runs 1 to `ratio` times as fast as u, from row to row; u over 1/2 to 4 texels a pixel: a little
// more than powers of 2, from the nearest level, or also between them.
static void add_stretched(struct frame *f, float most, int ratio, bool between)
{
    struct frame_texture *const t =
        begin(f, RHW_FILTER_LINEAR, between ? RHW_MIP_FILTER_LINEAR : RHW_MIP_FILTER_NEAREST);
    t->def.format = f->formats[0] = RHW_FORMAT_RGBA16_FLOAT;
    t->plain = true;
    t->sampler.max_anisotropy = most;
    for (int i = 0; i < 64; i++) {
        const float from = 0.0131f + 0.017f * (float)i;
        const float rate = between ? (float)(1 + i % 8) / 4 : 1.05f * (float)(1 << i % 4) / 4;
        const float low[4] = {from, from, 0, 0};
        const float high[4] = {from + rate, from + rate * (1 + (float)(i / 8 * (ratio - 1)) / 7), 0, 1};
        frame_add_quad(f, 32 * (i % 8), 32 * (i / 8), 32, 32, 0, low, high);
    }
    frame_add_draw(f, frame_draw_default(f, &implicit));
}

static void stretched_4(struct frame *f)
{
    add_stretched(f, 4, 4, false);
}

static void stretched_16(struct frame *f)
{
    add_stretched(f, 16, 16, false);
}

static void stretched_between(struct frame *f)
{
    add_stretched(f, 16, 16, true);
}

static void stretched_beyond(struct frame *f)
{
    add_stretched(f, 2, 16, true);
}

static void magnify(struct frame *f)
{
    struct frame_texture *const t = begin(f, RHW_FILTER_LINEAR, RHW_MIP_FILTER_NEAREST);
    t->sampler.mag_filter = RHW_FILTER_NEAREST;
    add_rates(f, &lod);
}

// With GALLIVM_PERF=no_aos_sampling, by which the peer mixes in floats, these differ by one unit at most.
static const char coarse_weights[] =
    "the peer mixes 8-bit texels by weights of 8 bits and rounds after every step";

// Seen to follow that formula: the pixels that it says are those that differ.
static const char rough_logarithm[] = "for the level the peer takes log2 of the square of the footprint as "
                                      "linear between powers of 2: up to 0.043 of a level "
                                      "low";

// Seen cell by cell.
static const char whole_levels[] = "the peer takes the level of the footprint's shorter side, rounded down, "
                                   "however long the other is; here it lies "
                                   "between levels, and the other counts where it is beyond max_anisotropy "
                                   "times as long (Vulkan, Image Level(s) "
                                   "Selection)";

struct scene_list filter_scenes(void)
{
    static const struct scene scenes[] = {
        {"textureLod, nearest", lod_nearest, NULL, 0, 0},
        {"textureLod, bilinear", lod_bilinear, coarse_weights, 4, 2},
        {"textureLod, trilinear", lod_trilinear, coarse_weights, 150, 2},
        {"textureLod, trilinear half floats", lod_halves, NULL, 0, 0},
        {"level limits", lod_limits, coarse_weights, 4, 2},
        {"magnified, minified", magnify, NULL, 0, 0},
        {"texture, nearest", implicit_nearest, NULL, 0, 0},
        {"texture, trilinear", implicit_trilinear, rough_logarithm, 8192, 2},
        {"texture, trilinear half floats", implicit_halves, rough_logarithm, 8192, 2},
        {"texture with a bias", biased, rough_logarithm, 1024, 255},
        {"textureGrad", gradients, coarse_weights, 4, 2},
        {"anisotropy 4", stretched_4, NULL, 0, 0},
        {"anisotropy 16", stretched_16, NULL, 0, 0},
        {"anisotropy 16, between levels", stretched_between, whole_levels, 33000, 481},
        {"anisotropy 2, footprints of up to 16", stretched_beyond, whole_levels, 60416, 1920},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
