// SPDX-License-Identifier: MIT
// A model of which parts stand so far apart that no one origin serves all. A picture of one part is drawn from a place
// in that part, so that floats are dense where the camera is.
#ifndef SCENE_VICINITY_H
#define SCENE_VICINITY_H

#include "camera/camera.h"

/// A model that is counted from another origin, kept from draw to draw. It borrows all but its instances, cameras
/// and lights. Zeroed: none.
struct scene_vicinity {
    struct scene_model model;
    struct scene_instance *instances;
    struct scene_model_camera *cameras;
    struct scene_model_light *lights;
};

/// Find where the model's origin is best for a picture, in the coordinates of the file. It is the model's own, unless
/// what the camera is near stands far from that.
void scene_vicinity_origin(const struct scene_model *model, const struct scene_camera *camera,
                           double origin[3]);
/// Count a model from another origin, unless the vicinity is counted from there already. Return false if there is no
/// memory for it. Free it with scene_vicinity_free, also before it is to be of another model.
bool scene_vicinity_get(struct scene_vicinity *vicinity, const struct scene_model *model,
                        const double origin[3]);
void scene_vicinity_free(struct scene_vicinity *vicinity);

#endif
