// SPDX-License-Identifier: MIT
// Textures: mip generation, storage, and what is misuse.
#include "texture_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "context/context.h"
#include "format/format.h"
#include "context/lookup.h"
#include "reference.h"

// Mips -----------------------------------------------------------------------------------------------

// How much of texel j of `larger` the texel i of `smaller` covers along one axis, in shares of 1.
static double coverage(int larger, int smaller, int i, int j)
{
    const double width = (double)larger / smaller;
    const double low = fmax(i * width, j), high = fmin((i + 1) * width, j + 1);
    return fmax(high - low, 0) / width;
}

// The level below `from`, in unrounded linear values.
static double *model_reduce(const double *from, int width, int height, int to_width, int to_height)
{
    double *const to = calloc((size_t)to_width * (size_t)to_height * 4, sizeof *to);
    for (int y = 0; y < to_height; y++) {
        for (int x = 0; x < to_width; x++) {
            for (int j = 0; j < height; j++) {
                for (int i = 0; i < width; i++) {
                    const double share = coverage(height, to_height, y, j) * coverage(width, to_width, x, i);
                    for (int c = 0; c < 4; c++) {
                        to[(y * to_width + x) * 4 + c] += share * from[(j * width + i) * 4 + c];
                    }
                }
            }
        }
    }
    return to;
}

// A stored texel against the value it should hold: half a step of its format, and a little for the float
// arithmetic on the way.
static void expect_texel(enum rhw_format format, const unsigned char *texel, const double value[4])
{
    double stored[4];
    model_decode(format, texel, stored);
    const int channels =
        format == RHW_FORMAT_R8_UNORM || format == RHW_FORMAT_R32_FLOAT || format == RHW_FORMAT_D32_FLOAT ? 1
        : format == RHW_FORMAT_RG8_UNORM                                                                  ? 2
                                                                                                          : 4;
    for (int c = 0; c < channels; c++) {
        double error, allowed;
        if (format == RHW_FORMAT_RGBA8_SRGB && c < 3) {
            error = (ref_srgb_encode(stored[c]) - ref_srgb_encode(value[c])) * 255;
            allowed = 0.501;
        } else if (format <= RHW_FORMAT_RGBA8_SRGB) {
            error = (stored[c] - value[c]) * 255;
            allowed = 0.5001;
        } else {
            error = stored[c] - value[c];
            // Numbers below 4 that cancel each other leave what floats round of them.
            allowed =
                format < RHW_FORMAT_R32_FLOAT ? fmax(fabs(value[c]), 6.2e-5) * 0x1.01p-11 + 0x1p-22 : 2e-6;
        }
        if (!(fabs(error) <= allowed)) {
            fail_msg("format %d: a texel of %.9g is stored as %.9g", (int)format, value[c], stored[c]);
        }
    }
}

static void test_mips_are_box_filtered_in_linear_light(void **state)
{
    (void)state;
    static const int mip_sizes[][2] = {{8, 8}, {16, 4}, {7, 5},  {1, 9},  {13, 1},
                                       {6, 3}, {1, 1},  {31, 2}, {23, 17}};
    struct rig rig;
    rig_open(&rig, 8, 8);
    uint64_t random = 6;
    for (int n = 0; n < SAMPLED_FORMATS * (int)(sizeof mip_sizes / sizeof mip_sizes[0]); n++) {
        const enum rhw_format format = sampled_formats[n % SAMPLED_FORMATS];
        int width = mip_sizes[n / SAMPLED_FORMATS][0], height = mip_sizes[n / SAMPLED_FORMATS][1];
        const rhw_texture texture =
            model_random_texture(rig.context, format, width, height, RHW_MIP_LEVELS_ALL, &random);
        const struct rhw_texture_data *const data = rhw_context_texture(rig.context, texture, "test");
        rhw_texture_generate_mips(rig.context, texture);
        double *values = malloc((size_t)(width * height * 4) * sizeof *values);
        for (int i = 0; i < width * height; i++) {
            model_decode(format,
                         data->mip[0].texels + (size_t)(i / width) * data->mip[0].row_pitch +
                             (size_t)(i % width) * rhw_format_size(format),
                         values + 4 * i);
        }
        for (int level = 1; level < data->levels; level++) {
            const struct rhw_mip *const mip = &data->mip[level];
            double *const next = model_reduce(values, width, height, mip->width, mip->height);
            free(values);
            values = next;
            width = mip->width;
            height = mip->height;
            for (int i = 0; i < width * height; i++) {
                expect_texel(format,
                             mip->texels + (size_t)(i / width) * mip->row_pitch +
                                 (size_t)(i % width) * rhw_format_size(format),
                             values + 4 * i);
            }
        }
        assert_int_equal(width * height, 1);
        free(values);
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

// Storage ------------------------------------------------------------------------------------

static void test_write_and_read_keep_every_byte(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    uint64_t random = 7;
    for (int format = RHW_FORMAT_R8_UNORM; format < RHW_PLAIN_FORMAT_COUNT; format++) {
        struct rhw_texture_def def = rhw_texture_def_default();
        def.format = (enum rhw_format)format;
        def.width = 13;
        def.height = 6;
        def.mip_levels = RHW_MIP_LEVELS_ALL;
        rhw_texture texture;
        assert_int_equal(rhw_texture_create(rig.context, &def, &texture), RHW_OK);
        assert_int_equal(rhw_texture_mip_levels(rig.context, texture), 4);
        assert_int_equal(rhw_texture_format(rig.context, texture), format);
        for (int level = 0; level < 4; level++) {
            const int width = rhw_texture_width(rig.context, texture, level);
            const int height = rhw_texture_height(rig.context, texture, level);
            assert_int_equal(width, 13 >> level);
            assert_int_equal(height, level == 3 ? 1 : 6 >> level);
            const size_t row = (size_t)width * rhw_format_size(def.format), pitch = row + 5;
            unsigned char in[13 * 16 * 6], out[(13 * 16 + 5) * 6];
            memset(out, 0xa5, sizeof out);
            rhw_texture_read(rig.context, texture, level, out, 0);
            for (size_t i = 0; i < row * (size_t)height; i++) {
                assert_int_equal(out[i], 0); // zeroed when created
                in[i] = (unsigned char)rig_random(&random);
            }
            rhw_texture_write(rig.context, texture, level, in, 0);
            memset(out, 0xa5, sizeof out);
            rhw_texture_read(rig.context, texture, level, out, pitch);
            for (size_t i = 0; i < pitch * (size_t)height; i++) {
                const size_t x = i % pitch, y = i / pitch;
                assert_int_equal(out[i], x < row ? in[y * row + x] : 0xa5);
            }
            rhw_texture_write(rig.context, texture, level, out, pitch);
            rhw_texture_read(rig.context, texture, level, out, 0);
            assert_memory_equal(out, in, row * (size_t)height);
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

static void test_misuse_is_named(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rhw_context *const context = rig.context;
    const struct rhw_texture_def good = {.format = RHW_FORMAT_RGBA8_UNORM, .width = 4, .height = 4};
    const struct {
        struct rhw_texture_def def;
        const char *words;
    } bad[] = {
        {{.format = RHW_FORMAT_NONE, .width = 4, .height = 4, .mip_levels = 1}, "format"},
        {{.format = RHW_FORMAT_COUNT, .width = 4, .height = 4, .mip_levels = 1}, "format"},
        {{.format = RHW_FORMAT_RGBA8_UNORM, .width = 0, .height = 4, .mip_levels = 1}, "width is 0"},
        {{.format = RHW_FORMAT_RGBA8_UNORM, .width = 4, .height = 16385, .mip_levels = 1}, "height is 16385"},
        {{.format = RHW_FORMAT_RGBA8_UNORM, .width = 4, .height = -1, .mip_levels = 1}, "height is -1"},
        {{.format = RHW_FORMAT_RGBA8_UNORM, .width = 4, .height = 4, .mip_levels = 4}, "mip_levels is 4"},
        {{.format = RHW_FORMAT_RGBA8_UNORM, .width = 4, .height = 4, .mip_levels = -2}, "mip_levels is -2"},
    };
    rhw_texture texture;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        texture.index = 9;
        assert_int_equal(rhw_texture_create(context, &bad[i].def, &texture), RHW_ERROR_MISUSE);
        assert_int_equal(texture.index, 0);
        rig_expect_misuse(&rig, bad[i].words);
    }
    assert_int_equal(rhw_texture_create(context, &good, &texture), RHW_OK);
    unsigned char texels[64];
    rhw_texture_write(context, texture, 3, texels, 0);
    rig_expect_misuse(&rig, "level is 3");
    rhw_texture_read(context, texture, -1, texels, 0);
    rig_expect_misuse(&rig, "level is -1");
    rhw_texture_write(context, texture, 0, NULL, 0);
    rig_expect_misuse(&rig, "data is NULL");
    rhw_texture_write(context, texture, 0, texels, 15);
    rig_expect_misuse(&rig, "row_pitch is 15");
    assert_int_equal(rhw_texture_width(context, texture, 3), 0);
    rig_expect_misuse(&rig, "level is 3");
    rhw_texture_destroy(context, texture);
    rhw_texture_destroy(context, texture);
    rig_expect_misuse(&rig, "rhw_texture_destroy");
    const struct rhw_texture_def ids = {.format = RHW_FORMAT_R32_UINT, .width = 4, .height = 4};
    assert_int_equal(rhw_texture_create(context, &ids, &texture), RHW_OK);
    rhw_texture_generate_mips(context, texture);
    rig_expect_misuse(&rig, "RHW_FORMAT_R32_UINT");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_mips_are_box_filtered_in_linear_light),
    cmocka_unit_test(test_write_and_read_keep_every_byte),
    cmocka_unit_test(test_misuse_is_named),
};

const struct unit_tests test_texture = UNIT_TESTS(tests, NULL, NULL);
