// SPDX-License-Identifier: MIT
// Constants, with the values that specialization gives them.
#include "module.h"

#include <string.h>

// Return true if a constant may be of a type without scalars: an undefined pointer or resource, a null pointer, or a
// structure without members.
static bool may_be_empty(uint32_t opcode, const struct shader_type *type)
{
    const bool is_object = type->kind != SHADER_VOID && type->kind != SHADER_FUNCTION;
    return (opcode == SPIRV_OP_Undef && is_object) ||
           (opcode == SPIRV_OP_ConstantNull && type->kind == SHADER_POINTER) || type->is_empty;
}

static uint32_t *new_constant(struct shader_module *module, uint32_t word, const struct shader_type *type)
{
    struct shader_constant *const constant = shader_take(module->memory, 1, sizeof *constant);
    if (type->scalars == 0 && !may_be_empty(module->words[word] & 0xffff, type)) {
        shader_refuse(module, word, "there are no constants of the type of id %u", (unsigned)type->id);
    }
    const uint32_t room = type->scalars == 0 ? 1 : type->scalars;
    uint32_t *const scalars = shader_take(module->memory, room, sizeof *scalars);
    constant->type = type;
    constant->scalars = scalars;
    module->ids[module->words[word + 2]].data.as_constant = constant;
    return scalars;
}

static void read_number(struct shader_module *module, uint32_t word, const struct shader_type *type,
                        uint32_t *scalar)
{
    if ((type->kind != SHADER_INT && type->kind != SHADER_FLOAT) || (module->words[word] >> 16) != 4) {
        shader_refuse(module, word, "a constant is a number of one word");
    }
    *scalar = shader_extend(type, module->words[word + 3]);
}

// Return whether a constant of one type may be a part of another. Naga (wgpu) gives vectors of unsigned integers parts
// that are signed, which drivers take.
static bool is_part(const struct shader_type *type, const struct shader_type *expected)
{
    return type == expected ||
           (type->kind == SHADER_INT && expected->kind == SHADER_INT && type->bits == expected->bits);
}

// Put the scalars of the parts of a composite behind one another.
static void read_composite(struct shader_module *module, uint32_t word, const struct shader_type *type,
                           uint32_t *scalars)
{
    const uint32_t count = (module->words[word] >> 16) - 3;
    const bool is_struct = type->kind == SHADER_STRUCT;
    const bool is_composite =
        is_struct || type->kind == SHADER_VECTOR || type->kind == SHADER_MATRIX || type->kind == SHADER_ARRAY;
    if (!is_composite || count != type->count) {
        shader_refuse(module, word, "a constant of id %u has %u parts", (unsigned)type->id,
                      is_composite ? (unsigned)type->count : 0);
    }
    for (uint32_t i = 0; i < count; i++) {
        const struct shader_constant *const part =
            shader_constant_of_id(module, word, module->words[word + 3 + i]);
        if (!is_part(part->type, is_struct ? type->members[i].type : type->element)) {
            shader_refuse(module, word, "part %u is of another type", (unsigned)i);
        }
        memcpy(scalars, part->scalars, part->type->scalars * sizeof *scalars);
        scalars += part->type->scalars;
    }
}

// Specialization -------------------------------------------------------------------------------------

static const struct shader_specialization *find_value(const struct shader_module *module, uint32_t id,
                                                      const struct shader_specialization *values,
                                                      size_t count)
{
    const struct shader_decoration *const decoration = shader_find_decoration(module, id, -1, SPIRV_SPEC_ID);
    for (size_t i = 0; decoration && i < count; i++) {
        if (values[i].constant_id == decoration->value) {
            return &values[i];
        }
    }
    return NULL;
}

// The operands of an OpSpecConstantOp.
struct operation {
    const struct shader_module *module;
    uint32_t word;
    const struct shader_type *type; // what the result is
    const uint32_t *operands;       // behind the number of the operation
    uint32_t count;
};

static const struct shader_constant *operand(const struct operation *operation, uint32_t index)
{
    if (index >= operation->count || operation->operands[index] >= operation->module->bound) {
        shader_refuse(operation->module, operation->word, "operand %u is missing", (unsigned)index);
    }
    return shader_constant_of_id(operation->module, operation->word, operation->operands[index]);
}

static int32_t divide(int32_t a, int32_t b)
{
    return b == 0 ? a : b == -1 ? (int32_t)(0 - (uint32_t)a) : a / b;
}

// Return what a half has of a number. What would be no normal half is 0.
static uint32_t quantize(uint32_t bits)
{
    const bool is_small = (bits & 0x7fffffff) < SHADER_LEAST_HALF;
    return is_small ? bits & 0x80000000 : shader_float_from_half(shader_half_from_float(bits));
}

// Return a scalar of the result. Divisions by 0 give what they give in shaders (shader_integer.h).
static bool evaluate(uint32_t opcode, const uint32_t v[3], uint32_t *result)
{
    const int32_t a = (int32_t)v[0], b = (int32_t)v[1];
    switch (opcode) {
    case SPIRV_OP_FConvert: *result = v[0]; return true;
    case SPIRV_OP_QuantizeToF16: *result = quantize(v[0]); return true;
    case SPIRV_OP_SNegate: *result = 0 - v[0]; return true;
    case SPIRV_OP_Not: *result = ~v[0]; return true;
    case SPIRV_OP_IAdd: *result = v[0] + v[1]; return true;
    case SPIRV_OP_ISub: *result = v[0] - v[1]; return true;
    case SPIRV_OP_IMul: *result = v[0] * v[1]; return true;
    case SPIRV_OP_UDiv: *result = v[1] ? v[0] / v[1] : v[0]; return true;
    case SPIRV_OP_SDiv: *result = (uint32_t)divide(a, b); return true;
    case SPIRV_OP_UMod: *result = v[1] ? v[0] % v[1] : 0; return true;
    case SPIRV_OP_SRem: *result = b == 0 ? 0 : v[0] - v[1] * (uint32_t)divide(a, b); return true;
    case SPIRV_OP_SMod:
        *result = b == 0 ? 0 : v[0] - v[1] * (uint32_t)divide(a, b);
        *result += *result != 0 && (int32_t)(*result ^ v[1]) < 0 ? v[1] : 0;
        return true;
    case SPIRV_OP_ShiftRightLogical: *result = v[0] >> (v[1] & 31); return true;
    case SPIRV_OP_ShiftRightArithmetic: *result = (uint32_t)(a >> (v[1] & 31)); return true;
    case SPIRV_OP_ShiftLeftLogical: *result = v[0] << (v[1] & 31); return true;
    case SPIRV_OP_BitwiseOr:
    case SPIRV_OP_LogicalOr: *result = v[0] | v[1]; return true;
    case SPIRV_OP_BitwiseXor: *result = v[0] ^ v[1]; return true;
    case SPIRV_OP_BitwiseAnd:
    case SPIRV_OP_LogicalAnd: *result = v[0] & v[1]; return true;
    case SPIRV_OP_LogicalNot: *result = ~v[0]; return true;
    case SPIRV_OP_LogicalEqual:
    case SPIRV_OP_IEqual: *result = 0 - (uint32_t)(v[0] == v[1]); return true;
    case SPIRV_OP_LogicalNotEqual:
    case SPIRV_OP_INotEqual: *result = 0 - (uint32_t)(v[0] != v[1]); return true;
    case SPIRV_OP_ULessThan: *result = 0 - (uint32_t)(v[0] < v[1]); return true;
    case SPIRV_OP_SLessThan: *result = 0 - (uint32_t)(a < b); return true;
    case SPIRV_OP_UGreaterThan: *result = 0 - (uint32_t)(v[0] > v[1]); return true;
    case SPIRV_OP_SGreaterThan: *result = 0 - (uint32_t)(a > b); return true;
    case SPIRV_OP_ULessThanEqual: *result = 0 - (uint32_t)(v[0] <= v[1]); return true;
    case SPIRV_OP_SLessThanEqual: *result = 0 - (uint32_t)(a <= b); return true;
    case SPIRV_OP_UGreaterThanEqual: *result = 0 - (uint32_t)(v[0] >= v[1]); return true;
    case SPIRV_OP_SGreaterThanEqual: *result = 0 - (uint32_t)(a >= b); return true;
    case SPIRV_OP_Select: *result = v[0] ? v[1] : v[2]; return true;
    default: return false;
    }
}

// Scalar i of an operand. A condition of Select may be one scalar for all.
static uint32_t scalar_of(const struct operation *operation, uint32_t index, uint32_t i)
{
    const struct shader_constant *const constant = operand(operation, index);
    return constant->scalars[constant->type->scalars == 1 ? 0 : i];
}

// Find the part of a composite that literals name. Return its type, and where its scalars begin.
static const struct shader_type *find_part(const struct operation *operation, const struct shader_type *type,
                                           uint32_t first, uint32_t *begin)
{
    *begin = 0;
    for (uint32_t i = first; i < operation->count; i++) {
        const uint32_t index = operation->operands[i];
        if (index >= type->count || type->scalars == 0) {
            shader_refuse(operation->module, operation->word, "there is no part %u", (unsigned)index);
        }
        if (type->kind == SHADER_STRUCT) {
            *begin += type->members[index].first;
            type = type->members[index].type;
        } else {
            *begin += index * type->element->scalars;
            type = type->element;
        }
    }
    return type;
}

static void check_part(const struct operation *operation, const struct shader_type *part,
                       const struct shader_type *expected)
{
    if (part != expected) {
        shader_refuse(operation->module, operation->word, "the part is of another type");
    }
}

static const struct shader_type *scalar_type(const struct shader_type *type)
{
    return type->kind == SHADER_VECTOR ? type->element : type;
}

// Return what stands for a number of the type that is nearest to what stands for another.
static uint32_t settle(const struct shader_type *type, uint32_t bits)
{
    return shader_extend(type, type->kind == SHADER_FLOAT && type->bits == 16 ? shader_half_from_float(bits)
                                                                              : bits);
}

static uint32_t operands_of(uint32_t opcode)
{
    switch (opcode) {
    case SPIRV_OP_SConvert:
    case SPIRV_OP_UConvert:
    case SPIRV_OP_FConvert:
    case SPIRV_OP_QuantizeToF16:
    case SPIRV_OP_SNegate:
    case SPIRV_OP_Not:
    case SPIRV_OP_LogicalNot: return 1;
    case SPIRV_OP_Select: return 3;
    default: return 2;
    }
}

static bool is_bool(const struct shader_type *type)
{
    return scalar_type(type)->kind == SHADER_BOOL;
}

// Return true if a type is a number, a bool or a vector of them.
static bool is_scalar_or_vector(const struct shader_type *type)
{
    const enum shader_type_kind kind = scalar_type(type)->kind;
    return kind == SHADER_BOOL || kind == SHADER_INT || kind == SHADER_FLOAT;
}

// Refuse an operation on what are no components, and one whose bools and numbers do not stand where it has them: a bool
// is −1 or 0.
static void check_kinds(const struct operation *operation, uint32_t opcode)
{
    const bool is_logical = opcode >= SPIRV_OP_LogicalEqual && opcode <= SPIRV_OP_LogicalNot;
    const bool is_comparison = opcode >= SPIRV_OP_IEqual && opcode <= SPIRV_OP_SLessThanEqual;
    const struct shader_type *const result = operation->type;
    const bool gives_bool = is_bool(result);
    if (operation->count != operands_of(opcode)) {
        shader_refuse(operation->module, operation->word, "Op%s has %u operands",
                      shader_instruction_name(opcode), (unsigned)operands_of(opcode));
    }
    if (!is_scalar_or_vector(result)) {
        shader_refuse(operation->module, operation->word, "Op%s gives a scalar or a vector",
                      shader_instruction_name(opcode));
    }
    if (opcode != SPIRV_OP_Select && gives_bool != (is_logical || is_comparison)) {
        shader_refuse(operation->module, operation->word, "Op%s gives %s", shader_instruction_name(opcode),
                      gives_bool ? "no bool" : "a bool");
    }
    for (uint32_t i = 0; i < operation->count; i++) {
        const struct shader_type *const type = operand(operation, i)->type;
        const bool is_condition = opcode == SPIRV_OP_Select && i == 0;
        const bool asks = is_condition ? true : is_comparison ? false : gives_bool;
        const bool has_count = type->scalars == result->scalars || (is_condition && type->scalars == 1);
        if (!is_scalar_or_vector(type) || !has_count || is_bool(type) != asks) {
            shader_refuse(operation->module, operation->word, "operand %u is of a type that does not fit",
                          (unsigned)i);
        }
    }
}

static void shuffle(const struct operation *operation, uint32_t *scalars)
{
    const struct shader_constant *const a = operand(operation, 0), *const b = operand(operation, 1);
    const struct shader_type *const type = operation->type;
    if (type->kind != SHADER_VECTOR || a->type->kind != SHADER_VECTOR || b->type->kind != SHADER_VECTOR ||
        a->type->element != type->element || b->type->element != type->element ||
        operation->count != 2 + type->count) {
        shader_refuse(operation->module, operation->word,
                      "a vector is shuffled of two with its type of components, and a number for each");
    }
    for (uint32_t i = 0; i < type->count; i++) {
        const uint32_t from = operation->operands[2 + i];
        if (from < a->type->count) {
            scalars[i] = a->scalars[from];
        } else if (from - a->type->count < b->type->count) {
            scalars[i] = b->scalars[from - a->type->count];
        }
    }
}

static void evaluate_operation(const struct operation *operation, uint32_t opcode, uint32_t *scalars)
{
    const struct shader_type *const type = operation->type;
    uint32_t begin;
    if (opcode == SPIRV_OP_CompositeExtract) {
        const struct shader_constant *const whole = operand(operation, 0);
        check_part(operation, find_part(operation, whole->type, 1, &begin), type);
        memcpy(scalars, whole->scalars + begin, type->scalars * sizeof *scalars);
        return;
    }
    if (opcode == SPIRV_OP_CompositeInsert) {
        const struct shader_constant *const part = operand(operation, 0), *const whole =
                                                                              operand(operation, 1);
        check_part(operation, whole->type, type);
        check_part(operation, find_part(operation, type, 2, &begin), part->type);
        memcpy(scalars, whole->scalars, type->scalars * sizeof *scalars);
        memcpy(scalars + begin, part->scalars, part->type->scalars * sizeof *scalars);
        return;
    }
    if (opcode == SPIRV_OP_VectorShuffle) {
        shuffle(operation, scalars);
        return;
    }
    if (opcode == SPIRV_OP_CopyObject) {
        check_part(operation, operand(operation, 0)->type, type);
        memcpy(scalars, operand(operation, 0)->scalars, type->scalars * sizeof *scalars);
        return;
    }
    check_kinds(operation, opcode);
    const struct shader_type *const scalar = scalar_type(type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        uint32_t v[3] = {0, 0, 0};
        for (uint32_t o = 0; o < operation->count && o < 3; o++) {
            v[o] = scalar_of(operation, o, i);
        }
        if (opcode == SPIRV_OP_UConvert || opcode == SPIRV_OP_SConvert) {
            struct shader_type from = *scalar_type(operand(operation, 0)->type);
            from.is_signed = opcode == SPIRV_OP_SConvert;
            scalars[i] = shader_extend(&from, v[0]);
        } else if (!evaluate(opcode, v, &scalars[i])) {
            shader_refuse(operation->module, operation->word, "Op%s of constants is not supported",
                          shader_instruction_name(opcode));
        }
        scalars[i] = settle(scalar, scalars[i]);
    }
}

void shader_read_constant(struct shader_module *module, uint32_t word,
                          const struct shader_specialization *values, size_t count)
{
    const uint32_t *const words = module->words + word;
    const uint32_t opcode = words[0] & 0xffff;
    const struct shader_type *const type = shader_type_of_id(module, word, words[1]);
    uint32_t *const scalars = new_constant(module, word, type);
    const bool is_true = opcode == SPIRV_OP_ConstantTrue || opcode == SPIRV_OP_SpecConstantTrue;
    const bool is_false = opcode == SPIRV_OP_ConstantFalse || opcode == SPIRV_OP_SpecConstantFalse;
    const struct shader_specialization *const given =
        opcode >= SPIRV_OP_SpecConstantTrue ? find_value(module, words[2], values, count) : NULL;
    if (is_true || is_false) {
        if (type->kind != SHADER_BOOL) {
            shader_refuse(module, word, "true and false are of the type bool");
        }
        scalars[0] = (given ? given->value != 0 : is_true) ? UINT32_MAX : 0;
    } else if (opcode == SPIRV_OP_Constant || opcode == SPIRV_OP_SpecConstant) {
        read_number(module, word, type, scalars);
        scalars[0] = given ? shader_extend(type, given->value) : scalars[0];
    } else if (opcode == SPIRV_OP_ConstantComposite || opcode == SPIRV_OP_SpecConstantComposite) {
        read_composite(module, word, type, scalars);
    } else if (opcode == SPIRV_OP_SpecConstantOp) {
        const struct operation operation = {module, word, type, words + 4, (words[0] >> 16) - 4};
        evaluate_operation(&operation, words[3], scalars);
    } // What is left is null or undefined: zeroes.
}
