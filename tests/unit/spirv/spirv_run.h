// SPDX-License-Identifier: MIT
// Words become programs, and compute programs run, as tests of translated shaders want it.
#ifndef SPIRV_RUN_H
#define SPIRV_RUN_H

#include <rhw/bind.h>
#include <rhw/spirv.h>
#include <string.h>

#include "harness.h"

#define SPIRV_CREATE(words, stage) spirv_create(words, sizeof(words), stage)

static inline rhw_shader *spirv_create(const uint32_t *words, size_t size, enum rhw_shader_stage stage)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    const struct rhw_shader_def def = {.stage = stage};
    if (rhw_shader_create(words, size, &def, &shader, message) != RHW_OK) {
        fail_msg("%s", message);
    }
    return shader;
}

// Link shaders, and destroy them.
static inline rhw_shader_program *spirv_link(rhw_shader *vertex, rhw_shader *fragment, rhw_shader *compute)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader_program *program;
    const struct rhw_shader_program_def def = {.vertex = vertex, .fragment = fragment, .compute = compute};
    if (rhw_shader_program_create(&def, &program, message) != RHW_OK) {
        fail_msg("%s", message);
    }
    rhw_shader_destroy(vertex);
    rhw_shader_destroy(fragment);
    rhw_shader_destroy(compute);
    return program;
}

static inline enum rhw_result spirv_dispatch(const struct rig *rig, const rhw_shader_program *program,
                                             const struct rhw_shader_frame *frame, uint32_t workgroups)
{
    const struct rhw_dispatch_def def = {.program = *rhw_shader_program_get_compute(program),
                                         .uniforms = frame,
                                         .uniform_bytes = sizeof *frame};
    return rhw_dispatch(rig->context, &def, workgroups, 1, 1);
}

// Return a binding of memory that is written.
static inline struct rhw_binding spirv_memory(void *memory, size_t size)
{
    struct rhw_binding binding;
    assert_true(rhw_binding_of_memory(memory, size, false, &binding));
    return binding;
}

#endif
