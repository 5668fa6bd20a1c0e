// SPDX-License-Identifier: MIT
// Scaled copies: which texel a nearest filter takes and what a linear one mixes, by integers and by doubles; mirroring,
// layers, slices and formats.
#include "harness.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static rhw_texture make(const struct rig *rig, const struct rhw_texture_def *def)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, def, &texture), RHW_OK);
    return texture;
}

static rhw_texture make_row(const struct rig *rig, enum rhw_format format, int width, const void *texels)
{
    const struct rhw_texture_def def = {.format = format, .width = width, .height = 1};
    const rhw_texture texture = make(rig, &def);
    if (texels) {
        assert_int_equal(rhw_texture_write(rig->context, texture, 0, texels, 0), RHW_OK);
    }
    return texture;
}

// Rows of floats scaled and read back.
static void expect_row(struct rig *rig, const float *from, int from_width, const float *expected, int width,
                       const struct rhw_blit_region *source, const struct rhw_blit_region *target,
                       enum rhw_filter filter)
{
    const rhw_texture a = make_row(rig, RHW_FORMAT_R32_FLOAT, from_width, from),
                      b = make_row(rig, RHW_FORMAT_R32_FLOAT, width, NULL);
    float texels[64];
    assert_int_equal(rhw_texture_blit(rig->context, a, source, b, target, filter), RHW_OK);
    assert_int_equal(rhw_texture_read(rig->context, b, 0, texels, 0), RHW_OK);
    assert_memory_equal(texels, expected, (size_t)width * sizeof *texels);
    rhw_texture_destroy(rig->context, a);
    rhw_texture_destroy(rig->context, b);
}

static void test_rows(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    static const float two[] = {0, 8}, three[] = {1, 2, 3}, seven[] = {1, 2, 3, 4, 5, 6, 7};
    // Centres at -3/8, -1/8, 1/8, 3/8 .. of the way from the first to the second.
    static const float linear[] = {0, 0, 1, 3, 5, 7, 8, 8};
    expect_row(&rig, two, 2, linear, 8, NULL, NULL, RHW_FILTER_LINEAR);
    static const float mirrored[] = {8, 8, 7, 5, 3, 1, 0, 0};
    expect_row(&rig, two, 2, mirrored, 8, &(struct rhw_blit_region){.x0 = 2}, NULL, RHW_FILTER_LINEAR);
    expect_row(&rig, two, 2, mirrored, 8, NULL, &(struct rhw_blit_region){.x0 = 8}, RHW_FILTER_LINEAR);
    expect_row(&rig, two, 2, linear, 8, &(struct rhw_blit_region){.x0 = 2},
               &(struct rhw_blit_region){.x0 = 8}, RHW_FILTER_LINEAR);
    // (2i + 1) · 3 / 14, rounded down: 3, 9, 15, 21, 27, 33, 39.
    static const float larger[] = {1, 1, 2, 2, 2, 3, 3};
    expect_row(&rig, three, 3, larger, 7, NULL, NULL, RHW_FILTER_NEAREST);
    static const float larger_mirrored[] = {3, 3, 2, 2, 2, 1, 1};
    expect_row(&rig, three, 3, larger_mirrored, 7, &(struct rhw_blit_region){.x0 = 3}, NULL,
               RHW_FILTER_NEAREST);
    // (2i + 1) · 7 / 6: 7, 21, 35.
    static const float smaller[] = {2, 4, 6};
    expect_row(&rig, seven, 7, smaller, 3, NULL, NULL, RHW_FILTER_NEAREST);
    // A linear filter takes the two neighbours of that place less a half: 2/3, 3, 16/3.
    static const float smaller_linear[] = {1 + 2.0f / 3, 4, 6 + 1.0f / 3};
    expect_row(&rig, seven, 7, smaller_linear, 3, NULL, NULL, RHW_FILTER_LINEAR);
    // From texels 2 and 3 into 1 .. 4, the rest stays 0; the neighbours 2 and 5 are not mixed in.
    static const float part[] = {0, 3, 3.25f, 3.75f, 4, 0};
    expect_row(&rig, seven, 7, part, 6, &(struct rhw_blit_region){.x0 = 2, .x1 = 4},
               &(struct rhw_blit_region){.x0 = 1, .x1 = 5}, RHW_FILTER_LINEAR);
    rig_close(&rig);
}

// The place of a texel of the target in the source, along an axis.
static double place(int i, int from0, int from1, int to0, int to1)
{
    return (i + 0.5 - to0) * (double)(from1 - from0) / (to1 - to0) + from0;
}

enum { MOST = 12 };

struct box {
    int first[3], last[3];
};

static void random_box(uint64_t *random, const int size[3], struct box *box)
{
    for (int i = 0; i < 3; i++) {
        do {
            box->first[i] = rig_random_int(random, size[i] + 1);
            box->last[i] = rig_random_int(random, size[i] + 1);
        } while (box->first[i] == box->last[i]);
    }
}

// What the texel of the target is made of.
static void model(float (*texels)[4], const int size[3], const struct box *from, const struct box *to,
                  const int at[3], bool is_linear, double value[4])
{
    double weight[3];
    int low[3];
    for (int i = 0; i < 3; i++) {
        const double u = place(at[i], from->first[i], from->last[i], to->first[i], to->last[i]);
        low[i] = (int)floor(is_linear ? u - 0.5 : u);
        weight[i] = is_linear ? u - 0.5 - low[i] : 0;
    }
    memset(value, 0, 4 * sizeof *value);
    for (int n = 0; n < 8; n++) {
        double part = 1;
        int tap[3];
        for (int i = 0; i < 3; i++) {
            const int begin = from->first[i] < from->last[i] ? from->first[i] : from->last[i];
            const int end = from->first[i] < from->last[i] ? from->last[i] : from->first[i];
            part *= n >> i & 1 ? weight[i] : 1 - weight[i];
            tap[i] = low[i] + (n >> i & 1);
            tap[i] = tap[i] < begin ? begin : tap[i] > end - 1 ? end - 1 : tap[i];
        }
        for (int c = 0; c < 4; c++) {
            value[c] += part * (double)texels[(tap[2] * size[1] + tap[1]) * size[0] + tap[0]][c];
        }
    }
}

static bool is_inside(const struct box *box, const int at[3])
{
    for (int i = 0; i < 3; i++) {
        const int begin = box->first[i] < box->last[i] ? box->first[i] : box->last[i];
        const int end = box->first[i] < box->last[i] ? box->last[i] : box->first[i];
        if (at[i] < begin || at[i] >= end) {
            return false;
        }
    }
    return true;
}

static struct rhw_blit_region region_of(const struct box *box)
{
    return (struct rhw_blit_region){.x0 = box->first[0],
                                    .y0 = box->first[1],
                                    .z0 = box->first[2],
                                    .x1 = box->last[0],
                                    .y1 = box->last[1],
                                    .z1 = box->last[2]};
}

// Volumes of floats, in both filters.
static void test_volumes(void **state)
{
    (void)state;
    static float texels[MOST * MOST * MOST][4], drawn[MOST * MOST * MOST][4];
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 3;
    for (int round = 0; round < 120; round++) {
        int from_size[3], to_size[3];
        for (int i = 0; i < 3; i++) {
            from_size[i] = 1 + rig_random_int(&random, MOST);
            to_size[i] = 1 + rig_random_int(&random, MOST);
        }
        for (int i = 0; i < MOST * MOST * MOST; i++) {
            for (int c = 0; c < 4; c++) {
                texels[i][c] = rig_random_float(&random, -4, 4);
            }
        }
        struct rhw_texture_def def = {.format = RHW_FORMAT_RGBA32_FLOAT,
                                      .kind = RHW_TEXTURE_3D,
                                      .width = from_size[0],
                                      .height = from_size[1],
                                      .depth = from_size[2]};
        const rhw_texture source = make(&rig, &def);
        def.width = to_size[0];
        def.height = to_size[1];
        def.depth = to_size[2];
        const rhw_texture target = make(&rig, &def);
        rhw_texture_write_region(rig.context, source, NULL, texels, 0, 0);
        struct box from, to;
        random_box(&random, from_size, &from);
        random_box(&random, to_size, &to);
        const struct rhw_blit_region a = region_of(&from), b = region_of(&to);
        const bool is_linear = round % 2 == 0;
        assert_int_equal(rhw_texture_blit(rig.context, source, &a, target, &b,
                                          is_linear ? RHW_FILTER_LINEAR : RHW_FILTER_NEAREST),
                         RHW_OK);
        rhw_texture_read_region(rig.context, target, NULL, drawn, 0, 0);
        for (int i = 0; i < to_size[0] * to_size[1] * to_size[2]; i++) {
            const int at[3] = {i % to_size[0], i / to_size[0] % to_size[1], i / to_size[0] / to_size[1]};
            double value[4] = {0};
            if (is_inside(&to, at)) {
                model(texels, from_size, &from, &to, at, is_linear, value);
            }
            for (int c = 0; c < 4; c++) {
                assert_true(fabs((double)drawn[i][c] - value[c]) <= (is_linear ? 3e-6 : 0));
            }
        }
        rhw_texture_destroy(rig.context, source);
        rhw_texture_destroy(rig.context, target);
    }
    rig_close(&rig);
}

// A byte of sRGB, and what else it is: 188 is 0.5029 in linear light, 128 of 255.
static void test_formats(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    static const uint8_t code[4] = {188, 0, 255, 51};
    const rhw_texture srgb = make_row(&rig, RHW_FORMAT_RGBA8_SRGB, 1, code);
    const rhw_texture unorm = make_row(&rig, RHW_FORMAT_RGBA8_UNORM, 1, NULL),
                      floats = make_row(&rig, RHW_FORMAT_RGBA32_FLOAT, 1, NULL),
                      red = make_row(&rig, RHW_FORMAT_R32_FLOAT, 1, NULL),
                      back = make_row(&rig, RHW_FORMAT_RGBA8_SRGB, 1, NULL);
    uint8_t bytes[4];
    float value[4];
    assert_int_equal(rhw_texture_blit(rig.context, srgb, NULL, unorm, NULL, RHW_FILTER_LINEAR), RHW_OK);
    rhw_texture_read(rig.context, unorm, 0, bytes, 0);
    assert_memory_equal(bytes, ((const uint8_t[]){128, 0, 255, 51}), 4);
    assert_int_equal(rhw_texture_blit(rig.context, srgb, NULL, floats, NULL, RHW_FILTER_LINEAR), RHW_OK);
    rhw_texture_read(rig.context, floats, 0, value, 0);
    assert_true(fabs((double)value[0] - pow((188 / 255.0 + 0.055) / 1.055, 2.4)) < 1e-7);
    assert_true(value[1] == 0 && value[2] == 1 && value[3] == 0.2f);
    assert_int_equal(rhw_texture_blit(rig.context, floats, NULL, back, NULL, RHW_FILTER_NEAREST), RHW_OK);
    rhw_texture_read(rig.context, back, 0, bytes, 0);
    assert_memory_equal(bytes, code, 4);
    // One channel becomes four: absent ones read 0, 0, 1.
    static const float third = 1.0f / 3;
    rhw_texture_write(rig.context, red, 0, &third, 0);
    assert_int_equal(rhw_texture_blit(rig.context, red, NULL, unorm, NULL, RHW_FILTER_LINEAR), RHW_OK);
    rhw_texture_read(rig.context, unorm, 0, bytes, 0);
    assert_memory_equal(bytes, ((const uint8_t[]){85, 0, 0, 255}), 4);
    rig_close(&rig);
}

// Where a format cannot hold an integer, the nearest one that it holds is written.
static void test_integers_stay_in_range(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    static const uint32_t positive[4] = {255, 256, 7, 0xffffffff};
    static const int32_t both[4] = {-128, -129, 128, INT32_MIN};
    uint8_t bytes[4];
    int16_t words[2];
    const rhw_texture from = make_row(&rig, RHW_FORMAT_RGBA32_UINT, 1, positive),
                      to = make_row(&rig, RHW_FORMAT_RGBA8_UINT, 1, NULL),
                      whole = make_row(&rig, RHW_FORMAT_RGBA32_SINT, 1, both),
                      small = make_row(&rig, RHW_FORMAT_RGBA8_SINT, 1, NULL),
                      pair = make_row(&rig, RHW_FORMAT_RG16_SINT, 1, NULL);
    assert_int_equal(rhw_texture_blit(rig.context, from, NULL, to, NULL, RHW_FILTER_NEAREST), RHW_OK);
    rhw_texture_read(rig.context, to, 0, bytes, 0);
    assert_memory_equal(bytes, ((const uint8_t[]){255, 255, 7, 255}), 4);
    assert_int_equal(rhw_texture_blit(rig.context, whole, NULL, small, NULL, RHW_FILTER_NEAREST), RHW_OK);
    rhw_texture_read(rig.context, small, 0, bytes, 0);
    assert_memory_equal(bytes, ((const int8_t[]){-128, -128, 127, -128}), 4);
    assert_int_equal(rhw_texture_blit(rig.context, whole, NULL, pair, NULL, RHW_FILTER_NEAREST), RHW_OK);
    rhw_texture_read(rig.context, pair, 0, words, 0);
    assert_memory_equal(words, ((const int16_t[]){-128, -129}), 4);
    rig_close(&rig);
}

static void test_layers_and_planes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const struct rhw_texture_def array = {.format = RHW_FORMAT_D24_UNORM_S8_UINT,
                                          .width = 2,
                                          .height = 2,
                                          .layers = 3},
                                 target = {.format = array.format, .width = 4, .height = 2, .layers = 2};
    const rhw_texture a = make(&rig, &array), b = make(&rig, &target);
    uint32_t depth[12], read[16];
    uint8_t stencil[12], read_stencil[16];
    for (int i = 0; i < 12; i++) {
        depth[i] = (uint32_t)(0xabc000 + i);
        stencil[i] = (uint8_t)(i + 7);
    }
    const struct rhw_texture_region plane = {.aspect = RHW_ASPECT_STENCIL};
    rhw_texture_write_region(rig.context, a, NULL, depth, 0, 0);
    rhw_texture_write_region(rig.context, a, &plane, stencil, 0, 0);
    struct rhw_blit_region from = {.z0 = 1, .z1 = 3}, to = {.x0 = 4};
    assert_int_equal(rhw_texture_blit(rig.context, a, &from, b, &to, RHW_FILTER_NEAREST), RHW_OK);
    from.aspect = to.aspect = RHW_ASPECT_STENCIL;
    assert_int_equal(rhw_texture_blit(rig.context, a, &from, b, &to, RHW_FILTER_NEAREST), RHW_OK);
    rhw_texture_read_region(rig.context, b, NULL, read, 0, 0);
    rhw_texture_read_region(rig.context, b, &plane, read_stencil, 0, 0);
    for (int i = 0; i < 16; i++) {
        const int x = (3 - i % 4) / 2, y = i / 4 % 2, layer = i / 8;
        const int source = x + 2 * y + 4 * (layer + 1);
        assert_int_equal(read[i], 0xabc000 + source);
        assert_int_equal(read_stencil[i], source + 7);
    }
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture depth = make_row(&rig, RHW_FORMAT_D32_FLOAT, 4, NULL),
                      d16 = make_row(&rig, RHW_FORMAT_D16_UNORM, 4, NULL),
                      color = make_row(&rig, RHW_FORMAT_RGBA8_UNORM, 4, NULL),
                      ids = make_row(&rig, RHW_FORMAT_R32_UINT, 4, NULL),
                      blocks = make_row(&rig, RHW_FORMAT_BC1_RGB_UNORM, 4, NULL);
    const struct rhw_texture_def array = {.format = RHW_FORMAT_RGBA8_UNORM,
                                          .width = 4,
                                          .height = 1,
                                          .layers = 3},
                                 samples = {
                                     .format = RHW_FORMAT_RGBA8_UNORM, .width = 4, .height = 1, .samples = 2};
    const rhw_texture layers = make(&rig, &array), many = make(&rig, &samples);
    static const struct rhw_blit_region outside = {.x0 = 1, .x1 = 5}, empty = {.x0 = 1, .x1 = 1},
                                        left = {.x1 = 2}, right = {.x0 = 1, .x1 = 3}, two = {.z1 = 2};
    rhw_texture_blit(rig.context, color, &outside, color, NULL, RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "from.x0 is 1 and from.x1 is 5; they differ and are in 0..4");
    rhw_texture_blit(rig.context, color, NULL, color, &empty, RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "to.x0 is 1 and to.x1 is 1; they differ and are in 0..4");
    rhw_texture_blit(rig.context, color, &left, color, &right, RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "rhw_texture_blit: the regions overlap");
    rhw_texture_blit(rig.context, depth, NULL, d16, NULL, RHW_FILTER_NEAREST);
    rig_expect_misuse(
        &rig, "is RHW_FORMAT_D32_FLOAT and texture 3 is RHW_FORMAT_D16_UNORM; neither becomes the other");
    rhw_texture_blit(rig.context, ids, NULL, color, NULL, RHW_FILTER_NEAREST);
    rig_expect_misuse(&rig, "neither becomes the other");
    rhw_texture_blit(rig.context, depth, &left, depth, &(struct rhw_blit_region){.x0 = 2, .x1 = 4},
                     RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "is RHW_FORMAT_D32_FLOAT; that takes RHW_FILTER_NEAREST");
    rhw_texture_blit(rig.context, color, NULL, blocks, NULL, RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "is RHW_FORMAT_BC1_RGB_UNORM; blocks are written by rhw_texture_write");
    rhw_texture_blit(rig.context, many, NULL, color, NULL, RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "has 2 samples; it must have one");
    rhw_texture_blit(rig.context, layers, &two, color, NULL, RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "layers 0 to 2 become 0 to 1; they are as many, and not mirrored");
    rhw_texture_blit(rig.context, layers, &(struct rhw_blit_region){.z0 = 3}, layers, NULL,
                     RHW_FILTER_LINEAR);
    rig_expect_misuse(&rig, "layers 3 to 0 become 0 to 3; they are as many, and not mirrored");
    rhw_texture_blit(rig.context, color, NULL, color, NULL, (enum rhw_filter)7);
    rig_expect_misuse(&rig, "filter is 7; not a filter");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_rows),
    cmocka_unit_test(test_volumes),
    cmocka_unit_test(test_formats),
    cmocka_unit_test(test_integers_stay_in_range),
    cmocka_unit_test(test_layers_and_planes),
    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_region_blit = UNIT_TESTS(tests, NULL, NULL);
