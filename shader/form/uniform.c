// SPDX-License-Identifier: MIT
// See pass.h.
#include "pass.h"

static bool is_uniform_source(enum shader_op op)
{
    return op == SHADER_CONSTANT || op == SHADER_PUSH || op == SHADER_WORKGROUP;
}

bool shader_is_varying(enum shader_op op)
{
    return op == SHADER_INPUT || op == SHADER_INPUT_DX || op == SHADER_INPUT_DY ||
           op == SHADER_INPUT_BESIDE || op == SHADER_INPUT_BELOW || op == SHADER_INPUT_AT ||
           op == SHADER_BUILT_IN || op == SHADER_PRIVATE || op == SHADER_DDX || op == SHADER_DDY ||
           op == SHADER_ATOMIC || op == SHADER_IMAGE_ATOMIC || op == SHADER_SAMPLE || op == SHADER_BALLOT ||
           op == SHADER_SHUFFLE || op == SHADER_SCAN;
}

// After so many rounds what is still open counts as not uniform, so that no program takes them for every home it has.
enum { MAX_ROUNDS = 32 };

// Mark what is not uniform, in rounds: a home that is set in some lanes only, or to what differs, is not.
static void mark_varying(const struct shader_program *program, bool *varies)
{
    bool diverges[SHADER_MAX_DEPTH + 1];
    bool changed = true;
    for (int round = 0; changed && round < MAX_ROUNDS; round++) {
        uint32_t depth = 0;
        changed = false;
        diverges[0] = false;
        // Once lanes may have left, those behind may be some only, until what they left ends.
        for (uint32_t i = 0; i < program->code_count; i++) {
            const uint32_t value = program->code[i];
            struct shader_node *const node = &program->nodes[value];
            const enum shader_op op = (enum shader_op)node->op;
            switch (op) {
            case SHADER_IF:
                diverges[depth + 1] = diverges[depth] || varies[node->operands[0]];
                depth++;
                continue;
            case SHADER_REGION:
            case SHADER_LOOP:
                // Lanes leave on their own unless nothing in it diverges, which is found by what its IFs say.
                diverges[depth + 1] = diverges[depth] || varies[value];
                depth++;
                continue;
            case SHADER_END_IF:
            case SHADER_END_REGION:
            case SHADER_END_LOOP: depth--; continue;
            case SHADER_LEAVE:
                if (diverges[depth] && !varies[node->operands[0]]) {
                    varies[node->operands[0]] = changed = true;
                }
                continue;
            case SHADER_SET:
                if (!varies[node->operands[0]] && (diverges[depth] || varies[node->operands[1]])) {
                    varies[node->operands[0]] = changed = true;
                }
                continue;
            default: break;
            }
            bool is_varying = shader_is_varying(op);
            uint32_t operand_count;
            const uint32_t *const operands = shader_operands(program, node, &operand_count);
            for (uint32_t o = 0; !is_uniform_source(op) && o < operand_count; o++) {
                is_varying = is_varying || varies[operands[o]];
            }
            if (is_varying && !varies[value]) {
                varies[value] = changed = true;
            }
        }
    }
    for (uint32_t value = 0; changed && value < program->node_count; value++) {
        varies[value] = !is_uniform_source((enum shader_op)program->nodes[value].op);
    }
}

void shader_mark_uniform(struct shader_program *program)
{
    bool *const varies = shader_take(program->memory, program->node_count, sizeof *varies);
    for (uint32_t i = 0; i < program->node_count; i++) { // what stands in no code
        varies[i] = program->nodes[i].op == SHADER_PRIVATE;
    }
    mark_varying(program, varies);
    for (uint32_t i = 0; i < program->node_count; i++) {
        program->nodes[i].flags = varies[i] ? 0 : SHADER_UNIFORM;
    }
}

void shader_run_passes(struct shader_program *program)
{
    shader_remove_dead(program); // no derivative is made of what nothing reads
    shader_build_derivatives(program);
    shader_simplify(program);
    shader_share_values(program);
    shader_ask_for_gradients(program);
    shader_keep_values(program);
    shader_forward_copies(program);
    shader_remove_dead(program);
    shader_mark_uniform(program);
    shader_mark_dynamically_uniform(program);
}
