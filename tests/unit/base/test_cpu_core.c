// SPDX-License-Identifier: MIT
// Threads that move to another core, and what they may use afterwards.
#if defined(__linux__) && !defined(_GNU_SOURCE)
#define _GNU_SOURCE // for sched_getaffinity
#endif
#include "harness.h"

#include "base/cpu.h"

#if defined(__linux__)
#include <sched.h>

static void skip_where_refused(void)
{
    cpu_set_t all;
    if (sched_getaffinity(0, sizeof all, &all) != 0 || sched_setaffinity(0, sizeof all, &all) != 0) {
        skip();
    }
}

// The system may move a thread back as soon as it may use the core again, so that one time of many has to do.
static void test_a_thread_leaves_its_core(void **state)
{
    (void)state;
    skip_where_refused();
    cpu_set_t before;
    assert_int_equal(sched_getaffinity(0, sizeof before, &before), 0);
    bool left = false;
    for (int i = 0; i < 100; i++) {
        const int core = rhw_cpu_core();
        assert_in_range(core, 0, CPU_SETSIZE - 1);
        rhw_cpu_leave(core);
        left |= rhw_cpu_core() != core;
        cpu_set_t after;
        assert_int_equal(sched_getaffinity(0, sizeof after, &after), 0);
        assert_true(CPU_EQUAL(&before, &after));
    }
    assert_int_equal(left, CPU_COUNT(&before) > 1);
}

static void test_a_thread_with_one_core_stays(void **state)
{
    (void)state;
    skip_where_refused();
    cpu_set_t before, one;
    assert_int_equal(sched_getaffinity(0, sizeof before, &before), 0);
    const int core = rhw_cpu_core();
    CPU_ZERO(&one);
    CPU_SET((size_t)core, &one);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    const int own = rhw_cpu_core();
    rhw_cpu_leave(own);
    cpu_set_t after;
    const int asked = sched_getaffinity(0, sizeof after, &after);
    assert_int_equal(sched_setaffinity(0, sizeof before, &before), 0);
    assert_int_equal(asked, 0);
    assert_int_equal(own, core);
    assert_true(CPU_EQUAL(&one, &after));
}

static void test_a_core_that_is_none_is_not_left(void **state)
{
    (void)state;
    cpu_set_t before, after;
    assert_int_equal(sched_getaffinity(0, sizeof before, &before), 0);
    rhw_cpu_leave(-1);
    rhw_cpu_leave(1 << 30);
    assert_int_equal(sched_getaffinity(0, sizeof after, &after), 0);
    assert_true(CPU_EQUAL(&before, &after));
}
#else
static void test_cores_without_a_name(void **state)
{
    (void)state;
    assert_int_equal(rhw_cpu_core(), -1);
    rhw_cpu_leave(0);
}
#endif

static const struct CMUnitTest tests[] = {
#if defined(__linux__)
    cmocka_unit_test(test_a_thread_leaves_its_core),
    cmocka_unit_test(test_a_thread_with_one_core_stays),
    cmocka_unit_test(test_a_core_that_is_none_is_not_left),
#else
    cmocka_unit_test(test_cores_without_a_name),
#endif
};

const struct unit_tests test_cpu_core = UNIT_TESTS(tests, NULL, NULL);
