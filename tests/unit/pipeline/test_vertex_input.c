// SPDX-License-Identifier: MIT
// Vertex fetch: every format over every bit pattern that matters, several buffers with stride, offset and
// no alignment, attributes per instance, and reads beyond the end.
#include "float_bits.h"
#include "harness.h"
#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 64 };

// Triangle n of the draw covers pixel n of a SIZE×SIZE target; its flat value is attribute 0.
static void pixel_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_int number = groups[g].vertex_index / 3, corner = groups[g].vertex_index % 3;
        const rhw_float column = __builtin_convertvector(number % SIZE, rhw_float);
        const rhw_float row = __builtin_convertvector(number / SIZE, rhw_float);
        // Corners at (0.25, 0.25), (0.25, 1), (1, 0.25) of the pixel.
        const rhw_float x = column + rhw_select(corner == 2, rhw_splat(1), rhw_splat(0.25f));
        const rhw_float y = row + rhw_select(corner == 1, rhw_splat(1), rhw_splat(0.25f));
        groups[g].position[0] = x * (2.0f / SIZE) - 1.0f;
        groups[g].position[1] = 1.0f - y * (2.0f / SIZE);
        groups[g].position[2] = rhw_splat(0);
        groups[g].position[3] = rhw_splat(1);
        for (int c = 0; c < 4; c++) {
            groups[g].varying[c] = groups[g].attribute[0][c];
        }
    }
}

static void open_rig(struct rig *rig)
{
    rig_open(rig, SIZE, SIZE);
    rig_set_program(rig, pixel_vertex, rig_fragment_pass);
    rig->pipeline.program.varyings[0].qualifier = RHW_FLAT;
    rig->pipeline.attribute_count = 1;
}

struct format_row {
    enum rhw_vertex_format first; ///< the one-component member of the family; 2 to 4 components follow
    int bytes;                    ///< of a component
    double (*value)(uint32_t bits);
};

static double float_value(uint32_t bits)
{
    return (double)from_bits(bits);
}

static double half_value(uint32_t bits)
{
    return ref_half((uint16_t)bits);
}

static double unorm8_value(uint32_t bits)
{
    return bits / 255.0;
}

static double snorm8_value(uint32_t bits)
{
    return fmax((int8_t)bits / 127.0, -1);
}

static double uint_value(uint32_t bits)
{
    return bits;
}

static double sint8_value(uint32_t bits)
{
    return (int8_t)bits;
}

static double unorm16_value(uint32_t bits)
{
    return bits / 65535.0;
}

static double snorm16_value(uint32_t bits)
{
    return fmax((int16_t)bits / 32767.0, -1);
}

static double sint16_value(uint32_t bits)
{
    return (int16_t)bits;
}

static const struct format_row families[] = {
    {RHW_VERTEX_FLOAT1, 4, float_value},      {RHW_VERTEX_HALF1, 2, half_value},
    {RHW_VERTEX_UNORM8X1, 1, unorm8_value},   {RHW_VERTEX_SNORM8X1, 1, snorm8_value},
    {RHW_VERTEX_USCALED8X1, 1, uint_value},   {RHW_VERTEX_SSCALED8X1, 1, sint8_value},
    {RHW_VERTEX_UNORM16X1, 2, unorm16_value}, {RHW_VERTEX_SNORM16X1, 2, snorm16_value},
    {RHW_VERTEX_USCALED16X1, 2, uint_value},  {RHW_VERTEX_SSCALED16X1, 2, sint16_value},
};

// A fixed-point value may be one rounding off the nearest float; its ends are exact, and so is all else.
static void expect_component(const struct format_row *family, uint32_t bits, float seen)
{
    const double expected = family->value(bits);
    if (isnan(expected)) {
        assert_true(isnan(seen));
        return;
    }
    const bool exact = expected == (double)(float)expected;
    if (exact ? (double)seen != expected : fabs((double)seen - expected) > rig_ulp(expected)) {
        fail_msg("format %d bits %x: %.9g where %.17g is meant", family->first, bits, (double)seen, expected);
    }
}

// Draws SIZE² triangles whose attribute takes consecutive bit patterns from `start` on.
static void check_patterns(struct rig *rig, const struct format_row *family, int components, uint32_t start,
                           uint32_t step)
{
    static unsigned char data[3 * SIZE * SIZE * 16];
    const int size = family->bytes * components;
    assert_int_equal(rhw_vertex_format_size(family->first + (enum rhw_vertex_format)(components - 1)), size);
    uint32_t bits = start;
    for (int i = 0; i < SIZE * SIZE; i++) {
        for (int c = 0; c < components; c++, bits += step) {
            for (int corner = 0; corner < 3; corner++) {
                memcpy(data + (3 * i + corner) * size + c * family->bytes, &bits, (size_t)family->bytes);
            }
        }
    }
    rig->pipeline.attributes[0] =
        (struct rhw_attribute){family->first + (enum rhw_vertex_format)(components - 1), 0, 0};
    rig->pipeline.buffers[0].stride = (uint32_t)size;
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, data, (size_t)(3 * SIZE * SIZE * size));
    rhw_pass_draw(rig->context, rig->recording, 0, 3 * SIZE * SIZE, 0, 1);
    rig_end(rig);
    assert_int_equal(rig->stats.fragments_shaded, SIZE * SIZE);
    const float(*pixels)[4] = rig_read_float4(rig);
    const uint32_t mask = family->bytes == 4 ? 0xffffffff : (1u << 8 * family->bytes) - 1;
    bits = start;
    for (int i = 0; i < SIZE * SIZE; i++) {
        for (int c = 0; c < components; c++, bits += step) {
            expect_component(family, bits & mask, pixels[i][c]);
        }
        for (int c = components; c < 4; c++) {
            assert_true(pixels[i][c] == (c == 3 ? 1.0f : 0.0f));
        }
    }
}

static void test_every_format(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    for (size_t f = 0; f < sizeof families / sizeof *families; f++) {
        for (int components = 1; components <= 4; components++) {
            // Odd steps visit every pattern of 8 bits in every component; floats spread over all exponents.
            const uint32_t step = families[f].bytes == 4 ? 0x10305u * 16 + 1 : 1;
            check_patterns(&rig, &families[f], components, families[f].bytes == 4 ? 0x3f000000 : 0xff80,
                           step);
        }
        if (families[f].bytes == 2) {
            for (uint32_t start = 0; start < 65536; start += SIZE * SIZE) {
                check_patterns(&rig, &families[f], 1, start, 1);
            }
        }
    }
    rig_close(&rig);
}

static void test_sizes(void **state)
{
    (void)state;
    for (size_t f = 0; f < sizeof families / sizeof *families; f++) {
        for (int components = 1; components <= 4; components++) {
            const enum rhw_vertex_format format =
                families[f].first + (enum rhw_vertex_format)(components - 1);
            assert_int_equal(rhw_vertex_format_size(format), families[f].bytes * components);
        }
    }
}

// Positions from attribute 0 (two floats, NDC); the value is the sum of what the other attributes bring.
static void sum_vertex(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float(*a)[4] = groups[g].attribute;
        groups[g].position[0] = a[0][0] + a[3][0];
        groups[g].position[1] = a[0][1] + a[3][1];
        groups[g].position[2] = a[0][2];
        groups[g].position[3] = a[0][3];
        groups[g].varying[0] = a[1][0];
        groups[g].varying[1] = a[2][1];
        groups[g].varying[2] = a[3][2];
        groups[g].varying[3] = a[4][0];
    }
}

static void put(unsigned char *data, size_t at, const void *value, size_t size)
{
    memcpy(data + at, value, size);
}

// Buffer 0: positions, stride 19, attribute offset 3, bound at 5. Buffer 1: a half and two bytes interleaved,
// stride 7. Buffer 2: per instance. Buffer 3: constant. None is aligned to anything.
static void bind_scattered(struct rig *rig, rhw_buffer buffers[4])
{
    static const float corners[3][2] = {{-1, -0.25f}, {-0.5f, -0.25f}, {-1, 0.25f}};
    unsigned char data[4][512];
    memset(data, 0x5b, sizeof data);
    for (int i = 0; i < 3; i++) {
        const size_t at = (size_t)i;
        put(data[0], 5 + at * 19 + 3, corners[i], 8);
        put(data[1], 1 + at * 7 + 1, &(uint16_t){0x3c00}, 2); // half 1.0
        put(data[1], 1 + at * 7 + 4, &(uint8_t[2]){9, 51}, 2);
    }
    for (int i = 0; i < 6; i++) {
        const float instance[3] = {(float)(i % 4) * 0.5f, i < 4 ? 0.0f : 0.5f, (float)(i + 1)};
        put(data[2], (size_t)i * 13 + 1, instance, 12);
    }
    put(data[3], 7, &(int16_t){-1234}, 2);
    const size_t offsets[4] = {5, 1, 0, 7};
    for (int b = 0; b < 4; b++) {
        struct rhw_buffer_def def = rhw_buffer_def_default();
        def.size = sizeof data[b];
        def.data = data[b];
        assert_int_equal(rhw_buffer_create(rig->context, &def, &buffers[b]), RHW_OK);
        rhw_pass_set_vertex_buffer(rig->context, rig->recording, b, buffers[b], offsets[b]);
    }
}

static void test_buffers_strides_offsets_and_instances(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_program(&rig, sum_vertex, rig_fragment_pass);
    rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
    const struct rhw_attribute attributes[5] = {
        {RHW_VERTEX_FLOAT2, 0, 3}, {RHW_VERTEX_HALF1, 1, 1},       {RHW_VERTEX_UNORM8X2, 1, 4},
        {RHW_VERTEX_FLOAT3, 2, 1}, {RHW_VERTEX_SSCALED16X1, 3, 0},
    };
    memcpy(rig.pipeline.attributes, attributes, sizeof attributes);
    rig.pipeline.attribute_count = 5;
    rig.pipeline.buffer_count = 4;
    rig.pipeline.buffers[0] = (struct rhw_vertex_layout){.stride = 19};
    rig.pipeline.buffers[1] = (struct rhw_vertex_layout){.stride = 7};
    rig.pipeline.buffers[2] = (struct rhw_vertex_layout){.stride = 13, .per_instance = true};
    rig.pipeline.buffers[3] = (struct rhw_vertex_layout){.constant = true};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_buffer buffers[4];
    bind_scattered(&rig, buffers);
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 1, 5); // instances 1 to 5
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < 6; i++) {
        // Instance i stands i % 4 quarters to the right; 4 and 5 a quarter higher. Its lower left pixel:
        const int x = i % 4 * 16, y = (i < 4 ? 40 : 24) - 1;
        const float *seen = pixels[y * SIZE + x];
        assert_true(seen[0] == (i == 0 ? 0.0f : 1.0f));
        assert_true(fabs((double)seen[1] - (i == 0 ? 0.0 : 51 / 255.0)) <= rig_ulp(0.2));
        assert_true(seen[2] == (i == 0 ? 0.0f : (float)(i + 1)));
        assert_true(seen[3] == (i == 0 ? 0.0f : -1234.0f));
    }
    assert_int_equal(rig.stats.triangles_rasterized, 5);
    for (int b = 0; b < 4; b++) {
        rhw_buffer_destroy(rig.context, buffers[b]);
    }
    rig_close(&rig);
}

// Instance 2 + i fills pixel i of a target one pixel high: its element and its index.
static void instance_vertex(struct rhw_vertex *groups, int count)
{
    static const float corners[3][2] = {{0, -1}, {0, 3}, {2, -1}};
    for (int g = 0; g < count; g++) {
        struct rhw_vertex *const v = &groups[g];
        for (int lane = 0; lane < RHW_LANES; lane++) {
            const float *const corner = corners[v->vertex_index[lane]];
            const float x = (float)(v->instance_index[lane] - 2) + corner[0];
            v->position[0][lane] = x / 7 * 2 - 1;
            v->position[1][lane] = corner[1];
        }
        v->position[2] = rhw_splat(0);
        v->position[3] = rhw_splat(1);
        v->varying[0] = v->attribute[0][0];
        v->varying[1] = rhw_float_from_int(v->instance_index);
        v->varying[2] = v->varying[3] = rhw_splat(0);
    }
}

// Element first_instance + ⌊i / step⌋ of instance first_instance + i: Vulkan's rule, by hand.
static void test_instances_share_elements(void **state)
{
    (void)state;
    enum { INSTANCES = 7 };
    for (uint32_t step = 0; step <= 8; step++) {
        struct rig rig;
        rig_open(&rig, INSTANCES, 1);
        rig_set_program(&rig, instance_vertex, rig_fragment_pass);
        rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
        rig.pipeline.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT1, 0, 0};
        rig.pipeline.attribute_count = 1;
        rig.pipeline.buffers[0] = (struct rhw_vertex_layout){.per_instance = true, .instance_step = step};
        const float data[2 + INSTANCES] = {10, 11, 12, 13, 14, 15, 16, 17, 18};
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, data, sizeof data);
        rhw_pass_draw(rig.context, rig.recording, 0, 3, 2, INSTANCES);
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (uint32_t i = 0; i < INSTANCES; i++) {
            assert_true(pixels[i][0] == (float)(12 + (step == 0 ? i : i / step)));
            assert_true(pixels[i][1] == (float)(2 + i)); // the index itself counts every instance
        }
        rig_close(&rig);
    }
    struct rig rig;
    rig_open(&rig, 8, 8);
    rig.pipeline.buffers[0].instance_step = 2;
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig,
                      "buffers[0].instance_step is 2; it must be 0 in a buffer that is not per_instance");
    rig_close(&rig);
}

// The attribute of the last triangle ends 0 to 12 bytes short of its buffer's end; what is not whole there
// reads zeros, and 1 in the channel that the format lacks.
static void test_an_element_that_ends_beyond_its_buffer(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig.pipeline.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, 0};
    rig.pipeline.buffers[0].stride = 12;
    float data[30];
    for (int i = 0; i < 30; i++) {
        data[i] = (float)(i + 1);
    }
    for (size_t cut = 0; cut <= 12; cut++) {
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, data, 7 * 12 - cut); // vertices 0..6; 6 provokes triangle 2
        rhw_pass_draw(rig.context, rig.recording, 0, 9, 0, 1);
        rig_end(&rig);
        const float(*pixels)[4] = rig_read_float4(&rig);
        for (int n = 0; n < 3; n++) {
            const bool whole = n < 2 || cut == 0;
            for (int c = 0; c < 3; c++) {
                assert_true(pixels[n][c] == (whole ? (float)(n * 9 + c + 1) : 0.0f));
            }
            assert_true(pixels[n][3] == 1);
        }
    }
    rig_close(&rig);
}

static void test_a_buffer_bound_beyond_its_end(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    rig.pipeline.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, 0xffffffe0};
    rig.pipeline.buffers[0].stride = 0xffffffff;
    const float data[4] = {1, 2, 3, 4};
    memcpy(rig.pass.colors[0].clear, data, sizeof data);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, data, sizeof data);
    rhw_pass_draw(rig.context, rig.recording, 3, 3, 0, 1);
    rig_end(&rig);
    const float *seen = rig_read_float4(&rig)[1];
    assert_true(seen[0] == 0 && seen[1] == 0 && seen[2] == 0 && seen[3] == 0);
    rig_close(&rig);
}

// Attributes reach into the elements behind theirs, as they do where a stride is shorter than a vertex.
static void test_attributes_beyond_their_stride(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig);
    float data[24];
    for (int i = 0; i < 24; i++) {
        data[i] = (float)(i + 1);
    }
    for (uint32_t stride = 1; stride <= 8; stride++) {
        for (uint32_t offset = 0; offset <= 32; offset += 16) {
            rig.pipeline.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offset};
            rig.pipeline.buffers[0].stride = 4 * stride;
            rig_begin(&rig);
            rig_use_pipeline(&rig);
            rig_use_vertices(&rig, 0, data, sizeof data);
            rhw_pass_draw(rig.context, rig.recording, 0, 9, 0, 1);
            rig_end(&rig);
            const float(*pixels)[4] = rig_read_float4(&rig);
            for (uint32_t n = 0; n < 3; n++) {
                const uint32_t first = 3 * n * stride + offset / 4; // of the vertex that provokes triangle n
                for (uint32_t c = 0; c < 4; c++) {
                    assert_true(pixels[n][c] == (first + 4 <= 24 ? (float)(first + c + 1) : 0.0f));
                }
            }
        }
    }
    rig_close(&rig);
}

// A stride and a divisor of 0, as Vulkan has them: element 0 for all vertices of all instances, and element
// first_instance for all instances of a draw.
static void test_elements_that_all_share(void **state)
{
    (void)state;
    enum { INSTANCES = 7 };
    for (int divisor = 0; divisor < 2; divisor++) {
        struct rig rig;
        rig_open(&rig, INSTANCES, 1);
        rig_set_program(&rig, instance_vertex, rig_fragment_pass);
        rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
        rig.pipeline.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT1, 0, 4};
        rig.pipeline.attribute_count = 1;
        rig.pipeline.buffers[0] =
            (struct rhw_vertex_layout){.constant = true, .per_instance = divisor, .stride = divisor ? 8 : 0};
        const float data[] = {10, 11, 12, 13, 14, 15, 16, 17};
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rig_use_vertices(&rig, 0, data, sizeof data);
        rhw_pass_draw(rig.context, rig.recording, 0, 3, 2, INSTANCES);
        rig_end(&rig);
        for (uint32_t i = 0; i < INSTANCES; i++) {
            assert_true(rig_read_float4(&rig)[i][0] == (divisor ? 15.0f : 11.0f));
        }
        rig_close(&rig);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_attributes_beyond_their_stride),
    cmocka_unit_test(test_elements_that_all_share),
    cmocka_unit_test(test_every_format),
    cmocka_unit_test(test_sizes),
    cmocka_unit_test(test_buffers_strides_offsets_and_instances),
    cmocka_unit_test(test_instances_share_elements),
    cmocka_unit_test(test_an_element_that_ends_beyond_its_buffer),
    cmocka_unit_test(test_a_buffer_bound_beyond_its_end),
};

const struct unit_tests test_vertex_input = UNIT_TESTS(tests, NULL, NULL);
