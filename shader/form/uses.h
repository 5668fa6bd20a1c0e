// SPDX-License-Identifier: MIT
// Who reads each value, and who sets each home, so that passes go from one to the other without walking the code again
// and again.
#ifndef SHADER_USES_H
#define SHADER_USES_H

#include "form.h"

struct shader_uses {
    uint32_t *first_reader, *readers; // by value: where its readers begin; nodes
    // By HOME, where its SETs begin, and by PRIVATE, where its STOREs do; their places in the code, from first to last.
    uint32_t *first_set, *sets;
};

// Find the uses of all values in the code. The readers of a home are those of what it holds. A SET reads its value
// alone, and a STORE to a PRIVATE reads its offset and value.
void shader_find_uses(const struct shader_program *program, struct shader_uses *uses);
// Find the SETs and STOREs alone.
void shader_find_sets(const struct shader_program *program, struct shader_uses *uses);

#endif
