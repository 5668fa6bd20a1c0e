// SPDX-License-Identifier: MIT
// Elementary functions for shader functions. Included by shader.h.
#ifndef RHW_SHADER_MATH_H
#define RHW_SHADER_MATH_H

#include "shader_vector.h"

#endif
