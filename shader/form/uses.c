// SPDX-License-Identifier: MIT
// See uses.h.
#include "uses.h"

// Count where entries begin: make of the number of entries of each value the place of its first.
static void add_up(uint32_t *counts, uint32_t values)
{
    uint32_t sum = 0;
    for (uint32_t value = 0; value <= values; value++) {
        const uint32_t count = counts[value];
        counts[value] = sum;
        sum += count;
    }
}

// Count the uses, or, in a second round, write them down where they begin by then.
static void walk(const struct shader_program *program, struct shader_uses *uses, bool writes)
{
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        struct shader_node *const node = &program->nodes[value];
        const bool is_set = shader_changed(program, value) != value;
        uint32_t count;
        const uint32_t *const operands = shader_operands(program, node, &count);
        if (is_set && writes) {
            uses->sets[uses->first_set[operands[0]]] = i;
        }
        if (is_set) {
            uses->first_set[operands[0]]++;
        }
        for (uint32_t o = is_set ? 1 : 0; o < count; o++) {
            if (writes) {
                uses->readers[uses->first_reader[operands[o]]] = value;
            }
            uses->first_reader[operands[o]]++;
        }
    }
}

// Behind the second round the entries of a value begin where those of the value before end.
static void move_up(uint32_t *firsts, uint32_t values)
{
    for (uint32_t value = values; value > 0; value--) {
        firsts[value] = firsts[value - 1];
    }
    firsts[0] = 0;
}

void shader_find_uses(const struct shader_program *program, struct shader_uses *uses)
{
    struct shader_memory *const memory = program->memory;
    const uint32_t values = program->node_count;
    uses->first_reader = shader_take(memory, values + 1, sizeof(uint32_t));
    uses->first_set = shader_take(memory, values + 1, sizeof(uint32_t));
    walk(program, uses, false);
    add_up(uses->first_reader, values);
    add_up(uses->first_set, values);
    uses->readers = shader_take(memory, uses->first_reader[values], sizeof(uint32_t));
    uses->sets = shader_take(memory, uses->first_set[values], sizeof(uint32_t));
    walk(program, uses, true);
    move_up(uses->first_reader, values);
    move_up(uses->first_set, values);
}
