// SPDX-License-Identifier: MIT
#include "render_camera.h"

#include "draw/camera/camera_frame.h"
#include "message.h"

#include <stdio.h>
#include <string.h>

static const double degree = 3.14159265358979323846 / 180.0;

// The camera the job names in the file, or NULL when there is none.
const struct scene_model_camera *cli_camera_find(const struct cli_render_job *job,
                                                 const struct scene_model *model)
{
    if (job->camera == CLI_CAMERA_AUTO) {
        return model->camera_count && job->fovy == 0.0f ? &model->cameras[0] : NULL;
    }
    for (uint32_t i = 0; i < model->camera_count; i++) {
        const bool wanted = job->camera == CLI_CAMERA_INDEX
                                ? i == (uint32_t)job->camera_index
                                : strcmp(model->cameras[i].name, job->camera_name) == 0;
        if (wanted) {
            return &model->cameras[i];
        }
    }
    return NULL;
}

static bool report_missing_camera(const struct cli_render_job *job, const struct scene_model *model)
{
    if (model->camera_count == 0) {
        cli_error(job->camera_option, "%s has no cameras", job->model_path);
    } else if (job->camera == CLI_CAMERA_INDEX) {
        cli_error(job->camera_option, "%s has the cameras 0..%u only", job->model_path,
                  model->camera_count - 1);
    } else {
        cli_error(job->camera_option, "%s has no camera named '%s'", job->model_path, job->camera_name);
    }
    return false;
}

static bool look_from_numbers(const struct cli_render_job *job, const struct scene_model *model,
                              struct scene_camera *camera)
{
    double vectors[3][3];
    char error[256];
    for (int i = 0; i < 9; i++) {
        vectors[i / 3][i % 3] = job->look[i];
    }
    const bool looks = job->orthographic
                           ? scene_camera_look_orthographic(camera, model, vectors[0], vectors[1], vectors[2],
                                                            job->look[9], error, sizeof error)
                           : scene_camera_look(camera, model, vectors[0], vectors[1], vectors[2],
                                               job->look[9] * degree, error, sizeof error);
    if (!looks) {
        cli_error("--camera", "%s", error);
    }
    return looks;
}

// `turn_center` NULL: the model stands still.
static struct scene_camera fit(const struct cli_render_job *job, const struct scene_model *model,
                               const double *turn_center)
{
    const enum scene_axis up = job->has_up ? job->up : model->up;
    const bool is_chosen = job->camera == CLI_CAMERA_ORBIT || job->camera == CLI_CAMERA_VIEWS;
    struct scene_orbit orbit = is_chosen ? job->orbit : scene_camera_default_orbit(model, up);
    orbit.azimuth += is_chosen ? scene_camera_front(model) : 0.0;
    orbit.up = up;
    orbit.whole = job->fit_all;
    orbit.turns = turn_center != NULL;
    if (turn_center) {
        memcpy(orbit.turn_center, turn_center, sizeof orbit.turn_center);
    }
    const struct scene_framing framing = {.orbit = orbit,
                                          .yfov = (double)job->fovy * degree,
                                          .orthographic = job->orthographic,
                                          .zoom = job->zoom,
                                          .margin = job->margin};
    return scene_camera_frame(model, &framing, (double)job->width / (double)job->height);
}

struct scene_camera cli_camera_fit(const struct cli_render_job *job, const struct scene_model *model)
{
    return fit(job, model, NULL);
}

struct scene_camera cli_camera_fit_turn(const struct cli_render_job *job, const struct scene_model *model,
                                        const double center[3])
{
    return fit(job, model, center);
}

bool cli_camera_choose(const struct cli_render_job *job, const struct scene_model *model,
                       struct scene_camera *camera, bool *distrusted)
{
    *distrusted = false;
    if (job->camera == CLI_CAMERA_LOOK) {
        return look_from_numbers(job, model, camera);
    }
    const bool fitted = job->camera >= CLI_CAMERA_FIT && job->camera <= CLI_CAMERA_VIEWS;
    const struct scene_model_camera *found = fitted ? NULL : cli_camera_find(job, model);
    if (!fitted && !found && job->camera != CLI_CAMERA_AUTO) {
        return report_missing_camera(job, model);
    }
    const double aspect = (double)job->width / (double)job->height;
    *camera = found ? scene_camera_from_model(model, found, aspect) : cli_camera_fit(job, model);
    const enum scene_sight sight = found && job->camera == CLI_CAMERA_AUTO
                                       ? scene_camera_sight(model, camera, aspect)
                                       : SCENE_SIGHT_ENOUGH;
    if (sight != SCENE_SIGHT_ENOUGH) {
        if (!job->quiet && !job->strict) {
            cli_warning(job->model_path, "its camera sees %s of the model, which is fitted instead",
                        sight == SCENE_SIGHT_NOTHING ? "nothing" : "next to nothing");
        }
        *camera = cli_camera_fit(job, model);
        *distrusted = true;
    }
    return true;
}

void cli_camera_print(const struct scene_camera *camera)
{
    const int digits = scene_camera_digits(camera->eye, camera->target);
    printf("%s--camera ", camera->orthographic ? "--ortho " : "");
    for (int i = 0; i < 9; i++) {
        const double *vector = i < 3 ? camera->eye : i < 6 ? camera->target : camera->up;
        printf("%.*g,", i < 6 ? digits : 9, vector[i % 3]);
    }
    printf("%.9g\n", camera->orthographic ? 2.0 * camera->ymag : camera->yfov / degree);
}
