// SPDX-License-Identifier: MIT
// The library's kernel templates and the maths header, compiled once per instruction set, in the shape tests
// want them: one function per call, no pipeline around.
#ifndef TEST_ISA_TEMPLATES_H
#define TEST_ISA_TEMPLATES_H

#include <rhw/isa.h>
#include <rhw/shader.h>

struct rhw_blend_state;
struct rhw_format_info;

enum isa_function {
    ISA_EXP2,
    ISA_EXP,
    ISA_LOG2,
    ISA_LOG,
    ISA_SIN,
    ISA_COS,
    ISA_TAN,
    ISA_ASIN,
    ISA_ACOS,
    ISA_ATAN,
    ISA_SINH,
    ISA_COSH,
    ISA_TANH,
    ISA_ASINH,
    ISA_ACOSH,
    ISA_ATANH,
    ISA_SQRT,
    ISA_RSQRT,
    ISA_FLOOR,
    ISA_CEIL,
    ISA_TRUNC,
    ISA_ROUND,
    ISA_FRACT,
    ISA_SIGN,
    ISA_SATURATE,
    ISA_TO_INT, ///< the integer's bits
    ISA_POW,
    ISA_ATAN2,
    ISA_MIN,
    ISA_MAX,
    ISA_LESS,
    ISA_LESS_EQUAL,
    ISA_EQUAL, ///< two arguments
    ISA_FUNCTION_COUNT
};

struct isa_templates {
    /// Blends 8 fragments; see blend_group.
    void (*blend)(const struct rhw_blend_state *state, const rhw_float color[4], const rhw_int *mask,
                  unsigned char *texels);
    /// Decodes 8 texels of a row; see decode_texels.
    void (*decode)(const struct rhw_format_info *format, const unsigned char *texels, rhw_float value[4]);
    /// result[i] = function(a[i], b[i]) of `count` numbers, a multiple of 8.
    void (*apply)(enum isa_function function, const float *a, const float *b, float *result, int count);
};

RHW_ISA_DECLARE(const struct isa_templates, isa_templates);

/// NULL where this build or this CPU lacks `isa`.
const struct isa_templates *isa_templates_for(enum rhw_isa isa);

#endif
