// SPDX-License-Identifier: MIT
// What types the operands of arithmetic have. Whoever translates an instruction relies on them: a bool is −1 or 0 and
// comes from nothing but a comparison, and every operand has the components that are asked of it.
#include "build.h"

// A signature has a letter for the result and one for each operand: f is floats, i integers, b bools, n floats or
// integers, and t a value of the type of the result. Small letters ask for one number of components in
// all of them, capital letters for a scalar. c is a bool for all components or one for each.
static const char *const signatures[] = {
    [SPIRV_OP_ConvertFToU] = "if",
    [SPIRV_OP_ConvertFToS] = "if",
    [SPIRV_OP_ConvertSToF] = "fi",
    [SPIRV_OP_ConvertUToF] = "fi",
    [SPIRV_OP_UConvert] = "ii",
    [SPIRV_OP_SConvert] = "ii",
    [SPIRV_OP_FConvert] = "ff",
    [SPIRV_OP_QuantizeToF16] = "ff",
    [SPIRV_OP_Bitcast] = "nn",
    [SPIRV_OP_SNegate] = "ii",
    [SPIRV_OP_FNegate] = "ff",
    [SPIRV_OP_IAdd] = "iii",
    [SPIRV_OP_FAdd] = "fff",
    [SPIRV_OP_ISub] = "iii",
    [SPIRV_OP_FSub] = "fff",
    [SPIRV_OP_IMul] = "iii",
    [SPIRV_OP_FMul] = "fff",
    [SPIRV_OP_UDiv] = "iii",
    [SPIRV_OP_SDiv] = "iii",
    [SPIRV_OP_FDiv] = "fff",
    [SPIRV_OP_UMod] = "iii",
    [SPIRV_OP_SRem] = "iii",
    [SPIRV_OP_SMod] = "iii",
    [SPIRV_OP_FRem] = "fff",
    [SPIRV_OP_FMod] = "fff",
    [SPIRV_OP_VectorTimesScalar] = "ffF",
    [SPIRV_OP_Dot] = "Fff",
    [SPIRV_OP_Any] = "Bb",
    [SPIRV_OP_All] = "Bb",
    [SPIRV_OP_IsNan] = "bf",
    [SPIRV_OP_IsInf] = "bf",
    [SPIRV_OP_LogicalEqual] = "bbb",
    [SPIRV_OP_LogicalNotEqual] = "bbb",
    [SPIRV_OP_LogicalOr] = "bbb",
    [SPIRV_OP_LogicalAnd] = "bbb",
    [SPIRV_OP_LogicalNot] = "bb",
    [SPIRV_OP_Select] = "tctt",
    [SPIRV_OP_IEqual] = "bii",
    [SPIRV_OP_INotEqual] = "bii",
    [SPIRV_OP_UGreaterThan] = "bii",
    [SPIRV_OP_SGreaterThan] = "bii",
    [SPIRV_OP_UGreaterThanEqual] = "bii",
    [SPIRV_OP_SGreaterThanEqual] = "bii",
    [SPIRV_OP_ULessThan] = "bii",
    [SPIRV_OP_SLessThan] = "bii",
    [SPIRV_OP_ULessThanEqual] = "bii",
    [SPIRV_OP_SLessThanEqual] = "bii",
    [SPIRV_OP_FOrdEqual] = "bff",
    [SPIRV_OP_FUnordEqual] = "bff",
    [SPIRV_OP_FOrdNotEqual] = "bff",
    [SPIRV_OP_FUnordNotEqual] = "bff",
    [SPIRV_OP_FOrdLessThan] = "bff",
    [SPIRV_OP_FUnordLessThan] = "bff",
    [SPIRV_OP_FOrdGreaterThan] = "bff",
    [SPIRV_OP_FUnordGreaterThan] = "bff",
    [SPIRV_OP_FOrdLessThanEqual] = "bff",
    [SPIRV_OP_FUnordLessThanEqual] = "bff",
    [SPIRV_OP_FOrdGreaterThanEqual] = "bff",
    [SPIRV_OP_FUnordGreaterThanEqual] = "bff",
    [SPIRV_OP_ShiftRightLogical] = "iii",
    [SPIRV_OP_ShiftRightArithmetic] = "iii",
    [SPIRV_OP_ShiftLeftLogical] = "iii",
    [SPIRV_OP_BitwiseOr] = "iii",
    [SPIRV_OP_BitwiseXor] = "iii",
    [SPIRV_OP_BitwiseAnd] = "iii",
    [SPIRV_OP_Not] = "ii",
    [SPIRV_OP_BitFieldInsert] = "iiiII",
    [SPIRV_OP_BitFieldSExtract] = "iiII",
    [SPIRV_OP_BitFieldUExtract] = "iiII",
    [SPIRV_OP_BitReverse] = "ii",
    [SPIRV_OP_BitCount] = "ii",
    [SPIRV_OP_DPdx] = "ff",
    [SPIRV_OP_DPdy] = "ff",
    [SPIRV_OP_Fwidth] = "ff",
    [SPIRV_OP_DPdxFine] = "ff",
    [SPIRV_OP_DPdyFine] = "ff",
    [SPIRV_OP_FwidthFine] = "ff",
    [SPIRV_OP_DPdxCoarse] = "ff",
    [SPIRV_OP_DPdyCoarse] = "ff",
    [SPIRV_OP_FwidthCoarse] = "ff",
};

// Return the letter of a type: of what its components are.
static char letter_of(const struct shader_type *type)
{
    const struct shader_type *const scalar = type->kind == SHADER_VECTOR ? type->element : type;
    switch (scalar->kind) {
    case SHADER_FLOAT: return 'f';
    case SHADER_INT: return 'i';
    case SHADER_BOOL: return 'b';
    default: return '?';
    }
}

static bool takes(char letter, char given)
{
    switch (letter) {
    case 'n': return given == 'f' || given == 'i';
    case 'c': return given == 'b';
    default: return letter == given;
    }
}

// Return true if a type is what a letter asks for. `*count` is the number of components that all have, or 0 before the
// first is known.
static bool fits(const struct shader_type *type, const struct shader_type *result, char letter,
                 uint32_t *count)
{
    const bool is_capital = letter >= 'A' && letter <= 'Z';
    if (letter == 't') {
        return type == result && type->scalars != 0;
    }
    if (!takes(is_capital ? (char)(letter - 'A' + 'a') : letter, letter_of(type))) {
        return false;
    }
    if (is_capital || (letter == 'c' && type->scalars == 1)) {
        return type->scalars == 1;
    }
    *count = *count == 0 ? type->scalars : *count;
    return type->scalars == *count;
}

void shader_check_types(struct shader_builder *builder, const struct shader_type *result, const char *letters,
                        uint32_t first)
{
    uint32_t count = letters[0] == 't' && letter_of(result) != '?' ? result->scalars : 0;
    if (!fits(result, result, letters[0], &count)) {
        shader_build_refuse(builder, "the instruction has no result of the type of id %u",
                            (unsigned)result->id);
    }
    for (uint32_t i = 0; letters[i + 1] != '\0'; i++) {
        const uint32_t id = shader_operand(builder, first + i);
        if (!fits(shader_type_of_value(builder, id), result, letters[i + 1], &count)) {
            shader_build_refuse(builder, "operand %u, id %u, is of a type that does not fit", (unsigned)i,
                                (unsigned)id);
        }
    }
}

void shader_check_signature(struct shader_builder *builder, const char *letters, uint32_t first)
{
    shader_check_types(builder, shader_result_type(builder), letters, first);
}

// Return true if two types are made of the same scalars in the same order.
static bool is_same_shape(const struct shader_type *a, const struct shader_type *b)
{
    if (a == b) {
        return true;
    }
    if (a->kind != b->kind || a->count != b->count || a->scalars != b->scalars || a->scalars == 0) {
        return false;
    }
    if (a->kind == SHADER_ARRAY) {
        return is_same_shape(a->element, b->element);
    }
    for (uint32_t i = 0; i < a->count; i++) {
        if (a->kind != SHADER_STRUCT || !is_same_shape(a->members[i].type, b->members[i].type)) {
            return false;
        }
    }
    return a->kind == SHADER_STRUCT;
}

void shader_check_operands(struct shader_builder *builder, uint32_t opcode)
{
    if (opcode == SPIRV_OP_CopyLogical &&
        !is_same_shape(shader_type_of_value(builder, shader_operand(builder, 3)),
                       shader_result_type(builder))) {
        shader_build_refuse(builder, "the operand is not made of what the result is made of");
    }
    if (opcode < sizeof signatures / sizeof *signatures && signatures[opcode]) {
        shader_check_signature(builder, signatures[opcode], 3);
    }
}
