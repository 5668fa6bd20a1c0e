// SPDX-License-Identifier: MIT
// Inputs, outputs and buffers. A load outside of a buffer gives 0, and a store there does nothing.
#ifndef SHADER_KERNEL_MEMORY_H
#define SHADER_KERNEL_MEMORY_H

#include <string.h>

#include "kernel_flow.h"
#include "form/form.h"

static void run_INPUT(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    if (frame->vertices) {
        for (int i = 0; i < frame->groups; i++) {
            d[i].f = frame->vertices[i].attribute[in->immediate / 4][in->immediate % 4];
        }
        return;
    }
    const int component = frame->bytecode->component_of[in->immediate];
    for (int i = 0; i < frame->groups; i++) {
        d[i].f = frame->fragments[i].varying[component];
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
    default: return rhw_splat_int(0);
    }
}

static void run_BUILT_IN(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        if (frame->fragments) {
            d[i].i = fragment_built_in(&frame->fragments[i], in->immediate);
        } else {
            d[i].i = in->immediate == SHADER_IN_INSTANCE_INDEX ? frame->vertices[i].instance_index
                                                               : frame->vertices[i].vertex_index;
        }
    }
}

static void vertex_output(const struct shader_bytecode *bytecode, struct rhw_vertex *vertex, uint32_t slot, union vector value)
{
    if (slot < SHADER_OUT_POSITION + 4) {
        vertex->position[slot - SHADER_OUT_POSITION] = value.f;
    } else if (slot == SHADER_OUT_POINT_SIZE) {
        vertex->point_size = value.f;
    } else if (slot < SHADER_OUT_CULL_DISTANCE) {
        vertex->clip_distance[slot - SHADER_OUT_CLIP_DISTANCE] = value.f;
    } else if (slot < SHADER_OUT_LAYER) {
        vertex->cull_distance[slot - SHADER_OUT_CULL_DISTANCE] = value.f;
    } else if (slot == SHADER_OUT_LAYER) {
        vertex->layer = value.i;
    } else if (slot == SHADER_OUT_VIEWPORT) {
        vertex->viewport_index = value.i;
    } else if (slot >= SHADER_OUT_VARYING && bytecode->component_of[slot - SHADER_OUT_VARYING] != 0xff) {
        vertex->varying[bytecode->component_of[slot - SHADER_OUT_VARYING]] = value.f;
    }
}

static void fragment_output(const struct shader_bytecode *bytecode, struct rhw_fragment *fragment, uint32_t slot, union vector value)
{
    const uint32_t channel = slot - SHADER_OUT_VARYING;
    if (slot == SHADER_OUT_DEPTH) {
        fragment->depth = value.f;
    } else if (slot == SHADER_OUT_SAMPLE_MASK) {
        fragment->sample_mask &= value.i;
    } else if (slot >= SHADER_OUT_VARYING && channel / 4 < bytecode->target_count) {
        fragment->color[channel / 4][channel % 4] = value.f;
    }
}

static void run_OUTPUT(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const a = &frame->registers[in->a.vector];
    for (int i = 0; i < frame->groups; i++) {
        const union vector value = a[in->a.is_uniform ? 0 : i];
        if (frame->vertices) {
            vertex_output(frame->bytecode, &frame->vertices[i], in->immediate, value);
        } else {
            fragment_output(frame->bytecode, &frame->fragments[i], in->immediate, value);
        }
    }
}

static const struct shader_buffer *buffer_of(const struct frame *frame, const struct shader_instruction *in)
{
    return in->resource == SHADER_NO_RESOURCE ? &frame->bound->push : &frame->bound->buffers[in->resource];
}

// Return the place of a word, or NULL where it is not within the buffer.
static unsigned char *word_at(const struct shader_buffer *buffer, uint32_t offset, uint32_t more)
{
    const uint64_t at = (uint64_t)offset + more;
    return at + 4 <= buffer->size && (at & 3) == 0 ? buffer->bytes + at : NULL;
}

static int32_t load_word(const struct shader_buffer *buffer, uint32_t offset, uint32_t more)
{
    const unsigned char *const word = word_at(buffer, offset, more);
    int32_t value = 0;
    if (word) {
        memcpy(&value, word, sizeof value);
    }
    return value;
}

static void run_LOAD(struct frame *frame, const struct shader_instruction *in)
{
    const struct shader_buffer *const buffer = buffer_of(frame, in);
    union vector *const d = &frame->registers[in->result.vector];
    const union vector *const offset = &frame->registers[in->b.vector];
    if (in->is_uniform) {
        d[0].i = rhw_splat_int(load_word(buffer, (uint32_t)offset[0].i[0], in->immediate));
        return;
    }
    for (int i = 0; i < frame->groups; i++) {
        const rhw_int at = offset[in->b.is_uniform ? 0 : i].i;
        rhw_int value = rhw_splat_int(0);
        for (int lane = 0; lane < RHW_LANES; lane++) {
            value[lane] = load_word(buffer, (uint32_t)at[lane], in->immediate);
        }
        d[i].i = value;
    }
}

static void run_STORE(struct frame *frame, const struct shader_instruction *in)
{
    const struct shader_buffer *const buffer = buffer_of(frame, in);
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    const union vector *const offset = &frame->registers[in->b.vector], *const from = &frame->registers[in->c.vector];
    for (int i = 0; i < frame->groups; i++) {
        const rhw_int at = offset[in->b.is_uniform ? 0 : i].i, value = from[in->c.is_uniform ? 0 : i].i;
        for (int lane = 0; lane < RHW_LANES; lane++) {
            unsigned char *const word =
                active[i].i[lane] ? word_at(buffer, (uint32_t)at[lane], in->immediate) : NULL;
            if (word) {
                const int32_t number = value[lane];
                memcpy(word, &number, sizeof number);
            }
        }
    }
}

static void run_LENGTH(struct frame *frame, const struct shader_instruction *in)
{
    const size_t size = buffer_of(frame, in)->size;
    union vector *const d = &frame->registers[in->result.vector];
    const int count = in->is_uniform ? 1 : frame->groups;
    for (int i = 0; i < count; i++) {
        d[i].i = rhw_splat_int((int32_t)(size > UINT32_MAX ? UINT32_MAX : size));
    }
}

static void run_NOTHING(struct frame *frame, const struct shader_instruction *in)
{
    (void)frame;
    (void)in;
}

#endif
