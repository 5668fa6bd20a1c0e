// SPDX-License-Identifier: MIT
// See form.h.
#include "form.h"

#define OP(name, operands, kind) {#name, operands, SHADER_KIND_##kind},
const struct shader_op_description shader_ops[SHADER_OP_COUNT] = {
#include "op.inc"
};
#undef OP

uint32_t shader_add_node(struct shader_program *program, enum shader_op op, uint32_t immediate, uint32_t a,
                         uint32_t b, uint32_t c)
{
    if (program->node_count >= SHADER_MAX_NODES) {
        shader_refuse(program->module, 0,
                      "the shader has more than %d operations after its calls are put in their places",
                      SHADER_MAX_NODES);
    }
    if (program->node_count == program->node_room) {
        size_t room = program->node_room;
        program->origins = shader_grow(program->memory, program->origins, &room, sizeof *program->origins);
        program->nodes =
            shader_grow(program->memory, program->nodes, &program->node_room, sizeof *program->nodes);
    }
    program->nodes[program->node_count] =
        (struct shader_node){.op = (uint16_t)op, .immediate = immediate, .operands = {a, b, c}};
    return program->node_count++;
}

uint32_t shader_add_constant(struct shader_program *program, uint32_t bits)
{
    enum { BUCKETS = 1024, MAX_LOOKED_AT = 32 };
    if (!program->constant_buckets) {
        program->constant_buckets = shader_take(program->memory, BUCKETS, sizeof(uint32_t));
    }
    uint32_t *const bucket = &program->constant_buckets[(bits * 2654435761u) >> 22];
    uint32_t looked_at = 0;
    // Constants that were chosen to fall into one bucket are not all compared: equal ones may then be two nodes.
    for (uint32_t node = *bucket; node != 0 && looked_at < MAX_LOOKED_AT; looked_at++) {
        if (program->nodes[node - 1].immediate == bits) {
            return node - 1;
        }
        node = program->nodes[node - 1].operands[0];
    }
    const uint32_t node = shader_add_node(program, SHADER_CONSTANT, bits, *bucket, 0, 0);
    *bucket = node + 1;
    return node;
}

uint32_t shader_changed(const struct shader_program *program, uint32_t value)
{
    const struct shader_node *const node = &program->nodes[value];
    const bool is_own = node->op == SHADER_STORE && program->nodes[node->operands[0]].op == SHADER_PRIVATE;
    return node->op == SHADER_SET || is_own ? node->operands[0] : value;
}

const struct shader_node *shader_resource_node(const struct shader_program *program, uint32_t value)
{
    const struct shader_node *const node = &program->nodes[value];
    return node->op == SHADER_HOME ? &program->nodes[node->operands[0]] : node;
}

uint32_t shader_add_list(struct shader_program *program, const uint32_t *values, uint32_t count)
{
    const uint32_t place = program->list_count;
    for (uint32_t i = 0; i <= count; i++) {
        if (program->list_count == program->list_room) {
            program->lists =
                shader_grow(program->memory, program->lists, &program->list_room, sizeof *program->lists);
        }
        program->lists[program->list_count++] = i == 0 ? count : values[i - 1];
    }
    return place;
}
