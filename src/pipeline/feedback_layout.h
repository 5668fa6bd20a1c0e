// SPDX-License-Identifier: MIT
// What a pipeline's transform feedback keeps of a vertex, and where it goes.
#ifndef RHW_FEEDBACK_LAYOUT_H
#define RHW_FEEDBACK_LAYOUT_H

#include "rhw/types.h"

// What an output reads of a vertex record, and where it goes.
struct rhw_feedback_copy {
    int first, count; // floats of the record
    int target;
    uint32_t offset; // bytes from the vertex's first byte in the target
};

// Return true if the outputs of a definition are as they must be. Report misuse of `where` and return false if not.
bool rhw_feedback_check(const struct rhw_context *context, const struct rhw_pipeline_def *def,
                        const char *where);
// Set a copy for each output of a definition, and the strides that are 0. Return the bits of the targets.
unsigned rhw_feedback_lay_out(struct rhw_pipeline_def *def, struct rhw_feedback_copy *copies);

#endif
