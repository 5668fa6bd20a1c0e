// SPDX-License-Identifier: MIT
// Transform feedback writes the vertices of draws into buffers, or into memory of the program. How many primitives a
// draw has is known when it is recorded, so its place there is known from then on. Chunks write their parts in any
// order (kernels/geometry/feedback.h), and a chunk that is made again writes the same bytes.
#ifndef RHW_TRANSFORM_FEEDBACK_H
#define RHW_TRANSFORM_FEEDBACK_H

#include "rhw/pass_def.h"

struct rhw_buffer_data;
struct rhw_draw;
struct rhw_encoder;
struct rhw_range;

// A target under way. Places are bytes from `bytes`, which is the start of a buffer or of memory of the program.
struct rhw_feedback_place {
    unsigned char *bytes; // NULL: no target
    size_t first, end;    // the bytes that may be written
    size_t at;            // place of the next vertex
    // The bytes in the set of the buffer, and in that of the pass's memory. NULL: they are in none.
    struct rhw_buffer_data *data; // NULL: memory of the program
    struct rhw_range *range, *memory_range;
};

// A pass keeps this between the calls that begin and end transform feedback.
struct rhw_feedback_state {
    bool is_active;
    struct rhw_feedback_place targets[RHW_MAX_FEEDBACK_TARGETS];
    int vertices; // vertices of a primitive
};

// Give a prepared draw its place in the buffers while feedback is under way. Return false when out of memory.
bool rhw_feedback_add_draw(struct rhw_encoder *encoder, struct rhw_draw *draw);
// Report transform feedback that was begun and not ended.
void rhw_feedback_check_ended(const struct rhw_encoder *encoder, const char *where);

#endif
