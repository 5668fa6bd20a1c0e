// SPDX-License-Identifier: MIT
// Memory of shaders: numbers of 8 and 16 bits, layouts of matrices, arrays that indices pick from, sizes of workgroups.
#include "spirv_run.h"

#include <math.h>
#include <stdlib.h>

#include "edges_comp.h"
#include "indexed_comp.h"
#include "indexed_comp_small.h"
#include "keep_comp.h"
#include "layout_comp.h"
#include "narrow_comp.h"

// Numbers of 8 and 16 bits ---------------------------------------------------------------------------

struct record {
    uint8_t a;
    int8_t b;
    uint16_t c;
    uint16_t d; // a half
    int16_t e;
};

static double half_to_double(uint16_t half)
{
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    const double size = exponent == 0 ? ldexp(fraction, -24) : ldexp(1024 + fraction, exponent - 25);
    return half & 0x8000 ? -size : size;
}

// Return the finite half that is nearest, the even one of two.
static uint16_t nearest_half(double value)
{
    uint16_t best = 0;
    for (uint32_t half = 0; half < 0x7c00; half++) {
        const double apart = fabs(half_to_double((uint16_t)half) - fabs(value));
        const double least = fabs(half_to_double(best) - fabs(value));
        if (apart < least || (apart == least && half % 2 == 0)) {
            best = (uint16_t)half;
        }
    }
    return (uint16_t)(best | (value < 0 ? 0x8000 : 0));
}

enum { RECORDS = 128 };

// All memory that narrow.comp sees.
struct narrow_memory {
    struct record records[RECORDS], copies[RECORDS];
    uint8_t bytes[RECORDS];
    uint16_t halves[RECORDS];
    int32_t whole[RECORDS][4];
    int16_t vectors[RECORDS][4];
};

static void fill_narrow(struct narrow_memory *memory)
{
    uint64_t state = 7;
    memset(memory, 0x55, sizeof *memory);
    for (int i = 0; i < RECORDS; i++) {
        const uint64_t bits = rig_random(&state);
        memcpy(&memory->records[i], &bits, sizeof bits);
        memory->records[i].d = (uint16_t)(bits >> 32 & 0x8bff) | (uint16_t)(12 << 10);
    }
}

static void test_narrow_numbers_are_loaded_converted_and_stored(void **state)
{
    (void)state;
    const struct {
        uint16_t more;
        int8_t less;
        uint16_t scale;
    } push = {20000, -100, nearest_half(1.5)};
    struct narrow_memory *const memory = malloc(sizeof *memory);
    fill_narrow(memory);
    const struct spirv_bytes bindings[] = {
        {memory->records, sizeof memory->records, true},  {memory->bytes, sizeof memory->bytes, false},
        {memory->halves, sizeof memory->halves, false},   {memory->whole, sizeof memory->whole, false},
        {memory->vectors, sizeof memory->vectors, false}, {memory->copies, sizeof memory->copies, false},
    };
    spirv_run(SPIRV_CREATE(narrow_comp, RHW_SHADER_COMPUTE), bindings, 6, &push, sizeof push, RECORDS / 64);
    for (int i = 0; i < RECORDS; i++) {
        const struct record *const r = &memory->records[i];
        assert_int_equal(memory->whole[i][0], r->a + 20000);
        assert_int_equal(memory->whole[i][1], r->b - 100);
        assert_int_equal(memory->whole[i][2], r->c);
        assert_int_equal(memory->whole[i][3], r->e);
        assert_int_equal(memory->bytes[i], (uint8_t)((uint32_t)r->b + r->c));
        const float sum = (float)half_to_double(r->d) * 1.5f + (float)(1.0 / 3.0);
        assert_int_equal(memory->halves[i], nearest_half((double)sum));
        for (int c = 0; c < 4; c++) {
            static const int factors[4] = {1, -1, 3, 70000};
            assert_int_equal(memory->vectors[i][c],
                             (int16_t)(uint16_t)((uint32_t)r->e * (uint32_t)factors[c]));
        }
    }
    assert_memory_equal(memory->records, memory->copies, sizeof memory->records);
    free(memory);
}

// Push constants may end within a word. What is not given reads as 0.
static void test_narrow_push_constants_end_within_a_word(void **state)
{
    (void)state;
    const uint16_t push[3] = {5, 0x0080, 0xffff};
    struct narrow_memory *const memory = malloc(sizeof *memory);
    fill_narrow(memory);
    const struct spirv_bytes bindings[] = {
        {memory->records, sizeof memory->records, true},  {memory->bytes, sizeof memory->bytes, false},
        {memory->halves, sizeof memory->halves, false},   {memory->whole, sizeof memory->whole, false},
        {memory->vectors, sizeof memory->vectors, false}, {memory->copies, sizeof memory->copies, false},
    };
    spirv_run(SPIRV_CREATE(narrow_comp, RHW_SHADER_COMPUTE), bindings, 6, push, 3, 1);
    assert_int_equal(memory->whole[3][0], memory->records[3].a + 5);
    assert_int_equal(memory->whole[3][1], memory->records[3].b - 128);
    assert_int_equal(memory->halves[3], nearest_half(1.0 / 3.0));
    assert_int_equal(memory->bytes[64], 0x55); // of the workgroup that did not run
    free(memory);
}

// Arrays ---------------------------------------------------------------------------------------------

struct pair {
    int32_t a[2];
    float b[3];
};

// The source of indexed.comp in C, for an invocation whose workgroup has these values.
static void model_indexed(const int32_t *given, int lane, int32_t result[8])
{
    const int own = given[lane];
    static int numbers[100];
    int array[100] = {0}, m[4][4] = {{0}};
    result[0] = 0;
    for (int i = 0; i < 100; i++) {
        numbers[i] = (i * own) ^ i;
    }
    numbers[own * 2] = -5;
    for (int i = own; i < 100; i += 3) {
        result[0] += numbers[i];
    }
    int small[4] = {own, 2, 3, 5};
    small[own & 3] += 100;
    result[1] = own * own + small[0] * 1000 + small[(own + 1) & 3];
    for (int k = 0; k < 100; k++) {
        array[(k * own) % 100] += k;
    }
    result[2] = array[own];
    result[3] = (own % 10 == 3 ? own : 0) * 10 + 8; // b of the two others is 0
    const int opposite = given[31 - lane], next = given[(lane + 5) % 32];
    result[4] = opposite * opposite;
    struct pair pair = {{0, 0}, {0, 0, 0}};
    pair.a[next & 1] = (lane + 5) % 32;
    pair.b[next % 3] = (float)next;
    result[5] = pair.a[0] * 100 + pair.a[1] * 10 + (int)(pair.b[0] + pair.b[1] + pair.b[2]);
    for (int i = 0; i < 4; i++) {
        m[i][i] = 1;
    }
    m[own & 3][(own + 1) & 3] = 7;
    result[6] = m[own & 3][(own + 1) & 3] * 10 + m[own & 3][own & 3];
    result[7] = 100 * (own % 3) + 10 * (own % 4) + own % 5;
}

static void check_indexed(const uint32_t *words, size_t size)
{
    int32_t source[64], sink[64][8];
    for (int i = 0; i < 64; i++) {
        source[i] = i * 37 % 40;
    }
    const struct spirv_bytes bindings[] = {{source, sizeof source, true}, {sink, sizeof sink, false}};
    spirv_run(spirv_create(words, size, RHW_SHADER_COMPUTE), bindings, 2, NULL, 0, 2);
    for (int i = 0; i < 64; i++) {
        int32_t expected[8];
        model_indexed(source + i / 32 * 32, i % 32, expected);
        for (int r = 0; r < 8; r++) {
            if (sink[i][r] != expected[r]) {
                fail_msg("invocation %d, result %d: %d, not %d", i, r, (int)sink[i][r], (int)expected[r]);
            }
        }
    }
}

static void test_indices_pick_from_arrays_of_every_kind(void **state)
{
    (void)state;
    check_indexed(indexed_comp, sizeof indexed_comp);
    check_indexed(indexed_comp_small, sizeof indexed_comp_small);
}

// Layouts --------------------------------------------------------------------------------------------

// Bytes of a block of layout.comp, by columns or by rows of 16 bytes: element c, r of a matrix at its offset.
static float element(const float *block, int offset, bool is_row_major, int c, int r)
{
    return block[offset / 4 + (is_row_major ? 4 * r + c : 4 * c + r)];
}

static void test_matrices_lie_by_columns_and_by_rows(void **state)
{
    (void)state;
    enum { X = 6, Y = 4, INVOCATIONS = X * Y };
    // Offsets of a, b and inner in each block. Columns of a: 4 of 16 bytes; rows: 3.
    static const int offsets[2][3] = {{0, 64, 160}, {0, 48, 144}};
    float blocks[2][64];
    struct {
        float whole[3][4]; // 3 rows of 4
        float parts[3][2][2];
        float pad[3];
        float results[INVOCATIONS][4][4];
    } sink;
    (void)sink.pad;
    for (int i = 0; i < 64; i++) {
        blocks[0][i] = (float)i;
        blocks[1][i] = (float)(100 + i);
    }
    const struct rhw_shader_constant sizes[] = {{.id = 3, .value = X}, {.id = 4, .value = Y}};
    rhw_shader *const shader =
        spirv_specialize(layout_comp, sizeof layout_comp, RHW_SHADER_COMPUTE, sizes, 2);
    const uint32_t *const size = rhw_shader_get_info(shader)->size;
    assert_int_equal(size[0], X);
    assert_int_equal(size[1], Y);
    assert_int_equal(size[2], 1);
    float memory[(48 + 48) / 4 + INVOCATIONS * 16];
    const struct spirv_bytes bindings[] = {{blocks[0], sizeof blocks[0], true},
                                           {blocks[1], sizeof blocks[1], true},
                                           {memory, sizeof memory, false}};
    spirv_run(shader, bindings, 3, NULL, 0, 1);
    for (int i = 0; i < INVOCATIONS; i++) {
        const int k = i % 4, r = i % 3, c = i % 2;
        const float *const result = memory + 24 + 16 * i;
        for (int block = 0; block < 2; block++) {
            const int *const at = offsets[block];
            for (int row = 0; row < 3; row++) {
                assert_true(result[4 * block + row] == element(blocks[block], at[0], block, k, row));
            }
            assert_true(result[4 * block + 3] == element(blocks[block], at[0], block, k, r));
            for (int row = 0; row < 2; row++) {
                assert_true(result[8 + 2 * block + row] ==
                            element(blocks[block], at[1] + 32 * r, block, c, row));
                const int inner = at[2] + c * (block ? 32 : 48);
                assert_true(result[12 + 2 * block + row] == element(blocks[block], inner, block, r, row));
            }
        }
    }
    for (int column = 0; column < 4; column++) { // of the first matrix, which lies by rows of 16 bytes now
        for (int row = 0; row < 3; row++) {
            assert_true(memory[4 * row + column] == element(blocks[0], 0, false, column, row));
        }
    }
    for (int m = 0; m < 3; m++) {
        for (int e = 0; e < 4; e++) {
            const float expected = m == 1 && e / 2 == 1 ? (float)(e % 2 ? Y : X)
                                                        : element(blocks[1], 48 + 32 * m, true, e / 2, e % 2);
            assert_true(memory[12 + 4 * m + 2 * (e % 2) + e / 2] == expected);
        }
    }
}

// Sizes ----------------------------------------------------------------------------------------------

static void expect_size_refused(uint32_t x, uint32_t y)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    const struct rhw_shader_constant sizes[] = {{.id = 3, .value = x}, {.id = 4, .value = y}};
    const struct rhw_shader_def def = {.stage = RHW_SHADER_COMPUTE, .constants = sizes, .constant_count = 2};
    assert_int_equal(rhw_shader_create(layout_comp, sizeof layout_comp, &def, &shader, message),
                     RHW_ERROR_MISUSE);
    assert_non_null(strstr(message, "1024 invocations"));
}

static void test_sizes_of_workgroups_are_specialized_and_bounded(void **state)
{
    (void)state;
    const struct rhw_shader_constant sizes[] = {{.id = 3, .value = 64}, {.id = 4, .value = 16}};
    rhw_shader *const shader =
        spirv_specialize(layout_comp, sizeof layout_comp, RHW_SHADER_COMPUTE, sizes, 2);
    rhw_shader_program *const program = spirv_link(NULL, NULL, shader);
    assert_int_equal(rhw_shader_program_get_compute(program)->size[0], 64);
    assert_int_equal(rhw_shader_program_get_compute(program)->size[1], 16);
    rhw_shader_program_destroy(program);
    expect_size_refused(64, 17);
    expect_size_refused(0, 4);
    expect_size_refused(65536, 65536);
}

// What invocations keep from barrier to barrier ----------------------------------------------------------

static rhw_shader *create_keep(uint32_t invocations, uint32_t words)
{
    const struct rhw_shader_constant constants[] = {{.id = 0, .value = invocations},
                                                    {.id = 1, .value = words}};
    return spirv_specialize(keep_comp, sizeof keep_comp, RHW_SHADER_COMPUTE, constants, 2);
}

static uint32_t kept_of(uint32_t i, uint32_t k)
{
    return i * (k + 3) ^ k;
}

static void expect_kept(uint32_t invocations, uint32_t words)
{
    static uint32_t sink[2048];
    const struct spirv_bytes memory = {.bytes = sink, .size = sizeof sink};
    memset(sink, 0, sizeof sink);
    spirv_run(create_keep(invocations, words), &memory, 1, NULL, 0, 3);
    for (uint32_t i = 0; i < invocations; i++) {
        const uint32_t beside = (i + 1) % invocations;
        uint32_t sum = kept_of(beside, beside % words);
        for (uint32_t k = 0; k < words; k++) {
            sum = 31 * sum + kept_of(i, k);
        }
        assert_int_equal(sink[i], sum);
    }
    assert_int_equal(sink[invocations], 0);
}

// On the stack, and beyond it.
static void test_workgroups_keep_what_they_need(void **state)
{
    (void)state;
    expect_kept(64, 8);
    expect_kept(1024, 64);
    expect_kept(1001, 900);
}

static void test_what_workgroups_keep_is_bounded(void **state)
{
    (void)state;
    const struct rhw_shader_constant constants[] = {{.id = 0, .value = 1024}, {.id = 1, .value = 1100}};
    const struct rhw_shader_def def = {
        .stage = RHW_SHADER_COMPUTE, .constants = constants, .constant_count = 2};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    assert_int_equal(rhw_shader_create(keep_comp, sizeof keep_comp, &def, &shader, message),
                     RHW_ERROR_MISUSE);
    assert_non_null(strstr(message, "from barrier to barrier: more than 4096"));
    rhw_shader_program *const program = spirv_link(NULL, NULL, create_keep(1024, 64));
    char *text;
    const struct rhw_shader_c_def c = {.name = "keep"};
    assert_int_equal(rhw_shader_program_emit_c(program, &c, &text, message), RHW_ERROR_MISUSE);
    assert_non_null(strstr(message, "C has room for 128 of 1024 invocations"));
    rhw_shader_program_destroy(program);
}

// Words behind one another are read one by one where some lie outside, and an offset of 32 bits begins again at 0.
static void test_words_at_the_edge_of_a_buffer(void **state)
{
    enum { WORDS = 7, LANES = 8 };
    static const uint32_t last = UINT32_MAX / 12; // its first word lies at the end of all offsets
    static const uint32_t elements[] = {0, 1, 2, 3, 100, last};
    static const uint32_t from[WORDS] = {11, 12, 13, 14, 15, 16, 17};
    (void)state;
    for (size_t i = 0; i < sizeof elements / sizeof *elements; i++) {
        uint32_t to[LANES][4];
        const struct spirv_bytes memory[] = {{(void *)(uintptr_t)from, sizeof from, true},
                                             {to, sizeof to, false}};
        spirv_run(SPIRV_CREATE(edges_comp, RHW_SHADER_COMPUTE), memory, 2, &elements[i], sizeof *elements, 1);
        for (int c = 0; c < 4; c++) {
            const uint32_t word = c == 3 ? 5 : (elements[i] * 12 + 4 * (uint32_t)c) / 4;
            assert_int_equal(to[0][c], word < WORDS ? from[word] : 0);
            assert_int_equal(to[LANES - 1][c], to[0][c]);
        }
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_narrow_numbers_are_loaded_converted_and_stored),
    cmocka_unit_test(test_narrow_push_constants_end_within_a_word),
    cmocka_unit_test(test_indices_pick_from_arrays_of_every_kind),
    cmocka_unit_test(test_matrices_lie_by_columns_and_by_rows),
    cmocka_unit_test(test_sizes_of_workgroups_are_specialized_and_bounded),
    cmocka_unit_test(test_workgroups_keep_what_they_need),
    cmocka_unit_test(test_what_workgroups_keep_is_bounded),
    cmocka_unit_test(test_words_at_the_edge_of_a_buffer),
};

const struct unit_tests test_spirv_memory = UNIT_TESTS(tests, NULL, NULL);
