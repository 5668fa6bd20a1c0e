// SPDX-License-Identifier: MIT
// Children and what they use: a process has a copy of it; a thread, on Windows, uses it for as long as it runs, however long
// anybody waits.
#include "unit.h"

#include <errno.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "child.h"

enum { STATUS = 7 };
static const char text[] = "what the child uses";

struct errand {
    char text[sizeof text];
    unsigned seconds; // to sleep
    bool leaves;      // by system_child_leave
};

static atomic_int released;
static atomic_bool is_thread, found_it_changed,
    is_done; // said by the child; a process says it to itself alone

static void release(void *user)
{
    struct errand *const errand = user;
    memset(errand, 0, sizeof *errand);
    free(errand);
    atomic_fetch_add(&released, 1);
}

static int run(void *user, struct system_child *child)
{
    const struct errand *const errand = user;
    atomic_store(&is_thread, true);
    for (unsigned s = 0; s < errand->seconds; s++) {
        sleep(1);
        if (strcmp(errand->text, text) != 0) {
            atomic_store(&found_it_changed, true);
            return 1;
        }
    }
    fputs(errand->text, child->reply);
    const bool leaves = errand->leaves;
    atomic_store(&is_done, true);
    if (leaves) {
        system_child_leave(child, STATUS);
    }
    return STATUS;
}

// A child with a second of time, that takes these seconds.
static struct system_child_work work_of(unsigned seconds, bool leaves)
{
    struct errand *const errand = malloc(sizeof *errand);
    assert_non_null(errand);
    *errand = (struct errand){.seconds = seconds, .leaves = leaves};
    memcpy(errand->text, text, sizeof text);
    atomic_store(&released, 0);
    atomic_store(&is_thread, false);
    atomic_store(&found_it_changed, false);
    atomic_store(&is_done, false);
    return (struct system_child_work){
        .run = run, .user = errand, .release = release, .cpu_seconds = 5, .wall_seconds = 1};
}

// A thread may be the last to use it, a moment after it was heard of.
static void assert_released_once(void)
{
    for (int tries = 0; tries < 100 && atomic_load(&released) == 0; tries++) {
        usleep(100000);
    }
    usleep(100000);
    assert_int_equal(atomic_load(&released), 1);
    assert_false(atomic_load(&found_it_changed));
}

static void assert_reply(struct system_child_result *result)
{
    char reply[64] = "";
    rewind(result->reply.stream);
    assert_int_equal(fread(reply, 1, sizeof reply, result->reply.stream), strlen(text));
    assert_string_equal(reply, text);
    system_memory_file_close(&result->reply);
}

static void test_a_child_that_ends(void **state)
{
    (void)state;
    for (int leaves = 0; leaves < 2; leaves++) {
        const struct system_child_work work = work_of(0, leaves);
        struct system_child_result result = system_child_run(&work);
        assert_int_equal(result.end, SYSTEM_CHILD_LEFT);
        assert_int_equal(result.number, STATUS);
        assert_reply(&result);
        assert_released_once();
    }
}

static void test_a_child_that_runs_out_of_time(void **state)
{
    (void)state;
    for (int leaves = 0; leaves < 2; leaves++) {
        const struct system_child_work work = work_of(3, leaves);
        struct system_child_result result = system_child_run(&work);
        assert_int_equal(result.end, SYSTEM_CHILD_WALL_TIME);
        if (atomic_load(&is_thread)) {
            assert_int_equal(atomic_load(&released), 0);
            assert_false(atomic_load(&is_done));
        }
        system_memory_file_close(&result.reply);
        assert_released_once();
        assert_int_equal(atomic_load(&is_done), atomic_load(&is_thread));
    }
}

static void test_a_thread_that_borrows_is_waited_for(void **state)
{
    (void)state;
    struct system_child_work work = work_of(2, false);
    work.is_borrowing = true;
    struct system_child_result result = system_child_run(&work);
    if (atomic_load(&is_thread)) {
        assert_int_equal(result.end, SYSTEM_CHILD_LEFT);
        assert_reply(&result);
    } else {
        assert_int_equal(result.end, SYSTEM_CHILD_WALL_TIME);
        system_memory_file_close(&result.reply);
    }
    assert_released_once();
}

static bool never(void *user)
{
    (void)user;
    return false;
}

static void test_a_child_that_is_given_up(void **state)
{
    (void)state;
    struct system_child_work work = work_of(1, false);
    work.wall_seconds = 20;
    work.goes_on = never;
    struct system_child_result result = system_child_run(&work);
    assert_int_equal(result.end, SYSTEM_CHILD_GIVEN_UP);
    system_memory_file_close(&result.reply);
    assert_int_equal(atomic_load(&is_done), atomic_load(&is_thread));
    assert_released_once();
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_a_child_that_ends),
    cmocka_unit_test(test_a_child_that_runs_out_of_time),
    cmocka_unit_test(test_a_thread_that_borrows_is_waited_for),
    cmocka_unit_test(test_a_child_that_is_given_up),
};

const struct unit_tests test_child = UNIT_TESTS(tests, NULL, NULL);
