// SPDX-License-Identifier: MIT
// Passes over the form make it shorter, and change no bit.
#include <math.h>
#include <rhw/shader_math.h>

#include "passes_comp.h"
#include "spirv_run.h"

static char printed[1 << 14];

static void keep(void *user, const char *text, size_t size)
{
    size_t *const length = user;
    assert_true(*length + size < sizeof printed);
    memcpy(printed + *length, text, size);
    *length += size;
    printed[*length] = 0;
}

// Return how often an operation stands in the form, by its name.
static int count_operations(const char *name)
{
    int count = 0;
    for (const char *at = strstr(printed, name); at; at = strstr(at + 1, name)) {
        count++;
    }
    return count;
}

static void test_what_is_not_needed_goes(void **state)
{
    (void)state;
    size_t length = 0;
    const struct rhw_shader_def def = {.stage = RHW_SHADER_COMPUTE};
    assert_int_equal(
        rhw_shader_print(passes_comp, sizeof passes_comp, &def, RHW_SHADER_PASSED, keep, &length, NULL),
        RHW_OK);
    assert_int_equal(count_operations("= sin "), 1);
    assert_int_equal(count_operations("= fdiv "), 1);
    assert_int_equal(count_operations("= fsub "), 0);
    assert_int_equal(count_operations("= not "), 1);
    assert_int_equal(count_operations("= xor "), 2); // one of them of the remainder
    assert_int_equal(count_operations("= imul "), 0);
    assert_int_equal(count_operations("= udiv "), 0);
    assert_int_equal(count_operations("= urem "), 0);
    assert_int_equal(count_operations("= idiv "), 1);
    assert_int_equal(count_operations("= load "), 3); // of source, and of two uniforms
}

static uint32_t bits_of(float number)
{
    uint32_t bits;
    memcpy(&bits, &number, sizeof bits);
    return bits;
}

enum { RESULTS = 20 };

static void compute(float x, const float scale[4], uint32_t expected[RESULTS])
{
    const uint32_t u = bits_of(x);
    const int32_t i = (int32_t)u;
    const float third = x / 3.0f, product = x * scale[0];
    const float sine = rhw_sin(rhw_splat(product))[0];
    const float scaled = sine * scale[1], b = x > 0.5f ? scale[1] + sine : scale[1];
    const uint32_t values[RESULTS] = {
        u,
        u,
        u,
        bits_of(x / 8.0f),
        bits_of(x / -0.25f),
        u,
        u,
        u + 2,
        u * 16,
        u / 4,
        u % 8,
        u ^ 3,
        1,
        bits_of(x + 0.0f),
        bits_of(x * 0.0f),
        bits_of(third),
        (uint32_t)(i / 4),
        (uint32_t)(i % 8),
        bits_of(sine),
        bits_of(b + scaled),
    };
    memcpy(expected, values, sizeof values);
}

static void test_bits_stay(void **state)
{
    (void)state;
    // Zeros, numbers without an exponent of their own, infinity, and others.
    static const float sources[8] = {0, -0.0f, 1e-40f, -1e-41f, INFINITY, 0.75f, -3e38f, 2.5f};
    static const struct {
        float scale[4];
        int32_t whole[4];
    } constants = {{1.5f, 0.3f, 0, 0}, {0}};
    uint32_t results[RESULTS][8];
    rhw_shader_program *const program = spirv_link(NULL, NULL, SPIRV_CREATE(passes_comp, RHW_SHADER_COMPUTE));
    const struct rhw_binding set[3] = {spirv_memory((void *)&constants, sizeof constants),
                                       spirv_memory((void *)sources, sizeof sources),
                                       spirv_memory(results, sizeof results)};
    struct rig rig;
    rig_open(&rig, 4, 4);
    assert_int_equal(spirv_dispatch(&rig, program, &(struct rhw_shader_frame){.sets = {set}}, 1), RHW_OK);
    for (int lane = 0; lane < 8; lane++) {
        uint32_t expected[RESULTS];
        compute(sources[lane], constants.scale, expected);
        for (int r = 0; r < RESULTS; r++) {
            float number;
            memcpy(&number, &expected[r], sizeof number);
            const bool is_nan = r >= 13 && isnan(number); // which NaN it is differs from machine to machine
            if (!is_nan && results[r][lane] != expected[r]) {
                fail_msg("result %d of %g: %08x for %08x", r, (double)sources[lane], results[r][lane],
                         expected[r]);
            }
        }
    }
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_what_is_not_needed_goes),
    cmocka_unit_test(test_bits_stay),
};

const struct unit_tests test_spirv_passes = UNIT_TESTS(tests, NULL, NULL);
