// SPDX-License-Identifier: MIT
// Images of Netpbm: samples of one byte and of two, whatever the largest is, and files that are damaged.
#include "image_file.h"

#include <stdlib.h>
#include <string.h>

#define BYTES(text) text, sizeof(text) - 1

static void check(const char *bytes, size_t size, enum scene_image_type type, const void *texels,
                  size_t texels_size)
{
    const struct image_file file = image_file_of(bytes, size);
    struct scene_image image = image_file_decode(&file);
    assert_int_equal(image.type, type);
    assert_int_equal(image.width, 2);
    assert_int_equal(image.height, 1);
    assert_int_equal(image.size, texels_size);
    assert_memory_equal(image.texels, texels, texels_size);
    free(image.texels);
    // Each length by itself, so that a sanitizer sees what is read beyond it.
    for (size_t length = 0; length < size; length++) {
        char *const cut = malloc(length + 1);
        memcpy(cut, bytes, length);
        assert_non_null(scene_image_decode(cut, length, &image));
        free(cut);
    }
}

static void test_samples(void **state)
{
    (void)state;
    static const uint8_t grey[] = {7, 7, 7, 255, 255, 255, 255, 255};
    check(BYTES("P5 2 1 255\n\7\xff"), SCENE_IMAGE_RGBA8, grey, sizeof grey);
    static const uint8_t color[] = {1, 2, 3, 255, 4, 5, 6, 255};
    check(BYTES("P6\n# of two texels\n2 # wide\n1\r\n255 \1\2\3\4\5\6"), SCENE_IMAGE_RGBA8, color,
          sizeof color);
    static const uint8_t scaled[] = {0,  17,  255, 255,
                                     51, 255, 255, 255}; // the last is more than there may be
    check(BYTES("P6 2 1 15\n\0\1\x0f\3\x0f\x10"), SCENE_IMAGE_RGBA8, scaled, sizeof scaled);
    static const uint16_t deep[] = {0x102, 0x102, 0x102, 65535, 0xfffe, 0xfffe, 0xfffe, 65535};
    check(BYTES("P5 2 1 65535\n\1\2\xff\xfe"), SCENE_IMAGE_RGBA16, deep, sizeof deep);
    static const uint16_t ten[] = {65535, 32768, 0, 65535, 66, 65535, 65535, 65535};
    check(BYTES("P6 2 1 1000\n\3\xe8\1\xf4\0\0\0\1\3\xe8\xff\xff"), SCENE_IMAGE_RGBA16, ten, sizeof ten);
}

static void test_damaged_files(void **state)
{
    (void)state;
    static const struct {
        const char *bytes;
        size_t size;
        const char *problem;
    } cases[] = {
        {BYTES("P5 2 1 65535\n\1\2\3"), "the file ends too early"},
        {BYTES("P6 2 1 255\n\1\2\3\4\5"), "the file ends too early"},
        {BYTES("P5 2 1 0\n\1\2"), "damaged PNM image"},
        {BYTES("P5 2 1 65536\n\1\2\3\4"), "damaged PNM image"},
        {BYTES("P5 2 1 255"), "damaged PNM image"},
        {BYTES("P5 2 1 255x\1\2"), "damaged PNM image"},
        {BYTES("P5 2 -1 255\n\1\2"), "damaged PNM image"},
        {BYTES("P5 # 2 1 255\n\1\2"), "damaged PNM image"},
        {BYTES("P5 99999999999 1 255\n\1\2"), "damaged PNM image"},
        {BYTES("P5 0 1 255\n\1\2"), "width and height must be 1 to 16384"},
        {BYTES("P5 2 16385 255\n\1\2"), "width and height must be 1 to 16384"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct image_file file = image_file_of(cases[i].bytes, cases[i].size);
        image_file_expect_refused(&file, cases[i].problem);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_samples),
    cmocka_unit_test(test_damaged_files),
};

const struct unit_tests test_pnm = UNIT_TESTS(tests, NULL, NULL);
