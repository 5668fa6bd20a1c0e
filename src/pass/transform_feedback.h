// SPDX-License-Identifier: MIT
// Transform feedback. How many primitives a draw has is known when it is recorded, so each has its place in the buffers from
// then on: chunks write theirs in any order (kernels/geometry/feedback.h), and one that is made again writes the same.
#ifndef RHW_FEEDBACK_H
#define RHW_FEEDBACK_H

#include "rhw/pass_def.h"

struct rhw_buffer_data;
struct rhw_draw;
struct rhw_encoder;
struct rhw_range;

// Of a pass, between the calls.
struct rhw_feedback_state {
    bool is_active;
    struct rhw_range *range[RHW_MAX_FEEDBACK_TARGETS]; // that is written, under way; NULL: no target
    struct rhw_buffer_data *data[RHW_MAX_FEEDBACK_TARGETS];
    unsigned char *bytes[RHW_MAX_FEEDBACK_TARGETS]; // of the buffers
    size_t at[RHW_MAX_FEEDBACK_TARGETS];            // where the next vertex goes
    int vertices;                                   // of a primitive
};

// Gives a draw that was prepared its place; feedback is under way. False when out of memory.
bool rhw_feedback_add_draw(struct rhw_encoder *encoder, struct rhw_draw *draw);
// Reports what was begun and not ended.
void rhw_feedback_check_ended(const struct rhw_encoder *encoder);

#endif
