// SPDX-License-Identifier: MIT
// Draws of a pass refer to these copies of the state.
#ifndef RHW_PASS_DRAW_STATE_H
#define RHW_PASS_DRAW_STATE_H

#include <stdbool.h>

struct rhw_draw;
struct rhw_draw_state;
struct rhw_encoder;

// Return an immutable copy of what the next draw uses, which the draws between two changes share. Return NULL when out
// of memory.
const struct rhw_draw_state *rhw_pass_draw_state(struct rhw_encoder *encoder);

// Give a draw whose vertices name their viewport a copy of the draw in each viewport. Return false when out of memory.
bool rhw_pass_route_draw(struct rhw_encoder *encoder, struct rhw_draw *draw);

#endif
