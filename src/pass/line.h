// SPDX-License-Identifier: MIT
// The stipple and the width of a draw's lines: the pipeline's, or what the pass sets in their place.
#ifndef RHW_PASS_LINE_H
#define RHW_PASS_LINE_H

struct rhw_draw_state;

// Sets what the state's lines have; the stipple has factor 0 where it draws none.
void rhw_draw_state_set_lines(struct rhw_draw_state *state);

#endif
