// SPDX-License-Identifier: MIT
// Small mathematics of the import: matrices, column major, colours, and whether numbers are finite.
#ifndef SCENE_NUMBERS_H
#define SCENE_NUMBERS_H

#include <stdbool.h>
#include <stddef.h>

void scene_import_identity(float matrix[16]);
void scene_import_multiply(const float a[16], const float b[16], float product[16]); ///< may alias
void scene_import_transform(const float matrix[16], const float point[3], float result[3]);
float scene_import_determinant(const float matrix[16]); ///< of the upper 3×3
/// Decodes the sRGB transfer function.
float scene_import_from_srgb(float value);
bool scene_import_finite(const float *values, size_t count);

#endif
