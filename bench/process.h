// SPDX-License-Identifier: MIT
// The program itself under measurement: from its start to a picture on the disk, as a script meets it.
#ifndef BENCH_PROCESS_H
#define BENCH_PROCESS_H

#include "rhw/types.h"

// Whether this machine lets a program start itself again.
bool bench_can_start_itself(void);
// Runs `rhw render MODEL` of this same program to a PNG that is deleted afterwards. False when that fails.
bool bench_render_process(const char *model, int width, int height, int threads, enum rhw_isa isa);

#endif
