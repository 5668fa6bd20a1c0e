// SPDX-License-Identifier: MIT
// The two that draw a frame.
#ifndef DIFFERENTIAL_RENDERERS_H
#define DIFFERENTIAL_RENDERERS_H

#include "frame.h"

// The library. False, with a line on stderr, where something was refused.
bool draw_here(rhw_context *context, const struct frame *frame, struct drawn *drawn);

struct peer;

// OpenGL ES of this machine, by a driver of Mesa; NULL, with the reason in *why, where there is none.
struct peer *peer_open(const char *driver, const char **why);
void peer_close(struct peer *peer);
const char *peer_name(const struct peer *peer);
// What the frame asks for that the peer has not: NULL, or in words.
const char *peer_lacks(const struct peer *peer, const struct frame *frame);
bool draw_there(struct peer *peer, const struct frame *frame, struct drawn *drawn);

#endif
