// SPDX-License-Identifier: MIT
// Decimal numbers against strtod, bit by bit: numbers of any length, and those halfway between two doubles.
#include "import/builder/decimal.h"
#include "import/builder/text_lines.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unit.h"

static uint64_t random_state = 88172645463325252u;

static uint64_t next_random(void)
{
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return random_state;
}

// Read a number that has nothing behind it, not even a zero.
static void check(const char *text)
{
    const size_t length = strlen(text);
    char *const bytes = malloc(length);
    memcpy(bytes, text, length);
    double value = 0;
    const char *const stop = scene_decimal_read(bytes, bytes + length, &value);
    const double right = strtod(text, NULL);
    if (stop != bytes + length || memcmp(&value, &right, sizeof value) != 0) {
        fail_msg("%s is read as %.17g", text, value);
    }
    free(bytes);
}

// Write digits with a point behind the first `before` of them, or none, and an exponent unless it is 0.
static void check_parts(uint64_t whole, unsigned before, int exponent)
{
    char digits[24], text[48];
    const unsigned count = (unsigned)snprintf(digits, sizeof digits, "%llu", (unsigned long long)whole);
    const char *const sign = next_random() % 2 == 0 ? "-" : "";
    const unsigned split = before < count ? before : count;
    const char *const point = before < count || next_random() % 4 == 0 ? "." : "";
    int length = snprintf(text, sizeof text, "%s%.*s%s%s", sign, (int)split, digits, point, digits + split);
    if (exponent != 0) {
        length += snprintf(text + length, sizeof text - (size_t)length, "e%d", exponent);
    }
    check(text);
}

static void test_random(void **state)
{
    (void)state;
    for (int i = 0; i < 30000; i++) {
        const unsigned shift = (unsigned)(next_random() % 64), before = (unsigned)(next_random() % 22);
        const int exponent = next_random() % 2 == 0 ? 0 : (int)(next_random() % 90) - 45;
        check_parts(next_random() >> shift, before, exponent);
    }
}

// Odd numbers of 54 bits over a power of two lie halfway between two doubles. Their neighbours in the last digit do
// not.
static void test_halfway(void **state)
{
    (void)state;
    for (int i = 0; i < 30000; i++) {
        const uint64_t odd = (next_random() >> 11) | (uint64_t)1 << 53 | 1;
        uint64_t whole = odd;
        const unsigned twos = (unsigned)(next_random() % 4);
        for (unsigned k = 0; k < twos; k++) {
            whole *= 5;
        }
        char digits[24];
        const unsigned count = (unsigned)snprintf(digits, sizeof digits, "%llu", (unsigned long long)whole);
        const uint64_t near = whole + next_random() % 3 - 1;
        check_parts(near, count - twos, 0);
        check_parts(near, count, -(int)twos);
        check_parts(odd << next_random() % 10, 24, 0);
    }
}

static void test_lengths(void **state)
{
    (void)state;
    char text[101]; // digits after the hundredth are left out
    for (size_t length = 1; length < sizeof text; length++) {
        memset(text, '7', length);
        text[length] = 0;
        check(text);
        text[length / 2] = '.';
        if (length > 1) {
            check(text);
        }
        memset(text, '0', length);
        text[length / 2] = '.';
        text[length - 1] = '3';
        check(text);
    }
}

// Whole digits after the hundredth count as 0, with their place.
static void test_many_digits(void **state)
{
    (void)state;
    char text[256];
    memset(text, '0', sizeof text);
    text[0] = '2';
    for (int i = 0; i < 3; i++) {
        static const char *const ends[] = {"", ".5", "e-149"};
        strcpy(text + 150, ends[i]);
        check(text);
    }
}

// A word of a million numbers takes as long as numbers that are apart, which a pass over the word for each would not.
static void test_words_of_numbers(void **state)
{
    (void)state;
    enum { COUNT = 1000000 };
    char *const text = malloc(2 * COUNT);
    for (int i = 0; i < COUNT; i++) {
        memcpy(text + 2 * (size_t)i, "-1", 2);
    }
    const char *place = text;
    double value, sum = 0;
    while ((place = scene_number_read(place, text + 2 * (size_t)COUNT, " ", &value)) != NULL) {
        sum += value;
    }
    assert_true(sum == -COUNT);
    free(text);
    static const char special[] = "1.#IND,2,-inf";
    place = scene_number_read(special, special + strlen(special), ",", &value);
    assert_true(place == special + 6 && value != value);
    place = scene_number_read(special + 9, special + strlen(special), ",", &value);
    assert_true(place == special + strlen(special) && value < 0 && value * 2 == value);
    assert_null(scene_number_read(special + 2, special + strlen(special), ",", &value));
}

static void test_ends(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int length; // 0 if there is no number
    } samples[] = {{"", 0},      {"-", 0},    {".", 0},    {"e5", 0},     {"x", 0},          {"1x", 1},
                   {"1.5.5", 3}, {"1e+", 1},  {"1e-x", 1}, {"1E+07z", 5}, {"12345678/9", 8}, {"+.5 ", 3},
                   {"-0", 2},    {"5.e1", 4}, {"1 2", 1},  {"1:", 1},     {"1\xff", 1}};
    for (size_t i = 0; i < sizeof samples / sizeof samples[0]; i++) {
        const char *const text = samples[i].text;
        double value;
        const char *const stop = scene_decimal_read(text, text + strlen(text), &value);
        assert_int_equal(stop == NULL ? 0 : stop - text, samples[i].length);
    }
}

static void test_digits(void **state)
{
    (void)state;
    uint32_t value;
    const char text[] = "0123456789/";
    assert_int_equal(scene_decimal_digits(text, text + 10, &value), 8);
    assert_int_equal(value, 1234567);
    assert_int_equal(scene_decimal_digits(text + 5, text + 11, &value), 5);
    assert_int_equal(value, 56789);
    assert_int_equal(scene_decimal_digits(text + 5, text + 7, &value), 2);
    assert_int_equal(value, 56);
    assert_int_equal(scene_decimal_digits(text + 10, text + 11, &value), 0);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_random),           cmocka_unit_test(test_halfway),
    cmocka_unit_test(test_lengths),          cmocka_unit_test(test_ends),
    cmocka_unit_test(test_digits),           cmocka_unit_test(test_many_digits),
    cmocka_unit_test(test_words_of_numbers),
};

const struct unit_tests test_decimal = UNIT_TESTS(tests, NULL, NULL);
