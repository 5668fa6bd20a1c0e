// SPDX-License-Identifier: MIT
// What functions of GLSL.std.450 and whole numbers give, bit for bit, from their definitions in scalar C: for every pair of
// numbers where something may go wrong. Then the same with operands that are constants, which the translation folds.
#include <math.h>
#include <string.h>

#include "function_rig.h"
#include "harness.h"

static float as_float(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t as_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

// Definitions ----------------------------------------------------------------------------------------

// The rules of shader_vector.h: the second operand comes of a NaN and of two zeros.
static float least(float a, float b)
{
    return a < b ? a : b;
}

static float most(float a, float b)
{
    return a > b ? a : b;
}

static float sign(float x)
{
    return x < 0 ? -1.0f : x > 0 ? 1.0f : 0.0f;
}

static float smooth(float from, float to, float x)
{
    const float t = least(most((x - from) / (to - from), 0), 1);
    return t * t * (3 - 2 * t);
}

static float number_or(float a, float b, float otherwise)
{
    return isnan(a) ? b : isnan(b) ? a : otherwise;
}

static int32_t whole(float x)
{
    return isnan(x) ? 0 : x >= 0x1p31f ? INT32_MAX : x <= -0x1p31f ? INT32_MIN : (int32_t)x;
}

static uint32_t positive(float x)
{
    return !(x > 0) ? 0 : x >= 0x1p32f ? UINT32_MAX : (uint32_t)x;
}

static float half_of(uint32_t bits)
{
    const int exponent = (int)(bits >> 10 & 31), part = (int)(bits & 1023);
    const float magnitude = exponent == 31 ? (part ? NAN : INFINITY)
                            : exponent     ? ldexpf(1024.0f + (float)part, exponent - 25)
                                           : ldexpf((float)part, -24);
    return bits & 0x8000 ? -magnitude : magnitude;
}

static float nearest_half(float x)
{
    if (!isfinite(x) || x == 0) {
        return x;
    }
    const int exponent = ilogbf(x) < -14 ? -24 : ilogbf(x) - 10;
    const float rounded = ldexpf(rintf(ldexpf(x, -exponent)), exponent);
    return fabsf(rounded) > 65504 ? copysignf(INFINITY, x) : rounded;
}

// Results of a function of floats. Return false where the number names none.
static bool plain(int which, float x, float y, float z, uint32_t r[4])
{
    int exponent;
    switch (which) {
    case 20: r[0] = as_bits(rintf(x)); return true;
    case 21: r[0] = as_bits(truncf(x)); return true;
    case 22: r[0] = as_bits(floorf(x)); return true;
    case 23: r[0] = as_bits(ceilf(x)); return true;
    case 24: r[0] = as_bits(x - floorf(x)); return true;
    case 25: r[0] = as_bits(x) & 0x7fffffff; return true;
    case 26: r[0] = as_bits(sign(x)); return true;
    case 27: r[0] = as_bits(least(x, y)); return true;
    case 28: r[0] = as_bits(most(x, y)); return true;
    case 29: r[0] = as_bits(least(most(x, y), z)); return true;
    case 30: r[0] = as_bits(x * (1 - z) + y * z); return true;
    case 31: r[0] = as_bits(y < x ? 0.0f : 1.0f); return true;
    case 32: r[0] = as_bits(smooth(x, y, z)); return true;
    case 33: r[0] = as_bits(x * y + z); return true;
    case 34: r[0] = as_bits(ldexpf(x, whole(y) < -500 ? -500 : whole(y) > 500 ? 500 : whole(y))); return true;
    case 35:
        r[0] = as_bits(frexpf(x, &exponent));
        r[1] = isfinite(x) ? (uint32_t)exponent : 0;
        return true;
    case 36:
        r[0] = as_bits(x - truncf(x));
        r[1] = as_bits(truncf(x));
        return true;
    case 37: r[0] = as_bits(x - y * floorf(x / y)); return true;
    case 38: r[0] = as_bits(z > 0.5f ? y : x); return true;
    case 39: r[0] = isnan(x) ? 1u : 0u, r[1] = isinf(x) ? 1u : 0u, r[2] = x == y, r[3] = x != y; return true;
    case 40: r[0] = as_bits(x * 0.017453292519943295f); return true;
    case 41: r[0] = as_bits(x * 57.29577951308232f); return true;
    case 42: r[0] = as_bits(number_or(x, y, least(x, y))); return true;
    case 43: r[0] = as_bits(number_or(x, y, most(x, y))); return true;
    case 44: {
        const float above = number_or(x, y, most(x, y));
        r[0] = as_bits(number_or(above, z, least(above, z)));
        return true;
    }
    case 45: r[0] = x<y, r[1] = x <= y, r[2] = x> y, r[3] = x >= y; return true;
    case 46:
        r[0] = (uint32_t)whole(x), r[1] = positive(x);
        r[2] = as_bits((float)(int32_t)as_bits(x)), r[3] = as_bits((float)as_bits(x));
        return true;
    default: return false;
    }
}

static float dot(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static uint32_t steps(float x, float low, float scale, uint32_t mask)
{
    return (uint32_t)(int32_t)rintf(least(most(x, low), 1) * scale) & mask;
}

static void put(uint32_t r[4], const float *values, int count)
{
    for (int i = 0; i < count; i++) {
        r[i] = as_bits(values[i]);
    }
}

static void refracted(const float v[3], const float n[3], float eta, uint32_t r[4])
{
    const float d = dot(n, v), k = 1 - eta * eta * (1 - d * d);
    for (int i = 0; i < 3; i++) {
        r[i] = as_bits(k < 0 ? 0.0f : eta * v[i] - (eta * d + sqrtf(k)) * n[i]);
    }
}

static bool vectors(int which, const float v[3], uint32_t r[4])
{
    const float o[3] = {v[2], v[0], v[1]}, u[3] = {v[1], v[2], v[0]};
    const uint32_t b[3] = {as_bits(v[0]), as_bits(v[1]), as_bits(v[2])};
    const float apart[3] = {v[0] - o[0], v[1] - o[1], v[2] - o[2]}, twice = 2 * dot(o, v);
    switch (which) {
    case 50: r[0] = as_bits(sqrtf(dot(v, v))); return true;
    case 51: r[0] = as_bits(sqrtf(dot(apart, apart))); return true;
    case 53:
        put(r, (float[]){v[1] * o[2] - o[1] * v[2], v[2] * o[0] - o[2] * v[0], v[0] * o[1] - o[0] * v[1]}, 3);
        return true;
    case 54:
        for (int i = 0; i < 3; i++) {
            r[i] = as_bits(v[i]) ^ (dot(u, o) < 0 ? 0 : 0x80000000);
        }
        return true;
    case 55: put(r, (float[]){v[0] - twice * o[0], v[1] - twice * o[1], v[2] - twice * o[2]}, 3); return true;
    case 56: refracted(v, o, v[0], r); return true;
    case 57: r[0] = as_bits(dot(v, o)); return true;
    case 58:
        for (int i = 0; i < 4; i++) {
            r[0] |= steps(v[i % 3], 0, 255, 0xff) << (8 * i);
            r[1] |= steps(v[i % 3], -1, 127, 0xff) << (8 * i);
            r[2] |= i < 2 ? steps(v[i], 0, 65535, 0xffff) << (16 * i) : 0;
            r[3] |= i < 2 ? steps(v[i], -1, 32767, 0xffff) << (16 * i) : 0;
        }
        return true;
    case 59:
        for (int i = 0; i < 4; i++) {
            r[i] = as_bits((float)(b[0] >> (8 * i) & 0xff) / 255.0f);
        }
        return true;
    case 60:
        for (int i = 0; i < 4; i++) {
            r[i] = as_bits(most((float)(int8_t)(b[0] >> (8 * i)) / 127.0f, -1));
        }
        return true;
    case 61:
        for (int i = 0; i < 2; i++) {
            r[i] = as_bits((float)(b[0] >> (16 * i) & 0xffff) / 65535.0f);
            r[2 + i] = as_bits(most((float)(int16_t)(b[1] >> (16 * i)) / 32767.0f, -1));
        }
        return true;
    case 62:
        put(r, (float[]){nearest_half(v[0]), nearest_half(v[1]), half_of(b[2] & 0xffff), half_of(b[2] >> 16)},
            4);
        return true;
    default: return false;
    }
}

static int highest(uint32_t x)
{
    return x ? 31 - __builtin_clz(x) : -1;
}

static uint32_t reversed(uint32_t x)
{
    uint32_t result = 0;
    for (int i = 0; i < 32; i++) {
        result |= (x >> i & 1) << (31 - i);
    }
    return result;
}

static bool whole_numbers(int which, int32_t x, int32_t y, int32_t z, uint32_t r[4])
{
    const uint32_t a = (uint32_t)x, b = (uint32_t)y, c = (uint32_t)z;
    const uint32_t at = b & 15, count = c & 15, mask = (1u << count) - 1;
    const int32_t low = y < z ? y : z, high = y < z ? z : y;
    switch (which) {
    case 70:
        r[0] = (uint32_t)highest(x < 0 ? ~a : a), r[1] = (uint32_t)(a ? __builtin_ctz(a) : -1);
        r[2] = (uint32_t)highest(a), r[3] = (uint32_t)__builtin_popcount(a);
        return true;
    case 71:
        r[0] = reversed(a), r[1] = x < 0 ? 0 - a : a, r[2] = (uint32_t)((x > 0) - (x < 0)), r[3] = 0 - a;
        return true;
    case 72:
        r[1] = a >> at & mask;
        r[0] = count && (r[1] >> (count - 1) & 1) ? r[1] | ~mask : r[1];
        r[2] = (a & ~(((1u << at) - 1) << count)) | (b & ((1u << at) - 1)) << count;
        return true;
    case 73:
        r[0] = (uint32_t)(x < y ? x : y), r[1] = (uint32_t)(x > y ? x : y);
        r[2] = (uint32_t)(x < low ? low : x > high ? high : x), r[3] = a < b ? a : b;
        return true;
    case 74:
        if (y != 0) {
            const int64_t quotient = (int64_t)x / y;
            r[0] = (uint32_t)quotient, r[1] = a / b, r[2] = a % b, r[3] = a - (uint32_t)quotient * b;
        }
        return true;
    case 75:
        r[0] = a << (b & 31), r[1] = (uint32_t)(x >> (b & 31)), r[2] = a >> (b & 31), r[3] = a ^ ~b;
        return true;
    case 76: r[0] = a + b, r[1] = a + b < a, r[2] = a - b, r[3] = a < b; return true;
    case 77:
        r[0] = (uint32_t)((uint64_t)((int64_t)x * y) >> 32), r[1] = r[3] = a * b;
        r[2] = (uint32_t)((uint64_t)a * b >> 32);
        return true;
    case 78: r[0] = x < y, r[1] = a < b, r[2] = x >= y, r[3] = a >= b; return true;
    default: return false;
    }
}

static bool define(int which, const float v[4], uint32_t r[4])
{
    memset(r, 0, 4 * sizeof *r);
    return which < 50   ? plain(which, v[0], v[1], v[2], r)
           : which < 70 ? vectors(which, v, r)
                        : whole_numbers(which, (int32_t)as_bits(v[0]), (int32_t)as_bits(v[1]),
                                        (int32_t)as_bits(v[2]), r);
}

// Operands -------------------------------------------------------------------------------------------

static const uint32_t numbers[] = {
    0x00000000, 0x80000000, 0x3f800000, 0xbf800000, 0x3f000000, 0xbf000000, 0x3fc00000, 0xc0200000,
    0x00000001, 0x807fffff, 0x00800000, 0x7f7fffff, 0x7f800000, 0xff800000, 0x7fc00000, 0x4effffff,
    0x4f000000, 0xcf000000, 0x4f800000, 0x4b000001, 0x3effffff, 0x41ffeb85, 0xc2c80001, 0x0000001f,
};

enum { NUMBERS = sizeof numbers / sizeof *numbers, ROWS = NUMBERS * NUMBERS };

static void fill(float operands[ROWS][4])
{
    for (int i = 0; i < ROWS; i++) {
        const uint32_t bits[4] = {numbers[i % NUMBERS], numbers[i / NUMBERS],
                                  numbers[(i * 7 + i / NUMBERS) % NUMBERS], 0};
        memcpy(operands[i], bits, sizeof bits);
    }
}

// Which NaN comes of an operation differs from machine to machine.
static bool is_same(uint32_t got, uint32_t want, bool is_float)
{
    return got == want || (is_float && isnan(as_float(got)) && isnan(as_float(want)));
}

static void compare(int which, const float operands[4], const uint32_t got[4], const uint32_t want[4])
{
    for (int i = 0; i < 4; i++) {
        if (!is_same(got[i], want[i], which < 70)) {
            fail_msg("function %d of %a, %a, %a (%08x): word %d is %08x (%a), not %08x (%a)", which,
                     (double)operands[0], (double)operands[1], (double)operands[2],
                     (unsigned)as_bits(operands[2]), i, (unsigned)got[i], (double)as_float(got[i]),
                     (unsigned)want[i], (double)as_float(want[i]));
        }
    }
}

static void test_results_are_those_of_the_definitions(void **state)
{
    (void)state;
    static float operands[ROWS][4];
    static uint32_t results[ROWS][4];
    fill(operands);
    for (int which = 20; which < 79; which++) {
        uint32_t want[4];
        if (!define(which, operands[0], want)) {
            continue;
        }
        function_rig_run(which, (const float(*)[4])operands, ROWS, false, results);
        for (int i = 0; i < ROWS; i++) {
            (void)define(which, operands[i], want);
            compare(which, operands[i], results[i], want);
        }
    }
}

static void test_constants_give_the_same(void **state)
{
    (void)state;
    enum { SOME = 24 };
    static float operands[ROWS][4];
    static uint32_t results[SOME][4], folded[SOME][4];
    fill(operands);
    float some[SOME][4];
    for (int i = 0; i < SOME; i++) {
        memcpy(some[i], operands[i * (ROWS / SOME) + i], sizeof some[i]);
    }
    for (int which = 0; which < 79; which++) {
        if (which > 46 && (which < 50 || (which > 63 && which < 70))) {
            continue;
        }
        function_rig_run(which, (const float(*)[4])some, SOME, false, results);
        function_rig_run(which, (const float(*)[4])some, SOME, true, folded);
        for (int i = 0; i < SOME; i++) {
            compare(which, some[i], folded[i], results[i]);
        }
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_results_are_those_of_the_definitions),
    cmocka_unit_test(test_constants_give_the_same),
};

const struct unit_tests test_spirv_numbers = UNIT_TESTS(tests, NULL, NULL);
