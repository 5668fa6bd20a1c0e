// SPDX-License-Identifier: MIT
// Decoders of compressed formats: blocks that were worked out by hand from the Khronos Data Format Specification.
#include "decoded_block.h"

#include <string.h>

static void expect_rgba(struct rig *rig, enum rhw_format format, const unsigned char *block, int texel,
                        const unsigned char wanted[4])
{
    assert_memory_equal((const unsigned char *)decode(rig, format, block) + 4 * texel, wanted, 4);
}

// BC -----------------------------------------------------------------------------------------------------

// No other code is nearer to n / d, and none above it as near.
static void expect_nearest(int code, int n, int d)
{
    const int twice_off = 2 * (255 * n - code * d);
    assert_true(twice_off >= -d && twice_off < d);
}

// All pairs of 5 bits in red and blue, of 6 in green, in both orders: the specification's fractions, rounded to the
// nearest code.
static void test_bc1_colors_are_the_nearest_codes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    for (int a = 0; a < 64; a++) {
        for (int b = 0; b < 64; b++) {
            const int first = (a >> 1) << 11 | a << 5 | (a >> 1), second = (b >> 1) << 11 | b << 5 | (b >> 1);
            const unsigned char block[8] = {(unsigned char)first,
                                            (unsigned char)(first >> 8),
                                            (unsigned char)second,
                                            (unsigned char)(second >> 8),
                                            0xe4,
                                            0xe4,
                                            0xe4,
                                            0xe4};
            const unsigned char *const texels = decode(&rig, RHW_FORMAT_BC1_RGBA_UNORM, block);
            for (int c = 0; c < 3; c++) {
                const int x = c == 1 ? a : a >> 1, y = c == 1 ? b : b >> 1, most = c == 1 ? 63 : 31;
                const bool thirds = first > second;
                expect_nearest(texels[c], x, most);
                expect_nearest(texels[4 + c], y, most);
                expect_nearest(texels[8 + c], thirds ? 2 * x + y : x + y, thirds ? 3 * most : 2 * most);
                expect_nearest(texels[12 + c], thirds ? x + 2 * y : 0, 3 * most);
            }
            assert_int_equal(texels[15], first > second ? 255 : 0);
        }
    }
    rig_close(&rig);
}

static void test_bc1_to_bc3_have_alpha_as_they_say(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    // Black and white, in the order that has black as index 3; texel 0 has it, texel 1 is between, texel 5 white.
    const unsigned char colors[8] = {0, 0, 0xff, 0xff, 0x0b, 0x04, 0, 0};
    expect_rgba(&rig, RHW_FORMAT_BC1_RGBA_UNORM, colors, 0, (const unsigned char[4]){0, 0, 0, 0});
    expect_rgba(&rig, RHW_FORMAT_BC1_RGB_UNORM, colors, 0, (const unsigned char[4]){0, 0, 0, 255});
    expect_rgba(&rig, RHW_FORMAT_BC1_RGB_SRGB, colors, 1, (const unsigned char[4]){128, 128, 128, 255});
    // BC2 and BC3 always have two colours between: index 3 is two thirds of white, 2 one third.
    unsigned char block[16] = {0x8f, 0, 0, 0, 0, 0, 0, 0xf0};
    memcpy(block + 8, colors, sizeof colors);
    expect_rgba(&rig, RHW_FORMAT_BC2_UNORM, block, 0, (const unsigned char[4]){170, 170, 170, 255});
    expect_rgba(&rig, RHW_FORMAT_BC2_UNORM, block, 1, (const unsigned char[4]){85, 85, 85, 136});
    expect_rgba(&rig, RHW_FORMAT_BC2_SRGB, block, 15, (const unsigned char[4]){0, 0, 0, 255});
    // Indices of 3 bits from texel 0 on: 2, 7, 0, 1. 6/7 of 210 and 1/7 of 140 are 200; 1/7 and 6/7 are 150.
    const unsigned char sevenths[8] = {210, 140, 0x3a, 0x02};
    memcpy(block, sevenths, sizeof sevenths);
    expect_rgba(&rig, RHW_FORMAT_BC3_UNORM, block, 0, (const unsigned char[4]){170, 170, 170, 200});
    expect_rgba(&rig, RHW_FORMAT_BC3_UNORM, block, 1, (const unsigned char[4]){85, 85, 85, 150});
    expect_rgba(&rig, RHW_FORMAT_BC3_SRGB, block, 3, (const unsigned char[4]){0, 0, 0, 140});
    // In the other order: 4/5 of 140 and 1/5 of 210 are 154; 7 is one, 6 would be zero.
    const unsigned char fifths[8] = {140, 210, 0x3a, 0x0c};
    memcpy(block, fifths, sizeof fifths);
    expect_rgba(&rig, RHW_FORMAT_BC3_UNORM, block, 0, (const unsigned char[4]){170, 170, 170, 154});
    expect_rgba(&rig, RHW_FORMAT_BC3_UNORM, block, 1, (const unsigned char[4]){85, 85, 85, 255});
    expect_rgba(&rig, RHW_FORMAT_BC3_UNORM, block, 3, (const unsigned char[4]){0, 0, 0, 0});
    rig_close(&rig);
}

static void test_bc4_and_bc5_keep_their_fractions(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    const unsigned char sevenths[8] = {211, 140, 0x3a, 0x02}; // indices 2, 7, 0, 1
    const float *red = decode(&rig, RHW_FORMAT_BC4_UNORM, sevenths);
    assert_float_equal(red[0], 1406.0f / 1785.0f, 0);
    assert_float_equal(red[1], 1051.0f / 1785.0f, 0);
    assert_float_equal(red[2], 211.0f / 255.0f, 0);
    assert_float_equal(red[3], 140.0f / 255.0f, 0);
    // 3 and −128, which counts as −127 when it is mixed: 6/7 of 3 and 1/7 of −127.
    const unsigned char below[8] = {3, 0x80, 0x3a, 0x02};
    red = decode(&rig, RHW_FORMAT_BC4_SNORM, below);
    assert_float_equal(red[0], -109.0f / 889.0f, 0);
    assert_float_equal(red[3], -1.0f, 0);
    // In the other order by fifths, with −1 and 1 as indices 6 and 7.
    unsigned char two[16] = {0x80, 3, 0x3e, 0x0c};
    memcpy(two + 8, below, sizeof below);
    const float *const both = decode(&rig, RHW_FORMAT_BC5_SNORM, two);
    const float wanted[2][4] = {{-1, -109.0f / 889.0f, 0, 1}, {1, (3.0f - 6 * 127) / 889.0f, 0, 1}};
    assert_memory_equal(both, wanted, sizeof wanted);
    assert_float_equal(both[8], -1, 0); // texel 2 has the first end
    rig_close(&rig);
}

static void expect_halves(struct rig *rig, enum rhw_format format, const unsigned char *block, int texel,
                          uint16_t red, uint16_t green, uint16_t blue)
{
    const uint16_t wanted[4] = {red, green, blue, 0x3c00};
    assert_memory_equal((const uint16_t *)decode(rig, format, block) + 4 * texel, wanted, sizeof wanted);
}

// Sets `count` bits from bit `at`.
static void put(unsigned char *block, int at, int count, unsigned value)
{
    for (int i = 0; i < count; i++) {
        const int bit = at + i;
        block[bit / 8] =
            (unsigned char)((block[bit / 8] & ~(1 << bit % 8)) | (int)(value >> i & 1) << bit % 8);
    }
}

static void test_bc6h_blocks(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    // Mode 3: endpoints of 10 bits, one subset, weights of 4 bits from bit 65 on, 3 for the first.
    unsigned char block[16] = {0};
    put(block, 0, 5, 3);
    put(block, 5, 10, 0x3ff);  // red from the most
    put(block, 15, 10, 0x100); // green: (0x100 << 15 | 0x4000) >> 9 = 0x4020, times 31 / 64: 0x1f0f
    put(block, 45, 10, 0x100);
    put(block, 55, 10, 1); // blue to (0x8000 + 0x4000) >> 9 = 0x60
    put(block, 68, 4, 15); // texel 1: the other end
    put(block, 72, 4, 8);  // texel 2: 34 of 64
    expect_halves(&rig, RHW_FORMAT_BC6H_UFLOAT, block, 0, 0x7bff, 0x1f0f, 0);
    expect_halves(&rig, RHW_FORMAT_BC6H_UFLOAT, block, 1, 0, 0x1f0f, 0x60 * 31 >> 6);
    // (30 · 0xffff + 32) >> 6 = 0x7800, (34 · 0x60 + 32) >> 6 = 51.
    expect_halves(&rig, RHW_FORMAT_BC6H_UFLOAT, block, 2, 0x7800 * 31 >> 6, 0x1f0f, 51 * 31 >> 6);
    // Signed: red is −1 of 10 bits, (0x8000 + 0x4000) >> 9 = 0x60 below 0; green 0x100 is half of the most.
    expect_halves(&rig, RHW_FORMAT_BC6H_SFLOAT, block, 0, 0x8000 | (0x60 * 31 >> 5), 0x4020 * 31 >> 5, 0);
    // Mode 15: 16 bits and a difference of 4, to the other side.
    memset(block, 0, sizeof block);
    put(block, 0, 5, 15);
    put(block, 5, 10, 3);  // red 3
    put(block, 35, 4, 12); // less 4: 0xffff
    put(block, 68, 4, 15);
    expect_halves(&rig, RHW_FORMAT_BC6H_UFLOAT, block, 0, 3 * 31 >> 6, 0, 0);
    expect_halves(&rig, RHW_FORMAT_BC6H_UFLOAT, block, 1, 0x7bff, 0, 0);
    expect_halves(&rig, RHW_FORMAT_BC6H_SFLOAT, block, 1, 0x8000 | 31 >> 5, 0, 0);
    // Reserved modes are black.
    for (int mode = 19; mode < 32; mode += 4) {
        memset(block, 0xff, sizeof block);
        put(block, 0, 5, (unsigned)mode);
        expect_halves(&rig, RHW_FORMAT_BC6H_SFLOAT, block, 5, 0, 0, 0);
    }
    rig_close(&rig);
}

static void test_bc7_blocks(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    // Mode 6: 7 bits and a low one of each endpoint; weights of 4 bits from bit 65 on, 3 for the first.
    unsigned char block[16] = {0};
    put(block, 0, 7, 0x40);
    put(block, 7, 7, 100);  // red from 201
    put(block, 14, 7, 10);  // to 20
    put(block, 35, 7, 127); // blue from 255
    put(block, 49, 7, 127); // alpha from 255
    put(block, 56, 7, 127); // to 254
    put(block, 63, 1, 1);   // the low bit of the first endpoint: green from 1
    put(block, 68, 4, 15);
    put(block, 72, 4, 8); // 34 of 64
    expect_rgba(&rig, RHW_FORMAT_BC7_UNORM, block, 0, (const unsigned char[4]){201, 1, 255, 255});
    expect_rgba(&rig, RHW_FORMAT_BC7_SRGB, block, 1, (const unsigned char[4]){20, 0, 0, 254});
    // (201·30 + 20·34 + 32) >> 6, (30 + 32) >> 6, (255·30 + 32) >> 6, (255·30 + 254·34 + 32) >> 6
    expect_rgba(&rig, RHW_FORMAT_BC7_UNORM, block, 2, (const unsigned char[4]){105, 0, 120, 254});
    // Mode 5, rotation 1: alpha and red change places; alpha has weights of its own from bit 97 on.
    memset(block, 0, sizeof block);
    put(block, 0, 6, 0x20);
    put(block, 6, 2, 1);
    put(block, 8, 7, 64);     // red from 129
    put(block, 58, 8, 64);    // alpha to 64
    put(block, 97 + 1, 2, 3); // texel 1
    expect_rgba(&rig, RHW_FORMAT_BC7_UNORM, block, 0, (const unsigned char[4]){0, 0, 0, 129});
    expect_rgba(&rig, RHW_FORMAT_BC7_UNORM, block, 1, (const unsigned char[4]){64, 0, 0, 129});
    memset(block, 0xff, sizeof block);
    block[0] = 0; // reserved
    expect_rgba(&rig, RHW_FORMAT_BC7_UNORM, block, 9, (const unsigned char[4]){0, 0, 0, 0});
    rig_close(&rig);
}

// ETC2 and EAC -------------------------------------------------------------------------------------------

// 8 bytes, the highest first.
static void put_big(unsigned char *block, uint64_t word)
{
    for (int i = 0; i < 8; i++) {
        block[i] = (unsigned char)(word >> (56 - 8 * i));
    }
}

static void test_etc2_modes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    unsigned char block[16] = {0};
    const enum rhw_format rgb = RHW_FORMAT_ETC2_RGB8_UNORM, punched = RHW_FORMAT_ETC2_RGB8A1_UNORM;
    // Individual: base colours 0x1/0xf, 0x2/0, 0x3/0; tables 0 and 2; side by side. Texel a (0, 0) has index 3 (−8), the
    // texel right of the middle (2, 0), bit 8, has index 1 (29).
    put_big(block, 0x1f20300000000000u | 2ull << 34 | 0x00010101u);
    expect_rgba(&rig, rgb, block, 0, (const unsigned char[4]){9, 26, 43, 255});
    expect_rgba(&rig, rgb, block, 2, (const unsigned char[4]){255, 29, 29, 255});
    expect_rgba(&rig, rgb, block, 4, (const unsigned char[4]){19, 36, 53, 255}); // index 0: 2
    // Differential: red 24 and one more, green and blue 4; one above the other. (24 is 198, 25 is 206, 4 is 33.)
    put_big(block, 24ull << 59 | 1ull << 56 | 4ull << 51 | 4ull << 43 | 3ull << 32);
    expect_rgba(&rig, rgb, block, 0, (const unsigned char[4]){200, 35, 35, 255});
    expect_rgba(&rig, rgb, block, 15, (const unsigned char[4]){208, 35, 35, 255});
    expect_rgba(&rig, punched, block, 15, (const unsigned char[4]){208, 35, 35, 255});
    // Without the opaque bit the small step is 0 and index 2 a hole: texel p, bit 31.
    put_big(block, 24ull << 59 | 1ull << 56 | 4ull << 51 | 4ull << 43 | 1ull << 32 | 1ull << 31);
    expect_rgba(&rig, punched, block, 0, (const unsigned char[4]){198, 33, 33, 255});
    expect_rgba(&rig, punched, block, 15, (const unsigned char[4]){0, 0, 0, 0});
    // T: red is 0 and its difference −1. First colour 0x3, 0, 0, second 0x8, 0, 0; distance index 5 is 32. Texels a, b, c, d
    // have the indices 0..3.
    const uint64_t t = 3ull << 56 | 1ull << 58 | 8ull << 44 | 2ull << 34 | 1ull << 32 | 0x000c000au;
    put_big(block, t | 1ull << 33);
    expect_rgba(&rig, rgb, block, 0, (const unsigned char[4]){0x33, 0, 0, 255});
    expect_rgba(&rig, rgb, block, 4, (const unsigned char[4]){0x88 + 32, 32, 32, 255});
    expect_rgba(&rig, rgb, block, 8, (const unsigned char[4]){0x88, 0, 0, 255});
    expect_rgba(&rig, rgb, block, 12, (const unsigned char[4]){0x88 - 32, 0, 0, 255});
    put_big(block, t);
    expect_rgba(&rig, punched, block, 8, (const unsigned char[4]){0, 0, 0, 0});
    expect_rgba(&rig, punched, block, 12, (const unsigned char[4]){0x88 - 32, 0, 0, 255});
    rig_close(&rig);
}

static void test_etc2_h_and_planar(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    unsigned char block[16] = {0};
    const enum rhw_format rgb = RHW_FORMAT_ETC2_RGB8_UNORM;
    // H: green is 0 and its difference −2. First colour 0x9, 0, 0x5 (blue: bit 51 and 47..49), second 0x4, 0, 0; the first is
    // the greater one: distance index 1 is 6.
    put_big(block, 9ull << 59 | 4ull << 48 | 1ull << 47 | 2ull << 48 | 4ull << 43 | 1ull << 33 | 0x000c000au);
    expect_rgba(&rig, rgb, block, 0, (const unsigned char[4]){0x99 + 6, 6, 0x55 + 6, 255});
    expect_rgba(&rig, rgb, block, 4, (const unsigned char[4]){0x99 - 6, 0, 0x55 - 6, 255});
    expect_rgba(&rig, rgb, block, 8, (const unsigned char[4]){0x44 + 6, 6, 6, 255});
    expect_rgba(&rig, rgb, block, 12, (const unsigned char[4]){0x44 - 6, 0, 0, 255});
    // Planar: blue is 0 and its difference −4. Red from 130 to 255 on the right and 0 below, green from 0 to 255 below:
    // (3·125 − 3·130 + 4·130 + 2) >> 2 = 126, (3·255 + 2) >> 2 = 191.
    put_big(block, 32ull << 57 | 1ull << 42 | 31ull << 34 | 1ull << 33 | 1ull << 32 | 127ull << 6);
    for (int i = 0; i < 2; i++) {
        const enum rhw_format format = i == 0 ? rgb : RHW_FORMAT_ETC2_RGB8A1_UNORM;
        expect_rgba(&rig, format, block, 0, (const unsigned char[4]){130, 0, 0, 255});
        expect_rgba(&rig, format, block, 3, (const unsigned char[4]){224, 0, 0, 255});
        expect_rgba(&rig, format, block, 12, (const unsigned char[4]){33, 191, 0, 255});
        expect_rgba(&rig, format, block, 15, (const unsigned char[4]){126, 191, 0, 255});
    }
    rig_close(&rig);
}

static void test_eac_follows_the_examples_of_its_specification(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    // Base 103, multiplier 2, table 13; texel b (0, 1) has index 3: −10, the others index 0: −1.
    unsigned char block[16];
    const uint64_t tail = 13ull << 48 | 3ull << 42;
    put_big(block, 103ull << 56 | 2ull << 52 | tail);
    put_big(block + 8, 103ull << 56 | tail);
    assert_float_equal(((const float *)decode(&rig, RHW_FORMAT_EAC_R11_UNORM, block))[4], 668.0f / 2047, 0);
    assert_float_equal(((const float *)decode(&rig, RHW_FORMAT_EAC_R11_UNORM, block + 8))[4], 818.0f / 2047,
                       0);
    const float *both = decode(&rig, RHW_FORMAT_EAC_RG11_UNORM, block);
    const float wanted[4] = {812.0f / 2047, 827.0f / 2047, 0, 1}; // 828 less 16 and less 1
    assert_memory_equal(both, wanted, sizeof wanted);
    put_big(block, 60ull << 56 | 2ull << 52 | tail);
    assert_float_equal(((const float *)decode(&rig, RHW_FORMAT_EAC_R11_SNORM, block))[4], 320.0f / 1023, 0);
    put_big(block, 0x80ull << 56 | tail); // −128 counts as −127: −1016 − 1
    put_big(block + 8, 65ull << 56 | tail);
    both = decode(&rig, RHW_FORMAT_EAC_RG11_SNORM, block);
    const float below[4] = {-1017.0f / 1023, 519.0f / 1023, 0, 1};
    assert_memory_equal(both, below, sizeof below);
    assert_float_equal(both[16], -1, 0); // −1016 − 10, clamped
    // Alpha: 103 − 20 and 103 − 2; a multiplier of 0 is one.
    put_big(block, 103ull << 56 | 2ull << 52 | tail);
    put_big(block + 8, 0);
    expect_rgba(&rig, RHW_FORMAT_ETC2_RGBA8_UNORM, block, 4, (const unsigned char[4]){2, 2, 2, 83});
    expect_rgba(&rig, RHW_FORMAT_ETC2_RGBA8_SRGB, block, 0, (const unsigned char[4]){2, 2, 2, 101});
    put_big(block, 103ull << 56 | tail);
    expect_rgba(&rig, RHW_FORMAT_ETC2_RGBA8_UNORM, block, 4, (const unsigned char[4]){2, 2, 2, 103});
    rig_close(&rig);
}

// ASTC ---------------------------------------------------------------------------------------------------

// Luminance from `first` to `second`, a 4 × 4 grid of weights of 2 bits: 0, 1, 2, 3 in each row.
static void make_luminance(unsigned char *block, unsigned first, unsigned second)
{
    memset(block, 0, 16);
    put(block, 0, 11, 0x042);
    put(block, 17, 8, first);
    put(block, 25, 8, second);
    for (int i = 0; i < 16; i++) {
        put(block, 127 - 2 * i, 1, (unsigned)i & 1); // backwards from the end
        put(block, 126 - 2 * i, 1, (unsigned)i >> 1 & 1);
    }
}

static void test_astc_weights_between_two_colors(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    unsigned char block[16];
    // 2 bits are 0, 21, 43 and 64 of 64. (8224·43 + 57568·21 + 32) >> 14 = 0x5f.
    make_luminance(block, 0x20, 0xe0);
    const unsigned char wanted[4] = {0x20, 0x5f, 0xa1, 0xe0};
    for (int i = 0; i < 16; i++) {
        const unsigned char *const texel =
            (const unsigned char *)decode(&rig, RHW_FORMAT_ASTC_4X4_UNORM, block) + 4 * i;
        assert_int_equal(texel[0], wanted[i % 4]);
        assert_int_equal(texel[2], wanted[i % 4]);
        assert_int_equal(texel[3], 255);
    }
    // From 0 to 1: 257·43 / 64 = 172.7 is 0 in the upper byte; of sRGB (128·21 + 384·43) / 64 = 300 is 1, of alpha too:
    // (0xff80 · 64 + 32) >> 14 = 255.
    make_luminance(block, 0, 1);
    expect_rgba(&rig, RHW_FORMAT_ASTC_4X4_UNORM, block, 2, (const unsigned char[4]){0, 0, 0, 255});
    expect_rgba(&rig, RHW_FORMAT_ASTC_4X4_SRGB, block, 2, (const unsigned char[4]){1, 1, 1, 255});
    // Stretched over 5 × 5: D = (1024 + 2) / 4 = 256, texel 1 at (256·3 + 32) >> 6 = 12 16ths: (0·4 + 21·12 + 8) >> 4 = 16
    // of 64; down the first column all weights are 0.
    make_luminance(block, 0, 255);
    expect_rgba(&rig, RHW_FORMAT_ASTC_5X5_UNORM, block, 1, (const unsigned char[4]){64, 64, 64, 255});
    expect_rgba(&rig, RHW_FORMAT_ASTC_5X5_UNORM, block, 20, (const unsigned char[4]){0, 0, 0, 255});
    rig_close(&rig);
}

static void test_astc_errors_are_magenta(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 12, 12);
    const unsigned char magenta[4] = {255, 0, 255, 255};
    const enum rhw_format format = RHW_FORMAT_ASTC_6X6_UNORM;
    unsigned char one_color[16] = {0xfc, 0xfd, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff,
                                   0,    10,   0,    20,   0,    30,   0,    40};
    expect_rgba(&rig, format, one_color, 35, (const unsigned char[4]){10, 20, 30, 40});
    expect_rgba(&rig, RHW_FORMAT_ASTC_12X12_SRGB, one_color, 143, (const unsigned char[4]){10, 20, 30, 40});
    one_color[1] = 0xff; // high dynamic range
    expect_rgba(&rig, format, one_color, 35, magenta);
    one_color[1] = 0xf5; // a reserved bit is not set
    expect_rgba(&rig, format, one_color, 35, magenta);
    one_color[1] = 0xfd;
    memset(one_color + 2, 0, 6); // from 15 to 0: no rectangle
    expect_rgba(&rig, format, one_color, 35, magenta);
    put(one_color, 25, 13, 16);
    put(one_color, 51, 13, 1); // from 15 to 16, from 0 to 1
    expect_rgba(&rig, format, one_color, 35, (const unsigned char[4]){10, 20, 30, 40});
    put(one_color, 25, 13, 15); // from 15 to 15: a rectangle of no width
    expect_rgba(&rig, format, one_color, 35, magenta);
    put(one_color, 25, 13, 16);
    put(one_color, 51, 13, 0); // of no height
    expect_rgba(&rig, format, one_color, 35, magenta);
    unsigned char block[16];
    make_luminance(block, 0, 255);
    put(block, 13, 4, 2); // endpoints of high dynamic range
    expect_rgba(&rig, format, block, 0, magenta);
    make_luminance(block, 0, 255);
    put(block, 0, 2, 1); // weights of 1 bit: 16 bits in all, fewer than 24
    expect_rgba(&rig, format, block, 0, magenta);
    make_luminance(block, 0, 255);
    put(block, 7, 2, 3); // a grid 7 wide, wider than the block
    expect_rgba(&rig, format, block, 0, magenta);
    make_luminance(block, 0, 255);
    put(block, 10, 3, 7); // two planes and four partitions
    expect_rgba(&rig, format, block, 0, magenta);
    memset(block, 0, sizeof block); // a reserved mode
    expect_rgba(&rig, format, block, 0, magenta);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_bc1_colors_are_the_nearest_codes),
    cmocka_unit_test(test_bc1_to_bc3_have_alpha_as_they_say),
    cmocka_unit_test(test_bc4_and_bc5_keep_their_fractions),
    cmocka_unit_test(test_bc6h_blocks),
    cmocka_unit_test(test_bc7_blocks),
    cmocka_unit_test(test_etc2_modes),
    cmocka_unit_test(test_etc2_h_and_planar),
    cmocka_unit_test(test_eac_follows_the_examples_of_its_specification),
    cmocka_unit_test(test_astc_weights_between_two_colors),
    cmocka_unit_test(test_astc_errors_are_magenta),
};

const struct unit_tests test_block_decoders = UNIT_TESTS(tests, NULL, NULL);
