// SPDX-License-Identifier: MIT
// The back end that translates a stage to machine code of x86-64 with AVX2.
#ifndef SHADER_MACHINE_H
#define SHADER_MACHINE_H

#include "form/print.h"
#include "form/linked_stage.h"

// Code that may be executed.
struct shader_machine_block {
    void *code; // NULL: there is none
    size_t size, entry;
};

// Generate the code of a stage for execution. Return false where there is none: the machine is another one, the system
// refuses, RHW_JIT is 0, or the stage needs more than there is.
bool shader_machine_make(const struct shader_linked_stage *stage, enum rhw_shader_stage kind,
                         struct shader_machine_block *block);
void shader_machine_free(struct shader_machine_block *block);

// Print the code of a stage beside its form and its source. Return false where it needs more of the stack than it may
// take.
bool shader_machine_print(const struct shader_sink *sink, struct shader_memory *memory,
                          const struct shader_linked_stage *stage, enum rhw_shader_stage kind);

#endif
