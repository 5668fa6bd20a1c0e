// SPDX-License-Identifier: MIT
// Limits of control groups, read from folders that look like the kernel's.
#include "harness.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/cpu_quota.h"

static char root[] = "/tmp/rhw_quota_XXXXXX";

static void write_file(const char *path, const char *text)
{
    char whole[256];
    for (const char *slash = strchr(path, '/'); slash; slash = strchr(slash + 1, '/')) {
        snprintf(whole, sizeof whole, "%s/%.*s", root, (int)(slash - path), path);
        mkdir(whole, 0700);
    }
    snprintf(whole, sizeof whole, "%s/%s", root, path);
    FILE *const file = fopen(whole, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    fclose(file);
}

static int quota(const char *groups)
{
    char mount[256], file[256];
    write_file("groups", groups);
    snprintf(mount, sizeof mount, "%s/cg", root);
    snprintf(file, sizeof file, "%s/groups", root);
    return rhw_cpu_quota(file, mount);
}

static void test_version_2(void **state)
{
    (void)state;
    write_file("cg/cpu.max", "max 100000\n");
    assert_int_equal(quota("0::/\n"), INT_MAX);
    write_file("cg/cpu.max", "250000 100000\n");
    assert_int_equal(quota("0::/\n"), 2);
    write_file("cg/cpu.max", "50000 100000\n");
    assert_int_equal(quota("0::/\n"), 1);
    write_file("cg/cpu.max", "800000 100000\n");
    write_file("cg/a/cpu.max", "300000 100000\n");
    write_file("cg/a/b/cpu.max", "max 100000\n");
    assert_int_equal(quota("0::/a/b\n"), 3); // the group above
    assert_int_equal(quota("0::/not/here\n"), 8);
    write_file("cpu.max", "100000 100000\n"); // beside the mount
    assert_int_equal(quota("0::/../..\n"), 8);
    assert_int_equal(quota("0::\n"), INT_MAX);
    write_file("cg/a/b/cpu.max", "200000 100000\n");
    assert_int_equal(quota("0::/a/b\n"), 2);
    write_file("cg/cpu.max", "nonsense\n");
    assert_int_equal(quota("0::/\n"), INT_MAX);
}

static void test_version_1(void **state)
{
    (void)state;
    write_file("cg/cpu.max", "max 100000\n");
    write_file("cg/cpu/cpu.cfs_quota_us", "-1\n");
    write_file("cg/cpu/cpu.cfs_period_us", "100000\n");
    assert_int_equal(quota("9:memory:/x\n4:cpu,cpuacct:/docker/1\n0::/\n"), INT_MAX);
    write_file("cg/cpu/docker/1/cpu.cfs_quota_us", "600000\n");
    write_file("cg/cpu/docker/1/cpu.cfs_period_us", "100000\n");
    assert_int_equal(quota("9:memory:/x\n4:cpu,cpuacct:/docker/1\n0::/\n"), 6);
    assert_int_equal(quota("4:cpuacct,cpu:/docker/1\n"), 6);
    assert_int_equal(quota("4:cpu:/docker\n"), INT_MAX);
    assert_int_equal(quota("3:cpuset:/docker/1\n5:cpuacct:/docker/1\n0::/\n"), INT_MAX);
}

static void test_what_cannot_be_read(void **state)
{
    (void)state;
    assert_int_equal(rhw_cpu_quota("/nothing", "/nowhere"), INT_MAX);
    assert_int_equal(quota(""), INT_MAX);
    assert_int_equal(quota("no colons\n1:cpu\n:::\n"), INT_MAX);
}

static int make_root(void **state)
{
    (void)state;
    return mkdtemp(root) == NULL ? -1 : 0;
}

static int remove_root(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", root);
    return system(command);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_version_2),
    cmocka_unit_test(test_version_1),
    cmocka_unit_test(test_what_cannot_be_read),
};

const struct unit_tests test_cpu_quota = UNIT_TESTS(tests, make_root, remove_root);
