// SPDX-License-Identifier: MIT
// See form.h.
#include "form.h"

struct op_description {
    const char *name;
    int operands;
    enum shader_op_kind kind;
};

#define OP(name, operands, kind) {#name, operands, SHADER_KIND_##kind},
static const struct op_description descriptions[] = {
#include "op.inc"
};
#undef OP

const char *shader_op_name(enum shader_op op)
{
    return descriptions[op].name;
}

int shader_op_operands(enum shader_op op)
{
    return descriptions[op].operands;
}

enum shader_op_kind shader_op_kind_of(enum shader_op op)
{
    return descriptions[op].kind;
}

bool shader_op_has_list(enum shader_op op)
{
    return op == SHADER_SAMPLE || op == SHADER_IMAGE_STORE || op == SHADER_ATOMIC ||
           op == SHADER_IMAGE_ATOMIC;
}

bool shader_op_has_result(enum shader_op op)
{
    const enum shader_op_kind kind = shader_op_kind_of(op);
    return kind == SHADER_KIND_VALUE || kind == SHADER_KIND_READ || op == SHADER_ATOMIC ||
           op == SHADER_IMAGE_ATOMIC;
}

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

uint32_t *shader_operands(const struct shader_program *program, struct shader_node *node, uint32_t *count)
{
    const enum shader_op op = (enum shader_op)node->op;
    if (shader_op_has_list(op)) {
        *count = program->lists[node->operands[0]];
        return &program->lists[node->operands[0] + 1];
    }
    *count = op == SHADER_LEAVE ? 0 : (uint32_t)shader_op_operands(op);
    return node->operands;
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
