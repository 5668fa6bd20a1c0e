// SPDX-License-Identifier: MIT
// Running a recorded pass.
#ifndef RHW_PASS_RUN_H
#define RHW_PASS_RUN_H

#include "rhw/stats.h"

struct rhw_pass_state;

enum rhw_result rhw_pass_run(struct rhw_pass_state *pass, struct rhw_stats *stats);
// Releases workers' scratch, chunks and transient depth.
void rhw_pass_run_release(struct rhw_pass_state *pass);

#endif
