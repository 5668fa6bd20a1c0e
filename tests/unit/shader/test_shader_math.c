// SPDX-License-Identifier: MIT
// The elementary functions of shader_math.h against MPFR, at the error their header states; the lane
// arithmetic of shader_vector.h against C; and every instruction set against the baseline, bit for bit.
#include "float_bits.h"
#include "harness.h"
#include "isa_templates.h"
#include "math_reference.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH = 4096 };

// Error measurement ---------------------------------------------------------------------------------

struct worst {
    double ulp;
    float a, b, got;
};

static void note(struct worst *worst, double ulp, float a, float b, float got)
{
    if (ulp > worst->ulp) {
        *worst = (struct worst){ulp, a, b, got};
    }
}

static struct worst measure(const struct math_function *row, const float *a, int count)
{
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    float result[BATCH];
    baseline->apply(row->function, a, a, result, count);
    struct worst worst = {-1, 0, 0, 0};
    mpfr_t exact;
    mpfr_init2(exact, 60);
    for (int i = 0; i < count; i++) {
        mpfr_set_flt(exact, a[i], MPFR_RNDN);
        row->exact(exact, exact, MPFR_RNDN);
        note(&worst, math_ulp_error(result[i], exact), a[i], 0, result[i]);
    }
    mpfr_clear(exact);
    return worst;
}

// A batch of arguments: all bit patterns evenly, the interval of most use, then what is special.
static void fill_arguments(float *a, int round, float low, float high)
{
    static const float special[] = {0.0f,      -0.0f,       1.0f,        -1.0f,       INFINITY, -INFINITY,
                                    NAN,       FLT_MIN,     -FLT_MIN,    FLT_MAX,     -FLT_MAX, 1e-45f,
                                    -1e-45f,   0.5f,        2.0f,        128.0f,      -149.0f,  -150.0f,
                                    88.72284f, -103.97208f, 1.57079637f, 3.14159274f, 32768.0f, 16367173.0f};
    uint64_t random = (uint64_t)round;
    for (int i = 0; i < BATCH; i++) {
        a[i] = i & 1 ? from_bits((uint32_t)rig_random(&random)) : rig_random_float(&random, low, high);
    }
    memcpy(a, special, sizeof special);
}

static void test_functions_keep_the_error_they_state(void **state)
{
    (void)state;
    for (int r = 0; r < MATH_FUNCTIONS; r++) {
        struct worst worst = {-1, 0, 0, 0};
        for (int round = 0; round < 12; round++) {
            float a[BATCH];
            fill_arguments(a, round, math_functions[r].low, math_functions[r].high);
            const struct worst here = measure(&math_functions[r], a, BATCH);
            note(&worst, here.ulp, here.a, 0, here.got);
        }
        print_message("%-6s %.3f ULP at %a\n", math_functions[r].name, worst.ulp, (double)worst.a);
        if (!(worst.ulp <= math_functions[r].stated)) {
            fail_msg("%s(%a) = %a is %.3f ULP off; the header states %.2f", math_functions[r].name,
                     (double)worst.a, (double)worst.got, worst.ulp, math_functions[r].stated);
        }
    }
}

// Arguments found by exhaustive search to be the worst, and those closest to multiples of π/2.
static void test_known_worst_arguments(void **state)
{
    (void)state;
    static const struct {
        enum isa_function function;
        float argument;
    } cases[] = {
        {ISA_EXP2, 0x1.3019a4p+3f},  {ISA_EXP, 0x1.819edap+5f},   {ISA_LOG2, 0x1.5b7f4cp+0f},
        {ISA_LOG, 0x1.913acep+0f},   {ISA_SIN, -0x1.a171e6p+43f}, {ISA_COS, -0x1.79a694p+9f},
        {ISA_TAN, -0x1.13881cp+72f}, {ISA_ATAN, 0x1.aa08f2p-2f},  {ISA_ASIN, 0x1.015c9ap-1f},
        {ISA_ACOS, 0x1.23f1p-1f},    {ISA_SIN, 0x1.921fb6p+1f},   {ISA_COS, 0x1.921fb6p+0f},
        {ISA_SIN, 0x1.6ac5b2p+62f},  {ISA_COS, 0x1.6ac5b2p+62f},  {ISA_TAN, 0x1.6ac5b2p+62f},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int r = 0; r < MATH_FUNCTIONS; r++) {
            if (math_functions[r].function == cases[i].function) {
                float a[RHW_LANES];
                for (int lane = 0; lane < RHW_LANES; lane++) {
                    a[lane] = cases[i].argument;
                }
                const struct worst worst = measure(&math_functions[r], a, RHW_LANES);
                if (!(worst.ulp <= math_functions[r].stated)) {
                    fail_msg("%s(%a) = %a is %.3f ULP off", math_functions[r].name, (double)worst.a,
                             (double)worst.got, worst.ulp);
                }
            }
        }
    }
}

// Two arguments -------------------------------------------------------------------------------------

static void fill_pairs(float *a, float *b, int round, bool power)
{
    uint64_t random = (uint64_t)(round + 100);
    for (int i = 0; i < BATCH; i++) {
        switch (i & 3) {
        case 0:
            a[i] = from_bits((uint32_t)rig_random(&random));
            b[i] = from_bits((uint32_t)rig_random(&random));
            break;
        case 1: // results all over the range
            a[i] = rig_random_float(&random, 0.01f, 30.0f);
            b[i] = power ? rig_random_float(&random, -150, 150) / log2f(a[i])
                         : rig_random_float(&random, -30, 30);
            break;
        case 2: // whole exponents, negative bases
            a[i] = rig_random_float(&random, -4, 4);
            b[i] = (float)rig_random_int(&random, 61) - 30.0f;
            break;
        default: // bases near 1, large exponents
            a[i] = 1.0f + rig_random_float(&random, -1e-3f, 1e-3f);
            b[i] = rig_random_float(&random, -60000, 60000);
            break;
        }
    }
}

static void check_pairs(const struct math_function2 *f, const float *a, const float *b, int count,
                        struct worst *worst)
{
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    float result[BATCH];
    baseline->apply(f->function, a, b, result, count);
    mpfr_t x, y;
    mpfr_init2(x, 60);
    mpfr_init2(y, 24);
    for (int i = 0; i < count; i++) {
        mpfr_set_flt(x, a[i], MPFR_RNDN);
        mpfr_set_flt(y, b[i], MPFR_RNDN);
        f->exact(x, x, y, MPFR_RNDN);
        const double ulp = math_ulp_error(result[i], x);
        note(worst, ulp, a[i], b[i], result[i]);
        if (!(ulp <= f->stated)) {
            fail_msg("%s(%a, %a) = %a is %.3f ULP off; the header states %.2f", f->name, (double)a[i],
                     (double)b[i], (double)result[i], ulp, f->stated);
        }
    }
    mpfr_clears(x, y, (mpfr_ptr)0);
}

static void test_pow_and_atan2_keep_the_error_they_state(void **state)
{
    (void)state;
    for (int f = 0; f < MATH_FUNCTIONS2; f++) {
        struct worst worst = {-1, 0, 0, 0};
        for (int round = 0; round < 10; round++) {
            float a[BATCH], b[BATCH];
            fill_pairs(a, b, round, math_functions2[f].function == ISA_POW);
            check_pairs(&math_functions2[f], a, b, BATCH, &worst);
        }
        print_message("%-6s %.3f ULP at %a, %a\n", math_functions2[f].name, worst.ulp, (double)worst.a,
                      (double)worst.b);
    }
}

static void test_special_cases_are_those_of_c(void **state)
{
    (void)state;
    static const float special[] = {0.0f, -0.0f,  1.0f,        -1.0f,        2.0f,        -2.0f,
                                    3.0f, -3.0f,  0.5f,        -0.5f,        INFINITY,    -INFINITY,
                                    NAN,  1e-45f, -1e-45f,     FLT_MAX,      -FLT_MAX,    1e30f,
                                    2.5f, -2.5f,  16777215.0f, -16777215.0f, 1.00000012f, 0.99999994f};
    enum { COUNT = sizeof special / sizeof special[0] };
    float a[COUNT * COUNT], b[COUNT * COUNT];
    for (int i = 0; i < COUNT * COUNT; i++) {
        a[i] = special[i / COUNT];
        b[i] = special[i % COUNT];
    }
    struct worst worst = {-1, 0, 0, 0};
    for (int f = 0; f < MATH_FUNCTIONS2; f++) {
        check_pairs(&math_functions2[f], a, b, COUNT * COUNT, &worst);
    }
}

// Lane arithmetic -----------------------------------------------------------------------------------

static void test_lane_arithmetic_is_that_of_c(void **state)
{
    (void)state;
    static const enum isa_function functions[] = {ISA_FLOOR, ISA_CEIL,       ISA_TRUNC,  ISA_ROUND, ISA_FRACT,
                                                  ISA_SIGN,  ISA_SATURATE,   ISA_TO_INT, ISA_MIN,   ISA_MAX,
                                                  ISA_LESS,  ISA_LESS_EQUAL, ISA_EQUAL};
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    for (int round = 0; round < 20; round++) {
        float a[BATCH], b[BATCH], result[BATCH];
        fill_arguments(a, round, -9e6f, 9e6f);
        fill_arguments(b, round & 1 ? round : round + 50, -3, 3);
        for (int i = 0; i < BATCH; i += 5) {
            a[i] = (float)(i - BATCH / 2) / 2; // halves, for rounding
        }
        for (size_t f = 0; f < sizeof functions / sizeof functions[0]; f++) {
            baseline->apply(functions[f], a, b, result, BATCH);
            for (int i = 0; i < BATCH; i++) {
                const float expected = math_plain(functions[f], a[i], b[i]);
                const bool number = functions[f] < ISA_TO_INT; // NaN for NaN will do
                if (!(number && isnan(expected) && isnan(result[i])) &&
                    to_bits(result[i]) != to_bits(expected)) {
                    fail_msg("function %d of %a, %a is %a, not %a", (int)functions[f], (double)a[i],
                             (double)b[i], (double)result[i], (double)expected);
                }
            }
        }
    }
}

static void test_vectors(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int n = 0; n < 2000; n++) {
        rhw_float a[4], b[4], cross[3], unit[3], mirrored[3];
        for (int c = 0; c < 4; c++) {
            for (int i = 0; i < RHW_LANES; i++) {
                a[c][i] = rig_random_float(&random, -5, 5);
                b[c][i] = rig_random_float(&random, -5, 5);
            }
        }
        rhw_cross(a, b, cross);
        rhw_normalize3(a, unit);
        rhw_reflect3(b, unit, mirrored);
        const rhw_float dot = rhw_dot4(a, b), length = rhw_length3(a);
        for (int i = 0; i < RHW_LANES; i++) {
            double x[4], y[4], sum = 0, square = 0;
            for (int c = 0; c < 4; c++) {
                x[c] = (double)a[c][i];
                y[c] = (double)b[c][i];
                sum += x[c] * y[c];
                square += c < 3 ? x[c] * x[c] : 0;
            }
            assert_true(fabs((double)dot[i] - sum) < 1e-5);
            assert_true(fabs((double)length[i] - sqrt(square)) < 2e-6);
            const double along = (x[0] * y[0] + x[1] * y[1] + x[2] * y[2]) / square;
            for (int c = 0; c < 3; c++) {
                const int p = (c + 1) % 3, q = (c + 2) % 3;
                assert_true(fabs((double)cross[c][i] - (x[p] * y[q] - x[q] * y[p])) < 1e-5);
                assert_true(fabs((double)unit[c][i] - x[c] / sqrt(square)) < 3e-7);
                assert_true(fabs((double)mirrored[c][i] - (y[c] - 2 * along * x[c])) < 1e-5);
            }
        }
    }
    const rhw_float zero[3] = {rhw_splat(0.0f), rhw_splat(-0.0f), rhw_splat(0.0f)};
    rhw_float unit[3];
    rhw_normalize3(zero, unit);
    assert_true(unit[0][0] == 0 && unit[1][5] == 0 && unit[2][7] == 0);
}

static void test_masks(void **state)
{
    (void)state;
    for (int bits = 0; bits < 256; bits++) {
        rhw_int mask;
        for (int i = 0; i < RHW_LANES; i++) {
            mask[i] = -(bits >> i & 1);
        }
        assert_int_equal(rhw_mask_bits(mask), bits);
        assert_int_equal(rhw_any(mask), bits != 0);
        assert_int_equal(rhw_all(mask), bits == 255);
        const rhw_float chosen = rhw_select(mask, rhw_splat(2.0f), rhw_splat(-0.0f));
        for (int i = 0; i < RHW_LANES; i++) {
            assert_int_equal(to_bits(chosen[i]), bits >> i & 1 ? 0x40000000u : 0x80000000u);
        }
    }
}

// Sameness ------------------------------------------------------------------------------------------

// Bits of a NaN are unspecified, everything else is not.
static bool same(float a, float b)
{
    return to_bits(a) == to_bits(b) || (isnan(a) && isnan(b));
}

static void test_every_isa_gives_the_same_bits(void **state)
{
    (void)state;
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    for (int isa = RHW_ISA_BASELINE + 1; isa < RHW_ISA_COUNT; isa++) {
        const struct isa_templates *const other = isa_templates_for((enum rhw_isa)isa);
        for (int n = 0; other && n < 60 * ISA_FUNCTION_COUNT; n++) {
            const enum isa_function function = (enum isa_function)(n % ISA_FUNCTION_COUNT);
            float a[BATCH], b[BATCH], expected[BATCH], result[BATCH];
            fill_arguments(a, n, -10, 10);
            fill_arguments(b, n + 1, -10, 10);
            if (n & 1) {
                fill_pairs(a, b, n, true);
            }
            baseline->apply(function, a, b, expected, BATCH);
            other->apply(function, a, b, result, BATCH);
            for (int i = 0; i < BATCH; i++) {
                if (!same(result[i], expected[i])) {
                    fail_msg("%s: function %d of %a, %a is %a, baseline %a", rhw_isa_name((enum rhw_isa)isa),
                             (int)function, (double)a[i], (double)b[i], (double)result[i],
                             (double)expected[i]);
                }
            }
        }
    }
}

static void test_one_at_a_time_gives_the_bits_of_a_lane(void **state)
{
    (void)state;
    const struct isa_templates *const baseline = isa_templates_for(RHW_ISA_BASELINE);
    static float (*const one[])(float) = {rhw_exp2_1, rhw_exp1, rhw_log2_1, rhw_log1,  rhw_sin1,
                                          rhw_cos1,   rhw_tan1, rhw_asin1,  rhw_acos1, rhw_atan1};
    static const enum isa_function functions[] = {ISA_EXP2, ISA_EXP, ISA_LOG2, ISA_LOG,  ISA_SIN,
                                                  ISA_COS,  ISA_TAN, ISA_ASIN, ISA_ACOS, ISA_ATAN};
    float a[BATCH], b[BATCH], expected[BATCH];
    fill_arguments(a, 77, -2, 2);
    for (size_t f = 0; f < sizeof functions / sizeof functions[0]; f++) {
        baseline->apply(functions[f], a, a, expected, BATCH);
        for (int i = 0; i < BATCH; i++) {
            assert_true(same(one[f](a[i]), expected[i]));
        }
    }
    fill_pairs(a, b, 77, true);
    baseline->apply(ISA_POW, a, b, expected, BATCH);
    for (int i = 0; i < BATCH; i++) {
        assert_true(same(rhw_pow1(a[i], b[i]), expected[i]));
    }
    baseline->apply(ISA_ATAN2, a, b, expected, BATCH);
    for (int i = 0; i < BATCH; i++) {
        assert_true(same(rhw_atan2_1(a[i], b[i]), expected[i]));
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_functions_keep_the_error_they_state),
    cmocka_unit_test(test_known_worst_arguments),
    cmocka_unit_test(test_pow_and_atan2_keep_the_error_they_state),
    cmocka_unit_test(test_special_cases_are_those_of_c),
    cmocka_unit_test(test_lane_arithmetic_is_that_of_c),
    cmocka_unit_test(test_vectors),
    cmocka_unit_test(test_masks),
    cmocka_unit_test(test_every_isa_gives_the_same_bits),
    cmocka_unit_test(test_one_at_a_time_gives_the_bits_of_a_lane),
};

const struct unit_tests test_shader_math = UNIT_TESTS(tests, NULL, NULL);
