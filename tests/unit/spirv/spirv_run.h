// SPDX-License-Identifier: MIT
// Words become programs, and compute programs run, as tests of translated shaders want it.
#ifndef SPIRV_RUN_H
#define SPIRV_RUN_H

#include <rhw/bind.h>
#include <rhw/spirv.h>
#include <string.h>

#include "harness.h"

#define SPIRV_CREATE(words, stage) spirv_create(words, sizeof(words), stage)

static inline rhw_shader *spirv_specialize(const uint32_t *words, size_t size, enum rhw_shader_stage stage,
                                           const struct rhw_shader_constant *constants, uint32_t count)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    const struct rhw_shader_def def = {.stage = stage, .constants = constants, .constant_count = count};
    if (rhw_shader_create(words, size, &def, &shader, message) != RHW_OK) {
        fail_msg("%s", message);
    }
    return shader;
}

static inline rhw_shader *spirv_create(const uint32_t *words, size_t size, enum rhw_shader_stage stage)
{
    return spirv_specialize(words, size, stage, NULL, 0);
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

// Draw vertices in a pass of its own.
static inline void spirv_draw(struct rig *rig, const rhw_shader_program *program,
                              const struct rig_vertex *vertices, uint32_t count,
                              const struct rhw_shader_frame *frame)
{
    rig->pipeline.program = *rhw_shader_program_get(program);
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, count * sizeof *vertices);
    rhw_pass_set_uniforms(rig->context, rig->recording, frame, sizeof *frame);
    rhw_pass_draw(rig->context, rig->recording, 0, count, 0, 1);
    rig_end(rig);
}

// Return a binding of memory that is written.
static inline struct rhw_binding spirv_memory(void *memory, size_t size)
{
    struct rhw_binding binding;
    assert_true(rhw_binding_of_memory(memory, size, false, &binding));
    return binding;
}

// Bytes that a shader reads or writes.
struct spirv_bytes {
    void *bytes;
    size_t size;
    bool read_only;
};

// Run workgroups of a compute shader, and destroy it. Binding i of set 0 is element i of `memory`.
static inline void spirv_run(rhw_shader *shader, const struct spirv_bytes *memory, int count,
                             const void *push, uint32_t push_size, uint32_t workgroups)
{
    rhw_shader_program *const program = spirv_link(NULL, NULL, shader);
    struct rhw_binding set[8];
    struct rig rig;
    for (int i = 0; i < count; i++) {
        assert_true(rhw_binding_of_memory(memory[i].bytes, memory[i].size, memory[i].read_only, &set[i]));
    }
    const struct rhw_shader_frame frame = {.sets = {set}, .push_constants = push, .push_size = push_size};
    rig_open(&rig, 4, 4);
    assert_int_equal(spirv_dispatch(&rig, program, &frame, workgroups), RHW_OK);
    rig_close(&rig);
    rhw_shader_program_destroy(program);
}

#endif
