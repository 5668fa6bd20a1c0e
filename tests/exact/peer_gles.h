// SPDX-License-Identifier: MIT
// The OpenGL ES implementation on this machine, to be measured with the same triangles and the same oracle.
#ifndef EXACT_PEER_GLES_H
#define EXACT_PEER_GLES_H

#include <stdbool.h>

#include "probe.h"
#include "scene.h"

struct peer;

// Opens a Mesa driver ("llvmpipe", "softpipe") without a window; NULL, with the reason in *why, when this
// machine has none. One at a time in a process.
struct peer *peer_open(const char *driver, const char **why);
void peer_close(struct peer *peer);
// GL_RENDERER and GL_VERSION.
const char *peer_name(const struct peer *peer);
// Whether the peer can draw the scene: depth −1..1 is all that OpenGL ES has.
bool peer_can_draw(const struct scene *scene);
// Valid until the next draw.
const struct probe_image *peer_draw(struct peer *peer, const struct scene *scene);

#endif
