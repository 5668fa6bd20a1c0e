// SPDX-License-Identifier: MIT
// What becomes of colours: blending, masks, several targets, formats, blits.
#include <string.h>

#include "scenes.h"

enum { FACTORS = RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA, EQUATIONS = 5 };

// Colours to blend with, and quads over them with every factor as source and another as destination.
static void add_factors(struct frame *f, enum rhw_format format, int shift)
{
    static const float low[4] = {0.1f, 0.2f, 0.9f, 1}, high[4] = {0.9f, 1, 0.05f, 0.15f};
    static const float low_over[4] = {0.8f, 0.1f, 0.3f, 0.3f}, high_over[4] = {0.3f, 0.95f, 0.6f, 0.75f};
    frame_begin(f, 256, 128);
    f->formats[0] = format;
    frame_add_quad(f, 0, 0, 256, 128, 0, low, high);
    frame_add_draw(f, frame_draw_default(f, &smooth_color));
    for (int i = 0; i < FACTORS; i++) {
        struct frame_draw draw = frame_draw_default(f, &smooth_color);
        struct rhw_color_target *const t = &draw.state.targets[0];
        const float constant[4] = {0.25f, 0.5f, 0.75f, 0.4f};
        t->blend = true;
        t->color.src = (enum rhw_blend_factor)(1 + i);
        t->color.dst = (enum rhw_blend_factor)(1 + (i + shift) % FACTORS);
        t->alpha.src = (enum rhw_blend_factor)(1 + (i + 2 * shift) % FACTORS);
        t->alpha.dst = (enum rhw_blend_factor)(1 + (i + 3 * shift) % FACTORS);
        t->color.operation = (enum rhw_blend_operation)(i * shift % EQUATIONS);
        t->alpha.operation = (enum rhw_blend_operation)((i + shift) % EQUATIONS);
        memcpy(draw.blend_constant, constant, sizeof constant);
        frame_add_quad(f, 32 * (i % 8), 64 * (i / 8), 32, 64, 0, low_over, high_over);
        frame_add_draw(f, draw);
    }
}

static void blend_factors(struct frame *f)
{
    add_factors(f, RHW_FORMAT_RGBA8_UNORM, 4);
}

static void blend_more_factors(struct frame *f)
{
    add_factors(f, RHW_FORMAT_RGBA8_UNORM, 7);
}

static void blend_packed(struct frame *f)
{
    add_factors(f, RHW_FORMAT_RGB10A2_UNORM, 4);
}

static void blend_srgb(struct frame *f)
{
    add_factors(f, RHW_FORMAT_RGBA8_SRGB, 4);
}

static void blend_half(struct frame *f)
{
    add_factors(f, RHW_FORMAT_RGBA16_FLOAT, 4);
}

// Layers of "over", where every rounding feeds the next.
static void blend_layers(struct frame *f)
{
    frame_begin(f, 256, 256);
    frame_add_triangles(f, 100, 200);
    struct frame_draw draw = frame_draw_default(f, &smooth_color);
    draw.state.targets[0].blend = true;
    draw.state.targets[0].color = draw.state.targets[0].alpha =
        (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    frame_add_draw(f, draw);
}

static void masks(struct frame *f)
{
    frame_begin(f, 256, 256);
    const float clear[4] = {0.2f, 0.4f, 0.6f, 0.8f};
    memcpy(f->clear[0], clear, sizeof clear);
    for (int mask = 0; mask < 16; mask++) {
        struct frame_draw draw = frame_draw_default(f, &flat_color);
        draw.state.targets[0].write_mask = (uint8_t)(mask ? mask : RHW_WRITE_NONE);
        frame_add_triangles(f, 20, 100);
        frame_add_draw(f, draw);
    }
}

static void paint_targets(struct rhw_fragment1 *f)
{
    for (int t = 0; t < FRAME_TARGETS; t++) {
        for (int c = 0; c < 4; c++) {
            f->color[t][c] = f->varying[(c + t) % 4];
        }
    }
}

static const struct shader_pair targets_color = {
    .fragment = "layout(location = 0) out vec4 a; layout(location = 1) out vec4 b;\n"
                "layout(location = 2) out vec4 c; layout(location = 3) out vec4 d;\n"
                "void main() { a = values; b = values.yzwx; c = values.zwxy; d = values.wxyz; }",
    .fragment1 = paint_targets};

static void targets(struct frame *f)
{
    frame_begin(f, 128, 128);
    f->target_count = 4;
    f->formats[1] = RHW_FORMAT_RGB10A2_UNORM;
    f->formats[2] = RHW_FORMAT_RGBA16_FLOAT;
    f->formats[3] = RHW_FORMAT_R8_UNORM;
    frame_add_triangles(f, 100, 80);
    struct frame_draw draw = frame_draw_default(f, &targets_color);
    draw.state.targets[1].blend = true; // each target has its own
    draw.state.targets[1].color = draw.state.targets[1].alpha =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_MAX};
    draw.state.targets[2].write_mask = RHW_WRITE_RED | RHW_WRITE_ALPHA;
    frame_add_draw(f, draw);
}

static void targets_left_out(struct frame *f)
{
    targets(f);
    struct frame_draw *const draw = &f->draws[0];
    draw->state.targets[1] = draw->state.targets[2] = (struct rhw_color_target){0};
    f->left_out = 1 << 1 | 1 << 2;
    f->clear[1][1] = f->clear[2][2] = 0.5f;
}

static void add_format(struct frame *f, enum rhw_format format)
{
    frame_begin(f, 256, 256);
    f->formats[0] = format;
    const float clear[4] = {0.3f, 0.6f, 0.9f, 0.5f};
    memcpy(f->clear[0], clear, sizeof clear);
    frame_add_triangles(f, 60, 160);
    frame_add_draw(f, frame_draw_default(f, &smooth_color));
}

static void srgb(struct frame *f)
{
    add_format(f, RHW_FORMAT_RGBA8_SRGB);
}

static void packed(struct frame *f)
{
    add_format(f, RHW_FORMAT_RGB10A2_UNORM);
}

static void small_floats(struct frame *f)
{
    add_format(f, RHW_FORMAT_RG11B10_FLOAT);
}

static void halves(struct frame *f)
{
    add_format(f, RHW_FORMAT_RGBA16_FLOAT);
}

static void paint_integers(struct rhw_fragment1 *f)
{
    for (int c = 0; c < 4; c++) {
        f->color[0][c] = rhw_float_from_bits1((int32_t)(f->varying[4 + c] * 256) * 1001 - 128000);
    }
}

static const struct shader_pair signed_color = {
    .fragment = "out ivec4 color; void main() { color = ivec4(flat_values * 256.0) * 1001 - 128000; }",
    .fragment1 = paint_integers};
static const struct shader_pair unsigned_color = {
    .fragment = "out uvec4 color; void main() { color = uvec4(ivec4(flat_values * 256.0) * 1001 - 128000); }",
    .fragment1 = paint_integers};

static void add_integers(struct frame *f, enum rhw_format format, const struct shader_pair *shaders)
{
    frame_begin(f, 128, 128);
    f->formats[0] = format;
    const int32_t clear[4] = {1, 2, 3, 100};
    memcpy(f->clear_integer[0], clear, sizeof clear);
    frame_add_triangles(f, 60, 80);
    frame_add_draw(f, frame_draw_default(f, shaders));
}

static void integers_signed(struct frame *f)
{
    add_integers(f, RHW_FORMAT_R32_SINT, &signed_color);
}

static void integers_unsigned(struct frame *f)
{
    add_integers(f, RHW_FORMAT_RGBA32_UINT, &unsigned_color);
}

static void paint_bytes(struct rhw_fragment1 *f)
{
    for (int c = 0; c < 4; c++) {
        f->color[0][c] = rhw_float_from_bits1((int32_t)(f->varying[4 + c] * 120));
    }
}

static const struct shader_pair bytes_color = {
    .fragment = "out uvec4 color; void main() { color = uvec4(flat_values * 120.0); }",
    .fragment1 = paint_bytes};
static const struct shader_pair signed_bytes_color = {
    .fragment = "out ivec4 color; void main() { color = ivec4(flat_values * 120.0); }",
    .fragment1 = paint_bytes};

static void integers_bytes(struct frame *f)
{
    add_integers(f, RHW_FORMAT_RGBA8_UINT, &bytes_color);
}

static void integers_short(struct frame *f)
{
    add_integers(f, RHW_FORMAT_RG16_SINT, &signed_bytes_color);
}

static void add_blit(struct frame *f, enum rhw_filter filter, const int to[4])
{
    static const int from[4] = {0, 0, 100, 80};
    frame_begin(f, 256, 256);
    f->target_count = 2;
    f->formats[1] = RHW_FORMAT_RGBA8_UNORM;
    frame_add_triangles(f, 200, 60);
    struct frame_draw draw = frame_draw_default(f, &smooth_color);
    draw.state.targets[1].write_mask = RHW_WRITE_NONE;
    frame_add_draw(f, draw);
    f->extra = FRAME_BLIT;
    f->blit_filter = filter;
    memcpy(f->blit_from, from, sizeof from);
    memcpy(f->blit_to, to, sizeof f->blit_to);
}

static void blit_nearest(struct frame *f)
{
    static const int to[4] = {245, 90, 103, 250}; // mirrored
    add_blit(f, RHW_FILTER_NEAREST, to);
}

static void blit_linear(struct frame *f)
{
    static const int to[4] = {110, 255, 250, 93};
    add_blit(f, RHW_FILTER_LINEAR, to);
}

static const char rounds_often[] = "the peer rounds the source, factors and both products to codes before it "
                                   "adds them; here the sum alone is rounded";

struct scene_list output_scenes(void)
{
    static const struct scene scenes[] = {
        {"blend factors and equations", blend_factors, rounds_often, 50, 2},
        {"the same, other pairs", blend_more_factors, NULL, 0, 0},
        {"blending RGB10A2", blend_packed, NULL, 0, 0},
        {"blending sRGB", blend_srgb,
         "the peer decodes and encodes sRGB by polynomials, up to 0.1 % of white off; where a difference is "
         "near black, that "
         "is many codes",
         1000, 16},
        {"blending RGBA16F", blend_half,
         "the peer cuts what does not fit into a half float, where it is rounded to nearest here: once when "
         "the first quad "
         "is drawn, and once when it is blended",
         7000, 5},
        {"100 layers blended", blend_layers, "as above, and every layer adds to it", 1300, 4},
        {"colour masks", masks, NULL, 0, 0},
        {"four targets", targets, NULL, 0, 0},
        {"four targets, two left out", targets_left_out, NULL, 0, 0},
        {"sRGB target", srgb, NULL, 0, 0},
        {"RGB10A2 target", packed, NULL, 0, 0},
        {"RG11B10F target", small_floats, NULL, 0, 0},
        {"RGBA16F target", halves, NULL, 0, 0},
        {"R32I target", integers_signed, NULL, 0, 0},
        {"RGBA32UI target", integers_unsigned, NULL, 0, 0},
        {"RGBA8UI target", integers_bytes, NULL, 0, 0},
        {"RG16I target", integers_short, NULL, 0, 0},
        {"blit, nearest", blit_nearest, NULL, 0, 0},
        {"blit, linear", blit_linear,
         "at the region's edge the filter repeats the last texel here, as the documentation says; there it "
         "takes the next "
         "one of the source",
         80, 255},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
