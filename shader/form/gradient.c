// SPDX-License-Identifier: MIT
// Gradients that no sampler reads. A shadow map has one level, and so have pictures that earlier passes drew, but their
// coordinates are computed, so that derivative.c computes them twice more. What nothing but gradients need stands
// behind a question to the texture and the sampler that are bound. Where they do not need it, the gradient is 0.
#include "pass.h"
#include "uses.h"

enum {
    WORTH_A_JUMP = 12, // operations that are left out
    MOST_PAIRS = 64,   // further ones are not asked for, so that time grows with the code alone
    NOBODY = 0
};

// A texture with its sampler, which may be one resource.
struct pair {
    uint32_t texture, sampler; // BUFFERs
    uint32_t is_needed;        // truth, or NOBODY where it was not asked for in structure that is open
};

struct gradients {
    struct shader_program *program;
    struct pair pairs[MOST_PAIRS];
    uint32_t pair_count;
    uint32_t *owner; // by value: the pair whose gradients alone need it, counted from 1, or NOBODY
    uint32_t *code;
    uint32_t count;
    size_t room;
    uint32_t *waiting; // values with an owner that are not placed yet
    uint32_t waiting_count;
    // BUFFERs of pairs in structure that is open, in the order in which they came.
    uint32_t named[2 * MOST_PAIRS];
    uint32_t named_count;
    uint32_t marks[SHADER_MAX_DEPTH + 1]; // their number where each open structure began
    uint32_t depth;
};

static void put(struct gradients *gradients, uint32_t value)
{
    if (gradients->count == gradients->room) {
        gradients->code = shader_grow(gradients->program->memory, gradients->code, &gradients->room,
                                      sizeof *gradients->code);
    }
    gradients->code[gradients->count++] = value;
}

// All lanes name one binding.
static bool is_one_binding(const struct shader_program *program, uint32_t buffer)
{
    const struct shader_node *const node = &program->nodes[buffer];
    return node->op == SHADER_BUFFER && program->nodes[node->operands[0]].op == SHADER_CONSTANT;
}

// Return the pair that a SAMPLE with a gradient reads, counted from 1, or NOBODY for other nodes.
static uint32_t pair_of(struct gradients *gradients, uint32_t value)
{
    struct shader_program *const program = gradients->program;
    struct shader_node *const node = &program->nodes[value];
    const uint32_t fields = 15 | SHADER_IMAGE_HAS_GRADIENT | SHADER_IMAGE_HAS_LEAST_LOD;
    if (node->op != SHADER_SAMPLE ||
        (node->immediate & fields) != (SHADER_DO_SAMPLE | SHADER_IMAGE_HAS_GRADIENT)) {
        return NOBODY;
    }
    uint32_t count;
    const uint32_t *const operands = shader_operands(program, node, &count);
    const uint32_t texture = operands[SHADER_IMAGE_TEXTURE];
    const uint32_t sampler =
        node->immediate & SHADER_IMAGE_HAS_SAMPLER ? operands[SHADER_IMAGE_SAMPLER] : texture;
    for (uint32_t p = 0; p < gradients->pair_count; p++) {
        if (gradients->pairs[p].texture == texture && gradients->pairs[p].sampler == sampler) {
            return p + 1;
        }
    }
    if (gradients->pair_count == MOST_PAIRS || !is_one_binding(program, texture) ||
        !is_one_binding(program, sampler)) {
        return NOBODY;
    }
    gradients->pairs[gradients->pair_count++] = (struct pair){.texture = texture, .sampler = sampler};
    return gradients->pair_count;
}

// A value that is the same at every place of its block behind its operands.
static bool is_movable(const struct shader_program *program, const struct shader_node *node)
{
    const enum shader_op op = (enum shader_op)node->op;
    if (op == SHADER_INPUT || op == SHADER_INPUT_DX || op == SHADER_INPUT_DY || op == SHADER_INPUT_BESIDE ||
        op == SHADER_INPUT_BELOW || op == SHADER_BUILT_IN) {
        return true;
    }
    if (shader_op_kind_of(op) != SHADER_KIND_VALUE || op == SHADER_BUFFER || op == SHADER_PART) {
        return false;
    }
    for (int o = 0; o < shader_op_operands(op); o++) {
        if (program->nodes[node->operands[o]].op == SHADER_HOME) {
            return false;
        }
    }
    return shader_op_operands(op) > 0;
}

static bool is_among(const uint32_t *values, uint32_t count, uint32_t value)
{
    for (uint32_t i = 0; i < count; i++) {
        if (values[i] == value) {
            return true;
        }
    }
    return false;
}

// Return the pair for whose gradients a reader needs a value.
static uint32_t owner_by(struct gradients *gradients, uint32_t reader, uint32_t value)
{
    const uint32_t pair = pair_of(gradients, reader);
    if (pair == NOBODY) {
        return gradients->owner[reader];
    }
    uint32_t count;
    const uint32_t *const operands =
        shader_operands(gradients->program, &gradients->program->nodes[reader], &count);
    const bool is_more = is_among(operands, SHADER_IMAGE_DX, value) ||
                         is_among(operands + SHADER_IMAGE_OFFSET, count - SHADER_IMAGE_OFFSET, value);
    return is_more ? NOBODY : pair;
}

static void find_owners(struct gradients *gradients)
{
    struct shader_program *const program = gradients->program;
    struct shader_uses uses;
    shader_find_uses(program, &uses);
    for (uint32_t i = program->code_count; i-- > 0;) {
        const uint32_t value = program->code[i];
        if (!is_movable(program, &program->nodes[value])) {
            continue;
        }
        uint32_t owner = NOBODY;
        for (uint32_t r = uses.first_reader[value]; r < uses.first_reader[value + 1]; r++) {
            const uint32_t other = owner_by(gradients, uses.readers[r], value);
            if (other == NOBODY || (owner != NOBODY && owner != other)) {
                owner = NOBODY;
                break;
            }
            owner = other;
        }
        gradients->owner[value] = owner;
    }
}

// Place what waits for a pair, behind a question where it is much.
static void place_waiting(struct gradients *gradients, uint32_t pair)
{
    struct shader_program *const program = gradients->program;
    const uint32_t is_needed = gradients->pairs[pair - 1].is_needed;
    uint32_t ours = 0, left = 0;
    for (uint32_t i = 0; i < gradients->waiting_count; i++) {
        ours += gradients->owner[gradients->waiting[i]] == pair ? 1 : 0;
    }
    const bool asks = is_needed != NOBODY && ours >= WORTH_A_JUMP && gradients->depth < SHADER_MAX_NESTING;
    if (asks) {
        put(gradients, shader_add_node(program, SHADER_IF, 0, is_needed, 0, 0));
    }
    for (uint32_t i = 0; i < gradients->waiting_count; i++) {
        const uint32_t value = gradients->waiting[i];
        if (gradients->owner[value] == pair) {
            put(gradients, value);
        } else {
            gradients->waiting[left++] = value;
        }
    }
    gradients->waiting_count = left;
    if (asks) {
        put(gradients, shader_add_node(program, SHADER_END_IF, 0, 0, 0, 0));
    }
}

// Ask as soon as both resources are named.
static void name_buffer(struct gradients *gradients, uint32_t buffer)
{
    for (uint32_t p = 0; p < gradients->pair_count; p++) {
        struct pair *const pair = &gradients->pairs[p];
        if (pair->texture != buffer && pair->sampler != buffer) {
            continue;
        }
        if (!is_among(gradients->named, gradients->named_count, buffer)) {
            gradients->named[gradients->named_count++] = buffer;
        }
        if (is_among(gradients->named, gradients->named_count, pair->texture) &&
            is_among(gradients->named, gradients->named_count, pair->sampler)) {
            pair->is_needed = shader_add_node(gradients->program, SHADER_NEEDS_GRADIENT, 0, pair->texture,
                                              pair->sampler, 0);
            put(gradients, pair->is_needed);
        }
    }
}

// Where structure ends, what it named is gone.
static void follow(struct gradients *gradients, enum shader_op op)
{
    const bool closes = op == SHADER_END_IF || op == SHADER_END_REGION || op == SHADER_END_LOOP;
    if (closes || op == SHADER_ELSE) {
        gradients->named_count = gradients->marks[gradients->depth];
        for (uint32_t p = 0; p < gradients->pair_count; p++) {
            struct pair *const pair = &gradients->pairs[p];
            if (!is_among(gradients->named, gradients->named_count, pair->texture) ||
                !is_among(gradients->named, gradients->named_count, pair->sampler)) {
                pair->is_needed = NOBODY;
            }
        }
    }
    gradients->depth -= closes ? 1 : 0;
    if (shader_opens(op)) {
        gradients->marks[++gradients->depth] = gradients->named_count;
    }
}

void shader_ask_for_gradients(struct shader_program *program)
{
    struct shader_memory *const memory = program->memory;
    const uint32_t nodes = program->node_count, *const old = program->code, old_count = program->code_count;
    struct gradients gradients = {.program = program,
                                  .owner = shader_take(memory, nodes, sizeof(uint32_t)),
                                  .waiting = shader_take(memory, old_count + 1, sizeof(uint32_t))};
    find_owners(&gradients);
    if (gradients.pair_count == 0) {
        return;
    }
    for (uint32_t i = 0; i < old_count; i++) {
        const uint32_t value = old[i];
        const enum shader_op op = (enum shader_op)program->nodes[value].op;
        if (gradients.owner[value] != NOBODY) {
            gradients.waiting[gradients.waiting_count++] = value;
            continue;
        }
        const bool is_flow = shader_op_kind_of(op) == SHADER_KIND_FLOW;
        const uint32_t pair = pair_of(&gradients, value);
        for (uint32_t p = 1; p <= gradients.pair_count; p++) {
            if (is_flow || p == pair) {
                place_waiting(&gradients, p);
            }
        }
        put(&gradients, value);
        follow(&gradients, op);
        if (op == SHADER_BUFFER) {
            name_buffer(&gradients, value);
        }
    }
    program->code = gradients.code;
    program->code_count = gradients.count;
    program->code_room = gradients.room;
}
