// SPDX-License-Identifier: MIT
#include "place.h"

#include <string.h>

#include "numbers.h"

struct scene_import_place scene_import_place_of(const float matrix[16])
{
    struct scene_import_place place;
    for (int i = 0; i < 16; i++) {
        place.world[i] = matrix[i];
        place.exact[i] = (double)matrix[i];
    }
    return place;
}

struct scene_import_place scene_import_place_identity(void)
{
    float identity[16];
    scene_import_identity(identity);
    return scene_import_place_of(identity);
}

void scene_import_identity_exact(double matrix[16])
{
    for (int i = 0; i < 16; i++) {
        matrix[i] = i % 5 == 0;
    }
}

void scene_import_multiply_exact(const double a[16], const double b[16], double product[16])
{
    double result[16];
    for (int column = 0; column < 4; column++) {
        for (int row = 0; row < 4; row++) {
            double sum = 0;
            for (int k = 0; k < 4; k++) {
                sum += a[4 * k + row] * b[4 * column + k];
            }
            result[4 * column + row] = sum;
        }
    }
    memcpy(product, result, sizeof result);
}

void scene_import_transform_exact(const double matrix[16], const double point[3], double result[3])
{
    const double x = point[0], y = point[1], z = point[2];
    for (int row = 0; row < 3; row++) {
        result[row] = matrix[row] * x + matrix[4 + row] * y + matrix[8 + row] * z + matrix[12 + row];
    }
}

void scene_import_transform_floats(const double matrix[16], const float point[3], double result[3])
{
    const double exact[3] = {(double)point[0], (double)point[1], (double)point[2]};
    scene_import_transform_exact(matrix, exact, result);
}

void scene_import_add_offset(double matrix[16], const double offset[3])
{
    scene_import_transform_exact(matrix, offset, matrix + 12);
}

struct scene_import_place scene_import_place_multiply(const struct scene_import_place *a,
                                                      const struct scene_import_place *b)
{
    struct scene_import_place product;
    scene_import_multiply(a->world, b->world, product.world);
    scene_import_multiply_exact(a->exact, b->exact, product.exact);
    return product;
}

void scene_import_place_from(const struct scene_import_place *place, const double origin[3], float matrix[16])
{
    for (int i = 0; i < 16; i++) {
        const double subtracted = i >= 12 && i < 15 ? origin[i - 12] : 0;
        matrix[i] = scene_origin_is_far(origin) ? (float)(place->exact[i] - subtracted) : place->world[i];
    }
}

static void set_last(const struct scene_import_exact *list, const double exact[16])
{
    memcpy(list->matrices[list->count - 1], exact, sizeof *list->matrices);
}

void scene_import_place_instance(struct scene_import *import, const struct scene_import_place *place)
{
    memcpy(import->model.instances[import->model.instance_count - 1].world, place->world,
           sizeof place->world);
    set_last(&import->exact_instances, place->exact);
}

void scene_import_place_camera(struct scene_import *import, const struct scene_import_place *place)
{
    set_last(&import->exact_cameras, place->exact);
}

void scene_import_place_light(struct scene_import *import, const struct scene_import_place *place)
{
    set_last(&import->exact_lights, place->exact);
}

void scene_import_place_mesh(struct scene_import *import, const double origin[3])
{
    struct scene_import_place place = scene_import_place_identity();
    memcpy(place.exact + 12, origin, 3 * sizeof *origin);
    set_last(&import->exact_meshes, place.exact);
}
