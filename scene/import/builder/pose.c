// SPDX-License-Identifier: MIT
// What the animations of all formats need: the animation that is wanted, and turns between keys.
#include "pose.h"

#include <stdlib.h>
#include <string.h>

#include "elementary.h"
#include "numbers.h"

int64_t scene_import_find_animation(const struct scene_import *import)
{
    const struct scene_model *const model = &import->model;
    const char *const wanted = import->animation;
    if (import->takes_number) {
        return import->animation_number < model->animation_count ? (int64_t)import->animation_number : -1;
    }
    if (wanted == NULL) {
        return 0;
    }
    for (uint32_t i = 0; i < model->animation_count; i++) {
        if (strcmp(model->animations[i].name, wanted) == 0) {
            return i;
        }
    }
    char *end;
    const unsigned long number = strtoul(wanted, &end, 10);
    return *wanted >= '0' && *wanted <= '9' && *end == 0 && number < model->animation_count ? (int64_t)number
                                                                                            : -1;
}

void scene_import_slerp(const float from[4], const float to[4], double part, double result[4])
{
    double cosine = 0.0;
    for (int c = 0; c < 4; c++) {
        cosine += (double)from[c] * (double)to[c];
    }
    const double size = cosine < 0.0 ? -cosine : cosine;
    double near = 1.0 - part, far = part;
    if (size < 0.9995) { // above that the arc is as good as straight
        const double angle = 2.0 * scene_atan(__builtin_sqrt((1.0 - size) / (1.0 + size)));
        const double sine = scene_sin(angle);
        near = scene_sin(angle * near) / sine;
        far = scene_sin(angle * far) / sine;
    }
    far = cosine < 0.0 ? -far : far;
    for (int c = 0; c < 4; c++) {
        result[c] = (double)from[c] * near + (double)to[c] * far;
    }
}

static void compose_floats(const float t[3], const float q[4], const float s[3], float matrix[16])
{
    const float square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const float scale = square > 0 ? 1 / __builtin_sqrtf(square) : 0;
    const float x = q[0] * scale, y = q[1] * scale, z = q[2] * scale, w = square > 0 ? q[3] * scale : 1;
    const float rotation[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
        2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
        2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y),
    };
    scene_import_identity(matrix);
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++) {
            matrix[4 * column + row] = rotation[3 * column + row] * s[column];
        }
    }
    memcpy(matrix + 12, t, 3 * sizeof *t);
}

static void compose_exact(const double t[3], const double q[4], const double s[3], double matrix[16])
{
    const double square = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    const double scale = square > 0 ? 1 / __builtin_sqrt(square) : 0;
    const double x = q[0] * scale, y = q[1] * scale, z = q[2] * scale, w = square > 0 ? q[3] * scale : 1;
    const double rotation[9] = {
        1 - 2 * (y * y + z * z), 2 * (x * y + z * w),     2 * (x * z - y * w),
        2 * (x * y - z * w),     1 - 2 * (x * x + z * z), 2 * (y * z + x * w),
        2 * (x * z + y * w),     2 * (y * z - x * w),     1 - 2 * (x * x + y * y),
    };
    for (int column = 0; column < 3; column++) {
        for (int row = 0; row < 3; row++) {
            matrix[4 * column + row] = rotation[3 * column + row] * s[column];
        }
        matrix[12 + column] = t[column];
        matrix[4 * column + 3] = 0.0;
    }
    matrix[15] = 1.0;
}

struct scene_import_place scene_import_compose(const double t[3], const double q[4], const double s[3])
{
    struct scene_import_place place;
    const float translation[3] = {(float)t[0], (float)t[1], (float)t[2]};
    const float rotation[4] = {(float)q[0], (float)q[1], (float)q[2], (float)q[3]};
    const float scale[3] = {(float)s[0], (float)s[1], (float)s[2]};
    compose_floats(translation, rotation, scale, place.world);
    compose_exact(t, q, s, place.exact);
    return place;
}
