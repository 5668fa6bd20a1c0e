// SPDX-License-Identifier: MIT
// Limits of control groups are read in both versions: cpu.max (Linux Documentation/admin-guide/cgroup-v2.rst), and
// cpu.cfs_quota_us over cpu.cfs_period_us (Documentation/scheduler/sched-bwc.rst). A group's limit holds for the groups
// below it, so all groups from the process's own up to the mount are asked; a container may show the mount alone.
#include "cpu_quota.h"

#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 1024, LINE_SIZE = 512 };

// Read the first line of a file, without its end. Return false when there is none.
static bool read_line(const char *folder, const char *name, char line[LINE_SIZE])
{
    char path[PATH_SIZE];
    if (snprintf(path, sizeof path, "%s/%s", folder, name) >= (int)sizeof path) {
        return false;
    }
    FILE *const file = fopen(path, "re");
    if (!file) {
        return false;
    }
    const bool read = fgets(line, LINE_SIZE, file) != NULL;
    fclose(file);
    return read;
}

// Return the cores that one group allows.
static int quota_of(const char *folder, bool unified)
{
    char first[LINE_SIZE], second[LINE_SIZE];
    long long quota = 0, period = 0;
    if (unified) { // "max 100000" or "200000 100000"
        if (!read_line(folder, "cpu.max", first) || sscanf(first, "%lld %lld", &quota, &period) != 2) {
            return INT_MAX;
        }
    } else if (!read_line(folder, "cpu.cfs_quota_us", first) || sscanf(first, "%lld", &quota) != 1 ||
               !read_line(folder, "cpu.cfs_period_us", second) || sscanf(second, "%lld", &period) != 1) {
        return INT_MAX;
    }
    if (quota <= 0 || period <= 0) { // a quota of −1 is no limit
        return INT_MAX;
    }
    const long long cores = quota / period;
    return cores < 1 ? 1 : cores < INT_MAX ? (int)cores : INT_MAX;
}

// Return the cores that the group `path` allows, which begins with a slash, with the limits of the groups above it up
// to the mount. A namespace may hide where the group stands ("/../.."): then the mount is asked alone.
static int quota_up_to_mount(const char *mount, const char *path, bool unified)
{
    char folder[PATH_SIZE];
    const int length = snprintf(folder, sizeof folder, "%s%s", mount, strstr(path, "/..") ? "/" : path);
    if (length >= (int)sizeof folder) {
        return INT_MAX;
    }
    int least = quota_of(folder, unified);
    while (strlen(folder) > strlen(mount)) {
        *strrchr(folder, '/') = '\0';
        const int cores = quota_of(folder, unified);
        least = cores < least ? cores : least;
    }
    return least;
}

// Return true if a list like "cpu,cpuacct" names the processor.
static bool has_cpu(const char *controllers)
{
    for (const char *at = controllers; at; at = strchr(at, ',')) {
        at += *at == ',';
        if (strncmp(at, "cpu", 3) == 0 && (at[3] == '\0' || at[3] == ',')) {
            return true;
        }
    }
    return false;
}

int rhw_cpu_quota(const char *groups, const char *mount)
{
    int least = INT_MAX;
    char line[LINE_SIZE];
    FILE *const file = fopen(groups, "re");
    // Lines of version 1 read "4:cpu,cpuacct:/a/b", the line of version 2 reads "0::/a/b".
    while (file && fgets(line, sizeof line, file)) {
        line[strcspn(line, "\n")] = '\0';
        char *const controllers = strchr(line, ':') ? strchr(line, ':') + 1 : NULL;
        char *const colon = controllers ? strchr(controllers, ':') : NULL;
        if (!colon || colon[1] != '/') {
            continue;
        }
        *colon = '\0';
        const bool unified = *controllers == '\0';
        if (!unified && !has_cpu(controllers)) {
            continue;
        }
        // The folder of version 1 is named "cpu"; it is a link where the controllers have another order.
        char hierarchy[PATH_SIZE];
        if (snprintf(hierarchy, sizeof hierarchy, unified ? "%s" : "%s/cpu", mount) < (int)sizeof hierarchy) {
            const int cores = quota_up_to_mount(hierarchy, colon + 1, unified);
            least = cores < least ? cores : least;
        }
    }
    if (file) {
        fclose(file);
    }
    return least;
}
