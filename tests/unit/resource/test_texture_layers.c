// SPDX-License-Identifier: MIT
// Layers, faces and slices: written and read, their mip levels, drawn into, and cleared.
#include "harness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct rhw_texture_def layered[] = {
    {.width = 70, .kind = RHW_TEXTURE_1D, .layers = 3},
    {.width = 70, .height = 9, .layers = 4},
    {.width = 12, .height = 12, .kind = RHW_TEXTURE_CUBE},
    {.width = 7, .height = 7, .kind = RHW_TEXTURE_CUBE, .layers = 2},
    {.width = 9, .height = 6, .depth = 5, .kind = RHW_TEXTURE_3D},
};
enum { LAYERED = sizeof layered / sizeof *layered };

static int slices_of(const struct rig *rig, rhw_texture texture, int level)
{
    return rhw_texture_depth(rig->context, texture, level) * rhw_texture_layers(rig->context, texture);
}

static rhw_texture make(const struct rig *rig, struct rhw_texture_def def, enum rhw_format format, int levels)
{
    rhw_texture texture;
    def.format = format;
    def.mip_levels = levels;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static void test_layers_hold_what_was_written(void **state)
{
    (void)state;
    static const int counts[] = {3, 4, 6, 12, 5};
    struct rig rig;
    rig_open(&rig, 4, 4);
    for (int n = 0; n < LAYERED; n++) {
        const rhw_texture texture = make(&rig, layered[n], RHW_FORMAT_R32_FLOAT, RHW_MIP_LEVELS_ALL);
        assert_int_equal(slices_of(&rig, texture, 0), counts[n]);
        static float texels[70 * 9], read[70 * 9];
        for (int pass = 0; pass < 2; pass++) {
            for (int level = 0; level < rhw_texture_mip_levels(rig.context, texture); level++) {
                const int count = rhw_texture_width(rig.context, texture, level) *
                                  rhw_texture_height(rig.context, texture, level);
                for (int slice = 0; slice < slices_of(&rig, texture, level); slice++) {
                    for (int i = 0; i < count; i++) {
                        texels[i] = (float)(i + 1000 * slice + 100000 * level);
                    }
                    if (pass == 0) {
                        assert_int_equal(
                            rhw_texture_write_layer(rig.context, texture, level, slice, texels, 0), RHW_OK);
                    }
                    assert_int_equal(rhw_texture_read_layer(rig.context, texture, level, slice, read, 0),
                                     RHW_OK);
                    assert_memory_equal(read, texels, (size_t)count * sizeof *read);
                    if (slice == 0) {
                        assert_int_equal(rhw_texture_read(rig.context, texture, level, read, 0), RHW_OK);
                        assert_memory_equal(read, texels, (size_t)count * sizeof *read);
                    }
                }
            }
        }
    }
    rig_close(&rig);
}

// The levels of a layer are those of a plain texture that holds it.
static void test_levels_of_layers(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 5;
    for (int n = 0; n < LAYERED - 1; n++) {
        const rhw_texture texture = make(&rig, layered[n], RHW_FORMAT_RGBA8_SRGB, RHW_MIP_LEVELS_ALL);
        const struct rhw_texture_def flat = {.width = layered[n].width,
                                             .height = rhw_texture_height(rig.context, texture, 0)};
        static unsigned char texels[16][70 * 9 * 4], read[70 * 9 * 4], expected[70 * 9 * 4];
        for (int layer = 0; layer < slices_of(&rig, texture, 0); layer++) {
            for (size_t i = 0; i < sizeof texels[0]; i++) {
                texels[layer][i] = (unsigned char)rig_random(&random);
            }
            rhw_texture_write_layer(rig.context, texture, 0, layer, texels[layer], 0);
        }
        assert_int_equal(rhw_texture_generate_mips(rig.context, texture), RHW_OK);
        for (int layer = 0; layer < slices_of(&rig, texture, 0); layer++) {
            const rhw_texture plain = make(&rig, flat, RHW_FORMAT_RGBA8_SRGB, RHW_MIP_LEVELS_ALL);
            rhw_texture_write(rig.context, plain, 0, texels[layer], 0);
            rhw_texture_generate_mips(rig.context, plain);
            for (int level = 0; level < rhw_texture_mip_levels(rig.context, plain); level++) {
                memset(read, 0, sizeof read);
                memset(expected, 0, sizeof expected);
                rhw_texture_read_layer(rig.context, texture, level, layer, read, 0);
                rhw_texture_read(rig.context, plain, level, expected, 0);
                assert_memory_equal(read, expected, sizeof read);
            }
            rhw_texture_destroy(rig.context, plain);
        }
    }
    rig_close(&rig);
}

// What texel i of a level takes of texel j of the level above, along one axis of that size.
static double weight(int larger, int i, int j)
{
    const int smaller = larger > 1 ? larger / 2 : 1;
    // The part of the smaller texel's extent that the larger level's texel lies in.
    const double low = fmax((double)i / smaller, (double)j / larger),
                 high = fmin((i + 1.0) / smaller, (j + 1.0) / larger);
    return high > low ? (high - low) * smaller : 0;
}

static void test_levels_of_a_volume(void **state)
{
    (void)state;
    static const int sizes[][3] = {{8, 4, 4}, {9, 6, 5}, {1, 7, 16}, {33, 1, 3}, {6, 6, 1}};
    uint64_t random = 9;
    for (size_t n = 0; n < sizeof sizes / sizeof *sizes; n++) {
        struct rig rig;
        rig_open(&rig, 4, 4);
        const struct rhw_texture_def def = {
            .width = sizes[n][0], .height = sizes[n][1], .depth = sizes[n][2], .kind = RHW_TEXTURE_3D};
        const rhw_texture texture = make(&rig, def, RHW_FORMAT_RGBA32_FLOAT, RHW_MIP_LEVELS_ALL);
        static float above[16][64][4], made[64][4];
        const int levels = rhw_texture_mip_levels(rig.context, texture);
        for (int slice = 0; slice < sizes[n][2]; slice++) {
            for (int i = 0; i < sizes[n][0] * sizes[n][1]; i++) {
                for (int c = 0; c < 4; c++) {
                    above[slice][i][c] = rig_random_float(&random, -1, 1);
                }
            }
            rhw_texture_write_layer(rig.context, texture, 0, slice, above[slice], 0);
        }
        assert_int_equal(rhw_texture_generate_mips(rig.context, texture), RHW_OK);
        for (int level = 1; level < levels; level++) {
            const int width = rhw_texture_width(rig.context, texture, level - 1),
                      height = rhw_texture_height(rig.context, texture, level - 1),
                      depth = rhw_texture_depth(rig.context, texture, level - 1);
            const int w = rhw_texture_width(rig.context, texture, level),
                      h = rhw_texture_height(rig.context, texture, level);
            for (int z = 0; z < depth; z++) {
                rhw_texture_read_layer(rig.context, texture, level - 1, z, above[z], 0);
            }
            for (int z = 0; z < rhw_texture_depth(rig.context, texture, level); z++) {
                rhw_texture_read_layer(rig.context, texture, level, z, made, 0);
                for (int i = 0; i < w * h; i++) {
                    double sum = 0;
                    for (int j = 0; j < width * height * depth; j++) {
                        sum += weight(width, i % w, j % width) * weight(height, i / w, j / width % height) *
                               weight(depth, z, j / width / height) *
                               (double)above[j / width / height][j % (width * height)][2];
                    }
                    assert_true(fabs(sum - (double)made[i][2]) < 1e-6);
                }
            }
        }
        rig_close(&rig);
    }
}

static void expect_color(struct rig *rig, rhw_texture texture, int layer, int x, int y, float red)
{
    static float pixels[80 * 80][4];
    assert_int_equal(rhw_texture_read_layer(rig->context, texture, 0, layer, pixels, 0), RHW_OK);
    assert_true(pixels[80 * y + x][0] == red);
}

// Two layers of one texture in a pass, and a third that stays as it was; each knows by itself which tiles are clean.
static void test_layers_are_drawn_into(void **state)
{
    (void)state;
    static const struct rhw_texture_def targets[] = {
        {.width = 80, .height = 80, .layers = 3},
        {.width = 80, .height = 80, .kind = RHW_TEXTURE_CUBE},
        {.width = 80, .height = 80, .depth = 3, .kind = RHW_TEXTURE_3D},
    };
    for (int n = 0; n < 3; n++) {
        struct rig rig;
        rig_open(&rig, 80, 80);
        rig_set_target(&rig, 1, RHW_FORMAT_RGBA32_FLOAT);
        rig.pipeline.targets[1].write_mask = RHW_WRITE_NONE;
        const rhw_texture texture = make(&rig, targets[n], RHW_FORMAT_RGBA32_FLOAT, 1);
        struct rig_vertex square[6];
        const float seven[4] = {7, 7, 7, 7};
        rig_rectangle(&rig, 10, 10, 20, 20, 0.5f, seven, square);
        for (int frame = 0; frame < 3;
             frame++) { // cleared by turns to other values: no tile is taken for clean
            for (int i = 0; i < 2; i++) {
                rig.pass.colors[i].texture = texture;
                rig.pass.colors[i].layer = 2 - i;
                rig.pass.colors[i].clear[0] = (float)(i + 1 + frame);
            }
            rig_draw_once(&rig, square, 6);
            expect_color(&rig, texture, 2, 15, 15, 7);
            expect_color(&rig, texture, 2, 70, 70, (float)(1 + frame));
            expect_color(&rig, texture, 1, 15, 15, (float)(2 + frame));
            expect_color(&rig, texture, 1, 70, 70, (float)(2 + frame));
            expect_color(&rig, texture, 0, 15, 15, 0);
            expect_color(&rig, texture, 0, 70, 70, 0);
        }
        rig_close(&rig);
    }
}

static void expect_refused(struct rig *rig, const struct rhw_texture_def *def, const char *part)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, def, &texture), RHW_ERROR_MISUSE);
    rig_expect_misuse(rig, part);
}

static void test_misuse_of_definitions(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    static const struct {
        struct rhw_texture_def def;
        const char *part;
    } cases[] = {
        {{.width = 4, .height = 4, .kind = (enum rhw_texture_kind)4}, "kind is 4; it must be 0..3"},
        {{.width = 4, .height = 2, .kind = RHW_TEXTURE_1D}, "height is 2; a 1D texture has none"},
        {{.width = 4, .height = 4, .kind = RHW_TEXTURE_3D}, "depth is 0; it must be 1..2048"},
        {{.width = 4, .height = 4, .depth = 2049, .kind = RHW_TEXTURE_3D}, "depth is 2049"},
        {{.width = 4, .height = 4, .depth = 2, .layers = 2, .kind = RHW_TEXTURE_3D},
         "layers is 2; a 3D texture"},
        {{.width = 4, .height = 4, .depth = 2}, "depth is 2; this kind has none"},
        {{.width = 4, .height = 4, .layers = -1}, "layers is -1; it must be 0..2048"},
        {{.width = 4, .height = 4, .layers = 342, .kind = RHW_TEXTURE_CUBE},
         "layers is 342; it must be 0..341"},
        {{.width = 4, .height = 5, .kind = RHW_TEXTURE_CUBE}, "4x5; its faces must be square"},
        {{.width = 4, .mip_levels = 4, .kind = RHW_TEXTURE_1D}, "mip_levels is 4"},
        {{.width = 2048, .height = 2048, .depth = 512, .kind = RHW_TEXTURE_3D}, "fewer than 2^31 texels"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct rhw_texture_def def = cases[i].def;
        def.format = RHW_FORMAT_RGBA8_UNORM;
        expect_refused(&rig, &def, cases[i].part);
    }
    rig_close(&rig);
}

static void test_misuse_of_layers(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    struct rhw_texture_def def = layered[2];
    def.label = "sky";
    const rhw_texture cube = make(&rig, def, RHW_FORMAT_RGBA32_FLOAT, 1);
    float texels[12 * 12 * 4] = {0};
    assert_int_equal(rhw_texture_write_layer(rig.context, cube, 0, 6, texels, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_texture_write_layer: layer is 6; level 0 of");
    assert_int_equal(rhw_texture_read_layer(rig.context, cube, 0, -1, texels, 0), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_texture_read_layer: layer is -1; level 0 of");
    rhw_pass pass;
    rig.pass.colors[0].texture = cube;
    rig.pass.colors[0].layer = 6;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_pass_begin: colors[0].layer is 6; level 0 of");
    rig.pass.color_count = 2;
    rig.pass.colors[1] = rig.pass.colors[0];
    rig.pass.colors[0].layer = rig.pass.colors[1].layer = 3;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "each needs its own texture or layer");
    rig.pass.color_count = 1;
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_layers_hold_what_was_written), cmocka_unit_test(test_levels_of_layers),
    cmocka_unit_test(test_levels_of_a_volume),           cmocka_unit_test(test_layers_are_drawn_into),
    cmocka_unit_test(test_misuse_of_definitions),        cmocka_unit_test(test_misuse_of_layers),
};

const struct unit_tests test_texture_layers = UNIT_TESTS(tests, NULL, NULL);
