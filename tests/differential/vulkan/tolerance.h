// SPDX-License-Identifier: MIT
// How far two right results of a function of glsl/functions.comp may lie apart, and when none of them is right.
#ifndef VULKAN_TOLERANCE_H
#define VULKAN_TOLERANCE_H

#include <stdbool.h>
#include <stdint.h>

/// Why two results differ.
enum difference {
    DIFFERENCE_NONE,
    DIFFERENCE_PRECISION, ///< within what Vulkan allows (Vulkan 1.3, "Precision and Operation of SPIR-V Instructions")
    DIFFERENCE_ZERO,      ///< the sign of a zero, which need not be kept
    DIFFERENCE_DENORMAL,  ///< a denormal number, which may be flushed to zero
    DIFFERENCE_UNDEFINED, ///< NaN, infinity, overflow, or operands for which GLSL leaves the result open
    DIFFERENCE_UNEXPLAINED,
    DIFFERENCE_COUNT
};

/// Return why word `word` of the results of function `which` differs.
enum difference explain_difference(int which, int word, const float operands[3], uint32_t here,
                                   uint32_t there);
/// Return the name of a function, or NULL where the number names none.
const char *function_name(int which);

#endif
