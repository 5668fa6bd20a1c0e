// SPDX-License-Identifier: MIT
// Lights of a file that stand in its camera and shine as it looks. They are the camera's, so that a picture that
// another camera takes has them in that one: what the file's camera would light from afar, from within or past the
// model is lit from where it is seen.
#ifndef SCENE_HEADLAMP_H
#define SCENE_HEADLAMP_H

#include "draw/camera/camera.h"

/// Who carries the headlamps of the file's first camera.
struct scene_headlamp {
    bool is_carried;           ///< the picture is taken by another camera than the file's first
    double eye[3], forward[3]; ///< the file's first camera: where it stands, and where it looks, of length 1
    double bearer[3], onward[3]; ///< place and direction of the camera that takes the picture
    double room;                 ///< what is no farther from a camera stands in it
};

/// Find out who carries the headlamps of a model, in a picture that `camera` takes. The camera's place is counted from
/// the model's origin.
struct scene_headlamp scene_headlamp_find(const struct scene_model *model, const struct scene_camera *camera);
/// Return a light as the picture has it: a headlamp stands in the camera that takes it and has no
/// range, any other is where it is.
struct scene_model_light scene_headlamp_carry(const struct scene_headlamp *headlamp,
                                              const struct scene_model_light *light);

#endif
