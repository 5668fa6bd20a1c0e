// SPDX-License-Identifier: MIT
// What a pass sets of viewports and scissors.
#ifndef RHW_PASS_VIEWPORT_H
#define RHW_PASS_VIEWPORT_H

struct rhw_draw_state;
struct rhw_encoder;

// Holds the state's scissor within its viewport and the target.
void rhw_pass_clip_scissor(const struct rhw_encoder *encoder, struct rhw_draw_state *state);

// Sets what vertices and depth need of the viewport and of the pipeline's range of Z.
void rhw_draw_state_map_viewport(struct rhw_draw_state *state);

#endif
