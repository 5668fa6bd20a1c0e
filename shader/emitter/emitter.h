// SPDX-License-Identifier: MIT
// The back end that writes a linked program as C on the 8-lane types of rhw/shader.h. It reads the form alone: what
// linking found stands in struct shader_c_program, which is all that a back end for whole programs is given.
#ifndef SHADER_EMITTER_H
#define SHADER_EMITTER_H

#include "form/linked_stage.h"

struct shader_c_program {
    const char *name, *source; // as in struct rhw_shader_c_def
    struct shader_linked_stage stages[RHW_SHADER_STAGE_COUNT];
    const struct rhw_program *program;
    const struct rhw_compute_program *compute; // NULL: it draws
    const struct rhw_shader_layout *layout;    // by set and binding, each once
    uint32_t layout_count;
    const char *const *layout_names; // names of the resources, or ""
};

// Return the text of a file. It lies in the memory, through which a program that is refused ends.
const char *shader_c_write(struct shader_memory *memory, const struct shader_c_program *program);

#endif
