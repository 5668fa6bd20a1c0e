// SPDX-License-Identifier: MIT
// A program that was linked, shared by what makes it and what writes it as C.
#ifndef SHADER_PROGRAM_H
#define SHADER_PROGRAM_H

#include "machine/machine.h"
#include "shader.h"

enum { STAGES = RHW_SHADER_STAGE_COUNT, MAX_TARGETS = RHW_MAX_COLOR_ATTACHMENTS };

struct rhw_shader_program {
    struct shader_kept kept;
    const rhw_shader *shaders[STAGES];
    struct shader_bytecode bytecode[STAGES]; // the shaders' own, with slots and components
    struct shader_slot *slots[STAGES];
    struct shader_stages stages;
    struct shader_machine_block machine[STAGES]; // generated code, where there is some
    struct rhw_shader_layout *layout;            // by set and binding, each once
    uint32_t layout_count;
    bool is_interpreted;
    struct rhw_program program;
    struct rhw_shader_feedback feedback;
    struct rhw_compute_program compute;
};

// Describe a stage of the program to a back end. The description is as long valid as the program.
struct shader_linked_stage shader_describe_stage(const rhw_shader_program *program,
                                                 enum rhw_shader_stage kind);

#endif
