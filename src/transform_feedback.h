// SPDX-License-Identifier: MIT
// Transform feedback. How many primitives a draw has is known when it is recorded, so each has its place in the buffers from
// then on: chunks write theirs in any order (kernels/geometry/feedback.h), and one that is made again writes the same.
#ifndef RHW_FEEDBACK_H
#define RHW_FEEDBACK_H

#include "rhw/transform_feedback.h"

struct rhw_draw;
struct rhw_pass_state;
struct rhw_pipeline_data;

// Bytes that a pass writes.
struct rhw_feedback_range {
    const struct rhw_feedback_range *next;
    uint32_t buffer; // index
    size_t first, end;
};

// Of a pass, between the calls.
struct rhw_feedback_state {
    bool is_active;
    const struct rhw_feedback_range *ranges;                    // of those before, and of the one under way
    struct rhw_feedback_range *range[RHW_MAX_FEEDBACK_TARGETS]; // under way; NULL: no target
    unsigned char *bytes[RHW_MAX_FEEDBACK_TARGETS];             // of the buffers
    size_t at[RHW_MAX_FEEDBACK_TARGETS];                        // where the next vertex goes
    int vertices;                                               // of a primitive
};

// Where a draw writes.
struct rhw_draw_feedback {
    unsigned char *to[RHW_MAX_FEEDBACK_TARGETS]; // its first vertex
    uint64_t primitives;                         // that are written, those of all instances in one line
    int vertices;                                // of a primitive
};

// What an output reads of a vertex record, and where it goes.
struct rhw_feedback_copy {
    int first, count; // floats of the record
    int target;
    uint32_t offset; // bytes from the vertex
};

// Whether the outputs of a definition are as they must be, else misuse of `where`.
bool rhw_feedback_check(const struct rhw_context *context, const struct rhw_pipeline_def *def,
                        const char *where);
// Sets what follows from the outputs of a pipeline, whose varyings are laid out.
void rhw_feedback_lay_out(struct rhw_pipeline_data *pipeline);
// Gives a draw that was prepared its place, where feedback is under way. False when out of memory.
bool rhw_feedback_add_draw(struct rhw_pass_state *pass, struct rhw_draw *draw);
// Reports what was begun and not ended.
void rhw_feedback_check_ended(const struct rhw_pass_state *pass);

#endif
