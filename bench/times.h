// SPDX-License-Identifier: MIT
// What programs share that time functions of the library by themselves: a clock, and an end where a call fails.
#ifndef BENCH_TIMES_H
#define BENCH_TIMES_H

#include <rhw/rhw.h>

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static inline double now_us(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec * 1e6 + (double)now.tv_nsec * 1e-3;
}

static inline void must(enum rhw_result result)
{
    if (result != RHW_OK) {
        fprintf(stderr, "a call failed: %s\n", rhw_result_string(result));
        exit(1);
    }
}

#endif
