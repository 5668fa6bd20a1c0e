// SPDX-License-Identifier: MIT
// Rounds of loops that stand one behind the other compute what the loops do.
#include "rounds_comp.h"
#include "rounds_comp_small.h"
#include "shares_comp.h"
#include "spirv_run.h"

enum { INVOCATIONS = 64, RESULTS = 8 };

// The source of rounds.comp in C.
static void model(int32_t given, int32_t result[RESULTS])
{
    int32_t numbers[9], large[24] = {0}, sum = 0, left = 0, k = 0;
    for (int n = 0; n < 9; n++) {
        numbers[n] = given * n + 3;
    }
    for (int n = 8; n >= 0; n -= 2) {
        sum = (int32_t)((uint32_t)sum * 7 + (uint32_t)numbers[n]);
    }
    for (unsigned n = 1; n != 16; n += 3) {
        sum ^= (int32_t)((uint32_t)numbers[n & 7] << n);
    }
    result[0] = sum;
    for (int y = 0; y < 3; y++) {
        for (int x = 0; x <= 2; x++) {
            numbers[3 * y + x] += 10 * numbers[3 * x + y];
        }
    }
    result[1] = numbers[1] + 3 * numbers[3] + 5 * numbers[8];
    for (int n = 0; n < 9; n++) {
        if (numbers[n] % 5 == 0) {
            continue;
        }
        left += numbers[n] + n;
        if (left > 200 * (given & 3)) {
            break;
        }
    }
    result[2] = left;
    result[3] = 0;
    while (numbers[result[3]] != numbers[given % 9]) {
        result[3]++;
    }
    int32_t guarded = 0, skipped = 0, many = 0, last = 0;
    for (; k < 12; k++) {
        guarded += k < 9 ? numbers[k] + k : k;
    }
    result[4] = guarded + k;
    for (int j = 0; j < 9; j += given % 3 == 1 ? 2 : 1) {
        skipped += numbers[j];
    }
    int place = 0;
    while (place < 9 && numbers[place] <= 30 * given) {
        place++;
    }
    result[5] = skipped + 1000 * place;
    for (int j = 0; j < 100; j++) {
        large[j % 24] = j * given;
        many += large[(j * 5) % 24 <= j ? (j * 5) % 24 : j % 24];
    }
    for (int j = 0; j < given % 9; j++) {
        many -= numbers[j];
    }
    result[6] = many;
    for (int j = 0; j < 9; j++) {
        last = (int32_t)((uint32_t)last * 3 + (uint32_t)numbers[j]);
    }
    int32_t turned = given;
    for (int n = 0; n < 4; n++) {
        turned = turned > 1000 ? turned - 7 * (n + given) : 3 * turned + n + given;
    }
    for (int n = 0; n < 5; n++) {
        turned ^= given + n;
    }
    result[7] = (int32_t)((uint32_t)last + (uint32_t)turned);
}

static void check(const uint32_t *words, size_t size)
{
    int32_t source[INVOCATIONS], sink[INVOCATIONS][RESULTS];
    for (int i = 0; i < INVOCATIONS; i++) {
        source[i] = i * 37 % 40;
    }
    const struct spirv_bytes bindings[] = {{source, sizeof source, true}, {sink, sizeof sink, false}};
    spirv_run(spirv_create(words, size, RHW_SHADER_COMPUTE), bindings, 2, NULL, 0, INVOCATIONS / 32);
    for (int i = 0; i < INVOCATIONS; i++) {
        int32_t expected[RESULTS];
        model(source[i], expected);
        for (int r = 0; r < RESULTS; r++) {
            if (sink[i][r] != expected[r]) {
                fail_msg("invocation %d, result %d: %d, not %d", i, r, (int)sink[i][r], (int)expected[r]);
            }
        }
    }
}

static void test_rounds_compute_what_loops_do(void **state)
{
    (void)state;
    check(rounds_comp, sizeof rounds_comp);
    check(rounds_comp_small, sizeof rounds_comp_small);
}

static char printed[1 << 16];

static void keep(void *user, const char *text, size_t size)
{
    size_t *const length = user;
    assert_true(*length + size < sizeof printed);
    memcpy(printed + *length, text, size);
    *length += size;
    printed[*length] = 0;
}

// Print a compute shader behind the passes, and return how often a text stands there.
static int count_printed(const uint32_t *words, size_t size, const char *text)
{
    const struct rhw_shader_def def = {.stage = RHW_SHADER_COMPUTE};
    size_t length = 0;
    int count = 0;
    assert_int_equal(rhw_shader_print(words, size, &def, RHW_SHADER_PASSED, keep, &length, NULL), RHW_OK);
    for (const char *at = strstr(printed, text); at; at = strstr(at + 1, text)) {
        count++;
    }
    return count;
}

// Loops stay that count to what is not constant or further than the rounds that are repeated, whose counter is changed in
// the round, that test at the end, or whose counter is no index and counts further than 4.
static void test_only_loops_whose_rounds_are_known_are_repeated(void **state)
{
    (void)state;
    assert_int_equal(count_printed(rounds_comp, sizeof rounds_comp, "end_loop"), 5);
}

// Loops without an index leave those that have one their share: four of five are repeated, and the long one behind them.
static void test_each_kind_of_loop_has_its_share(void **state)
{
    (void)state;
    assert_int_equal(count_printed(shares_comp, sizeof shares_comp, "end_loop"), 1);
    assert_int_equal(count_printed(shares_comp, sizeof shares_comp, " 33331"), 8);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_rounds_compute_what_loops_do),
    cmocka_unit_test(test_only_loops_whose_rounds_are_known_are_repeated),
    cmocka_unit_test(test_each_kind_of_loop_has_its_share),
};

const struct unit_tests test_spirv_rounds = UNIT_TESTS(tests, NULL, NULL);
