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

// Count the SETs of homes and the STOREs to memory of the lane, or, in a second round, write them down where they
// begin by then.
static void walk_sets(const struct shader_program *program, struct shader_uses *uses, bool writes)
{
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t changed = shader_changed(program, program->code[i]);
        if (changed == program->code[i]) {
            continue;
        }
        if (writes) {
            uses->sets[uses->first_set[changed]] = i;
        }
        uses->first_set[changed]++;
    }
}

// Count the readers of values, or, in a second round, write them down.
static void walk_readers(const struct shader_program *program, struct shader_uses *uses, bool writes)
{
    for (uint32_t i = 0; i < program->code_count; i++) {
        const uint32_t value = program->code[i];
        uint32_t count;
        const uint32_t *const operands = shader_operands(program, &program->nodes[value], &count);
        for (uint32_t o = shader_changed(program, value) != value ? 1 : 0; o < count; o++) {
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

void shader_find_sets(const struct shader_program *program, struct shader_uses *uses)
{
    struct shader_memory *const memory = program->memory;
    const uint32_t values = program->node_count;
    uses->first_set = shader_take(memory, values + 1, sizeof(uint32_t));
    walk_sets(program, uses, false);
    add_up(uses->first_set, values);
    uses->sets = shader_take(memory, uses->first_set[values], sizeof(uint32_t));
    walk_sets(program, uses, true);
    move_up(uses->first_set, values);
}

void shader_find_uses(const struct shader_program *program, struct shader_uses *uses)
{
    struct shader_memory *const memory = program->memory;
    const uint32_t values = program->node_count;
    shader_find_sets(program, uses);
    uses->first_reader = shader_take(memory, values + 1, sizeof(uint32_t));
    walk_readers(program, uses, false);
    add_up(uses->first_reader, values);
    uses->readers = shader_take(memory, uses->first_reader[values], sizeof(uint32_t));
    walk_readers(program, uses, true);
    move_up(uses->first_reader, values);
}
