// SPDX-License-Identifier: MIT
// Large blocks are marked for huge pages, where Linux lists the marks; small ones are not, and no byte changes. A heap
// that is asked for is marked.
#include "unit.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "huge_page_mark.h"
#include "huge_pages.h"
#include "sanitizer.h"

enum { MEBIBYTE = 1 << 20 };

static void test_large_blocks_are_marked(void **state)
{
    (void)state;
    unsigned char *const block = malloc(16 * MEBIBYTE);
    assert_non_null(block);
    block[0] = 1;
    block[16 * MEBIBYTE - 1] = 2;
    system_huge_pages_prefer(block, MEBIBYTE);
    assert_int_not_equal(huge_page_mark(block + 8 * MEBIBYTE), 1);
    system_huge_pages_prefer(block, 16 * MEBIBYTE);
    const int marked = huge_page_mark(block + 8 * MEBIBYTE);
    assert_int_equal(block[0], 1);
    assert_int_equal(block[16 * MEBIBYTE - 1], 2);
    free(block);
    if (marked < 0) {
        skip();
    }
    assert_int_equal(marked, 1);
}

// Ask for a heap on huge pages in a process of its own, which this one is not to be. Return what huge_page_mark says of
// a block of a megabyte there, or 2 if it is not zeroed where it should be.
static int marks_heap(void)
{
    const pid_t child = fork();
    if (child == 0) {
        system_huge_pages_prefer_heap(64 * MEBIBYTE);
        unsigned char *const dirty = malloc(MEBIBYTE);
        memset(dirty, 1, MEBIBYTE);
        free(dirty);
        const unsigned char *const block = calloc(MEBIBYTE, 1);
        bool is_zero = true;
        for (size_t i = 0; i < MEBIBYTE; i++) {
            is_zero = is_zero && block[i] == 0;
        }
        _exit(is_zero ? huge_page_mark(block + MEBIBYTE / 2) + 1 : 3); // it may begin in what was there
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status) - 1;
}

static void test_heap_is_marked(void **state)
{
    (void)state;
    const int marked = marks_heap();
    assert_int_not_equal(marked, 2);
#if defined(__GLIBC__)
    if (marked >= 0 && !SYSTEM_SANITIZED) {
        assert_int_equal(marked, 1);
    }
#endif
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_large_blocks_are_marked),
    cmocka_unit_test(test_heap_is_marked),
};

const struct unit_tests test_huge_pages = UNIT_TESTS(tests, NULL, NULL);
