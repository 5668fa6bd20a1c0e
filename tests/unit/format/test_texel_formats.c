// SPDX-License-Identifier: MIT
// Every colour format against the model of texel_model.h, on every path: what shaders read of any bits, what targets
// keep of any values, write masks, logic operations, clear values, mip levels, and what a format refuses.
#include "float_bits.h"
#include "harness.h"

#include <math.h>
#include <string.h>

#include "texel_model.h"

enum { WIDTH = 256, HEIGHT = 40, TEXELS = WIDTH * HEIGHT, BYTES = TEXELS * 16 };

static const struct color_format {
    enum rhw_format format;
    const char *name;
} formats[] = {
#define F(name)                                \
    {                                          \
        RHW_FORMAT_##name, "RHW_FORMAT_" #name \
    }
    F(R8_UNORM),     F(RG8_UNORM),     F(RGBA8_UNORM),  F(BGRA8_UNORM),   F(ABGR8_UNORM),  F(R8_SRGB),
    F(RG8_SRGB),     F(RGBA8_SRGB),    F(BGRA8_SRGB),   F(ABGR8_SRGB),    F(R8_SNORM),     F(RG8_SNORM),
    F(RGBA8_SNORM),  F(R8_UINT),       F(RG8_UINT),     F(RGBA8_UINT),    F(R8_SINT),      F(RG8_SINT),
    F(RGBA8_SINT),   F(R16_UNORM),     F(RG16_UNORM),   F(RGBA16_UNORM),  F(R16_SNORM),    F(RG16_SNORM),
    F(RGBA16_SNORM), F(R16_UINT),      F(RG16_UINT),    F(RGBA16_UINT),   F(R16_SINT),     F(RG16_SINT),
    F(RGBA16_SINT),  F(R16_FLOAT),     F(RG16_FLOAT),   F(RGBA16_FLOAT),  F(R32_UINT),     F(RG32_UINT),
    F(RGBA32_UINT),  F(R32_SINT),      F(RG32_SINT),    F(RGBA32_SINT),   F(R32_FLOAT),    F(RG32_FLOAT),
    F(RGBA32_FLOAT), F(RGB10A2_UNORM), F(RGB10A2_UINT), F(RG11B10_FLOAT), F(RGB565_UNORM), F(RGBA4_UNORM),
    F(BGRA4_UNORM),  F(RGB5A1_UNORM),  F(A1RGB5_UNORM), F(RGB9E5_FLOAT),
};
enum { FORMATS = sizeof formats / sizeof *formats };

static bool is_integer(const struct texel_model *model)
{
    return model->type == TEXEL_UINT || model->type == TEXEL_SINT;
}

// A target's texel is what the texture of slot 0 has at the pixel, and every value of it comes from there.
static void fragment_copy(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const group = &groups[g];
        const rhw_int at[2] = {rhw_int_from_float(group->coord[0]), rhw_int_from_float(group->coord[1])};
        rhw_sample_fetch(group->bindings, 0, at, NULL, group->color[0]);
    }
}

static void open_copy(struct rig *rig, enum rhw_paths paths, enum rhw_format target)
{
    rig_open_with(rig, WIDTH, HEIGHT, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig_set_target(rig, 0, target);
    rig_set_program(rig, rig_vertex_pass, fragment_copy);
    rig->pipeline.program.uses = RHW_USE_COORD;
    rig->pipeline.program.varying_count = 1;
}

static rhw_texture make_texture(struct rig *rig, enum rhw_format format, const void *texels)
{
    rhw_texture texture;
    const struct rhw_texture_def def = {.format = format, .width = WIDTH, .height = HEIGHT};
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    assert_int_equal(rhw_texture_write(rig->context, texture, 0, texels, 0), RHW_OK);
    return texture;
}

static const unsigned char *draw_copy(struct rig *rig, rhw_texture from)
{
    const struct rhw_sampler_def nearest = {.min_filter = RHW_FILTER_NEAREST,
                                            .mag_filter = RHW_FILTER_NEAREST,
                                            .mip_filter = RHW_MIP_FILTER_NONE};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig->context, &nearest, &sampler), RHW_OK);
    struct rig_vertex vertices[6];
    rig_cover(rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 0, from, sampler);
    rig_draw(rig, vertices, 6);
    rig_end(rig);
    rhw_sampler_destroy(rig->context, sampler);
    return rig_read(rig, rig->pass.colors[0].texture);
}

static void fill_random(uint64_t *random, unsigned char *bytes, size_t size)
{
    for (size_t i = 0; i < size; i += 8) {
        const uint64_t bits = rig_random(random);
        memcpy(bytes + i, &bits, size - i < 8 ? size - i : 8);
    }
}

// Floats that are hard on conversions: any bits, near 0..1 and −1..1, ties, small and large ones, specials.
static uint32_t awkward_bits(uint64_t *random)
{
    static const float special[] = {0,   -0.0f, 1,     -1,    INFINITY, -INFINITY,
                                    NAN, 0.5f,  65024, 65408, 65535,    1e30f};
    static const int steps[] = {255, 65535, 1023, 31, 63, 15, 127, 32767, 511};
    const float step = (float)steps[rig_random_int(random, 9)];
    float value;
    switch (rig_random_int(random, 6)) {
    case 0: return (uint32_t)rig_random(random);
    case 1: value = special[rig_random_int(random, 12)]; break;
    case 2: value = ((float)rig_random_int(random, (int)step + 1) + 0.5f) / step; break;
    case 3: value = ldexpf(rig_random_float(random, 1, 2), rig_random_int(random, 40) - 24); break;
    case 4:
        value = ldexpf((float)rig_random_int(random, 2048) + 0.5f, rig_random_int(random, 30) - 25);
        break;
    default: value = rig_random_float(random, -1.1f, 1.1f); break;
    }
    return to_bits(value);
}

static void test_shaders_read_what_the_bits_mean(void **state)
{
    (void)state;
    static unsigned char texels[BYTES];
    uint64_t random = 1;
    for (int f = 0; f < FORMATS; f++) {
        const struct texel_model model = texel_model_of(formats[f].name);
        assert_int_equal(rhw_format_size(formats[f].format), model.bytes);
        struct rig rig;
        open_copy(&rig, RHW_PATHS_ALL, RHW_FORMAT_RGBA32_UINT);
        fill_random(&random, texels, sizeof texels);
        const rhw_texture from = make_texture(&rig, formats[f].format, texels);
        const uint32_t(*const read)[4] = (const uint32_t(*)[4])(const void *)draw_copy(&rig, from);
        for (int i = 0; i < TEXELS; i++) {
            uint32_t expected[4];
            texel_model_decode(&model, texels + (size_t)i * (size_t)model.bytes, expected);
            for (int c = 0; c < 4; c++) {
                if (read[i][c] != expected[c]) {
                    fail_msg("%s: texel %d, channel %d reads %08x, not %08x", formats[f].name, i, c,
                             read[i][c], expected[c]);
                }
            }
        }
        rhw_texture_destroy(rig.context, from);
        rig_close(&rig);
    }
}

static uint32_t combined(enum rhw_logic logic, uint32_t s, uint32_t d)
{
    switch (logic) {
    case RHW_LOGIC_CLEAR: return 0;
    case RHW_LOGIC_AND: return s & d;
    case RHW_LOGIC_AND_REVERSE: return s & ~d;
    case RHW_LOGIC_AND_INVERTED: return ~s & d;
    case RHW_LOGIC_NO_OP: return d;
    case RHW_LOGIC_XOR: return s ^ d;
    case RHW_LOGIC_OR: return s | d;
    case RHW_LOGIC_NOR: return ~(s | d);
    case RHW_LOGIC_EQUIVALENT: return ~(s ^ d);
    case RHW_LOGIC_INVERT: return ~d;
    case RHW_LOGIC_OR_REVERSE: return s | ~d;
    case RHW_LOGIC_COPY_INVERTED: return ~s;
    case RHW_LOGIC_OR_INVERTED: return ~s | d;
    case RHW_LOGIC_NAND: return ~(s & d);
    case RHW_LOGIC_SET: return UINT32_MAX;
    default: return s;
    }
}

// Draws awkward values over random texels and compares every byte.
static void expect_drawn(const struct color_format *format, enum rhw_paths paths, unsigned write_mask,
                         enum rhw_logic logic, uint64_t *random)
{
    static uint32_t values[TEXELS][4];
    static unsigned char before[BYTES];
    const struct texel_model model = texel_model_of(format->name);
    const size_t size = (size_t)model.bytes;
    const bool has_logic = model.type != TEXEL_FLOAT && model.type != TEXEL_SRGB;
    struct rig rig;
    open_copy(&rig, paths, format->format);
    for (int i = 0; i < TEXELS * 4; i++) {
        values[i / 4][i % 4] = awkward_bits(random);
    }
    fill_random(random, before, sizeof before);
    assert_int_equal(rhw_texture_write(rig.context, rig.pass.colors[0].texture, 0, before, 0), RHW_OK);
    rig.pass.colors[0].load = RHW_LOAD_LOAD;
    rig.pipeline.targets[0].write_mask = (uint8_t)write_mask;
    rig.pipeline.logic = logic;
    const rhw_texture from = make_texture(&rig, RHW_FORMAT_RGBA32_UINT, values);
    const unsigned char *const texels = draw_copy(&rig, from);
    unsigned char mask[16], expected[16] = {0};
    texel_model_mask(&model, write_mask, mask);
    for (size_t i = 0; i < TEXELS; i++) {
        texel_model_encode(&model, values[i], expected);
        for (size_t b = 0; b < size; b++) {
            const unsigned char old = before[i * size + b];
            const uint32_t made = has_logic ? combined(logic, expected[b], old) : expected[b];
            const unsigned char byte = (unsigned char)((old & ~mask[b]) | (made & mask[b]));
            if (texels[i * size + b] != byte) {
                fail_msg(
                    "%s, mask %u, logic %d: byte %zu of texel %zu is %02x, not %02x (%08x %08x %08x %08x)",
                    format->name, write_mask, (int)logic, b, i, texels[i * size + b], byte, values[i][0],
                    values[i][1], values[i][2], values[i][3]);
            }
        }
    }
    rhw_texture_destroy(rig.context, from);
    rig_close(&rig);
}

static void test_the_table_has_them_all(void **state)
{
    (void)state;
    int color_formats = 0;
    for (int format = 1; format < RHW_FORMAT_COUNT; format++) {
        const uint32_t depth = RHW_FEATURE_DEPTH_ATTACHMENT | RHW_FEATURE_STENCIL_ATTACHMENT;
        const bool is_plain = rhw_format_decoded((enum rhw_format)format) == (enum rhw_format)format;
        color_formats += is_plain && !(rhw_format_features((enum rhw_format)format) & depth);
    }
    assert_int_equal(color_formats, FORMATS);
    for (int f = 0; f < FORMATS; f++) {
        const struct texel_model model = texel_model_of(formats[f].name);
        const bool is_word = strstr(formats[f].name, "_R32_") && is_integer(&model);
        const uint32_t shared = RHW_FEATURE_SAMPLED | RHW_FEATURE_FILTERED | RHW_FEATURE_TEXEL_BUFFER,
                       integer = RHW_FEATURE_SAMPLED | RHW_FEATURE_COLOR_ATTACHMENT |
                                 RHW_FEATURE_STORAGE_IMAGE | RHW_FEATURE_TEXEL_BUFFER |
                                 (is_word ? RHW_FEATURE_STORAGE_ATOMIC : 0);
        assert_int_equal(rhw_format_features(formats[f].format),
                         is_integer(&model)           ? integer
                         : model.type == TEXEL_SHARED ? shared
                                                      : integer | shared | RHW_FEATURE_BLENDED);
    }
    assert_int_equal(rhw_format_features(RHW_FORMAT_BC7_SRGB), RHW_FEATURE_SAMPLED | RHW_FEATURE_FILTERED);
    assert_int_equal(rhw_format_features(RHW_FORMAT_S8_UINT), RHW_FEATURE_STENCIL_ATTACHMENT);
    assert_int_equal(rhw_format_features(RHW_FORMAT_NONE), 0);
    assert_int_equal(rhw_format_features((enum rhw_format)9999), 0);
}

static bool is_target(const struct color_format *format)
{
    return rhw_format_features(format->format) & RHW_FEATURE_COLOR_ATTACHMENT;
}

static void test_targets_round_and_mask(void **state)
{
    (void)state;
    uint64_t random = 2;
    for (int f = 0; f < FORMATS; f++) {
        if (is_target(&formats[f])) {
            expect_drawn(&formats[f], RHW_PATHS_ALL, 15, RHW_LOGIC_OFF, &random);
            expect_drawn(&formats[f], RHW_PATHS_GENERAL, 15, RHW_LOGIC_OFF, &random);
            expect_drawn(&formats[f], RHW_PATHS_ALL, 1 + (unsigned)rig_random_int(&random, 14), RHW_LOGIC_OFF,
                         &random);
        }
    }
}

static void test_logic_operations(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int logic = RHW_LOGIC_CLEAR; logic <= RHW_LOGIC_SET; logic++) {
        expect_drawn(&formats[logic % FORMATS], RHW_PATHS_ALL, 15, (enum rhw_logic)logic, &random);
        for (int n = 0; n < 3; n++) {
            const struct color_format *const format = &formats[rig_random_int(&random, FORMATS - 1)];
            expect_drawn(format, RHW_PATHS_ALL, 1 + (unsigned)rig_random_int(&random, 15),
                         (enum rhw_logic)logic, &random);
        }
    }
}

// Logic operations stand in the place of blending.
static void test_logic_switches_blending_off(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA32_FLOAT);
    rig.pipeline.logic = RHW_LOGIC_XOR;
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color.dst = RHW_BLEND_ONE;
    memcpy(rig.pass.colors[0].clear, (const float[4]){4, 4, 4, 4}, 16);
    struct rig_vertex vertices[6];
    rig_cover(&rig, 0.5f, (const float[4]){1, 2, 3, 0.5f}, vertices);
    rig_draw_once(&rig, vertices, 6);
    assert_memory_equal(rig_read_float4(&rig)[0], ((const float[4]){1, 2, 3, 0.5f}), 16);
    rig_close(&rig);
}

static void test_clear_values(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int f = 0; f < FORMATS; f++) {
        const struct texel_model model = texel_model_of(formats[f].name);
        if (!is_target(&formats[f])) {
            continue;
        }
        struct rig rig;
        rig_open(&rig, 8, 8);
        rig_set_target(&rig, 0, formats[f].format);
        for (int n = 0; n < 20; n++) {
            uint32_t bits[4];
            for (int c = 0; c < 4; c++) {
                bits[c] = awkward_bits(&random);
            }
            if (is_integer(&model)) {
                memcpy(rig.pass.colors[0].clear_integer, bits, sizeof bits);
            } else {
                memcpy(rig.pass.colors[0].clear, bits, sizeof bits);
            }
            rig_begin(&rig);
            rig_end(&rig);
            unsigned char expected[16];
            texel_model_encode(&model, bits, expected);
            assert_memory_equal(rig_read(&rig, rig.pass.colors[0].texture), expected, (size_t)model.bytes);
        }
        rig_close(&rig);
    }
}

// Blending against the formula in double: a code beside it at most.
static void test_blending(void **state)
{
    (void)state;
    static uint32_t values[TEXELS][4];
    static unsigned char before[BYTES];
    uint64_t random = 5;
    for (int f = 0; f < FORMATS; f++) {
        const struct texel_model model = texel_model_of(formats[f].name);
        const size_t size = (size_t)model.bytes;
        if (!(rhw_format_features(formats[f].format) & RHW_FEATURE_BLENDED) || model.type == TEXEL_SRGB) {
            continue;
        }
        struct rig rig;
        open_copy(&rig, RHW_PATHS_ALL, formats[f].format);
        for (int i = 0; i < TEXELS; i++) {
            uint32_t old[4];
            for (int c = 0; c < 4; c++) {
                const float value = rig_random_float(&random, -1.2f, 1.2f),
                            dst = rig_random_float(&random, -1, 1);
                memcpy(&values[i][c], &value, sizeof value);
                memcpy(&old[c], &dst, sizeof dst);
            }
            texel_model_encode(&model, old, before + (size_t)i * size);
        }
        assert_int_equal(rhw_texture_write(rig.context, rig.pass.colors[0].texture, 0, before, 0), RHW_OK);
        rig.pass.colors[0].load = RHW_LOAD_LOAD;
        struct rhw_color_target *const target = &rig.pipeline.targets[0];
        target->blend = true;
        target->color = (struct rhw_blend_component){RHW_BLEND_CONSTANT_ALPHA,
                                                     RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA, RHW_BLEND_ADD};
        target->alpha = (struct rhw_blend_component){RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA, RHW_BLEND_CONSTANT,
                                                     RHW_BLEND_ADD};
        const rhw_texture from = make_texture(&rig, RHW_FORMAT_RGBA32_UINT, values);
        struct rig_vertex vertices[6];
        rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
        const struct rhw_sampler_def nearest = {.min_filter = RHW_FILTER_NEAREST,
                                                .mag_filter = RHW_FILTER_NEAREST};
        rhw_sampler sampler;
        assert_int_equal(rhw_sampler_create(rig.context, &nearest, &sampler), RHW_OK);
        rig_begin(&rig);
        rhw_pass_set_blend_constant(rig.context, rig.recording, (const float[4]){9, 9, 9, 0.25f});
        rhw_pass_set_texture(rig.context, rig.recording, 0, from, sampler);
        rig_draw(&rig, vertices, 6);
        rig_end(&rig);
        const unsigned char *const texels = rig_read(&rig, rig.pass.colors[0].texture);
        const double least = model.type == TEXEL_SNORM ? -1 : model.type == TEXEL_UNORM ? 0 : -INFINITY;
        const double most = model.type == TEXEL_FLOAT ? INFINITY : 1;
        for (size_t i = 0; i < TEXELS; i++) {
            uint32_t drawn[4], old[4];
            texel_model_decode(&model, texels + i * size, drawn);
            texel_model_decode(&model, before + i * size, old);
            for (int c = 0; c < 4; c++) {
                float src, dst, result;
                memcpy(&src, &values[i][c], 4);
                memcpy(&dst, &old[c], 4);
                memcpy(&result, &drawn[c], 4);
                const double a = fmin(fmax((double)src, least), most);
                const double sum = c < 3 ? a * 0.25 + (double)dst * 0.75 : a * 0.75 + (double)dst * 0.25;
                const bool no_sign = model.type == TEXEL_FLOAT && model.bits[c] < 16;
                const double exact = fmin(fmax(sum, no_sign ? 0 : least), most);
                const double code = model.type == TEXEL_UNORM   ? 1 / (ldexp(1, model.bits[c]) - 1)
                                    : model.type == TEXEL_SNORM ? 1 / (ldexp(1, model.bits[c] - 1) - 1)
                                    : model.bits[c] == 32       ? 1e-6
                                    : model.bits[c] == 16       ? 0x1p-10
                                                                : 0x1p-5;
                if (model.has[c] && fabs((double)result - exact) > code * 0.501 + 1e-7) {
                    fail_msg("%s: texel %zu, channel %d is %.9g, not %.9g", formats[f].name, i, c,
                             (double)result, exact);
                }
            }
        }
        rhw_sampler_destroy(rig.context, sampler);
        rhw_texture_destroy(rig.context, from);
        rig_close(&rig);
    }
}

// The second source --------------------------------------------------------------------------------------

static void fragment_two(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(0.125f * (float)(c + 1));
            groups[g].color[1][c] = rhw_splat(0.25f * (float)c);
        }
    }
}

static void fragment_two1(struct rhw_fragment1 *fragment)
{
    for (int c = 0; c < 4; c++) {
        fragment->color[0][c] = 0.125f * (float)(c + 1);
        fragment->color[1][c] = 0.25f * (float)c;
    }
}

// A second target, if there is one, is left as it is.
static void expect_dual(bool one_at_a_time, int samples, bool has_another)
{
    struct rig rig;
    rig_open_with(&rig, 16, 16, &(struct rhw_context_def){.threads = 1, .validate = RHW_VALIDATE_ON});
    rig_set_program(&rig, rig_vertex_pass, one_at_a_time ? NULL : fragment_two);
    rig.pipeline.program.fragment1 = one_at_a_time ? fragment_two1 : NULL;
    rig.pass.samples = samples;
    struct rhw_color_target *const target = &rig.pipeline.targets[0];
    target->blend = true;
    target->color = (struct rhw_blend_component){RHW_BLEND_SRC1, RHW_BLEND_ONE_MINUS_SRC1, RHW_BLEND_ADD};
    target->alpha =
        (struct rhw_blend_component){RHW_BLEND_ONE_MINUS_SRC1_ALPHA, RHW_BLEND_SRC1_ALPHA, RHW_BLEND_ADD};
    if (has_another) {
        rig_set_target(&rig, 1, RHW_FORMAT_RGBA8_UNORM);
        rig.pipeline.targets[1].write_mask = RHW_WRITE_NONE;
    }
    memcpy(rig.pass.colors[0].clear, (const float[4]){1, 2, 4, 8}, 16);
    struct rig_vertex vertices[6];
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_draw_once(&rig, vertices, 6);
    // 0.125·0 + 1·1, 0.25·0.25 + 2·0.75, 0.375·0.5 + 4·0.5, 0.5·0.25 + 8·0.75
    const float expected[4] = {1, 1.5625f, 2.1875f, 6.125f};
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < 256; i++) {
        assert_memory_equal(pixels[i], expected, sizeof expected);
    }
    rig_close(&rig);
}

static void test_second_source(void **state)
{
    (void)state;
    for (int another = 0; another < 2; another++) {
        expect_dual(false, 1, another);
        expect_dual(true, 1, another);
        expect_dual(false, 4, another);
    }
    struct rig rig;
    rig_open(&rig, 16, 16);
    rig_set_target(&rig, 1, RHW_FORMAT_RGBA8_UNORM);
    rig.pipeline.targets[1].blend = true;
    rig.pipeline.targets[1].alpha.dst = RHW_BLEND_ONE_MINUS_SRC1_ALPHA;
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "targets[1] blends with the second source, color[1], and target_count is 2");
    rig_close(&rig);
}

static void fragment_one(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(0.5f);
        }
    }
}

static void test_validation_misses_the_second_source(void **state)
{
    (void)state;
    struct rig rig;
    rig_open_with(&rig, 16, 16, &(struct rhw_context_def){.threads = 1, .validate = RHW_VALIDATE_ON});
    rig_set_program(&rig, rig_vertex_pass, fragment_one);
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color.src = RHW_BLEND_SRC1;
    struct rig_vertex vertices[6];
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_draw_once(&rig, vertices, 6);
    rig_expect_misuse(&rig, "does not write color[1][0]");
    rig_close(&rig);
}

// Levels as attachments ----------------------------------------------------------------------------------

static void test_levels_are_drawn_into(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 80, 48);
    const struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA8_UNORM,
                                        .width = 80,
                                        .height = 48,
                                        .layers = 2,
                                        .mip_levels = RHW_MIP_LEVELS_ALL};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
    rhw_texture_destroy(rig.context, rig.pass.colors[0].texture);
    rig.pipeline.targets[0].format = RHW_FORMAT_RGBA8_UNORM;
    for (int level = 0; level < 7; level++) {
        rig.pass.colors[0] = (struct rhw_color_attachment){
            .texture = texture, .clear = {(float)(10 * level) / 255, 1, 0, 1}, .layer = 1, .level = level};
        rig_begin(&rig);
        rig_end(&rig);
    }
    // Cleared again to the same value, in the other order: no tile is taken for another level's.
    for (int level = 6; level >= 0; level--) {
        unsigned char texels[80 * 48][4], other[80 * 48][4];
        rig.pass.colors[0].level = level;
        rig.pass.colors[0].clear[0] = (float)(10 * level) / 255;
        rig_begin(&rig);
        rig_end(&rig);
        assert_int_equal(rhw_texture_read_layer(rig.context, texture, level, 1, texels, 0), RHW_OK);
        assert_int_equal(rhw_texture_read_layer(rig.context, texture, level, 0, other, 0), RHW_OK);
        const int width = rhw_texture_width(rig.context, texture, level),
                  height = rhw_texture_height(rig.context, texture, level);
        for (int i = 0; i < width * height; i++) {
            assert_int_equal(texels[i][0], 10 * level);
            assert_int_equal(texels[i][1], 255);
            assert_int_equal(other[i][3], 0);
        }
    }
    rig.pass.colors[0].level = 7;
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0].level is 7; texture");
    rig.misuses = 0;
    rig.pass.colors[0].level = 2;
    rig.pass.width = 80, rig.pass.height = 48;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "whose level 2 is 20x12; the pass is 80x48");
    rig_close(&rig);
}

// What formats refuse ------------------------------------------------------------------------------------

static void test_integers_are_not_filtered(void **state)
{
    (void)state;
    struct rig rig;
    open_copy(&rig, RHW_PATHS_ALL, RHW_FORMAT_RGBA32_UINT);
    static const unsigned char texels[BYTES];
    const rhw_texture from = make_texture(&rig, RHW_FORMAT_R8_UINT, texels);
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &(struct rhw_sampler_def){0}, &sampler), RHW_OK);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, from, sampler);
    rig_expect_misuse(&rig, "RHW_FORMAT_R8_UINT, which is not filtered");
    rhw_pass_cancel(rig.context, rig.recording);
    assert_int_equal(rhw_texture_generate_mips(rig.context, from), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "RHW_FORMAT_R8_UINT; that format is not filtered");
    rig.pass.colors[0].clear[2] = 1;
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0].clear[2] is set and RHW_FORMAT_RGBA32_UINT holds integers");
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA8_UNORM);
    rig.pass.colors[0].clear[2] = 0;
    rig.pass.colors[0].clear_integer[1] = 1;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0].clear_integer[1] is set and RHW_FORMAT_RGBA8_UNORM holds no integers");
    rhw_sampler_destroy(rig.context, sampler);
    rhw_texture_destroy(rig.context, from);
    rig_close(&rig);
}

static void fragment_sampled(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float at[2] = {groups[g].coord[0] / (float)(WIDTH / 2), groups[g].coord[1] / (float)HEIGHT};
        rhw_sample_lod(groups[g].bindings, 0, at, rhw_splat(0), groups[g].color[0]);
    }
}

// Nearest samples are bits too, NaN or not, and the border is the very integers, which no float could be.
static void test_integers_are_sampled(void **state)
{
    (void)state;
    static uint32_t texels[TEXELS][4];
    struct rig rig;
    open_copy(&rig, RHW_PATHS_ALL, RHW_FORMAT_RGBA32_UINT);
    rig_set_program(&rig, rig_vertex_pass, fragment_sampled);
    uint64_t random = 6;
    fill_random(&random, (unsigned char *)texels, sizeof texels);
    const rhw_texture from = make_texture(&rig, RHW_FORMAT_RGBA32_SINT, texels);
    const struct rhw_sampler_def nearest = {.min_filter = RHW_FILTER_NEAREST,
                                            .mag_filter = RHW_FILTER_NEAREST,
                                            .address_u = RHW_ADDRESS_BORDER,
                                            .border = {0.5f, 1, 1, 0.25f},
                                            .border_integer = {16777217, -3, 0, INT32_MIN}};
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &nearest, &sampler), RHW_OK);
    struct rig_vertex vertices[6];
    rig_cover(&rig, 0.5f, (const float[4]){0}, vertices);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, from, sampler);
    rig_draw(&rig, vertices, 6);
    rig_end(&rig);
    const uint32_t(*const read)[4] =
        (const uint32_t(*)[4])(const void *)rig_read(&rig, rig.pass.colors[0].texture);
    static const uint32_t border[4] = {16777217, (uint32_t)-3, 0, 0x80000000u};
    for (int i = 0; i < TEXELS; i++) {
        const int x = i % WIDTH * 2 + 1, y = i / WIDTH;
        assert_memory_equal(read[i], x < WIDTH ? texels[y * WIDTH + x] : border, 16);
    }
    rhw_sampler_destroy(rig.context, sampler);
    rhw_texture_destroy(rig.context, from);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_the_table_has_them_all),
    cmocka_unit_test(test_shaders_read_what_the_bits_mean),
    cmocka_unit_test(test_targets_round_and_mask),
    cmocka_unit_test(test_logic_operations),
    cmocka_unit_test(test_logic_switches_blending_off),
    cmocka_unit_test(test_clear_values),
    cmocka_unit_test(test_blending),
    cmocka_unit_test(test_second_source),
    cmocka_unit_test(test_validation_misses_the_second_source),
    cmocka_unit_test(test_levels_are_drawn_into),
    cmocka_unit_test(test_integers_are_not_filtered),
    cmocka_unit_test(test_integers_are_sampled),
};

const struct unit_tests test_texel_formats = UNIT_TESTS(tests, NULL, NULL);
