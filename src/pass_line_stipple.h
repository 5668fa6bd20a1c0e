// SPDX-License-Identifier: MIT
// The stipple of a draw's lines: the pipeline's, or what the pass sets in its place.
#ifndef RHW_PASS_LINE_STIPPLE_H
#define RHW_PASS_LINE_STIPPLE_H

#include "line_stipple.h"

struct rhw_pipeline_data;

// What a draw has: factor 0 where it draws no lines.
struct rhw_line_stipple rhw_line_stipple_of(const struct rhw_line_stipple_setting *setting,
                                            const struct rhw_pipeline_data *pipeline);

#endif
