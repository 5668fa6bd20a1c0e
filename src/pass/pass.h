// SPDX-License-Identifier: MIT
// Recording a draw. The public rhw_pass_ functions come here; encoder.h has the data.
#ifndef RHW_PASS_H
#define RHW_PASS_H

#include <stdint.h>

struct rhw_draw;
struct rhw_encoder;

// Records a draw of `count` vertices or indices; of `draw`, what the parameters of a draw say is set.
void rhw_pass_record(struct rhw_encoder *encoder, const struct rhw_draw *draw, uint32_t count,
                     const char *where);

#endif
