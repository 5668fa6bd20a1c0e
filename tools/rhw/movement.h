// SPDX-License-Identifier: MIT
// A model that moves: the times of its pictures, its poses, and a camera that sees all of it without moving to and fro.
#ifndef CLI_MOVEMENT_H
#define CLI_MOVEMENT_H

#include "render_state.h"

struct cli_movement {
    int frame_count;
    double rate;               ///< pictures per second
    double seconds;            ///< of the animation; 0: none is played
    double center[3], axis[3]; ///< of the turn
};

/// The number of the animation that the job names, of a model that was read with it.
uint32_t cli_movement_animation(const struct cli_render_job *job, const struct scene_model *model);
/// How many pictures there are and how fast, for a model that has been read. Reports an animation that it lacks.
bool cli_movement_plan(struct cli_movement *movement, const struct cli_render_job *job,
                       const struct scene_model *model);
/// Reads the pose at a time in seconds, with the materials and images of `render->model`, which it borrows; NULL after
/// a report, or where it was given up. Free it by cli_movement_free_pose.
struct scene_model *cli_pose_read(const struct render *render, double time);
/// The same of a picture.
struct scene_model *cli_movement_pose(const struct cli_movement *movement, const struct render *render,
                                      int frame);
void cli_movement_free_pose(struct scene_model *pose);
/// The camera of the first picture: fitted to all of them where it is fitted, else render->view's. Reports failure.
bool cli_movement_camera(struct cli_movement *movement, struct render *render);
/// That of another one.
struct scene_camera cli_movement_turned(const struct cli_movement *movement, const struct scene_camera *first,
                                        const struct cli_render_job *job, int frame);

#endif
