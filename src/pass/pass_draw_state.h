// SPDX-License-Identifier: MIT
// The state that draws of a pass refer to.
#ifndef RHW_PASS_DRAW_STATE_H
#define RHW_PASS_DRAW_STATE_H

#include <stdbool.h>

struct rhw_draw;
struct rhw_draw_state;
struct rhw_encoder;

// An immutable copy of what the next draw uses, shared by the draws between two changes. NULL when out of memory.
const struct rhw_draw_state *rhw_pass_draw_state(struct rhw_encoder *encoder);

// Gives a draw whose vertices name their viewport the same draw in each. False when out of memory.
bool rhw_pass_route_draw(struct rhw_encoder *encoder, struct rhw_draw *draw);

#endif
