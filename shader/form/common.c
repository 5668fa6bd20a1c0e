// SPDX-License-Identifier: MIT
// Values that were computed before from the same operands, in structure that is still open, are there in all lanes that
// ask again.
#include "pass.h"

enum { BUCKETS = 1024, MAX_LOOKED_AT = 32 };

// Values that are there, by hash. Those of structure that has ended are taken out, the last first.
struct available {
    struct shader_program *program;
    uint32_t *buckets; // value, plus 1
    uint32_t *next;    // by value: the one behind it in its bucket, plus 1
    uint32_t *stack;   // values in the order in which they came
    uint32_t count;
    uint32_t marks[SHADER_MAX_DEPTH + 1]; // their number where each open structure began
    uint32_t depth;
};

// Memory that nothing writes to while the shader runs.
static bool is_constant_memory(const struct shader_program *program, uint32_t buffer)
{
    const struct shader_node *const node = &program->nodes[buffer];
    if (node->op != SHADER_BUFFER) {
        return node->op == SHADER_PUSH || node->op == SHADER_TABLE;
    }
    const struct shader_resource *const resource = &program->resources[node->immediate];
    return resource->variable->storage == SPIRV_UNIFORM && !resource->type->is_buffer_block;
}

// Return true if the same operands give the same value at all places.
static bool is_shared(const struct shader_program *program, const struct shader_node *node)
{
    switch (node->op) {
    case SHADER_PART: // it follows what is sampled
    case SHADER_CONSTANT:
    case SHADER_HOME: return false;
    case SHADER_INPUT:
    case SHADER_INPUT_DX:
    case SHADER_INPUT_DY:
    case SHADER_INPUT_BESIDE:
    case SHADER_INPUT_BELOW:
    case SHADER_INPUT_AT:
    case SHADER_SAMPLE_X:
    case SHADER_SAMPLE_Y:
    case SHADER_BUILT_IN: return true;
    case SHADER_LOAD: return is_constant_memory(program, node->operands[0]);
    default: return shader_op_kind_of((enum shader_op)node->op) == SHADER_KIND_VALUE;
    }
}

static bool is_equal(const struct shader_node *a, const struct shader_node *b)
{
    bool result = a->op == b->op && a->immediate == b->immediate;
    for (int o = 0; o < shader_op_operands((enum shader_op)a->op); o++) {
        result = result && a->operands[o] == b->operands[o];
    }
    return result;
}

static uint32_t *bucket_of(const struct available *available, const struct shader_node *node)
{
    uint32_t hash = node->op * 31u + node->immediate;
    for (int o = 0; o < shader_op_operands((enum shader_op)node->op); o++) {
        hash = (hash ^ node->operands[o]) * 2654435761u;
        hash ^= hash >> 15;
    }
    return &available->buckets[hash % BUCKETS];
}

// Return a value that is there and equal to this one, or the value itself, which is there from now on.
static uint32_t find(struct available *available, uint32_t value)
{
    const struct shader_node *const nodes = available->program->nodes;
    uint32_t *const bucket = bucket_of(available, &nodes[value]);
    int looked_at = 0;
    for (uint32_t other = *bucket; other != 0 && looked_at < MAX_LOOKED_AT; looked_at++) {
        if (is_equal(&nodes[other - 1], &nodes[value])) {
            return other - 1;
        }
        other = available->next[other - 1];
    }
    available->next[value] = *bucket;
    *bucket = value + 1;
    available->stack[available->count++] = value;
    return value;
}

// Where structure begins and ends.
static void follow(struct available *available, uint16_t op)
{
    const bool opens = op == SHADER_IF || op == SHADER_REGION || op == SHADER_LOOP;
    const bool closes = op == SHADER_END_IF || op == SHADER_END_REGION || op == SHADER_END_LOOP;
    if (closes || op == SHADER_ELSE) {
        const uint32_t mark = available->marks[available->depth];
        while (available->count > mark) {
            const uint32_t value = available->stack[--available->count];
            *bucket_of(available, &available->program->nodes[value]) = available->next[value];
        }
    }
    available->depth -= closes ? 1 : 0;
    if (opens) {
        available->marks[++available->depth] = available->count;
    }
}

void shader_share_values(struct shader_program *program)
{
    struct shader_memory *const memory = program->memory;
    struct available available = {.program = program,
                                  .buckets = shader_take(memory, BUCKETS, sizeof(uint32_t)),
                                  .next = shader_take(memory, program->node_count, sizeof(uint32_t)),
                                  .stack = shader_take(memory, program->node_count, sizeof(uint32_t))};
    uint32_t *const stands_for = shader_take(memory, program->node_count, sizeof *stands_for);
    const uint32_t old_count = program->code_count;
    program->code_count = 0;
    for (uint32_t i = 0; i < old_count; i++) {
        const uint32_t value = program->code[i];
        struct shader_node *const node = &program->nodes[value];
        uint32_t count;
        uint32_t *const operands = shader_operands(program, node, &count);
        for (uint32_t o = 0; o < count; o++) {
            operands[o] = stands_for[operands[o]] != 0 ? stands_for[operands[o]] - 1 : operands[o];
        }
        follow(&available, node->op);
        const uint32_t other = is_shared(program, node) ? find(&available, value) : value;
        if (other != value) {
            stands_for[value] = other + 1;
        } else {
            program->code[program->code_count++] = value;
        }
    }
}
