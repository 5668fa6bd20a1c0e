// SPDX-License-Identifier: MIT
// What stands in the lessons' scenes: a ball and a box, and a camera to look at them.
#ifndef SOLID_H
#define SOLID_H

enum { BALL_RINGS = 48, BALL_SECTORS = 96, BALL_VERTICES = BALL_RINGS * BALL_SECTORS * 6, BOX_VERTICES = 36 };

struct solid_vertex {
    float position[3], normal[3];
};

/// Triangles of a ball of radius 1 and of a box from −1 to 1; counter-clockwise from outside.
void solid_ball(struct solid_vertex vertices[BALL_VERTICES]);
void solid_box(struct solid_vertex vertices[BOX_VERTICES]);

/// World to clip coordinates, column by column: from `eye` towards `target`, y up; `zoom` is the cotangent of half the
/// angle of view, the same each way. W is the distance ahead and Z half a unit less.
void solid_camera(const float eye[3], const float target[3], float zoom, float matrix[16]);

/// The same for a face of a cube texture, 0..5, as seen from `center`: X runs with the face's s, Y against its t, as rows
/// of texels run down (Vulkan 1.3, "Cube Map Face Selection"). Z is `near` less than W.
void solid_face_camera(int face, const float center[3], float near, float matrix[16]);

#endif
