// SPDX-License-Identifier: MIT
// From two translated stages to a program of librhw: which varyings there are, and what its functions receive and do.
#ifndef SHADER_LINK_H
#define SHADER_LINK_H

#include "form/form.h"
#include "interpreter/bytecode.h"
#include "rhw/spirv.h"

// What a stage reads and writes, found in its code.
struct shader_interface {
    // By number (enum shader_input)
    bool reads[SHADER_IN_NUMBERS];
    bool derives[SHADER_IN_NUMBERS];          // its derivatives, or its value at another place, are asked for
    uint8_t interpolation[SHADER_IN_NUMBERS]; // or-ed enum shader_interpolation
    bool needs_w;                             // some value at another place is asked for
    bool built_in[SHADER_IN_COUNT];
    bool writes[SHADER_OUT_COUNT];
    bool discards, has_effects, uses_atomic_results;
    bool samples;     // something that a fragment function samples
    bool is_captured; // transform feedback keeps outputs
};

void shader_find_interface(const struct shader_program *program, struct shader_interface *interface);
// Make varyings of outputs that transform feedback keeps and fragments do not read, and describe all that it keeps.
// Return false, with a message, where there are too many.
bool shader_link_feedback(const struct shader_program *vertex, struct shader_bytecode *vertex_code,
                          struct rhw_program *program, struct rhw_shader_feedback *feedback, char *message);

// Give varyings their components, and describe the program. Return false, with a message, where the stages do not fit.
// `fragment` may be NULL.
bool shader_link(const struct shader_interface *vertex, const struct shader_interface *fragment,
                 struct shader_bytecode *vertex_code, struct shader_bytecode *fragment_code,
                 struct rhw_program *program, char *message);

#endif
