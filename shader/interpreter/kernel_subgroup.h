// SPDX-License-Identifier: MIT
// Operations among the 8 lanes of a group, of which those take part that are active.
#ifndef SHADER_KERNEL_SUBGROUP_H
#define SHADER_KERNEL_SUBGROUP_H

#include "kernel_arithmetic.h"
#include "kernel_flow.h"
#include "form/form.h"

static void run_BALLOT(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                              *const a = &frame->registers[in->a.vector];
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        d[i].i = rhw_splat_int(rhw_mask_bits(active[i].i & a[in->a.is_uniform ? 0 : i].i));
    }
}

static void run_SHUFFLE(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                              *const a = &frame->registers[in->a.vector],
                              *const b = &frame->registers[in->b.vector];
    union vector *const d = &frame->registers[in->result.vector];
    for (int i = 0; i < frame->groups; i++) {
        const rhw_int value = a[in->a.is_uniform ? 0 : i].i & active[i].i,
                      from = b[in->b.is_uniform ? 0 : i].i;
        for (int lane = 0; lane < RHW_LANES; lane++) {
            d[i].i[lane] = (uint32_t)from[lane] < RHW_LANES ? value[from[lane]] : 0;
        }
    }
}

static uint32_t scan_float(enum shader_scan scan, uint32_t x, uint32_t y)
{
    float a, b;
    memcpy(&a, &x, sizeof a);
    memcpy(&b, &y, sizeof b);
    const float result = scan == SHADER_SCAN_FADD   ? a + b
                         : scan == SHADER_SCAN_FMUL ? a * b
                         : scan == SHADER_SCAN_FMIN ? (b < a ? b : a)
                                                    : (a < b ? b : a);
    memcpy(&x, &result, sizeof x);
    return x;
}

static uint32_t scan_two(enum shader_scan scan, uint32_t x, uint32_t y)
{
    switch (scan) {
    case SHADER_SCAN_IADD: return x + y;
    case SHADER_SCAN_IMUL: return x * y;
    case SHADER_SCAN_MIN_INT: return (int32_t)y < (int32_t)x ? y : x;
    case SHADER_SCAN_MAX_INT: return (int32_t)x < (int32_t)y ? y : x;
    case SHADER_SCAN_MIN_UINT: return y < x ? y : x;
    case SHADER_SCAN_MAX_UINT: return x < y ? y : x;
    case SHADER_SCAN_AND: return x & y;
    case SHADER_SCAN_OR: return x | y;
    case SHADER_SCAN_XOR: return x ^ y;
    default: return scan_float(scan, x, y);
    }
}

// What a lane gets that has no other before it.
static uint32_t scan_none(enum shader_scan scan)
{
    switch (scan) {
    case SHADER_SCAN_FMUL: return 0x3f800000;
    case SHADER_SCAN_FMIN: return 0x7f800000;
    case SHADER_SCAN_FMAX: return 0xff800000;
    case SHADER_SCAN_IMUL: return 1;
    case SHADER_SCAN_MIN_INT: return INT32_MAX;
    case SHADER_SCAN_MAX_INT: return 0x80000000;
    case SHADER_SCAN_MIN_UINT:
    case SHADER_SCAN_AND: return UINT32_MAX;
    default: return 0;
    }
}

// Scan the active lanes of a cluster, from the first to the last.
static void scan_cluster(uint32_t immediate, rhw_int value, rhw_int active, int first, rhw_int *result)
{
    const enum shader_scan scan = (enum shader_scan)(immediate & 15);
    const uint32_t reach = immediate >> SHADER_SCAN_REACH_SHIFT & 3;
    const int end = first + (1 << (immediate >> SHADER_SCAN_CLUSTER_SHIFT & 3));
    uint32_t all = scan_none(scan);
    bool has_any = false;
    for (int lane = first; lane < end; lane++) {
        if (!active[lane]) {
            continue;
        }
        const uint32_t before = all, own = (uint32_t)value[lane];
        all = has_any ? scan_two(scan, all, own) : own;
        has_any = true;
        (*result)[lane] = (int32_t)(reach == 2 ? before : all);
    }
    for (int lane = first; reach == 0 && lane < end; lane++) {
        (*result)[lane] = active[lane] ? (int32_t)all : 0;
    }
}

static void run_SCAN(struct frame *frame, const struct shader_instruction *in)
{
    const union vector *const active = fixed_register(frame, SHADER_ACTIVE),
                              *const a = &frame->registers[in->a.vector];
    union vector *const d = &frame->registers[in->result.vector];
    const int lanes = 1 << (in->immediate >> SHADER_SCAN_CLUSTER_SHIFT & 3);
    for (int i = 0; i < frame->groups; i++) {
        rhw_int result = rhw_splat_int(0);
        for (int first = 0; first < RHW_LANES; first += lanes) {
            scan_cluster(in->immediate, a[in->a.is_uniform ? 0 : i].i, active[i].i, first, &result);
        }
        d[i].i = result;
    }
}

#endif
