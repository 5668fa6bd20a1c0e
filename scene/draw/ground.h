// SPDX-License-Identifier: MIT
// A ground below the model that shows nothing but the shadow on it, fading out around the model.
#ifndef SCENE_GROUND_H
#define SCENE_GROUND_H

#include "upload.h"

enum { SCENE_GROUND_SPOKES = 64, SCENE_GROUND_VERTICES = 1 + 2 * SCENE_GROUND_SPOKES };

/// A model of one round mesh. Zeroed: none.
struct scene_ground {
    bool is_made;
    struct scene_model model;
    struct scene_mesh mesh;
    struct scene_material material;
    struct scene_instance instance;
    float positions[SCENE_GROUND_VERTICES][3], normals[SCENE_GROUND_VERTICES][3];
    float colors[SCENE_GROUND_VERTICES][4];
    uint32_t indices[SCENE_GROUND_SPOKES * 9];
    struct scene_upload upload;
};

/// Makes it for the lowest point of the subject with that up.
enum rhw_result scene_ground_make(struct scene_ground *ground, rhw_context *context,
                                  const struct scene_model *model, enum scene_axis up);
void scene_ground_destroy(struct scene_ground *ground);

#endif
