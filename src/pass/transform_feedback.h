// SPDX-License-Identifier: MIT
// Transform feedback writes the vertices of draws into buffers. How many primitives a draw has is known when it is
// recorded, so its place in the buffers is known from then on. Chunks write their parts in any order
// (kernels/geometry/feedback.h), and a chunk that is made again writes the same bytes.
#ifndef RHW_TRANSFORM_FEEDBACK_H
#define RHW_TRANSFORM_FEEDBACK_H

#include "rhw/pass_def.h"

struct rhw_buffer_data;
struct rhw_draw;
struct rhw_encoder;
struct rhw_range;

// A pass keeps this between the calls that begin and end transform feedback.
struct rhw_feedback_state {
    bool is_active;
    struct rhw_range *range[RHW_MAX_FEEDBACK_TARGETS]; // bytes under way that are written; NULL: no target
    struct rhw_buffer_data *data[RHW_MAX_FEEDBACK_TARGETS];
    unsigned char *bytes[RHW_MAX_FEEDBACK_TARGETS]; // bytes of the buffers
    size_t at[RHW_MAX_FEEDBACK_TARGETS];            // place of the next vertex
    int vertices;                                   // vertices of a primitive
};

// Give a prepared draw its place in the buffers while feedback is under way. Return false when out of memory.
bool rhw_feedback_add_draw(struct rhw_encoder *encoder, struct rhw_draw *draw);
// Report transform feedback that was begun and not ended.
void rhw_feedback_check_ended(const struct rhw_encoder *encoder);

#endif
