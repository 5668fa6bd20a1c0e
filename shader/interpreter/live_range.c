// SPDX-License-Identifier: MIT
// See live_range.h.
//
// A value is kept from where it is computed to where it is last read. What is read in a loop that began behind it stays
// until the loop's end. Homes and the masks of structure are values that live from the outermost IF, REGION or LOOP
// around their first use to the end of the one around the last.
#include "live_range.h"

struct finder {
    struct shader_program *program;
    const struct shader_pairs *pairs;
    struct shader_live_range *ranges;  // by value
    uint32_t *outer_begin, *outer_end; // by place: of the outermost structure around it
};

static bool closes(uint16_t op)
{
    return op == SHADER_END_IF || op == SHADER_END_REGION || op == SHADER_END_LOOP;
}

static uint16_t op_at(const struct finder *finder, uint32_t place)
{
    return finder->program->nodes[finder->program->code[place]].op;
}

// Find the outermost structure around every place.
static void find_outermost(struct finder *finder)
{
    uint32_t depth = 0, begin = 0;
    for (uint32_t i = 0; i < finder->program->code_count; i++) {
        const uint16_t op = op_at(finder, i);
        begin = depth == 0 ? i : begin;
        depth += shader_opens(op) ? 1 : 0;
        finder->outer_begin[i] = begin;
        depth -= closes(op) ? 1 : 0;
    }
    uint32_t end = 0;
    for (uint32_t i = finder->program->code_count; i-- > 0;) {
        const uint16_t op = op_at(finder, i);
        end = depth == 0 ? i : end;
        depth += closes(op) ? 1 : 0;
        finder->outer_end[i] = end;
        depth -= shader_opens(op) ? 1 : 0;
    }
}

static void extend(struct shader_live_range *range, uint32_t place)
{
    range->begin = place < range->begin ? place : range->begin;
    range->end = place > range->end || range->end == SHADER_NEVER ? place : range->end;
}

static void read_at(struct finder *finder, uint32_t value, uint32_t place, const uint32_t *loops,
                    uint32_t depth, const uint32_t *loop_end)
{
    struct shader_live_range *const range = &finder->ranges[value];
    if (finder->program->nodes[value].op == SHADER_HOME) {
        extend(range, finder->outer_begin[place]);
        extend(range, finder->outer_end[place]);
        return;
    }
    for (uint32_t l = 0; l < depth; l++) {
        if (loops[l] > range->begin) {
            place = loop_end[loops[l]];
            break;
        }
    }
    extend(range, place);
}

bool shader_is_jump(const struct shader_program *program, uint32_t value)
{
    const struct shader_node *const nodes = program->nodes;
    return nodes[value].op == SHADER_IF &&
           (nodes[nodes[value].operands[0]].flags & SHADER_DYNAMICALLY_UNIFORM);
}

static void find_ranges(struct finder *finder)
{
    const struct shader_program *const program = finder->program;
    uint32_t *const loop_end = shader_take(program->memory, program->code_count + 1, sizeof *loop_end);
    uint32_t *const structure_end =
        shader_take(program->memory, program->code_count + 1, sizeof *structure_end);
    uint32_t stack[SHADER_MAX_DEPTH], depth = 0;
    for (uint32_t i = program->code_count; i-- > 0;) {
        const uint16_t op = op_at(finder, i);
        if (closes(op)) {
            stack[depth++] = i;
        } else if (shader_opens(op)) {
            structure_end[i] = stack[--depth];
            loop_end[i] = op == SHADER_LOOP ? structure_end[i] : i;
        }
    }
    uint32_t loops[SHADER_MAX_DEPTH], loop_depth = 0;
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        struct shader_node *const node = &program->nodes[value];
        const enum shader_op op = (enum shader_op)node->op;
        if (finder->pairs->is_taken[value]) {
            continue;
        }
        if (shader_op_has_result(op)) {
            extend(&finder->ranges[value], i);
        }
        uint32_t operand_count;
        uint32_t paired[3];
        const uint32_t *operands = shader_operands(program, node, &operand_count);
        if (shader_pair_at(finder->pairs, program, value, paired)) {
            operands = paired;
            operand_count = 3;
        }
        for (uint32_t o = 0; o < operand_count; o++) {
            read_at(finder, operands[o], i, loops, loop_depth, loop_end);
        }
        if (shader_opens(op) && !shader_is_jump(finder->program, value)) { // its masks
            extend(&finder->ranges[value], i);
            extend(&finder->ranges[value], structure_end[i]);
        }
        if (op == SHADER_IF && !shader_is_jump(finder->program, value)) {
            // The condition is read again by ELSE.
            read_at(finder, node->operands[0], structure_end[i], loops, loop_depth, loop_end);
        }
        if (op == SHADER_LOOP) {
            loops[loop_depth++] = i;
        } else if (op == SHADER_END_LOOP) {
            loop_depth--;
        }
    }
}

const struct shader_live_range *shader_find_live_ranges(struct shader_program *program,
                                                        const struct shader_pairs *pairs)
{
    struct shader_memory *const memory = program->memory;
    struct finder finder = {.program = program,
                            .pairs = pairs,
                            .ranges =
                                shader_take(memory, program->node_count, sizeof(struct shader_live_range)),
                            .outer_begin = shader_take(memory, program->code_count + 1, sizeof(uint32_t)),
                            .outer_end = shader_take(memory, program->code_count + 1, sizeof(uint32_t))};
    for (uint32_t value = 0; value < program->node_count; value++) {
        finder.ranges[value] = (struct shader_live_range){SHADER_NEVER, SHADER_NEVER};
    }
    find_outermost(&finder);
    find_ranges(&finder);
    return finder.ranges;
}
