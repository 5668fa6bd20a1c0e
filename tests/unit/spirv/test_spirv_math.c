// SPDX-License-Identifier: MIT
// The transcendental functions of GLSL.std.450 against MPFR. The bounds are those of shader_math.h and its kin, far inside
// Vulkan's (Vulkan 1.3, "Precision of GLSL.std.450 Instructions"): a wrong function or operands in the wrong order show.
#include <math.h>
#include <mpfr.h>
#include <string.h>

#include "function_rig.h"
#include "harness.h"
#include "math_reference.h"

enum { COUNT = 512 };

struct function {
    const char *name;
    int (*exact)(mpfr_t result, const mpfr_t a, mpfr_rnd_t rounding);
    float low, high;
};

// By number, as in functions.comp.
static const struct function functions[] = {
    {"sin", mpfr_sin, -3.2f, 3.2f}, {"cos", mpfr_cos, -3.2f, 3.2f},
    {"tan", mpfr_tan, -1.5f, 1.5f}, {"asin", mpfr_asin, -1, 1},
    {"acos", mpfr_acos, -1, 1},     {"atan", mpfr_atan, -50, 50},
    {"sinh", mpfr_sinh, -20, 20},   {"cosh", mpfr_cosh, -20, 20},
    {"tanh", mpfr_tanh, -8, 8},     {"asinh", mpfr_asinh, -1000, 1000},
    {"acosh", mpfr_acosh, 1, 1000}, {"atanh", mpfr_atanh, -0.999f, 0.999f},
    {"exp", mpfr_exp, -80, 80},     {"log", mpfr_log, 1e-30f, 100},
    {"exp2", mpfr_exp2, -120, 120}, {"log2", mpfr_log2, 1e-30f, 100},
    {"sqrt", mpfr_sqrt, 0, 1000},   {"inversesqrt", mpfr_rec_sqrt, 1e-3f, 1000},
};

static void expect_near(const char *name, const float operands[4], uint32_t bits, const mpfr_t want)
{
    float got;
    memcpy(&got, &bits, sizeof got);
    const double error = math_ulp_error(got, want);
    if (!(error <= 4)) {
        fail_msg("%s(%a, %a) is %a, %g ULP away", name, (double)operands[0], (double)operands[1], (double)got,
                 error);
    }
}

static void test_functions_of_one_operand(void **state)
{
    (void)state;
    static float operands[COUNT][4];
    static uint32_t results[COUNT][4];
    uint64_t random = 1;
    mpfr_t a, want;
    mpfr_inits2(200, a, want, NULL);
    for (int f = 0; f < (int)(sizeof functions / sizeof *functions); f++) {
        for (int i = 0; i < COUNT; i++) {
            operands[i][0] = rig_random_float(&random, functions[f].low, functions[f].high);
        }
        function_rig_run(f, (const float(*)[4])operands, COUNT, false, results);
        for (int i = 0; i < COUNT; i++) {
            mpfr_set_flt(a, operands[i][0], MPFR_RNDN);
            (void)functions[f].exact(want, a, MPFR_RNDN);
            expect_near(functions[f].name, operands[i], results[i][0], want);
        }
    }
    mpfr_clears(a, want, NULL);
}

static void test_functions_of_two_operands(void **state)
{
    (void)state;
    static float operands[COUNT][4];
    static uint32_t results[COUNT][4];
    uint64_t random = 2;
    mpfr_t a, b, want;
    mpfr_inits2(200, a, b, want, NULL);
    for (int f = 18; f < 20; f++) {
        for (int i = 0; i < COUNT; i++) {
            operands[i][0] = rig_random_float(&random, f == 18 ? -10 : 0.01f, 10);
            operands[i][1] = rig_random_float(&random, -10, 10);
        }
        function_rig_run(f, (const float(*)[4])operands, COUNT, false, results);
        for (int i = 0; i < COUNT; i++) {
            mpfr_set_flt(a, operands[i][0], MPFR_RNDN);
            mpfr_set_flt(b, operands[i][1], MPFR_RNDN);
            (void)(f == 18 ? mpfr_atan2 : mpfr_pow)(want, a, b, MPFR_RNDN);
            expect_near(f == 18 ? "atan2" : "pow", operands[i], results[i][0], want);
        }
    }
    mpfr_clears(a, b, want, NULL);
}

// What is computed together has the bits of each alone, numbers among them that are reduced lane by lane.
static void test_sine_and_cosine_together(void **state)
{
    (void)state;
    static float operands[COUNT][4];
    static uint32_t sines[COUNT][4], cosines[COUNT][4], both[COUNT][4];
    uint64_t random = 3;
    for (int i = 0; i < COUNT; i++) {
        operands[i][0] = rig_random_float(&random, -1, 1) * (i % 3 == 0 ? 1e6f : 10.0f);
    }
    function_rig_run(0, (const float(*)[4])operands, COUNT, false, sines);
    function_rig_run(1, (const float(*)[4])operands, COUNT, false, cosines);
    for (int first = 0; first < 2; first++) {
        function_rig_run(48 + first, (const float(*)[4])operands, COUNT, false, both);
        for (int i = 0; i < COUNT; i++) {
            assert_int_equal(both[i][first], sines[i][0]);
            assert_int_equal(both[i][1 - first], cosines[i][0]);
        }
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_functions_of_one_operand),
    cmocka_unit_test(test_functions_of_two_operands),
    cmocka_unit_test(test_sine_and_cosine_together),
};

const struct unit_tests test_spirv_math = UNIT_TESTS(tests, NULL, NULL);
