// SPDX-License-Identifier: MIT
// The public rhw_pass_ functions that draw come here to record a draw; encoder.h has the data.
#ifndef RHW_PASS_H
#define RHW_PASS_H

#include <stdint.h>

struct rhw_draw;
struct rhw_encoder;

// Record a draw of `count` vertices or indices. `draw` has only the members that are parameters of a call.
void rhw_pass_record(struct rhw_encoder *encoder, const struct rhw_draw *draw, uint32_t count,
                     const char *where);

#endif
