// SPDX-License-Identifier: MIT
// Textures of compressed formats: their table, levels that end within a block, sampling, and what is misuse. Hashes of
// random blocks keep what blocks_peer found equal to a second implementation; test_block_decoders has single blocks.
#include "decoded_block.h"

#include <stdlib.h>
#include <string.h>

#include "format/format.h"
#include "random_block.h"

static void test_tables_say_what_blocks_are(void **state)
{
    (void)state;
    const struct {
        enum rhw_format format;
        int width, height, bytes;
        enum rhw_format decoded;
    } rows[] = {
        {RHW_FORMAT_NONE, 0, 0, 0, RHW_FORMAT_NONE},
        {RHW_FORMAT_COUNT, 0, 0, 0, RHW_FORMAT_NONE},
        {RHW_FORMAT_RGBA16_FLOAT, 1, 1, 8, RHW_FORMAT_RGBA16_FLOAT},
        {RHW_FORMAT_BC1_RGB_UNORM, 4, 4, 8, RHW_FORMAT_RGBA8_UNORM},
        {RHW_FORMAT_BC3_SRGB, 4, 4, 16, RHW_FORMAT_RGBA8_SRGB},
        {RHW_FORMAT_BC4_SNORM, 4, 4, 8, RHW_FORMAT_R32_FLOAT},
        {RHW_FORMAT_BC6H_UFLOAT, 4, 4, 16, RHW_FORMAT_RGBA16_FLOAT},
        {RHW_FORMAT_ETC2_RGB8A1_SRGB, 4, 4, 8, RHW_FORMAT_RGBA8_SRGB},
        {RHW_FORMAT_EAC_RG11_UNORM, 4, 4, 16, RHW_FORMAT_RGBA32_FLOAT},
        {RHW_FORMAT_ASTC_4X4_UNORM, 4, 4, 16, RHW_FORMAT_RGBA8_UNORM},
        {RHW_FORMAT_ASTC_10X6_SRGB, 10, 6, 16, RHW_FORMAT_RGBA8_SRGB},
        {RHW_FORMAT_ASTC_12X12_SRGB, 12, 12, 16, RHW_FORMAT_RGBA8_SRGB},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_int_equal(rhw_format_block_width(rows[i].format), rows[i].width);
        assert_int_equal(rhw_format_block_height(rows[i].format), rows[i].height);
        assert_int_equal(rhw_format_block_bytes(rows[i].format), rows[i].bytes);
        assert_int_equal(rhw_format_decoded(rows[i].format), rows[i].decoded);
    }
    for (int format = RHW_PLAIN_FORMAT_COUNT; format < RHW_FORMAT_COUNT; format++) {
        assert_int_equal(rhw_format_size((enum rhw_format)format), 0);
        assert_int_equal(rhw_format_info((enum rhw_format)format)->roles, 0);
        assert_int_equal(strncmp(rhw_format_info((enum rhw_format)format)->name, "RHW_FORMAT_", 11), 0);
    }
}

// Levels that end within a block: all their texels are written, from blocks of their own.
static void test_levels_may_end_within_a_block(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    enum { WIDTH = 13, HEIGHT = 6, LEVELS = 4 };
    for (int f = RHW_PLAIN_FORMAT_COUNT; f < RHW_FORMAT_COUNT; f++) {
        const enum rhw_format format = (enum rhw_format)f;
        const size_t size = rhw_format_size(rhw_format_decoded(format)),
                     bytes = rhw_format_block_bytes(format);
        const rhw_texture texture = make_texture(&rig, format, WIDTH, HEIGHT, LEVELS);
        assert_int_equal(rhw_texture_format(rig.context, texture), format);
        uint64_t state_of_random = (uint64_t)f;
        for (int level = 0; level < LEVELS; level++) {
            const int width = WIDTH >> level, height = HEIGHT >> level > 1 ? HEIGHT >> level : 1;
            const int block_width = rhw_format_block_width(format),
                      block_height = rhw_format_block_height(format);
            const int columns = (width + block_width - 1) / block_width,
                      rows = (height + block_height - 1) / block_height;
            // Exactly as many bytes as are read, so that the address sanitizer sees one more.
            const size_t pitch = (size_t)columns * bytes + 5;
            unsigned char *const blocks = malloc((size_t)(rows - 1) * pitch + (size_t)columns * bytes);
            for (int i = 0; i < rows * columns; i++) {
                random_block(format, &state_of_random,
                             blocks + (size_t)(i / columns) * pitch + (size_t)(i % columns) * bytes);
            }
            assert_int_equal(rhw_texture_write(rig.context, texture, level, blocks, pitch), RHW_OK);
            unsigned char texels[WIDTH * HEIGHT * 16];
            assert_int_equal(rhw_texture_read(rig.context, texture, level, texels, 0), RHW_OK);
            for (int i = 0; i < width * height; i++) {
                const int x = i % width, y = i / width;
                const unsigned char *const block =
                    blocks + (size_t)(y / block_height) * pitch + (size_t)(x / block_width) * bytes;
                const unsigned char *const alone = decode(&rig, format, block);
                const int at = y % block_height * block_width + x % block_width;
                assert_memory_equal(texels + size * (size_t)i, alone + size * (size_t)at, size);
            }
            free(blocks);
        }
        rhw_texture_destroy(rig.context, texture);
    }
    rig_close(&rig);
}

static void sample_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        rhw_sample_lod(groups[g].textures, 0, groups[g].varying, rhw_splat(0), groups[g].color[0]);
    }
}

// A target that the texture was drawn into, magnified and filtered.
static uint64_t draw_hash(struct rig *rig, rhw_texture texture)
{
    const struct rhw_sampler_def def = rhw_sampler_def_default();
    rhw_sampler sampler;
    assert_int_equal(rhw_sampler_create(rig->context, &def, &sampler), RHW_OK);
    struct rig_vertex all[6];
    rig_cover(rig, 0.5f, (const float[4]){0, 0, 0, 0}, all);
    for (int i = 0; i < 6; i++) {
        all[i].value[0] = all[i].position[0];
        all[i].value[1] = all[i].position[1];
    }
    rig_begin(rig);
    rhw_pass_set_texture(rig->context, rig->recording, 0, texture, sampler);
    rig_draw(rig, all, 6);
    rig_end(rig);
    rhw_sampler_destroy(rig->context, sampler);
    return rig_hash(rig, 0);
}

// Sampling sees the decoded texels, whatever they came from.
static void test_blocks_are_sampled_as_their_texels(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 40, 40);
    rig_set_program(&rig, rig_vertex_pass, sample_fragment);
    enum { SIDE = 24 };
    for (int f = RHW_PLAIN_FORMAT_COUNT; f < RHW_FORMAT_COUNT; f++) {
        const enum rhw_format format = (enum rhw_format)f, decoded = rhw_format_decoded(format);
        unsigned char blocks[36 * 16], texels[SIDE * SIDE * 16];
        uint64_t random = 5;
        for (int i = 0; i < 36; i++) {
            random_block(format, &random, blocks + (size_t)i * rhw_format_block_bytes(format));
        }
        const rhw_texture texture = make_texture(&rig, format, SIDE, SIDE, 1);
        const rhw_texture plain = make_texture(&rig, decoded, SIDE, SIDE, 1);
        const uint64_t empty = draw_hash(&rig, texture);
        rhw_texture_write(rig.context, texture, 0, blocks, 0);
        rhw_texture_read(rig.context, texture, 0, texels, 0);
        rhw_texture_write(rig.context, plain, 0, texels, 0);
        const uint64_t hash = draw_hash(&rig, texture);
        assert_int_not_equal(hash, empty);
        assert_int_equal(hash, draw_hash(&rig, plain));
        rhw_texture_destroy(rig.context, texture);
        rhw_texture_destroy(rig.context, plain);
    }
    rig_close(&rig);
}

static void test_misuse_is_named(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    const rhw_texture texture = make_texture(&rig, RHW_FORMAT_BC3_UNORM, 8, 8, 2);
    const unsigned char blocks[64] = {0};
    rhw_texture_write(rig.context, texture, 0, blocks, 31);
    rig_expect_misuse(&rig, "row_pitch is 31; a row of blocks of level 0 of");
    unsigned char texels[8 * 8 * 4];
    rhw_texture_read(rig.context, texture, 0, texels, 31);
    rig_expect_misuse(&rig, "row_pitch is 31; a row of level 0 of");
    assert_int_equal(rhw_texture_generate_mips(rig.context, texture), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "is RHW_FORMAT_BC3_UNORM; levels of compressed formats are written");
    rhw_texture_destroy(rig.context, rig.pass.colors[0].texture);
    rig.pass.colors[0].texture = texture;
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "which is RHW_FORMAT_BC3_UNORM; that is no colour target");
    rig.pipeline.targets[0].format = RHW_FORMAT_ASTC_8X8_SRGB;
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "RHW_FORMAT_ASTC_8X8_SRGB");
    rig_close(&rig);
}

// FNV-1a of the texels of 8192 random blocks, in the order of the formats. blocks_peer compares the same blocks.
static const uint64_t hashes[] = {
    0x1b9b985f7f0564c6, 0x372ab85dd0eb8208, 0x31dcd3394e6d8c0e, 0x7a3feb3670fa1820, 0xe43fc05a8b30e2a6,
    0xe096667917841e86, 0xf2aa716f3ac2204e, 0x6856e0b1cabba4ee, 0x8f432adee2fe48f1, 0x1ba534a56aa4b13d,
    0xf7da5849e2d24e30, 0x4da03c5b52c5a378, 0xcad9b32c796b6d1a, 0x1a65ee7c1eacc9d1, 0xb6ad6248d63042b0,
    0x2df2f167b87dbe26, 0x94e48e7777916934, 0xd475542690385ce0, 0x73138527d4827e2b, 0x3cbc481d7de1ee0c,
    0x2e58c939315833e9, 0xc0d70ea0929b61dd, 0xc159c895de64ae7a, 0xc5da3c6753a0fd40, 0x97ae54e736f558dd,
    0x9a4356a7c31a8c0d, 0x15b8775751dbd75e, 0x2cb2da179573997a, 0x51fa31b49abcda16, 0x85eb180bc62b9d18,
    0x166d48252c41938e, 0x60a22dbf9dc36624, 0x9924e9f143cf69ea, 0x7773b13e47b89b4d, 0xce96393e401a37fc,
    0x4f4b4da1d3c60e46, 0x3fa418f1f22e39ff, 0x26d9f6c05db422ea, 0x20664dd41c948a40, 0x3c22828e6cf18916,
    0xe01f7b9f1394e400, 0xc8372597ab72c40c, 0x0d6696bbe0ede539, 0xcddb48f6953e8f5d, 0xd92b498208f46ab2,
    0xabdf32c2116630ad, 0xafabce4ffe123813, 0x424dcaa73d3e0e57, 0x598fe7865bc2e33b, 0xb466e761285dfcd3,
    0x1df760de43ff4fe6, 0xa2028dc9368988ca, 0x23c52d24d5506bc9, 0x7612074bbebc4800,
};

_Static_assert(sizeof hashes / sizeof hashes[0] == RHW_FORMAT_COUNT - RHW_PLAIN_FORMAT_COUNT, "all formats");

static uint64_t hash_of(enum rhw_format format, int threads)
{
    enum { BLOCKS = 64 };
    struct rig rig;
    const struct rhw_context_def def = {.threads = threads};
    rig_open_with(&rig, 8, 8, &def);
    const int width = BLOCKS * rhw_format_block_width(format),
              height = BLOCKS * rhw_format_block_height(format);
    const size_t bytes = rhw_format_block_bytes(format);
    const size_t size = rhw_format_size(rhw_format_decoded(format)) * (size_t)width * (size_t)height;
    unsigned char *const blocks = malloc(BLOCKS * BLOCKS * bytes), *const texels = malloc(size);
    const rhw_texture texture = make_texture(&rig, format, width, height, 1);
    uint64_t random = (uint64_t)(format - RHW_PLAIN_FORMAT_COUNT), hash = UINT64_C(0xcbf29ce484222325);
    for (int round = 0; round < 2; round++) {
        for (size_t at = 0; at < BLOCKS * BLOCKS * bytes; at += bytes) {
            random_block(format, &random, blocks + at);
        }
        assert_int_equal(rhw_texture_write(rig.context, texture, 0, blocks, 0), RHW_OK);
        assert_int_equal(rhw_texture_read(rig.context, texture, 0, texels, 0), RHW_OK);
        hash = rig_hash_bytes(hash, texels, size);
    }
    free(blocks);
    free(texels);
    rig_close(&rig);
    return hash;
}

static void test_random_blocks_keep_their_texels(void **state)
{
    (void)state;
    bool same = true;
    for (int i = 0; i < RHW_FORMAT_COUNT - RHW_PLAIN_FORMAT_COUNT; i++) {
        const enum rhw_format format = (enum rhw_format)(RHW_PLAIN_FORMAT_COUNT + i);
        const uint64_t hash = hash_of(format, 1 + i % 4);
        if (hash != hashes[i]) {
            print_message("%s: 0x%016llx\n", rhw_format_info(format)->name, (unsigned long long)hash);
            same = false;
        }
    }
    assert_true(same);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_tables_say_what_blocks_are),
    cmocka_unit_test(test_levels_may_end_within_a_block),
    cmocka_unit_test(test_blocks_are_sampled_as_their_texels),
    cmocka_unit_test(test_misuse_is_named),
    cmocka_unit_test(test_random_blocks_keep_their_texels),
};

const struct unit_tests test_block_formats = UNIT_TESTS(tests, NULL, NULL);
