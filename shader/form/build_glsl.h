// SPDX-License-Identifier: MIT
// The numbers of the instructions of GLSL.std.450 (SPIR-V Extended Instructions for GLSL), and what the files that
// translate them share.
#ifndef SHADER_BUILD_GLSL_H
#define SHADER_BUILD_GLSL_H

#include "build.h"

#define SIGN_BIT 0x80000000u

enum glsl_instruction {
    GLSL_ROUND = 1,
    GLSL_ROUND_EVEN,
    GLSL_TRUNC,
    GLSL_FABS,
    GLSL_SABS,
    GLSL_FSIGN,
    GLSL_SSIGN,
    GLSL_FLOOR,
    GLSL_CEIL,
    GLSL_FRACT,
    GLSL_RADIANS,
    GLSL_DEGREES,
    GLSL_SIN,
    GLSL_COS,
    GLSL_TAN,
    GLSL_ASIN,
    GLSL_ACOS,
    GLSL_ATAN,
    GLSL_SINH,
    GLSL_COSH,
    GLSL_TANH,
    GLSL_ASINH,
    GLSL_ACOSH,
    GLSL_ATANH,
    GLSL_ATAN2,
    GLSL_POW,
    GLSL_EXP,
    GLSL_LOG,
    GLSL_EXP2,
    GLSL_LOG2,
    GLSL_SQRT,
    GLSL_INVERSE_SQRT,
    GLSL_DETERMINANT,
    GLSL_MATRIX_INVERSE,
    GLSL_MODF,
    GLSL_MODF_STRUCT,
    GLSL_FMIN,
    GLSL_UMIN,
    GLSL_SMIN,
    GLSL_FMAX,
    GLSL_UMAX,
    GLSL_SMAX,
    GLSL_FCLAMP,
    GLSL_UCLAMP,
    GLSL_SCLAMP,
    GLSL_FMIX,
    GLSL_STEP = 48,
    GLSL_SMOOTH_STEP,
    GLSL_FMA,
    GLSL_FREXP,
    GLSL_FREXP_STRUCT,
    GLSL_LDEXP,
    GLSL_PACK_SNORM4X8,
    GLSL_PACK_UNORM4X8,
    GLSL_PACK_SNORM2X16,
    GLSL_PACK_UNORM2X16,
    GLSL_PACK_HALF2X16,
    GLSL_UNPACK_SNORM2X16 = 60,
    GLSL_UNPACK_UNORM2X16,
    GLSL_UNPACK_HALF2X16,
    GLSL_UNPACK_SNORM4X8,
    GLSL_UNPACK_UNORM4X8,
    GLSL_LENGTH = 66,
    GLSL_DISTANCE,
    GLSL_CROSS,
    GLSL_NORMALIZE,
    GLSL_FACE_FORWARD,
    GLSL_REFLECT,
    GLSL_REFRACT,
    GLSL_FIND_I_LSB,
    GLSL_FIND_S_MSB,
    GLSL_FIND_U_MSB,
    GLSL_NMIN = 79,
    GLSL_NMAX,
    GLSL_NCLAMP
};

// Operands of the instruction: component i of operand o, counted behind the number of the instruction.
static inline uint32_t operand(struct shader_builder *builder, uint32_t o, uint32_t i)
{
    const uint32_t id = shader_operand(builder, 5 + o);
    const uint32_t count = shader_type_of_value(builder, id)->scalars;
    if (count != 1 && i >= count) {
        shader_build_refuse(builder, "id %u has too few components", (unsigned)id);
    }
    return shader_scalars(builder, id)[count == 1 ? 0 : i];
}

static inline uint32_t count_of(struct shader_builder *builder, uint32_t o)
{
    return shader_type_of_value(builder, shader_operand(builder, 5 + o))->scalars;
}

static inline uint32_t emit1(struct shader_builder *b, enum shader_op op, uint32_t x)
{
    return shader_emit(b, op, x, 0, 0);
}

static inline uint32_t emit2(struct shader_builder *b, enum shader_op op, uint32_t x, uint32_t y)
{
    return shader_emit(b, op, x, y, 0);
}

static inline uint32_t select(struct shader_builder *b, uint32_t condition, uint32_t x, uint32_t y)
{
    return shader_emit(b, SHADER_SELECT, condition, x, y);
}

static inline uint32_t number(struct shader_builder *b, float value)
{
    return shader_number_float(b, value);
}

// build_geometry.c, build_packing.c. Return false where the file does not have the instruction.
bool shader_build_geometry(struct shader_builder *b, uint32_t instruction);
bool shader_build_packing(struct shader_builder *b, uint32_t instruction);

#endif
