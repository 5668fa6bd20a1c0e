// SPDX-License-Identifier: MIT
// Instructions on numbers, vectors and matrices against their definitions, computed in integers and doubles.
#include "spirv_run.h"

#include <math.h>

#include "values_comp.h"
#include "values_comp_small.h"

enum { INVOCATIONS = 64, RESULTS = 64 };

struct given {
    int32_t i[4];
    float f[4];
};

// What is expected of one invocation, in the order in which values.comp puts it.
struct expectation {
    double value[RESULTS];
    double tolerance[RESULTS]; // −1: the word is `bits`
    uint32_t bits[RESULTS];
    int count;
};

static void expect_bits(struct expectation *expected, uint32_t bits)
{
    expected->tolerance[expected->count] = -1;
    expected->bits[expected->count++] = bits;
}

static void expect_float(struct expectation *expected, double value, double tolerance)
{
    expected->tolerance[expected->count] = tolerance;
    expected->value[expected->count++] = value;
}

static uint32_t field(uint32_t value, int offset, int count)
{
    return (uint32_t)((uint64_t)value >> offset & ((UINT64_C(1) << count) - 1));
}

static int highest_bit(uint32_t value)
{
    int bit = -1;
    for (int i = 0; i < 32; i++) {
        bit = value >> i & 1 ? i : bit;
    }
    return bit;
}

// SPIR-V leaves it open what a division gives whose result is too large; no case here has one.
static int64_t modulo(int64_t a, int64_t b)
{
    const int64_t rest = a % b;
    return rest != 0 && (rest < 0) != (b < 0) ? rest + b : rest;
}

static void expect_bit_fields(struct expectation *e, const int32_t i[4])
{
    const uint32_t x = (uint32_t)i[0], y = (uint32_t)i[1];
    const int offset = i[2] & 15, count = i[3] & 15;
    const uint32_t mask = (uint32_t)(((UINT64_C(1) << count) - 1) << offset);
    const uint32_t part = field(x, offset, count);
    uint32_t reversed = 0;
    int ones = 0, lowest = -1;
    for (int bit = 31; bit >= 0; bit--) {
        reversed |= (x >> bit & 1) << (31 - bit);
        ones += (int)(x >> bit & 1);
        lowest = x >> bit & 1 ? bit : lowest;
    }
    expect_bits(e, (x & ~mask) | (y << offset & mask));
    expect_bits(e, count > 0 && part >> (count - 1) ? part - (1u << count) : part);
    expect_bits(e, part);
    expect_bits(e, reversed);
    expect_bits(e, (uint32_t)ones);
    expect_bits(e, (uint32_t)lowest);
    expect_bits(e, (uint32_t)highest_bit(i[0] < 0 ? ~x : x));
    expect_bits(e, (uint32_t)highest_bit(x));
}

static int32_t least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}

static void expect_whole_numbers(struct expectation *e, const int32_t i[4])
{
    const uint32_t x = (uint32_t)i[0], y = (uint32_t)i[1];
    const uint64_t product = (uint64_t)x * y;
    const uint64_t signed_product = (uint64_t)((int64_t)i[0] * i[1]);
    const int shift = i[2] & 31;
    expect_bits(e, (uint32_t)((int64_t)i[0] % i[1]));
    expect_bits(e, (uint32_t)modulo(i[0], i[1]));
    expect_bit_fields(e, i);
    expect_bits(e, x + y);
    expect_bits(e, (uint32_t)(((uint64_t)x + y) >> 32));
    expect_bits(e, x - y);
    expect_bits(e, x < y);
    expect_bits(e, (uint32_t)(product >> 32) ^ (uint32_t)product);
    expect_bits(e, (uint32_t)(signed_product >> 32) ^ (uint32_t)signed_product);
    expect_bits(e, (x / y) ^ (x % y));
    expect_bits(e, (uint32_t)((uint64_t)x << shift));
    expect_bits(e, (uint32_t)(i[0] < 0 ? ~(~x >> shift) : x >> shift));
    expect_bits(e, x >> shift);
    expect_bits(e, (i[0] < 0 ? 0 - x : x) ^ (uint32_t)((i[1] > 0) - (i[1] < 0)) ^
                       (uint32_t)least(i[0], i[1]) ^ (uint32_t)-least(-i[2], -i[3]));
    expect_bits(e, i[0] < 0 || i[1] < 0 || i[2] < 0 || i[3] < 0);
    expect_bits(e, i[0] >= i[1] && i[1] >= i[2] && i[2] >= i[3]);
    expect_bits(e,
                (9 * 7 - 2) / 3 % 8 + (9 << 2) + 100 + 1 + (~9 & 0xff)); // with 9 for SIX, and true for YES
}

static uint32_t bits_of(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static void expect_floats(struct expectation *e, const float f[4], const int32_t i[4])
{
    const double x = (double)f[0], y = (double)f[1], size = fabs(x) * 0x1p-20;
    int exponent;
    expect_float(e, x - y * trunc(x / y), size);
    expect_float(e, x - y * floor(x / y), size);
    const double step = ldexp(1, (fabs(x) < 0x1p-14 ? -14 : ilogb(x)) - 10);
    expect_float(e, rint(x / step) * step, 0);
    expect_bits(e, bits_of(f[0] - truncf(f[0])));
    expect_bits(e, bits_of(truncf(f[0])));
    expect_bits(e, bits_of(frexpf(f[0], &exponent)));
    expect_bits(e, (uint32_t)exponent);
    // Comparisons with what is no number: unordered ones hold.
    expect_bits(e, 1u | 4u | 8u | (x > y ? 16u : 0u) | (x <= y ? 32u : 0u) | 64u | 128u | 256u);
    expect_bits(e, bits_of(f[0]));
    expect_bits(e, bits_of(f[1]));
    expect_float(e, x < -1 ? -1 : x > 1 ? 1 : x, 0);
    expect_bits(e, (uint32_t)(int32_t)f[0]);
    expect_bits(e, (uint32_t)fabsf(f[0]));
    expect_bits(e, bits_of((float)i[0]));
    expect_bits(e, bits_of((float)(uint32_t)i[0]));
}

static double determinant(double m[3][3])
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3, g = (c + 2) % 3;
        sum += m[c][0] * (m[d][1] * m[g][2] - m[g][1] * m[d][2]);
    }
    return sum;
}

static void expect_composites(struct expectation *e, const struct given *all, int number)
{
    const float *const f = all[number].f;
    const int32_t *const i = all[number].i;
    double v[4], inserted = 0, sum = 0;
    for (int c = 0; c < 4; c++) {
        v[c] = c == (i[2] & 3) ? 9 : (double)f[c];
        sum += v[c] * (1 << c);
        inserted += (c == (i[3] & 3) ? -1 : (double)f[c]) * (1 << c);
    }
    double m[3][3] = {{(double)f[0], (double)f[1], (double)f[2]},
                      {(double)f[1], (double)f[2], (double)f[3]},
                      {1, 2, (double)f[0]}};
    const double x = (double)f[0], y = (double)f[1], z = (double)f[2], w = (double)f[3];
    expect_float(e, sum + v[2], 1e-4);
    expect_bits(e, bits_of(f[i[3] & 3]));
    expect_float(e, inserted, 1e-4);
    expect_float(e, determinant(m), 1e-2);
    expect_float(e, 3, 1e-4 + 1e-1 / fabs(determinant(m)));
    expect_float(e, z * z + 2 * x * w, 1e-2);
    // Element c, r of the transposed outer product is f[c] · f[2 + r].
    const double squares = x * x + y * y + z * z;
    expect_float(e, z * w * x * x * z + w * squares + z * squares, 1e-1);
    expect_float(e, w * w + 2 * w, 1e-2);
    expect_bits(e, (uint32_t)(i[0] > 0 ? all[0].i[1] : all[1].i[1]));
    expect_bits(e, bits_of(x > 0 ? f[3] : f[0]));
}

static void check_values(const uint32_t *words, size_t size)
{
    static struct given given[INVOCATIONS];
    static uint32_t sink[INVOCATIONS][RESULTS];
    uint64_t random = 11;
    for (int n = 0; n < INVOCATIONS; n++) {
        for (int c = 0; c < 4; c++) {
            const uint32_t bits = (uint32_t)rig_random(&random);
            given[n].i[c] = (int32_t)(bits >> rig_random_int(&random, 30)) * (n % 3 == c % 2 ? -1 : 1);
            given[n].i[c] += given[n].i[c] == 0 || given[n].i[c] == -1 ? 3 : 0;
            given[n].f[c] = rig_random_float(&random, -9, 9);
        }
    }
    const struct rhw_shader_constant constants[] = {{.id = 0, .value = 9}, {.id = 1, .value = 1}};
    const struct spirv_bytes bindings[] = {{given, sizeof given, true}, {sink, sizeof sink, false}};
    rhw_shader *const shader = spirv_specialize(words, size, RHW_SHADER_COMPUTE, constants, 2);
    spirv_run(shader, bindings, 2, NULL, 0, INVOCATIONS / 16);
    for (int n = 0; n < INVOCATIONS; n++) {
        struct expectation e = {.count = 0};
        expect_whole_numbers(&e, given[n].i);
        expect_floats(&e, given[n].f, given[n].i);
        expect_composites(&e, given, n);
        for (int r = 0; r < e.count; r++) {
            float value;
            memcpy(&value, &sink[n][r], sizeof value);
            if (e.tolerance[r] < 0 ? sink[n][r] != e.bits[r]
                                   : !(fabs((double)value - e.value[r]) <= e.tolerance[r])) {
                fail_msg("invocation %d, result %d: 0x%x or %g, not 0x%x or %g", n, r, (unsigned)sink[n][r],
                         (double)value, (unsigned)e.bits[r], e.value[r]);
            }
        }
    }
}

static void test_instructions_on_numbers(void **state)
{
    (void)state;
    check_values(values_comp, sizeof values_comp);
    check_values(values_comp_small, sizeof values_comp_small);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_instructions_on_numbers),
};

const struct unit_tests test_spirv_values = UNIT_TESTS(tests, NULL, NULL);
