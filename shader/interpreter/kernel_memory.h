// SPDX-License-Identifier: MIT
// Buffers. A load outside of a buffer gives 0, and a store there does nothing.
#ifndef SHADER_KERNEL_MEMORY_H
#define SHADER_KERNEL_MEMORY_H

#include <string.h>

#include "kernel_arithmetic.h"
#include "kernel_flow.h"
#include "rhw/shader_binding.h"
#include "rhw/shader_spirv.h"
#include "form/atomic.h"

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

static rhw_int load_words(const struct frame *frame, const struct shader_instruction *in, int group,
                          rhw_int index, rhw_int mask)
{
    if (in->resource == SHADER_NO_RESOURCE) {
        rhw_int value;
        for (int lane = 0; lane < RHW_LANES; lane++) {
            value[lane] = rhw_spirv_push_word(frame->bound, (uint32_t)index[lane]);
        }
        return value;
    }
    rhw_int value = rhw_splat_int(0);
    const rhw_int element = frame->registers[in->a.vector + (in->a.is_uniform ? 0u : (uint32_t)group)].i;
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

static void run_LOAD_ONCE(struct frame *frame, const struct shader_instruction *in)
{
    const uint32_t index = ((uint32_t)frame->registers[in->b.vector].i[0] + in->immediate) >> 2;
    const uint32_t element = (uint32_t)frame->registers[in->a.vector].i[0];
    const int32_t word = in->resource == SHADER_NO_RESOURCE
                             ? rhw_spirv_push_word(frame->bound, index)
                             : rhw_binding_storage_load1(binding_of(frame, in->resource, element), index);
    frame->registers[in->result.vector].i = rhw_splat_int(word);
}

static void run_LOAD(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    for (int i = 0; i < frame->groups; i++) {
        d[i].i = load_words(frame, in, i, word_index(frame, in, i), active[i].i);
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

// Store the lowest bits of words.
static void store_part(struct frame *frame, const struct shader_instruction *in, int bits)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    for (int i = 0; i < frame->groups; i++) {
        const uint32_t at_b = in->b.is_uniform ? 0u : (uint32_t)i, at_c = in->c.is_uniform ? 0u : (uint32_t)i;
        const rhw_int element = frame->registers[in->a.vector + (in->a.is_uniform ? 0u : (uint32_t)i)].i;
        for (rhw_int todo = active[i].i, lanes; rhw_any(todo);) {
            const uint32_t named = (uint32_t)rhw_binding_next(element, &todo, &lanes);
            rhw_spirv_store_part(binding_of(frame, in->resource, named),
                                 frame->registers[in->b.vector + at_b].i, in->immediate,
                                 frame->registers[in->c.vector + at_c].i, bits, lanes);
        }
    }
}

static void run_STORE8(struct frame *frame, const struct shader_instruction *in)
{
    store_part(frame, in, 8);
}

static void run_STORE16(struct frame *frame, const struct shader_instruction *in)
{
    store_part(frame, in, 16);
}

static void run_LENGTH(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const union vector *const element = &frame->registers[in->a.vector];
    const int count = in->kind == SHADER_ONCE ? 1 : frame->groups;
    for (int i = 0; i < count; i++) {
        for (int lane = 0; lane < RHW_LANES; lane++) {
            const uint32_t named = (uint32_t)element[in->a.is_uniform ? 0 : i].i[lane];
            const uint32_t words = rhw_binding_storage_count(binding_of(frame, in->resource, named));
            d[i].i[lane] = (int32_t)(words > UINT32_MAX / 4 ? UINT32_MAX & ~3u : 4 * words);
        }
    }
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
            const struct rhw_storage_request request = {.operation = shader_storage_operation(in->immediate),
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

// The memory of the workgroup is element 0 of what it stands for.
static void run_WORKGROUP(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    const int count = in->kind == SHADER_ONCE ? 1 : frame->groups;
    for (int i = 0; i < count; i++) {
        d[i].i = rhw_splat_int(0);
    }
}

static void run_NOTHING(struct frame *frame, const struct shader_instruction *in)
{
    (void)frame;
    (void)in;
}

#endif
