// SPDX-License-Identifier: MIT
// The stage that scenes of several passes share: a floor that fills the picture, and 5 × 5 bodies that stand above it.
#ifndef BENCH_SCENE_STAGE_H
#define BENCH_SCENE_STAGE_H

#include "bench_scene.h"

enum { BENCH_STAGE_FLOOR = -1, BENCH_STAGE_BODIES = 25, BENCH_STAGE_MIDDLE = BENCH_STAGE_BODIES / 2 };

extern const struct scene_camera bench_stage_camera;

// Positions and normals. A ball of radius 1 with 2·`stacks` slices and smooth normals.
bool bench_stage_floor(struct bench_mesh *mesh);
bool bench_stage_ball(struct bench_mesh *mesh, uint32_t stacks);

// Where a body, or the floor, stands, and how it looks.
void bench_stage_place(int number, double world[16], float color[4]);
// A draw of it by BENCH_SHADER_LIT, in front of that camera.
struct bench_draw bench_stage_draw(int number, uint32_t mesh, const struct scene_camera *camera,
                                   double aspect);
double bench_stage_triangles(const struct bench_scene *scene); // of all draws

#endif
