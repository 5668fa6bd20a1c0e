// SPDX-License-Identifier: MIT
// Where the window looks from: a camera as --camera takes it, and how the mouse and the keys move it. All numbers have
// nine digits, as the command line has them that draws the same picture.
#ifndef VIEW_EYE_H
#define VIEW_EYE_H

#include "draw/camera/camera.h"

struct view_eye {
    double eye[3], target[3], up[3];
    bool orthographic;
    double fovy;   ///< degrees; in perspective
    double height; ///< of all that is seen, in the world; orthographic
};

/// What a camera sees. It turns around what lies ahead of it in the middle of the model.
void view_eye_set(struct view_eye *eye, const struct scene_camera *camera, const struct scene_model *model);
/// Around the target: to the right and upwards, radians. `vertical`: what is up in the world.
void view_eye_orbit(struct view_eye *eye, const double vertical[3], double right, double up);
/// Around the eye itself.
void view_eye_turn(struct view_eye *eye, const double vertical[3], double right, double up);
/// Moves what lies at the target by parts of the picture's height, to the right and upwards.
void view_eye_pan(struct view_eye *eye, double right, double up);
/// To the point of the target's plane that is seen so far right of and above the middle, in half heights of the
/// picture, until its distance, or without perspective the height of what is seen, is `factor` times what it was.
void view_eye_zoom(struct view_eye *eye, double right, double up, double factor);
/// Flies to the right, upwards and ahead, in the world's units. Without perspective what is ahead gets larger instead.
void view_eye_fly(struct view_eye *eye, const double way[3]);
/// Looks the same way at a ball, with all of it in a picture of that aspect ratio.
void view_eye_fit(struct view_eye *eye, const double middle[3], double radius, double aspect);
/// What a zoom multiplies: the distance of the target, or without perspective the height of what is seen.
double view_eye_scale(const struct view_eye *eye);
/// The ten numbers of --camera.
void view_eye_numbers(const struct view_eye *eye, double numbers[10]);

#endif
