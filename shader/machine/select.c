// SPDX-License-Identifier: MIT
// Arithmetic: an instruction or a few for each operation, or a call.
#include "generator.h"

// Operations that are one instruction: how it is written.
struct notation {
    uint16_t instruction;
    enum { NOT_ONE, OF_ONE, OF_TWO, OF_TWO_SWAPPED } operands; // swapped: the second comes first
    bool commutes;
    int16_t immediate;
};

static const struct notation notations[SHADER_OP_COUNT] = {
    [SHADER_FADD] = {X86_VADDPS, OF_TWO, true, 0},
    [SHADER_FSUB] = {X86_VSUBPS, OF_TWO, false, 0},
    [SHADER_FMUL] = {X86_VMULPS, OF_TWO, true, 0},
    [SHADER_FDIV] = {X86_VDIVPS, OF_TWO, false, 0},
    [SHADER_FMIN] = {X86_VMINPS, OF_TWO, false, 0},
    [SHADER_FMAX] = {X86_VMAXPS, OF_TWO, false, 0},
    [SHADER_FSQRT] = {X86_VSQRTPS, OF_ONE, false, 0},
    [SHADER_FLOOR] = {X86_VROUNDPS, OF_ONE, false, X86_ROUND_DOWN},
    [SHADER_CEIL] = {X86_VROUNDPS, OF_ONE, false, X86_ROUND_UP},
    [SHADER_TRUNC] = {X86_VROUNDPS, OF_ONE, false, X86_ROUND_ZERO},
    [SHADER_ROUND_EVEN] = {X86_VROUNDPS, OF_ONE, false, X86_ROUND_EVEN},
    [SHADER_FEQUAL] = {X86_VCMPPS, OF_TWO, true, X86_EQ_O},
    [SHADER_FLESS] = {X86_VCMPPS, OF_TWO, false, X86_LT_O},
    [SHADER_FLESS_EQUAL] = {X86_VCMPPS, OF_TWO, false, X86_LE_O},
    [SHADER_IADD] = {X86_VPADDD, OF_TWO, true, 0},
    [SHADER_ISUB] = {X86_VPSUBD, OF_TWO, false, 0},
    [SHADER_IMUL] = {X86_VPMULLD, OF_TWO, true, 0},
    [SHADER_AND] = {X86_VANDPS, OF_TWO, true, 0},
    [SHADER_OR] = {X86_VORPS, OF_TWO, true, 0},
    [SHADER_XOR] = {X86_VXORPS, OF_TWO, true, 0},
    [SHADER_IEQUAL] = {X86_VPCMPEQD, OF_TWO, true, 0},
    [SHADER_ILESS] = {X86_VPCMPGTD, OF_TWO_SWAPPED, false, 0},
    [SHADER_FLOAT_FROM_INT] = {X86_VCVTDQ2PS, OF_ONE, false, 0},
};

static const uint32_t *operands_of(const struct shader_generator *g, uint32_t value)
{
    return g->form->nodes[value].operands;
}

static void put_unary(struct shader_generator *g, uint32_t value, const struct notation *notation)
{
    const struct x86_operand a = shader_anywhere(g, operands_of(g, value)[0]);
    shader_end_operands(g);
    const int result = shader_result(g, value);
    shader_encode(&g->code, notation->instruction, result, 0, a, notation->immediate);
}

static void put_binary(struct shader_generator *g, uint32_t value, uint32_t a, uint32_t b,
                       const struct notation *notation)
{
    const bool is_better = g->values[a].reg < 0 && g->values[b].reg >= 0;
    if (notation->operands == OF_TWO_SWAPPED || (notation->commutes && is_better)) {
        const uint32_t swapped = a;
        a = b;
        b = swapped;
    }
    if (g->values[b].reg >= 0) {
        g->locked |= 1u << g->values[b].reg;
    }
    const int first = shader_in_register(g, a);
    const struct x86_operand second = shader_anywhere(g, b);
    shader_end_operands(g);
    const int result = shader_result(g, value);
    shader_encode(&g->code, notation->instruction, result, first, second, notation->immediate);
}

// Return true for a comparison of integers whose only reader, a SELECT behind it, takes the lesser or the greater.
static bool is_of_extreme(const struct shader_generator *g, uint32_t place)
{
    const uint32_t value = g->form->code[place];
    const struct shader_node *const node = &g->form->nodes[value];
    if ((node->op != SHADER_ILESS && node->op != SHADER_ULESS) || g->plan.uses[value] != 1) {
        return false;
    }
    const struct shader_node *const reader = &g->form->nodes[g->form->code[place + 1]];
    const uint32_t a = node->operands[0], b = node->operands[1];
    return reader->op == SHADER_SELECT && reader->operands[0] == value &&
           ((reader->operands[1] == a && reader->operands[2] == b) ||
            (reader->operands[1] == b && reader->operands[2] == a));
}

static void put_extreme(struct shader_generator *g, uint32_t value)
{
    const uint32_t *const operands = operands_of(g, value);
    const struct shader_node *const less = &g->form->nodes[operands[0]];
    const bool is_signed = less->op == SHADER_ILESS, is_lesser = operands[1] == less->operands[0];
    const unsigned instruction =
        is_signed ? (is_lesser ? X86_VPMINSD : X86_VPMAXSD) : (is_lesser ? X86_VPMINUD : X86_VPMAXUD);
    put_binary(g, value, operands[1], operands[2],
               &(struct notation){(uint16_t)instruction, OF_TWO, true, 0});
}

static void put_select(struct shader_generator *g, uint32_t value)
{
    const uint32_t *const operands = operands_of(g, value);
    if (g->place > 0 && is_of_extreme(g, g->place - 1)) {
        put_extreme(g, value);
        return;
    }
    for (int o = 0; o < 3; o++) {
        g->locked |= g->values[operands[o]].reg >= 0 ? 1u << g->values[operands[o]].reg : 0;
    }
    const int truth = shader_in_register(g, operands[0]), otherwise = shader_in_register(g, operands[2]);
    const struct x86_operand then = shader_anywhere(g, operands[1]);
    shader_end_operands(g);
    const int result = shader_result(g, value);
    shader_encode(&g->code, X86_VBLENDVPS, result, otherwise, then, truth);
}

static void put_copy(struct shader_generator *g, uint32_t value)
{
    const struct x86_operand a = shader_anywhere(g, operands_of(g, value)[0]);
    shader_end_operands(g);
    const int result = shader_result(g, value);
    if (a.reg != result) {
        shader_put(g, X86_VMOVUPS, result, 0, a);
    }
}

static void put_not(struct shader_generator *g, uint32_t value)
{
    const int a = shader_in_register(g, operands_of(g, value)[0]);
    shader_end_operands(g);
    const int result = shader_result(g, value);
    shader_put(g, X86_VXORPS, result, a, shader_pool_splat(&g->code, UINT32_MAX));
}

// 1 / sqrt(a), as rhw_rsqrt has it.
static void put_rsqrt(struct shader_generator *g, uint32_t value)
{
    const struct x86_operand a = shader_anywhere(g, operands_of(g, value)[0]);
    const int root = shader_temporary(g), one = shader_temporary(g);
    shader_put(g, X86_VSQRTPS, root, 0, a);
    shader_put(g, X86_VBROADCASTSS, one, 0, shader_pool_scalar(&g->code, 0x3f800000));
    shader_end_operands(g);
    shader_put(g, X86_VDIVPS, shader_result(g, value), one, x86_reg(root));
}

// What does not fit becomes the lowest number, which NaN and what is too large turn into 0 and the highest.
static void put_int_from_float(struct shader_generator *g, uint32_t value)
{
    const int a = shader_in_register(g, operands_of(g, value)[0]);
    const int whole = shader_temporary(g), mask = shader_temporary(g);
    shader_put(g, X86_VCVTTPS2DQ, whole, 0, x86_reg(a));
    shader_encode(&g->code, X86_VCMPPS, mask, a, x86_reg(a), X86_EQ_O);
    shader_put(g, X86_VANDPS, whole, whole, x86_reg(mask));
    shader_encode(&g->code, X86_VCMPPS, mask, a, shader_pool_splat(&g->code, 0x4f000000), X86_GE_O); // 2^31
    shader_end_operands(g);
    shader_put(g, X86_VXORPS, shader_result(g, value), whole, x86_reg(mask));
}

// Shifts take the lower 5 bits of what they shift by.
static void put_shift(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value], *const by =
                                                                       &g->form->nodes[node->operands[1]];
    const bool is_left = node->op == SHADER_SHIFT_LEFT, is_signed = node->op == SHADER_SHIFT_RIGHT_SIGNED;
    if (by->op == SHADER_CONSTANT) {
        const unsigned instruction = is_left ? X86_VPSLLD_I : is_signed ? X86_VPSRAD_I : X86_VPSRLD_I;
        const int a = shader_in_register(g, node->operands[0]);
        shader_end_operands(g);
        shader_encode(&g->code, instruction, shader_result(g, value), 0, x86_reg(a),
                      (int32_t)(by->immediate & 31));
        return;
    }
    const unsigned instruction = is_left ? X86_VPSLLVD : is_signed ? X86_VPSRAVD : X86_VPSRLVD;
    const int a = shader_in_register(g, node->operands[0]), b = shader_in_register(g, node->operands[1]);
    const int bits = shader_temporary(g);
    shader_put(g, X86_VANDPS, bits, b, shader_pool_splat(&g->code, 31));
    shader_end_operands(g);
    shader_put(g, instruction, shader_result(g, value), a, x86_reg(bits));
}

// Signed comparison with the sign bits turned is unsigned comparison.
static void put_unsigned_less(struct shader_generator *g, uint32_t value)
{
    const uint32_t *const operands = operands_of(g, value);
    const struct x86_operand sign = shader_pool_splat(&g->code, 0x80000000);
    const int a = shader_in_register(g, operands[0]), b = shader_in_register(g, operands[1]);
    const int x = shader_temporary(g), y = shader_temporary(g);
    shader_put(g, X86_VXORPS, x, a, sign);
    shader_put(g, X86_VXORPS, y, b, sign);
    shader_end_operands(g);
    shader_put(g, X86_VPCMPGTD, shader_result(g, value), y, x86_reg(x));
}

// Return the cosine of what a value is the sine of, or the other way round, that is computed soon. SHADER_NONE: there
// is none.
static uint32_t other_of_pair(const struct shader_generator *g, uint32_t value)
{
    enum { FAR = 32 };
    const struct shader_node *const nodes = g->form->nodes, *const node = &nodes[value];
    if ((node->op != SHADER_SIN && node->op != SHADER_COS) || nodes[node->operands[0]].op == SHADER_HOME) {
        return SHADER_NONE;
    }
    const uint16_t wanted = node->op == SHADER_SIN ? SHADER_COS : SHADER_SIN;
    for (uint32_t i = g->place + 1; i < g->form->code_count && i < g->place + FAR; i++) {
        const uint32_t other = g->form->code[i];
        if (nodes[other].op == wanted && nodes[other].operands[0] == node->operands[0]) {
            const bool is_near = g->plan.block[i] == g->plan.block[g->place] &&
                                 g->plan.run[i] == g->plan.run[g->place] &&
                                 g->plan.is_hoisted[other] == g->plan.is_hoisted[value] &&
                                 g->plan.is_joint[other] == g->plan.is_joint[value];
            return is_near ? other : SHADER_NONE;
        }
    }
    return SHADER_NONE;
}

static void put_call(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    struct shader_invocation call = {
        .which = node->op, .vector_count = shader_op_operands((enum shader_op)node->op), .result = value};
    const uint32_t other = other_of_pair(g, value);
    if (g->values[value].home != SHADER_HOMELESS) {
        return; // it came with the other
    }
    if (other != SHADER_NONE) {
        call.which = node->op == SHADER_SIN ? SHADER_CALL_SINE_FIRST : SHADER_CALL_COSINE_FIRST;
        call.arguments[call.argument_count++] = shader_address_argument(shader_home_of(g, other));
        g->values[other].is_stored = true;
    }
    for (int o = 0; o < call.vector_count; o++) {
        call.vectors[o] = node->operands[o];
    }
    shader_invoke(g, &call);
}

// Operations among the lanes of a group.
static bool select_subgroup(struct shader_generator *g, uint32_t value)
{
    const struct shader_node *const node = &g->form->nodes[value];
    struct shader_invocation call = {.which = node->op, .result = value};
    switch ((enum shader_op)node->op) {
    case SHADER_SCAN: call.arguments[call.argument_count++] = shader_number_argument(node->immediate); break;
    case SHADER_BALLOT:
    case SHADER_SHUFFLE: break;
    default: return false;
    }
    for (int o = 0; o < shader_op_operands((enum shader_op)node->op); o++) {
        call.vectors[call.vector_count++] = node->operands[o];
    }
    call.vectors[call.vector_count++] = g->mask;
    shader_invoke(g, &call);
    return true;
}

bool shader_is_instruction(const struct shader_generator *g, uint32_t value)
{
    const uint16_t op = g->form->nodes[value].op;
    const bool is_slow = op == SHADER_FDIV || op == SHADER_FSQRT;
    return (notations[op].operands != NOT_ONE && !is_slow) || op == SHADER_SELECT || op == SHADER_COPY;
}

bool shader_is_bare(const struct shader_generator *g, uint32_t value)
{
    switch ((enum shader_op)g->form->nodes[value].op) {
    case SHADER_FDIV:
    case SHADER_FSQRT:
    case SHADER_RSQRT:
    case SHADER_NOT:
    case SHADER_SHIFT_LEFT:
    case SHADER_SHIFT_RIGHT:
    case SHADER_SHIFT_RIGHT_SIGNED:
    case SHADER_INT_FROM_FLOAT:
    case SHADER_ULESS:
    case SHADER_PART:
    case SHADER_SET:
    case SHADER_IF:
    case SHADER_ELSE:
    case SHADER_END_IF:
    case SHADER_REGION:
    case SHADER_END_REGION:
    case SHADER_LEAVE: return true;
    default: return shader_is_instruction(g, value);
    }
}

bool shader_select_arithmetic(struct shader_generator *g, uint32_t value)
{
    const struct notation *const notation = &notations[g->form->nodes[value].op];
    if (is_of_extreme(g, g->place)) {
        return true;
    }
    if (notation->operands == OF_ONE) {
        put_unary(g, value, notation);
        return true;
    }
    if (notation->operands != NOT_ONE) {
        put_binary(g, value, operands_of(g, value)[0], operands_of(g, value)[1], notation);
        return true;
    }
    switch ((enum shader_op)g->form->nodes[value].op) {
    case SHADER_BUFFER: // its value is the element, which lanes name themselves
    case SHADER_COPY: put_copy(g, value); return true;
    case SHADER_SELECT: put_select(g, value); return true;
    case SHADER_NOT: put_not(g, value); return true;
    case SHADER_SHIFT_LEFT:
    case SHADER_SHIFT_RIGHT:
    case SHADER_SHIFT_RIGHT_SIGNED: put_shift(g, value); return true;
    case SHADER_INT_FROM_FLOAT: put_int_from_float(g, value); return true;
    case SHADER_RSQRT: put_rsqrt(g, value); return true;
    case SHADER_ULESS: put_unsigned_less(g, value); return true;
    default: break;
    }
    if (select_subgroup(g, value)) {
        return true;
    }
    if (!shader_machine_function(g->form->nodes[value].op) ||
        shader_op_kind_of((enum shader_op)g->form->nodes[value].op) != SHADER_KIND_VALUE) {
        return false;
    }
    put_call(g, value);
    return true;
}
