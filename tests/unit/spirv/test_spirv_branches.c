// SPDX-License-Identifier: MIT
// Control flow in lanes that go different ways, against the functions of the text in C, one invocation after the other.
// The optimized words have phis where the plain ones have variables.
#include "spirv_run.h"

#include "branches_comp.h"
#include "branches_comp_small.h"

enum { INVOCATIONS = 128, NUMBERS = 11, UNTOUCHED = 0x55555555 };

static int32_t source[INVOCATIONS];

static int32_t collatz(int32_t n)
{
    int32_t steps = 0;
    while (n != 1 && steps < 200) {
        n = (n & 1) == 0 ? n / 2 : 3 * n + 1;
        steps++;
    }
    return steps;
}

static int32_t find(int32_t x)
{
    for (int32_t i = 0; i < 40; i++) {
        if (source[i] == x) {
            return i;
        }
        if (source[i] <= 38 && i == x + 5) {
            break;
        }
    }
    return -1;
}

static int32_t fall(int32_t x)
{
    int32_t r = 0;
    switch (x % 9) {
    case 0: return 11;
    case 1: return 10;
    case 2:
        for (int32_t i = 0; i < x && i < 7; i++) {
            r += i;
        }
        return r + (x > 20 ? 100 : 1105);
    case 3: return x > 20 ? 100 : 1105;
    case 5: return -x;
    case 6:
    case 7: return 77;
    default: return 5;
    }
}

static int32_t nested(int32_t x)
{
    int32_t sum = 0;
    for (int32_t i = 0; i < 10; i++) {
        for (int32_t j = 0; j < 10; j++) {
            if (j != x % 7 && i * j > x) {
                break;
            }
            if (j != x % 7 && (j & 3) != 0) {
                sum = (sum + ((j & 3) == 1 ? 2 : i)) ^ j;
            }
        }
        if (sum > 300) {
            return sum;
        }
    }
    return sum + 1000;
}

static int32_t at_least_once(int32_t x)
{
    int32_t k = 0;
    do {
        k += 3;
        if (k == x) {
            break;
        }
        k += k % 2 != 0;
    } while (k < x);
    return k;
}

// The first call decides whether there is a second, and both whether there is a third.
static int32_t lazy(int32_t x)
{
    int32_t c = x + 1;
    bool holds = c % 2 == 0;
    if (holds) {
        c++;
        holds = c % 2 == 0;
    }
    if (!holds) {
        c++;
        holds = c % 2 == 0;
    }
    return holds ? c + 100 : c;
}

static void model(int32_t x, int32_t expected[NUMBERS])
{
    int32_t sum = 0;
    expected[0] = collatz(x + 1);
    expected[1] = find(x);
    expected[2] = fall(x);
    expected[3] = nested(x);
    expected[4] = at_least_once(x);
    expected[5] = lazy(x);
    expected[6] = 2 * x;
    expected[7] = x > 20 ? 4 * x : -4 * x;
    expected[8] = x < 10 ? 1 : x >= 20 ? 3 : x % 2 == 0 ? 2 : 4;
    for (int32_t i = 0; i < 3; i++) {
        for (int32_t j = 0; j < 3 && x != 5; j++) {
            if (i == 1 && x > 3) {
                sum += 7;
                break;
            }
            sum += i * j;
        }
        sum += x == 5 && i == 1 ? 7 : 0;
    }
    expected[9] = sum;
    for (int32_t i = x; i <= 50; i += 3) {
        sum += i;
        if (sum > 400) {
            expected[10] = UNTOUCHED;
            return;
        }
    }
    expected[10] = sum + 1000;
}

static void check(const uint32_t *words, size_t size)
{
    static int32_t sink[INVOCATIONS][NUMBERS];
    for (int i = 0; i < INVOCATIONS; i++) {
        source[i] = i * 37 % 61;
    }
    memset(sink, 0x55, sizeof sink);
    const struct spirv_bytes memory[] = {{source, sizeof source, true}, {sink, sizeof sink, false}};
    spirv_run(spirv_create(words, size, RHW_SHADER_COMPUTE), memory, 2, NULL, 0, INVOCATIONS / 64);
    for (int i = 0; i < INVOCATIONS; i++) {
        int32_t expected[NUMBERS];
        model(source[i], expected);
        for (int n = 0; n < NUMBERS; n++) {
            if (sink[i][n] != expected[n]) {
                fail_msg("of %d, number %d: %d, not %d", (int)source[i], n, (int)sink[i][n],
                         (int)expected[n]);
            }
        }
    }
}

static void test_lanes_go_different_ways(void **state)
{
    (void)state;
    check(branches_comp, sizeof branches_comp);
}

static void test_phis_take_what_each_way_gives(void **state)
{
    (void)state;
    check(branches_comp_small, sizeof branches_comp_small);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_lanes_go_different_ways),
    cmocka_unit_test(test_phis_take_what_each_way_gives),
};

const struct unit_tests test_spirv_branches = UNIT_TESTS(tests, NULL, NULL);
