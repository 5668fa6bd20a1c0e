// SPDX-License-Identifier: MIT
// Constants of the sampler as whole vectors: an instruction then takes one from memory as an operand, where gcc would
// spend one instruction to load a number into all lanes, or three if it is an integer.
#ifndef RHW_SAMPLE_CONSTANTS_H
#define RHW_SAMPLE_CONSTANTS_H

#include "base/simd.h"

struct sample_constants {
    f32x8 largest;                        // largest finite float
    i32x8 fraction_bits, one_bits;        // bits of a float's fraction; bits of 1.0f
    f32x8 one, one_16;                    // 1; 1 in 16.16
    f32x8 curve0, curve1, curve2, curve3; // see half_log2
    f32x8 log_scale, log_offset;
    f32x8 half_texel;              // half a texel, 16.16
    f32x8 fixed_scale, fixed_rest; // see fixed_to_float
    i32x8 lower_half, upper_half;  // halves of a lane
    i32x8 not_in_row;              // see filter_interior
};

// This is a macro because the result of a function is no constant.
#define SPLAT(v)               \
    {                          \
        v, v, v, v, v, v, v, v \
    }
static const struct sample_constants sample_constant_values = {
    .largest = SPLAT(3.4028235e38f),
    .fraction_bits = SPLAT(0x7fffff),
    .one_bits = SPLAT(0x3f800000),
    .one = SPLAT(1.0f),
    .one_16 = SPLAT(65536.0f),
    .curve0 = SPLAT(-0.220960796f),
    .curve1 = SPLAT(0.133602321f),
    .curve2 = SPLAT(-0.074232161f),
    .curve3 = SPLAT(0.02258187345f),
    .log_scale = SPLAT(0x1p-24f),
    .log_offset = SPLAT(-63.5f),
    .half_texel = SPLAT(32768.0f),
    .fixed_scale = SPLAT(0x1p-15f),
    .fixed_rest = SPLAT(1.19676784e-07f),
    .lower_half = SPLAT(0xffff),
    .upper_half = SPLAT(-0x10000),
    .not_in_row = SPLAT(~0x70000),
};
#undef SPLAT

RHW_INLINE const struct sample_constants *sample_constants(void)
{
    const struct sample_constants *constants = &sample_constant_values;
    __asm__("" : "+r"(constants)); // keeps the compiler from knowing the numbers again
    return constants;
}

#endif
