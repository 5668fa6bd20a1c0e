// SPDX-License-Identifier: MIT
// The camera of a picture: what the command line says, what the file has, or one that is fitted.
#ifndef CLI_RENDER_CAMERA_H
#define CLI_RENDER_CAMERA_H

#include "render_job.h"

/// The camera of the file that the job takes or, where it asks for none, the file's first; NULL: there is none.
const struct scene_model_camera *cli_camera_find(const struct cli_render_job *job,
                                                 const struct scene_model *model);
/// One that is fitted to the model, as the job says.
struct scene_camera cli_camera_fit(const struct cli_render_job *job, const struct scene_model *model);
/// To all that the model sweeps while it turns around the vertical line through that point.
struct scene_camera cli_camera_fit_turn(const struct cli_render_job *job, const struct scene_model *model,
                                        const double center[3]);
/// False after a message. `*distrusted`: the file's camera gave way to a fitted one.
bool cli_camera_choose(const struct cli_render_job *job, const struct scene_model *model,
                       struct scene_camera *camera, bool *distrusted);
/// As an option, on standard output.
void cli_camera_print(const struct scene_camera *camera);

#endif
