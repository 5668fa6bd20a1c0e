// SPDX-License-Identifier: MIT
// Places in the world, in two forms. Models near the origin are drawn by the floats. Where a model turns out to be far,
// finish.c goes on with the doubles, from which what they have in common is subtracted.
#ifndef SCENE_PLACE_H
#define SCENE_PLACE_H

#include "import.h"

struct scene_import_place {
    float world[16];
    double exact[16];
};

struct scene_import_place scene_import_place_identity(void);
struct scene_import_place scene_import_place_of(const float matrix[16]);
struct scene_import_place scene_import_place_multiply(const struct scene_import_place *a,
                                                      const struct scene_import_place *b);
/// Write the matrix of a place that is counted from `origin`. If that is 0, it is the place's floats.
void scene_import_place_from(const struct scene_import_place *place, const double origin[3],
                             float matrix[16]);
/// Put the instance that was added last at a place. Its floats are in the model's struct from then on.
void scene_import_place_instance(struct scene_import *import, const struct scene_import_place *place);
/// Say exactly where the camera or the light stands that was added last. Of a light the last column counts.
void scene_import_place_camera(struct scene_import *import, const struct scene_import_place *place);
void scene_import_place_light(struct scene_import *import, const struct scene_import_place *place);
/// Say what was subtracted from the positions of the mesh that was added last.
void scene_import_place_mesh(struct scene_import *import, const double origin[3]);
/// Write the matrix that moves nothing.
void scene_import_identity_exact(double matrix[16]);
/// Write `a`·`b` to `product`, which may be one of them.
void scene_import_multiply_exact(const double a[16], const double b[16], double product[16]);
/// Write where a matrix brings a point.
void scene_import_transform_exact(const double matrix[16], const double point[3], double result[3]);
/// Write where a matrix brings a point of floats.
void scene_import_transform_floats(const double matrix[16], const float point[3], double result[3]);
/// Move the place that a matrix brings 0 to by an offset that is counted as what the matrix moves is.
void scene_import_add_offset(double matrix[16], const double offset[3]);

#endif
