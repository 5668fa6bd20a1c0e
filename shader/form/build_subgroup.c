// SPDX-License-Identifier: MIT
// Subgroups (Vulkan 1.3 §9.27, "Group Operations"; SPIR-V, "Non-Uniform Instructions"). A subgroup is a group of 8
// lanes, on every machine. In compute shaders its invocations follow one another by their index in the workgroup. How
// vertices and fragments come together depends on the machine, so they have but their lane and elect.
#include "build.h"

enum { SUBGROUP_SIZE = 8, SUBGROUP_BITS = 0xff };

enum reach { REDUCE, INCLUSIVE_SCAN, EXCLUSIVE_SCAN, CLUSTERED_REDUCE };

// Built-in variables ---------------------------------------------------------------------------------

static uint32_t lane(struct shader_builder *builder)
{
    return shader_emit_with(builder, SHADER_BUILT_IN, SHADER_IN_LANE, 0, 0, 0);
}

// The bits of the lanes that a mask has: those from the lane on or behind it, or those before.
static uint32_t mask_of(struct shader_builder *builder, int number)
{
    const bool is_inverse = number == SPIRV_SUBGROUP_LE_MASK || number == SPIRV_SUBGROUP_LT_MASK;
    const bool begins_here = number == SPIRV_SUBGROUP_GE_MASK || number == SPIRV_SUBGROUP_LT_MASK;
    const uint32_t first = number == SPIRV_SUBGROUP_EQ_MASK ? 1 : begins_here ? 0xff : 0xfe;
    const uint32_t bits =
        shader_emit(builder, SHADER_SHIFT_LEFT, shader_number(builder, first), lane(builder), 0);
    return shader_emit(builder, SHADER_AND, is_inverse ? shader_emit(builder, SHADER_NOT, bits, 0, 0) : bits,
                       shader_number(builder, SUBGROUP_BITS), 0);
}

uint32_t shader_subgroup_built_in(struct shader_builder *builder, int number, uint32_t component)
{
    const uint32_t *const size = builder->entry->local_size;
    switch (number) {
    case SPIRV_SUBGROUP_SIZE: return shader_number(builder, SUBGROUP_SIZE);
    case SPIRV_NUM_SUBGROUPS:
        return shader_number(builder, (size[0] * size[1] * size[2] + SUBGROUP_SIZE - 1) / SUBGROUP_SIZE);
    case SPIRV_SUBGROUP_ID:
        return shader_emit(builder, SHADER_SHIFT_RIGHT,
                           shader_emit_with(builder, SHADER_BUILT_IN, SHADER_IN_LOCAL_INDEX, 0, 0, 0),
                           shader_number(builder, 3), 0);
    case SPIRV_SUBGROUP_LOCAL_INVOCATION_ID: return lane(builder);
    case SPIRV_SUBGROUP_EQ_MASK:
    case SPIRV_SUBGROUP_GE_MASK:
    case SPIRV_SUBGROUP_GT_MASK:
    case SPIRV_SUBGROUP_LE_MASK:
    case SPIRV_SUBGROUP_LT_MASK: return component == 0 ? mask_of(builder, number) : shader_number(builder, 0);
    default: return SHADER_NO_VALUE;
    }
}

// Votes and ballots ----------------------------------------------------------------------------------

static uint32_t ballot(struct shader_builder *builder, uint32_t truth)
{
    return shader_emit(builder, SHADER_BALLOT, truth, 0, 0);
}

// The first lane that is active.
static uint32_t first_lane(struct shader_builder *builder)
{
    const uint32_t active = ballot(builder, shader_number(builder, UINT32_MAX));
    return shader_emit(builder, SHADER_FIND_LOWEST, active, 0, 0);
}

// Return whether a truth holds in all lanes.
static uint32_t holds_in_all(struct shader_builder *builder, uint32_t truth)
{
    const uint32_t missing = ballot(builder, shader_emit(builder, SHADER_NOT, truth, 0, 0));
    return shader_emit(builder, SHADER_IEQUAL, missing, shader_number(builder, 0), 0);
}

static uint32_t holds_in_any(struct shader_builder *builder, uint32_t truth)
{
    const uint32_t none =
        shader_emit(builder, SHADER_IEQUAL, ballot(builder, truth), shader_number(builder, 0), 0);
    return shader_emit(builder, SHADER_NOT, none, 0, 0);
}

// Return whether a value is the same in all lanes.
static uint32_t is_equal_in_all(struct shader_builder *builder, uint32_t id)
{
    const struct shader_type *const type = shader_type_of_value(builder, id);
    const struct shader_type *const element = type->kind == SHADER_VECTOR ? type->element : type;
    const enum shader_op equal = element->kind == SHADER_FLOAT ? SHADER_FEQUAL : SHADER_IEQUAL;
    const uint32_t first = first_lane(builder);
    uint32_t all = shader_number(builder, UINT32_MAX);
    for (uint32_t i = 0; i < type->scalars; i++) {
        const uint32_t value = shader_scalars(builder, id)[i];
        const uint32_t other = shader_emit(builder, SHADER_SHUFFLE, value, first, 0);
        all = shader_emit(builder, SHADER_AND, all, shader_emit(builder, equal, value, other, 0), 0);
    }
    return holds_in_all(builder, all);
}

// The bits of a ballot that count.
static uint32_t bits_of(struct shader_builder *builder, uint32_t id)
{
    return shader_emit(builder, SHADER_AND, shader_scalars(builder, id)[0],
                       shader_number(builder, SUBGROUP_BITS), 0);
}

static uint32_t bit_at(struct shader_builder *builder, uint32_t bits, uint32_t number)
{
    const uint32_t bit =
        shader_emit(builder, SHADER_AND, shader_emit(builder, SHADER_SHIFT_RIGHT, bits, number, 0),
                    shader_number(builder, 1), 0);
    return shader_emit(builder, SHADER_ISUB, shader_number(builder, 0), bit, 0);
}

static uint32_t count_bits(struct shader_builder *builder)
{
    uint32_t bits = bits_of(builder, shader_operand(builder, 5));
    const uint32_t reach = shader_operand(builder, 4);
    if (reach > EXCLUSIVE_SCAN) {
        shader_build_refuse(builder, "group operation %u is not supported here", (unsigned)reach);
    }
    if (reach != REDUCE) {
        const int mask = reach == INCLUSIVE_SCAN ? SPIRV_SUBGROUP_LE_MASK : SPIRV_SUBGROUP_LT_MASK;
        bits = shader_emit(builder, SHADER_AND, bits, mask_of(builder, mask), 0);
    }
    return shader_emit(builder, SHADER_BIT_COUNT, bits, 0, 0);
}

// Values of other lanes ------------------------------------------------------------------------------

// Define the result as the operand's scalars in another lane.
static void define_shuffled(struct shader_builder *builder, uint32_t from)
{
    const uint32_t id = shader_operand(builder, 4);
    const struct shader_type *const type = shader_result_type(builder);
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        result[i] = shader_emit(builder, SHADER_SHUFFLE, shader_scalars(builder, id)[i], from, 0);
    }
    shader_define(builder, result);
}

static void build_quad(struct shader_builder *builder, uint32_t opcode)
{
    const uint32_t number = shader_scalars(builder, shader_operand(builder, 5))[0];
    uint32_t bits;
    if (!shader_is_number(builder, number, &bits) ||
        bits > (opcode == SPIRV_OP_GroupNonUniformQuadSwap ? 2u : 3u)) {
        shader_build_refuse(builder, "the lane of a quad is a constant");
    }
    if (opcode == SPIRV_OP_GroupNonUniformQuadSwap) {
        define_shuffled(builder,
                        shader_emit(builder, SHADER_XOR, lane(builder), shader_number(builder, bits + 1), 0));
        return;
    }
    const uint32_t quad = shader_emit(builder, SHADER_AND, lane(builder), shader_number(builder, ~3u), 0);
    define_shuffled(builder, shader_emit(builder, SHADER_OR, quad, number, 0));
}

static bool build_shuffle(struct shader_builder *builder, uint32_t opcode)
{
    if (opcode == SPIRV_OP_GroupNonUniformBroadcastFirst) {
        define_shuffled(builder, first_lane(builder));
        return true;
    }
    if (opcode == SPIRV_OP_GroupNonUniformQuadBroadcast || opcode == SPIRV_OP_GroupNonUniformQuadSwap) {
        build_quad(builder, opcode);
        return true;
    }
    const bool is_one =
        opcode == SPIRV_OP_GroupNonUniformBroadcast || opcode == SPIRV_OP_GroupNonUniformShuffle;
    const enum shader_op step = opcode == SPIRV_OP_GroupNonUniformShuffleXor    ? SHADER_XOR
                                : opcode == SPIRV_OP_GroupNonUniformShuffleUp   ? SHADER_ISUB
                                : opcode == SPIRV_OP_GroupNonUniformShuffleDown ? SHADER_IADD
                                                                                : SHADER_OP_COUNT;
    if (!is_one && step == SHADER_OP_COUNT) {
        return false;
    }
    const uint32_t number = shader_scalars(builder, shader_operand(builder, 5))[0];
    define_shuffled(builder, is_one ? number : shader_emit(builder, step, lane(builder), number, 0));
    return true;
}

// Sums and their like --------------------------------------------------------------------------------

static bool find_scan(uint32_t opcode, enum shader_scan *scan)
{
    switch (opcode) {
    case SPIRV_OP_GroupNonUniformIAdd: *scan = SHADER_SCAN_IADD; return true;
    case SPIRV_OP_GroupNonUniformFAdd: *scan = SHADER_SCAN_FADD; return true;
    case SPIRV_OP_GroupNonUniformIMul: *scan = SHADER_SCAN_IMUL; return true;
    case SPIRV_OP_GroupNonUniformFMul: *scan = SHADER_SCAN_FMUL; return true;
    case SPIRV_OP_GroupNonUniformSMin: *scan = SHADER_SCAN_MIN_INT; return true;
    case SPIRV_OP_GroupNonUniformUMin: *scan = SHADER_SCAN_MIN_UINT; return true;
    case SPIRV_OP_GroupNonUniformFMin: *scan = SHADER_SCAN_FMIN; return true;
    case SPIRV_OP_GroupNonUniformSMax: *scan = SHADER_SCAN_MAX_INT; return true;
    case SPIRV_OP_GroupNonUniformUMax: *scan = SHADER_SCAN_MAX_UINT; return true;
    case SPIRV_OP_GroupNonUniformFMax: *scan = SHADER_SCAN_FMAX; return true;
    case SPIRV_OP_GroupNonUniformBitwiseAnd:
    case SPIRV_OP_GroupNonUniformLogicalAnd: *scan = SHADER_SCAN_AND; return true;
    case SPIRV_OP_GroupNonUniformBitwiseOr:
    case SPIRV_OP_GroupNonUniformLogicalOr: *scan = SHADER_SCAN_OR; return true;
    case SPIRV_OP_GroupNonUniformBitwiseXor:
    case SPIRV_OP_GroupNonUniformLogicalXor: *scan = SHADER_SCAN_XOR; return true;
    default: return false;
    }
}

// Return the binary logarithm of the lanes of a cluster.
static uint32_t cluster_of(struct shader_builder *builder, uint32_t reach)
{
    uint32_t lanes = SUBGROUP_SIZE, log = 0;
    if (reach == CLUSTERED_REDUCE &&
        (!shader_is_number(builder, shader_scalars(builder, shader_operand(builder, 6))[0], &lanes) ||
         lanes == 0 || lanes > SUBGROUP_SIZE || (lanes & (lanes - 1)) != 0)) {
        shader_build_refuse(builder, "a cluster has 1, 2, 4 or %d lanes", SUBGROUP_SIZE);
    }
    while (1u << log < lanes) {
        log++;
    }
    return log;
}

static bool build_scan(struct shader_builder *builder, uint32_t opcode)
{
    enum shader_scan scan;
    if (!find_scan(opcode, &scan)) {
        return false;
    }
    const uint32_t reach = shader_operand(builder, 4), id = shader_operand(builder, 5);
    const struct shader_type *const type = shader_result_type(builder);
    if (reach > CLUSTERED_REDUCE) {
        shader_build_refuse(builder, "group operation %u is not supported", (unsigned)reach);
    }
    const uint32_t immediate = (uint32_t)scan |
                               (reach == CLUSTERED_REDUCE ? 0 : reach) << SHADER_SCAN_REACH_SHIFT |
                               cluster_of(builder, reach) << SHADER_SCAN_CLUSTER_SHIFT;
    uint32_t *const result = shader_new_scalars(builder, type);
    for (uint32_t i = 0; i < type->scalars; i++) {
        result[i] = shader_emit_with(builder, SHADER_SCAN, immediate, shader_scalars(builder, id)[i], 0, 0);
    }
    shader_define(builder, result);
    return true;
}

// ------------------------------------------------------------------------------------------------------

// Check the types of the result and the operands, in the letters of signature.c.
static void check_types(struct shader_builder *builder, uint32_t opcode)
{
    switch (opcode) {
    case SPIRV_OP_GroupNonUniformElect: shader_check_signature(builder, "B", 4); return;
    case SPIRV_OP_GroupNonUniformAll:
    case SPIRV_OP_GroupNonUniformAny: shader_check_signature(builder, "BB", 4); return;
    case SPIRV_OP_GroupNonUniformAllEqual: shader_check_signature(builder, "B", 4); return;
    case SPIRV_OP_GroupNonUniformInverseBallot: shader_check_signature(builder, "Bi", 4); return;
    case SPIRV_OP_GroupNonUniformBallotBitExtract: shader_check_signature(builder, "BiI", 4); return;
    case SPIRV_OP_GroupNonUniformBallotBitCount: shader_check_signature(builder, "Ii", 5); return;
    case SPIRV_OP_GroupNonUniformBallotFindLSB:
    case SPIRV_OP_GroupNonUniformBallotFindMSB: shader_check_signature(builder, "Ii", 4); return;
    case SPIRV_OP_GroupNonUniformBallot: shader_check_signature(builder, "iB", 4); return;
    case SPIRV_OP_GroupNonUniformBroadcastFirst: shader_check_signature(builder, "tt", 4); return;
    case SPIRV_OP_GroupNonUniformFAdd:
    case SPIRV_OP_GroupNonUniformFMul:
    case SPIRV_OP_GroupNonUniformFMin:
    case SPIRV_OP_GroupNonUniformFMax: shader_check_signature(builder, "ff", 5); return;
    case SPIRV_OP_GroupNonUniformLogicalAnd:
    case SPIRV_OP_GroupNonUniformLogicalOr:
    case SPIRV_OP_GroupNonUniformLogicalXor: shader_check_signature(builder, "bb", 5); return;
    default: break;
    }
    const bool is_scan =
        opcode >= SPIRV_OP_GroupNonUniformIAdd && opcode <= SPIRV_OP_GroupNonUniformBitwiseXor;
    shader_check_signature(builder, is_scan ? "ii" : "ttI", is_scan ? 5 : 4);
}

// Return the value of an instruction that has one of 32 bits, or SHADER_NO_VALUE.
static uint32_t build_number(struct shader_builder *builder, uint32_t opcode)
{
    const uint32_t id = shader_word_count(builder) > 4 ? shader_operand(builder, 4) : 0;
    switch (opcode) {
    case SPIRV_OP_GroupNonUniformElect:
        return shader_emit(builder, SHADER_IEQUAL, lane(builder), first_lane(builder), 0);
    case SPIRV_OP_GroupNonUniformAll: return holds_in_all(builder, shader_scalars(builder, id)[0]);
    case SPIRV_OP_GroupNonUniformAny: return holds_in_any(builder, shader_scalars(builder, id)[0]);
    case SPIRV_OP_GroupNonUniformAllEqual: return is_equal_in_all(builder, id);
    case SPIRV_OP_GroupNonUniformInverseBallot: return bit_at(builder, bits_of(builder, id), lane(builder));
    case SPIRV_OP_GroupNonUniformBallotBitExtract:
        return bit_at(builder, bits_of(builder, id), shader_scalars(builder, shader_operand(builder, 5))[0]);
    case SPIRV_OP_GroupNonUniformBallotBitCount: return count_bits(builder);
    case SPIRV_OP_GroupNonUniformBallotFindLSB:
        return shader_emit(builder, SHADER_FIND_LOWEST, bits_of(builder, id), 0, 0);
    case SPIRV_OP_GroupNonUniformBallotFindMSB:
        return shader_emit(builder, SHADER_FIND_HIGHEST, bits_of(builder, id), 0, 0);
    default: return SHADER_NO_VALUE;
    }
}

bool shader_build_subgroup(struct shader_builder *builder, uint32_t opcode)
{
    if (opcode < SPIRV_OP_GroupNonUniformElect || opcode > SPIRV_OP_GroupNonUniformQuadSwap) {
        return false;
    }
    if (builder->entry->model != SPIRV_COMPUTE && opcode != SPIRV_OP_GroupNonUniformElect) {
        shader_build_refuse(builder, "vertex and fragment shaders have no subgroup operation but elect");
    }
    check_types(builder, opcode);
    const uint32_t number = build_number(builder, opcode);
    if (number != SHADER_NO_VALUE) {
        shader_define(builder, &number);
        return true;
    }
    if (opcode == SPIRV_OP_GroupNonUniformBallot) {
        const uint32_t zero = shader_number(builder, 0);
        const uint32_t bits = ballot(builder, shader_scalars(builder, shader_operand(builder, 4))[0]);
        if (shader_result_type(builder)->scalars != 4) {
            shader_build_refuse(builder, "a ballot has 4 components");
        }
        shader_define(builder, (const uint32_t[]){bits, zero, zero, zero});
        return true;
    }
    return build_shuffle(builder, opcode) || build_scan(builder, opcode);
}
