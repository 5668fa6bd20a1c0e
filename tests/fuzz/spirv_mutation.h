// SPDX-License-Identifier: MIT
// SPIR-V modules that are nearly right: changes of a module that know its words, instructions and ids, and modules that
// are made of nothing but the grammar. The same seed makes the same modules.
#ifndef SPIRV_MUTATION_H
#define SPIRV_MUTATION_H

#include <stddef.h>
#include <stdint.h>

enum { SPIRV_MUTATION_ROOM = 1 << 14 }; // words

struct spirv_words {
    uint32_t words[SPIRV_MUTATION_ROOM];
    size_t count;
};

// Return a random number below `count`, which is not 0.
uint32_t spirv_pick(uint64_t *state, uint32_t count);
// Change a module in up to a few places. `other` is a module from which instructions may be taken.
void spirv_mutate(uint64_t *state, struct spirv_words *module, const struct spirv_words *other);
// Make a module of random instructions within the frame of a compute shader.
void spirv_generate(uint64_t *state, struct spirv_words *module);

#endif
