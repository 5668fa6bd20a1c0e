// SPDX-License-Identifier: MIT
// Numbers of 8 and 16 bits, which memory may hold (VK_KHR_16bit_storage, VK_KHR_8bit_storage). As values they are 32
// bits: integers are extended, by their sign where they have one, and a half is the float that equals it.
#include "build.h"

static uint32_t emit2(struct shader_builder *builder, enum shader_op op, uint32_t a, uint32_t b)
{
    return shader_emit(builder, op, a, b, 0);
}

// Conversions ----------------------------------------------------------------------------------------

// Extend the lowest bits of an integer.
static uint32_t extend(struct shader_builder *builder, uint32_t value, int bits, bool is_signed)
{
    if (bits == 32) {
        return value;
    }
    if (!is_signed) {
        return emit2(builder, SHADER_AND, value, shader_number(builder, (1u << bits) - 1));
    }
    const uint32_t above = shader_number(builder, (uint32_t)(32 - bits));
    return emit2(builder, SHADER_SHIFT_RIGHT_SIGNED, emit2(builder, SHADER_SHIFT_LEFT, value, above), above);
}

static uint32_t half_bits(struct shader_builder *builder, uint32_t value)
{
    return emit2(builder, SHADER_PACK_HALVES, value, shader_number(builder, 0));
}

static uint32_t from_half_bits(struct shader_builder *builder, uint32_t value)
{
    return emit2(builder, SHADER_UNPACK_LOW_HALF, value, 0);
}

static bool is_half(const struct shader_type *type)
{
    return type->kind == SHADER_FLOAT && type->bits == 16;
}

static uint32_t convert(struct shader_builder *builder, uint32_t opcode, uint32_t value,
                        const struct shader_type *from, const struct shader_type *to)
{
    if (opcode == SPIRV_OP_FConvert) {
        return is_half(to) ? from_half_bits(builder, half_bits(builder, value)) : value;
    }
    if (opcode != SPIRV_OP_Bitcast) {
        const bool is_signed = opcode == SPIRV_OP_SConvert;
        const uint32_t whole = extend(builder, value, from->bits, is_signed);
        return extend(builder, whole, to->bits, to->is_signed);
    }
    const uint32_t bits = is_half(from) ? half_bits(builder, value) : value;
    if (to->kind == SHADER_FLOAT) {
        return is_half(to) ? from_half_bits(builder, bits) : bits;
    }
    return extend(builder, bits, to->bits, to->is_signed);
}

bool shader_build_conversion(struct shader_builder *builder, uint32_t opcode)
{
    if (opcode != SPIRV_OP_UConvert && opcode != SPIRV_OP_SConvert && opcode != SPIRV_OP_FConvert &&
        opcode != SPIRV_OP_Bitcast) {
        return false;
    }
    const uint32_t id = shader_operand(builder, 3);
    const struct shader_type *const type = shader_result_type(builder);
    const struct shader_type *const from = shader_scalar_type(shader_type_of_value(builder, id));
    const struct shader_type *const to = shader_scalar_type(type);
    const enum shader_type_kind kind = opcode == SPIRV_OP_FConvert ? SHADER_FLOAT : SHADER_INT;
    const uint32_t *const scalars = shader_scalars(builder, id);
    const bool is_number = from && to && from->kind != SHADER_BOOL && to->kind != SHADER_BOOL;
    const bool fits = opcode == SPIRV_OP_Bitcast ? is_number && from->bits == to->bits
                                                 : is_number && from->kind == kind && to->kind == kind;
    if (!fits || shader_type_of_value(builder, id)->scalars != type->scalars) {
        shader_build_refuse(builder, "the operand is no number that converts to the type of id %u",
                            (unsigned)type->id);
    }
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        result[i] = convert(builder, opcode, scalars[i], from, to);
    }
    shader_define(builder, result);
    return true;
}

// Memory ---------------------------------------------------------------------------------------------

uint32_t shader_load_narrow(struct shader_builder *builder, const struct shader_place *place, uint32_t offset)
{
    const struct shader_type *const type = place->type;
    const uint32_t word = shader_emit_with(builder, SHADER_LOAD, place->bytes, place->buffer, offset, 0);
    const uint32_t byte = emit2(builder, SHADER_IADD, offset, shader_number(builder, place->bytes));
    // Bits up to the number. Shifts count modulo 32, so they need not be cut off to those within the word.
    const uint32_t below = emit2(builder, SHADER_SHIFT_LEFT, byte, shader_number(builder, 3));
    const uint32_t above = shader_number(builder, (uint32_t)(32 - type->bits));
    if (type->kind == SHADER_INT && type->is_signed) {
        const uint32_t upper =
            emit2(builder, SHADER_SHIFT_LEFT, word, emit2(builder, SHADER_ISUB, above, below));
        return emit2(builder, SHADER_SHIFT_RIGHT_SIGNED, upper, above);
    }
    const uint32_t lower = emit2(builder, SHADER_SHIFT_RIGHT, word, below);
    return is_half(type) ? from_half_bits(builder, lower) : extend(builder, lower, type->bits, false);
}

void shader_store_narrow(struct shader_builder *builder, const struct shader_place *place, uint32_t offset,
                         uint32_t value)
{
    const uint32_t bits = is_half(place->type) ? half_bits(builder, value) : value;
    (void)shader_emit_with(builder, place->type->bits == 8 ? SHADER_STORE8 : SHADER_STORE16, place->bytes,
                           place->buffer, offset, bits);
}
