// SPDX-License-Identifier: MIT
// The state of a draw and of a sampler, in the peer's words.
#ifndef DIFFERENTIAL_PEER_STATE_H
#define DIFFERENTIAL_PEER_STATE_H

#include "frame.h"
#include "peer_functions.h"

// Sets all state of a draw of the frame but programs, vertices and textures.
void peer_state_set(const struct gles *gl, const struct peer_functions *more, const struct frame *frame,
                    const struct frame_draw *draw);
// Sets the parameters of the texture that is bound to `target`.
void peer_state_set_sampler(const struct gles *gl, const struct peer_functions *more, GLenum target,
                            const struct rhw_sampler_def *sampler);
GLenum peer_state_topology(enum rhw_topology topology);

#endif
