// SPDX-License-Identifier: MIT
// The dynamic state of a pass decides these parts of a draw's state.
#ifndef RHW_DYNAMIC_STATE_H
#define RHW_DYNAMIC_STATE_H

struct rhw_draw_state;
struct rhw_encoder;

// Hold the state's scissor within its viewport and the target.
void rhw_pass_clip_scissor(const struct rhw_encoder *encoder, struct rhw_draw_state *state);

// Set what vertices and depth need of the viewport and of the pipeline's range of Z.
void rhw_draw_state_map_viewport(struct rhw_draw_state *state);

// Set the stipple and the width of the state's lines: what the pass sets, or what the pipeline has where the pass sets
// nothing. The stipple has factor 0 where the state draws no lines.
void rhw_draw_state_set_lines(struct rhw_draw_state *state);

#endif
