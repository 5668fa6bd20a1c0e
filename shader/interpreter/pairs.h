// SPDX-License-Identifier: MIT
// Products that are added or subtracted at once: the interpreter does both in one instruction, with two roundings. It
// spares what a second instruction costs, and the way of the product through memory.
#ifndef SHADER_PAIRS_H
#define SHADER_PAIRS_H

#include "bytecode.h"
#include "form/form.h"

struct shader_pairs {
    uint32_t *product; // by value: of a sum or difference, the product that it takes in, plus 1; 0: none
    bool *is_taken;    // by value: a product that has no instruction of its own
};

// Find the pairs of a program. What they are kept in lies in its memory.
void shader_find_pairs(struct shader_program *program, struct shader_pairs *pairs);
// Return the instruction of a sum or difference that takes in a product, and set `operands` to the two factors and the
// other operand. Return 0 for any other value.
uint32_t shader_pair_at(const struct shader_pairs *pairs, const struct shader_program *program,
                        uint32_t value, uint32_t operands[3]);

#endif
