// SPDX-License-Identifier: MIT
// Mip generation, bit by bit: on every instruction set, on any number of threads and for any size a chain has the bytes
// of the plain loops below, which go texel by texel through whole levels.
#include "harness.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "context/context.h"
#include "format/format.h"
#include "base/half.h"
#include "context/lookup.h"
#include "format/srgb.h"
#include "resource/texture.h"

static const enum rhw_format formats[] = {
    RHW_FORMAT_R8_UNORM,     RHW_FORMAT_RG8_UNORM, RHW_FORMAT_RGBA8_UNORM,  RHW_FORMAT_RGBA8_SRGB,
    RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_R32_FLOAT, RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_D32_FLOAT};
enum { FORMATS = sizeof formats / sizeof *formats };

// The model ------------------------------------------------------------------------------------------

struct taps {
    int first, count;
    float weight[3];
};

static struct taps taps_of(int larger, int smaller, int i)
{
    if (larger == 1) {
        return (struct taps){0, 1, {1.0f, 0.0f, 0.0f}};
    }
    if (larger % 2 == 0) {
        return (struct taps){2 * i, 2, {0.5f, 0.5f, 0.0f}};
    }
    const float width = (float)larger;
    return (struct taps){
        2 * i, 3, {(float)(smaller - i) / width, (float)smaller / width, (float)(i + 1) / width}};
}

// Linear channels of 8 bits stand on the scale 0..255.
static void load(const struct rhw_format_info *format, const unsigned char *texel, float value[4])
{
    for (size_t c = 0; c < format->channels; c++) {
        uint16_t half;
        if (format->codec == RHW_CODEC_UNORM8 || (format->codec == RHW_CODEC_SRGB8 && c == 3)) {
            value[c] = texel[c];
        } else if (format->codec == RHW_CODEC_SRGB8) {
            value[c] = rhw_srgb_decode_table[texel[c]];
        } else if (format->codec == RHW_CODEC_FLOAT16) {
            memcpy(&half, texel + 2 * c, sizeof half);
            value[c] = rhw_half_to_float(half);
        } else {
            memcpy(&value[c], texel + 4 * c, sizeof value[c]);
        }
    }
}

static unsigned char round_code(float value)
{
    return (unsigned char)lrintf(value);
}

static void store(const struct rhw_format_info *format, const float value[4], unsigned char *texel)
{
    for (size_t c = 0; c < format->channels; c++) {
        const float number = isnan(value[c]) ? NAN : value[c];
        const uint16_t half = rhw_half_from_float(number);
        if (format->codec == RHW_CODEC_UNORM8 || (format->codec == RHW_CODEC_SRGB8 && c == 3)) {
            texel[c] = round_code(number);
        } else if (format->codec == RHW_CODEC_SRGB8) {
            texel[c] = rhw_srgb_encode(number);
        } else if (format->codec == RHW_CODEC_FLOAT16) {
            memcpy(texel + 2 * c, &half, sizeof half);
        } else {
            memcpy(texel + 4 * c, &number, sizeof number);
        }
    }
}

static void filter(const float (*from)[4], int pitch, const struct taps *x, const struct taps *y,
                   float value[4])
{
    for (int c = 0; c < 4; c++) {
        float sum = 0;
        for (int j = 0; j < y->count; j++) {
            const float(*const row)[4] = from + (y->first + j) * pitch + x->first;
            float line = row[0][c] * x->weight[0];
            for (int i = 1; i < x->count; i++) {
                line += row[i][c] * x->weight[i];
            }
            sum += line * y->weight[j];
        }
        value[c] = sum;
    }
}

// Wants the chain that belongs to level 0, and zeros between rows.
static void expect_chain(const struct rhw_texture_data *texture, const char *what)
{
    const struct rhw_format_info *const info = texture->info;
    const size_t texels = (size_t)texture->mip[0].width * (size_t)texture->mip[0].height;
    float(*from)[4] = calloc(texels, sizeof *from), (*to)[4] = calloc(texels, sizeof *to);
    for (size_t i = 0; i < texels; i++) {
        const size_t x = i % (size_t)texture->mip[0].width, y = i / (size_t)texture->mip[0].width;
        load(info, texture->mip[0].texels + y * texture->mip[0].row_pitch + x * info->size, from[i]);
    }
    for (int level = 1; level < texture->levels; level++) {
        const struct rhw_mip *const above = &texture->mip[level - 1], *const mip = &texture->mip[level];
        for (int y = 0; y < mip->height; y++) {
            const unsigned char *const row = mip->texels + (size_t)y * mip->row_pitch;
            const struct taps rows = taps_of(above->height, mip->height, y);
            for (int x = 0; x < mip->width; x++) {
                const struct taps columns = taps_of(above->width, mip->width, x);
                float *const value = to[y * mip->width + x];
                unsigned char texel[RHW_TEXEL_BYTES];
                filter((const float(*)[4])from, above->width, &columns, &rows, value);
                store(info, value, texel);
                if (memcmp(texel, row + (size_t)x * info->size, info->size) != 0) {
                    fail_msg("%s, %s of %dx%d: texel %d, %d of level %d differs", what, info->name,
                             texture->mip[0].width, texture->mip[0].height, x, y, level);
                }
            }
            for (size_t i = (size_t)mip->width * info->size; i < mip->row_pitch; i++) {
                assert_int_equal(row[i], 0);
            }
        }
        float(*const last)[4] = from;
        from = to;
        to = last;
    }
    free(from);
    free(to);
}

// ----------------------------------------------------------------------------------------------------

// Level 0 gets any bits: of floats NaN, infinities and denormals too, and −0 in whole boxes.
static rhw_texture make_texture(rhw_context *context, enum rhw_format format, int width, int height,
                                uint64_t *random)
{
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = format;
    def.width = width;
    def.height = height;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(context, &def, &texture), RHW_OK);
    const size_t size = (size_t)width * (size_t)height * rhw_format_size(format);
    unsigned char *const texels = calloc(size + 8, 1);
    for (size_t i = 0; i < size; i += 8) {
        const uint64_t bits = i / 512 % 4 == 3 ? 0x8000000080000000 : rig_random(random);
        memcpy(texels + i, &bits, sizeof bits);
    }
    rhw_texture_write(context, texture, 0, texels, 0);
    free(texels);
    return texture;
}

static rhw_context *open_context(enum rhw_isa isa, int threads)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = threads;
    def.isa_limit = rhw_isa_up_to(isa);
    rhw_context *context;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    return context;
}

static void check_chains(rhw_context *context, const char *what, const int (*sizes)[2], int count)
{
    uint64_t random = 15;
    for (int n = 0; n < FORMATS * count; n++) {
        const int *const size = sizes[n / FORMATS];
        const rhw_texture texture = make_texture(context, formats[n % FORMATS], size[0], size[1], &random);
        assert_int_equal(rhw_texture_generate_mips(context, texture), RHW_OK);
        expect_chain(rhw_context_texture(context, texture, "test"), what);
        rhw_texture_destroy(context, texture);
    }
}

// Every number of texels in the last group of lanes, and every way in which sizes become odd.
static void test_small_chains(void **state)
{
    (void)state;
    static int sizes[40 * 4][2];
    for (int i = 0; i < 40; i++) {
        const int others[4] = {1, 2, 7, 24};
        for (int k = 0; k < 4; k++) {
            sizes[4 * i + k][0] = k % 2 == 0 ? i + 1 : others[k];
            sizes[4 * i + k][1] = k % 2 == 0 ? others[k] : i + 1;
        }
    }
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        if (rhw_isa_supported((enum rhw_isa)isa)) {
            rhw_context *const context = open_context((enum rhw_isa)isa, 1);
            check_chains(context, rhw_isa_name((enum rhw_isa)isa), (const int(*)[2])sizes, 40 * 4);
            rhw_context_destroy(context);
        }
    }
}

// So large that threads take bands of rows, which overlap where sizes are odd. How many bands there are has nothing to do
// with what an instruction set makes of one: the baseline makes chains with any number of threads, the others with many.
static void test_chains_in_bands(void **state)
{
    (void)state;
    static const int sizes[][2] = {{1023, 511}, {259, 2047}, {512, 768}, {3000, 150}, {1, 16384}};
    const int threads[] = {5, 2, 1};
    for (int isa = RHW_ISA_BASELINE; isa < RHW_ISA_COUNT; isa++) {
        for (int t = 0; t < (isa == RHW_ISA_BASELINE ? 3 : 1) && rhw_isa_supported((enum rhw_isa)isa); t++) {
            rhw_context *const context = open_context((enum rhw_isa)isa, threads[t]);
            check_chains(context, rhw_isa_name((enum rhw_isa)isa), sizes, sizeof sizes / sizeof *sizes);
            rhw_context_destroy(context);
        }
    }
}

// Memory ---------------------------------------------------------------------------------------------

static void *take(void *user, size_t size, size_t alignment)
{
    _Atomic size_t *const largest = user;
    if (size > *largest) {
        *largest = size;
    }
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static void give(void *user, void *memory, size_t size)
{
    (void)user;
    (void)size;
    free(memory);
}

// Whole levels as floats would be 22 MB.
static void test_a_chain_needs_little_memory(void **state)
{
    (void)state;
    _Atomic size_t largest = 0;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 2;
    def.allocator = (struct rhw_allocator){take, give, &largest};
    rhw_context *context;
    assert_int_equal(rhw_context_create(&def, &context), RHW_OK);
    uint64_t random = 16;
    const rhw_texture texture = make_texture(context, RHW_FORMAT_RGBA8_UNORM, 2048, 1024, &random);
    largest = 0;
    assert_int_equal(rhw_texture_generate_mips(context, texture), RHW_OK);
    assert_true(largest > 0 && largest < 2 << 20);
    rhw_context_destroy(context);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_small_chains),
    cmocka_unit_test(test_chains_in_bands),
    cmocka_unit_test(test_a_chain_needs_little_memory),
};

const struct unit_tests test_mips = UNIT_TESTS(tests, NULL, NULL);
