// SPDX-License-Identifier: MIT
// Inputs, outputs and buffers. A load outside of a buffer gives 0, and a store there does nothing.
#ifndef SHADER_KERNEL_MEMORY_H
#define SHADER_KERNEL_MEMORY_H

#include <string.h>

#include "kernel_arithmetic.h"
#include "kernel_flow.h"
#include "rhw/shader_binding.h"
#include "form/form.h"

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

static void put_varying(const struct frame *frame, const struct shader_instruction *in, int component)
{
    struct rhw_vertex *const vertices = frame->vertices;
    for (int i = 0; i < frame->groups; i++) {
        vertices[i].varying[component] = operand_a(frame, in, i).f;
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
    const uint32_t slot = in->immediate;
    if (slot >= SHADER_OUT_VARYING) {
        const int component = bytecode->component_of[slot - SHADER_OUT_VARYING];
        if (component != 0xff) {
            put_varying(frame, in, component);
        }
        return;
    }
    for (int i = 0; i < frame->groups; i++) {
        if (slot < SHADER_OUT_POSITION + 4) {
            frame->vertices[i].position[slot - SHADER_OUT_POSITION] = operand_a(frame, in, i).f;
        } else {
            put_other(&frame->vertices[i], slot, operand_a(frame, in, i));
        }
    }
    if (slot == SHADER_OUT_POSITION + 3 && bytecode->w_component != 0xff) {
        put_varying(frame, in, bytecode->w_component);
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

// Return an element of a resource, or NULL where there is none.
static const struct rhw_binding *binding_of(const struct frame *frame, uint32_t resource, uint32_t element)
{
    if (resource == SHADER_SHARED) {
        return &frame->shared;
    }
    const struct shader_slot *const slot = &frame->bytecode->slots[resource];
    const struct rhw_binding *const set = frame->bound->sets[slot->set];
    return set && element < slot->count ? set + slot->first + element : NULL;
}

static int32_t load_push(const struct frame *frame, uint32_t index)
{
    int32_t value = 0;
    if (index < frame->bound->push_size / 4) {
        memcpy(&value, (const unsigned char *)frame->bound->push_constants + 4 * (size_t)index, sizeof value);
    }
    return value;
}

static rhw_int load_words(const struct frame *frame, const struct shader_instruction *in, rhw_int index,
                          rhw_int mask)
{
    if (in->resource == SHADER_NO_RESOURCE) {
        rhw_int value;
        for (int lane = 0; lane < RHW_LANES; lane++) {
            value[lane] = load_push(frame, (uint32_t)index[lane]);
        }
        return value;
    }
    rhw_int value = rhw_splat_int(0);
    const rhw_int element = frame->registers[in->a.vector].i;
    if (in->a.is_uniform) {
        return rhw_binding_storage_load(binding_of(frame, in->resource, (uint32_t)element[0]), index, mask);
    }
    for (rhw_int todo = mask, lanes; rhw_any(todo);) {
        const uint32_t named = (uint32_t)rhw_binding_next(element, &todo, &lanes);
        value |= rhw_binding_storage_load(binding_of(frame, in->resource, named), index, lanes) & lanes;
    }
    return value;
}

static rhw_int word_index(const struct frame *frame, const struct shader_instruction *in, int group)
{
    const rhw_uint offset =
        (rhw_uint)frame->registers[in->b.vector + (in->b.is_uniform ? 0u : (uint32_t)group)].i;
    return (rhw_int)((offset + (rhw_uint)rhw_splat_int((int32_t)in->immediate)) >> 2);
}

static void run_LOAD(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    if (in->is_uniform) {
        const uint32_t index = (uint32_t)word_index(frame, in, 0)[0];
        const uint32_t element = (uint32_t)frame->registers[in->a.vector].i[0];
        d[0].i =
            rhw_splat_int(in->resource == SHADER_NO_RESOURCE
                              ? load_push(frame, index)
                              : rhw_binding_storage_load1(binding_of(frame, in->resource, element), index));
        return;
    }
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    for (int i = 0; i < frame->groups; i++) {
        d[i].i = load_words(frame, in, word_index(frame, in, i), active[i].i);
    }
}

static void run_STORE(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    const union vector *const from = &frame->registers[in->c.vector];
    for (int i = 0; i < frame->groups; i++) {
        const rhw_int element = frame->registers[in->a.vector + (in->a.is_uniform ? 0u : (uint32_t)i)].i;
        for (rhw_int todo = active[i].i, lanes; rhw_any(todo);) {
            const uint32_t named = (uint32_t)rhw_binding_next(element, &todo, &lanes);
            rhw_binding_storage_store(binding_of(frame, in->resource, named), word_index(frame, in, i),
                                      from[in->c.is_uniform ? 0 : i].i, lanes);
        }
    }
}

static void run_LENGTH(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const union vector *const element = &frame->registers[in->a.vector];
    const int count = in->is_uniform ? 1 : frame->groups;
    for (int i = 0; i < count; i++) {
        for (int lane = 0; lane < RHW_LANES; lane++) {
            const uint32_t named = (uint32_t)element[in->a.is_uniform ? 0 : i].i[lane];
            const uint32_t words = rhw_binding_storage_count(binding_of(frame, in->resource, named));
            d[i].i[lane] = (int32_t)(words > UINT32_MAX / 4 ? UINT32_MAX & ~3u : 4 * words);
        }
    }
}

static enum rhw_storage_operation operation_of(uint32_t atomic)
{
    static const enum rhw_storage_operation operations[] = {
        [SHADER_ATOMIC_LOAD] = RHW_STORAGE_LOAD,
        [SHADER_ATOMIC_STORE] = RHW_STORAGE_STORE,
        [SHADER_ATOMIC_EXCHANGE] = RHW_STORAGE_EXCHANGE,
        [SHADER_ATOMIC_COMPARE_EXCHANGE] = RHW_STORAGE_COMPARE_EXCHANGE,
        [SHADER_ATOMIC_ADD] = RHW_STORAGE_ADD,
        [SHADER_ATOMIC_MIN_INT] = RHW_STORAGE_MIN,
        [SHADER_ATOMIC_MAX_INT] = RHW_STORAGE_MAX,
        [SHADER_ATOMIC_MIN_UINT] = RHW_STORAGE_MIN_UNSIGNED,
        [SHADER_ATOMIC_MAX_UINT] = RHW_STORAGE_MAX_UNSIGNED,
        [SHADER_ATOMIC_AND] = RHW_STORAGE_AND,
        [SHADER_ATOMIC_OR] = RHW_STORAGE_OR,
        [SHADER_ATOMIC_XOR] = RHW_STORAGE_XOR,
    };
    return operations[atomic];
}

static void run_ATOMIC(struct frame *frame, const struct shader_instruction *in)
{
    const struct shader_operand_of *const operands = frame->bytecode->image_operands + in->b.vector;
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        rhw_int v[SHADER_ATOMIC_OPERANDS], result = rhw_splat_int(0);
        for (int o = 0; o < SHADER_ATOMIC_OPERANDS; o++) {
            v[o] = frame->registers[operands[o].vector + (operands[o].is_uniform ? 0u : (uint32_t)i)].i;
        }
        const rhw_int index = (rhw_int)((rhw_uint)v[SHADER_ATOMIC_OFFSET] >> 2);
        for (rhw_int todo = active[i].i, lanes; rhw_any(todo);) {
            const uint32_t named = (uint32_t)rhw_binding_next(v[SHADER_ATOMIC_BUFFER], &todo, &lanes);
            const struct rhw_storage_request request = {.operation = operation_of(in->immediate),
                                                        .mask = &lanes,
                                                        .index = &index,
                                                        .value = &v[SHADER_ATOMIC_VALUE],
                                                        .comparand = &v[SHADER_ATOMIC_COMPARAND]};
            rhw_int before;
            rhw_binding_storage_access(binding_of(frame, in->resource, named), &request, &before);
            result = rhw_select_int(lanes, before, result);
        }
        d[i].i = result;
    }
}

// A BUFFER is the number of the element, and push constants have none.
static void run_BUFFER(struct frame *frame, const struct shader_instruction *in)
{
    run_COPY(frame, in);
}

static void run_NOTHING(struct frame *frame, const struct shader_instruction *in)
{
    (void)frame;
    (void)in;
}

#endif
