// SPDX-License-Identifier: MIT
// See pass.h.
#include "pass.h"

// Mark what effects read, from the end to the beginning. A SET counts where its home is read anywhere, so rounds go on
// until nothing new is found.
static void mark(const struct shader_program *program, bool *is_read)
{
    for (bool found = true; found;) {
        found = false;
        for (uint32_t i = program->code_count; i-- > 0;) {
            const uint32_t value = program->code[i];
            struct shader_node *const node = &program->nodes[value];
            const enum shader_op op = (enum shader_op)node->op;
            const enum shader_op_kind kind = shader_op_kind_of(op);
            const bool counts =
                op == SHADER_SET ? is_read[node->operands[0]]
                                 : kind == SHADER_KIND_EFFECT || kind == SHADER_KIND_FLOW || is_read[value];
            uint32_t operand_count;
            const uint32_t *const operands = shader_operands(program, node, &operand_count);
            for (uint32_t o = op == SHADER_SET ? 1 : 0; counts && o < operand_count; o++) {
                found = found || !is_read[operands[o]];
                is_read[operands[o]] = true;
            }
        }
    }
}

static bool is_empty_pair(const struct shader_program *program, uint32_t before, uint32_t now)
{
    const uint16_t first = program->nodes[before].op, second = program->nodes[now].op;
    return (first == SHADER_IF && second == SHADER_END_IF) ||
           (first == SHADER_REGION && second == SHADER_END_REGION);
}

// Take out what is not read, ELSE with nothing behind it, IF and REGION with nothing in them, and REGIONs that nothing
// leaves. Return true if something went.
static bool sweep(struct shader_program *program, const bool *is_read)
{
    uint32_t count = 0, depth = 0;
    bool *const is_plain = shader_take(program->memory, program->code_count + 1, sizeof *is_plain);
    const uint32_t old = program->code_count;
    for (uint32_t i = 0; i < old; i++) {
        const uint32_t value = program->code[i];
        const struct shader_node *const node = &program->nodes[value];
        const enum shader_op_kind kind = shader_op_kind_of((enum shader_op)node->op);
        const bool is_value = kind == SHADER_KIND_VALUE || kind == SHADER_KIND_READ;
        if ((is_value && !is_read[value]) || (node->op == SHADER_SET && !is_read[node->operands[0]])) {
            continue;
        }
        if (node->op == SHADER_REGION) {
            is_plain[depth++] = node->immediate == 0;
            if (node->immediate == 0) {
                continue;
            }
        } else if (node->op == SHADER_END_REGION && is_plain[--depth]) {
            continue;
        }
        if (count > 0 && node->op == SHADER_END_IF &&
            program->nodes[program->code[count - 1]].op == SHADER_ELSE) {
            count--;
        }
        if (count > 0 && is_empty_pair(program, program->code[count - 1], value)) {
            count--;
            continue;
        }
        program->code[count++] = value;
    }
    program->code_count = count;
    return count != old;
}

void shader_remove_dead(struct shader_program *program)
{
    bool *const is_read = shader_take(program->memory, program->node_count, sizeof *is_read);
    mark(program, is_read);
    while (sweep(program, is_read)) {
    }
}
