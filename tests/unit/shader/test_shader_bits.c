// SPDX-License-Identifier: MIT
// The integers of shader_integer.h and the exponents and packed numbers of shader_pack.h against C and plain formulas, in
// lanes. test_shader_kit compares them with their twins on every instruction set, which have the bits of plain C.
#include "float_bits.h"
#include "harness.h"
#include "reference.h"

#include <math.h>

static void assert_same_float(float got, float want)
{
    if (to_bits(got) != to_bits(want) && !(isnan(got) && isnan(want))) {
        fail_msg("%a instead of %a", (double)got, (double)want);
    }
}

// Any integer, one near 0 or near an end of the range.
static int32_t random_int(uint64_t *random)
{
    const uint32_t bits = (uint32_t)rig_random(random);
    switch (rig_random_int(random, 4)) {
    case 0: return (int32_t)bits;
    case 1: return (int32_t)(bits % 9) - 4;
    case 2: return (int32_t)((bits % 5) + 0x7ffffffeu);
    default: return (int32_t)(bits >> bits % 32);
    }
}

static int count_bits(uint32_t a)
{
    int count = 0;
    for (; a != 0; a >>= 1) {
        count += (int)(a & 1);
    }
    return count;
}

static int highest(uint32_t a)
{
    int number = -1;
    for (; a != 0; a >>= 1) {
        number++;
    }
    return number;
}

static uint32_t reversed(uint32_t a)
{
    uint32_t result = 0;
    for (int i = 0; i < 32; i++) {
        result |= (a >> i & 1) << (31 - i);
    }
    return result;
}

static void test_division_is_that_of_c_and_defined(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int round = 0; round < 20000; round++) {
        rhw_int a, b;
        for (int i = 0; i < RHW_LANES; i++) {
            a[i] = random_int(&random);
            b[i] = random_int(&random);
        }
        const rhw_int quotient = rhw_divide_int(a, b), rest = rhw_remainder_int(a, b);
        const rhw_int u_quotient = rhw_divide_uint(a, b), u_rest = rhw_remainder_uint(a, b);
        for (int i = 0; i < RHW_LANES; i++) {
            const int64_t x = a[i], y = b[i] == 0 ? 1 : b[i];
            assert_int_equal(quotient[i], (int32_t)(uint32_t)(uint64_t)(x / y));
            assert_int_equal(rest[i], b[i] == 0 ? 0 : x % y);
            const uint32_t u = (uint32_t)a[i], v = b[i] == 0 ? 1 : (uint32_t)b[i];
            assert_int_equal((uint32_t)u_quotient[i], u / v);
            assert_int_equal((uint32_t)u_rest[i], b[i] == 0 ? 0 : u % v);
        }
    }
}

static void test_bits_are_counted(void **state)
{
    (void)state;
    uint64_t random = 2;
    for (int round = 0; round < 4000; round++) {
        rhw_int a;
        for (int i = 0; i < RHW_LANES; i++) {
            a[i] = random_int(&random);
        }
        const rhw_int count = rhw_bit_count(a), reverse = rhw_bit_reverse(a), lsb = rhw_find_lsb(a);
        const rhw_int msb = rhw_find_msb_uint(a), msb_int = rhw_find_msb_int(a);
        for (int i = 0; i < RHW_LANES; i++) {
            const uint32_t u = (uint32_t)a[i];
            assert_int_equal(count[i], count_bits(u));
            assert_int_equal((uint32_t)reverse[i], reversed(u));
            assert_int_equal(lsb[i], u == 0 ? -1 : 31 - highest(reversed(u)));
            assert_int_equal(msb[i], highest(u));
            assert_int_equal(msb_int[i], highest(a[i] < 0 ? ~u : u));
        }
    }
}

static void test_exponents_are_those_of_c(void **state)
{
    (void)state;
    static const float special[] = {0.0f,   -0.0f,   INFINITY,        -INFINITY, NAN,
                                    1e-45f, -1e-45f, 1.17549435e-38f, 2.5f,      -2.5f};
    uint64_t random = 3;
    for (int round = 0; round < 20000; round++) {
        const float a = round < 40 ? special[round % 10] : from_bits((uint32_t)rig_random(&random));
        const int n = round % 2 ? random_int(&random) : rig_random_int(&random, 600) - 300;
        assert_same_float(rhw_ldexp(a, n)[0], ldexpf(a, n > 1000 ? 1000 : n < -1000 ? -1000 : n));
        rhw_int exponent;
        const float fraction = rhw_frexp(rhw_splat(a), &exponent)[0];
        int want = 0;
        assert_same_float(fraction, frexpf(a, &want));
        assert_int_equal(exponent[0], isfinite(a) ? want : 0);
        rhw_float whole;
        float want_whole;
        const float rest = rhw_modf(rhw_splat(a), &whole)[0];
        // The C library of Windows gives a rest of infinity no sign.
        assert_same_float(rest, copysignf(modff(a, &want_whole), a));
        assert_same_float(whole[0], want_whole);
    }
}

static void test_halves_are_exact_and_the_nearest(void **state)
{
    (void)state;
    for (int half = 0; half < 0x10000; half++) {
        const float value = rhw_float_from_half_bits(rhw_splat_int(half))[0];
        const int back = rhw_half_bits_from_float(rhw_splat(value))[0];
        if ((half & 0x7fff) > 0x7c00) {
            assert_true(isnan(value));
            assert_int_equal(back, 0x7e00);
        } else {
            assert_int_equal(back, half);
            if ((half & 0x7fff) < 0x7c00) {
                assert_true((double)value == ref_half((uint16_t)half));
            } else {
                assert_true(isinf(value) && (signbit(value) != 0) == (half >= 0x8000));
            }
        }
        if ((half & 0x7fff) < 0x7bff) { // halfway to the next: the even one; beside it: the nearer one
            const float middle = (float)(0.5 * (ref_half((uint16_t)half) + ref_half((uint16_t)(half + 1))));
            const float above = nextafterf(middle, half < 0x8000 ? INFINITY : -INFINITY);
            const float below = nextafterf(middle, 0);
            assert_int_equal(rhw_half_bits_from_float(rhw_splat(middle))[0], half + (half & 1));
            assert_int_equal(rhw_half_bits_from_float(rhw_splat(above))[0], half + 1);
            assert_int_equal(rhw_half_bits_from_float(rhw_splat(below))[0], half);
        }
    }
    assert_int_equal(rhw_half_bits_from_float(rhw_splat(65520.0f))[0], 0x7c00);
    assert_int_equal(rhw_half_bits_from_float(rhw_splat(nextafterf(65520.0f, 0)))[0], 0x7bff);
}

// What a component is in `bits` bits, by the definition of GLSL.
static uint32_t packed(double a, bool is_signed, int bits)
{
    const double low = is_signed ? -1 : 0, scale = (1 << (is_signed ? bits - 1 : bits)) - 1;
    const double clamped = a > low ? fmin(a, 1) : low; // NaN is low
    return (uint32_t)(int)nearbyint((double)((float)clamped * (float)scale)) & ((1u << bits) - 1);
}

static void test_components_are_packed(void **state)
{
    (void)state;
    uint64_t random = 4;
    for (int round = 0; round < 20000; round++) {
        float v[4];
        rhw_float lanes[4], out[4];
        for (int i = 0; i < 4; i++) {
            v[i] = round % 8 == 0 ? from_bits((uint32_t)rig_random(&random))
                                  : rig_random_float(&random, -1.2f, 1.2f);
            lanes[i] = rhw_splat(v[i]);
        }
        const uint32_t got[4] = {(uint32_t)rhw_pack_unorm4x8(lanes)[0], (uint32_t)rhw_pack_snorm4x8(lanes)[0],
                                 (uint32_t)rhw_pack_unorm2x16(lanes)[0],
                                 (uint32_t)rhw_pack_snorm2x16(lanes)[0]};
        for (int kind = 0; kind < 4; kind++) {
            const int bits = kind < 2 ? 8 : 16;
            for (int i = 0; i < 32 / bits; i++) {
                assert_int_equal(got[kind] >> (bits * i) & ((1u << bits) - 1),
                                 packed((double)v[i], kind % 2, bits));
            }
        }
        const rhw_int word = rhw_splat_int((int32_t)rig_random(&random));
        const uint32_t u = (uint32_t)word[0];
        rhw_unpack_snorm4x8(word, out);
        assert_same_float(out[3][0], fmaxf((float)(int8_t)(u >> 24) / 127.0f, -1));
        rhw_unpack_unorm4x8(word, out);
        assert_same_float(out[3][0], (float)(u >> 24) / 255.0f);
        rhw_unpack_snorm2x16(word, out);
        assert_same_float(out[1][0], fmaxf((float)(int16_t)(u >> 16) / 32767.0f, -1));
        rhw_unpack_unorm2x16(word, out);
        assert_same_float(out[1][0], (float)(u >> 16) / 65535.0f);
        const uint32_t halves = (uint32_t)rhw_pack_half2x16(lanes)[0];
        assert_int_equal(halves & 0xffff, rhw_half_bits_from_float1(v[0]));
        assert_int_equal(halves >> 16, rhw_half_bits_from_float1(v[1]));
        rhw_unpack_half2x16(word, out);
        assert_same_float(out[1][0], rhw_float_from_half_bits1((int32_t)(u >> 16)));
        assert_same_float(out[0][0], rhw_float_from_half_bits1((int32_t)(u & 0xffff)));
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_division_is_that_of_c_and_defined),
    cmocka_unit_test(test_bits_are_counted),
    cmocka_unit_test(test_exponents_are_those_of_c),
    cmocka_unit_test(test_halves_are_exact_and_the_nearest),
    cmocka_unit_test(test_components_are_packed),
};

const struct unit_tests test_shader_bits = UNIT_TESTS(tests, NULL, NULL);
