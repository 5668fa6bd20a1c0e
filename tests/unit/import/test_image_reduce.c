// SPDX-License-Identifier: MIT
// Images made smaller while they are read: means worked out by hand, and the same bytes row by row as at once.
#include <spng.h>
#include <stdlib.h>
#include <string.h>

#include "harness.h"
#include "import/image/read.h"
#include "import/image/reduce.h"

static struct scene_image image_of(enum scene_image_type type, uint32_t width, uint32_t height,
                                   const void *texels, size_t texel)
{
    struct scene_image image = {
        .type = type, .width = width, .height = height, .size = (size_t)width * height * texel};
    image.texels = malloc(image.size);
    assert_non_null(image.texels);
    memcpy(image.texels, texels, image.size);
    return image;
}

static void sizes_are_halved_until_they_fit(void **state)
{
    (void)state;
    assert_false(scene_reduce_needed(4096, 16, 4096));
    assert_true(scene_reduce_needed(16, 4097, 4096));
    assert_false(scene_reduce_needed(16384, 16384, 0));
    struct scene_image image;
    struct scene_reducer reducer;
    assert_true(scene_reducer_open(&reducer, 1000, 3, 250, false, &image));
    scene_reducer_close(&reducer);
    assert_int_equal(image.width, 250);
    assert_int_equal(image.height, 1); // 3, 1, 1
    assert_int_equal(image.size, 1000);
    free(image.texels);
}

// Half of the light is code 188 (0.5 is 187.5 of 255 encoded), the middle of the codes 127.5 is 128; alpha is no light.
static void color_is_averaged_as_light(void **state)
{
    (void)state;
    const uint8_t texels[4][4] = {{0, 255, 10, 0}, {255, 255, 10, 255}, {255, 255, 10, 0}, {0, 255, 10, 255}};
    struct scene_image color = image_of(SCENE_IMAGE_RGBA8, 2, 2, texels, 4),
                       data = image_of(SCENE_IMAGE_RGBA8, 2, 2, texels, 4);
    assert_true(scene_reduce_image(&color, 1, true));
    assert_true(scene_reduce_image(&data, 1, false));
    const uint8_t light[4] = {188, 255, 10, 128}, plain[4] = {128, 255, 10, 128};
    assert_int_equal(color.size, 4);
    assert_memory_equal(color.texels, light, 4);
    assert_memory_equal(data.texels, plain, 4);
    free(color.texels);
    free(data.texels);
}

// Every code stays itself where all texels are alike.
static void codes_come_back(void **state)
{
    (void)state;
    for (int code = 0; code < 256; code++) {
        uint8_t texels[4 * 4];
        memset(texels, code, sizeof texels);
        struct scene_image image = image_of(SCENE_IMAGE_RGBA8, 2, 2, texels, 4);
        assert_true(scene_reduce_image(&image, 1, true));
        assert_memory_equal(image.texels, texels, 4);
        free(image.texels);
    }
}

// 5 columns in 2: texels 0..2 and 3..4 (x·2/5); 3 rows in 1.
static void odd_sizes_lose_no_texel(void **state)
{
    (void)state;
    uint16_t deep[3][5][4];
    float light[3][5][4];
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x < 5; x++) {
            for (int c = 0; c < 4; c++) {
                deep[y][x][c] = (uint16_t)((10 * x + y) * 257); // 16 bits of an 8-bit code
                light[y][x][c] = (float)(10 * x + y) * 100.0f;
            }
        }
    }
    struct scene_image bits = image_of(SCENE_IMAGE_RGBA16, 5, 3, deep, 8),
                       floats = image_of(SCENE_IMAGE_RGBA32F, 5, 3, light, 16);
    assert_true(scene_reduce_image(&bits, 2, false));
    assert_true(scene_reduce_image(&floats, 2, true));
    const uint8_t expected[2] = {11, 36}; // 10 + 1 and 35 + 1
    assert_int_equal(bits.type, SCENE_IMAGE_RGBA8);
    assert_int_equal(floats.type, SCENE_IMAGE_RGBA32F);
    for (int x = 0; x < 2; x++) {
        for (int c = 0; c < 4; c++) {
            assert_int_equal(((uint8_t *)bits.texels)[4 * x + c], expected[x]);
            assert_float_equal(((float *)floats.texels)[4 * x + c], 100.0f * (float)expected[x], 0.0f);
        }
    }
    assert_int_equal(bits.size, 8);
    assert_int_equal(floats.size, 32);
    free(bits.texels);
    free(floats.texels);
}

static void *encode_png(uint32_t width, uint32_t height, enum spng_color_type kind, int channels,
                        size_t *size)
{
    struct spng_ihdr header = {.width = width, .height = height, .bit_depth = 8, .color_type = (uint8_t)kind};
    const size_t bytes = (size_t)width * height * (size_t)channels;
    uint8_t *const texels = malloc(bytes);
    uint32_t random = 12345;
    for (size_t i = 0; i < bytes; i++) {
        random = random * 1664525u + 1013904223u;
        texels[i] = (uint8_t)(random >> 24);
    }
    spng_ctx *const png = spng_ctx_new(SPNG_CTX_ENCODER);
    int result = spng_set_option(png, SPNG_ENCODE_TO_BUFFER, 1);
    assert_int_equal(result, 0);
    assert_int_equal(spng_set_ihdr(png, &header), 0);
    assert_int_equal(spng_encode_image(png, texels, bytes, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
    void *const file = spng_get_png_buffer(png, size, &result);
    assert_non_null(file);
    spng_ctx_free(png);
    free(texels);
    return file;
}

static void rows_of_png_give_the_same_bytes(void **state)
{
    (void)state;
    static const struct {
        enum spng_color_type kind;
        int channels;
    } kinds[] = {{SPNG_COLOR_TYPE_GRAYSCALE, 1},
                 {SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, 2},
                 {SPNG_COLOR_TYPE_TRUECOLOR, 3},
                 {SPNG_COLOR_TYPE_TRUECOLOR_ALPHA, 4}};
    for (size_t k = 0; k < 4; k++) {
        size_t size;
        void *const file = encode_png(83, 61, kinds[k].kind, kinds[k].channels, &size);
        assert_int_equal(scene_image_texels(file, size), 83 * 61);
        for (int is_color = 0; is_color < 2; is_color++) {
            struct scene_image rows, whole;
            assert_null(scene_image_decode_within(file, size, 40, is_color, &rows));
            assert_null(scene_image_decode(file, size, &whole));
            assert_true(scene_reduce_image(&whole, 40, is_color));
            assert_int_equal(rows.width, 20);
            assert_int_equal(rows.height, 15);
            assert_int_equal(rows.size, whole.size);
            assert_memory_equal(rows.texels, whole.texels, rows.size);
            assert_int_equal(rows.has_alpha, kinds[k].channels % 2 == 0);
            free(rows.texels);
            free(whole.texels);
        }
        // What is cut before its last rows is refused.
        for (size_t length = 0; length < size / 10 * 9; length += 7) {
            struct scene_image none = {0};
            assert_non_null(scene_image_decode_within(file, length, 40, true, &none));
            assert_null(none.texels);
        }
        free(file);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(sizes_are_halved_until_they_fit),
    cmocka_unit_test(color_is_averaged_as_light),
    cmocka_unit_test(codes_come_back),
    cmocka_unit_test(odd_sizes_lose_no_texel),
    cmocka_unit_test(rows_of_png_give_the_same_bytes),
};

const struct unit_tests test_image_reduce = UNIT_TESTS(tests, NULL, NULL);
