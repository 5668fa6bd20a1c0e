// SPDX-License-Identifier: MIT
// What the promise of equal bytes asks of the compiler and its options: no contraction, no reassociation, no
// excess precision, subnormals kept, and a rounding to float that is a rounding. gcc 12's SLP vectorizer fails
// the last one at -O2, which is why the build switches it off.
#include "unit.h"

#include <math.h>
#include <string.h>

__attribute__((noinline)) static void round_two(const double in[2], float narrow[2], double out[2])
{
    narrow[0] = (float)in[0];
    narrow[1] = (float)in[1];
    out[0] = (double)narrow[0];
    out[1] = (double)narrow[1];
}

static void test_a_rounding_to_float_is_one(void **state)
{
    (void)state;
    static volatile double source[2] = {0.1, 0.7}; // unknown to the compiler
    const double in[2] = {source[0], source[1]};
    float narrow[2];
    double out[2];
    round_two(in, narrow, out);
    for (int i = 0; i < 2; i++) {
        assert_true(out[i] != in[i]);
        assert_true(out[i] == (double)narrow[i]);
    }
}

__attribute__((noinline)) static float multiply_add(float a, float b, float c)
{
    return a * b + c;
}

__attribute__((noinline)) static float add_and_take_away(float a, float b)
{
    return (a + b) - a;
}

__attribute__((noinline)) static float divide(float a, float b)
{
    return a / b;
}

static void test_operations_are_ieee(void **state)
{
    (void)state;
    static volatile float unknown[] = {1, 3, 2};
    // (1 + 2^-12)² = 1 + 2^-11 + 2^-24: the last term is lost in a product of floats, kept in a fused one.
    assert_true(multiply_add(unknown[0] + 0x1p-12f, 1 + 0x1p-12f, -(1 + 0x1p-11f)) == 0);
    assert_true(add_and_take_away(0x1p24f * unknown[0], 1.25f) == 2);
    assert_true(divide(unknown[0], unknown[1]) == 0x1.555556p-2f);
    assert_true(divide(0x1p-126f, 4) == 0x1p-128f);
    assert_true(sqrtf(divide(unknown[2], unknown[0])) == 0x1.6a09e6p+0f);
    assert_true(multiply_add(-0.0f, 1, -0.0f) == 0 && signbit(multiply_add(-0.0f, 1, -0.0f)));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_a_rounding_to_float_is_one),
    cmocka_unit_test(test_operations_are_ieee),
};

const struct unit_tests test_compiler = UNIT_TESTS(tests, NULL, NULL);
