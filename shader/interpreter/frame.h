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

// Groups of a batch, from the first to before the last.
struct group_range {
    int first, end;
};

struct frame {
    union vector *registers;
    const struct shader_bytecode *bytecode;
    const struct rhw_shader_frame *bound;
    const struct rhw_bindings *bindings; // tells whether the program gives the work up
    uint32_t rounds;                     // rounds of loops until now
    bool is_given_up;
    int groups;
    struct group_range range;    // groups outside of it have no active lane, and arithmetic leaves them out
    struct group_range *outer;   // behind the ranges that come back when structure ends
    struct rhw_vertex *vertices; // groups of the batch, or NULL
    struct rhw_fragment *fragments;            // groups of the batch, or NULL
    const struct rhw_workgroup *workgroup;     // what a compute shader is called for, or NULL
    const struct rhw_invocations *invocations; // groups of the batch, where there is a workgroup
    struct rhw_binding shared;                 // memory of the workgroup
    const struct shader_instruction *next;
    rhw_float (*texels)[4]; // what was sampled last, by group
};

typedef void shader_kernel(struct frame *frame, const struct shader_instruction *in);

#endif
