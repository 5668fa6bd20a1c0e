// SPDX-License-Identifier: MIT
// The program of a room: runs the tests of its files, or lists them.
#include "unit.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MOST_TESTS = 64 }; // of a file

static void list_tests(void)
{
    for (const struct unit_file *file = unit_files; file->name; file++) {
        printf("%s\n", file->name);
        for (size_t i = 0; i < file->tests->count; i++) {
            printf("    %s\n", file->tests->tests[i].name);
        }
    }
}

static bool is_file(const char *name)
{
    const struct unit_file *file = unit_files;
    while (file->name && strcmp(file->name, name) != 0) {
        file++;
    }
    return file->name;
}

// The name of a file picks this file alone, so that test_depth leaves test_depth_state out. Any other pattern picks each test
// that has it in its name or in the name of its file.
static bool is_picked(const struct unit_file *file, const char *test, const char *pattern)
{
    if (is_file(pattern)) {
        return strcmp(file->name, pattern) == 0;
    }
    return strstr(file->name, pattern) || strstr(test, pattern);
}

// Runs what the pattern picks of a file and adds how many tests that is. Returns 0 if they pass.
static int run_file(const struct unit_file *file, const char *pattern, size_t *run)
{
    struct CMUnitTest picked[MOST_TESTS] = {{0}}; // cmocka passes over a row without a name
    const struct unit_tests *const all = file->tests;
    size_t count = 0;
    if (all->count > MOST_TESTS) {
        fprintf(stderr, "%s has %zu tests; unit.c has room for %d\n", file->name, all->count, MOST_TESTS);
        return 1;
    }
    for (size_t i = 0; i < all->count; i++) {
        if (is_picked(file, all->tests[i].name, pattern)) {
            picked[count++] = all->tests[i];
        }
    }
    *run += count;
    if (count == 0) {
        return 0;
    }
    print_message("%s\n", file->name);
    return cmocka_run_group_tests_name(file->name, picked, all->setup, all->teardown);
}

static int run_room(const char *pattern)
{
    size_t run = 0;
    int failed = 0;
    for (const struct unit_file *file = unit_files; file->name; file++) {
        failed += run_file(file, pattern, &run) != 0;
    }
    if (run == 0) {
        fprintf(stderr, "no file and no test here has '%s' in its name\n", pattern);
    }
    return failed > 0 || run == 0;
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--list") == 0) {
        list_tests();
        return 0;
    }
    if (argc == 3 && strcmp(argv[1], "--filter") == 0) {
        return run_room(argv[2]);
    }
    if (argc == 1) {
        return run_room("");
    }
    fprintf(stderr, "usage: %s [--list | --filter PATTERN]\n", argv[0]);
    return 2;
}
