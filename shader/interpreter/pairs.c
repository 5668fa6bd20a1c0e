// SPDX-License-Identifier: MIT
// See pairs.h.
//
// The product is computed where the sum is. That is right where its factors are what they were: values stay, and a HOME
// changes by a SET alone. Product and sum stand in one piece of code without structure, so the same lanes are active. A
// comparison that chooses between what it compares is treated alike: the choice is the lesser or the greater.
#include "pairs.h"

// What is known of values on the way through the code.
struct walk {
    uint32_t *use_count; // by value
    uint32_t *place;     // by value: where it is computed, or for a HOME where it was set last; plus 1
    uint32_t begin;      // where the piece of code begins
};

static uint32_t *count_uses(const struct shader_program *program)
{
    uint32_t *const use_count = shader_take(program->memory, program->node_count, sizeof *use_count);
    for (uint32_t i = 0; i < program->code_count; i++) {
        uint32_t count;
        const uint32_t *const operands = shader_operands(program, &program->nodes[program->code[i]], &count);
        for (uint32_t o = 0; o < count; o++) {
            use_count[operands[o]]++;
        }
    }
    return use_count;
}

static bool is_unchanged(const struct shader_program *program, const struct walk *walk, uint32_t factor,
                         uint32_t since)
{
    return program->nodes[factor].op != SHADER_HOME || walk->place[factor] < since;
}

// Return whether what reads a value may take it in.
static bool can_take(const struct shader_program *program, const struct walk *walk, uint32_t value,
                     uint16_t op)
{
    const struct shader_node *const node = &program->nodes[value];
    const uint32_t place = walk->place[value];
    return node->op == op && walk->use_count[value] == 1 && (node->flags & SHADER_DYNAMICALLY_UNIFORM) == 0 &&
           place > walk->begin && is_unchanged(program, walk, node->operands[0], place) &&
           is_unchanged(program, walk, node->operands[1], place);
}

// Return whether a SELECT chooses between the operands of its condition.
static bool is_lesser_or_greater(const struct shader_program *program, const struct shader_node *node)
{
    const struct shader_node *const less = &program->nodes[node->operands[0]];
    const uint32_t a = less->operands[0], b = less->operands[1];
    return less->op == SHADER_ILESS && ((node->operands[1] == a && node->operands[2] == b) ||
                                        (node->operands[1] == b && node->operands[2] == a));
}

static void take(struct shader_pairs *pairs, uint32_t value, uint32_t other)
{
    pairs->other[value] = other + 1;
    pairs->is_taken[other] = true;
}

void shader_find_pairs(struct shader_program *program, struct shader_pairs *pairs)
{
    struct walk walk = {.use_count = count_uses(program),
                        .place = shader_take(program->memory, program->node_count, sizeof(uint32_t))};
    pairs->other = shader_take(program->memory, program->node_count, sizeof *pairs->other);
    pairs->is_taken = shader_take(program->memory, program->node_count, sizeof *pairs->is_taken);
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        const struct shader_node *const node = &program->nodes[value];
        walk.place[node->op == SHADER_SET ? node->operands[0] : value] = i + 1;
        if (shader_op_kind_of((enum shader_op)node->op) == SHADER_KIND_FLOW) {
            walk.begin = i + 1;
        }
        for (int o = 1; o >= 0 && (node->op == SHADER_FADD || node->op == SHADER_FSUB); o--) {
            if (pairs->other[value] == 0 && can_take(program, &walk, node->operands[o], SHADER_FMUL)) {
                take(pairs, value, node->operands[o]);
            }
        }
        if (node->op == SHADER_SELECT && is_lesser_or_greater(program, node) &&
            can_take(program, &walk, node->operands[0], SHADER_ILESS)) {
            take(pairs, value, node->operands[0]);
        }
    }
}

uint32_t shader_pair_at(const struct shader_pairs *pairs, const struct shader_program *program,
                        uint32_t value, uint32_t operands[3])
{
    const struct shader_node *const node = &program->nodes[value];
    if (pairs->other[value] == 0) {
        return 0;
    }
    const uint32_t other = pairs->other[value] - 1;
    const struct shader_node *const taken = &program->nodes[other];
    // The interpreter is quick where the first operand has a vector for each group.
    const int first = program->nodes[taken->operands[0]].flags & SHADER_DYNAMICALLY_UNIFORM ? 1 : 0;
    operands[0] = taken->operands[first];
    operands[1] = operands[2] = taken->operands[1 - first];
    if (node->op == SHADER_SELECT) {
        return node->operands[1] == taken->operands[0] ? (uint32_t)SHADER_IMIN : (uint32_t)SHADER_IMAX;
    }
    operands[2] = node->operands[node->operands[0] == other ? 1 : 0];
    return node->op == SHADER_FADD      ? (uint32_t)SHADER_MUL_ADD
           : node->operands[0] == other ? (uint32_t)SHADER_MUL_SUB
                                        : (uint32_t)SHADER_SUB_MUL;
}
