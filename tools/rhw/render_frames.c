// SPDX-License-Identifier: MIT
// Pictures that follow one another, of a model that is animated or turned: files with a number in their names, or one
// that moves.
#include "frame_writer.h"
#include "message.h"
#include "pose_reader.h"

#include <stdlib.h>
#include <string.h>

static bool is_sequence(const struct cli_render_job *job)
{
    return cli_out_has(job, "{frame}");
}

// Pictures in the making.
struct frames {
    struct render *render;
    struct cli_movement movement;
    struct scene_camera first;     // that of the first picture
    struct cli_pose_reader reader; // of a model that is animated
    struct scene_model *pose;      // what the scene shows; NULL: the model as it was read
};

static bool pose_next(struct frames *frames)
{
    struct render *const render = frames->render;
    struct scene_model *const next = cli_pose_reader_next(&frames->reader);
    if (!next) {
        return false;
    }
    const enum rhw_result result = scene_set_pose(render->scene, next);
    cli_movement_free_pose(frames->pose);
    frames->pose = next;
    if (result != RHW_OK) {
        cli_error(render->job.model_path, "%s", rhw_result_string(result));
    }
    return result == RHW_OK;
}

// The pose and the camera of a picture, drawn.
static bool draw_frame(struct frames *frames, int frame)
{
    struct render *const render = frames->render;
    const struct cli_movement *const movement = &frames->movement;
    cli_progress(render->job.model_path, frame, movement->frame_count);
    if (movement->seconds > 0.0 && !pose_next(frames)) {
        return false;
    }
    render->view.camera = cli_movement_turned(movement, &frames->first, &render->job, frame);
    return cli_render_draw(render);
}

// Into files of their own, or into `moving`.
static bool draw_all(struct frames *frames, struct cli_moving *moving)
{
    struct render *const render = frames->render;
    struct cli_frame_writer *const writer = cli_frame_writer_open(render, moving);
    bool going = writer != NULL;
    for (int frame = 0; frame < frames->movement.frame_count && going; frame++) {
        cli_render_files_forget(render);
        going = draw_frame(frames, frame) && (moving || cli_render_files_plan(render, frame)) &&
                cli_frame_writer_add(writer, render);
    }
    const bool written = writer && cli_frame_writer_close(writer);
    return going && written;
}

// The one file there is.
static char *take_path(struct render *render)
{
    int kind = 0;
    while (!render->paths[kind]) {
        kind++;
    }
    char *const path = render->paths[kind];
    render->paths[kind] = NULL;
    return path;
}

static bool draw_moving(struct frames *frames, const char *path)
{
    const struct cli_render_job *const job = &frames->render->job;
    struct cli_output_file file;
    struct cli_moving moving;
    if (!cli_output_file_open(&file, path)) {
        return false;
    }
    cli_moving_open(&moving, &file, job->format, frames->movement.frame_count, frames->movement.rate,
                    job->quality);
    const bool drawn = draw_all(frames, &moving) && cli_moving_finish(&moving);
    cli_moving_close(&moving);
    cli_progress_end();
    if (drawn && cli_output_file_finish(&file)) {
        return cli_output_file_commit(&file);
    }
    cli_output_file_discard(&file);
    return false;
}

bool cli_render_frames(struct render *render)
{
    struct frames frames = {.render = render};
    if (!cli_movement_plan(&frames.movement, &render->job, render->model)) {
        return false;
    }
    cli_progress(render->job.model_path, 0, frames.movement.frame_count);
    if (!cli_movement_camera(&frames.movement, render)) {
        cli_progress_end();
        return false;
    }
    frames.first = render->view.camera;
    const bool animated = frames.movement.seconds > 0.0;
    if (animated) {
        cli_pose_reader_open(&frames.reader, &frames.movement, render);
    }
    char *const path = is_sequence(&render->job) ? NULL : take_path(render);
    const bool drawn = path ? draw_moving(&frames, path) : draw_all(&frames, NULL);
    free(path);
    if (animated) {
        cli_pose_reader_close(&frames.reader);
    }
    cli_progress_end();
    // The scene still has the last pose.
    scene_destroy(render->scene);
    render->scene = NULL;
    cli_movement_free_pose(frames.pose);
    return drawn;
}
