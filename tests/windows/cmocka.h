// SPDX-License-Identifier: MIT
// What the unit tests use of cmocka, which Debian has not for Windows: the first assertion that fails ends the program.
#ifndef TEST_CMOCKA_H
#define TEST_CMOCKA_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

struct CMUnitTest {
    const char *name;
    void (*function)(void **state);
};

typedef int cmocka_fixture(void **state);

#define cmocka_unit_test(function) \
    {                              \
        #function, function        \
    }
#define cmocka_run_group_tests_name(name, tests, setup, teardown) \
    test_run(tests, sizeof(tests) / sizeof(tests)[0], setup, teardown)
/// Passes over tests without a name.
int test_run(const struct CMUnitTest *tests, size_t count, cmocka_fixture *setup, cmocka_fixture *teardown);

/// Ends the program with a line that begins with the place.
_Noreturn void test_fail(const char *file, int line, const char *format, ...);
/// Ends the test that is running, which has neither passed nor failed.
_Noreturn void test_skip(void);
#define skip()             test_skip()
#define fail_msg(...)      test_fail(__FILE__, __LINE__, __VA_ARGS__)
#define print_message(...) ((void)printf(__VA_ARGS__))

#define test_require(condition, ...) ((condition) ? (void)0 : test_fail(__FILE__, __LINE__, __VA_ARGS__))
#define assert_true(a)               test_require(a, "%s", #a)
#define assert_false(a)              test_require(!(a), "!(%s)", #a)
#define assert_null(a)               test_require((a) == NULL, "%s is NULL", #a)
#define assert_non_null(a)           test_require((a) != NULL, "%s is not NULL", #a)
#define assert_ptr_equal(a, b)       test_require((const void *)(a) == (const void *)(b), "%s is %s", #a, #b)
#define assert_ptr_not_equal(a, b) \
    test_require((const void *)(a) != (const void *)(b), "%s is not %s", #a, #b)

// As cmocka does, numbers are compared as the widest integers.
void test_compare_integers(const char *file, int line, const char *text, uintmax_t a, uintmax_t b, int equal);
#define assert_int_equal(a, b) \
    test_compare_integers(__FILE__, __LINE__, #a, (uintmax_t)(a), (uintmax_t)(b), 1)
#define assert_int_not_equal(a, b) \
    test_compare_integers(__FILE__, __LINE__, #a, (uintmax_t)(a), (uintmax_t)(b), 0)
#define assert_in_range(a, least, most)                                                       \
    test_require((uintmax_t)(a) >= (uintmax_t)(least) && (uintmax_t)(a) <= (uintmax_t)(most), \
                 "%s is in %s .. %s", #a, #least, #most)
void test_compare_floats(const char *file, int line, const char *text, float a, float b, float most);
#define assert_float_equal(a, b, most) test_compare_floats(__FILE__, __LINE__, #a, a, b, most)
void test_compare_bytes(const char *file, int line, const char *text, const void *a, const void *b,
                        size_t size, int equal);
#define assert_memory_equal(a, b, size)     test_compare_bytes(__FILE__, __LINE__, #a, a, b, size, 1)
#define assert_memory_not_equal(a, b, size) test_compare_bytes(__FILE__, __LINE__, #a, a, b, size, 0)
void test_compare_strings(const char *file, int line, const char *a, const char *b, int equal);
#define assert_string_equal(a, b)     test_compare_strings(__FILE__, __LINE__, a, b, 1)
#define assert_string_not_equal(a, b) test_compare_strings(__FILE__, __LINE__, a, b, 0)

#endif
