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

// Narrow the range to the first and the last group that has an active lane. Return false where no group has one; then
// the range stays.
static bool narrow_range(struct frame *frame)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    struct group_range range = frame->range;
    while (range.first < range.end && !rhw_any(active[range.first].i)) {
        range.first++;
    }
    if (range.first == range.end) {
        return false;
    }
    while (!rhw_any(active[range.end - 1].i)) {
        range.end--;
    }
    frame->range = range;
    return true;
}

// Keep the range of groups until the structure that begins now ends.
static void push_range(struct frame *frame)
{
    *frame->outer++ = frame->range;
}

static void pop_range(struct frame *frame)
{
    frame->range = *--frame->outer;
}

static void jump_if_none(struct frame *frame, const struct shader_instruction *in)
{
    if (!narrow_range(frame)) {
        frame->next = frame->bytecode->code + in->immediate;
    }
}

static void run_IF(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                        *const saved = &frame->registers[in->result.vector];
    const union vector *const a = &frame->registers[in->a.vector];
    push_range(frame);
    for (int i = frame->range.first; i < frame->range.end; i++) {
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
    frame->range = frame->outer[-1];
    for (int i = frame->range.first; i < frame->range.end; i++) {
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

// Behind structure, narrow the range to the groups that have active lanes. Where lanes may have left for good and none
// is active, go to the end of what lies around it.
static void go_on(struct frame *frame, const struct shader_instruction *in)
{
    if (!narrow_range(frame) && in->c.vector != 0) {
        frame->next = frame->bytecode->code + in->c.vector;
    }
}

static void run_END_IF(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const active = fixed_register(frame, SHADER_ACTIVE), *const alive = fixed_register(
                                                                           frame, SHADER_ALIVE);
    const union vector *const saved = &frame->registers[in->result.vector];
    pop_range(frame);
    for (int i = frame->range.first; i < frame->range.end; i++) {
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
    push_range(frame);
    for (int i = frame->range.first; i < frame->range.end; i++) {
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
    pop_range(frame);
    for (int i = frame->range.first; i < frame->range.end; i++) {
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
    if (narrow_range(frame)) {
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
    for (int i = frame->range.first; i < frame->range.end; i++) {
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

static bool any_active(struct frame *frame)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    bool any = false;
    for (int i = frame->range.first; i < frame->range.end && !any; i++) {
        any = rhw_any(active[i].i);
    }
    return any;
}

// Code behind a LEAVE is executed though no lane is active, so a register of all lanes changes where one is.
static void run_SET(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                              *const a = &frame->registers[in->a.vector];
    union vector *const d = &frame->registers[in->result.vector];
    if (in->kind == SHADER_ONCE) {
        d[0].i = any_active(frame) ? a[0].i : d[0].i;
        return;
    }
    const int step = in->a.is_uniform ? 0 : 1;
    for (int i = frame->range.first; i < frame->range.end; i++) {
        d[i].i = rhw_select_int(active[i].i, a[i * step].i, d[i].i);
    }
}

static void run_FILL(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const int count = in->kind == SHADER_ONCE ? 1 : frame->groups;
    for (int i = 0; i < count; i++) {
        d[i].i = rhw_splat_int((int32_t)in->immediate);
    }
}

#endif
