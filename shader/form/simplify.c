// SPDX-License-Identifier: MIT
// Operations whose value is known, is that of an operand, or comes from a cheaper operation. Only what gives the same
// bits for every operand counts: x + 0 is not x where x is −0, and x · 0 is not 0 where x is infinite.
#include "pass.h"

#define NONE UINT32_MAX

struct simplifier {
    struct shader_program *program;
    uint32_t *stands_for; // by value: another value, plus 1
};

static bool is_constant(const struct simplifier *simplifier, uint32_t value, uint32_t *bits)
{
    const struct shader_node *const node = &simplifier->program->nodes[value];
    *bits = node->immediate;
    return node->op == SHADER_CONSTANT;
}

// Return the number k of 2^k, or −1 of other numbers.
static int power_of_two(uint32_t number)
{
    int power = 0;
    if (number == 0 || (number & (number - 1)) != 0) {
        return -1;
    }
    while (number >> power != 1) {
        power++;
    }
    return power;
}

static uint32_t number(const struct simplifier *simplifier, uint32_t bits)
{
    return shader_add_constant(simplifier->program, bits);
}

// Make a node another operation.
static void become(const struct simplifier *simplifier, uint32_t value, enum shader_op op, uint32_t a,
                   uint32_t bits)
{
    const uint32_t b = number(simplifier, bits);
    struct shader_node *const node = &simplifier->program->nodes[value];
    node->op = (uint16_t)op;
    node->operands[0] = a;
    node->operands[1] = b;
}

// Return the value of an operation whose operands are all constants, or NONE.
static uint32_t fold(const struct simplifier *simplifier, const struct shader_node *node)
{
    const enum shader_op op = (enum shader_op)node->op;
    const int count = shader_op_operands(op);
    uint32_t bits[3] = {0, 0, 0}, result;
    for (int o = 0; o < count; o++) {
        if (!is_constant(simplifier, node->operands[o], &bits[o])) {
            return NONE;
        }
    }
    return count > 0 && shader_fold(op, bits, &result) ? number(simplifier, result) : NONE;
}

// Floats with a constant as their second operand. Return the value, or NONE.
static uint32_t simplify_float(const struct simplifier *simplifier, uint32_t value, uint32_t bits)
{
    enum { ONE = 0x3f800000, SIGN_SHIFT = 31, EXPONENT_SHIFT = 23, BIAS = 127 };
    const struct shader_node *const node = &simplifier->program->nodes[value];
    const uint32_t a = node->operands[0], exponent = bits >> EXPONENT_SHIFT & 0xff;
    switch (node->op) {
    case SHADER_FADD: return bits == 1u << SIGN_SHIFT ? a : NONE;
    case SHADER_FSUB: return bits == 0 ? a : NONE;
    case SHADER_FMUL: return bits == ONE ? a : NONE;
    case SHADER_FDIV:
        // The reciprocal of a power of two is exact.
        if ((bits & 0x7fffff) == 0 && exponent > 0 && exponent < 2 * BIAS) {
            const uint32_t reciprocal = (bits >> SIGN_SHIFT << SIGN_SHIFT) | (2 * BIAS - exponent)
                                                                                 << EXPONENT_SHIFT;
            become(simplifier, value, SHADER_FMUL, a, reciprocal);
        }
        return bits == ONE ? a : NONE;
    default: return NONE;
    }
}

// Take two steps with constants as one: (x + 1) + 2, (x ^ 1) ^ 3. Return the value, or NONE.
static uint32_t join(const struct simplifier *simplifier, uint32_t value, uint32_t bits)
{
    const struct shader_node *const node = &simplifier->program->nodes[value];
    const struct shader_node *const inner = &simplifier->program->nodes[node->operands[0]];
    const uint32_t first = inner->operands[0];
    uint32_t other;
    if (inner->op != node->op || !is_constant(simplifier, inner->operands[1], &other)) {
        return NONE;
    }
    const uint32_t both = node->op == SHADER_IADD ? bits + other : bits ^ other;
    become(simplifier, value, (enum shader_op)node->op, first, both);
    return both == 0 ? first : NONE;
}

// Integers with a constant as their second operand. Return the value, or NONE.
static uint32_t simplify_integer(const struct simplifier *simplifier, uint32_t value, uint32_t bits)
{
    const struct shader_node *const node = &simplifier->program->nodes[value];
    const uint32_t a = node->operands[0];
    const int power = power_of_two(bits);
    switch (node->op) {
    case SHADER_IADD:
    case SHADER_XOR: return bits == 0 ? a : join(simplifier, value, bits);
    case SHADER_OR: return bits == 0 ? a : bits == UINT32_MAX ? number(simplifier, bits) : NONE;
    case SHADER_AND: return bits == 0 ? number(simplifier, 0) : bits == UINT32_MAX ? a : NONE;
    case SHADER_SHIFT_LEFT:
    case SHADER_SHIFT_RIGHT:
    case SHADER_SHIFT_RIGHT_SIGNED: return (bits & 31) == 0 ? a : NONE;
    case SHADER_IMUL:
        if (power > 0) {
            become(simplifier, value, SHADER_SHIFT_LEFT, a, (uint32_t)power);
        }
        return bits == 1 ? a : bits == 0 ? number(simplifier, 0) : NONE;
    case SHADER_UDIV:
        if (power > 0) {
            become(simplifier, value, SHADER_SHIFT_RIGHT, a, (uint32_t)power);
        }
        return bits == 1 ? a : NONE;
    case SHADER_UREM:
        if (power > 0) {
            become(simplifier, value, SHADER_AND, a, bits - 1);
        }
        return bits == 1 ? number(simplifier, 0) : NONE;
    default: return NONE;
    }
}

// Put a constant behind the other operand where the order does not matter, and subtract by adding.
static void set_order(const struct simplifier *simplifier, uint32_t value)
{
    struct shader_node *const node = &simplifier->program->nodes[value];
    const uint32_t a = node->operands[0];
    const bool may_swap = node->op == SHADER_FADD || node->op == SHADER_FMUL || node->op == SHADER_IADD ||
                          node->op == SHADER_IMUL || node->op == SHADER_AND || node->op == SHADER_OR ||
                          node->op == SHADER_XOR || node->op == SHADER_IEQUAL;
    uint32_t bits;
    if (may_swap && is_constant(simplifier, a, &bits)) {
        node->operands[0] = node->operands[1];
        node->operands[1] = a;
    } else if (node->op == SHADER_ISUB && is_constant(simplifier, node->operands[1], &bits)) {
        become(simplifier, value, SHADER_IADD, a, 0 - bits);
    }
}

// Operations on a value and itself. Return the value, or NONE.
static uint32_t simplify_same(const struct simplifier *simplifier, const struct shader_node *node)
{
    switch (node->op) {
    case SHADER_AND:
    case SHADER_OR:
    case SHADER_FMIN:
    case SHADER_FMAX: return node->operands[0];
    case SHADER_XOR:
    case SHADER_ISUB:
    case SHADER_ILESS:
    case SHADER_ULESS: return number(simplifier, 0);
    case SHADER_IEQUAL: return number(simplifier, UINT32_MAX);
    default: return NONE;
    }
}

// Return the value, or NONE. A truth is −1 or 0.
static uint32_t simplify_select(const struct simplifier *simplifier, struct shader_node *node)
{
    const struct shader_node *const condition = &simplifier->program->nodes[node->operands[0]];
    uint32_t bits, if_true, if_false;
    if (is_constant(simplifier, node->operands[0], &bits)) {
        return node->operands[bits ? 1 : 2];
    }
    if (node->operands[1] == node->operands[2]) {
        return node->operands[1];
    }
    if (condition->op == SHADER_NOT) {
        const uint32_t first = node->operands[1];
        node->operands[0] = condition->operands[0];
        node->operands[1] = node->operands[2];
        node->operands[2] = first;
    }
    const bool is_known = is_constant(simplifier, node->operands[1], &if_true) &&
                          is_constant(simplifier, node->operands[2], &if_false);
    return is_known && if_true == UINT32_MAX && if_false == 0 ? node->operands[0] : NONE;
}

// Return a value that the node stands for, or NONE. The node may become a cheaper one.
static uint32_t simplify(const struct simplifier *simplifier, uint32_t value)
{
    set_order(simplifier, value);
    struct shader_node *const node = &simplifier->program->nodes[value];
    const uint32_t known = fold(simplifier, node);
    if (known != NONE) {
        return known;
    }
    if (node->op == SHADER_SELECT) {
        return simplify_select(simplifier, node);
    }
    if (node->op == SHADER_NOT) {
        const struct shader_node *const inner = &simplifier->program->nodes[node->operands[0]];
        return inner->op == SHADER_NOT ? inner->operands[0] : NONE;
    }
    if (shader_op_operands((enum shader_op)node->op) != 2) {
        return NONE;
    }
    if (node->operands[0] == node->operands[1]) {
        const uint32_t same = simplify_same(simplifier, node);
        if (same != NONE) {
            return same;
        }
    }
    uint32_t bits;
    if (!is_constant(simplifier, node->operands[1], &bits)) {
        return NONE;
    }
    const uint32_t result = simplify_float(simplifier, value, bits);
    return result != NONE ? result : simplify_integer(simplifier, value, bits);
}

void shader_simplify(struct shader_program *program)
{
    // Constants that are made on the way stand for themselves.
    const uint32_t nodes = program->node_count, old_count = program->code_count;
    const struct simplifier simplifier = {program, shader_take(program->memory, nodes, sizeof(uint32_t))};
    program->code_count = 0;
    for (uint32_t i = 0; i < old_count; i++) {
        const uint32_t value = program->code[i];
        const enum shader_op op = (enum shader_op)program->nodes[value].op;
        uint32_t count;
        uint32_t *const operands = shader_operands(program, &program->nodes[value], &count);
        for (uint32_t o = 0; o < count; o++) {
            const uint32_t other = operands[o] < nodes ? simplifier.stands_for[operands[o]] : 0;
            operands[o] = other != 0 ? other - 1 : operands[o];
        }
        const bool is_plain =
            shader_op_kind_of(op) == SHADER_KIND_VALUE && op != SHADER_PART && op != SHADER_BUFFER;
        const uint32_t result = is_plain ? simplify(&simplifier, value) : NONE;
        if (result != NONE) {
            simplifier.stands_for[value] = result + 1;
        } else {
            program->code[program->code_count++] = value;
        }
    }
}
