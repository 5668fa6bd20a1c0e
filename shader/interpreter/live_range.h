// SPDX-License-Identifier: MIT
// From where to where in the code a value is kept.
#ifndef SHADER_LIVE_RANGE_H
#define SHADER_LIVE_RANGE_H

#include "form/form.h"
#include "pairs.h"

#define SHADER_NEVER UINT32_MAX

struct shader_live_range {
    uint32_t begin, end; // places in the code; SHADER_NEVER: nothing has the value
};

// Return the ranges by value. They lie in the memory of the program.
const struct shader_live_range *shader_find_live_ranges(struct shader_program *program,
                                                        const struct shader_pairs *pairs);

// Return true for an IF whose condition all active lanes share: the code jumps, and masks stay as they are.
bool shader_is_jump(const struct shader_program *program, uint32_t value);

#endif
