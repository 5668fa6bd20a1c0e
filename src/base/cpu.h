// SPDX-License-Identifier: MIT
// What this machine can do, and the floating-point environment that determinism needs.
#ifndef RHW_CPU_H
#define RHW_CPU_H

#include "rhw/types.h"

// Whether the CPU and the operating system run code that was compiled for `isa`.
bool rhw_cpu_supports(enum rhw_isa isa);

// Whole cores whose time this process may use, by its affinity and the limits of its control groups; at least 1.
int rhw_cpu_cores(void);

// A program that is linked with -ffast-math flushes denormals to zero in all its threads, and a thread may
// have set another rounding mode; both would change our bytes. Work that computes texels or geometry
// stands between these two calls (rhw_scheduler_run makes them around its tasks, on every thread): round
// to nearest, denormals kept, no traps. The second restores what the first returned.
uint64_t rhw_cpu_float_enter(void);
void rhw_cpu_float_leave(uint64_t saved);

#endif
