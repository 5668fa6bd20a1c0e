// SPDX-License-Identifier: MIT
// Attributes whose bits the vertex function receives, and those that share a word: random bytes against the meaning of
// each format, one component at a time, where all of 8 vertices are inside their buffer and where they are not.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 32, COUNT = SIZE * SIZE };

// Triangle n of the draw covers pixel n; its value is attribute 0, bit for bit.
static void pixel_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int number = groups[g].vertex_index / 3, corner = groups[g].vertex_index % 3;
        const rhw_float x =
            rhw_float_from_int(number % SIZE) + rhw_select(corner == 2, rhw_splat(1), rhw_splat(0.25f));
        const rhw_float y =
            rhw_float_from_int(number / SIZE) + rhw_select(corner == 1, rhw_splat(1), rhw_splat(0.25f));
        groups[g].position[0] = x * (2.0f / SIZE) - 1.0f;
        groups[g].position[1] = 1.0f - y * (2.0f / SIZE);
        groups[g].position[2] = rhw_splat(0);
        groups[g].position[3] = rhw_splat(1);
        memcpy(groups[g].varying, groups[g].attribute[0], 4 * sizeof(rhw_float));
    }
}

enum meaning { UINT, SINT, USCALED, SSCALED, UNORM, SNORM };

struct packed_format {
    enum rhw_vertex_format format;
    enum meaning meaning;
    int components;        ///< that it has
    int first[4], bits[4]; ///< of each
    int bytes;
};

#define BYTES_OF(n)       \
    {0, n, 2 * n, 3 * n}, \
    {                     \
        n, n, n, n        \
    }
#define FAMILY(name, meaning, n)                                     \
    {RHW_VERTEX_##name##X1, meaning, 1, BYTES_OF(n), n / 8},         \
        {RHW_VERTEX_##name##X2, meaning, 2, BYTES_OF(n), n / 4},     \
        {RHW_VERTEX_##name##X3, meaning, 3, BYTES_OF(n), 3 * n / 8}, \
    {                                                                \
        RHW_VERTEX_##name##X4, meaning, 4, BYTES_OF(n), n / 2        \
    }
#define WORD(name, meaning)                                                                 \
    {RHW_VERTEX_##name##10_10_10_2, meaning, 4, {0, 10, 20, 30}, {10, 10, 10, 2}, 4},       \
    {                                                                                       \
        RHW_VERTEX_##name##10_10_10_2_BGRA, meaning, 4, {20, 10, 0, 30}, {10, 10, 10, 2}, 4 \
    }

static const struct packed_format formats[] = {
    FAMILY(UINT8, UINT, 8),
    FAMILY(SINT8, SINT, 8),
    FAMILY(UINT16, UINT, 16),
    FAMILY(SINT16, SINT, 16),
    FAMILY(UINT32, UINT, 32),
    FAMILY(SINT32, SINT, 32),
    {RHW_VERTEX_FLOAT64X1, UINT, 2, BYTES_OF(32), 8},
    {RHW_VERTEX_FLOAT64X2, UINT, 4, BYTES_OF(32), 16},
    WORD(UNORM, UNORM),
    WORD(SNORM, SNORM),
    WORD(USCALED, USCALED),
    WORD(SSCALED, SSCALED),
    WORD(UINT, UINT),
    WORD(SINT, SINT),
    {RHW_VERTEX_UNORM8X4_BGRA, UNORM, 4, {16, 8, 0, 24}, {8, 8, 8, 8}, 4},
};

static uint32_t bits_of(double value)
{
    const float number = (float)value;
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

static uint32_t component(const struct packed_format *format, const unsigned char *bytes, int c)
{
    const bool is_integer = format->meaning <= SINT;
    if (c >= format->components) {
        return c < 3 ? 0 : is_integer ? 1 : bits_of(1);
    }
    uint32_t code = 0;
    for (int i = 0; i < format->bits[c]; i++) {
        const int bit = format->first[c] + i;
        code |= (uint32_t)(bytes[bit / 8] >> bit % 8 & 1) << i;
    }
    const int bits = format->bits[c];
    const int32_t number = (int32_t)(code << (32 - bits)) >> (32 - bits);
    switch (format->meaning) {
    case UINT: return code;
    case SINT: return (uint32_t)number;
    case USCALED: return bits_of(code);
    case SSCALED: return bits_of(number);
    case UNORM: return bits_of(code / (ldexp(1, bits) - 1));
    default: return bits_of(fmax(number / (ldexp(1, bits - 1) - 1), -1));
    }
}

static void expect_format(const struct packed_format *format, enum rhw_paths paths, uint64_t *random)
{
    static unsigned char data[3 * COUNT * 16];
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig_set_target(&rig, 0, RHW_FORMAT_RGBA32_UINT);
    rig_set_program(&rig, pixel_vertex, rig_fragment_pass);
    rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
    rig.pipeline.attribute_count = 1;
    rig.pipeline.attributes[0] = (struct rhw_attribute){format->format, 0, 0};
    rig.pipeline.buffers[0].stride = 0;
    const size_t size = rhw_vertex_format_size(format->format);
    assert_int_equal(size, format->bytes);
    for (size_t i = 0; i < COUNT; i++) {
        const uint64_t bits[2] = {rig_random(random), rig_random(random)};
        for (size_t corner = 0; corner < 3; corner++) {
            memcpy(data + (3 * i + corner) * size, bits, size);
        }
    }
    // The last triangle lies behind the end.
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, data, (3 * COUNT - 3) * size);
    rhw_pass_draw(rig.context, rig.recording, 0, 3 * COUNT, 0, 1);
    rig_end(&rig);
    const uint32_t(*const seen)[4] =
        (const uint32_t(*)[4])(const void *)rig_read(&rig, rig.pass.colors[0].texture);
    for (int i = 0; i < COUNT; i++) {
        static const unsigned char zeros[16];
        for (int c = 0; c < 4; c++) {
            const uint32_t expected =
                component(format, i < COUNT - 1 ? data + 3 * (size_t)i * size : zeros, c);
            if (seen[i][c] != expected) {
                fail_msg("format %d, triangle %d, component %d: %08x where %08x is meant",
                         (int)format->format, i, c, seen[i][c], expected);
            }
        }
    }
    rig_close(&rig);
}

static void test_every_format(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (size_t f = 0; f < sizeof formats / sizeof *formats; f++) {
        expect_format(&formats[f], RHW_PATHS_ALL, &random);
        expect_format(&formats[f], RHW_PATHS_GENERAL, &random);
    }
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_every_format)};

const struct unit_tests test_vertex_integers = UNIT_TESTS(tests, NULL, NULL);
