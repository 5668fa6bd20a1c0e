// SPDX-License-Identifier: MIT
// Regions of textures written, read and copied: every texel is where it belongs, and no other has changed.
#include "harness.h"

#include <string.h>

enum { WIDTH = 9, HEIGHT = 6, SLICES = 5, TEXELS = WIDTH * HEIGHT * SLICES };

static const struct rhw_texture_def volume = {.format = RHW_FORMAT_R32_UINT,
                                              .width = WIDTH,
                                              .height = HEIGHT,
                                              .depth = SLICES,
                                              .kind = RHW_TEXTURE_3D,
                                              .label = "volume"},
                                    array = {.format = RHW_FORMAT_R32_FLOAT,
                                             .width = WIDTH,
                                             .height = HEIGHT,
                                             .layers = SLICES,
                                             .mip_levels = 2,
                                             .label = "array"};

static rhw_texture make(const struct rig *rig, const struct rhw_texture_def *def)
{
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, def, &texture), RHW_OK);
    return texture;
}

// The number of a texel of level 0.
static uint32_t number(int x, int y, int z)
{
    return (uint32_t)(x + 100 * y + 10000 * z);
}

static rhw_texture make_numbered(const struct rig *rig, const struct rhw_texture_def *def)
{
    static uint32_t texels[TEXELS];
    for (int i = 0; i < TEXELS; i++) {
        texels[i] = number(i % WIDTH, i / WIDTH % HEIGHT, i / WIDTH / HEIGHT);
    }
    const rhw_texture texture = make(rig, def);
    assert_int_equal(rhw_texture_write_region(rig->context, texture, NULL, texels, 0, 0), RHW_OK);
    return texture;
}

// Texels of level 0.
static const uint32_t *all_texels(const struct rig *rig, rhw_texture texture)
{
    static uint32_t texels[TEXELS];
    memset(texels, 0xff, sizeof texels);
    assert_int_equal(rhw_texture_read_region(rig->context, texture, NULL, texels, 0, 0), RHW_OK);
    return texels;
}

static bool is_within(const struct rhw_texture_region *region, int x, int y, int z)
{
    return x >= region->x && x < region->x + region->width && y >= region->y &&
           y < region->y + region->height && z >= region->z && z < region->z + region->depth;
}

static void test_write_and_read(void **state)
{
    (void)state;
    static const struct rhw_texture_region region = {
        .x = 2, .y = 1, .z = 1, .width = 4, .height = 3, .depth = 2};
    enum { ROW = 7, SLICE = ROW * 4 }; // words
    static const struct rhw_texture_def *const defs[] = {&volume, &array};
    struct rig rig;
    rig_open(&rig, 4, 4);
    for (int n = 0; n < 2; n++) {
        const rhw_texture texture = make_numbered(&rig, defs[n]);
        uint32_t words[2 * SLICE];
        for (int i = 0; i < 2 * SLICE; i++) {
            words[i] = 0x1000000 + (uint32_t)i;
        }
        assert_int_equal(rhw_texture_write_region(rig.context, texture, &region, words, 4 * ROW, 4 * SLICE),
                         RHW_OK);
        const uint32_t *const texels = all_texels(&rig, texture);
        for (int i = 0; i < TEXELS; i++) {
            const int x = i % WIDTH, y = i / WIDTH % HEIGHT, z = i / WIDTH / HEIGHT;
            const uint32_t word = 0x1000000 + (uint32_t)((z - 1) * SLICE + (y - 1) * ROW + x - 2);
            assert_int_equal(texels[i], is_within(&region, x, y, z) ? word : number(x, y, z));
        }
        // A read of other sizes, tightly packed: up to the far corner.
        static const struct rhw_texture_region corner = {.x = 5, .y = 4, .z = 2};
        uint32_t read[4 * 2 * 3 + 1] = {[24] = 77};
        assert_int_equal(rhw_texture_read_region(rig.context, texture, &corner, read, 0, 0), RHW_OK);
        for (int i = 0; i < 24; i++) {
            assert_int_equal(read[i], number(5 + i % 4, 4 + i / 4 % 2, 2 + i / 8));
        }
        assert_int_equal(read[24], 77);
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

static void test_levels(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture texture = make(&rig, &array);
    float texels[4 * 3], read[4 * 3];
    for (int i = 0; i < 12; i++) {
        texels[i] = (float)i;
    }
    const struct rhw_texture_region level = {.level = 1, .z = 3, .depth = 1};
    assert_int_equal(rhw_texture_write_region(rig.context, texture, &level, texels, 0, 0), RHW_OK);
    assert_int_equal(rhw_texture_read_layer(rig.context, texture, 1, 3, read, 0), RHW_OK);
    assert_memory_equal(read, texels, sizeof read);
    rhw_texture_write_region(rig.context, texture, &(struct rhw_texture_region){.level = 1, .width = 5},
                             texels, 0, 0);
    rig_expect_misuse(&rig,
                      "rhw_texture_write_region: region.x is 0 and region.width is 5; from there level 1 "
                      "of texture 2 \"array\" has 1..4");
    rig_close(&rig);
}

// Stencil of layers, and of single samples.
static void test_stencil(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {RHW_FORMAT_S8_UINT, RHW_FORMAT_D24_UNORM_S8_UINT,
                                              RHW_FORMAT_D32_FLOAT_S8_UINT};
    struct rig rig;
    rig_open(&rig, 4, 4);
    for (int n = 0; n < 6; n++) {
        const bool samples = n % 2 != 0;
        const struct rhw_texture_def def = {.format = formats[n / 2],
                                            .width = 6,
                                            .height = 3,
                                            .layers = samples ? 0 : 4,
                                            .samples = samples ? 4 : 0};
        const rhw_texture texture = make(&rig, &def);
        uint8_t stencil[4][18], read[18];
        for (int part = 0; part < 4; part++) {
            for (int i = 0; i < 18; i++) {
                stencil[part][i] = (uint8_t)(40 * part + i);
            }
            const struct rhw_texture_region region = {.z = samples ? 0 : part,
                                                      .depth = 1,
                                                      .sample = samples ? part : 0,
                                                      .aspect = RHW_ASPECT_STENCIL};
            assert_int_equal(rhw_texture_write_region(rig.context, texture, &region, stencil[part], 0, 0),
                             RHW_OK);
        }
        for (int part = 0; part < 4; part++) {
            const struct rhw_texture_region region = {.z = samples ? 0 : part,
                                                      .depth = 1,
                                                      .sample = samples ? part : 0,
                                                      .aspect = RHW_ASPECT_STENCIL};
            assert_int_equal(rhw_texture_read_region(rig.context, texture, &region, read, 0, 0), RHW_OK);
            assert_memory_equal(read, stencil[part], sizeof read);
        }
        if (n >= 2) { // depth has not been touched
            uint32_t depth[18] = {1};
            const struct rhw_texture_region region = {.depth = 1};
            assert_int_equal(rhw_texture_read_region(rig.context, texture, &region, depth, 0, 0), RHW_OK);
            static const uint32_t zero[18];
            assert_memory_equal(depth, zero, sizeof zero);
        }
    }
    rig_close(&rig);
}

static void test_buffers(void **state)
{
    (void)state;
    enum { ROW = 6, HIGH = 4, FIRST = 6, WORDS = 64 }; // FIRST: bytes, at no word
    static const struct rhw_texture_region region = {
        .x = 1, .y = 2, .z = 3, .width = 5, .height = 3, .depth = 2};
    static const struct rhw_texel_layout layout = {.offset = FIRST, .row_length = ROW, .image_height = HIGH};
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture texture = make_numbered(&rig, &volume), copied = make(&rig, &volume);
    const struct rhw_buffer_def def = {.size = 4 * WORDS};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    assert_int_equal(rhw_texture_copy_to_buffer(rig.context, texture, &region, buffer, &layout), RHW_OK);
    void *bytes;
    assert_int_equal(rhw_buffer_map(rig.context, buffer, 0, 0, RHW_MAP_READ, &bytes), RHW_OK);
    for (int i = 0; i < (WORDS * 4 - FIRST) / 4; i++) {
        const int x = i % ROW, y = i / ROW % HIGH, z = i / ROW / HIGH;
        uint32_t word;
        memcpy(&word, (unsigned char *)bytes + FIRST + 4 * i, sizeof word);
        assert_int_equal(word, x < 5 && y < 3 && z < 2 ? number(x + 1, y + 2, z + 3) : 0);
    }
    rhw_buffer_unmap(rig.context, buffer);
    assert_int_equal(rhw_texture_copy_from_buffer(rig.context, copied, &region, buffer, &layout), RHW_OK);
    const uint32_t *const texels = all_texels(&rig, copied);
    for (int i = 0; i < TEXELS; i++) {
        const int x = i % WIDTH, y = i / WIDTH % HEIGHT, z = i / WIDTH / HEIGHT;
        assert_int_equal(texels[i], is_within(&region, x, y, z) ? number(x, y, z) : 0);
    }
    // The last byte of the last row is the last that is needed: 6 + 4 · (6 · (4 + 2) + 5) = 170.
    struct rhw_buffer_def small = {.size = 170};
    rhw_buffer enough, less;
    assert_int_equal(rhw_buffer_create(rig.context, &small, &enough), RHW_OK);
    small.size = 169;
    assert_int_equal(rhw_buffer_create(rig.context, &small, &less), RHW_OK);
    assert_int_equal(rhw_texture_copy_to_buffer(rig.context, texture, &region, enough, &layout), RHW_OK);
    rhw_texture_copy_to_buffer(rig.context, texture, &region, less, &layout);
    rig_expect_misuse(&rig,
                      "rhw_texture_copy_to_buffer: layout.offset is 6 and 5x3x2 texels follow in rows of 6; "
                      "buffer 3 has 169 bytes");
    rhw_texture_copy_from_buffer(rig.context, texture, &region, less, &layout);
    rig_expect_misuse(&rig, "rhw_texture_copy_from_buffer: layout.offset is 6");
    const struct rhw_texel_layout huge = {.row_length = INT32_MAX, .image_height = INT32_MAX};
    rhw_texture_copy_from_buffer(rig.context, texture, NULL, buffer, &huge);
    rig_expect_misuse(&rig, "texels follow in rows of 2147483647");
    rhw_texture_copy_from_buffer(rig.context, texture, &region, buffer,
                                 &(struct rhw_texel_layout){.row_length = 4});
    rig_expect_misuse(&rig, "layout.row_length is 4; the region is 5 wide");
    rhw_texture_copy_from_buffer(rig.context, texture, &region, buffer,
                                 &(struct rhw_texel_layout){.image_height = -1});
    rig_expect_misuse(&rig, "layout.image_height is -1; the region is 3 high");
    rig_close(&rig);
}

// Slices of a volume become layers of an array with another format of the same size, and back within one texture.
static void test_textures(void **state)
{
    (void)state;
    static const struct rhw_texture_region from = {
        .x = 3, .y = 1, .z = 0, .width = 4, .height = 5, .depth = 3};
    static const struct rhw_texture_region to = {.x = 0, .y = 1, .z = 2};
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture source = make_numbered(&rig, &volume), target = make(&rig, &array);
    assert_int_equal(rhw_texture_copy(rig.context, source, &from, target, &to), RHW_OK);
    const uint32_t *texels = all_texels(&rig, target);
    for (int i = 0; i < TEXELS; i++) {
        const int x = i % WIDTH, y = i / WIDTH % HEIGHT, z = i / WIDTH / HEIGHT;
        const bool copied = x < 4 && y >= 1 && z >= 2;
        assert_int_equal(texels[i], copied ? number(x + 3, y, z - 2) : 0);
    }
    // Side by side within one texture.
    const struct rhw_texture_region left = {.width = 4, .depth = 1}, right = {.x = 4, .width = 4};
    assert_int_equal(rhw_texture_copy(rig.context, source, &left, source, &right), RHW_OK);
    texels = all_texels(&rig, source);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const int x = i % WIDTH;
        assert_int_equal(texels[i], number(x >= 4 && x < 8 ? x - 4 : x, i / WIDTH, 0));
    }
    const struct rhw_texture_region over = {.x = 3};
    rhw_texture_copy(rig.context, source, &left, source, &over);
    rig_expect_misuse(&rig, "rhw_texture_copy: the regions overlap in texture 2 \"volume\"");
    rhw_texture_copy(rig.context, source, &from, target, &(struct rhw_texture_region){.width = 3});
    rig_expect_misuse(&rig, "from is 4x5x3 texels and to is 3x0x0; sizes are equal, or 0");
    rhw_texture_copy(rig.context, source, &from, target, &(struct rhw_texture_region){.z = 3});
    rig_expect_misuse(&rig,
                      "to.z is 3 and to.depth is 3; from there level 0 of texture 3 \"array\" has 1..2");
    rig_close(&rig);
}

// All samples, and both planes one after the other.
static void test_samples(void **state)
{
    (void)state;
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_D32_FLOAT_S8_UINT, .width = 5, .height = 4, .samples = 4};
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture a = make(&rig, &def), b = make(&rig, &def);
    float depth[20], read[20];
    uint8_t stencil[20], read_stencil[20];
    for (int sample = 0; sample < 4; sample++) {
        for (int i = 0; i < 20; i++) {
            depth[i] = (float)(i + 20 * sample) / 128;
            stencil[i] = (uint8_t)(3 * i + sample);
        }
        struct rhw_texture_region region = {.sample = sample};
        assert_int_equal(rhw_texture_write_region(rig.context, a, &region, depth, 0, 0), RHW_OK);
        region.aspect = RHW_ASPECT_STENCIL;
        assert_int_equal(rhw_texture_write_region(rig.context, a, &region, stencil, 0, 0), RHW_OK);
    }
    const struct rhw_texture_region plane = {.aspect = RHW_ASPECT_STENCIL},
                                    place = {.x = 1, .aspect = RHW_ASPECT_STENCIL},
                                    part = {.width = 4, .aspect = RHW_ASPECT_STENCIL};
    assert_int_equal(rhw_texture_copy(rig.context, a, NULL, b, NULL), RHW_OK);
    assert_int_equal(rhw_texture_copy(rig.context, a, &part, b, &place), RHW_OK);
    for (int sample = 0; sample < 4; sample++) {
        struct rhw_texture_region region = {.sample = sample};
        assert_int_equal(rhw_texture_read_region(rig.context, b, &region, read, 0, 0), RHW_OK);
        region.aspect = RHW_ASPECT_STENCIL;
        assert_int_equal(rhw_texture_read_region(rig.context, b, &region, read_stencil, 0, 0), RHW_OK);
        for (int i = 0; i < 20; i++) {
            assert_true(read[i] == (float)(i + 20 * sample) / 128);
            assert_int_equal(read_stencil[i], i % 5 == 0 ? 0 : 3 * (i - 1) + sample);
        }
    }
    rhw_texture_copy(rig.context, a, &plane, b, NULL);
    rig_expect_misuse(&rig, "from.aspect and to.aspect differ; stencil is copied to stencil");
    rhw_texture_copy(rig.context, a, &(struct rhw_texture_region){.sample = 1}, b, NULL);
    rig_expect_misuse(&rig, "from.sample is 1; all samples are meant, it must be 0");
    rhw_texture_copy(rig.context, a, NULL, rig.pass.colors[0].texture, NULL);
    rig_expect_misuse(&rig, "to.width is 5");
    rhw_texture_copy(rig.context, a, &(struct rhw_texture_region){.width = 4}, rig.pass.colors[0].texture,
                     NULL);
    rig_expect_misuse(&rig, "formats are equal, or colour with texels of one size, not compressed");
    const struct rhw_texture_def single = {.format = def.format, .width = 5, .height = 4};
    rhw_texture_copy(rig.context, a, NULL, make(&rig, &single), NULL);
    rig_expect_misuse(&rig, "texture 2 has 4 samples and texture 4 has 1; they must be equal");
    rig_close(&rig);
}

// Texels of blocks are copied between textures of one format, and read.
static void test_blocks(void **state)
{
    (void)state;
    const struct rhw_texture_def def = {.format = RHW_FORMAT_BC1_RGBA_UNORM, .width = 8, .height = 4},
                                 plain = {.format = RHW_FORMAT_RGBA8_UNORM, .width = 8, .height = 4};
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture a = make(&rig, &def), b = make(&rig, &def), c = make(&rig, &plain);
    // Colour 0 of the first block is red, of the second green.
    static const unsigned char blocks[16] = {0, 0xf8, 0, 0, 0, 0, 0, 0, 0xe0, 0x07};
    assert_int_equal(rhw_texture_write(rig.context, a, 0, blocks, 0), RHW_OK);
    const struct rhw_texture_region from = {.x = 2, .width = 4, .height = 2}, to = {.x = 4, .y = 2};
    assert_int_equal(rhw_texture_copy(rig.context, a, &from, b, &to), RHW_OK);
    uint32_t texels[32];
    assert_int_equal(rhw_texture_read_region(rig.context, b, NULL, texels, 0, 0), RHW_OK);
    for (int i = 0; i < 32; i++) {
        const int x = i % 8, y = i / 8;
        assert_int_equal(texels[i], y < 2 || x < 4 ? 0 : x < 6 ? 0xff0000ff : 0xff00ff00);
    }
    rhw_texture_copy(rig.context, a, &from, c, &to);
    rig_expect_misuse(&rig, "formats are equal, or colour with texels of one size, not compressed");
    rig_close(&rig);
}

// A block of BC1 whose texels all are red, green or blue.
static const unsigned char colored[3][8] = {{0, 0xf8}, {0xe0, 0x07}, {0x1f, 0}};
static const uint32_t colors[3] = {0xff0000ff, 0xff00ff00, 0xffff0000};

// 10 × 7 texels in two layers: 3 × 2 blocks, of which the last column and row reach out of the level.
static const struct rhw_texture_def blocky = {
    .format = RHW_FORMAT_BC1_RGBA_UNORM, .width = 10, .height = 7, .layers = 2, .label = "blocky"};

static void expect_blocks(const struct rig *rig, rhw_texture texture, const int expected[2][2][3])
{
    uint32_t texels[2][7][10];
    assert_int_equal(rhw_texture_read_region(rig->context, texture, NULL, texels, 0, 0), RHW_OK);
    for (int i = 0; i < 2 * 7 * 10; i++) {
        const int x = i % 10, y = i / 10 % 7, z = i / 70, color = expected[z][y / 4][x / 4];
        assert_int_equal(texels[z][y][x], color < 0 ? 0 : colors[color]);
    }
}

static void test_blocks_are_written_in_parts(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture texture = make(&rig, &blocky);
    // Both layers, the right two columns, the lower row; slices 40 bytes apart.
    unsigned char blocks[56] = {0};
    memcpy(blocks, colored[0], 8);
    memcpy(blocks + 8, colored[1], 8);
    memcpy(blocks + 40, colored[2], 8);
    memcpy(blocks + 48, colored[0], 8);
    const struct rhw_texture_region lower = {.x = 4, .y = 4};
    assert_int_equal(rhw_texture_write_region(rig.context, texture, &lower, blocks, 0, 40), RHW_OK);
    expect_blocks(&rig, texture,
                  (const int[2][2][3]){{{-1, -1, -1}, {-1, 0, 1}}, {{-1, -1, -1}, {-1, 2, 0}}});
    // One block above, whose neighbours stay.
    const struct rhw_texture_region one = {.x = 4, .z = 1, .width = 4, .height = 4, .depth = 1};
    assert_int_equal(rhw_texture_write_region(rig.context, texture, &one, colored[1], 0, 0), RHW_OK);
    expect_blocks(&rig, texture, (const int[2][2][3]){{{-1, -1, -1}, {-1, 0, 1}}, {{-1, 1, -1}, {-1, 2, 0}}});
    // From a buffer: rows of 4 blocks, slices of 3 rows; a column of two layers. The last block ends with the buffer.
    enum { FIRST = 3, ROW = 4 * 8, SLICE = 3 * ROW, BYTES = FIRST + SLICE + ROW + 8 };
    unsigned char bytes[BYTES] = {0};
    for (int i = 0; i < 4; i++) {
        memcpy(bytes + FIRST + i / 2 * SLICE + i % 2 * ROW, colored[i % 3], 8);
    }
    const struct rhw_buffer_def def = {.data = bytes, .size = BYTES};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig.context, &def, &buffer), RHW_OK);
    const struct rhw_texture_region column = {.width = 4};
    struct rhw_texel_layout layout = {.offset = FIRST, .row_length = 16, .image_height = 12};
    assert_int_equal(rhw_texture_copy_from_buffer(rig.context, texture, &column, buffer, &layout), RHW_OK);
    expect_blocks(&rig, texture, (const int[2][2][3]){{{0, -1, -1}, {1, 0, 1}}, {{2, 1, -1}, {0, 2, 0}}});
    layout.offset++;
    rhw_texture_copy_from_buffer(rig.context, texture, &column, buffer, &layout);
    rig_expect_misuse(&rig,
                      "layout.offset is 4 and 4x7x2 texels follow in rows of 16; buffer 1 has 139 bytes");
    layout.offset = 0;
    layout.row_length = 18;
    rhw_texture_copy_from_buffer(rig.context, texture, &column, buffer, &layout);
    rig_expect_misuse(&rig, "layout.row_length is 18; it must be a multiple of the 4 texels of a block");
    layout.row_length = 0;
    layout.image_height = 7;
    rhw_texture_copy_from_buffer(rig.context, texture, &column, buffer, &layout);
    rig_expect_misuse(&rig, "layout.image_height is 7; it must be a multiple of the 4 texels of a block");
    rig_close(&rig);
}

static void test_parts_are_of_whole_blocks(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture texture = make(&rig, &blocky);
    static const struct {
        struct rhw_texture_region region;
        const char *message;
    } wrong[] = {
        {{.x = 2}, "region.x is 2; blocks of RHW_FORMAT_BC1_RGBA_UNORM are 4 texels apart"},
        {{.y = 5}, "region.y is 5; blocks of RHW_FORMAT_BC1_RGBA_UNORM are 4 texels apart"},
        {{.width = 6}, "region.width is 6; it must be a multiple of the 4 texels of a block of"},
        {{.height = 3}, "region.height is 3; it must be a multiple of the 4 texels of a block of"},
    };
    const unsigned char blocks[2 * 3 * 2 * 8] = {0};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(rhw_texture_write_region(rig.context, texture, &wrong[i].region, blocks, 0, 0),
                         RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, wrong[i].message);
    }
    rhw_texture_write_region(rig.context, texture, NULL, blocks, 23, 0);
    rig_expect_misuse(&rig, "row_pitch is 23; a row of the region has 24 bytes");
    rhw_texture_write_region(rig.context, texture, NULL, blocks, 24, 47);
    rig_expect_misuse(&rig, "slice_pitch is 47; a slice of the region has 48 bytes");
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 4, 4);
    const rhw_texture texture = make(&rig, &volume);
    uint32_t word = 0;
    static const struct {
        struct rhw_texture_region region;
        const char *message;
    } wrong[] = {
        {{.level = 1}, "level is 1; texture 2 \"volume\" has levels 0..0"},
        {{.x = 9}, "region.x is 9; level 0 of texture 2 \"volume\" has 0..8"},
        {{.y = -1}, "region.y is -1; level 0 of texture 2 \"volume\" has 0..5"},
        {{.z = 5}, "region.z is 5; level 0 of texture 2 \"volume\" has 0..4"},
        {{.x = 8, .width = 2},
         "region.x is 8 and region.width is 2; from there level 0 of texture 2 \"volume\" has 1..1"},
        {{.height = -3}, "region.height is -3"},
        {{.z = 1, .depth = INT32_MAX}, "region.depth is 2147483647"},
        {{.sample = 1}, "region.sample is 1; texture 2 \"volume\" has samples 0..0"},
        {{.aspect = RHW_ASPECT_STENCIL}, "is RHW_FORMAT_R32_UINT; that has no stencil"},
        {{.aspect = (enum rhw_aspect)5}, "region.aspect is 5; not an aspect"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(rhw_texture_read_region(rig.context, texture, &wrong[i].region, &word, 0, 0),
                         RHW_ERROR_MISUSE);
        rig_expect_misuse(&rig, wrong[i].message);
    }
    rhw_texture_write_region(rig.context, texture, NULL, NULL, 0, 0);
    rig_expect_misuse(&rig, "rhw_texture_write_region: data is NULL");
    rhw_texture_read_region(rig.context, texture, NULL, &word, 35, 0);
    rig_expect_misuse(&rig, "row_pitch is 35; a row of the region has 36 bytes");
    rhw_texture_read_region(rig.context, texture, NULL, &word, 40, 40 * 5 + 35);
    rig_expect_misuse(&rig, "slice_pitch is 235; a slice of the region has 236 bytes");
    // The last row of a slice has no gap behind it, so the next slice may begin there.
    unsigned char all[5 * 236];
    assert_int_equal(rhw_texture_read_region(rig.context, texture, NULL, all, 40, 236), RHW_OK);
    rhw_texture_read_region(rig.context, texture, NULL, &word, SIZE_MAX, 0);
    rig_expect_misuse(&rig, "such rows have no place in memory");
    rig_begin(&rig);
    const float color[4] = {0};
    rhw_texture_write_region(rig.context, rig.pass.colors[0].texture,
                             &(struct rhw_texture_region){.width = 1, .height = 1}, color, 0, 0);
    rig_expect_misuse(&rig, "is an attachment of the pass being recorded; end that first");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_write_and_read),
    cmocka_unit_test(test_levels),
    cmocka_unit_test(test_stencil),
    cmocka_unit_test(test_buffers),
    cmocka_unit_test(test_textures),
    cmocka_unit_test(test_samples),
    cmocka_unit_test(test_blocks),
    cmocka_unit_test(test_blocks_are_written_in_parts),
    cmocka_unit_test(test_parts_are_of_whole_blocks),
    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_region_copy = UNIT_TESTS(tests, NULL, NULL);
