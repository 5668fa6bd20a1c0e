// SPDX-License-Identifier: MIT
// How much processor time a container gives its processes. sched_getaffinity does not tell it.
#ifndef RHW_CPU_QUOTA_H
#define RHW_CPU_QUOTA_H

// Return the number of whole cores that the Linux control groups of this process allow, at least 1. Return INT_MAX
// where they set no limit or cannot be read. `groups` and `mount` stand for /proc/self/cgroup and /sys/fs/cgroup.
int rhw_cpu_quota(const char *groups, const char *mount);

#endif
