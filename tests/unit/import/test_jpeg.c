// SPDX-License-Identifier: MIT
// JPEGs that are damaged, and those that only look so. Their files are made here from the specification.
#include "image_file.h"

#include <stdlib.h>
#include <string.h>

// A Huffman table of more codes than there are symbols, at the end of a file, behind another table, and after a scan.
static void test_jpeg_tables(void **state)
{
    (void)state;
    static const char problem[] = "damaged JPEG: a Huffman table of more than 256 codes";
    for (int place = 0; place < 4; place++) {
        struct image_file file = image_file_of("\xff\xd8", 2);
        if (place == 2) {
            image_file_put_bytes(&file, "\xff\xda\0\x08\x01\x01\0\0\x3f\0\x12\xff\0\xff\xd0\x34",
                                 16); // a scan
        }
        if (place == 3) {
            image_file_put_bytes(&file, "\xff\xe0\0\x06\xff\xc4\0\0nothing",
                                 15); // a table within a comment is none
        }
        image_file_put_bytes(&file, "\xff\xff\xc4\x01", 4);
        image_file_put(&file, place == 1 ? 0x40 : 0x13, 1);
        if (place == 1) {
            uint8_t table[17 + 1] = {0, 1};
            image_file_put_bytes(&file, table, sizeof table);
        }
        image_file_put(&file, 0, 1);
        for (int i = 0; i < 16; i++) {
            image_file_put(&file, i >= 2 ? 0 : place == 3 ? 128 : 129, 1);
            if (place == 0 && i == 1) {
                break; // stb_image reads zeros from here on
            }
        }
        file.size += place == 0 ? 0 : 300; // the first one ends within its codes
        if (place == 3) {
            struct scene_image image = {.width = 0};
            const char *const other = scene_image_decode(file.bytes, file.size, &image);
            assert_non_null(other);
            assert_true(strcmp(other, problem) != 0);
        } else {
            image_file_expect_refused(&file, problem);
            assert_int_equal(scene_image_texels(file.bytes, file.size), 0);
        }
    }
}

// Put a grey JPEG of 8 x 128 pixels, a brighter one where its first block is, up to its only scan. Codes: 0 and 10 for
// differences of no bits and of six, 0 for the end of a block.
static struct image_file jpeg_of(const char *frame, size_t frame_size, bool has_quantization, bool has_codes)
{
    static const uint8_t ones[64] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
                                     1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
                                     1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
    struct image_file file = image_file_of("\xff\xd8", 2);
    if (has_quantization) {
        image_file_put_bytes(&file, "\xff\xdb\0\x43\0", 5);
        image_file_put_bytes(&file, ones, sizeof ones);
    }
    image_file_put_bytes(&file, frame, frame_size);
    // Tables in one segment, of which the second is of no component here.
    image_file_put_bytes(&file, has_codes ? "\xff\xc4\0\x39" : "\xff\xc4\0\x27", 4);
    image_file_put_bytes(&file, "\0\1\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\6", 19);
    image_file_put_bytes(&file, "\1\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 18);
    if (has_codes) {
        image_file_put_bytes(&file, "\x10\1\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 18);
    }
    return file;
}

#define BYTES(text) text, sizeof(text) - 1
#define BASELINE    "\xff\xc0\0\x0b\x08\0\x80\0\x08\1\1\x11\0"
#define SCAN        "\xff\xda\0\x08\1\1\0\0\x3f\0"
#define EVERY_FOUR  "\xff\xdd\0\4\0\4"
#define DATA        "\xbf\0\0\0\1"
#define MARK        "\xff\xd9"
#define PROGRESSIVE "\xff\xc2\0\x0b\x08\0\x80\0\x08\1\1\x11\0"
#define FIRST_SCAN  "\xff\xda\0\x08\1\1\0\0\0\0"
#define OTHERS      "\xff\xda\0\x08\1\1\0\1\x3f\0"
#define TAILED      "\0\0\0\0\0\0\0\0\xff\0"
#define LIKE_TAIL   "\xff\0\xff\xc1"
#define LIKE_FIVE   LIKE_TAIL LIKE_TAIL LIKE_TAIL LIKE_TAIL LIKE_TAIL
#define REFINEMENT  "\xff\xda\0\x08\1\1\0\0\0\x10"
#define THREE       "\xff\xc0\0\x11\x08\0\x80\0\x08\3\1\x11\0\2\x11\0\3\x11\0"

// What a JPEG needs to be whole: all of its scans and rows, and tables for them. A mark at its end it does not need.
static void test_jpeg_gaps(void **state)
{
    (void)state;
    static const struct {
        const char *frame;
        size_t frame_size;
        const char *scans;
        size_t scans_size;
        bool lacks_quantization, lacks_codes, lacks_end;
        const char *problem;
    } cases[] = {
        {BYTES(BASELINE), BYTES(SCAN DATA MARK), false, false, false, NULL},
        {BYTES(BASELINE), BYTES(SCAN DATA), false, false, true, NULL},
        {BYTES(BASELINE), BYTES(SCAN DATA "\xff"), false, false, true, NULL},
        {BYTES(BASELINE), BYTES(SCAN DATA "\0\0\0"), false, false, true, NULL},
        {BYTES(BASELINE), BYTES(SCAN "\xbf\0\0\0"), false, false, false, "the JPEG ends too early"},
        {BYTES(BASELINE), BYTES(SCAN DATA "\xff\xfe\0\x20"), false, false, false, "the JPEG ends too early"},
        {BYTES(BASELINE), BYTES(EVERY_FOUR SCAN "\xbf\1\xff\xd0\0\xff\xd1\0\xff\xd2\0" MARK), false, false,
         false, NULL},
        {BYTES(BASELINE), BYTES(EVERY_FOUR SCAN "\xbf\1\xff\xd0\0\xff\xd1\0\xff\xd2\0"), false, false, true,
         NULL},
        {BYTES(BASELINE), BYTES(EVERY_FOUR SCAN "\xbf\1\xff\xd0\0\xff\xd1\0" MARK), false, false, false,
         "damaged JPEG: rows are not there"},
        {BYTES(BASELINE), BYTES(EVERY_FOUR SCAN "\xbf\1\xff\xd0\0\xff\xd1\0"), false, false, false,
         "damaged JPEG: rows are not there"},
        {BYTES(BASELINE), BYTES(SCAN DATA MARK), true, false, false,
         "damaged JPEG: a table of quantization is not there"},
        {BYTES(BASELINE), BYTES(SCAN DATA MARK), false, true, false,
         "damaged JPEG: a Huffman table is not there"},
        {BYTES(THREE), BYTES(SCAN DATA MARK), false, false, false, "damaged JPEG: scans are not there"},
        {BYTES(BASELINE), BYTES("\xff\xda\0\x08\1\7\0\0\x3f\0" DATA MARK), false, false, false,
         "damaged JPEG: a scan of a component that is not there"},
        // The last byte of a scan is needed by nothing.
        {BYTES(BASELINE), BYTES(SCAN DATA "\0\0\0\0\0\0\0\xff\0" MARK), false, false, false, NULL},
        {BYTES(PROGRESSIVE),
         BYTES(FIRST_SCAN "\xbf\0\1\1\1\1\1\1\1\xff\0" OTHERS "\0\0\0\0\0\0\0\0\xff\0" MARK), false, false,
         false, NULL},
        {BYTES(BASELINE), BYTES(SCAN DATA "\0\0\0\0\0\0\0\xff\0" MARK), true, false, false,
         "damaged JPEG: a table of quantization is not there"},
        // Places in comments look like it. Of all, up to 16 are looked at.
        {BYTES(PROGRESSIVE),
         BYTES(FIRST_SCAN "\xbf\0\1\xff\xfe\0\x3e" LIKE_FIVE LIKE_FIVE LIKE_FIVE OTHERS TAILED MARK), false,
         false, false, NULL},
        {BYTES(PROGRESSIVE), BYTES(FIRST_SCAN "\xbf\0\1" MARK), false, true, false, NULL},
        {BYTES(PROGRESSIVE), BYTES(FIRST_SCAN "\xbf\0\1" OTHERS "\0\0" MARK), false, false, false, NULL},
        {BYTES(PROGRESSIVE), BYTES(FIRST_SCAN "\xbf\0\1" OTHERS "\0\0"), false, false, true, NULL},
        {BYTES(PROGRESSIVE), BYTES(FIRST_SCAN "\xbf\0\1" OTHERS "\0"), false, false, false,
         "the JPEG ends too early"},
        {BYTES(PROGRESSIVE), BYTES(OTHERS "\0\0" MARK), false, false, false,
         "damaged JPEG: scans are not there"},
        {BYTES(PROGRESSIVE), BYTES(REFINEMENT "\0\0" MARK), false, false, false,
         "damaged JPEG: scans are not there"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct image_file file =
            jpeg_of(cases[i].frame, cases[i].frame_size, !cases[i].lacks_quantization, !cases[i].lacks_codes);
        image_file_put_bytes(&file, cases[i].scans, cases[i].scans_size);
        if (cases[i].problem != NULL) {
            image_file_expect_refused(&file, cases[i].problem);
            continue;
        }
        struct scene_image image = image_file_decode(&file);
        const uint8_t *const texels = image.texels;
        assert_int_equal(image.lacks_end, cases[i].lacks_end);
        assert_int_equal(image.width, 8);
        assert_int_equal(image.height, 128);
        assert_in_range(texels[0], 135, 137);
        assert_int_equal(texels[image.size - 4],
                         cases[i].frame[1] == '\xc0' && cases[i].scans[1] == '\xdd' ? 128 : texels[0]);
        free(image.texels);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_jpeg_tables),
    cmocka_unit_test(test_jpeg_gaps),
};

const struct unit_tests test_jpeg = UNIT_TESTS(tests, NULL, NULL);
