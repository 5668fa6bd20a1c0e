// SPDX-License-Identifier: MIT
// Matrices and colours of the import.
#include "numbers.h"

#include <string.h>

#include "elementary.h"

void scene_import_identity(float matrix[16])
{
    for (int i = 0; i < 16; i++) {
        matrix[i] = i % 5 == 0 ? 1.0f : 0.0f;
    }
}

bool scene_import_is_identity(const float matrix[16])
{
    float identity[16];
    scene_import_identity(identity);
    return memcmp(matrix, identity, sizeof identity) == 0;
}

void scene_import_multiply(const float a[16], const float b[16], float product[16])
{
    float result[16];
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            float sum = 0;
            for (int k = 0; k < 4; k++) {
                sum += a[4 * k + row] * b[4 * column + k];
            }
            result[4 * column + row] = sum;
        }
    }
    memcpy(product, result, sizeof result);
}

void scene_import_transform(const float matrix[16], const float point[3], float result[3])
{
    const float x = point[0], y = point[1], z = point[2];
    for (int row = 0; row < 3; row++) {
        result[row] = matrix[row] * x + matrix[4 + row] * y + matrix[8 + row] * z + matrix[12 + row];
    }
}

float scene_import_determinant(const float matrix[16])
{
    const float *a = matrix, *b = matrix + 4, *c = matrix + 8;
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

float scene_import_from_srgb(float value)
{
    if (!(value > 0.04045f)) { // true for negative values and NaN too
        return value > 0 ? value / 12.92f : 0;
    }
    return (float)scene_pow(((double)value + 0.055) / 1.055, 2.4);
}

bool scene_import_finite(const float *values, size_t count)
{
    // x − x is 0 for every finite x and NaN for all others.
    float sum = 0;
    for (size_t i = 0; i < count; i++) {
        sum += values[i] - values[i];
    }
    return sum == 0;
}
