// SPDX-License-Identifier: MIT
// Programs of the peer, made when a draw first asks for them and kept.
#ifndef DIFFERENTIAL_PEER_PROGRAM_H
#define DIFFERENTIAL_PEER_PROGRAM_H

#include "frame.h"
#include "peer_functions.h"

enum { PEER_PROGRAMS = 128 };

struct peer_programs {
    const struct shader_pair *shaders[PEER_PROGRAMS]; // what they were made of
    GLuint names[PEER_PROGRAMS];
    int count;
};

// 0 where there is no more room.
GLuint peer_program_find(const struct gles *gl, const struct peer_functions *more,
                         struct peer_programs *programs, const struct shader_pair *shaders);

#endif
