// SPDX-License-Identifier: MIT
// Files that are being written: without a name until the end where the system has that, else with one that tells whether
// its process lives.
#include "unit.h"

#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file.h"
#include "temporary_file.h"

static char folder[512], path[600], other[600];

static int make_folder(void **state)
{
    (void)state;
    const bool made = system_folder_make_unnamed(folder, sizeof folder);
    snprintf(path, sizeof path, "%s/written.tmp", folder);
    snprintf(other, sizeof other, "%s/target", folder);
    return made ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    unlink(path);
    unlink(other);
    return rmdir(folder);
}

static bool is_there(const char *name)
{
    return access(name, F_OK) == 0;
}

// It is its writer's until that closes it, or ends.
static void test_a_leftover_is_removed(void **state)
{
    (void)state;
    const int descriptor = system_temporary_file_create(path);
    assert_true(descriptor >= 0);
    assert_int_equal(system_temporary_file_create(path), -1);
    assert_int_equal(errno, EEXIST);
    assert_false(system_temporary_file_remove(path));
    assert_true(is_there(path));
    close(descriptor);
    assert_true(system_temporary_file_remove(path));
    assert_false(is_there(path));
    assert_false(system_temporary_file_remove(path));
    assert_false(system_temporary_file_remove(folder)); // it is no file
}

static void test_a_named_file_takes_the_place_of_another(void **state)
{
    (void)state;
    for (int round = 0; round < 2; round++) {
        int descriptor = system_temporary_file_create(path);
        assert_true(descriptor >= 0);
        assert_int_equal(write(descriptor, "text", 4), 4);
        assert_true(system_temporary_file_replace(&descriptor, path, other));
        if (descriptor >= 0) {
            close(descriptor);
        }
        assert_false(is_there(path));
        assert_true(is_there(other));
    }
}

static void test_an_unnamed_file_gets_a_name(void **state)
{
    (void)state;
    const int descriptor = system_temporary_file_open(folder);
    if (descriptor < 0) {
        skip(); // there are none on this system, or in this folder
    }
    assert_int_equal(rmdir(folder), 0); // it is empty
    assert_true(system_folder_make(folder));
    close(descriptor);
    const int again = system_temporary_file_open(folder);
    assert_int_equal(write(again, "text", 4), 4);
    assert_true(system_temporary_file_name(again, path));
    assert_false(system_temporary_file_name(again, path));
    assert_int_equal(errno, EEXIST);
    assert_false(system_temporary_file_remove(path)); // it is still being written
    close(again);
    struct stat status;
    assert_int_equal(stat(path, &status), 0);
    assert_int_equal(status.st_size, 4);
    assert_int_equal(status.st_nlink, 1);
}

// Anything else may be waited for, or do something.
static void test_only_regular_files_are_opened(void **state)
{
    (void)state;
    assert_int_equal(system_file_open_regular(path), -1);
    assert_int_equal(errno, ENOENT);
    assert_int_equal(system_file_open_regular(folder), -1);
    assert_int_equal(errno, EISDIR);
    struct stat status;
    if (stat("/dev/null", &status) == 0) {
        assert_int_equal(system_file_open_regular("/dev/null"), -1);
        assert_int_equal(errno, 0);
    }
    close(system_temporary_file_create(path));
    const int descriptor = system_file_open_regular(path);
    assert_true(descriptor >= 0);
    close(descriptor);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test_setup_teardown(test_a_leftover_is_removed, make_folder, remove_folder),
    cmocka_unit_test_setup_teardown(test_a_named_file_takes_the_place_of_another, make_folder, remove_folder),
    cmocka_unit_test_setup_teardown(test_an_unnamed_file_gets_a_name, make_folder, remove_folder),
    cmocka_unit_test_setup_teardown(test_only_regular_files_are_opened, make_folder, remove_folder),
};

const struct unit_tests test_temporary_file = UNIT_TESTS(tests, NULL, NULL);
