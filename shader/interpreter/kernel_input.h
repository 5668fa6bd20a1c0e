// SPDX-License-Identifier: MIT
// Inputs and outputs of the stages.
#ifndef SHADER_KERNEL_INPUT_H
#define SHADER_KERNEL_INPUT_H

#include "kernel_flow.h"
#include "form/form.h"
#include "rhw/shader_spirv.h"

static void run_INPUT(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const int count = frame->groups;
    if (frame->vertices) {
        const struct rhw_vertex *const vertices = frame->vertices;
        for (int i = 0; i < count; i++) {
            d[i].f = vertices[i].attribute[in->immediate / 4][in->immediate % 4];
        }
        return;
    }
    const int component = frame->bytecode->component_of[in->immediate];
    const struct rhw_fragment *const fragments = frame->fragments;
    for (int i = 0; i < count; i++) {
        d[i].f = fragments[i].varying[component];
    }
}

static rhw_int fragment_built_in(const struct rhw_fragment *fragment, uint32_t number)
{
    switch (number) {
    case SHADER_IN_COORD:
    case SHADER_IN_COORD + 1:
    case SHADER_IN_COORD + 2:
    case SHADER_IN_COORD + 3: return rhw_bits_from_float(fragment->coord[number - SHADER_IN_COORD]);
    case SHADER_IN_FRONT_FACING: return fragment->front_facing;
    case SHADER_IN_PRIMITIVE: return fragment->primitive;
    case SHADER_IN_SAMPLE_ID: return fragment->sample_id;
    case SHADER_IN_SAMPLE_POSITION:
    case SHADER_IN_SAMPLE_POSITION + 1:
        return rhw_bits_from_float(fragment->sample_position[number - SHADER_IN_SAMPLE_POSITION]);
    case SHADER_IN_SAMPLE_MASK: return fragment->sample_mask;
    case SHADER_IN_POINT_COORD:
    case SHADER_IN_POINT_COORD + 1:
        return rhw_bits_from_float(fragment->point_coord[number - SHADER_IN_POINT_COORD]);
    case SHADER_IN_LAYER: return fragment->layer;
    case SHADER_IN_VIEWPORT: return fragment->viewport_index;
    case SHADER_IN_LANE: return rhw_lane_numbers();
    default: return rhw_splat_int(0);
    }
}

static rhw_int invocation_built_in(const struct frame *frame, int group, uint32_t number)
{
    const struct rhw_invocations *const group_of = &frame->invocations[group];
    const struct rhw_workgroup *const workgroup = frame->workgroup;
    if (number >= SHADER_IN_LOCAL_INDEX) {
        return number == SHADER_IN_LANE ? rhw_lane_numbers() : group_of->index;
    }
    if (number >= SHADER_IN_GLOBAL) {
        return group_of->id[number - SHADER_IN_GLOBAL];
    }
    if (number >= SHADER_IN_LOCAL) {
        return group_of->local[number - SHADER_IN_LOCAL];
    }
    if (number >= SHADER_IN_WORKGROUP) {
        return rhw_splat_int(workgroup->id[number - SHADER_IN_WORKGROUP]);
    }
    return rhw_splat_int(
        number >= SHADER_IN_WORKGROUP_COUNT ? workgroup->counts[number - SHADER_IN_WORKGROUP_COUNT] : 0);
}

static void run_BUILT_IN(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        if (frame->workgroup) {
            d[i].i = invocation_built_in(frame, i, in->immediate);
        } else if (frame->fragments) {
            d[i].i = fragment_built_in(&frame->fragments[i], in->immediate);
        } else {
            d[i].i = in->immediate == SHADER_IN_INSTANCE_INDEX ? frame->vertices[i].instance_index
                     : in->immediate == SHADER_IN_LANE         ? rhw_lane_numbers()
                                                               : frame->vertices[i].vertex_index;
        }
    }
}

// The value of the first operand in a group.
static inline union vector operand_a(const struct frame *frame, const struct shader_instruction *in,
                                     int group)
{
    return frame->registers[in->a.vector + (in->a.is_uniform ? 0u : (uint32_t)group)];
}

static void put_component(const struct frame *frame, const struct shader_instruction *in, int component)
{
    struct rhw_vertex *const vertices = frame->vertices;
    for (int i = 0; i < frame->groups; i++) {
        vertices[i].varying[component] = operand_a(frame, in, i).f;
    }
}

// Write what the fragment stage takes as the input of this number, if it does.
static void put_varying(const struct frame *frame, const struct shader_instruction *in, uint32_t number)
{
    const int component = frame->bytecode->component_of[number];
    if (component != 0xff) {
        put_component(frame, in, component);
    }
}

// Outputs of the vertex stage that are no varyings and not the position.
static void put_other(struct rhw_vertex *vertex, uint32_t slot, union vector value)
{
    if (slot == SHADER_OUT_POINT_SIZE) {
        vertex->point_size = value.f;
    } else if (slot < SHADER_OUT_CULL_DISTANCE) {
        vertex->clip_distance[slot - SHADER_OUT_CLIP_DISTANCE] = value.f;
    } else if (slot < SHADER_OUT_LAYER) {
        vertex->cull_distance[slot - SHADER_OUT_CULL_DISTANCE] = value.f;
    } else if (slot == SHADER_OUT_LAYER) {
        vertex->layer = value.i;
    } else if (slot == SHADER_OUT_VIEWPORT) {
        vertex->viewport_index = value.i;
    }
}

static void put_vertex_output(const struct frame *frame, const struct shader_instruction *in)
{
    const struct shader_bytecode *const bytecode = frame->bytecode;
    const uint32_t slot = in->immediate, number = slot - SHADER_OUT_VARYING;
    if (slot >= SHADER_OUT_VARYING) {
        put_varying(frame, in, SHADER_IN_DECLARED + number);
        put_varying(frame, in, SHADER_IN_CENTROID + number);
        put_varying(frame, in, SHADER_IN_CENTER + number);
        return;
    }
    for (int i = 0; i < frame->groups; i++) {
        if (slot < SHADER_OUT_POSITION + 4) {
            frame->vertices[i].position[slot - SHADER_OUT_POSITION] = operand_a(frame, in, i).f;
        } else {
            put_other(&frame->vertices[i], slot, operand_a(frame, in, i));
        }
    }
    if (slot >= SHADER_OUT_CLIP_DISTANCE &&
        slot < SHADER_OUT_LAYER) { // clip distances, and behind them cull distances
        put_varying(frame, in, SHADER_IN_CLIP_DISTANCE + slot - SHADER_OUT_CLIP_DISTANCE);
    }
    if (slot == SHADER_OUT_POSITION + 3 && bytecode->w_component != 0xff) {
        put_component(frame, in, bytecode->w_component);
    }
}

// The colours of the groups of a call stand one after the other.
static void put_color(const struct frame *frame, const struct shader_instruction *in, uint32_t target,
                      uint32_t channel)
{
    enum { STEP = 4 * RHW_MAX_COLOR_ATTACHMENTS };
    rhw_float *const color = &frame->fragments->color[target][channel];
    for (int i = 0; i < frame->groups; i++) {
        color[i * STEP] = operand_a(frame, in, i).f;
    }
}

static void put_fragment_output(const struct frame *frame, const struct shader_instruction *in)
{
    const uint32_t slot = in->immediate, channel = slot - SHADER_OUT_VARYING;
    struct rhw_fragment *const fragments = frame->fragments;
    if (slot >= SHADER_OUT_VARYING) {
        if (channel / 4 < frame->bytecode->target_count) {
            put_color(frame, in, channel / 4, channel % 4);
        }
        return;
    }
    for (int i = 0; i < frame->groups && slot == SHADER_OUT_DEPTH; i++) {
        fragments[i].depth = operand_a(frame, in, i).f;
    }
    for (int i = 0; i < frame->groups && slot == SHADER_OUT_SAMPLE_MASK; i++) {
        fragments[i].sample_mask &= operand_a(frame, in, i).i;
    }
}

static void run_OUTPUT(struct frame *frame, const struct shader_instruction *in)
{
    if (frame->vertices) {
        put_vertex_output(frame, in);
    } else {
        put_fragment_output(frame, in);
    }
}

// Derivatives of inputs, and inputs at partner pixels.
static void run_INPUT_DX(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const int component = frame->bytecode->component_of[in->immediate];
    for (int i = 0; i < frame->groups; i++) {
        d[i].f = frame->fragments[i].ddx[component];
    }
}

static void run_INPUT_DY(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const int component = frame->bytecode->component_of[in->immediate];
    for (int i = 0; i < frame->groups; i++) {
        d[i].f = frame->fragments[i].ddy[component];
    }
}

static void read_partner(struct frame *frame, const struct shader_instruction *in, int axis)
{
    union vector *const d = &frame->registers[in->result.vector];
    const struct shader_bytecode *const bytecode = frame->bytecode;
    const int component = bytecode->component_of[in->immediate];
    const bool is_linear = bytecode->is_linear[in->immediate];
    for (int i = 0; i < frame->groups; i++) {
        const rhw_int odd = rhw_int_from_float(frame->fragments[i].coord[axis]) & 1;
        rhw_float offset[2] = {rhw_splat(0.0f), rhw_splat(0.0f)};
        offset[axis] = rhw_float_from_int(1 - 2 * odd);
        d[i].f = rhw_interpolate_at(&frame->fragments[i], component, is_linear ? -1 : bytecode->w_component,
                                    offset);
    }
}

static void run_INPUT_BESIDE(struct frame *frame, const struct shader_instruction *in)
{
    read_partner(frame, in, 0);
}

static void run_INPUT_BELOW(struct frame *frame, const struct shader_instruction *in)
{
    read_partner(frame, in, 1);
}

// Inputs at an offset, and the offsets of samples -----------------------------------------------------

static void run_INPUT_AT(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const union vector *const x = &frame->registers[in->a.vector], *const y = &frame->registers[in->b.vector];
    const struct shader_bytecode *const bytecode = frame->bytecode;
    const int component = bytecode->component_of[in->immediate];
    const int w = bytecode->is_linear[in->immediate] ? -1 : bytecode->w_component;
    for (int i = 0; i < frame->groups; i++) {
        d[i].f = rhw_spirv_input_at(&frame->fragments[i], component, w, x[in->a.is_uniform ? 0 : i].f,
                                    y[in->b.is_uniform ? 0 : i].f);
    }
}

static void sample_place(struct frame *frame, const struct shader_instruction *in, int axis)
{
    union vector *const d = &frame->registers[in->result.vector];
    const union vector *const a = &frame->registers[in->a.vector];
    const int count = in->kind == SHADER_ONCE ? 1 : frame->groups;
    for (int i = 0; i < count; i++) {
        d[i].f = rhw_spirv_sample_place(frame->bound, a[in->a.is_uniform ? 0 : i].i, axis);
    }
}

static void run_SAMPLE_X(struct frame *frame, const struct shader_instruction *in)
{
    sample_place(frame, in, 0);
}

static void run_SAMPLE_Y(struct frame *frame, const struct shader_instruction *in)
{
    sample_place(frame, in, 1);
}

#endif
