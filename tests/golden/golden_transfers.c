// SPDX-License-Identifier: MIT
// Golden scene of what moves texels without drawing: scaling with conversion, resolving, clearing, copying.
#include "golden_scenes.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 37, HEIGHT = 29, SAMPLES = 4 };

// Floats in and out of 0..1, and now and then what is none.
static void write_floats(rhw_context *context, rhw_texture texture, uint64_t *random)
{
    static const float odd[] = {INFINITY, -INFINITY, NAN, 0x1p-140f, -0.0f, 70000};
    static float texels[WIDTH * HEIGHT * 4];
    for (int sample = 0; sample < rhw_texture_samples(context, texture); sample++) {
        for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
            texels[i] = i % 97 == 0 ? odd[i / 97 % 6] : golden_random(random, -0.25f, 1.25f);
        }
        const struct rhw_texture_region region = {.sample = sample};
        golden_check(rhw_texture_write_region(context, texture, &region, texels, 0, 0), "texels");
    }
}

static rhw_texture make(rhw_context *context, enum rhw_format format, int samples)
{
    const struct rhw_texture_def def = {
        .format = format, .width = WIDTH, .height = HEIGHT, .samples = samples};
    rhw_texture texture;
    golden_check(rhw_texture_create(context, &def, &texture), "texture");
    return texture;
}

// Into every kind of format, enlarged, and back, mirrored and made smaller.
static void scale(rhw_context *context, struct golden_images *images, uint64_t *random)
{
    static const enum rhw_format formats[] = {
        RHW_FORMAT_RGBA8_UNORM,  RHW_FORMAT_BGRA8_SRGB,   RHW_FORMAT_RG8_SNORM,
        RHW_FORMAT_R16_UNORM,    RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_RG11B10_FLOAT,
        RHW_FORMAT_RGB9E5_FLOAT, RHW_FORMAT_RGB5A1_UNORM, RHW_FORMAT_RGBA32_FLOAT};
    const rhw_texture source = make(context, RHW_FORMAT_RGBA32_FLOAT, 1);
    write_floats(context, source, random);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++) {
        const rhw_texture large = golden_texture(context, formats[i], 61, 50, 1),
                          small = golden_texture(context, RHW_FORMAT_RGBA32_FLOAT, 23, 19, 1);
        const struct rhw_blit_region from = {.x0 = 3, .y0 = 28, .x1 = 36, .y1 = 1},
                                     to = {.x0 = 58, .y0 = 2, .x1 = 1, .y1 = 47};
        golden_check(rhw_texture_blit(context, source, &from, large, &to,
                                      i % 3 == 2 ? RHW_FILTER_NEAREST : RHW_FILTER_LINEAR),
                     "blit");
        golden_check(rhw_texture_blit(context, large, NULL, small, NULL, RHW_FILTER_LINEAR), "blit");
        golden_keep(images, context, large);
        golden_keep(images, context, small);
    }
}

static void resolve(rhw_context *context, struct golden_images *images, uint64_t *random)
{
    static const enum rhw_resolve modes[] = {RHW_RESOLVE_AVERAGE, RHW_RESOLVE_MIN, RHW_RESOLVE_MAX};
    const rhw_texture many = make(context, RHW_FORMAT_RGBA32_FLOAT, SAMPLES);
    write_floats(context, many, random);
    for (int i = 0; i < 3; i++) {
        const rhw_texture one = make(context, RHW_FORMAT_RGBA32_FLOAT, 1);
        const struct rhw_clear_value value = {.color = {0.1f, 0.2f, 0.3f, 0.4f}};
        const struct rhw_texture_region part = {.x = 5, .y = 2, .width = 27, .height = 21},
                                        to = {.x = 9, .y = 7};
        golden_check(rhw_texture_clear(context, one, NULL, &value), "clear");
        golden_check(rhw_texture_resolve(context, many, &part, one, &to, modes[i]), "resolve");
        golden_check(
            rhw_texture_copy(context, one, &(struct rhw_texture_region){.x = 20, .width = 6}, one, NULL),
            "copy");
        golden_keep(images, context, one);
    }
}

void golden_transfers_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    uint64_t random = 16;
    scale(context, images, &random);
    resolve(context, images, &random);
}
