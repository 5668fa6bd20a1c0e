// SPDX-License-Identifier: MIT
// Where a picture is taken from: the camera, how it is fitted to a model, and its matrices.
//
// Everything is computed in double with our own sine, so that a picture does not depend on the C library.
// Matrices are column major and work on column vectors, as in model.h.
#ifndef SCENE_CAMERA_H
#define SCENE_CAMERA_H

#include "model.h"

/// Looks from `eye` to `target`; `up` need not be perpendicular, and may be parallel (another is then taken).
struct scene_camera {
    double eye[3], target[3], up[3];
    bool orthographic;
    double yfov;        ///< radians, the whole angle from the bottom to the top of the picture; perspective
    double ymag;        ///< half the height of the picture in the world; orthographic
    double znear, zfar; ///< distances along the view; zfar 0: infinitely far (perspective only)
    double stretch;     ///< of the picture's width: pixels that are not square; 0: 1
    double shift[2]; ///< where in the picture the axis of the view lies, −1..1, right and up: a principal point
};

/// Degrees. With y up azimuth 0 looks at the model's front (from +Z), 90 from its left hand side (+X); elevation 90 looks
/// straight down (−Y). With z up the front is −Y; x and −x up keep the front, y turning to them; −y up stands on its head.
struct scene_orbit {
    double azimuth, elevation;
    enum scene_axis up;
    bool whole; ///< also what is no part of the subject (subject.h) is brought into the picture
    /// The model will turn around the vertical line through `turn_center`: what it sweeps is brought into the picture, and
    /// that line into the middle.
    bool turns;
    double turn_center[3];
};

/// Turns a direction of a world with y up to what it is with another.
void scene_axis_turn(enum scene_axis up, double direction[3]);

/// 30 degrees: long enough a lens to keep proportions, short enough to show depth.
double scene_camera_default_yfov(void);

/// The part of the picture that a fitted camera leaves free on each side.
double scene_camera_fit_margin(void);

/// The angle from which a model shows best: from the front, a little to the side and from above; a flat
/// model from the side it faces.
struct scene_orbit scene_camera_default_orbit(const struct scene_model *model, enum scene_axis up);

/// The camera at those angles that is as near as it can be with every vertex of the subject in the picture
/// and a margin of 4% around it; near and far planes enclose the model. A model without vertices gets a
/// camera that looks at the origin.
struct scene_camera scene_camera_fit(const struct scene_model *model, struct scene_orbit orbit, double yfov,
                                     double aspect);

/// Perspective from `eye` to `target`, planes around the model. False with one line in `error` when the
/// numbers make no camera: not finite, eye equals target, up along the view, yfov (radians) outside 0.01..179 degrees.
bool scene_camera_look(struct scene_camera *camera, const struct scene_model *model, const double eye[3],
                       const double target[3], const double up[3], double yfov, char *error,
                       size_t error_size);

/// The same without perspective; `height` of the whole picture in the world, above 0.
bool scene_camera_look_orthographic(struct scene_camera *camera, const struct scene_model *model,
                                    const double eye[3], const double target[3], const double up[3],
                                    double height, char *error, size_t error_size);

/// Puts the near and the far plane around the model.
void scene_camera_enclose(struct scene_camera *camera, const struct scene_model *model);
/// Around all that the model sweeps when it turns as the orbit says.
void scene_camera_enclose_turn(struct scene_camera *camera, const struct scene_model *model,
                               const struct scene_orbit *orbit);

/// A camera of the file. Where the picture's aspect ratio differs from the camera's, all of what the camera
/// frames stays in the picture.
struct scene_camera scene_camera_from_model(const struct scene_model_camera *camera, double aspect);

/// Whether the camera stands outside the model's bounds and has at least half of its vertices in the picture.
bool scene_camera_shows_most(const struct scene_model *model, const struct scene_camera *camera,
                             double aspect);

/// Whether it has a hundredth of the vertices in the picture, or a fifth where it stands within the model's bounds, as that of
/// a room does. Cameras of formats that many programs write wrongly are often elsewhere.
bool scene_camera_is_believable(const struct scene_model *model, const struct scene_camera *camera,
                                double aspect);

/// World to camera space (looking along −Z).
void scene_camera_view(const struct scene_camera *camera, double matrix[16]);
/// Camera space to clip space: NDC y up, depth 0 at znear and 1 at zfar.
void scene_camera_projection(const struct scene_camera *camera, double aspect, double matrix[16]);

/// a · b.
void scene_matrix_multiply(const double a[16], const double b[16], double product[16]);
/// The transposed inverse of the upper 3×3, times the square of a length (its direction is what counts): it
/// carries normals through any affine matrix, mirrored or not. Where the matrix is singular the result is too.
void scene_matrix_normal(const double matrix[16], double normal[9]);

#endif
