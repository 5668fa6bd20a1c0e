// SPDX-License-Identifier: MIT
// What a scene is lit by: the lights of its file, or a studio of our own.
#ifndef SCENE_LIGHT_H
#define SCENE_LIGHT_H

#include "draw/camera/camera.h"
#include "draw/shading/scene_shaders.h"

struct scene_lighting {
    uint32_t count;
    bool from_file;
    struct scene_shader_light *lights; ///< owned
    struct scene_environment environment;
};

/// Takes the lights of the model, or the studio where the model has none or `default_lights` says so. The studio's sky
/// is in the direction `up`. `exposure` in stops is multiplied into everything. Returns false when memory runs out.
///
/// Studio: a key light from above the viewer's left shoulder, soft boxes above, to the right and behind, a
/// sky and a ground. The boxes turn with the camera, so that no view is of the dark side; sky and ground do not.
/// A camera within the model's bounds stands in a room, whose walls would take all of the key light: there it casts no
/// shadows.
/// A light that stands in the file's first camera and shines as it looks is carried by the camera of the picture.
/// Lights of a file keep their proportions, but not their absolute strength: exposure is chosen so that a
/// white surface in the middle of the model is about white, and a quarter of the studio's surroundings is
/// added, because a file has no sky and its metals would be black.
bool scene_lighting_create(struct scene_lighting *lighting, const struct scene_model *model,
                           const struct scene_camera *camera, enum scene_axis up, bool default_lights,
                           double exposure);

struct scene_surroundings;

/// With a panorama: it takes the place of the studio, with its sun for the key light; lights of the file stay.
void scene_lighting_surround(struct scene_lighting *lighting, const struct scene_surroundings *surroundings,
                             double exposure);
void scene_lighting_destroy(struct scene_lighting *lighting);

#endif
