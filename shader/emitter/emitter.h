// SPDX-License-Identifier: MIT
// The back end that writes a linked program as C on the 8-lane types of rhw/shader.h. It reads the form alone: what
// linking found stands in struct shader_c_program, which is all that a back end for whole programs is given.
#ifndef SHADER_EMITTER_H
#define SHADER_EMITTER_H

#include "form/form.h"
#include "rhw/spirv.h"

// Where a resource of a stage lies: as many bindings of a set from place `first` on.
struct shader_c_slot {
    uint32_t set, first, count;
};

// A stage as it is linked.
struct shader_c_stage {
    const struct shader_program *form; // NULL: the program has no such stage
    const struct shader_c_slot *slots; // by resource
    const uint8_t *component_of;       // number among the varyings, by enum shader_input; 0xff: none
    const bool *is_linear;             // by enum shader_input: it is flat or noperspective
    uint8_t w_component;               // varying that holds W of the position; 0xff: none
    uint32_t batch;                    // groups that go through the shader together where their order shows
    uint32_t target_count;
};

struct shader_c_program {
    const char *name, *source; // as in struct rhw_shader_c_def
    struct shader_c_stage stages[RHW_SHADER_STAGE_COUNT];
    const struct rhw_program *program;
    const struct rhw_compute_program *compute; // NULL: it draws
    const struct rhw_shader_layout *layout;    // by set and binding, each once
    uint32_t layout_count;
    const char *const *layout_names; // names of the resources, or ""
};

// Return the text of a file. It lies in the memory, through which a program that is refused ends.
const char *shader_c_write(struct shader_memory *memory, const struct shader_c_program *program);

#endif
