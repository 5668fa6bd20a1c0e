// SPDX-License-Identifier: MIT
// Operations among the 8 lanes of a group, of which those take part that are active.
#ifndef SHADER_KERNEL_SUBGROUP_H
#define SHADER_KERNEL_SUBGROUP_H

#include "form/form.h"
#include "kernel_arithmetic.h"
#include "kernel_flow.h"
#include "rhw/shader_spirv.h"

_Static_assert((int)SHADER_SCAN_XOR == (int)RHW_SPIRV_SCAN_XOR, "the form and rhw_spirv_scan have one enum");

static void run_BALLOT(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                              *const a = &frame->registers[in->a.vector];
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        d[i].i = rhw_spirv_ballot(a[in->a.is_uniform ? 0 : i].i, active[i].i);
    }
}

static void run_SHUFFLE(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                              *const a = &frame->registers[in->a.vector],
                              *const b = &frame->registers[in->b.vector];
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        d[i].i = rhw_spirv_shuffle(a[in->a.is_uniform ? 0 : i].i, b[in->b.is_uniform ? 0 : i].i, active[i].i);
    }
}

static void run_SCAN(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                              *const a = &frame->registers[in->a.vector];
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        d[i].i = rhw_spirv_scan(in->immediate, a[in->a.is_uniform ? 0 : i].i, active[i].i);
    }
}

#endif
