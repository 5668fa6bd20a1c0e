// SPDX-License-Identifier: MIT
// Runs the functions of glsl/functions.comp on rows of operands.
#ifndef TEST_FUNCTION_RIG_H
#define TEST_FUNCTION_RIG_H

#include <stdbool.h>
#include <stdint.h>

/// Compute function `which` of `count` rows of 4 operands, which may be floats or their bits. Four words of results come
/// of each. If `is_given`, the operands of each row are constants of a translation of its own.
void function_rig_run(int which, const float (*operands)[4], int count, bool is_given,
                      uint32_t (*results)[4]);

#endif
