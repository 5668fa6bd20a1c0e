// SPDX-License-Identifier: MIT
// Images in the formats beside PNG and JPEG that models come with. Their files are made here from the specifications, but
// for AVIF; the blocks of DDS are what the library makes of them.
#include "decoded_block.h"
#include "image_file.h"
#include "import/image/read.h"
#include "model_files.h"
#include "random_block.h"
#include "reference.h"

#include <stdlib.h>
#include <string.h>

static const char size_problem[] = "width and height must be 1 to 16384";

static void assert_texels(const struct scene_image *image, enum scene_image_type type, uint32_t width,
                          const void *texels, size_t size)
{
    assert_int_equal(image->type, type);
    assert_int_equal(image->width, width);
    assert_int_equal(image->size, size);
    assert_memory_equal(image->texels, texels, size);
}

// Decode a file and compare it, then each of its beginnings, which may be refused and may not crash.
static void check_file(const struct image_file *file, enum scene_image_type type, uint32_t width,
                       const void *texels, size_t size)
{
    struct scene_image image = image_file_decode(file);
    assert_texels(&image, type, width, texels, size);
    free(image.texels);
    for (size_t length = 0; length < file->size; length++) {
        uint8_t *const cut =
            malloc(length + 1); // of this length, so that a sanitizer sees what is read beyond it
        memcpy(cut, file->bytes, length);
        image = (struct scene_image){.width = 0};
        if (scene_image_decode(cut, length, &image) == NULL) {
            free(image.texels);
        }
        scene_image_texels(cut, length);
        free(cut);
    }
}

// DDS ----------------------------------------------------------------------------------------------------

struct dds_def {
    uint32_t width, height, flags, bits, masks[4], caps2;
    const char *code;
    uint32_t number, dimension, misc; // of the extended header
    const void *data;
    size_t size;
};

static struct image_file make_dds(const struct dds_def *def)
{
    struct image_file file = image_file_of("DDS ", 4);
    image_file_put(&file, 124, 4);
    image_file_put(&file, 0x1007, 4);
    image_file_put(&file, def->height, 4);
    image_file_put(&file, def->width, 4);
    file.size = 76;
    image_file_put(&file, 32, 4);
    image_file_put(&file, def->code != NULL ? 4 : def->flags, 4);
    image_file_put_bytes(&file, def->code != NULL ? def->code : "\0\0\0", 4);
    image_file_put(&file, def->bits, 4);
    for (int c = 0; c < 4; c++) {
        image_file_put(&file, def->masks[c], 4);
    }
    image_file_put(&file, 0x1000, 4);
    image_file_put(&file, def->caps2, 4);
    file.size = 128;
    if (def->code != NULL && memcmp(def->code, "DX10", 4) == 0) {
        image_file_put(&file, def->number, 4);
        image_file_put(&file, def->dimension != 0 ? def->dimension : 3, 4);
        image_file_put(&file, def->misc, 4);
        image_file_put(&file, 1, 4);
        image_file_put(&file, 0, 4);
    }
    image_file_put_bytes(&file, def->data, def->size);
    return file;
}

static struct scene_image decode_dds(const struct dds_def *def)
{
    const struct image_file file = make_dds(def);
    return image_file_decode(&file);
}

// Blocks are those of librhw: BC1 to BC7 by either name.
static void test_dds_blocks(void **state)
{
    (void)state;
    static const struct {
        const char *code;
        uint32_t number;
        enum rhw_format format;
    } cases[] = {
        {"DXT1", 71, RHW_FORMAT_BC1_RGBA_UNORM}, {"DXT3", 74, RHW_FORMAT_BC2_UNORM},
        {"DXT5", 78, RHW_FORMAT_BC3_UNORM},      {"ATI1", 80, RHW_FORMAT_BC4_UNORM},
        {"BC4S", 81, RHW_FORMAT_BC4_SNORM},      {"ATI2", 83, RHW_FORMAT_BC5_UNORM},
        {"BC5S", 84, RHW_FORMAT_BC5_SNORM},      {NULL, 95, RHW_FORMAT_BC6H_UFLOAT},
        {NULL, 96, RHW_FORMAT_BC6H_SFLOAT},      {NULL, 98, RHW_FORMAT_BC7_UNORM},
        {NULL, 99, RHW_FORMAT_BC7_SRGB},
    };
    struct rig rig;
    rig_open(&rig, 4, 4);
    uint64_t random = 3;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint8_t block[16];
        random_block(cases[i].format, &random, block);
        const struct dds_def extended = {.width = 4,
                                         .height = 4,
                                         .code = "DX10",
                                         .number = cases[i].number,
                                         .data = block,
                                         .size = rhw_format_block_bytes(cases[i].format)};
        struct scene_image image = decode_dds(&extended);
        const enum rhw_format decoded = rhw_format_decoded(cases[i].format);
        const void *const texels = decode(&rig, cases[i].format, block);
        if (image.type == SCENE_IMAGE_RGBA8) {
            assert_memory_equal(image.texels, texels, image.size);
        }
        const bool is_signed =
            cases[i].format == RHW_FORMAT_BC4_SNORM || cases[i].format == RHW_FORMAT_BC5_SNORM;
        for (size_t t = 0; t < 16 && image.type == SCENE_IMAGE_RGBA16; t++) {
            const float red = ((const float *)texels)[decoded == RHW_FORMAT_R32_FLOAT ? t : 4 * t];
            const uint16_t *const texel = (const uint16_t *)image.texels + 4 * t;
            assert_float_equal(texel[0], (is_signed ? red * 0.5f + 0.5f : red) * 65535, 0.51f);
            assert_true(decoded != RHW_FORMAT_R32_FLOAT || (texel[1] == texel[0] && texel[2] == texel[0]));
        }
        assert_true(image.type != SCENE_IMAGE_RGBA32F || decoded == RHW_FORMAT_RGBA16_FLOAT);
        for (size_t k = 0; k < 4 * 16 && image.type == SCENE_IMAGE_RGBA32F; k++) {
            assert_true((double)((const float *)image.texels)[k] == ref_half(((const uint16_t *)texels)[k]));
        }
        if (cases[i].code != NULL) {
            struct dds_def named = extended;
            named.code = cases[i].code;
            struct scene_image other = decode_dds(&named);
            assert_texels(&other, image.type, 4, image.texels, image.size);
            free(other.texels);
        }
        free(image.texels);
    }
    rig_close(&rig);
}

// A normal map of two components has the third one, colours that were multiplied by alpha become straight, and Doom 3's
// red comes out of alpha.
static void test_dds_changes(void **state)
{
    (void)state;
    const uint8_t normal[16] = {255, 255, [8] = 128, 128}; // x = 1, y = 0
    struct scene_image image =
        decode_dds(&(struct dds_def){.width = 4, .height = 4, .code = "BC5U", .data = normal, .size = 16});
    assert_in_range(((const uint16_t *)image.texels)[2], 32767, 32767 + 300);
    free(image.texels);
    const uint8_t half[16] = {128, 128, [8] = 0x00, 0x80, 0x00, 0x80}; // alpha 128, red 16 of 31
    static const uint8_t straight[4] = {255, 0, 0, 128}, moved[4] = {128, 0, 0, 255},
                         plain[4] = {132, 0, 0, 128};
    static const struct {
        const char *code;
        const uint8_t *expected;
    } cases[] = {{"DXT4", straight}, {"RXGB", moved}, {"DXT5", plain}};
    for (int i = 0; i < 3; i++) {
        image = decode_dds(
            &(struct dds_def){.width = 4, .height = 4, .code = cases[i].code, .data = half, .size = 16});
        assert_memory_equal(image.texels, cases[i].expected, 4);
        free(image.texels);
    }
}

// Words, whose channels the masks tell.
static void test_dds_words(void **state)
{
    (void)state;
    enum { RGB = 0x40, RGBA = 0x41, GREY = 0x20000, GREY_ALPHA = 0x20001, ALPHA = 2 };
    static const struct {
        uint32_t flags, bits, masks[4], word;
        uint8_t expected[4];
    } cases[] = {
        {RGBA, 32, {0xff0000, 0xff00, 0xff, 0xff000000}, 0x04010203, {1, 2, 3, 4}},
        {RGB, 32, {0xff0000, 0xff00, 0xff, 0xff000000}, 0x04010203, {1, 2, 3, 255}},
        {RGB, 32, {0xff, 0xff00, 0xff0000, 0}, 0x04030201, {1, 2, 3, 255}},
        {RGB, 24, {0xff0000, 0xff00, 0xff, 0}, 0x010203, {1, 2, 3, 255}},
        {RGB, 16, {0xf800, 0x7e0, 0x1f, 0}, 0xf81f, {255, 0, 255, 255}},
        {RGBA, 16, {0x7c00, 0x3e0, 0x1f, 0x8000}, 0x4210, {132, 132, 132, 0}},
        {RGBA, 16, {0xf00, 0xf0, 0xf, 0xf000}, 0x1234, {34, 51, 68, 17}},
        {RGB, 8, {0xe0, 0x1c, 0x3, 0}, 0xe3, {255, 0, 255, 255}},
        {GREY, 8, {0xff, 0, 0, 0}, 7, {7, 7, 7, 255}},
        {GREY_ALPHA, 16, {0xff, 0, 0, 0xff00}, 0x0907, {7, 7, 7, 9}},
        {ALPHA, 8, {0, 0, 0, 0xff}, 5, {0, 0, 0, 5}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct image_file word = {.size = 0};
        image_file_put(&word, cases[i].word, (int)cases[i].bits / 8);
        struct dds_def def = {.width = 1,
                              .height = 1,
                              .flags = cases[i].flags,
                              .bits = cases[i].bits,
                              .data = word.bytes,
                              .size = word.size};
        memcpy(def.masks, cases[i].masks, sizeof def.masks);
        const struct image_file file = make_dds(&def);
        check_file(&file, SCENE_IMAGE_RGBA8, 1, cases[i].expected, 4);
    }
    const uint32_t tens = 1023u | 512u << 10 | 3u << 30;
    struct scene_image image = decode_dds(
        &(struct dds_def){.width = 1, .height = 1, .code = "DX10", .number = 24, .data = &tens, .size = 4});
    assert_texels(&image, SCENE_IMAGE_RGBA16, 1, (const uint16_t[]){65535, 32800, 0, 65535}, 8);
    free(image.texels);
    const float light[4] = {2, 0.5f, 0, 1};
    image = decode_dds(&(struct dds_def){
        .width = 1, .height = 1, .code = "DX10", .number = 2, .data = light, .size = sizeof light});
    assert_texels(&image, SCENE_IMAGE_RGBA32F, 1, light, sizeof light);
    free(image.texels);
    uint8_t palette[1024 + 2] = {[4 * 9] = 1, 2, 3, 4, [1024] = 0, 9};
    image = decode_dds(&(struct dds_def){
        .width = 2, .height = 1, .flags = 0x20, .bits = 8, .data = palette, .size = sizeof palette});
    assert_texels(&image, SCENE_IMAGE_RGBA8, 2, (const uint8_t[]){0, 0, 0, 0, 1, 2, 3, 4}, 8);
    free(image.texels);
}

static void test_dds_refused(void **state)
{
    (void)state;
    const uint8_t block[16] = {0};
    static const struct {
        struct dds_def def;
        const char *problem;
    } cases[] = {
        {{.width = 4, .height = 4, .code = "DXT1", .caps2 = 0x200}, "a DDS file of a cube map"},
        {{.width = 4, .height = 4, .code = "DX10", .number = 71, .misc = 4}, "a DDS file of a cube map"},
        {{.width = 4, .height = 4, .code = "DXT1", .caps2 = 0x200000},
         "a DDS file of slices or of one dimension"},
        {{.width = 4, .height = 4, .code = "DX10", .number = 71, .dimension = 4},
         "a DDS file of slices or of one dimension"},
        {{.width = 4, .height = 4, .code = "UYVY"}, "a DDS file of a pixel format that is not read"},
        {{.width = 4, .height = 4, .code = "DX10", .number = 1000},
         "a DDS file of a pixel format that is not read"},
        {{.width = 4, .height = 4, .flags = 0x40, .bits = 7},
         "a DDS file of a pixel format that is not read"},
        {{.width = 0, .height = 4, .code = "DXT1"}, "width and height must be 1 to 16384"},
        {{.width = 16385, .height = 4, .code = "DXT1"}, "width and height must be 1 to 16384"},
        {{.width = 16384, .height = 16384, .code = "DXT5"}, "the DDS file ends too early"},
        {{.width = 64, .height = 64, .flags = 0x40, .bits = 32, .masks = {255, 255, 255, 0}},
         "the DDS file ends too early"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct dds_def def = cases[i].def;
        def.data = block;
        def.size = sizeof block;
        const struct image_file file = make_dds(&def);
        image_file_expect_refused(&file, cases[i].problem);
    }
}

// TIFF ---------------------------------------------------------------------------------------------------

struct tiff_def {
    uint32_t width, height, bits, samples, photometric, sample_format, planar, extra, orientation, tile;
    const void *data;
    uint32_t size; // of all samples; of planes, of each
};

static void put_tag(struct image_file *file, uint32_t tag, uint32_t type, uint32_t count, uint32_t value)
{
    image_file_put(file, tag, 2);
    image_file_put(file, type, 2);
    image_file_put(file, count, 4);
    image_file_put(file, value, 4);
}

// One strip or tile with all samples, or one for each plane of three.
static struct image_file make_tiff(const struct tiff_def *def)
{
    enum { SHORT = 3, LONG = 4, DATA = 256, BITS = 1024, OFFSETS = 1040, COUNTS = 1056, KINDS = 1072 };
    struct image_file file = {.size = 0};
    const bool is_tiled = def->tile != 0;
    const uint32_t chunks = def->planar == 2 ? def->samples : 1;
    const uint32_t kind = def->sample_format != 0 ? def->sample_format : 1;
    const uint32_t tags = 12 + (is_tiled ? 1u : 0u) + (def->extra != 0 ? 1u : 0u);
    image_file_put_bytes(&file, "II*\0", 4);
    image_file_put(&file, 8, 4);
    image_file_put(&file, tags, 2);
    put_tag(&file, 256, LONG, 1, def->width);
    put_tag(&file, 257, LONG, 1, def->height);
    put_tag(&file, 258, SHORT, def->samples, def->samples > 2 ? BITS : def->bits | def->bits << 16);
    put_tag(&file, 259, SHORT, 1, 1);
    put_tag(&file, 262, SHORT, 1, def->photometric);
    if (!is_tiled) {
        put_tag(&file, 273, LONG, chunks, chunks > 1 ? OFFSETS : DATA);
    }
    put_tag(&file, 274, SHORT, 1, def->orientation != 0 ? def->orientation : 1);
    put_tag(&file, 277, SHORT, 1, def->samples);
    if (!is_tiled) {
        put_tag(&file, 278, LONG, 1, def->height);
        put_tag(&file, 279, LONG, chunks, chunks > 1 ? COUNTS : def->size);
    }
    put_tag(&file, 284, SHORT, 1, def->planar != 0 ? def->planar : 1);
    if (is_tiled) {
        put_tag(&file, 322, LONG, 1, def->tile);
        put_tag(&file, 323, LONG, 1, def->tile);
        put_tag(&file, 324, LONG, 1, DATA);
        put_tag(&file, 325, LONG, 1, def->size);
    }
    if (def->extra != 0) {
        put_tag(&file, 338, SHORT, 1, def->extra);
    }
    put_tag(&file, 339, SHORT, def->samples, def->samples > 2 ? KINDS : kind | kind << 16);
    image_file_put(&file, 0, 4);
    file.size = DATA;
    image_file_put_bytes(&file, def->data, def->size * chunks);
    if (def->samples > 2 || chunks > 1) {
        file.size = BITS;
        for (uint32_t i = 0; i < 8; i++) {
            image_file_put(&file, def->bits, 2);
        }
        for (uint32_t i = 0; i < 4; i++) {
            image_file_put(&file, DATA + i * def->size, 4);
        }
        for (uint32_t i = 0; i < 4; i++) {
            image_file_put(&file, def->size, 4);
        }
        for (uint32_t i = 0; i < 8; i++) {
            image_file_put(&file, kind, 2);
        }
    }
    return file;
}

static void check_tiff(const struct tiff_def *def, enum scene_image_type type, const void *texels,
                       size_t size)
{
    const struct image_file file = make_tiff(def);
    if (!SCENE_TIFF) {
        image_file_expect_refused(&file, "a TIFF image, which this build does not read");
        return;
    }
    check_file(&file, type, def->width, texels, size);
    assert_int_equal(scene_image_texels(file.bytes, file.size), def->width * def->height);
}

static void test_tiff_bytes(void **state)
{
    (void)state;
    const uint8_t samples[] = {1, 2, 3, 4, 5, 6, 7, 8};
    check_tiff(&(struct tiff_def){2, 1, 8, 3, .photometric = 2, .data = samples, .size = 6},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){1, 2, 3, 255, 4, 5, 6, 255}, 8);
    check_tiff(&(struct tiff_def){1, 2, 8, 4, .photometric = 2, .extra = 2, .data = samples, .size = 8},
               SCENE_IMAGE_RGBA8, samples, 8);
    check_tiff(&(struct tiff_def){2, 1, 8, 1, .photometric = 1, .data = samples, .size = 2},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){1, 1, 1, 255, 2, 2, 2, 255}, 8);
    check_tiff(&(struct tiff_def){2, 1, 8, 1, .photometric = 0, .data = samples, .size = 2},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){254, 254, 254, 255, 253, 253, 253, 255}, 8);
    check_tiff(&(struct tiff_def){1, 1, 8, 2, .photometric = 1, .extra = 2, .data = samples, .size = 2},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){1, 1, 1, 2}, 4);
    const uint8_t multiplied[] = {64, 32, 0, 128};
    check_tiff(&(struct tiff_def){1, 1, 8, 4, .photometric = 2, .extra = 1, .data = multiplied, .size = 4},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){128, 64, 0, 128}, 4);
    check_tiff(&(struct tiff_def){2, 1, 8, 3, .photometric = 2, .planar = 2, .data = samples, .size = 2},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){1, 3, 5, 255, 2, 4, 6, 255}, 8);
    check_tiff(&(struct tiff_def){2, 1, 8, 3, .photometric = 2, .orientation = 2, .data = samples, .size = 6},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){4, 5, 6, 255, 1, 2, 3, 255}, 8);
    check_tiff(&(struct tiff_def){1, 2, 8, 3, .photometric = 2, .orientation = 4, .data = samples, .size = 6},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){4, 5, 6, 255, 1, 2, 3, 255}, 8);
    uint8_t tile[256] = {9, 8, [16] = 7, 6};
    check_tiff(&(struct tiff_def){2, 2, 8, 1, .photometric = 1, .tile = 16, .data = tile, .size = 256},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){9, 9, 9, 255, 8, 8, 8, 255, 7, 7, 7, 255, 6, 6, 6, 255},
               16);
    check_tiff(&(struct tiff_def){1, 1, 8, 4, .photometric = 5, .data = (const uint8_t[]){0, 255, 255, 0},
                                  .size = 4},
               SCENE_IMAGE_RGBA8, (const uint8_t[]){255, 0, 0, 255}, 4); // CMYK
}

static void test_tiff_wide(void **state)
{
    (void)state;
    const uint16_t words[3] = {1, 300, 65535}, halves[3] = {0x3c00, 0xc000, 0x3800};
    const float light[3] = {4, -2, 0.5f};
    check_tiff(&(struct tiff_def){1, 1, 16, 3, .photometric = 2, .data = words, .size = 6},
               SCENE_IMAGE_RGBA16, (const uint16_t[]){1, 300, 65535, 65535}, 8);
    check_tiff(
        &(struct tiff_def){1, 1, 32, 3, .photometric = 2, .sample_format = 3, .data = light, .size = 12},
        SCENE_IMAGE_RGBA32F, (const float[]){4, -2, 0.5f, 1}, 16);
    check_tiff(
        &(struct tiff_def){1, 1, 16, 3, .photometric = 2, .sample_format = 3, .data = halves, .size = 6},
        SCENE_IMAGE_RGBA32F, (const float[]){1, -2, 0.5f, 1}, 16);
    const struct image_file large =
        make_tiff(&(struct tiff_def){16385, 1, 8, 1, .photometric = 1, .data = words, .size = 6});
    const struct image_file strange =
        make_tiff(&(struct tiff_def){1, 1, 32, 3, .photometric = 2, .data = light, .size = 12});
    if (SCENE_TIFF) {
        image_file_expect_refused(&large, "width and height must be 1 to 16384");
        image_file_expect_refused(&strange, "a TIFF file of samples that are not read");
    }
}

// OpenEXR ------------------------------------------------------------------------------------------------

static void put_attribute(struct image_file *file, const char *name, const char *type, const void *value,
                          uint32_t size)
{
    image_file_put_bytes(file, name, strlen(name) + 1);
    image_file_put_bytes(file, type, strlen(type) + 1);
    image_file_put(file, size, 4);
    image_file_put_bytes(file, value, size);
}

static void put_exr_row(struct image_file *file, const float *samples, size_t count)
{
    image_file_put(file, file->size + 8, 8); // where it begins
    image_file_put(file, 0, 4);
    image_file_put(file, count * 4, 4);
    image_file_put_bytes(file, samples, count * 4);
}

// Each a tile of its own.
static void put_exr_tiles(struct image_file *file, const float *samples, size_t channels, uint32_t width)
{
    const uint64_t first = file->size + 8 * (size_t)width, size = 20 + 4 * channels;
    for (uint32_t x = 0; x < width; x++) {
        image_file_put(file, first + x * size, 8);
    }
    for (uint32_t x = 0; x < width; x++) {
        image_file_put(file, x, 4);
        image_file_put(file, 0, 12); // row and levels
        image_file_put(file, 4 * channels, 4);
        for (size_t c = 0; c < channels; c++) {
            image_file_put_bytes(file, &samples[c * width + x], 4);
        }
    }
}

// One row of floats, without compression; `names` are the channels, in alphabetic order.
static struct image_file make_exr(const char *names, const float *samples, uint32_t width, bool in_tiles)
{
    struct image_file file = {.size = 0}, channels = {.size = 0}, window = {.size = 0};
    const size_t count = strlen(names);
    const float one = 1, middle[2] = {0, 0};
    for (size_t i = 0; i < count; i++) {
        image_file_put(&channels, (uint8_t)names[i], 2); // with its end
        image_file_put(&channels, 2, 4);                 // floats
        image_file_put(&channels, 0, 4);
        image_file_put(&channels, 1, 4);
        image_file_put(&channels, 1, 4);
    }
    image_file_put(&channels, 0, 1);
    image_file_put(&window, 0, 8);
    image_file_put(&window, width - 1, 4);
    image_file_put(&window, 0, 4);
    image_file_put(&file, 20000630, 4);
    image_file_put(&file, in_tiles ? 0x202 : 2, 4);
    put_attribute(&file, "channels", "chlist", channels.bytes, (uint32_t)channels.size);
    put_attribute(&file, "compression", "compression", "", 1);
    put_attribute(&file, "dataWindow", "box2i", window.bytes, 16);
    put_attribute(&file, "displayWindow", "box2i", window.bytes, 16);
    put_attribute(&file, "lineOrder", "lineOrder", "", 1);
    put_attribute(&file, "pixelAspectRatio", "float", &one, 4);
    put_attribute(&file, "screenWindowCenter", "v2f", middle, 8);
    put_attribute(&file, "screenWindowWidth", "float", &one, 4);
    if (in_tiles) {
        put_attribute(&file, "tiles", "tiledesc", "\1\0\0\0\1\0\0\0", 9);
    }
    image_file_put(&file, 0, 1);
    if (in_tiles) {
        put_exr_tiles(&file, samples, count, width);
    } else {
        put_exr_row(&file, samples, count * width);
    }
    return file;
}

static void check_exr(const char *names, const float *samples, const float *expected)
{
    for (int in_tiles = 0; in_tiles < 2; in_tiles++) {
        const struct image_file file = make_exr(names, samples, 2, in_tiles);
        if (SCENE_EXR) {
            check_file(&file, SCENE_IMAGE_RGBA32F, 2, expected, 32);
        } else {
            image_file_expect_refused(&file, "an EXR image, which this build does not read");
        }
    }
}

static void test_exr(void **state)
{
    (void)state;
    const float samples[8] = {0.25f, 0.5f, 1, 2, 3, 4, 5, 6};
    check_exr("ABGR", samples, (const float[]){5, 3, 1, 0.25f, 6, 4, 2, 0.5f});
    check_exr("BGRZ", samples, (const float[]){3, 1, 0.25f, 1, 4, 2, 0.5f, 1}); // depth is no colour
    check_exr("Y", samples, (const float[]){0.25f, 0.25f, 0.25f, 1, 0.5f, 0.5f, 0.5f, 1});
    if (SCENE_EXR) {
        const struct image_file depth = make_exr("Z", samples, 2, false);
        image_file_expect_refused(&depth, "an EXR file without the channels R, G and B, or Y");
    }
}

// GIF and AVIF -------------------------------------------------------------------------------------------

// 3 × 2 texels, of which the blue one is transparent.
static void test_gif(void **state)
{
    (void)state;
    static const uint8_t bytes[] = {
        'G',  'I', 'F',  '8',  '9',  'a',  3,    0,    2,    0,    0x82, 0,    0,    0xff, 0xff, 0xff, 0,
        0xff, 0,   0xc8, 0x64, 0x32, 0x0a, 0x14, 0x1e, 0xff, 0,    0,    0,    0,    0xff, 0,    0,    0,
        0,    0,   0,    0x21, 0xf9, 4,    1,    0,    0,    5,    0,    0x2c, 0,    0,    0,    0,    3,
        0,    2,   0,    0,    8,    9,    0,    9,    4,    0x28, 0,    0x60, 0x80, 0x80, 0x80, 0,    0x3b};
    static const uint8_t expected[] = {255, 0,   0,   255, 0,  255, 0,  255, 0,   0,   255, 0,
                                       255, 255, 255, 255, 10, 20,  30, 255, 200, 100, 50,  255};
    struct image_file file = image_file_of(bytes, sizeof bytes);
    if (!SCENE_GIF) {
        image_file_expect_refused(&file, "a GIF image, which this build does not read");
        return;
    }
    check_file(&file, SCENE_IMAGE_RGBA8, 3, expected, sizeof expected);
    file.bytes[50] = 4; // the picture is wider than the canvas
    image_file_expect_refused(&file, "damaged GIF");
    file.bytes[50] = 3;
}

// 8 × 8 texels, of which the upper half lets through.
static const char avif_base64[] =
    "AAAAIGZ0eXBhdmlmAAAAAGF2aWZtaWYxbWlhZk1BMUEAAAGNbWV0YQAAAAAAAAAoaGRscgAAAAAAAAAAcGljdAAAAAAAAAAA"
    "AAAAAGxpYmF2aWYAAAAADnBpdG0AAAAAAAEAAAAsaWxvYwAAAABEAAACAAEAAAABAAAByAAAADMAAgAAAAEAAAG1AAAAEwAA"
    "AEJpaW5mAAAAAAACAAAAGmluZmUCAAAAAAEAAGF2MDFDb2xvcgAAAAAaaW5mZQIAAAAAAgAAYXYwMUFscGhhAAAAABppcmVm"
    "AAAAAAAAAA5hdXhsAAIAAQABAAAAw2lwcnAAAACdaXBjbwAAABRpc3BlAAAAAAAAAAgAAAAIAAAAEHBpeGkAAAAAAwgICAAA"
    "AAxhdjFDgSAAAAAAABNjb2xybmNseAABAA0ABoAAAAAOcGl4aQAAAAABCAAAAAxhdjFDgQAcAAAAADhhdXhDAAAAAHVybjpt"
    "cGVnOm1wZWdCOmNpY3A6c3lzdGVtczphdXhpbGlhcnk6YWxwaGEAAAAAHmlwbWEAAAAAAAAAAgABBAECgwQAAgQBBYYHAAAA"
    "Tm1kYXQSAAoFGAi/YVAyCBAAidV+VM3wEgAKCDgIv2EBDQaQMiUQgAAAUEHBvApcfIT60Oq11ZRSfV3tL0OwrvOWjFdxcKBd"
    "Yaye";

static void test_avif(void **state)
{
    (void)state;
    struct image_file file;
    struct scene_image image = {.width = 0};
    file.size = read_base64(avif_base64, file.bytes);
    if (!SCENE_AVIF) {
        image_file_expect_refused(&file, "an AVIF image, which this build does not read");
        return;
    }
    const char *const problem = scene_image_decode(file.bytes, file.size, &image);
    if (problem != NULL && strstr(problem, "is not there") != NULL) {
        skip(); // libavif is opened where there is an AVIF, and may lack
    }
    assert_null(problem);
    static const uint8_t upper[4] = {20, 60, 220, 128}, lower[4] = {200, 100, 50, 255};
    assert_int_equal(image.width, 8);
    assert_int_equal(image.type, SCENE_IMAGE_RGBA8);
    assert_true(image.has_alpha);
    for (int c = 0; c < 4; c++) {
        const uint8_t *const texels = image.texels;
        assert_in_range(texels[4 * 9 + c], upper[c] - 4, upper[c] + 4);
        assert_in_range(texels[4 * 57 + c], lower[c] - 4, c == 3 ? 255 : lower[c] + 4);
    }
    free(image.texels);
    const struct image_file whole = file;
    file.size /= 2;
    image_file_expect_refused(&file, "damaged AVIF");
    file = whole;
    size_t at = 0;
    while (memcmp(file.bytes + at, "ispe", 4) != 0) {
        at++;
    }
    memcpy(file.bytes + at + 8, "\0\0\x40\x01", 4); // a width of 16385
    image_file_expect_refused(&file, size_problem);
}

// SGI ----------------------------------------------------------------------------------------------------

// The header of an image of 3 × 2 texels, what follows it behind.
static struct image_file sgi_of(bool is_packed, uint8_t depth, uint8_t channels, const void *rest,
                                size_t size)
{
    struct image_file file = {.size = 512 + size};
    const uint8_t head[12] = {1, 0xda, is_packed, depth, 0, channels > 1 ? 3 : 2, 0, 3, 0, 2, 0, channels};
    memset(file.bytes, 0, 512);
    memcpy(file.bytes, head, sizeof head);
    memcpy(file.bytes + 512, rest, size);
    return file;
}

// Rows of a channel stand from the bottom up, packed or not, and channels one behind the other.
static void test_sgi(void **state)
{
    (void)state;
    static const uint8_t grey[] = {1, 2, 3, 4, 5, 6};
    static const uint8_t grey_texels[] = {4, 4, 4, 255, 5, 5, 5, 255, 6, 6, 6, 255,
                                          1, 1, 1, 255, 2, 2, 2, 255, 3, 3, 3, 255};
    struct image_file file = sgi_of(false, 1, 1, grey, sizeof grey);
    check_file(&file, SCENE_IMAGE_RGBA8, 3, grey_texels, sizeof grey_texels);
    file.size--;
    image_file_expect_refused(&file, "damaged SGI image");
    static const uint8_t deep[] = {1,    2, 3,    4, 5,    6, 7,    8, 9,    10, 11,   12,
                                   0x10, 0, 0x20, 0, 0x30, 0, 0x40, 0, 0x50, 0,  0x60, 0};
    static const uint16_t deep_texels[] = {0x708, 0x708, 0x708, 0x4000, 0x90a, 0x90a, 0x90a, 0x5000,
                                           0xb0c, 0xb0c, 0xb0c, 0x6000, 0x102, 0x102, 0x102, 0x1000,
                                           0x304, 0x304, 0x304, 0x2000, 0x506, 0x506, 0x506, 0x3000};
    file = sgi_of(false, 2, 2, deep, sizeof deep);
    check_file(&file, SCENE_IMAGE_RGBA16, 3, deep_texels, sizeof deep_texels);
    // Three channels of two rows, whose table says where each starts and how long it is. All lower rows are one.
    static const uint8_t packed[] = {0, 0, 2, 48, 0, 0, 2, 51, 0, 0, 2, 48,   0, 0, 2, 56, 0,    0, 2, 48,
                                     0, 0, 2, 56, 0, 0, 0, 3,  0, 0, 0, 5,    0, 0, 0, 3,  0,    0, 0, 4,
                                     0, 0, 0, 3,  0, 0, 0, 4,  3, 9, 0, 0x83, 7, 8, 9, 0,  0x81, 1, 2, 5};
    static const uint8_t packed_texels[] = {7, 1, 1, 255, 8, 5, 5, 255, 9, 5, 5, 255,
                                            9, 9, 9, 255, 9, 9, 9, 255, 9, 9, 9, 255};
    file = sgi_of(true, 1, 3, packed, sizeof packed);
    check_file(&file, SCENE_IMAGE_RGBA8, 3, packed_texels, sizeof packed_texels);
    static const struct {
        size_t place;
        uint8_t byte;
        const char *problem;
    } broken[] = {
        {560, 2, "damaged SGI image"}, // a row that is short
        {560, 4, "damaged SGI image"}, // a row that is long
        {563, 0x84, "damaged SGI image"},
        {516 + 2, 9, "damaged SGI image"},      // a row behind the end
        {512 + 24 + 1, 1, "damaged SGI image"}, // a row that ends behind it
        {2, 2, "damaged SGI image"},
        {3, 3, "damaged SGI image"},
        {11, 0, "an SGI image that has not 1 to 4 channels"},
        {11, 5, "an SGI image that has not 1 to 4 channels"},
        {107, 2, "an SGI image with a map of colours, which is not read"},
    };
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        struct image_file other = file;
        other.bytes[broken[i].place] = broken[i].byte;
        image_file_expect_refused(&other, broken[i].problem);
    }
}

// Sizes --------------------------------------------------------------------------------------------------

// The headers of files that begin as images do, and where their width stands.
static const struct {
    const char *name, *bytes;
    size_t size, place, length; // length: bytes of the width
    bool is_big_endian;
} headers[] = {
#define BYTES(text) text, sizeof(text) - 1
    {"PNG", BYTES("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\0\1\0\0\0\1\x08\6\0\0\0\0\0\0\0"), 16, 4, true},
    {"PNG of an iPhone",
     BYTES(
         "\x89PNG\r\n\x1a\n\0\0\0\4CgBI\x50\0\x20\6\x2b\xd5\xb3\x7f\0\0\0\x0dIHDR\0\0\0\1\0\0\0\1\x08\6\0\0\0"
         "\0\0\0\0"),
     32, 4, true},
    {"JPEG", BYTES("\xff\xd8\xff\xe0\0\4\xff\xc4\xff\xc0\0\x0b\x08\0\1\0\1\1\1\x11\0\xff\xda"), 15, 2, true},
    {"progressive JPEG", BYTES("\xff\xd8\xff\xc2\0\x0b\x08\0\1\0\1\1\1\x11\0\xff\xda"), 9, 2, true},
    {"GIF", BYTES("GIF89a\1\0\1\0\0\0\0"), 6, 2, false},
    {"BMP", BYTES("BM\0\0\0\0\0\0\0\0\x1a\0\0\0\x0c\0\0\0\1\0\1\0\1\0\x18\0\0\0\0\0"), 18, 2, false},
    {"TGA", BYTES("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0"), 12, 2, false},
    {"SGI", BYTES("\1\xda\0\1\0\2\0\1\0\1\0\1"), 6, 2, true},
    {"PSD", BYTES("8BPS\0\1\0\0\0\0\0\0\0\3\0\0\0\1\0\0\0\1\0\x08\0\3"), 18, 4, true},
#undef BYTES
};

// A size that is refused is told by the header alone, for what a file of it would take and not for what it lacks.
static void test_sizes(void **state)
{
    (void)state;
    static const uint32_t widths[] = {16385, 20000, 60000};
    for (size_t i = 0; i < sizeof headers / sizeof headers[0]; i++) {
        if (strcmp(headers[i].name, "GIF") == 0 && !SCENE_GIF) {
            continue;
        }
        struct image_file file = image_file_of(headers[i].bytes, headers[i].size);
        for (size_t w = 0; w < sizeof widths / sizeof widths[0]; w++) {
            for (size_t b = 0; b < headers[i].length; b++) {
                const size_t last = headers[i].is_big_endian ? headers[i].length - 1 - b : b;
                file.bytes[headers[i].place + last] = (uint8_t)(widths[w] >> 8 * b);
            }
            struct scene_image image = {.width = 0};
            const char *const problem = scene_image_decode(file.bytes, file.size, &image);
            if (problem == NULL || strcmp(problem, size_problem) != 0) {
                fail_msg("%s of %u texels: %s", headers[i].name, widths[w], problem);
            }
            assert_string_equal(scene_image_decode_within(file.bytes, file.size, 64, true, &image),
                                size_problem);
        }
    }
}

// A BMP of a negative height has its rows from the top down.
static void test_bmp_from_top(void **state)
{
    (void)state;
    struct image_file file = image_file_of("BM", 2);
    image_file_put(&file, 62, 4);
    image_file_put(&file, 0, 4);
    image_file_put(&file, 54, 4);
    image_file_put(&file, 40, 4);
    image_file_put(&file, 1, 4);
    image_file_put(&file, (uint32_t)-2, 4);
    image_file_put(&file, 1, 2);
    image_file_put(&file, 24, 2);
    file.size = 54;
    image_file_put(&file, 0x102030, 4);
    image_file_put(&file, 0x405060, 4);
    static const uint8_t expected[] = {0x10, 0x20, 0x30, 255, 0x40, 0x50, 0x60, 255};
    struct scene_image image = image_file_decode(&file);
    assert_texels(&image, SCENE_IMAGE_RGBA8, 1, expected, sizeof expected);
    free(image.texels);
}

// A PNG or a JPEG that is damaged is called so, and not an unknown format or another's.
static void test_damaged_headers(void **state)
{
    (void)state;
    struct image_file file = image_file_of(headers[0].bytes, 20);
    image_file_expect_refused(&file, "damaged PNG");
    file = image_file_of("\xff\xd8\xff\xe0\0\4ab", 8);
    image_file_expect_refused(&file, "damaged JPEG");
    file = image_file_of(headers[0].bytes, headers[0].size);
    file.bytes[18] = file.bytes[22] = 0x40; // 16384 each way
    file.bytes[19] = file.bytes[23] = 0;
    file.bytes[24] = 16;
    image_file_expect_refused(&file, "a PNG of 2 GiB of samples, which is not read");
}

// An image whose last texels are not there is refused, whatever the size of its header and its texels.
static void test_cut_images(void **state)
{
    (void)state;
    static const struct {
        const char *head;
        size_t head_size, data_size;
    } images[] = {
#define BYTES(text) text, sizeof(text) - 1
        {BYTES("P6 1 1 255\n"), 3},
        {BYTES("P5 40 40 255\n"), 1600},
        {BYTES("P5 16 16 65535\n"), 512},
        {BYTES("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\40\0"), 4},
        {BYTES("\0\0\2\0\0\0\0\0\0\0\0\0\40\0\40\0\30\0"), 3072},
        {BYTES("\0\0\12\0\0\0\0\0\0\0\0\0\40\0\2\0\30\0\237\1\2\3\237"), 3}, // in runs
        {BYTES("BM\0\0\0\0\0\0\0\0\66\0\0\0\50\0\0\0\20\0\0\0\20\0\0\0\1\0\40\0"
               "\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"),
         1024},
        {BYTES("8BPS\0\1\0\0\0\0\0\0\0\3\0\0\0\20\0\0\0\20\0\10\0\3\0\0\0\0\0\0\0\0\0\0\0\0\0\0"), 768},
#undef BYTES
    };
    for (size_t i = 0; i < sizeof images / sizeof images[0]; i++) {
        struct image_file file = image_file_of(images[i].head, images[i].head_size);
        file.size += images[i].data_size;
        struct scene_image image = image_file_decode(&file);
        free(image.texels);
        file.size--;
        image_file_expect_refused(&file, "the file ends too early");
        file.size = images[i].head_size;
        image_file_expect_refused(&file, "the file ends too early");
    }
}
// Formats that are known and not read have their name in the refusal.
static void test_named_refusals(void **state)
{
    (void)state;
    static const struct {
        const char *bytes, *problem;
    } cases[] = {
        {"\0\0\0\x0cjP  \r\n\x87\n", "a JPEG 2000 image, which is not read"},
        {"\xff\x0a\0\0\0\0\0\0\0\0\0\0", "a JPEG XL image, which is not read"},
        {"\0\0\0\x18"
         "ftypheic",
         "an HEIC image, which is not read"},
        {"nothing that is known", "not an image format that can be read"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct image_file file = image_file_of(cases[i].bytes, 12);
        image_file_expect_refused(&file, cases[i].problem);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_dds_blocks),
    cmocka_unit_test(test_dds_changes),
    cmocka_unit_test(test_dds_words),
    cmocka_unit_test(test_dds_refused),
    cmocka_unit_test(test_tiff_bytes),
    cmocka_unit_test(test_tiff_wide),
    cmocka_unit_test(test_exr),
    cmocka_unit_test(test_gif),
    cmocka_unit_test(test_sgi),
    cmocka_unit_test(test_avif),
    cmocka_unit_test(test_sizes),
    cmocka_unit_test(test_bmp_from_top),
    cmocka_unit_test(test_cut_images),
    cmocka_unit_test(test_damaged_headers),
    cmocka_unit_test(test_named_refusals),
};

const struct unit_tests test_image_formats = UNIT_TESTS(tests, NULL, NULL);
