// SPDX-License-Identifier: MIT
// Derivatives. The derivative of an input is analytic. That of anything else is a difference in the 2×2 quad (Vulkan
// 1.3, "Derivative Operations"): what the value depends on is computed a second time, as it is at the partner pixel,
// which is (x ^ 1, y) for d/dx and (x, y ^ 1) for d/dy. Each lane does so for itself, so there are no helper lanes.
#include "pass.h"
#include "uses.h"

#define NONE UINT32_MAX

// One of the two directions.
struct direction {
    struct shader_program *program;
    enum shader_op derivative, beside; // DDX and INPUT_BESIDE, or those of y
    uint32_t axis;                     // 0: x, 1: y
    bool *is_needed;                   // by value: at the partner pixel
    bool *differs;                     // by value: at the partner pixel it may be another
    uint32_t *partner;                 // by value: its value there, or NONE
    uint32_t step;                     // 1 − 2 · (the pixel's number & 1), as a float; NONE: not made yet
    uint32_t *code;
    uint32_t count;
    size_t room;
};

static bool is_coordinate(const struct shader_node *node, uint32_t axis)
{
    return node->op == SHADER_BUILT_IN && node->immediate == SHADER_IN_COORD + axis;
}

// Values that were marked, and whose neighbours are still to be looked at.
struct worklist {
    bool *is_marked;
    uint32_t *todo;
    uint32_t count;
};

static void mark_value(struct worklist *list, uint32_t value)
{
    if (!list->is_marked[value]) {
        list->is_marked[value] = true;
        list->todo[list->count++] = value;
    }
}

// A derivative is one number for the whole quad, and an effect happens once.
static bool may_differ(const struct shader_node *node)
{
    return node->op != SHADER_DDX && node->op != SHADER_DDY && node->op != SHADER_ATOMIC &&
           node->op != SHADER_IMAGE_ATOMIC && (node->flags & SHADER_PER_QUAD) == 0;
}

// Mark values that may be others at the partner pixel.
static void mark_different(const struct direction *direction, const struct shader_uses *uses, uint32_t *todo)
{
    struct shader_program *const program = direction->program;
    struct worklist list = {direction->differs, todo, 0};
    for (uint32_t i = 0; i < program->code_count; i++) {
        const struct shader_node *const node = &program->nodes[program->code[i]];
        if (node->op == SHADER_INPUT || node->op == SHADER_INPUT_AT || is_coordinate(node, direction->axis)) {
            mark_value(&list, program->code[i]);
        }
    }
    while (list.count > 0) {
        const uint32_t value = list.todo[--list.count];
        for (uint32_t r = uses->first_reader[value]; r < uses->first_reader[value + 1]; r++) {
            const struct shader_node *const reader = &program->nodes[uses->readers[r]];
            if (may_differ(reader)) {
                mark_value(&list, shader_changed(program, uses->readers[r]));
            }
        }
    }
}

static void mark_operands(const struct direction *direction, struct worklist *list, uint32_t value)
{
    struct shader_program *const program = direction->program;
    uint32_t count;
    const uint32_t *const operands = shader_operands(program, &program->nodes[value], &count);
    for (uint32_t o = shader_changed(program, value) != value ? 1 : 0; o < count; o++) {
        if (direction->differs[operands[o]]) {
            mark_value(list, operands[o]);
        }
    }
}

// Mark those among them that derivatives need at the partner pixel.
static void mark_needed(const struct direction *direction, const struct shader_uses *uses, uint32_t *todo)
{
    struct shader_program *const program = direction->program;
    struct worklist list = {direction->is_needed, todo, 0};
    for (uint32_t i = 0; i < program->code_count; i++) {
        const struct shader_node *const node = &program->nodes[program->code[i]];
        const uint32_t operand = node->operands[0];
        if (node->op == direction->derivative && direction->differs[operand]) {
            mark_value(&list, operand);
        }
    }
    while (list.count > 0) {
        const uint32_t value = list.todo[--list.count];
        mark_operands(direction, &list, value);
        for (uint32_t s = uses->first_set[value]; s < uses->first_set[value + 1]; s++) {
            mark_operands(direction, &list, program->code[uses->sets[s]]);
        }
    }
}

static void mark(const struct direction *direction)
{
    const struct shader_program *const program = direction->program;
    uint32_t *const todo = shader_take(program->memory, program->node_count, sizeof *todo);
    struct shader_uses uses;
    shader_find_uses(program, &uses);
    mark_different(direction, &uses, todo);
    mark_needed(direction, &uses, todo);
}

static void put(struct direction *direction, uint32_t node)
{
    if (direction->count == direction->room) {
        direction->code = shader_grow(direction->program->memory, direction->code, &direction->room,
                                      sizeof *direction->code);
    }
    direction->code[direction->count++] = node;
}

static uint32_t add(struct direction *direction, enum shader_op op, uint32_t immediate, uint32_t a,
                    uint32_t b)
{
    const uint32_t node = shader_add_node(direction->program, op, immediate, a, b, 0);
    put(direction, node);
    return node;
}

// The value at the partner pixel.
static uint32_t there(const struct direction *direction, uint32_t value, uint32_t nodes)
{
    return value < nodes && direction->partner[value] != NONE ? direction->partner[value] : value;
}

// Compute a node as it is at the partner pixel.
static void put_partner(struct direction *direction, uint32_t value, uint32_t nodes)
{
    struct shader_program *const program = direction->program;
    struct shader_node node = program->nodes[value];
    if (node.op == SHADER_INPUT) {
        direction->partner[value] = add(direction, direction->beside, node.immediate, 0, 0);
        return;
    }
    if (is_coordinate(&node, direction->axis)) {
        direction->partner[value] = add(direction, SHADER_FADD, 0, value, direction->step);
        return;
    }
    if (node.op == SHADER_SET) {
        (void)add(direction, SHADER_SET, 0, there(direction, node.operands[0], nodes),
                  there(direction, node.operands[1], nodes));
        return;
    }
    if (node.op == SHADER_INPUT_AT) {
        uint32_t offset[2];
        for (uint32_t o = 0; o < 2; o++) {
            offset[o] = there(direction, node.operands[o], nodes);
        }
        offset[direction->axis] = add(direction, SHADER_FADD, 0, offset[direction->axis], direction->step);
        direction->partner[value] = add(direction, SHADER_INPUT_AT, node.immediate, offset[0], offset[1]);
        return;
    }
    uint32_t count;
    const uint32_t *const operands = shader_operands(program, &program->nodes[value], &count);
    if (node.op == SHADER_SAMPLE) {
        uint32_t values[SHADER_IMAGE_OPERANDS];
        for (uint32_t o = 0; o < count; o++) {
            values[o] = there(direction, operands[o], nodes);
        }
        node.operands[0] = shader_add_list(program, values, count);
    } else {
        for (uint32_t o = 0; o < count; o++) {
            node.operands[o] = there(direction, operands[o], nodes);
        }
    }
    const uint32_t copy = shader_add_node(program, (enum shader_op)node.op, node.immediate, node.operands[0],
                                          node.operands[1], node.operands[2]);
    put(direction, copy);
    direction->partner[value] = copy;
}

// A derivative is the difference to the partner pixel, in the direction of the axis.
static void put_derivative(struct direction *direction, uint32_t value, uint32_t nodes)
{
    struct shader_program *const program = direction->program;
    const uint32_t operand = program->nodes[value].operands[0];
    struct shader_node *const node = &program->nodes[value];
    if (!direction->differs[operand]) {
        *node = (struct shader_node){.op = SHADER_COPY, .operands = {0, 0, 0}}; // constant 0
        put(direction, value);
        return;
    }
    const uint32_t difference = add(direction, SHADER_FSUB, 0, there(direction, operand, nodes), operand);
    program->nodes[value] = (struct shader_node){
        .op = SHADER_FMUL, .flags = SHADER_PER_QUAD, .operands = {difference, direction->step, 0}};
    put(direction, value);
}

// The partner pixel lies a step to the right or down of pixels with an even number, and the other way of others.
static void put_step(struct direction *direction)
{
    struct shader_program *const program = direction->program;
    const uint32_t one = shader_add_node(program, SHADER_CONSTANT, 1, 0, 0, 0);
    const uint32_t unit = shader_add_node(program, SHADER_CONSTANT, 0x3f800000, 0, 0, 0);
    const uint32_t shift = shader_add_node(program, SHADER_CONSTANT, 31, 0, 0, 0);
    const uint32_t coordinate = add(direction, SHADER_BUILT_IN, SHADER_IN_COORD + direction->axis, 0, 0);
    const uint32_t pixel = add(direction, SHADER_INT_FROM_FLOAT, 0, coordinate, 0);
    const uint32_t odd = add(direction, SHADER_AND, 0, pixel, one);
    direction->step = add(direction, SHADER_OR, 0, add(direction, SHADER_SHIFT_LEFT, 0, odd, shift), unit);
}

// What homes and memory of the lane hold at the partner pixel has a place of its own. Return it, or NONE for others.
static uint32_t add_partner_of_variable(struct shader_program *program, uint32_t value)
{
    const struct shader_node node = program->nodes[value];
    if (node.op == SHADER_HOME) {
        return shader_add_node(program, SHADER_HOME, node.immediate, 0, 0, 0);
    }
    if (node.op == SHADER_PRIVATE) {
        const uint32_t first = program->private_count;
        program->private_count += node.operands[0];
        return shader_add_node(program, SHADER_PRIVATE, first, node.operands[0], 0, 0);
    }
    return NONE;
}

// Replace derivatives of inputs. Return true if there are others, which are differences.
static bool derive_inputs(struct shader_program *program, enum shader_op derivative, enum shader_op analytic)
{
    bool has_others = false;
    for (uint32_t i = 0; i < program->code_count; i++) {
        struct shader_node *const node = &program->nodes[program->code[i]];
        if (node->op != derivative) {
            continue;
        }
        const struct shader_node *const operand = &program->nodes[node->operands[0]];
        if (operand->op == SHADER_INPUT) {
            *node = (struct shader_node){.op = (uint16_t)analytic, .immediate = operand->immediate};
        } else {
            has_others = true;
        }
    }
    return has_others;
}

static void differentiate(struct shader_program *program, enum shader_op derivative, enum shader_op analytic,
                          enum shader_op beside, uint32_t axis)
{
    const uint32_t nodes = program->node_count, old_count = program->code_count;
    struct shader_memory *const memory = program->memory;
    if (!derive_inputs(program, derivative, analytic)) {
        return;
    }
    struct direction direction = {.program = program,
                                  .derivative = derivative,
                                  .beside = beside,
                                  .axis = axis,
                                  .is_needed = shader_take(memory, nodes, sizeof(bool)),
                                  .differs = shader_take(memory, nodes, sizeof(bool)),
                                  .partner = shader_take(memory, nodes, sizeof(uint32_t)),
                                  .step = NONE};
    mark(&direction);
    bool needs_any = false;
    for (uint32_t value = 0; value < nodes; value++) {
        direction.partner[value] = NONE;
        needs_any = needs_any || direction.is_needed[value];
        if (direction.is_needed[value]) {
            direction.partner[value] = add_partner_of_variable(program, value);
        }
    }
    if (needs_any) {
        put_step(&direction);
    }
    const uint32_t *const old = program->code;
    for (uint32_t i = 0; i < old_count; i++) {
        const uint32_t value = old[i];
        const uint16_t op = program->nodes[value].op;
        const uint32_t home = shader_changed(program, value);
        if (op == derivative) {
            put_derivative(&direction, value, nodes);
            continue;
        }
        // What is sampled and its parts stay together.
        uint32_t end = i + 1;
        while (op == SHADER_SAMPLE && end < old_count && program->nodes[old[end]].op == SHADER_PART) {
            end++;
        }
        for (uint32_t k = i; k < end; k++) {
            put(&direction, old[k]);
        }
        for (uint32_t k = i; k < end; k++) {
            if (direction.is_needed[k == i ? home : old[k]]) {
                put_partner(&direction, old[k], nodes);
            }
        }
        i = end - 1;
    }
    program->code = direction.code;
    program->code_count = direction.count;
    program->code_room = direction.room;
}

void shader_build_derivatives(struct shader_program *program)
{
    differentiate(program, SHADER_DDX, SHADER_INPUT_DX, SHADER_INPUT_BESIDE, 0);
    differentiate(program, SHADER_DDY, SHADER_INPUT_DY, SHADER_INPUT_BELOW, 1);
}
