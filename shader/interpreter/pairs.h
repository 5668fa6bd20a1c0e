// SPDX-License-Identifier: MIT
// Products that are added or subtracted at once, and comparisons that choose the lesser or the greater: the interpreter
// does both in one instruction, a product and a sum with two roundings. It spares what a second instruction costs, and
// the way of what lies between through memory.
#ifndef SHADER_PAIRS_H
#define SHADER_PAIRS_H

#include "bytecode.h"
#include "form/form.h"

struct shader_pairs {
    uint32_t *other; // by value: the product or comparison that it takes in, plus 1; 0: none
    bool *is_taken;  // by value: a product or comparison that has no instruction of its own
};

// Find the pairs of a program. What they are kept in lies in its memory.
void shader_find_pairs(struct shader_program *program, struct shader_pairs *pairs);
// Return the instruction of a sum or difference that takes in a product, and set `operands` to the two factors and the
// other operand; or that of the lesser or the greater, of the first two. Return 0 for any other value.
uint32_t shader_pair_at(const struct shader_pairs *pairs, const struct shader_program *program,
                        uint32_t value, uint32_t operands[3]);

static inline int shader_pair_operands(uint32_t pair)
{
    return pair == SHADER_IMIN || pair == SHADER_IMAX ? 2 : 3;
}

#endif
