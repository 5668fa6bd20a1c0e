// SPDX-License-Identifier: MIT
// Arithmetic, comparisons and conversions, component by component.
#include "build.h"

#define SIGN_BIT 0x80000000u

static uint32_t emit2(struct shader_builder *builder, enum shader_op op, uint32_t a, uint32_t b)
{
    return shader_emit(builder, op, a, b, 0);
}

static uint32_t not_value(struct shader_builder *builder, uint32_t a)
{
    return shader_emit(builder, SHADER_NOT, a, 0, 0);
}

// Components -----------------------------------------------------------------------------------------

// Operations that are one operation of the form, or that with its operands the other way round, or its opposite.
struct plain_operation {
    uint16_t opcode;
    uint8_t op;
    uint8_t operands;
    bool is_swapped, is_negated;
};

static const struct plain_operation plain_operations[] = {
    {SPIRV_OP_FAdd, SHADER_FADD, 2, false, false},
    {SPIRV_OP_FSub, SHADER_FSUB, 2, false, false},
    {SPIRV_OP_FMul, SHADER_FMUL, 2, false, false},
    {SPIRV_OP_FDiv, SHADER_FDIV, 2, false, false},
    {SPIRV_OP_IAdd, SHADER_IADD, 2, false, false},
    {SPIRV_OP_ISub, SHADER_ISUB, 2, false, false},
    {SPIRV_OP_IMul, SHADER_IMUL, 2, false, false},
    {SPIRV_OP_UDiv, SHADER_UDIV, 2, false, false},
    {SPIRV_OP_SDiv, SHADER_IDIV, 2, false, false},
    {SPIRV_OP_UMod, SHADER_UREM, 2, false, false},
    {SPIRV_OP_SRem, SHADER_IREM, 2, false, false},
    {SPIRV_OP_Not, SHADER_NOT, 1, false, false},
    {SPIRV_OP_BitwiseOr, SHADER_OR, 2, false, false},
    {SPIRV_OP_BitwiseXor, SHADER_XOR, 2, false, false},
    {SPIRV_OP_BitwiseAnd, SHADER_AND, 2, false, false},
    {SPIRV_OP_ShiftLeftLogical, SHADER_SHIFT_LEFT, 2, false, false},
    {SPIRV_OP_ShiftRightLogical, SHADER_SHIFT_RIGHT, 2, false, false},
    {SPIRV_OP_ShiftRightArithmetic, SHADER_SHIFT_RIGHT_SIGNED, 2, false, false},
    {SPIRV_OP_BitReverse, SHADER_BIT_REVERSE, 1, false, false},
    {SPIRV_OP_BitCount, SHADER_BIT_COUNT, 1, false, false},
    {SPIRV_OP_LogicalOr, SHADER_OR, 2, false, false},
    {SPIRV_OP_LogicalAnd, SHADER_AND, 2, false, false},
    {SPIRV_OP_LogicalNot, SHADER_NOT, 1, false, false},
    {SPIRV_OP_LogicalEqual, SHADER_XOR, 2, false, true},
    {SPIRV_OP_LogicalNotEqual, SHADER_XOR, 2, false, false},
    {SPIRV_OP_IEqual, SHADER_IEQUAL, 2, false, false},
    {SPIRV_OP_INotEqual, SHADER_IEQUAL, 2, false, true},
    {SPIRV_OP_ULessThan, SHADER_ULESS, 2, false, false},
    {SPIRV_OP_UGreaterThan, SHADER_ULESS, 2, true, false},
    {SPIRV_OP_ULessThanEqual, SHADER_ULESS, 2, true, true},
    {SPIRV_OP_UGreaterThanEqual, SHADER_ULESS, 2, false, true},
    {SPIRV_OP_SLessThan, SHADER_ILESS, 2, false, false},
    {SPIRV_OP_SGreaterThan, SHADER_ILESS, 2, true, false},
    {SPIRV_OP_SLessThanEqual, SHADER_ILESS, 2, true, true},
    {SPIRV_OP_SGreaterThanEqual, SHADER_ILESS, 2, false, true},
    {SPIRV_OP_FOrdEqual, SHADER_FEQUAL, 2, false, false},
    {SPIRV_OP_FUnordNotEqual, SHADER_FEQUAL, 2, false, true},
    {SPIRV_OP_FOrdLessThan, SHADER_FLESS, 2, false, false},
    {SPIRV_OP_FOrdGreaterThan, SHADER_FLESS, 2, true, false},
    {SPIRV_OP_FOrdLessThanEqual, SHADER_FLESS_EQUAL, 2, false, false},
    {SPIRV_OP_FOrdGreaterThanEqual, SHADER_FLESS_EQUAL, 2, true, false},
    {SPIRV_OP_FUnordLessThan, SHADER_FLESS_EQUAL, 2, true, true},
    {SPIRV_OP_FUnordGreaterThan, SHADER_FLESS_EQUAL, 2, false, true},
    {SPIRV_OP_FUnordLessThanEqual, SHADER_FLESS, 2, true, true},
    {SPIRV_OP_FUnordGreaterThanEqual, SHADER_FLESS, 2, false, true},
    {SPIRV_OP_ConvertSToF, SHADER_FLOAT_FROM_INT, 1, false, false},
    {SPIRV_OP_ConvertUToF, SHADER_FLOAT_FROM_UINT, 1, false, false},
    {SPIRV_OP_ConvertFToS, SHADER_INT_FROM_FLOAT, 1, false, false},
    {SPIRV_OP_ConvertFToU, SHADER_UINT_FROM_FLOAT, 1, false, false},
};

static uint32_t build_plain(struct shader_builder *builder, const struct plain_operation *plain, uint32_t a,
                            uint32_t b)
{
    const uint32_t result = plain->is_swapped ? emit2(builder, (enum shader_op)plain->op, b, a)
                                              : emit2(builder, (enum shader_op)plain->op, a, b);
    return plain->is_negated ? not_value(builder, result) : result;
}

// x − y · round(x / y)
static uint32_t float_rest(struct shader_builder *builder, uint32_t x, uint32_t y, enum shader_op round)
{
    const uint32_t whole = emit2(builder, round, emit2(builder, SHADER_FDIV, x, y), 0);
    return emit2(builder, SHADER_FSUB, x, emit2(builder, SHADER_FMUL, y, whole));
}

// The rest with the sign of y.
static uint32_t signed_modulo(struct shader_builder *builder, uint32_t x, uint32_t y)
{
    const uint32_t zero = shader_number(builder, 0);
    const uint32_t rest = emit2(builder, SHADER_IREM, x, y);
    const uint32_t signs_differ = emit2(builder, SHADER_ILESS, emit2(builder, SHADER_XOR, rest, y), zero);
    const uint32_t is_zero = emit2(builder, SHADER_IEQUAL, rest, zero);
    const uint32_t moves = emit2(builder, SHADER_AND, signs_differ, not_value(builder, is_zero));
    return emit2(builder, SHADER_IADD, rest, emit2(builder, SHADER_AND, moves, y));
}

static uint32_t magnitude(struct shader_builder *builder, uint32_t x)
{
    return emit2(builder, SHADER_AND, x, shader_number(builder, ~SIGN_BIT));
}

// The bits [offset, offset + count) as a mask; count 0 gives 0, and 32 all bits.
static uint32_t field_mask(struct shader_builder *builder, uint32_t offset, uint32_t count)
{
    const uint32_t all = shader_number(builder, UINT32_MAX), whole = shader_number(builder, 32);
    const uint32_t ones = emit2(builder, SHADER_SHIFT_RIGHT, all, emit2(builder, SHADER_ISUB, whole, count));
    const uint32_t is_none = emit2(builder, SHADER_IEQUAL, count, shader_number(builder, 0));
    const uint32_t mask = shader_emit(builder, SHADER_SELECT, is_none, shader_number(builder, 0), ones);
    return emit2(builder, SHADER_SHIFT_LEFT, mask, offset);
}

static uint32_t insert_field(struct shader_builder *builder, uint32_t base, uint32_t insert, uint32_t offset,
                             uint32_t count)
{
    const uint32_t mask = field_mask(builder, offset, count);
    const uint32_t moved = emit2(builder, SHADER_SHIFT_LEFT, insert, offset);
    return emit2(builder, SHADER_OR, emit2(builder, SHADER_AND, base, not_value(builder, mask)),
                 emit2(builder, SHADER_AND, moved, mask));
}

static uint32_t extract_field(struct shader_builder *builder, uint32_t base, uint32_t offset, uint32_t count,
                              bool is_signed)
{
    const uint32_t whole = shader_number(builder, 32);
    const uint32_t above = emit2(builder, SHADER_ISUB, emit2(builder, SHADER_ISUB, whole, offset), count);
    const uint32_t moved = emit2(builder, SHADER_SHIFT_LEFT, base, above);
    const uint32_t field = emit2(builder, is_signed ? SHADER_SHIFT_RIGHT_SIGNED : SHADER_SHIFT_RIGHT, moved,
                                 emit2(builder, SHADER_ISUB, whole, count));
    const uint32_t is_none = emit2(builder, SHADER_IEQUAL, count, shader_number(builder, 0));
    return shader_emit(builder, SHADER_SELECT, is_none, shader_number(builder, 0), field);
}

// Operations that are several of the form. Return false where the instruction is none of them.
static bool build_composed(struct shader_builder *builder, uint32_t opcode, const uint32_t v[4],
                           uint32_t *result)
{
    const uint32_t zero = shader_number(builder, 0);
    uint32_t less, greater;
    switch (opcode) {
    case SPIRV_OP_SNegate: *result = emit2(builder, SHADER_ISUB, zero, v[0]); return true;
    case SPIRV_OP_FNegate:
        *result = emit2(builder, SHADER_XOR, v[0], shader_number(builder, SIGN_BIT));
        return true;
    case SPIRV_OP_FRem: *result = float_rest(builder, v[0], v[1], SHADER_TRUNC); return true;
    case SPIRV_OP_FMod: *result = float_rest(builder, v[0], v[1], SHADER_FLOOR); return true;
    case SPIRV_OP_SMod: *result = signed_modulo(builder, v[0], v[1]); return true;
    case SPIRV_OP_FOrdNotEqual:
    case SPIRV_OP_FUnordEqual:
        less = emit2(builder, SHADER_FLESS, v[0], v[1]);
        greater = emit2(builder, SHADER_FLESS, v[1], v[0]);
        *result = emit2(builder, SHADER_OR, less, greater);
        *result = opcode == SPIRV_OP_FUnordEqual ? not_value(builder, *result) : *result;
        return true;
    case SPIRV_OP_IsNan: *result = not_value(builder, emit2(builder, SHADER_FEQUAL, v[0], v[0])); return true;
    case SPIRV_OP_IsInf:
        *result = emit2(builder, SHADER_IEQUAL, magnitude(builder, v[0]), shader_number(builder, 0x7f800000));
        return true;
    case SPIRV_OP_Select: *result = shader_emit(builder, SHADER_SELECT, v[0], v[1], v[2]); return true;
    case SPIRV_OP_QuantizeToF16: {
        const uint32_t halves = emit2(builder, SHADER_PACK_HALVES, v[0], zero);
        const uint32_t half = emit2(builder, SHADER_UNPACK_LOW_HALF, halves, 0);
        const uint32_t least = shader_number(builder, SHADER_LEAST_HALF);
        const uint32_t is_small = emit2(builder, SHADER_ILESS, magnitude(builder, v[0]), least);
        const uint32_t sign = emit2(builder, SHADER_AND, v[0], shader_number(builder, SIGN_BIT));
        *result = shader_emit(builder, SHADER_SELECT, is_small, sign, half);
        return true;
    }
    case SPIRV_OP_BitFieldInsert: *result = insert_field(builder, v[0], v[1], v[2], v[3]); return true;
    case SPIRV_OP_BitFieldSExtract: *result = extract_field(builder, v[0], v[1], v[2], true); return true;
    case SPIRV_OP_BitFieldUExtract: *result = extract_field(builder, v[0], v[1], v[2], false); return true;
    default: return false;
    }
}

static const struct plain_operation *find_plain(uint32_t opcode)
{
    for (size_t i = 0; i < sizeof plain_operations / sizeof *plain_operations; i++) {
        if (plain_operations[i].opcode == opcode) {
            return &plain_operations[i];
        }
    }
    return NULL;
}

uint32_t shader_component(struct shader_builder *builder, uint32_t operand, uint32_t i)
{
    const uint32_t id = shader_operand(builder, operand);
    const uint32_t *const scalars = shader_scalars(builder, id);
    const uint32_t count = shader_type_of_value(builder, id)->scalars;
    if (count == 1) {
        return scalars[0];
    }
    if (i >= count) {
        shader_build_refuse(builder, "id %u has too few components", (unsigned)id);
    }
    return scalars[i];
}

// Numbers of 8 and 16 bits are loaded, stored, converted and chosen alone.
static void refuse_narrow(const struct shader_builder *builder, const struct shader_type *type)
{
    const struct shader_type *const scalar = shader_scalar_type(type);
    if (scalar && scalar->kind != SHADER_BOOL && scalar->bits < 32) {
        shader_build_refuse(builder, "arithmetic on numbers of %d bits is not supported", scalar->bits);
    }
}

static bool build_components(struct shader_builder *builder, uint32_t opcode)
{
    const struct plain_operation *const plain = find_plain(opcode);
    const uint32_t operands = shader_word_count(builder) - 3;
    if (operands == 0 || operands > 4 || (plain && operands != plain->operands)) {
        return false;
    }
    const struct shader_type *const type = shader_result_type(builder);
    uint32_t *const result = shader_new_scalars(builder, type);
    if (opcode != SPIRV_OP_Select) {
        refuse_narrow(builder, type);
        refuse_narrow(builder, shader_type_of_value(builder, shader_operand(builder, 3)));
    }
    for (uint32_t i = 0; i < type->scalars; i++) {
        uint32_t v[4] = {0, 0, 0, 0};
        if (plain) {
            v[0] = shader_component(builder, 3, i);
            v[1] = operands > 1 ? shader_component(builder, 4, i) : 0;
            result[i] = build_plain(builder, plain, v[0], v[1]);
            continue;
        }
        for (uint32_t o = 0; o < operands; o++) {
            v[o] = shader_component(builder, 3 + o, i);
        }
        if (!build_composed(builder, opcode, v, &result[i])) {
            return false;
        }
    }
    shader_define(builder, result);
    return true;
}

// Truths, and results of two words -------------------------------------------------------------------

static void build_any_all(struct shader_builder *builder, enum shader_op op)
{
    const uint32_t count = shader_type_of_value(builder, shader_operand(builder, 3))->scalars;
    uint32_t result = shader_component(builder, 3, 0);
    for (uint32_t i = 1; i < count; i++) {
        result = emit2(builder, op, result, shader_component(builder, 3, i));
    }
    shader_define_scalar(builder, result);
}

// Two results in a structure: sum and carry, difference and borrow, or the lower and the upper half of a product.
static void build_extended(struct shader_builder *builder, uint32_t opcode)
{
    const struct shader_type *const type = shader_result_type(builder);
    const uint32_t count = type->scalars / 2;
    if (type->kind != SHADER_STRUCT || type->count != 2 || type->members[0].type != type->members[1].type) {
        shader_build_refuse(builder, "the result is a structure of two members of one type");
    }
    shader_check_types(builder, type->members[0].type, "iii", 3);
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t a = shader_component(builder, 3, i), b = shader_component(builder, 4, i);
        const uint32_t one = shader_number(builder, 1);
        uint32_t low, high;
        if (opcode == SPIRV_OP_IAddCarry) {
            low = emit2(builder, SHADER_IADD, a, b);
            high = emit2(builder, SHADER_AND, emit2(builder, SHADER_ULESS, low, a), one);
        } else if (opcode == SPIRV_OP_ISubBorrow) {
            low = emit2(builder, SHADER_ISUB, a, b);
            high = emit2(builder, SHADER_AND, emit2(builder, SHADER_ULESS, a, b), one);
        } else {
            low = emit2(builder, SHADER_IMUL, a, b);
            high =
                emit2(builder, opcode == SPIRV_OP_UMulExtended ? SHADER_UMUL_HIGH : SHADER_IMUL_HIGH, a, b);
        }
        result[i] = low;
        result[count + i] = high;
    }
    shader_define(builder, result);
}

bool shader_build_arithmetic(struct shader_builder *builder, uint32_t opcode)
{
    shader_check_operands(builder, opcode);
    switch (opcode) {
    case SPIRV_OP_Any: build_any_all(builder, SHADER_OR); return true;
    case SPIRV_OP_All: build_any_all(builder, SHADER_AND); return true;
    case SPIRV_OP_IAddCarry:
    case SPIRV_OP_ISubBorrow:
    case SPIRV_OP_UMulExtended:
    case SPIRV_OP_SMulExtended: build_extended(builder, opcode); return true;
    default: break;
    }
    if (shader_build_matrix(builder, opcode)) {
        return true;
    }
    const bool is_component =
        find_plain(opcode) != NULL || (opcode >= SPIRV_OP_QuantizeToF16 && opcode <= SPIRV_OP_BitCount);
    return is_component && build_components(builder, opcode);
}
