// SPDX-License-Identifier: MIT
// Regions cleared, and samples resolved, outside of passes.
#include "harness.h"

#include <string.h>

static rhw_texture make(const struct rig *rig, const struct rhw_texture_def *def)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, def, &texture), RHW_OK);
    return texture;
}

static void test_clear_region(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_RGBA8_SRGB, .width = 7, .height = 5, .layers = 3, .mip_levels = 2};
    const rhw_texture texture = make(&rig, &def);
    const struct rhw_texture_region region = {.x = 2, .y = 1, .z = 1, .width = 4, .height = 3, .depth = 1};
    // 0.5029 is code 188; 0.2 is code 51 of alpha.
    const struct rhw_clear_value value = {.color = {0.5029f, 0, 1, 0.2f}};
    assert_int_equal(rhw_texture_clear(rig.context, texture, &region, &value), RHW_OK);
    uint32_t texels[7 * 5 * 3];
    rhw_texture_read_region(rig.context, texture, NULL, texels, 0, 0);
    for (int i = 0; i < 7 * 5 * 3; i++) {
        const int x = i % 7, y = i / 7 % 5, z = i / 35;
        const bool inside = x >= 2 && x < 6 && y >= 1 && y < 4 && z == 1;
        assert_int_equal(texels[i], inside ? 0x33ff00bc : 0);
    }
    // All of it: levels and layers.
    assert_int_equal(rhw_texture_clear(rig.context, texture, NULL, &value), RHW_OK);
    for (int level = 0; level < 2; level++) {
        const struct rhw_texture_region whole = {.level = level};
        memset(texels, 0, sizeof texels);
        rhw_texture_read_region(rig.context, texture, &whole, texels, 0, 0);
        for (int i = 0; i < (level == 0 ? 105 : 18); i++) {
            assert_int_equal(texels[i], 0x33ff00bc);
        }
    }
    rig_close(&rig);
}

static void test_clear_planes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def def = {.format = RHW_FORMAT_D24_UNORM_S8_UINT,
                                        .width = 5,
                                        .height = 4,
                                        .samples = 4},
                                 ids_def = {.format = RHW_FORMAT_R32_UINT, .width = 3, .height = 1};
    const rhw_texture texture = make(&rig, &def), ids = make(&rig, &ids_def);
    const struct rhw_clear_value value = {.depth = 0.5f, .stencil = 200}; // 8388607.5, ties to even
    const struct rhw_texture_region stencil = {.x = 1, .width = 2, .aspect = RHW_ASPECT_STENCIL};
    assert_int_equal(rhw_texture_clear(rig.context, texture, &stencil, &value), RHW_OK);
    for (int round = 0; round < 2; round++) {
        for (int sample = 0; sample < 4; sample++) {
            struct rhw_texture_region region = {.sample = sample};
            uint32_t depth[20];
            uint8_t bytes[20];
            rhw_texture_read_region(rig.context, texture, &region, depth, 0, 0);
            region.aspect = RHW_ASPECT_STENCIL;
            rhw_texture_read_region(rig.context, texture, &region, bytes, 0, 0);
            for (int i = 0; i < 20; i++) {
                const bool inside = round == 1 || (i % 5 >= 1 && i % 5 < 3);
                assert_int_equal(bytes[i], inside ? 200 : 0);
                assert_int_equal(depth[i], round == 1 ? 0x800000 : 0);
            }
        }
        assert_int_equal(rhw_texture_clear(rig.context, texture, NULL, &value), RHW_OK);
    }
    const struct rhw_clear_value number = {.color_integer = {-2}};
    assert_int_equal(rhw_texture_clear(rig.context, ids, NULL, &number), RHW_OK);
    uint32_t words[3];
    rhw_texture_read(rig.context, ids, 0, words, 0);
    assert_true(words[0] == 0xfffffffe && words[2] == 0xfffffffe);
    rhw_texture_clear(rig.context, ids, NULL, &(struct rhw_clear_value){.color = {1}});
    rig_expect_misuse(&rig, "rhw_texture_clear: color[0] is set and RHW_FORMAT_R32_UINT holds integers");
    rhw_texture_clear(rig.context, rig.pass.colors[0].texture, NULL, &number);
    rig_expect_misuse(&rig,
                      "color_integer[0] is set and RHW_FORMAT_RGBA32_FLOAT holds no integers; set color");
    rhw_texture_clear(rig.context, texture, NULL, &(struct rhw_clear_value){.depth = 1.5f});
    rig_expect_misuse(&rig, "depth is 1.5; it is in 0..1");
    rhw_texture_clear(rig.context, texture, NULL, NULL);
    rig_expect_misuse(&rig, "value is NULL");
    rhw_texture_clear(rig.context, texture, &(struct rhw_texture_region){.sample = 1}, &value);
    rig_expect_misuse(&rig, "region.sample is 1; all samples are meant, it must be 0");
    rig_close(&rig);
}

// A pass that clears to what its tiles hold leaves them alone; it must see that they no longer do.
static void test_clear_between_passes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 70, 70);
    const struct rhw_clear_value value = {.color = {1, 2, 3, 4}};
    for (int round = 0; round < 2; round++) {
        rig_begin(&rig);
        rig_end(&rig);
        assert_true(rig_read_float4(&rig)[70 * 70 - 1][2] == 0);
        assert_int_equal(rhw_texture_clear(rig.context, rig.pass.colors[0].texture, NULL, &value), RHW_OK);
        assert_true(rig_read_float4(&rig)[70 * 70 - 1][2] == 3);
    }
    rig_close(&rig);
}

enum { WIDTH = 11, HEIGHT = 3, TEXELS = WIDTH * HEIGHT };

static void test_resolve(void **state)
{
    (void)state;
    static const enum rhw_resolve modes[] = {RHW_RESOLVE_DEFAULT, RHW_RESOLVE_AVERAGE, RHW_RESOLVE_MIN,
                                             RHW_RESOLVE_MAX, RHW_RESOLVE_SAMPLE_ZERO};
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct rhw_texture_def def = {
        .format = RHW_FORMAT_R32_FLOAT, .width = WIDTH, .height = HEIGHT, .samples = 4};
    const rhw_texture many = make(&rig, &def);
    def.samples = 1;
    const rhw_texture one = make(&rig, &def);
    float texels[TEXELS];
    for (int sample = 0; sample < 4; sample++) {
        for (int i = 0; i < TEXELS; i++) {
            texels[i] = (float)(16 * i + (sample == 1 ? 8 : sample == 2 ? -4 : 4)); // 4, 8, -4, 4
        }
        const struct rhw_texture_region region = {.sample = sample};
        assert_int_equal(rhw_texture_write_region(rig.context, many, &region, texels, 0, 0), RHW_OK);
    }
    static const float offset[] = {3, 3, -4, 8, 4};
    for (int mode = 0; mode < 5; mode++) {
        const struct rhw_texture_region from = {.x = 1, .width = 10, .height = 2}, to = {.y = 1};
        rhw_texture_clear(rig.context, one, NULL, &(struct rhw_clear_value){.color = {-1}});
        assert_int_equal(rhw_texture_resolve(rig.context, many, &from, one, &to, modes[mode]), RHW_OK);
        rhw_texture_read(rig.context, one, 0, texels, 0);
        for (int i = 0; i < TEXELS; i++) {
            const int x = i % WIDTH, y = i / WIDTH;
            const float expected = (float)(16 * (x + 1 + WIDTH * (y - 1))) + offset[mode];
            assert_true(texels[i] == (y >= 1 && x < 10 ? expected : -1));
        }
    }
    rhw_texture_resolve(rig.context, one, NULL, one, NULL, RHW_RESOLVE_DEFAULT);
    rig_expect_misuse(&rig, "rhw_texture_resolve: texture 3 has one sample; copy it by rhw_texture_copy");
    rhw_texture_resolve(rig.context, many, NULL, many, NULL, RHW_RESOLVE_DEFAULT);
    rig_expect_misuse(&rig, "texture 2 has 4 samples; it must have one");
    rhw_texture_resolve(rig.context, many, &(struct rhw_texture_region){.width = 4},
                        rig.pass.colors[0].texture, NULL, RHW_RESOLVE_DEFAULT);
    rig_expect_misuse(&rig,
                      "is RHW_FORMAT_R32_FLOAT and texture 1 is RHW_FORMAT_RGBA32_FLOAT; formats are equal");
    rhw_texture_resolve(rig.context, many, NULL, one, NULL, (enum rhw_resolve)9);
    rig_expect_misuse(&rig, "mode is 9; not a resolve mode");
    rig_close(&rig);
}

static void test_resolve_stencil(void **state)
{
    (void)state;
    static const enum rhw_resolve modes[] = {RHW_RESOLVE_DEFAULT, RHW_RESOLVE_MIN, RHW_RESOLVE_MAX};
    static const int offset[] = {10, 3, 100};
    struct rig rig;
    rig_open(&rig, 4, 4);
    struct rhw_texture_def def = {
        .format = RHW_FORMAT_D32_FLOAT_S8_UINT, .width = WIDTH, .height = HEIGHT, .samples = 2};
    const rhw_texture many = make(&rig, &def);
    def.samples = 1;
    const rhw_texture one = make(&rig, &def);
    uint8_t stencil[TEXELS];
    for (int sample = 0; sample < 2; sample++) {
        for (int i = 0; i < TEXELS; i++) {
            stencil[i] = (uint8_t)(i + (sample == 0 ? 10 : i % 2 ? 3 : 100));
        }
        const struct rhw_texture_region region = {.sample = sample, .aspect = RHW_ASPECT_STENCIL};
        assert_int_equal(rhw_texture_write_region(rig.context, many, &region, stencil, 0, 0), RHW_OK);
    }
    const struct rhw_texture_region plane = {.aspect = RHW_ASPECT_STENCIL};
    for (int mode = 0; mode < 3; mode++) {
        assert_int_equal(rhw_texture_resolve(rig.context, many, &plane, one, &plane, modes[mode]), RHW_OK);
        rhw_texture_read_region(rig.context, one, &plane, stencil, 0, 0);
        for (int i = 0; i < TEXELS; i++) {
            const bool other = mode == 1 ? i % 2 == 1 : i % 2 == 0;
            assert_int_equal(stencil[i], i + (other ? offset[mode] : 10));
        }
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_clear_region),         cmocka_unit_test(test_clear_planes),
    cmocka_unit_test(test_clear_between_passes), cmocka_unit_test(test_resolve),
    cmocka_unit_test(test_resolve_stencil),
};

const struct unit_tests test_region_clear = UNIT_TESTS(tests, NULL, NULL);
