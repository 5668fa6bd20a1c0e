// SPDX-License-Identifier: MIT
// How a file of unit tests is found by the program of its room. A file ends with its tests and one line of its own name:
//     const struct unit_tests test_query = UNIT_TESTS(tests, NULL, NULL);
// tests/unit/rooms.cmake lists the files of a room for unit.c, which has main.
#ifndef TEST_UNIT_H
#define TEST_UNIT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

typedef int unit_fixture(void **state);

/// The tests of one file; what runs before the first and after the last of them may be NULL, and returns 0 for success.
struct unit_tests {
    const struct CMUnitTest *tests;
    size_t count;
    unit_fixture *setup, *teardown;
};

#define UNIT_TESTS(tests, setup, teardown)                       \
    {                                                            \
        tests, sizeof(tests) / sizeof(tests)[0], setup, teardown \
    }

struct unit_file {
    const char *name; ///< without its ending
    const struct unit_tests *tests;
};

/// The files of the room. The last row has no name.
extern const struct unit_file unit_files[];

#endif
