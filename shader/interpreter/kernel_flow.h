// SPDX-License-Identifier: MIT
// Structure: which lanes are active, and jumps where none is.
#ifndef SHADER_KERNEL_FLOW_H
#define SHADER_KERNEL_FLOW_H

#include "frame.h"
#include "rhw/shader_spirv.h"

static union vector *fixed_register(struct frame *frame, int number)
{
    return &frame->registers[(uint32_t)number * frame->bytecode->batch];
}

static bool any_active(struct frame *frame)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    rhw_int any = active[0].i;
    for (int i = 1; i < frame->groups; i++) {
        any |= active[i].i;
    }
    return rhw_any(any);
}

static void jump_if_none(struct frame *frame, const struct shader_instruction *in)
{
    if (!any_active(frame)) {
        frame->next = frame->bytecode->code + in->immediate;
    }
}

static void run_IF(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                        *const saved = &frame->registers[in->result.vector];
    const union vector *const a = &frame->registers[in->a.vector];
    for (int i = 0; i < frame->groups; i++) {
        saved[i].i = active[i].i;
        active[i].i &= a[in->a.is_uniform ? 0 : i].i;
    }
    jump_if_none(frame, in);
}

static void run_ELSE(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const active = fixed_register(frame, SHADER_ACTIVE), *const alive = fixed_register(
                                                                           frame, SHADER_ALIVE);
    const union vector *const saved = &frame->registers[in->result.vector],
                              *const a = &frame->registers[in->a.vector];
    for (int i = 0; i < frame->groups; i++) {
        active[i].i = saved[i].i & alive[i].i & ~a[in->a.is_uniform ? 0 : i].i;
    }
    jump_if_none(frame, in);
}

static void run_JUMP(struct frame *frame, const struct shader_instruction *in)
{
    frame->next = frame->bytecode->code + in->immediate;
}

static void run_JUMP_UNLESS(struct frame *frame, const struct shader_instruction *in)
{
    if (frame->registers[in->a.vector].i[0] == 0) {
        run_JUMP(frame, in);
    }
}

// Behind structure that lanes leave for good, go to the end of what lies around it if none is left.
static void go_on(struct frame *frame, const struct shader_instruction *in)
{
    if (in->c.vector != 0 && !any_active(frame)) {
        frame->next = frame->bytecode->code + in->c.vector;
    }
}

static void run_END_IF(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const active = fixed_register(frame, SHADER_ACTIVE), *const alive = fixed_register(
                                                                           frame, SHADER_ALIVE);
    const union vector *const saved = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        active[i].i = saved[i].i & alive[i].i;
    }
    go_on(frame, in);
}

// REGION and LOOP: `saved` are the lanes that come in, `left` those that have left.
static void run_REGION(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    union vector *const saved = &frame->registers[in->result.vector], *const left =
                                                                          &frame->registers[in->b.vector];
    for (int i = 0; i < frame->groups; i++) {
        saved[i].i = active[i].i;
        left[i].i = rhw_splat_int(0);
    }
}

static void run_END_REGION(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const active = fixed_register(frame, SHADER_ACTIVE), *const alive = fixed_register(
                                                                           frame, SHADER_ALIVE);
    const union vector *const saved = &frame->registers[in->result.vector],
                              *const left = &frame->registers[in->b.vector];
    for (int i = 0; i < frame->groups; i++) {
        alive[i].i |= left[i].i;
        active[i].i = saved[i].i & alive[i].i;
    }
    go_on(frame, in);
}

// A loop may have no end, so the program is asked now and then whether somebody waits for it.
static bool is_given_up(struct frame *frame)
{
    frame->is_given_up = frame->is_given_up || rhw_spirv_is_given_up(&frame->rounds, frame->bindings);
    return frame->is_given_up;
}

static void run_END_LOOP(struct frame *frame, const struct shader_instruction *in)
{
    if (any_active(frame)) {
        const struct shader_bytecode *const bytecode = frame->bytecode;
        frame->next = bytecode->code + (is_given_up(frame) ? bytecode->code_count - 1 : in->immediate);
        return;
    }
    run_END_REGION(frame, in);
}

static void take_away(struct frame *frame, union vector *to)
{
    union vector *const active = fixed_register(frame, SHADER_ACTIVE), *const alive = fixed_register(
                                                                           frame, SHADER_ALIVE);
    for (int i = 0; i < frame->groups; i++) {
        to[i].i |= active[i].i;
        alive[i].i &= ~active[i].i;
        active[i].i = rhw_splat_int(0);
    }
}

static void run_LEAVE(struct frame *frame, const struct shader_instruction *in)
{
    take_away(frame, &frame->registers[in->result.vector]);
}

static void run_DISCARD(struct frame *frame, const struct shader_instruction *in)
{
    (void)in;
    take_away(frame, fixed_register(frame, SHADER_KILLED));
}

static void run_SET(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                              *const a = &frame->registers[in->a.vector];
    union vector *const d = &frame->registers[in->result.vector];
    if (in->is_uniform) {
        d[0].i = a[0].i;
        return;
    }
    for (int i = 0; i < frame->groups; i++) {
        d[i].i = rhw_select_int(active[i].i, a[in->a.is_uniform ? 0 : i].i, d[i].i);
    }
}

static void run_FILL(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const int count = in->is_uniform ? 1 : frame->groups;
    for (int i = 0; i < count; i++) {
        d[i].i = rhw_splat_int((int32_t)in->immediate);
    }
}

#endif
