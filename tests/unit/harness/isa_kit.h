// SPDX-License-Identifier: MIT
// Every function of the shader kit beside its twin for one at a time, in one shape: a table for each instruction set.
#ifndef TEST_ISA_KIT_H
#define TEST_ISA_KIT_H

#include <rhw/isa.h>
#include <rhw/shader.h>

enum { KIT_INPUTS = 24, KIT_RESULTS = 12 };

/// A function that reads the first few of its inputs and writes the first few of its results. Integers and masks pass
/// as the bits of floats.
struct kit_function {
    const char *name;
    void (*lanes)(const rhw_float input[KIT_INPUTS], rhw_float result[KIT_RESULTS]);
    void (*one)(const float input[KIT_INPUTS], float result[KIT_RESULTS]);
};

struct kit_table {
    int count;
    const struct kit_function *functions;
};

/// The parts of the kit, each of which has a table.
enum kit_part {
    KIT_LANES, // shader_vector.h, shader_linear.h and shader_memory.h
    KIT_MATH,  // shader_math.h and shader_hyperbolic.h
    KIT_BITS,  // shader_integer.h and shader_pack.h
    KIT_DUAL,  // shader_dual.h
    KIT_PARTS
};

RHW_ISA_DECLARE(const struct kit_table, kit_lanes_table);
RHW_ISA_DECLARE(const struct kit_table, kit_math_table);
RHW_ISA_DECLARE(const struct kit_table, kit_bits_table);
RHW_ISA_DECLARE(const struct kit_table, kit_dual_table);

/// Return the functions of a part. Return NULL where this build or this CPU lacks `isa`.
const struct kit_table *kit_table_for(enum kit_part part, enum rhw_isa isa);

#endif
