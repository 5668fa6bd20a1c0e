// SPDX-License-Identifier: MIT
// Where a picture is taken from: the camera, how it is fitted to a model, and its matrices.
//
// Everything is computed in double with our own sine, so that a picture does not depend on the C library.
// Matrices are column major and work on column vectors, as in model.h.
#ifndef SCENE_CAMERA_H
#define SCENE_CAMERA_H

#include "model.h"

/// A camera looks from `eye` to `target`, both in the coordinates of the file. `up` need not be perpendicular to the
/// view. If it is parallel, another direction takes its place.
struct scene_camera {
    double eye[3], target[3], up[3];
    bool orthographic;
    double yfov;        ///< whole angle from the bottom to the top of a perspective picture, radians
    double ymag;        ///< half the height of an orthographic picture in the world
    double znear, zfar; ///< distances along the view; a zfar of 0 is infinitely far (perspective only)
    double stretch;     ///< factor of the picture's width for pixels that are not square; 0 means 1
    /// The place in the picture of the view's axis, −1..1, right and up: a principal point
    double shift[2];
};

/// An orbit has its angles in degrees. With y up, azimuth 0 looks at the model's front (from +Z), azimuth 90 looks from
/// its left hand side (+X), and elevation 90 looks straight down (−Y). With z up the front is −Y. With x or −x up the
/// front stays, and y turns to x or −x. With −y up the model stands on its head.
struct scene_orbit {
    double azimuth, elevation;
    enum scene_axis up;
    /// What is no part of the subject (subject.h) is brought into the picture too
    bool whole;
    /// The model will turn around the vertical line through `turn_center`. What it sweeps is brought into the picture,
    /// and the line into the middle. `turn_center` is in the coordinates of the file.
    bool turns;
    double turn_center[3];
};

/// Turn a direction of a world where y is up into that of a world where `up` is up.
void scene_axis_turn(enum scene_axis up, double direction[3]);

/// Return 30 degrees, in radians. The lens is long enough to keep proportions, and short enough to show depth.
double scene_camera_default_yfov(void);

/// Return the part of the picture that a fitted camera leaves free on each side.
double scene_camera_fit_margin(void);

/// Return the azimuth of a model's front: 0, or 180 for one that faces back.
double scene_camera_front(const struct scene_model *model);

/// Return the angle from which a model shows best: from the front, a little to the side and from above. A flat model
/// shows best from the side that it faces, but from above if it can be seen from there. Where next to nothing is seen,
/// because all of it stands edge-on, the angle is that of the side that most of its surface faces, if it covers more
/// than 16 times as many pixels then.
struct scene_orbit scene_camera_default_orbit(const struct scene_model *model, enum scene_axis up);

/// Return the camera at the orbit's angles that is as near as it can be with every vertex of the subject in the picture
/// and a margin of 4% around it. Near and far planes enclose the model. A model without vertices gets a camera that
/// looks at the origin.
struct scene_camera scene_camera_fit(const struct scene_model *model, struct scene_orbit orbit, double yfov,
                                     double aspect);

/// Make a perspective camera that looks from `eye` to `target`, with its planes around the model. Return false, with
/// one line in `error`, if the numbers make no camera: they are not finite, eye equals target, up is along the view, or
/// yfov (radians) is outside of 0.01..179 degrees.
bool scene_camera_look(struct scene_camera *camera, const struct scene_model *model, const double eye[3],
                       const double target[3], const double up[3], double yfov, char *error,
                       size_t error_size);

/// Make an orthographic camera that looks from `eye` to `target`, with its planes around the model. `height` is that of
/// the whole picture in the world, above 0. Return false, with one line in `error`, if the numbers make no camera.
bool scene_camera_look_orthographic(struct scene_camera *camera, const struct scene_model *model,
                                    const double eye[3], const double target[3], const double up[3],
                                    double height, char *error, size_t error_size);

/// Put the near and the far plane around the model.
void scene_camera_enclose(struct scene_camera *camera, const struct scene_model *model);
/// Put the near and the far plane around all that the model sweeps when it turns as the orbit says.
void scene_camera_enclose_turn(struct scene_camera *camera, const struct scene_model *model,
                               const struct scene_orbit *orbit);

/// Return the camera with its place counted from `origin`: with that of a model, in the coordinates that the model has
/// in memory.
struct scene_camera scene_camera_from_origin(const struct scene_camera *camera, const double origin[3]);

/// Return a camera of the file. If the picture's aspect ratio differs from the camera's, all of what the camera frames
/// stays in the picture.
struct scene_camera scene_camera_from_model(const struct scene_model *model,
                                            const struct scene_model_camera *camera, double aspect);

/// Return true if the camera stands outside the model's bounds and has at least half of the model's vertices in the
/// picture.
bool scene_camera_shows_most(const struct scene_model *model, const struct scene_camera *camera,
                             double aspect);

/// Return true if the camera has a hundredth of the vertices in the picture, or a fifth if it stands within the model's
/// bounds, as the camera of a room does. Cameras of formats that many programs write wrongly often stand elsewhere.
bool scene_camera_is_believable(const struct scene_model *model, const struct scene_camera *camera,
                                double aspect);

/// What the first camera of a file sees of the model.
enum scene_sight {
    SCENE_SIGHT_ENOUGH,
    /// Fitted, the model would cover more than 16 times as many pixels: a thumbnail would show more of it. A camera of
    /// a format that many programs write wrongly must also be believable.
    SCENE_SIGHT_NEXT_TO_NOTHING,
    SCENE_SIGHT_NOTHING
};

/// Return what a camera sees, in a picture of a few hundred pixels.
enum scene_sight scene_camera_sight(const struct scene_model *model, const struct scene_camera *camera,
                                    double aspect);

/// Return true if a camera that was asked for sees next to nothing: fitted, the model would cover more than 256 times
/// as many pixels.
bool scene_camera_shows_a_dot(const struct scene_model *model, const struct scene_camera *camera,
                              double aspect);

/// Return how many digits tell the place of a camera. There are more far from the origin, so that the same is seen when
/// they are read.
int scene_camera_digits(const double eye[3], const double target[3]);

/// Write the matrix from the world to camera space, which looks along −Z.
void scene_camera_view(const struct scene_camera *camera, double matrix[16]);
/// Write the matrix from camera space to clip space. In NDC y is up, and depth is 0 at znear and 1 at zfar.
void scene_camera_projection(const struct scene_camera *camera, double aspect, double matrix[16]);

/// Write a · b to `product`.
void scene_matrix_multiply(const double a[16], const double b[16], double product[16]);
/// Write the transposed inverse of the upper 3×3, times the square of a length, since its direction is what counts. It
/// carries normals through any affine matrix, mirrored or not. If the matrix is singular, the result is singular too.
void scene_matrix_normal(const double matrix[16], double normal[9]);

#endif
