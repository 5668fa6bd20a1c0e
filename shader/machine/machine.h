// SPDX-License-Identifier: MIT
// The back end that translates a stage to machine code of x86-64 with AVX2.
#ifndef SHADER_MACHINE_H
#define SHADER_MACHINE_H

#include "form/form.h"
#include "form/print.h"
#include "rhw/spirv.h"

// Where a resource of a stage lies: as many bindings of a set from place `first` on.
struct shader_machine_slot {
    uint32_t set, first, count;
};

// A stage as it is linked.
struct shader_machine_stage {
    const struct shader_program *form;
    const struct shader_machine_slot *slots; // by resource
    const uint8_t *component_of;             // number among the varyings, by enum shader_input; 0xff: none
    const bool *is_linear;                   // by enum shader_input: it is flat or noperspective
    uint8_t w_component;                     // varying that holds W of the position; 0xff: none
    uint32_t batch; // groups that go through the shader together where their order shows
    uint32_t target_count;
};

// Code that may be executed.
struct shader_machine_block {
    void *code; // NULL: there is none
    size_t size, entry;
};

// Generate the code of a stage for execution. Return false where there is none: the machine is another one, the system
// refuses, RHW_JIT is 0, or the stage needs more than there is.
bool shader_machine_make(const struct shader_machine_stage *stage, enum rhw_shader_stage kind,
                         struct shader_machine_block *block);
void shader_machine_free(struct shader_machine_block *block);

// Print the code of a stage beside its form and its source. Return false where it needs more of the stack than it may
// take.
bool shader_machine_print(const struct shader_sink *sink, struct shader_memory *memory,
                          const struct shader_machine_stage *stage, enum rhw_shader_stage kind);

#endif
