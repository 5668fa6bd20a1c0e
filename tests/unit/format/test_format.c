// SPDX-License-Identifier: MIT
// Rows of the table of texel formats, against a table of what they have to mean: bytes, roles, and the texels that
// clearing, drawing and sampling make of known values. All colour formats stand in test_texel_formats.c.
#include "harness.h"

#include <string.h>

#include "format/format.h"
#include "kernels/texel/texel_codec.h"

struct expectation {
    enum rhw_format format;
    const char *name;
    int size;
    int roles;
    float value[4];            // cleared to, or drawn
    unsigned char cleared[16]; // what clearing stores
    float sampled[4];          // what sampling that gives
};

enum {
    SAMPLED = RHW_ROLE_SAMPLED | RHW_ROLE_FILTERED,
    FETCHED = RHW_ROLE_SAMPLED,
    COLOR = RHW_ROLE_COLOR_TARGET,
    BLENDED = RHW_ROLE_COLOR_TARGET | RHW_ROLE_BLENDED_TARGET,
    DEPTH = RHW_ROLE_DEPTH_TARGET,
    STENCIL = RHW_ROLE_STENCIL_TARGET
};

#define NAMED(format) format, #format

// 0.25, 0.5, 0.75 and 1 are the halves 3400, 3800, 3a00, 3c00, the floats 3e800000, 3f000000, 3f400000, 3f800000 and, in
// sRGB, the codes nearest to 136.96, 187.52, 224.61 and (alpha is linear) 255.
static const struct expectation expected[] = {
    {NAMED(RHW_FORMAT_R8_UNORM), 1, SAMPLED | BLENDED, {0.25f, 0.5f, 0.75f, 1}, {64}, {64 / 255.0f, 0, 0, 1}},
    {NAMED(RHW_FORMAT_RG8_UNORM),
     2,
     SAMPLED | BLENDED,
     {0.25f, 0.5f, 0.75f, 1},
     {64, 128},
     {64 / 255.0f, 128 / 255.0f, 0, 1}},
    {NAMED(RHW_FORMAT_RGBA8_UNORM),
     4,
     SAMPLED | BLENDED,
     {0.25f, 0.5f, 0.75f, 1},
     {64, 128, 191, 255},
     {64 / 255.0f, 128 / 255.0f, 191 / 255.0f, 1}},
    {NAMED(RHW_FORMAT_RGBA8_SRGB),
     4,
     SAMPLED | BLENDED,
     {0.25f, 0.5f, 0.75f, 1},
     {137, 188, 225, 255},
     {0.250158280f, 0.502886474f, 0.752942205f, 1}},
    {NAMED(RHW_FORMAT_RGBA16_FLOAT),
     8,
     SAMPLED | BLENDED,
     {0.25f, 0.5f, 0.75f, 1},
     {0x00, 0x34, 0x00, 0x38, 0x00, 0x3a, 0x00, 0x3c},
     {0.25f, 0.5f, 0.75f, 1}},
    {NAMED(RHW_FORMAT_R32_FLOAT),
     4,
     SAMPLED | BLENDED,
     {0.25f, 0.5f, 0.75f, 1},
     {0, 0, 0x80, 0x3e},
     {0.25f, 0, 0, 1}},
    {NAMED(RHW_FORMAT_RGBA32_FLOAT),
     16,
     SAMPLED | BLENDED,
     {0.25f, 0.5f, 0.75f, 1},
     {0, 0, 0x80, 0x3e, 0, 0, 0, 0x3f, 0, 0, 0x40, 0x3f, 0, 0, 0x80, 0x3f},
     {0.25f, 0.5f, 0.75f, 1}},
    // The bits of what a shader wrote; the alpha that it lacks is the integer 1.
    {NAMED(RHW_FORMAT_R32_UINT),
     4,
     FETCHED | COLOR,
     {0.25f, 0.5f, 0.75f, 1},
     {0, 0, 0x80, 0x3e},
     {0.25f, 0, 0, 0x1p-149f}},
    {NAMED(RHW_FORMAT_D32_FLOAT), 4, SAMPLED | DEPTH, {0.25f, 0, 0, 0}, {0, 0, 0x80, 0x3e}, {0.25f, 0, 0, 1}},
    // A quarter of 65535 is 16383.75, of 16777215 4194303.75.
    {NAMED(RHW_FORMAT_D16_UNORM),
     2,
     SAMPLED | DEPTH,
     {0.25f, 0, 0, 0},
     {0x00, 0x40},
     {(float)(16384 / 65535.0), 0, 0, 1}},
    {NAMED(RHW_FORMAT_D24_UNORM),
     4,
     SAMPLED | DEPTH,
     {0.25f, 0, 0, 0},
     {0x00, 0x00, 0x40, 0},
     {(float)(4194304 / 16777215.0), 0, 0, 1}},
    {NAMED(RHW_FORMAT_D24_UNORM_S8_UINT),
     4,
     SAMPLED | DEPTH | STENCIL,
     {0.25f, 0, 0, 0},
     {0x00, 0x00, 0x40, 0},
     {(float)(4194304 / 16777215.0), 0, 0, 1}},
    {NAMED(RHW_FORMAT_D32_FLOAT_S8_UINT),
     4,
     SAMPLED | DEPTH | STENCIL,
     {0.25f, 0, 0, 0},
     {0, 0, 0x80, 0x3e},
     {0.25f, 0, 0, 1}},
    {NAMED(RHW_FORMAT_S8_UINT), 1, STENCIL, {0.25f, 0, 0, 0}, {0}, {0}},
};
enum { ROWS = sizeof expected / sizeof expected[0], SIDE = 9, TEXELS = SIDE * SIDE };

static void expect_texels(const struct expectation *row, const unsigned char *texels,
                          const unsigned char *texel)
{
    for (int i = 0; i < TEXELS; i++) {
        if (memcmp(texels + (size_t)i * (size_t)row->size, texel, (size_t)row->size) != 0) {
            fail_msg("%s: texel %d holds something else", row->name, i);
        }
    }
}

// Clears a texture of the format and draws into it, or is refused where that is no colour target.
static void expect_color(const struct expectation *row)
{
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    rig_set_target(&rig, 0, row->format);
    const bool is_integer = row->format == RHW_FORMAT_R32_UINT;
    memcpy(is_integer ? (void *)rig.pass.colors[0].clear_integer : rig.pass.colors[0].clear, row->value,
           sizeof row->value);
    if (!(row->roles & COLOR)) {
        rhw_pass pass;
        assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, row->name);
        rig_close(&rig);
        return;
    }
    rig_begin(&rig);
    rig_end(&rig);
    expect_texels(row, rig_read(&rig, rig.pass.colors[0].texture), row->cleared);
    // Drawing gives what clearing gives.
    memset(rig.pass.colors[0].clear, 0, sizeof rig.pass.colors[0].clear);
    memset(rig.pass.colors[0].clear_integer, 0, sizeof rig.pass.colors[0].clear_integer);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, row->value, all);
    rig_draw_once(&rig, all, 6);
    expect_texels(row, rig_read(&rig, rig.pass.colors[0].texture), row->cleared);
    rig.pipeline.targets[0].blend = true;
    rhw_pipeline pipeline;
    const bool blends = (row->roles & RHW_ROLE_BLENDED_TARGET) != 0;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline),
                     blends ? RHW_OK : RHW_ERROR_MISUSE);
    if (blends) {
        rhw_pipeline_destroy(rig.context, pipeline);
    } else {
        rig_expect_misuse(&rig, row->name);
    }
    rig_close(&rig);
}

static rhw_texture make_texture(struct rig *rig, const struct expectation *row)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = row->format;
    def.width = def.height = SIDE;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    unsigned char texels[TEXELS * 16];
    for (size_t i = 0; i < TEXELS; i++) {
        memcpy(texels + i * (size_t)row->size, row->cleared, (size_t)row->size);
    }
    rhw_texture_write(rig->context, texture, 0, texels, 0);
    return texture;
}

static void expect_depth(const struct expectation *row)
{
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    rig_set_depth(&rig);
    const rhw_texture texture = make_texture(&rig, row);
    rhw_texture_destroy(rig.context, rig.pass.depth.texture);
    rig.pass.depth.texture = texture;
    rig.pass.depth.clear = row->value[0];
    if (row->roles & (DEPTH | STENCIL)) {
        rig_begin(&rig);
        rig_end(&rig);
        expect_texels(row, rig_read(&rig, texture), row->cleared);
    } else {
        rhw_pass pass;
        assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, row->name);
    }
    rig_close(&rig);
}

static void sample_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_sample_lod(groups[g].textures, 0, groups[g].varying, rhw_splat(0), groups[g].color[0]);
    }
}

static void expect_sampled(const struct expectation *row)
{
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    struct rhw_sampler_def def = rhw_sampler_def_default();
    def.min_filter = def.mag_filter = RHW_FILTER_NEAREST;
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig.context, &def, &sampler), RHW_OK);
    rig_set_program(&rig, rig_vertex_pass, sample_fragment);
    const rhw_texture texture = make_texture(&rig, row);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, (const float[4]){0.25f, 0.25f, 0, 0}, all);
    rig_begin(&rig);
    rhw_pass_set_texture(rig.context, rig.recording, 0, texture, sampler);
    rig_draw(&rig, all, 6);
    rig_end(&rig);
    if (row->roles & FETCHED) {
        for (int i = 0; i < TEXELS; i++) {
            assert_memory_equal(rig_read_float4(&rig)[i], row->sampled, sizeof row->sampled);
        }
    } else {
        rig_expect_misuse(&rig, row->name);
    }
    rig_close(&rig);
}

static void test_every_row_says_the_truth(void **state)
{
    (void)state;
    for (int i = 0; i < ROWS; i++) {
        const struct expectation *const row = &expected[i];
        const struct rhw_format_info *const info = rhw_format_info(row->format);
        assert_string_equal(info->name, row->name);
        assert_int_equal(rhw_format_size(row->format), row->size);
        assert_int_equal(info->roles, row->roles);
        expect_color(row);
        expect_depth(row);
        expect_sampled(row);
    }
}

// Every depth that a UNORM format holds is the quotient, rounded once, and found again.
static void test_depths_are_quotients(void **state)
{
    (void)state;
    const enum rhw_texel_codec codecs[] = {RHW_CODEC_DEPTH16, RHW_CODEC_DEPTH24};
    for (int i = 0; i < 2; i++) {
        const double steps = rhw_codec_depth_steps(codecs[i]);
        for (int32_t first = 0; first <= (int32_t)steps; first += RHW_LANES) {
            const i32x8 codes = i32x8_splat(first) + rhw_lane_index;
            const f32x8 depth = depth_from_steps(f64x8_from_i32x8(codes), steps);
            const i32x8 again = rhw_int_from_float_unchecked(f32x8_from_f64x8(steps_of_depth(depth, steps)));
            for (int lane = 0; lane < RHW_LANES; lane++) {
                assert_true(depth[lane] == (float)((double)codes[lane] / steps));
                assert_true(again[lane] == codes[lane]);
            }
        }
    }
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_row_says_the_truth),
                                          cmocka_unit_test(test_depths_are_quotients)};

const struct unit_tests test_format = UNIT_TESTS(tests, NULL, NULL);
