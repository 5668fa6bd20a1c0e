// SPDX-License-Identifier: MIT
// What of a vertex a pipeline's transform feedback keeps, and where it goes.
#ifndef RHW_FEEDBACK_LAYOUT_H
#define RHW_FEEDBACK_LAYOUT_H

#include "rhw/types.h"

// What an output reads of a vertex record, and where it goes.
struct rhw_feedback_copy {
    int first, count; // floats of the record
    int target;
    uint32_t offset; // bytes from the vertex
};

// Whether the outputs of a definition are as they must be, else misuse of `where`.
bool rhw_feedback_check(const struct rhw_context *context, const struct rhw_pipeline_def *def,
                        const char *where);
// Gives a copy for each output of a definition and the bits of the targets, and sets the strides that are 0.
unsigned rhw_feedback_lay_out(struct rhw_pipeline_def *def, struct rhw_feedback_copy *copies);

#endif
