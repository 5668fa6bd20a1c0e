// SPDX-License-Identifier: MIT
// See pass.h.
#include "pass.h"
#include "uses.h"

// Values that are read, and those of them whose operands are still to be marked.
struct marks {
    bool *is_read;
    uint32_t *todo;
    uint32_t count;
};

static void mark_read(struct marks *marks, uint32_t value)
{
    if (!marks->is_read[value]) {
        marks->is_read[value] = true;
        marks->todo[marks->count++] = value;
    }
}

static void mark_operands(const struct shader_program *program, struct marks *marks, uint32_t value)
{
    uint32_t count;
    const uint32_t *const operands = shader_operands(program, &program->nodes[value], &count);
    for (uint32_t o = shader_changed(program, value) != value ? 1 : 0; o < count; o++) {
        mark_read(marks, operands[o]);
    }
}

// Mark what effects and structure read, and what that reads. A SET counts where its home is read
// anywhere, and a STORE to a PRIVATE where that is.
static void mark(const struct shader_program *program, struct marks *marks)
{
    struct shader_uses uses;
    shader_find_sets(program, &uses);
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        const enum shader_op op = (enum shader_op)program->nodes[value].op;
        const enum shader_op_kind kind = shader_op_kind_of(op);
        if (shader_changed(program, value) == value &&
            (kind == SHADER_KIND_EFFECT || kind == SHADER_KIND_FLOW)) {
            mark_operands(program, marks, value);
        }
    }
    while (marks->count > 0) {
        const uint32_t value = marks->todo[--marks->count];
        mark_operands(program, marks, value);
        for (uint32_t s = uses.first_set[value]; s < uses.first_set[value + 1]; s++) {
            mark_operands(program, marks, program->code[uses.sets[s]]);
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
        const uint32_t changed = shader_changed(program, value);
        if ((is_value && !is_read[value]) || (changed != value && !is_read[changed])) {
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
    struct marks marks = {.is_read = shader_take(program->memory, program->node_count, sizeof(bool)),
                          .todo = shader_take(program->memory, program->node_count, sizeof(uint32_t))};
    mark(program, &marks);
    while (sweep(program, marks.is_read)) {
    }
}
