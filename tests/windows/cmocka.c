// SPDX-License-Identifier: MIT
#include "cmocka.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

_Noreturn void test_fail(const char *file, int line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    printf("%s:%d: ", file, line);
    vprintf(format, arguments);
    printf("\n");
    va_end(arguments);
    exit(1);
}

static jmp_buf end_of_test;

_Noreturn void test_skip(void)
{
    longjmp(end_of_test, 1);
}

// Run a test. Return false if it was skipped.
static bool run_one(const struct CMUnitTest *test, void **state)
{
    if (setjmp(end_of_test) != 0) {
        return false;
    }
    test->function(state);
    return true;
}

int test_run(const struct CMUnitTest *tests, size_t count, cmocka_fixture *setup, cmocka_fixture *teardown)
{
    void *state = NULL;
    if (setup && setup(&state) != 0) {
        return 1;
    }
    size_t passed = 0;
    for (size_t i = 0; i < count; i++) {
        if (tests[i].name) {
            printf("%s\n", tests[i].name);
            fflush(stdout); // so that a crash loses no line
            passed += run_one(&tests[i], &state);
        }
    }
    printf("%zu passed, 0 failed\n", passed);
    return teardown ? teardown(&state) : 0;
}

void test_compare_integers(const char *file, int line, const char *text, uintmax_t a, uintmax_t b, int equal)
{
    if ((a == b) != equal) {
        test_fail(file, line, "%s is %jd, not %s%jd", text, (intmax_t)a, equal ? "" : "another than ",
                  (intmax_t)b);
    }
}

void test_compare_floats(const char *file, int line, const char *text, float a, float b, float most)
{
    if (!(fabsf(a - b) <= most)) {
        test_fail(file, line, "%s is %.9g, not %.9g", text, (double)a, (double)b);
    }
}

void test_compare_bytes(const char *file, int line, const char *text, const void *a, const void *b,
                        size_t size, int equal)
{
    if ((memcmp(a, b, size) == 0) != equal) {
        test_fail(file, line, "%zu bytes of %s are %s", size, text, equal ? "others" : "the same");
    }
}

void test_compare_strings(const char *file, int line, const char *a, const char *b, int equal)
{
    if ((strcmp(a, b) == 0) != equal) {
        test_fail(file, line, "'%s' is %s'%s'", a, equal ? "not " : "", b);
    }
}
