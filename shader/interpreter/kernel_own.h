// SPDX-License-Identifier: MIT
// Memory of the lanes, which are registers behind the fixed ones: word n of a lane is that lane of register n. And
// tables of constants. A load outside of them gives 0, and a store there does nothing.
#ifndef SHADER_KERNEL_OWN_H
#define SHADER_KERNEL_OWN_H

#include "kernel_memory.h"

static union vector *own_memory(struct frame *frame)
{
    return fixed_register(frame, SHADER_FIXED_REGISTERS);
}

static void run_LOAD_PRIVATE(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const memory = own_memory(frame);
    union vector *const d = &frame->registers[in->result.vector];
    const uint32_t words = frame->bytecode->private_count, batch = frame->bytecode->batch;
    for (int i = 0; i < frame->groups; i++) {
        const rhw_int index = word_index(frame, in, i);
        const union vector *const own = memory + i;
        if (in->b.is_uniform) {
            const uint32_t word = (uint32_t)index[0];
            d[i].i = word < words ? own[(size_t)word * batch].i : rhw_splat_int(0);
            continue;
        }
        for (int lane = 0; lane < RHW_LANES; lane++) {
            const uint32_t word = (uint32_t)index[lane];
            d[i].i[lane] = word < words ? own[(size_t)word * batch].i[lane] : 0;
        }
    }
}

static void run_STORE_PRIVATE(struct frame *frame, const struct shader_instruction *in)
{
    union vector *const memory = own_memory(frame);
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE);
    const union vector *const from = &frame->registers[in->c.vector];
    const uint32_t words = frame->bytecode->private_count, batch = frame->bytecode->batch;
    for (int i = 0; i < frame->groups; i++) {
        const rhw_int index = word_index(frame, in, i), value = from[in->c.is_uniform ? 0 : i].i;
        union vector *const own = memory + i;
        if (in->b.is_uniform && (uint32_t)index[0] < words) {
            union vector *const word = &own[(size_t)(uint32_t)index[0] * batch];
            word->i = rhw_select_int(active[i].i, value, word->i);
        }
        for (int lane = 0; lane < RHW_LANES && !in->b.is_uniform; lane++) {
            const uint32_t word = (uint32_t)index[lane];
            if (active[i].i[lane] && word < words) {
                own[(size_t)word * batch].i[lane] = value[lane];
            }
        }
    }
}

static void run_LOAD_TABLE(struct frame *frame, const struct shader_instruction *in)
{
    const struct shader_bytecode *const bytecode = frame->bytecode;
    union vector *const d = &frame->registers[in->result.vector];
    const int first = in->kind == SHADER_ONCE ? 0 : frame->range.first,
              end = in->kind == SHADER_ONCE ? 1 : frame->range.end;
    const int32_t *const table = (const int32_t *)bytecode->table;
    for (int i = first; i < end; i++) {
        d[i].i = rhw_gather_int(table, (int32_t)bytecode->table_count, word_index(frame, in, i));
    }
}

#endif
