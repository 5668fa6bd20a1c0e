// SPDX-License-Identifier: MIT
// Places by names. A text that is as OpenGL has it (glsl_code.is_relaxed) says what things are called, and not where
// they are. What is compiled of it has places in the order of the text, which become those of the names here.
#ifndef GLSL_GLSL_NAMES_H
#define GLSL_GLSL_NAMES_H

#include "glsl.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What has a place.
enum glsl_thing {
    GLSL_INPUT,    ///< the place is a location; a block has the name of its type
    GLSL_OUTPUT,   ///< as GLSL_INPUT
    GLSL_RESOURCE, ///< a binding of set 0; a block has the name of its type
    GLSL_UNIFORM,  ///< bytes from the begin of gl_DefaultUniformBlock
};

struct glsl_place {
    const char *name;
    uint32_t number;
};

/// Put all things of a kind where their names belong. Return NULL, or the name of one that is none of the places': it
/// is a name in the code.
const char *glsl_place(const struct glsl_code *code, enum glsl_thing thing, const struct glsl_place *places,
                       uint32_t count);

/// Fit the texts of a program together by names, if one of them is relaxed: inputs of the fragment shader get the
/// locations of the vertex shader's outputs, or of no other input where it does not read them and no output has their
/// name; textures and blocks of set 0 get a binding for each name, and uniforms of gl_DefaultUniformBlock a place for
/// each name. Return false, with one line in `message`, where names do not fit.
bool glsl_match(const struct glsl_code *vertex, const struct glsl_code *fragment, char *message,
                size_t message_size);

#ifdef __cplusplus
}
#endif

#endif
