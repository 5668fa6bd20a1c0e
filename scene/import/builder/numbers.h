// SPDX-License-Identifier: MIT
// Small mathematics of the import: matrices, which are column major, colours, and whether numbers are finite.
#ifndef SCENE_NUMBERS_H
#define SCENE_NUMBERS_H

#include <stdbool.h>
#include <stddef.h>

void scene_import_identity(float matrix[16]);
bool scene_import_is_identity(const float matrix[16]);
/// Set the product. It may alias a or b.
void scene_import_multiply(const float a[16], const float b[16], float product[16]);
void scene_import_transform(const float matrix[16], const float point[3], float result[3]);
float scene_import_determinant(const float matrix[16]); ///< determinant of the upper 3×3
/// Decode the sRGB transfer function.
float scene_import_from_srgb(float value);
bool scene_import_finite(const float *values, size_t count);

#endif
