// SPDX-License-Identifier: MIT
// Recorded draws keep the vertices and indices that they read, when the program writes them before the pass has ended.
#ifndef RHW_KEPT_READS_H
#define RHW_KEPT_READS_H

#include <stdbool.h>

struct rhw_buffer_part;
struct rhw_context;

// Copy what the recorded draws read of the part, and let them read the copies. See rhw_context::keep_reads.
bool rhw_encoder_keep_reads(struct rhw_context *context, const struct rhw_buffer_part *part);

#endif
