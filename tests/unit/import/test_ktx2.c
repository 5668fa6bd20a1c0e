// SPDX-License-Identifier: MIT
// KTX2 files: Basis Universal's two formats, whose hashes are of what its own transcoder makes of the same files,
// Vulkan's formats, and files that are damaged.
#include "decoded_block.h"
#include "import/image/read.h"
#include "ktx2_samples.h"
#include "model_files.h"
#include "random_block.h"
#include "reference.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zstd.h>

enum { R8G8B8 = 23, MODEL_PLAIN = 1, MODEL_ETC1S = 163, MODEL_UASTC = 166, MOST_BYTES = 1 << 17 };

static uint64_t hash_of(const struct scene_image *image)
{
    return rig_hash_bytes(UINT64_C(0xcbf29ce484222325), image->texels, image->size);
}

static struct scene_image decode_file(const void *bytes, size_t size)
{
    struct scene_image image = {.width = 0};
    const char *const problem = scene_image_decode(bytes, size, &image);
    if (problem != NULL) {
        fail_msg("%s", problem);
    }
    return image;
}

static void assert_refused(const void *bytes, size_t size, const char *problem)
{
    struct scene_image image = {.width = 77};
    assert_string_equal(scene_image_decode(bytes, size, &image), problem);
    assert_int_equal(image.width, 77);
    assert_null(image.texels);
}

// Making files -------------------------------------------------------------------------------------------

struct ktx2_def {
    uint32_t format, width, height;
    uint32_t scheme;        // 2: packed by Zstandard here
    uint8_t model, channel; // of the descriptor
    const char *swizzle;
    const void *texels;
    size_t size;
    const void *global; // data of BasisLZ
    size_t global_size;
};

struct ktx2_file {
    uint8_t bytes[MOST_BYTES];
    size_t size;
};

static void put(struct ktx2_file *file, uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        file->bytes[file->size++] = (uint8_t)(i < 8 ? value >> 8 * i : 0);
    }
}

static void put_header(struct ktx2_file *file, const struct ktx2_def *def, size_t pairs, size_t level_size)
{
    static const uint8_t identifier[12] = {0xab, 'K', 'T', 'X', ' ', '2', '0', 0xbb, '\r', '\n', 0x1a, '\n'};
    const uint32_t numbers[13] = {def->format, 1,  def->width, def->height,    0, 0, 1, 1, def->scheme,
                                  104,         44, 148,        (uint32_t)pairs};
    memcpy(file->bytes, identifier, sizeof identifier);
    file->size = sizeof identifier;
    for (int i = 0; i < 13; i++) {
        put(file, numbers[i], 4);
    }
    put(file, 148 + pairs + level_size, 8);
    put(file, def->global_size, 8);
    put(file, 148 + pairs, 8);
    put(file, level_size, 8);
    put(file, def->size, 8);
}

// One level, a descriptor with one sample, and perhaps KTXswizzle.
static const struct ktx2_file *make_file(const struct ktx2_def *def)
{
    static struct ktx2_file file;
    static uint8_t packed[MOST_BYTES];
    memcpy(packed, def->texels, def->size);
    const size_t level_size =
        def->scheme == 2 ? ZSTD_compress(packed, sizeof packed, def->texels, def->size, 1) : def->size;
    const size_t pairs = def->swizzle != NULL ? 20 : 0;
    put_header(&file, def, pairs, level_size);
    put(&file, 44, 4);
    put(&file, 0, 4);
    put(&file, 2 | 40 << 16, 4);
    put(&file, def->model, 4);
    put(&file, 0, 12);
    put(&file, (uint64_t)def->channel << 24, 8);
    put(&file, 0, 8);
    if (pairs > 0) {
        put(&file, 16, 4);
        memcpy(file.bytes + file.size, "KTXswizzle", 11);
        memcpy(file.bytes + file.size + 11, def->swizzle, 5);
        file.size += 16;
    }
    memcpy(file.bytes + file.size, packed, level_size);
    file.size += level_size;
    if (def->global_size > 0) {
        memcpy(file.bytes + file.size, def->global, def->global_size);
        file.size += def->global_size;
    }
    return &file;
}

static struct scene_image decode_def(const struct ktx2_def *def)
{
    const struct ktx2_file *const file = make_file(def);
    return decode_file(file->bytes, file->size);
}

// ETC1S --------------------------------------------------------------------------------------------------

static void test_etc1s(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof ktx2_samples / sizeof ktx2_samples[0]; i++) {
        const struct ktx2_sample *const sample = &ktx2_samples[i];
        uint8_t bytes[2048];
        struct scene_image image = decode_file(bytes, read_base64(sample->base64, bytes));
        assert_int_equal(image.width, sample->width);
        assert_int_equal(image.height, sample->height);
        assert_int_equal(image.type, SCENE_IMAGE_RGBA8);
        assert_int_equal(image.has_alpha, sample->has_alpha);
        assert_int_equal(hash_of(&image), sample->hash);
        free(image.texels);
    }
}

struct bit_writer {
    uint8_t bytes[512];
    size_t count; // of bits
};

static void put_bits(struct bit_writer *writer, uint32_t value, int count)
{
    for (int i = 0; i < count; i++, writer->count++) {
        writer->bytes[writer->count / 8] |= (uint8_t)((value >> i & 1) << writer->count % 8);
    }
}

static size_t end_bytes(struct bit_writer *writer)
{
    writer->count = (writer->count + 7) / 8 * 8;
    return writer->count / 8;
}

// A code of one symbol, a bit that is 0. The lengths of all symbols up to it have a code of the two lengths 0 and 1.
static void put_code(struct bit_writer *writer, uint32_t symbol)
{
    put_bits(writer, symbol + 1, 14);
    put_bits(writer, 19, 5);
    for (int i = 0; i < 19; i++) {
        put_bits(writer, i == 4 || i == 18, 3); // where 0 and 1 stand
    }
    for (uint32_t i = 0; i < symbol; i++) {
        put_bits(writer, 0, 1);
    }
    put_bits(writer, 1, 1);
}

// One block of one grey: an endpoint whose differences are 0, a selector of the darkest step. `prediction` says where the
// endpoint of the block comes from.
static const struct ktx2_file *make_etc1s(uint32_t prediction)
{
    struct bit_writer writer = {.count = 0};
    put_bits(&writer, 1 | 1 << 16, 32);
    put_bits(&writer, 0, 32); // the sizes, below
    put_bits(&writer, 0, 32);
    put_bits(&writer, 0, 32);
    put_bits(&writer, 0, 32);
    const uint32_t slices[5] = {0, 0, 1, 0, 0};
    for (int i = 0; i < 5; i++) {
        put_bits(&writer, slices[i], 32);
    }
    const size_t begin = end_bytes(&writer);
    for (int i = 0; i < 4; i++) {
        put_code(&writer, 0);
    }
    put_bits(&writer, 1, 1); // grey
    put_bits(&writer, 0, 2);
    const size_t selectors = end_bytes(&writer);
    put_bits(&writer, 4, 3); // as they are
    put_bits(&writer, 0, 32);
    const size_t tables = end_bytes(&writer);
    put_code(&writer, 0xfc | prediction);
    for (int i = 0; i < 3; i++) {
        put_code(&writer, 0);
    }
    put_bits(&writer, 0, 13);
    const size_t end = end_bytes(&writer);
    writer.bytes[4] = (uint8_t)(selectors - begin);
    writer.bytes[8] = (uint8_t)(tables - selectors);
    writer.bytes[12] = (uint8_t)(end - tables);
    const uint8_t slice = 0;
    return make_file(&(struct ktx2_def){.width = 4,
                                        .height = 4,
                                        .scheme = 1,
                                        .model = MODEL_ETC1S,
                                        .texels = &slice,
                                        .size = 1,
                                        .global = writer.bytes,
                                        .global_size = end});
}

static void test_etc1s_by_hand(void **state)
{
    (void)state;
    const struct ktx2_file *file = make_etc1s(3);
    struct scene_image image = decode_file(file->bytes, file->size);
    const uint8_t grey[4] = {16 * 8 + 4 - 8, 124, 124, 255};
    for (int i = 0; i < 16; i++) {
        assert_memory_equal((const uint8_t *)image.texels + 4 * i, grey, 4);
    }
    free(image.texels);
    for (uint32_t prediction = 0; prediction < 3; prediction++) { // from blocks beside the image
        file = make_etc1s(prediction);
        assert_refused(file->bytes, file->size, "damaged KTX2: its ETC1S data");
    }
}

// The descriptor of the first sample says that its second slice is green.
static void test_etc1s_of_two_channels(void **state)
{
    (void)state;
    uint8_t bytes[2048];
    const size_t size = read_base64(ktx2_samples[0].base64, bytes);
    struct scene_image plain = decode_file(bytes, size);
    uint32_t descriptor;
    memcpy(&descriptor, bytes + 48, 4);
    bytes[descriptor + 28 + 3] = 3;
    bytes[descriptor + 44 + 3] = 4;
    struct scene_image two = decode_file(bytes, size);
    for (size_t i = 0; i < (size_t)two.width * two.height; i++) {
        const uint8_t *const texel = (const uint8_t *)plain.texels + 4 * i;
        const uint8_t expected[4] = {texel[0], texel[3], 0, 255};
        assert_memory_equal((const uint8_t *)two.texels + 4 * i, expected, 4);
    }
    free(plain.texels);
    free(two.texels);
}

// UASTC --------------------------------------------------------------------------------------------------

enum { UASTC_MODES = 19, SIDE = 64 /* blocks */ };

static void set_bits(uint8_t *block, int at, int count, uint32_t value)
{
    for (int i = 0; i < count; i++) {
        const uint8_t bit = (uint8_t)(1u << (at + i) % 8);
        uint8_t *const byte = &block[(at + i) / 8];
        *byte = (uint8_t)(value >> i & 1 ? *byte | bit : *byte & ~bit);
    }
}

// Prefix of each mode and its length, bits up to the pattern of subsets, bits and number of patterns.
static const struct {
    uint8_t prefix, length, pattern_at, pattern_bits, patterns;
} modes[UASTC_MODES] = {
    {0x01, 4, 0, 0, 0},   {0x35, 6, 0, 0, 0},   {0x1d, 5, 20, 5, 30}, {0x03, 5, 20, 4, 11},
    {0x13, 5, 20, 5, 30}, {0x0b, 5, 0, 0, 0},   {0x1b, 5, 0, 0, 0},   {0x07, 5, 20, 5, 19},
    {0x17, 5, 0, 0, 0},   {0x0f, 5, 28, 5, 30}, {0x02, 3, 0, 0, 0},   {0x00, 2, 0, 0, 0},
    {0x06, 3, 0, 0, 0},   {0x1f, 5, 0, 0, 0},   {0x0d, 5, 0, 0, 0},   {0x05, 7, 0, 0, 0},
    {0x15, 6, 29, 5, 30}, {0x25, 6, 0, 0, 0},   {0x09, 4, 0, 0, 0},
};

static void random_uastc(int mode, uint64_t *random, uint8_t block[16])
{
    const uint64_t words[2] = {random_word(random), random_word(random)};
    memcpy(block, words, sizeof words);
    set_bits(block, 0, modes[mode].length, modes[mode].prefix);
    if (modes[mode].patterns > 0) {
        const uint32_t pattern = (uint32_t)(random_word(random) % modes[mode].patterns);
        set_bits(block, modes[mode].pattern_at, modes[mode].pattern_bits, pattern);
    }
}

// FNV-1a of the RGBA8 texels that Basis Universal's transcoder makes of these 4096 random blocks of each mode.
static const uint64_t uastc_hashes[UASTC_MODES] = {
    0x9d5343d4cf01ddff, 0x0ab9f10c02b34cd8, 0x6bb83c27c3d4d3ce, 0x750a477ddf42c1ea, 0x14d24673965b4aad,
    0x88e96992be37abf1, 0x67c177f7dcfad245, 0xab307daffa2f72a7, 0xd29231d53e88c345, 0xee068b1d0d189291,
    0x3c4667ff49e29c4d, 0xc93fa477d8f0172e, 0xdee4cd45a125c2d7, 0x0f74bef5cb97ea30, 0x89e26e8217075bdc,
    0xe0d493c98d988f87, 0xa6647894b40d8409, 0x68105b1df18b0223, 0x1e89902afd9242d1,
};

static void test_uastc_modes(void **state)
{
    (void)state;
    static uint8_t blocks[SIDE * SIDE][16];
    for (int mode = 0; mode < UASTC_MODES; mode++) {
        uint64_t random = (uint64_t)mode;
        for (int i = 0; i < SIDE * SIDE; i++) {
            random_uastc(mode, &random, blocks[i]);
        }
        struct ktx2_def def = {.width = 4 * SIDE,
                               .height = 4 * SIDE,
                               .model = MODEL_UASTC,
                               .channel = 3,
                               .texels = blocks,
                               .size = sizeof blocks};
        struct scene_image image = decode_def(&def);
        if (hash_of(&image) != uastc_hashes[mode]) {
            fail_msg("mode %d: 0x%016llx", mode, (unsigned long long)hash_of(&image));
        }
        free(image.texels);
        if (mode == 3) { // as well packed, and cut at the right and below
            def.scheme = 2;
            def.width -= 3;
            def.height -= 2;
            struct scene_image cut = decode_def(&def);
            assert_int_equal(cut.size, 4u * (4 * SIDE - 3) * (4 * SIDE - 2));
            free(cut.texels);
        }
    }
}

// One block alone.
static void decode_uastc(const uint8_t block[16], uint8_t channel, uint32_t width, uint32_t height,
                         uint8_t *texels)
{
    const struct ktx2_def def = {.width = width,
                                 .height = height,
                                 .model = MODEL_UASTC,
                                 .channel = channel,
                                 .texels = block,
                                 .size = 16};
    struct scene_image image = decode_def(&def);
    memcpy(texels, image.texels, image.size);
    free(image.texels);
}

static void test_uastc_by_hand(void **state)
{
    (void)state;
    uint8_t block[16] = {0}, texels[16][4];
    const uint8_t color[4] = {1, 20, 200, 77};
    set_bits(block, 0, 5, 0x17);
    for (int c = 0; c < 4; c++) {
        set_bits(block, 5 + 8 * c, 8, color[c]);
    }
    decode_uastc(block, 3, 4, 4, texels[0]);
    for (int i = 0; i < 16; i++) {
        assert_memory_equal(texels[i], color, 4);
    }
    decode_uastc(block, 5, 1, 1, texels[0]); // red, and green in alpha
    const uint8_t two[4] = {1, 77, 0, 255};
    assert_memory_equal(texels[0], two, 4);
    decode_uastc(block, 6, 1, 1, texels[0]);
    const uint8_t plain[4] = {1, 20, 0, 255};
    assert_memory_equal(texels[0], plain, 4);
    // Mode 18: endpoints of 5 bits behind 19 bits, weights of 5, the first of 4. Red from 0 to 255.
    memset(block, 0, sizeof block);
    set_bits(block, 0, 4, 0x09);
    set_bits(block, 24, 5, 31);
    set_bits(block, 49, 4, 15);
    set_bits(block, 53, 5, 16);
    set_bits(block, 58, 5, 31);
    decode_uastc(block, 0, 3, 1, texels[0]);
    const uint8_t reds[3][4] = {
        {120, 0, 0, 255}, {135, 0, 0, 255}, {255, 0, 0, 255}}; // 30, 34 and 64 parts of 64
    assert_memory_equal(texels, reds, sizeof reds);
}

static void test_uastc_errors(void **state)
{
    (void)state;
    static const uint8_t magenta[4] = {255, 0, 255, 255};
    uint8_t block[16] = {0}, texels[16][4];
    set_bits(block, 0, 7, 0x45); // the reserved mode
    decode_uastc(block, 3, 4, 4, texels[0]);
    assert_memory_equal(texels[15], magenta, 4);
    for (int mode = 0; mode < UASTC_MODES; mode++) {
        if (modes[mode].patterns > 0) {
            memset(block, 0, sizeof block);
            set_bits(block, 0, modes[mode].length, modes[mode].prefix);
            set_bits(block, modes[mode].pattern_at, modes[mode].pattern_bits, modes[mode].patterns);
            decode_uastc(block, 3, 4, 4, texels[0]);
            assert_memory_equal(texels[15], magenta, 4);
        }
    }
}

// Vulkan's formats ---------------------------------------------------------------------------------------

// Two texels of a plain format and what they become.
static void test_plain_formats(void **state)
{
    (void)state;
    static const struct {
        uint32_t format;
        enum scene_image_type type;
        size_t size;
        uint16_t texels[8]; // bytes of a plain format, two by two
        uint16_t expected[8];
    } cases[] = {
        {9, SCENE_IMAGE_RGBA8, 2, {0xff05}, {0x0005, 0xff00, 0x00ff, 0xff00}},
        {15, SCENE_IMAGE_RGBA8, 2, {0xfe05}, {0x0005, 0xff00, 0x00fe, 0xff00}},
        {16, SCENE_IMAGE_RGBA8, 4, {0x0201, 0x0403}, {0x0201, 0xff00, 0x0403, 0xff00}},
        {22, SCENE_IMAGE_RGBA8, 4, {0x0201, 0x0403}, {0x0201, 0xff00, 0x0403, 0xff00}},
        {R8G8B8, SCENE_IMAGE_RGBA8, 6, {0x0201, 0x0403, 0x0605}, {0x0201, 0xff03, 0x0504, 0xff06}},
        {29, SCENE_IMAGE_RGBA8, 6, {0x0201, 0x0403, 0x0605}, {0x0201, 0xff03, 0x0504, 0xff06}},
        {37, SCENE_IMAGE_RGBA8, 8, {0x0201, 0x0403, 0x0605, 0x0807}, {0x0201, 0x0403, 0x0605, 0x0807}},
        {43, SCENE_IMAGE_RGBA8, 8, {0x0201, 0x0403, 0x0605, 0x0807}, {0x0201, 0x0403, 0x0605, 0x0807}},
        {44, SCENE_IMAGE_RGBA8, 8, {0x0201, 0x0403, 0x0605, 0x0807}, {0x0203, 0x0401, 0x0607, 0x0805}},
        {50, SCENE_IMAGE_RGBA8, 8, {0x0201, 0x0403, 0x0605, 0x0807}, {0x0203, 0x0401, 0x0607, 0x0805}},
        {70, SCENE_IMAGE_RGBA16, 4, {7, 60000}, {7, 0, 0, 65535, 60000, 0, 0, 65535}},
        {77, SCENE_IMAGE_RGBA16, 8, {7, 8, 9, 60000}, {7, 8, 0, 65535, 9, 60000, 0, 65535}},
        {91, SCENE_IMAGE_RGBA16, 16, {1, 2, 3, 4, 5, 6, 7, 8}, {1, 2, 3, 4, 5, 6, 7, 8}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (uint32_t scheme = 0; scheme <= 2; scheme += 2) {
            const struct ktx2_def def = {.format = cases[i].format,
                                         .width = 2,
                                         .height = 1,
                                         .scheme = scheme,
                                         .model = MODEL_PLAIN,
                                         .texels = cases[i].texels,
                                         .size = cases[i].size};
            struct scene_image image = decode_def(&def);
            assert_int_equal(image.type, cases[i].type);
            assert_int_equal(image.size, cases[i].type == SCENE_IMAGE_RGBA8 ? 8 : 16);
            assert_memory_equal(image.texels, cases[i].expected, image.size);
            free(image.texels);
        }
    }
    const float light[4] = {0.5f, 1000, -2, 1};
    const uint16_t halves[4] = {0x3800, 0x63d0, 0xc000, 0x3c00};
    for (int i = 0; i < 2; i++) {
        const struct ktx2_def def = {.format = i == 0 ? 109 : 97,
                                     .width = 1,
                                     .height = 1,
                                     .model = MODEL_PLAIN,
                                     .texels = i == 0 ? (const void *)light : halves,
                                     .size = i == 0 ? sizeof light : sizeof halves};
        struct scene_image image = decode_def(&def);
        assert_int_equal(image.type, SCENE_IMAGE_RGBA32F);
        assert_memory_equal(image.texels, light, sizeof light);
        free(image.texels);
    }
}

// All codes come through a blit between formats of sRGB as they are.
static void test_srgb_codes(void **state)
{
    (void)state;
    uint8_t codes[256];
    for (int i = 0; i < 256; i++) {
        codes[i] = (uint8_t)i;
    }
    const struct ktx2_def def = {
        .format = 15, .width = 16, .height = 16, .model = MODEL_PLAIN, .texels = codes, .size = sizeof codes};
    struct scene_image image = decode_def(&def);
    for (int i = 0; i < 256; i++) {
        assert_int_equal(((const uint8_t *)image.texels)[4 * i], i);
    }
    free(image.texels);
}

// Blocks become what the library makes of them: bytes as they are, 16 bits of what it holds as floats. Signed numbers
// become 0..1.
static void test_block_formats(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    uint64_t random = 1;
    for (enum rhw_format format = RHW_FORMAT_BC1_RGB_UNORM; format < RHW_FORMAT_COUNT; format++) {
        uint8_t block[16];
        random_block(format, &random, block);
        const uint32_t width = (uint32_t)rhw_format_block_width(format),
                       height = (uint32_t)rhw_format_block_height(format);
        const struct ktx2_def def = {.format = 131 + (uint32_t)(format - RHW_FORMAT_BC1_RGB_UNORM),
                                     .width = width,
                                     .height = height,
                                     .model = MODEL_PLAIN,
                                     .texels = block,
                                     .size = rhw_format_block_bytes(format)};
        const bool is_signed = format == RHW_FORMAT_BC4_SNORM || format == RHW_FORMAT_BC5_SNORM ||
                               format == RHW_FORMAT_EAC_R11_SNORM || format == RHW_FORMAT_EAC_RG11_SNORM;
        struct scene_image image = decode_def(&def);
        const void *const texels = decode(&rig, format, block);
        const enum rhw_format decoded = rhw_format_decoded(format);
        for (uint32_t i = 0; i < width * height; i++) {
            if (image.type == SCENE_IMAGE_RGBA8) {
                assert_memory_equal((const uint8_t *)image.texels + 4 * i, (const uint8_t *)texels + 4 * i,
                                    4);
            } else if (image.type == SCENE_IMAGE_RGBA16) {
                const float red = ((const float *)texels)[decoded == RHW_FORMAT_R32_FLOAT ? i : 4 * i];
                const float part = is_signed ? red * 0.5f + 0.5f : red;
                assert_float_equal(((const uint16_t *)image.texels)[4 * i], part * 65535, 0.51f);
            } else {
                assert_true(decoded == RHW_FORMAT_RGBA16_FLOAT);
                for (uint32_t k = 4 * i; k < 4 * i + 4; k++) {
                    assert_true((double)((const float *)image.texels)[k] ==
                                ref_half(((const uint16_t *)texels)[k]));
                }
            }
        }
        free(image.texels);
    }
    rig_close(&rig);
}

static void test_swizzle(void **state)
{
    (void)state;
    static const struct {
        char swizzle[5];
        uint8_t expected[4];
    } cases[] = {{"rgba", {9, 0, 0, 255}},
                 {"rrr1", {9, 9, 9, 255}},
                 {"01ar", {0, 255, 255, 9}},
                 {"rrrx", {9, 0, 0, 255}}};
    const uint8_t grey = 9;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const struct ktx2_def def = {.format = 9,
                                     .width = 1,
                                     .height = 1,
                                     .model = MODEL_PLAIN,
                                     .swizzle = cases[i].swizzle,
                                     .texels = &grey,
                                     .size = 1};
        struct scene_image image = decode_def(&def);
        assert_memory_equal(image.texels, cases[i].expected, 4);
        assert_int_equal(image.has_alpha, cases[i].expected[3] != 255);
        free(image.texels);
    }
}

// Damage -------------------------------------------------------------------------------------------------

static void put_number(struct ktx2_file *file, size_t at, uint32_t number)
{
    memcpy(file->bytes + at, &number, 4);
}

static void test_refused(void **state)
{
    (void)state;
    static const struct {
        size_t at;
        uint32_t number;
        const char *problem;
    } cases[] = {
        {12, 1000, "a KTX2 file of a format that is not read"},
        {12, 0, "a KTX2 file of a format that is not read"}, // nor does the descriptor name one
        {20, 0, "width and height must be 1 to 16384"},
        {20, 16385, "width and height must be 1 to 16384"},
        {24, 0, "width and height must be 1 to 16384"},
        {24, 16384, "damaged KTX2"}, // of two texels
        {28, 2, "a KTX2 file of several layers, faces or slices"},
        {32, 6, "a KTX2 file of several layers, faces or slices"},
        {36, 6, "a KTX2 file of several layers, faces or slices"},
        {40, 33, "damaged KTX2"},
        {44, 1, "damaged KTX2"},
        {44, 2, "damaged KTX2"}, // it is not packed
        {44, 3, "a KTX2 file whose compression is neither BasisLZ nor Zstandard"},
        {48, 0xffffffff, "damaged KTX2"},
        {52, 43, "damaged KTX2"},
        {56, 0xffffffff, "damaged KTX2"},
        {76, 1, "damaged KTX2"}, // 2³² bytes of global data
        {80, 0xffffffff, "damaged KTX2"},
        {92, 1, "damaged KTX2"}, // 2³² bytes of texels
        {112, 2 | 39 << 16, "damaged KTX2"},
        {112, 2 | 41 << 16, "damaged KTX2"},
    };
    const uint8_t texels[8] = {0};
    const struct ktx2_def def = {
        .format = 37, .width = 2, .height = 1, .model = MODEL_PLAIN, .texels = texels, .size = sizeof texels};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct ktx2_file file = *make_file(&def);
        put_number(&file, cases[i].at, cases[i].number);
        assert_refused(file.bytes, file.size, cases[i].problem);
    }
    struct ktx2_file packed = *make_file(&(struct ktx2_def){.format = 37,
                                                            .width = 2,
                                                            .height = 1,
                                                            .scheme = 2,
                                                            .model = MODEL_PLAIN,
                                                            .texels = texels,
                                                            .size = 8});
    put_number(&packed, 96, 9);
    assert_refused(packed.bytes, packed.size, "damaged KTX2");
}

// A file that ends early, and global data that says what it may not.
static void test_damaged_etc1s(void **state)
{
    (void)state;
    uint8_t bytes[2048];
    const size_t size = read_base64(ktx2_samples[0].base64, bytes);
    for (size_t length = 12; length < size; length++) {
        uint8_t *const shorter = malloc(length); // so that a sanitizer sees what is read behind its end
        memcpy(shorter, bytes, length);
        assert_refused(shorter, length, "damaged KTX2");
        free(shorter);
    }
    uint64_t global;
    memcpy(&global, bytes + 64, 8);
    static const struct {
        size_t at;
        uint8_t byte;
    } cases[] = {{0, 0}, {2, 0}, {7, 0xff}, {20, 2} /* a frame after another one */, {27, 0xff}, {35, 0xff}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        uint8_t changed[2048];
        memcpy(changed, bytes, size);
        changed[global + cases[i].at] = cases[i].byte;
        changed[global + cases[i].at + 1] = i < 2 ? 0 : changed[global + cases[i].at + 1];
        assert_refused(changed, size, "damaged KTX2");
    }
    memset(bytes + global + 60, 0xff, 40);
    assert_refused(bytes, size, "damaged KTX2: its ETC1S data");
}

// Whatever a few changed bytes make of a file, it is decoded or refused.
static void test_mutations(void **state)
{
    (void)state;
    uint64_t random = 5;
    for (int round = 0; round < 20000; round++) {
        uint8_t bytes[2048];
        const size_t size = read_base64(ktx2_samples[round % 3].base64, bytes);
        for (int i = 0; i < 1 + round % 5; i++) {
            bytes[48 + random_word(&random) % (size - 48)] ^= (uint8_t)(random_word(&random) % 255 + 1);
        }
        struct scene_image image = {.width = 0};
        if (scene_image_decode(bytes, size, &image) == NULL) {
            free(image.texels);
        }
    }
}

// KHR_texture_basisu -------------------------------------------------------------------------------------

static void write_textured(const char *texture)
{
    write_format("textured.gltf",
                 "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"KHR_texture_basisu\"],"
                 "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
                 "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
                 "\"accessors\":[{\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
                 "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
                 "\"textures\":[%s],\"images\":[{\"uri\":\"nothing.png\"},{\"uri\":\"image.ktx2\","
                 "\"mimeType\":\"image/ktx2\"}]}",
                 texture);
}

static void test_gltf(void **state)
{
    (void)state;
    uint8_t bytes[2048];
    const size_t size = read_base64(ktx2_samples[0].base64, bytes);
    write_bytes("image.ktx2", bytes, size);
    write_textured("{\"source\":0,\"extensions\":{\"KHR_texture_basisu\":{\"source\":1}}}");
    struct scene_model *model = load("textured.gltf");
    const struct scene_image *image = &model->images[model->materials[0].slots[SCENE_SLOT_BASE_COLOR].image];
    assert_true(image->has_alpha && !image->missing);
    assert_int_equal(hash_of(image), ktx2_samples[0].hash);
    scene_model_free(model);
    write_bytes("image.ktx2", bytes, size / 2);
    model = load("textured.gltf");
    assert_true(has_warning(model, "image.ktx2\": damaged KTX2"));
    assert_true(model->images[0].missing);
    scene_model_free(model);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_etc1s),
    cmocka_unit_test(test_etc1s_by_hand),
    cmocka_unit_test(test_etc1s_of_two_channels),
    cmocka_unit_test(test_uastc_modes),
    cmocka_unit_test(test_uastc_by_hand),
    cmocka_unit_test(test_uastc_errors),
    cmocka_unit_test(test_plain_formats),
    cmocka_unit_test(test_srgb_codes),
    cmocka_unit_test(test_block_formats),
    cmocka_unit_test(test_swizzle),
    cmocka_unit_test(test_refused),
    cmocka_unit_test(test_damaged_etc1s),
    cmocka_unit_test(test_mutations),
    cmocka_unit_test(test_gltf),
};

const struct unit_tests test_ktx2 = UNIT_TESTS(tests, make_directory, remove_directory);
