// SPDX-License-Identifier: MIT
// See pairs.h.
//
// The product is computed where the sum is. That is right where its factors are what they were: values stay, and a HOME
// changes by a SET alone. Product and sum stand in one piece of code without structure, so the same lanes are active.
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

// Return whether a sum may take in this operand.
static bool can_take(const struct shader_program *program, const struct walk *walk, uint32_t value)
{
    const struct shader_node *const node = &program->nodes[value];
    const uint32_t place = walk->place[value];
    return node->op == SHADER_FMUL && walk->use_count[value] == 1 && (node->flags & SHADER_UNIFORM) == 0 &&
           place > walk->begin && is_unchanged(program, walk, node->operands[0], place) &&
           is_unchanged(program, walk, node->operands[1], place);
}

void shader_find_pairs(struct shader_program *program, struct shader_pairs *pairs)
{
    struct walk walk = {.use_count = count_uses(program),
                        .place = shader_take(program->memory, program->node_count, sizeof(uint32_t))};
    pairs->product = shader_take(program->memory, program->node_count, sizeof *pairs->product);
    pairs->is_taken = shader_take(program->memory, program->node_count, sizeof *pairs->is_taken);
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        const struct shader_node *const node = &program->nodes[value];
        walk.place[node->op == SHADER_SET ? node->operands[0] : value] = i + 1;
        if (shader_op_kind_of((enum shader_op)node->op) == SHADER_KIND_FLOW) {
            walk.begin = i + 1;
        }
        for (int o = 1; o >= 0 && (node->op == SHADER_FADD || node->op == SHADER_FSUB); o--) {
            if (pairs->product[value] == 0 && can_take(program, &walk, node->operands[o])) {
                pairs->product[value] = node->operands[o] + 1;
                pairs->is_taken[node->operands[o]] = true;
            }
        }
    }
}

uint32_t shader_pair_at(const struct shader_pairs *pairs, const struct shader_program *program,
                        uint32_t value, uint32_t operands[3])
{
    const struct shader_node *const node = &program->nodes[value];
    if (pairs->product[value] == 0) {
        return 0;
    }
    const uint32_t product = pairs->product[value] - 1;
    const struct shader_node *const factors = &program->nodes[product];
    // The interpreter is quick where the first factor has a vector for each group.
    const int first = program->nodes[factors->operands[0]].flags & SHADER_UNIFORM ? 1 : 0;
    operands[0] = factors->operands[first];
    operands[1] = factors->operands[1 - first];
    operands[2] = node->operands[node->operands[0] == product ? 1 : 0];
    return node->op == SHADER_FADD        ? (uint32_t)SHADER_MUL_ADD
           : node->operands[0] == product ? (uint32_t)SHADER_MUL_SUB
                                          : (uint32_t)SHADER_SUB_MUL;
}
