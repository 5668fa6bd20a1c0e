// SPDX-License-Identifier: MIT
// The elementary functions of scene/ in double: the errors that elementary.h states, against MPFR, what they do at the
// ends, and their bits, which are the same on every machine.
#include "harness.h"

#include <math.h>
#include <mpfr.h>
#include <string.h>

#include "elementary.h"

typedef double double_function(double a);
typedef int mpfr_function(mpfr_t result, const mpfr_t a, mpfr_rnd_t rounding);

enum { SAMPLES = 20000 };

static double exact(mpfr_function *function, double a)
{
    mpfr_t value;
    mpfr_init2(value, 200);
    mpfr_set_d(value, a, MPFR_RNDN);
    function(value, value, MPFR_RNDN);
    const double result = mpfr_get_d(value, MPFR_RNDN);
    mpfr_clear(value);
    return result;
}

static double random_between(uint64_t *state, double low, double high)
{
    return low + (high - low) * (double)(rig_random(state) >> 11) * 0x1p-53;
}

// The largest error over `low`..`high`, of the larger of the result's magnitude and `least`.
static double worst(double_function *function, mpfr_function *truth, double low, double high, double least)
{
    uint64_t random = 3;
    double largest = 0;
    for (int i = 0; i < SAMPLES; i++) {
        const double a = random_between(&random, low, high), wanted = exact(truth, a);
        largest = fmax(largest, fabs(function(a) - wanted) / fmax(fabs(wanted), least));
    }
    return largest;
}

static void test_errors(void **state)
{
    (void)state;
    static const double reach[] = {0.8, 10, 1e6};
    for (int i = 0; i < 3; i++) {
        assert_true(worst(scene_sin, mpfr_sin, -reach[i], reach[i], 1) <= 0x1p-52);
        assert_true(worst(scene_cos, mpfr_cos, -reach[i], reach[i], 1) <= 0x1p-52);
    }
    assert_true(worst(scene_tan, mpfr_tan, -1.5, 1.5, 0) <= 0x1p-51);
    assert_true(worst(scene_atan, mpfr_atan, -1e6, 1e6, 0) <= 0x1p-50);
    assert_true(worst(scene_exp, mpfr_exp, -1, 1, 0) <= 0x1p-51);
    assert_true(worst(scene_exp, mpfr_exp, -700, 700, 0) <= 0x1p-51);
    assert_true(worst(scene_log, mpfr_log, 0, 2, 1) <= 0x1p-51);
    assert_true(worst(scene_log, mpfr_log, 0, 1e300, 1) <= 0x1p-51);
    assert_true(worst(scene_atan, mpfr_atan, -2, 2, 0) <= 0x1p-50);
    uint64_t random = 4;
    for (int i = 0; i < SAMPLES; i++) {
        const double a = random_between(&random, 0, 10), b = random_between(&random, -30, 30);
        mpfr_t base, power;
        mpfr_inits2(200, base, power, (mpfr_ptr)NULL);
        mpfr_set_d(base, a, MPFR_RNDN);
        mpfr_set_d(power, b, MPFR_RNDN);
        mpfr_pow(base, base, power, MPFR_RNDN);
        const double wanted = mpfr_get_d(base, MPFR_RNDN);
        mpfr_clears(base, power, (mpfr_ptr)NULL);
        if (wanted > 1e-38 && wanted < 3e38) {
            assert_true(fabs(scene_pow(a, b) - wanted) <= 0x1p-44 * wanted);
        }
    }
}

static void test_ends(void **state)
{
    (void)state;
    assert_true(scene_sin(0) == 0 && scene_cos(0) == 1 && scene_tan(0) == 0 && scene_atan(0) == 0);
    assert_true(scene_exp(0) == 1 && scene_log(1) == 0 && scene_pow(1, 2.4) == 1);
    assert_true(fabs(scene_sin(1e9)) <= 1 && fabs(scene_cos(-1e300)) <= 1);
    assert_true(scene_atan(1e300) == acos(0) && scene_atan(-INFINITY) == -acos(0));
    assert_true(scene_exp(1000) == INFINITY && scene_exp(-1000) == 0);
    assert_true(scene_log(0) == -INFINITY && scene_log(INFINITY) == INFINITY);
    static double_function *const all[] = {scene_sin, scene_cos, scene_tan, scene_atan, scene_exp, scene_log};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        assert_true(isnan(all[i](NAN)));
    }
    assert_true(scene_pow(0, 0) == 1 && scene_pow(INFINITY, 0) == 1 && scene_pow(NAN, 0) == 1);
    assert_true(scene_pow(1, INFINITY) == 1 && scene_pow(0, 2) == 0 && scene_pow(0, -1) == INFINITY);
    double sine, cosine;
    scene_sin_cos_degrees(90 * 0x1p62, &sine, &cosine);
    assert_true(sine == 0 && cosine == 1);
    scene_sin_cos_degrees(-90 * (0x1p40 + 1), &sine, &cosine);
    assert_true(sine == -1 && cosine == 0);
    static const double no_angles[] = {INFINITY, -INFINITY, NAN};
    for (int i = 0; i < 3; i++) {
        scene_sin_cos_degrees(no_angles[i], &sine, &cosine);
        assert_true(isnan(sine) && isnan(cosine));
    }
    assert_true(isnan(scene_sin(INFINITY)) && isnan(scene_cos(-INFINITY)) && isnan(scene_log(-1)));
}

static void test_bits(void **state)
{
    (void)state;
    static double_function *const all[] = {scene_sin, scene_cos, scene_tan, scene_atan, scene_exp, scene_log};
    uint64_t random = 5, hash = rig_hash_bytes(UINT64_C(0xcbf29ce484222325), "", 0);
    for (int i = 0; i < SAMPLES; i++) {
        const double a = random_between(&random, 0, 100);
        for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
            const double result = all[k](a);
            hash = rig_hash_bytes(hash, &result, sizeof result);
        }
    }
    assert_true(hash == UINT64_C(0xbf0b2088dc73444a));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_errors),
    cmocka_unit_test(test_ends),
    cmocka_unit_test(test_bits),
};

const struct unit_tests test_elementary = UNIT_TESTS(tests, NULL, NULL);
