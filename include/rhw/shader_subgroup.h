// SPDX-License-Identifier: MIT
// Operations of translated shaders among the 8 lanes of a group, which is their subgroup (Vulkan 1.3 §9.27, "Group
// Operations"). Those lanes take part that are active. shader_spirv.h includes this header.
#ifndef RHW_SHADER_SUBGROUP_H
#define RHW_SHADER_SUBGROUP_H

#include "shader_vector.h"

#if RHW_HAS_LANES

/// What a scan does with the values of active lanes.
enum rhw_spirv_scan {
    RHW_SPIRV_SCAN_FADD,
    RHW_SPIRV_SCAN_FMUL,
    RHW_SPIRV_SCAN_FMIN,
    RHW_SPIRV_SCAN_FMAX,
    RHW_SPIRV_SCAN_IADD,
    RHW_SPIRV_SCAN_IMUL,
    RHW_SPIRV_SCAN_MIN_INT,
    RHW_SPIRV_SCAN_MAX_INT,
    RHW_SPIRV_SCAN_MIN_UINT,
    RHW_SPIRV_SCAN_MAX_UINT,
    RHW_SPIRV_SCAN_AND,
    RHW_SPIRV_SCAN_OR,
    RHW_SPIRV_SCAN_XOR
};

/// How far a lane looks: at all lanes of its cluster, up to itself, or at those before it.
enum rhw_spirv_reach { RHW_SPIRV_REACH_ALL, RHW_SPIRV_REACH_INCLUSIVE, RHW_SPIRV_REACH_EXCLUSIVE };

RHW_QUIET_BEGIN

/// Return the operation on two floats, as bits.
static inline uint32_t rhw_spirv_scan_float(enum rhw_spirv_scan scan, uint32_t x, uint32_t y)
{
    float a, b;
    memcpy(&a, &x, sizeof a);
    memcpy(&b, &y, sizeof b);
    const float result = scan == RHW_SPIRV_SCAN_FADD   ? a + b
                         : scan == RHW_SPIRV_SCAN_FMUL ? a * b
                         : scan == RHW_SPIRV_SCAN_FMIN ? (b < a ? b : a)
                                                       : (a < b ? b : a);
    memcpy(&x, &result, sizeof x);
    return x;
}

/// Return the operation on two values.
static inline uint32_t rhw_spirv_scan_two(enum rhw_spirv_scan scan, uint32_t x, uint32_t y)
{
    switch (scan) {
    case RHW_SPIRV_SCAN_IADD: return x + y;
    case RHW_SPIRV_SCAN_IMUL: return x * y;
    case RHW_SPIRV_SCAN_MIN_INT: return (int32_t)y < (int32_t)x ? y : x;
    case RHW_SPIRV_SCAN_MAX_INT: return (int32_t)x < (int32_t)y ? y : x;
    case RHW_SPIRV_SCAN_MIN_UINT: return y < x ? y : x;
    case RHW_SPIRV_SCAN_MAX_UINT: return x < y ? y : x;
    case RHW_SPIRV_SCAN_AND: return x & y;
    case RHW_SPIRV_SCAN_OR: return x | y;
    case RHW_SPIRV_SCAN_XOR: return x ^ y;
    default: return rhw_spirv_scan_float(scan, x, y);
    }
}

/// Return what a lane gets that has no other before it.
static inline uint32_t rhw_spirv_scan_none(enum rhw_spirv_scan scan)
{
    switch (scan) {
    case RHW_SPIRV_SCAN_FMUL: return 0x3f800000;
    case RHW_SPIRV_SCAN_FMIN: return 0x7f800000;
    case RHW_SPIRV_SCAN_FMAX: return 0xff800000;
    case RHW_SPIRV_SCAN_IMUL: return 1;
    case RHW_SPIRV_SCAN_MIN_INT: return INT32_MAX;
    case RHW_SPIRV_SCAN_MAX_INT: return 0x80000000;
    case RHW_SPIRV_SCAN_MIN_UINT:
    case RHW_SPIRV_SCAN_AND: return UINT32_MAX;
    default: return 0;
    }
}

/// Return the scan of values, in clusters of `lanes` lanes, from the first lane to the last.
static inline rhw_int rhw_spirv_scan(enum rhw_spirv_scan scan, enum rhw_spirv_reach reach, int lanes,
                                     rhw_int value, rhw_int active)
{
    rhw_int result = rhw_splat_int(0);
    for (int first = 0; first < RHW_LANES; first += lanes) {
        uint32_t all = rhw_spirv_scan_none(scan);
        bool has_any = false;
        for (int lane = first; lane < first + lanes; lane++) {
            if (!active[lane]) {
                continue;
            }
            const uint32_t before = all, own = (uint32_t)value[lane];
            all = has_any ? rhw_spirv_scan_two(scan, all, own) : own;
            has_any = true;
            result[lane] = (int32_t)(reach == RHW_SPIRV_REACH_EXCLUSIVE ? before : all);
        }
        for (int lane = first; reach == RHW_SPIRV_REACH_ALL && lane < first + lanes; lane++) {
            result[lane] = active[lane] ? (int32_t)all : 0;
        }
    }
    return result;
}

/// Return a bit for each active lane whose truth holds.
static inline rhw_int rhw_spirv_ballot(rhw_int truth, rhw_int active)
{
    return rhw_splat_int(rhw_mask_bits(truth & active));
}

/// Return the value in the lane whose number is given, or 0 where that is not active.
static inline rhw_int rhw_spirv_shuffle(rhw_int value, rhw_int from, rhw_int active)
{
    const rhw_int values = value & active;
    rhw_int result = rhw_splat_int(0);
    for (int lane = 0; lane < RHW_LANES; lane++) {
        result[lane] = (uint32_t)from[lane] < RHW_LANES ? values[from[lane]] : 0;
    }
    return result;
}

RHW_QUIET_END

#endif

#endif
