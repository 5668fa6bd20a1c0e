// SPDX-License-Identifier: MIT
// Blending: every factor with every factor under every operation against a scalar model, per
// target and per channel, in every colour format; write masks; encoding on write.
#include "harness.h"
#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FACTORS = 13, OPERATIONS = 5 };

struct blend_case {
    struct rhw_blend_component color, alpha;
    double src[4], dst[4];
};

static double factor(enum rhw_blend_factor f, int c, const double src[4], const double dst[4],
                     const double constant[4])
{
    switch (f) {
    case RHW_BLEND_DEFAULT: break; // test_zero.c has it
    case RHW_BLEND_ZERO: return 0;
    case RHW_BLEND_ONE: return 1;
    case RHW_BLEND_SRC: return src[c];
    case RHW_BLEND_ONE_MINUS_SRC: return 1 - src[c];
    case RHW_BLEND_SRC_ALPHA: return src[3];
    case RHW_BLEND_ONE_MINUS_SRC_ALPHA: return 1 - src[3];
    case RHW_BLEND_DST: return dst[c];
    case RHW_BLEND_ONE_MINUS_DST: return 1 - dst[c];
    case RHW_BLEND_DST_ALPHA: return dst[3];
    case RHW_BLEND_ONE_MINUS_DST_ALPHA: return 1 - dst[3];
    case RHW_BLEND_SRC_ALPHA_SATURATED: return c == 3 ? 1 : fmin(src[3], 1 - dst[3]);
    case RHW_BLEND_CONSTANT: return constant[c];
    case RHW_BLEND_ONE_MINUS_CONSTANT: return 1 - constant[c];
    case RHW_BLEND_CONSTANT_ALPHA: return constant[3];
    case RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA: return 1 - constant[3];
    case RHW_BLEND_SRC1: // test_texel_formats.c has the second source
    case RHW_BLEND_ONE_MINUS_SRC1:
    case RHW_BLEND_SRC1_ALPHA:
    case RHW_BLEND_ONE_MINUS_SRC1_ALPHA: break;
    }
    return NAN;
}

static double blend(const struct blend_case *row, int c, const double constant[4])
{
    const struct rhw_blend_component *part = c == 3 ? &row->alpha : &row->color;
    const double src = row->src[c] * factor(part->src, c, row->src, row->dst, constant);
    const double dst = row->dst[c] * factor(part->dst, c, row->src, row->dst, constant);
    switch (part->operation) {
    case RHW_BLEND_ADD: return src + dst;
    case RHW_BLEND_SUBTRACT: return src - dst;
    case RHW_BLEND_REVERSE_SUBTRACT: return dst - src;
    case RHW_BLEND_MIN: return fmin(row->src[c], row->dst[c]); // factors do not count
    case RHW_BLEND_MAX: return fmax(row->src[c], row->dst[c]);
    }
    return NAN;
}

// Draws one pixel of the target per case, over what the target holds.
static void draw_cases(struct rig *rig, const struct blend_case *rows, int count, const float constant[4])
{
    rig->pass.colors[0].load = RHW_LOAD_LOAD;
    rig_begin(rig);
    rhw_pass_set_blend_constant(rig->context, rig->recording, constant);
    for (int i = 0; i < count; i++) {
        const float x = (float)(i % rig->width), y = (float)(i / rig->width);
        struct rig_vertex square[6];
        float src[4];
        for (int c = 0; c < 4; c++) {
            src[c] = (float)rows[i].src[c];
        }
        rig_rectangle(rig, x, y, x + 1, y + 1, 0.5f, src, square);
        rig->pipeline.targets[0].blend = true;
        rig->pipeline.targets[0].color = rows[i].color;
        rig->pipeline.targets[0].alpha = rows[i].alpha;
        rig_draw(rig, square, 6);
    }
    rig_end(rig);
}

static void test_every_factor_and_operation(void **state)
{
    (void)state;
    enum { COUNT = FACTORS * FACTORS * OPERATIONS };
    static struct blend_case rows[COUNT];
    static float texels[32 * 32][4];
    struct rig rig;
    rig_open(&rig, 32, 32);
    uint64_t random = 5;
    for (int i = 0; i < COUNT; i++) {
        rows[i].color.src = (enum rhw_blend_factor)(RHW_BLEND_ZERO + i % FACTORS);
        rows[i].color.dst = (enum rhw_blend_factor)(RHW_BLEND_ZERO + i / FACTORS % FACTORS);
        rows[i].color.operation = (enum rhw_blend_operation)(i / (FACTORS * FACTORS));
        // Alpha blends with factors of its own, and gets round to every combination as well.
        rows[i].alpha.src = (enum rhw_blend_factor)(RHW_BLEND_ZERO + (i + 5) / FACTORS % FACTORS);
        rows[i].alpha.dst = (enum rhw_blend_factor)(RHW_BLEND_ZERO + (i + 5) % FACTORS);
        rows[i].alpha.operation = (enum rhw_blend_operation)((i / (FACTORS * FACTORS) + 2) % OPERATIONS);
        for (int c = 0; c < 4; c++) {
            rows[i].src[c] = (double)rig_random_float(&random, -0.5f, 1.5f);
            texels[i][c] = rig_random_float(&random, -0.5f, 1.5f);
            rows[i].dst[c] = (double)texels[i][c];
        }
    }
    rhw_texture_write(rig.context, rig.pass.colors[0].texture, 0, texels, 0);
    const float constant[4] = {0.3f, -0.7f, 1.2f, 0.6f};
    draw_cases(&rig, rows, COUNT, constant);
    const double constant_exact[4] = {(double)constant[0], (double)constant[1], (double)constant[2],
                                      (double)constant[3]};
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < COUNT; i++) {
        for (int c = 0; c < 4; c++) {
            // Three roundings of terms below 4.
            const double expected = blend(&rows[i], c, constant_exact);
            if (fabs((double)pixels[i][c] - expected) > 2 * rig_ulp(4)) {
                fail_msg("case %d channel %d: %.9g, not %.9g", i, c, (double)pixels[i][c], expected);
            }
        }
    }
    for (int i = COUNT; i < 32 * 32; i++) {
        assert_memory_equal(pixels[i], texels[i], sizeof pixels[i]);
    }
    rig_close(&rig);
}

// Whether a byte is what `value` rounds to; a value within a hundredth of a tie may go either way.
static bool is_unorm8(unsigned byte, double value)
{
    const double scaled = fmin(fmax(value, 0), 1) * 255;
    return fabs((double)byte - scaled) <= 0.51;
}

// Blends random colours over random texels of an 8-bit format. What is blended is clamped to 0..1 first.
static void check_fixed_point(enum rhw_format format)
{
    static const struct rhw_blend_component kinds[] = {
        {RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD},
        {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD},
        {RHW_BLEND_DST, RHW_BLEND_ZERO, RHW_BLEND_ADD},
        {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_SUBTRACT},
        {RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_MAX},
        {RHW_BLEND_ONE_MINUS_DST_ALPHA, RHW_BLEND_DST_ALPHA, RHW_BLEND_ADD},
        {RHW_BLEND_SRC_ALPHA_SATURATED, RHW_BLEND_ONE, RHW_BLEND_ADD},
    };
    enum { COUNT = 30 * 30 };
    static struct blend_case rows[COUNT];
    static unsigned char texels[COUNT * 4];
    struct rig rig;
    rig_open(&rig, 30, 30);
    rig_set_target(&rig, 0, format);
    const bool srgb = format == RHW_FORMAT_RGBA8_SRGB;
    uint64_t random = 6 + (uint64_t)format;
    for (int i = 0; i < COUNT; i++) {
        rows[i].color = kinds[i % 7];
        rows[i].alpha = kinds[(i / 7 + 3) % 7];
        for (int c = 0; c < 4; c++) {
            rows[i].src[c] = (double)rig_random_float(&random, -0.25f, 1.25f);
            const int byte = rig_random_int(&random, 256);
            texels[i * 4 + c] = (unsigned char)byte;
            rows[i].dst[c] = srgb && c < 3 ? ref_srgb_decode(byte / 255.0) : byte / 255.0;
        }
    }
    rhw_texture_write(rig.context, rig.pass.colors[0].texture, 0, texels, 0);
    draw_cases(&rig, rows, COUNT, (const float[4]){0, 0, 0, 0});
    const unsigned char *bytes = rig_read(&rig, rig.pass.colors[0].texture);
    for (int i = 0; i < COUNT; i++) {
        for (int c = 0; c < 4; c++) {
            rows[i].src[c] = fmin(fmax((double)(float)rows[i].src[c], 0), 1);
        }
        for (int c = 0; c < 4; c++) {
            double expected = fmin(fmax(blend(&rows[i], c, (const double[4]){0}), 0), 1);
            if (srgb && c < 3) {
                expected = ref_srgb_encode(expected);
            }
            if (!is_unorm8(bytes[i * 4 + c], expected)) {
                fail_msg("format %d case %d channel %d: %d, not %.3f", format, i, c, bytes[i * 4 + c],
                         expected * 255);
            }
        }
    }
    rig_close(&rig);
}

static void test_blending_in_8_bit_formats(void **state)
{
    (void)state;
    check_fixed_point(RHW_FORMAT_RGBA8_UNORM);
    check_fixed_point(RHW_FORMAT_RGBA8_SRGB);
}

static void test_blending_in_float_formats(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 16, 16);
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_R32_FLOAT};
    for (int f = 0; f < 2; f++) {
        rig_set_target(&rig, 0, formats[f]);
        rig.pass.colors[0].clear[0] = 3.5f; // not clamped
        rig.pipeline.targets[0].blend = true;
        rig.pipeline.targets[0].color =
            (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
        struct rig_vertex all[6];
        rig_cover(&rig, 0.5f, (const float[4]){-1.25f, 0, 0, 0}, all);
        rig_begin(&rig);
        rig_draw(&rig, all, 6);
        rig_draw(&rig, all, 6);
        rig_draw(&rig, all, 6);
        rig_end(&rig);
        const void *texels = rig_read(&rig, rig.pass.colors[0].texture);
        if (f == 0) {
            assert_true(ref_half(*(const uint16_t *)texels) == -0.25);
        } else {
            assert_true(*(const float *)texels == -0.25f);
        }
    }
    rig_close(&rig);
}

// Fills a target of `format` with one colour by a draw (or by the clear) and gives its first texel.
static const void *fill(struct rig *rig, const float color[4], bool by_clear)
{
    struct rig_vertex all[6];
    rig_cover(rig, 0.5f, color, all);
    if (by_clear) {
        memcpy(rig->pass.colors[0].clear, color, 4 * sizeof *color);
    }
    rig_begin(rig);
    if (!by_clear) {
        rig_draw(rig, all, 6);
    }
    rig_end(rig);
    memset(rig->pass.colors[0].clear, 0, 4 * sizeof *color);
    return rig_read(rig, rig->pass.colors[0].texture);
}

static void test_encoding_on_write(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 1, 1);
    for (int by_clear = 0; by_clear < 2; by_clear++) {
        uint64_t random = 7;
        rig_set_target(&rig, 0, RHW_FORMAT_RGBA8_UNORM);
        for (int i = 0; i < 600; i++) {
            const float v = rig_random_float(&random, -0.1f, 1.1f);
            const unsigned char *bytes = fill(&rig, (const float[4]){v, 1 - v, 0.5f, v}, by_clear != 0);
            assert_true(is_unorm8(bytes[0], (double)v) && is_unorm8(bytes[1], (double)(1 - v)));
            assert_true(is_unorm8(bytes[3], (double)v));
            assert_int_equal(bytes[2], 128); // 127.5 to even
        }
        rig_set_target(&rig, 0, RHW_FORMAT_RGBA8_SRGB);
        for (int i = 0; i < 600; i++) {
            const float v = rig_random_float(&random, -0.1f, 1.1f);
            const double clamped = fmin(fmax((double)v, 0), 1);
            const unsigned char *bytes = fill(&rig, (const float[4]){v, v, v, v}, by_clear != 0);
            assert_true(is_unorm8(bytes[0], ref_srgb_encode(clamped)) && is_unorm8(bytes[3], clamped));
        }
        for (int byte = 0; byte < 256; byte++) {
            const float v = (float)ref_srgb_decode(byte / 255.0);
            const unsigned char *bytes = fill(&rig, (const float[4]){v, v, v, v}, by_clear != 0);
            assert_int_equal(bytes[1], byte);
        }
    }
    rig_close(&rig);
}

// Round to nearest, ties to even, overflow to infinity, subnormals kept.
static void test_half_floats_on_write(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 1, 1);
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA16_FLOAT);
    rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
    const struct {
        float value;
        uint16_t bits;
    } rows[] = {
        {0, 0},
        {-0.0f, 0x8000},
        {1, 0x3c00},
        {-2, 0xc000},
        {65504, 0x7bff},
        {65519, 0x7bff},
        {65520, 0x7c00},
        {1e10f, 0x7c00},
        {-1e10f, 0xfc00},
        {INFINITY, 0x7c00},
        {0x1p-24f, 1},
        {0x1p-25f, 0},
        {0x1.8p-24f, 2},
        {0x1.000002p-25f, 1},
        {0x1p-14f, 0x0400},
        {0x1.ff8p-15f, 0x03ff},
        {0x1.ffcp-15f, 0x0400},
        {1 + 0x1p-11f, 0x3c00},
        {1 + 0x1.8p-10f, 0x3c02},
        {1 + 0x1.2p-11f, 0x3c01},
        {0x1.fffp-15f, 0x0400},
        {1e-40f, 0},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        for (int by_clear = 0; by_clear < 2; by_clear++) {
            const float v = rows[i].value;
            const uint16_t *texel = fill(&rig, (const float[4]){v, v, v, v}, by_clear != 0);
            if (texel[0] != rows[i].bits || texel[3] != rows[i].bits) {
                fail_msg("%g is written as %04x, not %04x", (double)v, texel[0], rows[i].bits);
            }
        }
    }
    const uint16_t *texel = fill(&rig, (const float[4]){NAN, 0, 0, 0}, true);
    assert_true(isnan(ref_half(texel[0])));
    rig_close(&rig);
}

static void test_nan_is_zero_in_fixed_point(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 1, 1);
    rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB};
    for (int f = 0; f < 2; f++) {
        rig_set_target(&rig, 0, formats[f]);
        const unsigned char *bytes = fill(&rig, (const float[4]){NAN, INFINITY, -INFINITY, NAN}, false);
        const unsigned char expected[4] = {0, 255, 0, 0};
        assert_memory_equal(bytes, expected, 4);
    }
    rig_close(&rig);
}

static void test_write_mask(void **state)
{
    (void)state;
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_RGBA16_FLOAT,
                                       RHW_FORMAT_RGBA32_FLOAT};
    struct rig rig;
    rig_open(&rig, 20, 20);
    for (int f = 0; f < 4; f++) {
        rig_set_target(&rig, 0, formats[f]);
        const size_t channel = rhw_format_size(formats[f]) / 4;
        for (int blend_on = 0; blend_on < 2; blend_on++) {
            for (int mask = 0; mask < 16; mask++) {
                rig.pass.colors[0].clear[0] = rig.pass.colors[0].clear[1] = 0;
                rig.pass.colors[0].clear[2] = rig.pass.colors[0].clear[3] = 0;
                rig.pipeline.targets[0].write_mask = (uint8_t)(mask ? mask : RHW_WRITE_NONE);
                rig.pipeline.targets[0].blend = blend_on != 0;
                rig.pipeline.targets[0].color =
                    (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
                rig.pipeline.targets[0].alpha = rig.pipeline.targets[0].color;
                struct rig_vertex all[6];
                rig_cover(&rig, 0.5f, (const float[4]){1, 1, 1, 1}, all);
                rig_draw_once(&rig, all, 6);
                const unsigned char *bytes = rig_read(&rig, rig.pass.colors[0].texture);
                static const unsigned char zero[4] = {0};
                for (int i = 0; i < 20 * 20; i++) {
                    for (int c = 0; c < 4; c++) {
                        const bool written =
                            memcmp(bytes + ((size_t)i * 4 + (size_t)c) * channel, zero, channel) != 0;
                        assert_int_equal(written, mask >> c & 1);
                    }
                }
            }
        }
    }
    rig_close(&rig);
}

static void eight_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int t = 0; t < 8; t++) {
            for (int c = 0; c < 4; c++) {
                groups[g].color[t][c] = groups[g].varying[c] + (float)t;
            }
        }
    }
}

// Eight float targets, each with a blend and a mask of its own.
static void test_eight_targets_each_with_its_own_state(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 100, 70);
    rig_set_program(&rig, rig_vertex_pass, eight_fragment);
    for (int t = 0; t < 8; t++) {
        if (t > 0) {
            rig_set_target(&rig, t, t == 5 ? RHW_FORMAT_R32_FLOAT : RHW_FORMAT_RGBA32_FLOAT);
        }
        struct rhw_color_target *target = &rig.pipeline.targets[t];
        target->blend = t % 2 == 1;
        target->color = (struct rhw_blend_component){
            RHW_BLEND_ONE, t % 4 == 1 ? RHW_BLEND_ONE : RHW_BLEND_ZERO, RHW_BLEND_ADD};
        target->alpha = (struct rhw_blend_component){RHW_BLEND_ZERO, RHW_BLEND_ONE, RHW_BLEND_ADD};
        target->write_mask = (uint8_t)(15 - t);
        for (int c = 0; c < 4; c++) {
            rig.pass.colors[t].clear[c] = (float)(100 * (t + 1) + c);
        }
    }
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, (const float[4]){10, 20, 30, 40}, all);
    rig_draw_once(&rig, all, 6);
    for (int t = 0; t < 8; t++) {
        const float *texels = rig_read(&rig, rig.pass.colors[t].texture);
        const int channels = t == 5 ? 1 : 4;
        for (int i = 0; i < 100 * 70; i++) {
            for (int c = 0; c < channels; c++) {
                const float src = (float)(10 * (c + 1) + t), dst = (float)(100 * (t + 1) + c);
                float expected = t % 2 == 0 ? src : c == 3 ? dst : t % 4 == 1 ? src + dst : src;
                if (((15 - t) >> c & 1) == 0) {
                    expected = dst;
                }
                assert_true(texels[i * channels + c] == expected);
            }
        }
    }
    rig_close(&rig);
}

static void bits_fragment(struct rhw_fragment *groups, int count)
{
    // A signalling NaN for every primitive.
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = (rhw_float)(groups[g].primitive * 0x00010101 + 0x7fa00001);
    }
}

static uint32_t pattern(uint32_t primitive)
{
    return primitive * 0x00010101u + 0x7fa00001u;
}

// R32_UINT takes the bits of the first channel, signalling NaNs and all.
// Factors are held to what a target holds: 1 − (−1) is 1 in SNORM formats (Vulkan 1.3 §29.1), by destination and constant.
static void test_factors_of_snorm_targets(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_SNORM, RHW_FORMAT_RGBA16_SNORM};
    static const enum rhw_blend_factor factors[] = {RHW_BLEND_ONE_MINUS_DST, RHW_BLEND_ONE_MINUS_CONSTANT,
                                                    RHW_BLEND_ONE_MINUS_DST_ALPHA};
    for (int n = 0; n < 6; n++) {
        struct rig rig;
        rig_open(&rig, 16, 16);
        rig_set_target(&rig, 0, formats[n % 2]);
        for (int c = 0; c < 4; c++) {
            rig.pass.colors[0].clear[c] = -1;
        }
        rig.pipeline.targets[0].blend = true;
        rig.pipeline.targets[0].color = rig.pipeline.targets[0].alpha =
            (struct rhw_blend_component){factors[n / 2], RHW_BLEND_ZERO, RHW_BLEND_ADD};
        struct rig_vertex all[6];
        rig_cover(&rig, 0.5f, (const float[4]){0.25f, 0.25f, 0.25f, 0.25f}, all);
        rig_begin(&rig);
        rhw_pass_set_blend_constant(rig.context, rig.recording, (const float[4]){-1, -1, -1, -1});
        rig_draw(&rig, all, 6);
        rig_end(&rig);
        const void *const texels = rig_read(&rig, rig.pass.colors[0].texture);
        int16_t red;
        memcpy(&red, texels, sizeof red);
        assert_int_equal(n % 2 ? red : *(const int8_t *)texels,
                         n % 2 ? 8192 : 32); // round(0.25 · 32767 or 127)
        rig_close(&rig);
    }
}

static void test_integer_target(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 32, 32);
    rig_set_target(&rig, 0, RHW_FORMAT_R32_UINT);
    rig_set_program(&rig, rig_vertex_pass, bits_fragment);
    rig.pipeline.program.uses = RHW_USE_IDS;
    rig.pass.colors[0].clear_integer[0] = 70000;
    struct rig_vertex columns[18];
    for (int i = 0; i < 3; i++) {
        rig_rectangle(&rig, (float)i * 8, 0, (float)i * 8 + 8, 32, 0.5f, (const float[4]){0},
                      columns + 6 * i);
    }
    rig_draw_once(&rig, columns, 18);
    const uint32_t *texels = rig_read(&rig, rig.pass.colors[0].texture);
    for (int y = 0; y < 32; y++) {
        assert_int_equal(texels[y * 32 + 31], 70000);
        for (uint32_t i = 0; i < 3; i++) {
            // The lower left corner belongs to the first triangle of a column, the upper right to the second.
            if (y > 24) {
                assert_int_equal(texels[(uint32_t)y * 32 + i * 8], pattern(2 * i));
            }
            if (y < 8) {
                assert_int_equal(texels[(uint32_t)y * 32 + i * 8 + 7], pattern(2 * i + 1));
            }
        }
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_every_factor_and_operation),
    cmocka_unit_test(test_blending_in_8_bit_formats),
    cmocka_unit_test(test_blending_in_float_formats),
    cmocka_unit_test(test_encoding_on_write),
    cmocka_unit_test(test_half_floats_on_write),
    cmocka_unit_test(test_nan_is_zero_in_fixed_point),
    cmocka_unit_test(test_write_mask),
    cmocka_unit_test(test_eight_targets_each_with_its_own_state),
    cmocka_unit_test(test_factors_of_snorm_targets),
    cmocka_unit_test(test_integer_target),
};

const struct unit_tests test_blend = UNIT_TESTS(tests, NULL, NULL);
