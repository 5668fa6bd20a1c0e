// SPDX-License-Identifier: MIT
// What stands in the lessons' scenes: balls, boxes and squares, and a camera to look at them.
#ifndef SOLID_H
#define SOLID_H

#include <rhw/rhw.h>

/// A ball of radius 1, a box from −1 to 1, and a square from −1 to 1 each way at y = 0 that looks up.
enum solid { SOLID_BALL, SOLID_BOX, SOLID_SQUARE };

/// A vertex buffer with all of them: triangles, counter-clockwise from outside; a position, then a normal.
rhw_buffer solid_buffer(rhw_context *context);

/// Pipelines for that buffer in slot 0: the position is attribute 0, the normal attribute 1; with a depth test. What is
/// missing are a program and targets.
struct rhw_pipeline_def solid_pipeline_def(void);

/// Draws one of them, with the buffer in slot 0.
void solid_draw(rhw_context *context, rhw_pass pass, enum solid solid, int instances);

/// World to clip coordinates, column by column: from `eye` towards `target`, y up; `zoom` is the cotangent of half the
/// angle of view, the same each way. W is the distance ahead and Z half a unit less.
void solid_camera(const float eye[3], const float target[3], float zoom, float matrix[16]);

/// The same for a face of a cube texture, 0..5, as seen from `center`: X runs with the face's s, Y against its t, as rows
/// of texels run down (Vulkan 1.3, "Cube Map Face Selection"). Z is `near` less than W.
void solid_face_camera(int face, const float center[3], float near, float matrix[16]);

#endif
