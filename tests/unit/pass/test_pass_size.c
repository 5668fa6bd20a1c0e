// SPDX-License-Identifier: MIT
// Passes smaller than their attachments: what lies beyond them stays to the last byte, whatever is loaded, drawn,
// resolved and stored, and tiles that are known to be clear are not taken for those of another size.
#include "harness.h"

#include <string.h>

enum { WIDTH = 150, HEIGHT = 90, PASS_WIDTH = 77, PASS_HEIGHT = 69, PATTERN = 0x3c };

static rhw_texture make(const struct rig *rig, enum rhw_format format, int samples)
{
    static unsigned char bytes[WIDTH * HEIGHT * 16];
    const struct rhw_texture_def def = {
        .format = format, .width = WIDTH, .height = HEIGHT, .samples = samples};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    memset(bytes, PATTERN, sizeof bytes);
    if (samples <= 1) {
        assert_int_equal(rhw_texture_write(rig->context, texture, 0, bytes, 0), RHW_OK);
    }
    return texture;
}

// Whether all bytes beyond the pass are those of before, and inside each texel is `left` where the rectangle was drawn,
// `right` elsewhere.
static void check_texels(const struct rig *rig, rhw_texture texture, size_t size, const void *left,
                         const void *right)
{
    static unsigned char texels[WIDTH * HEIGHT * 16];
    unsigned char pattern[16];
    assert_int_equal(rhw_texture_read(rig->context, texture, 0, texels, 0), RHW_OK);
    memset(pattern, PATTERN, sizeof pattern);
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const bool inside = x < PASS_WIDTH && y < PASS_HEIGHT;
            const void *const expected = !inside ? pattern : x < 40 ? left : right;
            assert_memory_equal(texels + (size_t)(y * WIDTH + x) * size, expected, size);
        }
    }
}

// Both halves of the pass are tiles that are drawn, or one of them is only cleared. As often as several waves need.
static void draw(int samples, enum rhw_format depth_format, size_t bin_memory)
{
    const struct rhw_context_def def = {.threads = 2, .bin_memory = bin_memory};
    static const float one[4] = {1, 0, 0, 1};
    struct rig rig;
    struct rig_vertex vertices[6];
    rig_open_with(&rig, PASS_WIDTH, PASS_HEIGHT, &def);
    rig_set_target(&rig, 1, RHW_FORMAT_RGBA8_UNORM);
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA8_UNORM);
    rig.pipeline.targets[0].format = rig.pipeline.targets[1].format = RHW_FORMAT_RGBA8_UNORM;
    rig.pipeline.targets[1].write_mask = RHW_WRITE_NONE;
    rig.pass.colors[0] = (struct rhw_color_attachment){.texture = make(&rig, RHW_FORMAT_RGBA8_UNORM, 1),
                                                       .clear = {0, 0, 1, 1}};
    rig.pass.colors[1] = (struct rhw_color_attachment){.texture = make(&rig, RHW_FORMAT_RGBA8_UNORM, 1),
                                                       .load = RHW_LOAD_LOAD};
    rig.pass.depth = (struct rhw_depth_attachment){
        .enabled = true, .texture = make(&rig, depth_format, 1), .load = RHW_LOAD_CLEAR, .clear = 1};
    rig.pass.samples = samples;
    rig.pass.width = PASS_WIDTH;
    rig.pass.height = PASS_HEIGHT;
    rig.pipeline.depth_test = true;
    rig_rectangle(&rig, -20, -20, 40, HEIGHT, 0, one, vertices);
    rig_begin(&rig);
    for (int i = 0; i < 8; i++) {
        rig_draw(&rig, vertices, 6);
    }
    rig_end(&rig);
    assert_true((rig.stats.flushes > 0) == (bin_memory != 0));
    const unsigned char red[4] = {255, 0, 0, 255}, blue[4] = {0, 0, 255, 255};
    check_texels(&rig, rig.pass.colors[0].texture, 4, red, blue);
    unsigned char pattern[16];
    memset(pattern, PATTERN, sizeof pattern);
    check_texels(&rig, rig.pass.colors[1].texture, 4, pattern, pattern);
    const float near = 0, far = 1;
    const uint16_t near_step = 0, far_step = 0xffff;
    const bool is_float = depth_format == RHW_FORMAT_D32_FLOAT;
    check_texels(&rig, rig.pass.depth.texture, is_float ? 4 : 2, is_float ? (const void *)&near : &near_step,
                 is_float ? (const void *)&far : &far_step);
    rig_close(&rig);
}

static void test_beyond_the_pass(void **state)
{
    (void)state;
    for (size_t i = 0; i < 8; i++) {
        draw(i & 1 ? 4 : 1, i & 2 ? RHW_FORMAT_D16_UNORM : RHW_FORMAT_D32_FLOAT, i / 4);
    }
}

// Samples that are kept, and resolved besides, of texels of all sizes.
static void test_samples(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {RHW_FORMAT_R8_UNORM, RHW_FORMAT_RG8_UNORM,
                                              RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_RGBA16_FLOAT,
                                              RHW_FORMAT_RGBA32_FLOAT};
    for (size_t f = 0; f < sizeof formats / sizeof formats[0]; f++) {
        struct rig rig;
        struct rig_vertex vertices[6];
        static const float one[4] = {1, 1, 1, 1};
        rig_open(&rig, PASS_WIDTH, PASS_HEIGHT);
        rig.pipeline.targets[0].format = formats[f];
        rig.pass.colors[0] = (struct rhw_color_attachment){.texture = make(&rig, formats[f], 4),
                                                           .resolve = make(&rig, formats[f], 1)};
        rig.pass.width = PASS_WIDTH;
        rig.pass.height = PASS_HEIGHT;
        rig_rectangle(&rig, -20, -20, 40, HEIGHT, 0, one, vertices);
        rig_draw_once(&rig, vertices, 6);
        unsigned char left[16] = {0}, right[16] = {0};
        const size_t size = rhw_format_size(formats[f]);
        switch (formats[f]) {
        case RHW_FORMAT_RGBA16_FLOAT:
            memcpy(left, (uint16_t[4]){0x3c00, 0x3c00, 0x3c00, 0x3c00}, size);
            break;
        case RHW_FORMAT_RGBA32_FLOAT: memcpy(left, one, size); break;
        default: memset(left, 255, size);
        }
        check_texels(&rig, rig.pass.colors[0].resolve, size, left, right);
        static unsigned char sample[WIDTH * HEIGHT * 16];
        for (int s = 0; s < 4; s++) {
            rhw_texture_read_sample(rig.context, rig.pass.colors[0].texture, s, sample, 0);
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                const bool is_drawn = i % WIDTH < 40 && i / WIDTH < PASS_HEIGHT;
                assert_memory_equal(sample + (size_t)i * size, is_drawn ? left : right, size);
            }
        }
        rig_close(&rig);
    }
}

// Tiles are counted anew in each size, and passes clear to what is there already, or not.
static void test_clean_tiles(void **state)
{
    (void)state;
    enum { SIDE = 200 };
    static const int sizes[][2] = {{SIDE, SIDE}, {70, 130}, {SIDE, SIDE}, {130, 70},   {130, 70},
                                   {SIDE, SIDE}, {SIDE, 1}, {1, SIDE},    {SIDE, SIDE}};
    struct rig rig;
    struct rig_vertex vertices[6];
    static const float one[4] = {1, 1, 1, 1};
    static float expected[SIDE * SIDE];
    uint64_t random = 7;
    rig_open(&rig, SIDE, SIDE);
    const struct rhw_texture_def def = {.format = RHW_FORMAT_R32_FLOAT, .width = SIDE, .height = SIDE};
    assert_int_equal(rhw_texture_create(rig.context, &def, &rig.pass.colors[0].texture), RHW_OK);
    rig.pipeline.targets[0].format = RHW_FORMAT_R32_FLOAT;
    for (int pass = 0; pass < 60; pass++) {
        const int *const size = sizes[rig_random_int(&random, 9)];
        const float clear = (float)rig_random_int(&random, 2) / 2;
        const int x0 = rig_random_int(&random, SIDE - 20), y0 = rig_random_int(&random, SIDE - 20);
        const bool draws = rig_random_int(&random, 2);
        rig.pass.width = rig.width = size[0];
        rig.pass.height = rig.height = size[1];
        rig.pass.colors[0].clear[0] = clear;
        rig_rectangle(&rig, (float)x0, (float)y0, (float)x0 + 20, (float)y0 + 20, 0, one, vertices);
        rig_begin(&rig);
        if (draws) {
            rig_draw(&rig, vertices, 6);
        }
        rig_end(&rig);
        for (int i = 0; i < SIDE * SIDE; i++) {
            const int x = i % SIDE, y = i / SIDE;
            const bool is_drawn = draws && x >= x0 && x < x0 + 20 && y >= y0 && y < y0 + 20;
            expected[i] = x >= size[0] || y >= size[1] ? expected[i] : is_drawn ? 1 : clear;
        }
        rig.width = rig.height = SIDE;
        assert_memory_equal(rig_read(&rig, rig.pass.colors[0].texture), expected, sizeof expected);
    }
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig_set_target(&rig, 1, RHW_FORMAT_RGBA8_UNORM);
    rig.pass.colors[1].texture = make(&rig, RHW_FORMAT_RGBA8_UNORM, 1);
    rig_expect_refused_pass(
        &rig, "colors[1] is texture 3, whose level 0 is 150x90; the pass is 8x8 as its first attachment; "
              "set width and height for a part of larger ones");
    rig.pass.width = 8;
    rig.pass.height = 9;
    rig_expect_refused_pass(&rig, "whose level 0 is 8x8; the pass is 8x9, and each is at least as large");
    rig.pass.height = 0;
    rig_expect_refused_pass(&rig, "width is 8 and height is 0; both are set, or both are 0");
    rig.pass.width = 0;
    rig.pass.height = 8;
    rig_expect_refused_pass(&rig, "width is 0 and height is 8; both are set, or both are 0");
    rig.pass.width = 8;
    rig_begin(&rig);
    rig_end(&rig);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_beyond_the_pass),
                                          cmocka_unit_test(test_samples), cmocka_unit_test(test_clean_tiles),
                                          cmocka_unit_test(test_misuse)};

const struct unit_tests test_pass_size = UNIT_TESTS(tests, NULL, NULL);
