// SPDX-License-Identifier: MIT
// Operations among the 8 lanes of a group, of which those take part that are active.
#ifndef SHADER_KERNEL_SUBGROUP_H
#define SHADER_KERNEL_SUBGROUP_H

#include "kernel_arithmetic.h"
#include "kernel_flow.h"
#include "form/form.h"
#include "rhw/shader_subgroup.h"

_Static_assert(SHADER_SCAN_FADD == (int)RHW_SPIRV_SCAN_FADD && SHADER_SCAN_XOR == (int)RHW_SPIRV_SCAN_XOR,
               "scans of the form are those of shader_subgroup.h");

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
    const enum rhw_spirv_scan scan = (enum rhw_spirv_scan)(in->immediate & 15);
    const enum rhw_spirv_reach reach = (enum rhw_spirv_reach)(in->immediate >> SHADER_SCAN_REACH_SHIFT & 3);
    const int lanes = 1 << (in->immediate >> SHADER_SCAN_CLUSTER_SHIFT & 3);
    for (int i = 0; i < frame->groups; i++) {
        d[i].i = rhw_spirv_scan(scan, reach, lanes, a[in->a.is_uniform ? 0 : i].i, active[i].i);
    }
}

#endif
