// SPDX-License-Identifier: MIT
// What this machine can do, and the floating-point environment that determinism needs.
#ifndef RHW_CPU_H
#define RHW_CPU_H

#include "rhw/types.h"

// Return true if the CPU and the operating system run code that was compiled for `isa`.
bool rhw_cpu_supports(enum rhw_isa isa);

// Return the number of whole cores whose time this process may use, by its affinity and the limits of its control
// groups. It is at least 1.
int rhw_cpu_cores(void);

// Return the number of the core that the calling thread runs on, or -1 where the system does not tell.
int rhw_cpu_core(void);

// Move the calling thread to another core than `core`, where it may use one. From then on it may run on all that it
// could use before; cores that the system gives the process later stay closed to it.
void rhw_cpu_leave(int core);

// Set the floating-point environment that the library promises: round to nearest, denormals kept, no traps. A program
// that is linked with -ffast-math flushes denormals to zero in all its threads, and a thread may have set another
// rounding mode; both would change our bytes. Work that computes texels or geometry stands between these two calls;
// rhw_scheduler_run makes them around its tasks, on every thread. The second call restores what the first one returned.
uint64_t rhw_cpu_float_enter(void);
void rhw_cpu_float_leave(uint64_t saved);

#endif
