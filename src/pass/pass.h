// SPDX-License-Identifier: MIT
// The state of passes as a context owns it. Recording is the public rhw_pass_ functions; pass_state.h has the data.
#ifndef RHW_PASS_H
#define RHW_PASS_H

#include "rhw/types.h"

struct rhw_context;
struct rhw_draw;
struct rhw_pass_state;

enum rhw_result rhw_pass_state_create(struct rhw_context *context, struct rhw_pass_state **pass);
void rhw_pass_state_destroy(struct rhw_context *context, struct rhw_pass_state *pass);

// Records a draw of `count` vertices or indices; of `draw`, what the parameters of a draw say is set.
void rhw_pass_record(struct rhw_pass_state *pass, const struct rhw_draw *draw, uint32_t count,
                     const char *where);

#endif
