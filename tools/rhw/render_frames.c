// SPDX-License-Identifier: MIT
// Pictures that follow one another, of a model that is animated or turned: files with a number in their names, or one that
// moves.
#include "message.h"
#include "movement.h"
#include "moving_write.h"

#include <string.h>

static bool is_sequence(const struct cli_render_job *job)
{
    return strstr(job->out, "{frame}") != NULL;
}

static enum cli_output_kind only_kind(const struct cli_render_job *job)
{
    int kind = 0;
    while (!(job->kinds >> kind & 1)) {
        kind++;
    }
    return (enum cli_output_kind)kind;
}

// The pose and the camera of a picture, drawn.
static bool draw_frame(struct render *render, const struct cli_movement *movement,
                       const struct scene_camera *first, int frame, struct scene_model **pose)
{
    cli_progress(render->job.model_path, frame, movement->frame_count);
    if (movement->seconds > 0.0) {
        struct scene_model *const next = cli_movement_pose(movement, render, frame);
        if (!next) {
            return false;
        }
        const enum rhw_result result = scene_set_pose(render->scene, next);
        cli_movement_free_pose(*pose);
        *pose = next;
        if (result != RHW_OK) {
            cli_error(render->job.model_path, "%s", rhw_result_string(result));
            return false;
        }
    }
    render->view.camera = cli_movement_turned(movement, first, &render->job, frame);
    return cli_render_draw(render);
}

static bool draw_sequence(struct render *render, const struct cli_movement *movement,
                          struct scene_model **pose)
{
    const struct scene_camera first = render->view.camera;
    bool going = true;
    for (int frame = 0; frame < movement->frame_count && going; frame++) {
        cli_render_files_forget(render);
        going = draw_frame(render, movement, &first, frame, pose) && cli_render_files_plan(render, frame) &&
                cli_render_files_write(render);
    }
    return going;
}

static bool draw_moving(struct render *render, const struct cli_movement *movement, struct scene_model **pose)
{
    const struct cli_render_job *const job = &render->job;
    const struct scene_camera first = render->view.camera;
    const enum cli_output_kind kind = only_kind(job);
    struct cli_output_file file;
    struct cli_moving moving;
    if (!cli_output_file_open(&file, render->paths[kind])) {
        return false;
    }
    cli_moving_open(&moving, &file, job->format, movement->frame_count, movement->rate, job->quality);
    bool going = true;
    for (int frame = 0; frame < movement->frame_count && going; frame++) {
        struct cli_output_raster output;
        going = draw_frame(render, movement, &first, frame, pose);
        if (going) {
            cli_render_rasterize(render, kind, &output);
            going = cli_moving_add(&moving, &output.raster);
        }
    }
    going = going && cli_moving_finish(&moving);
    cli_moving_close(&moving);
    cli_progress_end();
    if (going && cli_output_file_finish(&file)) {
        return cli_output_file_commit(&file);
    }
    cli_output_file_discard(&file);
    return false;
}

bool cli_render_frames(struct render *render)
{
    struct cli_movement movement;
    struct scene_model *pose = NULL;
    if (!cli_movement_plan(&movement, &render->job, render->model)) {
        return false;
    }
    cli_progress(render->job.model_path, 0, movement.frame_count);
    if (!cli_movement_camera(&movement, render)) {
        cli_progress_end();
        return false;
    }
    const bool drawn = is_sequence(&render->job) ? draw_sequence(render, &movement, &pose)
                                                 : draw_moving(render, &movement, &pose);
    cli_progress_end();
    // The scene still has the last pose.
    scene_destroy(render->scene);
    render->scene = NULL;
    cli_movement_free_pose(pose);
    return drawn;
}
