// SPDX-License-Identifier: MIT
// See pass.h.
#include "pass.h"
#include "uses.h"

// A copy may be read as its home where the home is not set from the copy to its last reader. A reader in a loop that
// began behind the copy reads in every round, so then the whole loop counts.

// For each copy: where it stands, the last place where it is read, and where homes are set.
struct copies {
    uint32_t *place;     // by value: number in the code, plus 1
    uint32_t *last_read; // by value: number in the code
    struct shader_uses uses;
};

static void find_readers(const struct shader_program *program, struct copies *copies)
{
    // Begin and end of the loops that are open.
    uint32_t *const loop_end = shader_take(program->memory, program->code_count + 1, sizeof *loop_end);
    uint32_t stack[SHADER_MAX_DEPTH], depth = 0;
    for (uint32_t i = program->code_count; i-- > 0;) {
        const uint16_t op = program->nodes[program->code[i]].op;
        if (op == SHADER_END_LOOP) {
            stack[depth++] = i;
        } else if (op == SHADER_LOOP) {
            loop_end[i] = stack[--depth];
        }
    }
    uint32_t conditions[SHADER_MAX_DEPTH], condition_count = 0;
    depth = 0;
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        struct shader_node *const node = &program->nodes[value];
        const enum shader_op op = (enum shader_op)node->op;
        copies->place[value] = i + 1;
        // The condition is read again by ELSE.
        if (op == SHADER_IF) {
            conditions[condition_count++] = node->operands[0];
        } else if (op == SHADER_ELSE && copies->last_read[conditions[condition_count - 1]] < i) {
            copies->last_read[conditions[condition_count - 1]] = i;
        } else if (op == SHADER_END_IF) {
            condition_count--;
        }
        uint32_t operand_count;
        const uint32_t *const operands = shader_operands(program, node, &operand_count);
        for (uint32_t o = 0; o < operand_count; o++) {
            const uint32_t operand = operands[o];
            uint32_t at = i;
            // The outermost loop that began behind the operand.
            for (uint32_t l = 0; l < depth; l++) {
                if (stack[l] + 1 > copies->place[operand]) {
                    at = loop_end[stack[l]];
                    break;
                }
            }
            copies->last_read[operand] = at > copies->last_read[operand] ? at : copies->last_read[operand];
        }
        if (op == SHADER_LOOP) {
            stack[depth++] = i;
        } else if (op == SHADER_END_LOOP) {
            depth--;
        }
    }
}

// Return true if a home is set behind place `from`, up to place `to`.
static bool is_set_between(const struct copies *copies, uint32_t home, uint32_t from, uint32_t to)
{
    const uint32_t end = copies->uses.first_set[home + 1];
    uint32_t low = copies->uses.first_set[home], high = end;
    while (low < high) { // the first that stands behind `from`
        const uint32_t middle = (low + high) / 2;
        if (copies->uses.sets[middle] <= from) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < end && copies->uses.sets[low] <= to;
}

void shader_forward_copies(struct shader_program *program)
{
    struct shader_memory *const memory = program->memory;
    struct copies copies = {.place = shader_take(memory, program->node_count, sizeof(uint32_t)),
                            .last_read = shader_take(memory, program->node_count, sizeof(uint32_t))};
    uint32_t *const stands_for = shader_take(memory, program->node_count, sizeof *stands_for);
    shader_find_sets(program, &copies.uses);
    find_readers(program, &copies);
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        struct shader_node *const node = &program->nodes[value];
        const enum shader_op op = (enum shader_op)node->op;
        uint32_t operand_count;
        uint32_t *const operands = shader_operands(program, node, &operand_count);
        for (uint32_t o = 0; o < operand_count; o++) {
            const uint32_t other = stands_for[operands[o]];
            operands[o] = other != 0 ? other : operands[o];
        }
        // A SET that reads the home at the place of the last reader reads before it writes.
        if (op == SHADER_COPY) {
            const uint32_t last = copies.last_read[value];
            const bool last_sets = last > 0 && program->nodes[program->code[last]].op == SHADER_SET;
            if (!is_set_between(&copies, node->operands[0], i, last_sets ? last - 1 : last)) {
                stands_for[value] = node->operands[0];
            }
        }
    }
}
