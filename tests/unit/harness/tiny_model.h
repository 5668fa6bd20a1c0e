// SPDX-License-Identifier: MIT
// A model of one square in memory, which a test changes and draws, and numbers compared with a tolerance.
#ifndef TEST_TINY_MODEL_H
#define TEST_TINY_MODEL_H

#include "unit.h"

#include "draw/draw.h"

struct tiny {
    struct scene_model model;
    struct scene_mesh mesh;
    struct scene_material material;
    struct scene_instance instances[2];
    struct scene_model_light light;
    struct scene_image image;
    uint8_t texels[4][4];
    float positions[4][3], normals[4][3], tangents[4][4], uvs[4][2], colors[4][4];
    uint32_t indices[6];
};

/// The square −1..1 in the plane z = 0 that faces +Z, white, unlit; texture coordinates 0..1 from its top left.
void tiny_make(struct tiny *t);
/// After `positions` were changed.
void tiny_set_bounds(struct tiny *t);
/// Orthographic, so that the square −1..1 is the middle half of an 8×8 picture: pixels 2..5.
struct scene_view tiny_view(const struct tiny *t, int size);

/// Draws it in a context of its own. Free the pictures by scene_pictures_free.
struct scene_pictures tiny_draw(const struct tiny *t, const struct scene_view *view);
/// Return the red light of the pixel over (x, y) of the plane z = 0, in a picture of tiny_view's camera.
double tiny_light_at(const struct scene_pictures *pictures, double x, double y);

void tiny_identity(float m[16]);
void tiny_assert_close(double value, double expected, double tolerance);

#endif
