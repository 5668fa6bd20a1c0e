// SPDX-License-Identifier: MIT
// See pass.h.
#include "pass.h"

enum { NO_SCOPE = 0 };

// Scopes are numbered in the order in which they begin; 0 is the whole program.
struct scopes {
    bool *is_open; // by number
    uint32_t stack[SHADER_MAX_DEPTH + 1];
    uint32_t depth, count;
};

static bool opens(uint16_t op)
{
    return op == SHADER_IF || op == SHADER_ELSE || op == SHADER_REGION || op == SHADER_LOOP;
}

static bool closes(uint16_t op)
{
    return op == SHADER_ELSE || op == SHADER_END_IF || op == SHADER_END_REGION || op == SHADER_END_LOOP;
}

static void follow(struct scopes *scopes, uint16_t op)
{
    if (closes(op)) {
        scopes->is_open[scopes->stack[scopes->depth--]] = false;
    }
    if (opens(op)) {
        scopes->stack[++scopes->depth] = ++scopes->count;
        scopes->is_open[scopes->count] = true;
    }
}

static bool is_placed(const struct shader_node *node)
{
    return node->op != SHADER_CONSTANT && node->op != SHADER_HOME && node->op != SHADER_PRIVATE &&
           node->op != SHADER_TABLE;
}

// Find the homes that values need. Return how many.
static uint32_t find_kept(struct shader_program *program, uint32_t *scope_of, uint32_t *home_of)
{
    struct scopes scopes = {.is_open = shader_take(program->memory, program->code_count + 2, sizeof(bool))};
    uint32_t kept = 0;
    scopes.is_open[0] = true;
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        const uint16_t op = program->nodes[value].op;
        uint32_t operand_count;
        const uint32_t *operands = shader_operands(program, &program->nodes[value], &operand_count);
        for (uint32_t o = 0; o < operand_count; o++) {
            const uint32_t operand = operands[o];
            if (is_placed(&program->nodes[operand]) && !scopes.is_open[scope_of[operand]] &&
                home_of[operand] == 0) {
                home_of[operand] = shader_add_node(program, SHADER_HOME, 0, operand, 0, 0);
                operands = shader_operands(program, &program->nodes[value],
                                           &operand_count); // the nodes may have moved
                kept++;
            }
        }
        follow(&scopes, op);
        scope_of[value] = scopes.stack[scopes.depth];
    }
    return kept;
}

void shader_keep_values(struct shader_program *program)
{
    struct shader_memory *const memory = program->memory;
    const uint32_t nodes = program->node_count, old_count = program->code_count;
    uint32_t *const scope_of = shader_take(memory, nodes, sizeof *scope_of);
    uint32_t *const home_of = shader_take(memory, nodes, sizeof *home_of);
    const uint32_t kept = find_kept(program, scope_of, home_of);
    if (kept == 0) {
        return;
    }
    uint32_t *const code = shader_take(memory, old_count + kept, sizeof *code);
    struct scopes scopes = {.is_open = shader_take(memory, old_count + 2, sizeof(bool))};
    uint32_t count = 0;
    scopes.is_open[0] = true;
    for (uint32_t i = 0; i < old_count; i++) {
        const uint32_t value = program->code[i];
        const uint16_t op = program->nodes[value].op;
        uint32_t operand_count;
        uint32_t *const operands = shader_operands(program, &program->nodes[value], &operand_count);
        for (uint32_t o = 0; o < operand_count; o++) {
            const uint32_t operand = operands[o];
            if (operand < nodes && home_of[operand] != 0 && !scopes.is_open[scope_of[operand]]) {
                operands[o] = home_of[operand];
            }
        }
        follow(&scopes, op);
        code[count++] = value;
        if (value < nodes && home_of[value] != 0) {
            code[count++] = shader_add_node(program, SHADER_SET, 0, home_of[value], value, 0);
        }
    }
    program->code = code;
    program->code_count = count;
    program->code_room = old_count + kept;
}
