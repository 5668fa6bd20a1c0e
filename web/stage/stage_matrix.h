// SPDX-License-Identifier: MIT
// Inverses of 4 x 4 matrices, column major, in double.
#ifndef STAGE_MATRIX_H
#define STAGE_MATRIX_H

#include <stdbool.h>

/// False where there is none; `inverse` is then not set.
bool stage_matrix_invert(const double matrix[16], double inverse[16]);

#endif
