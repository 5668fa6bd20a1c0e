// SPDX-License-Identifier: MIT
// One batch under execution.
#ifndef SHADER_FRAME_H
#define SHADER_FRAME_H

#include "bytecode.h"
#include "rhw/shader.h"
#include "rhw/shader_binding.h"

union vector {
    rhw_float f;
    rhw_int i;
};

struct frame {
    union vector *registers;
    const struct shader_bytecode *bytecode;
    const struct rhw_shader_frame *bound;
    const struct rhw_bindings *bindings; // tells whether the program gives the work up
    uint32_t rounds;                     // of loops
    bool is_given_up;
    int groups;
    struct rhw_vertex *vertices;               // of the batch, or NULL
    struct rhw_fragment *fragments;            // of the batch, or NULL
    const struct rhw_workgroup *workgroup;     // of compute, or NULL
    const struct rhw_invocations *invocations; // of the batch
    struct rhw_binding shared;                 // memory of the workgroup
    const struct shader_instruction *next;
    rhw_float texels[RHW_MAX_WORKGROUP_GROUPS][4]; // what was sampled last
};

typedef void shader_kernel(struct frame *frame, const struct shader_instruction *in);

#endif
