// SPDX-License-Identifier: MIT
// From two translated stages to a program of librhw: which varyings there are, and what its functions receive and do.
#ifndef SHADER_LINK_H
#define SHADER_LINK_H

#include "form/form.h"
#include "interpreter/bytecode.h"
#include "rhw/types.h"

// What a stage reads and writes, found in its code.
struct shader_interface {
    bool reads[128];   // by location · 4 + component
    bool derives[128]; // analytic derivatives of it, or its value at a partner pixel, are asked for
    bool needs_w;      // some value at a partner pixel is
    bool is_flat[32], is_noperspective[32], is_centroid[32], is_sample[32]; // by location
    bool built_in[SHADER_IN_COUNT];
    bool writes[SHADER_OUT_COUNT];
    bool discards, has_effects, uses_atomic_results;
    bool samples; // something that a fragment function samples
};

void shader_find_interface(const struct shader_program *program, struct shader_interface *interface);
// Give varyings their components, and describe the program. Return a message where the stages do not fit, or NULL.
// `fragment` may be NULL.
const char *shader_link(const struct shader_interface *vertex, const struct shader_interface *fragment,
                        struct shader_bytecode *vertex_code, struct shader_bytecode *fragment_code,
                        struct rhw_program *program);

#endif
