// SPDX-License-Identifier: MIT
// See movement.h.
#include "movement.h"

#include "elementary.h"
#include "message.h"
#include "render_camera.h"
#include "draw/camera/subject.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POSES_SEEN = 12, DEFAULT_RATE = 30 };

uint32_t cli_movement_animation(const struct cli_render_job *job, const struct scene_model *model)
{
    for (uint32_t i = 0; job->animation && i < model->animation_count; i++) {
        if (strcmp(model->animations[i].name, job->animation) == 0) {
            return i;
        }
    }
    return job->animation ? (uint32_t)atoi(job->animation) : 0; // the reader has looked at it
}

static double animation_seconds(const struct cli_render_job *job, const struct scene_model *model)
{
    const uint32_t chosen = cli_movement_animation(job, model);
    return chosen < model->animation_count ? (double)model->animations[chosen].seconds : 0.0;
}

bool cli_movement_plan(struct cli_movement *movement, const struct cli_render_job *job,
                       const struct scene_model *model)
{
    enum { MOST_FRAMES = 100000 };
    *movement = (struct cli_movement){.rate = job->rate > 0.0 ? job->rate : DEFAULT_RATE};
    if (job->rate > 0.0) {
        movement->seconds = animation_seconds(job, model);
    }
    const double frames =
        job->turntable > 0 ? job->turntable : ceil(movement->seconds * movement->rate - 1e-6);
    if (frames > MOST_FRAMES) {
        cli_error(job->turntable > 0 ? "--turntable" : "--animate", "%.0f pictures are more than %d", frames,
                  MOST_FRAMES);
        return false;
    }
    movement->frame_count = frames < 1.0 ? 1 : (int)frames;
    double up[3] = {0.0, 1.0, 0.0};
    scene_axis_turn(job->has_up ? job->up : model->up, up);
    memcpy(movement->axis, up, sizeof up);
    return true;
}

// Seconds into the animation, which begins again when it is over.
static double time_of(const struct cli_movement *movement, double frame)
{
    const double time = frame / movement->rate;
    return movement->seconds > 0.0 ? time - movement->seconds * floor(time / movement->seconds) : 0.0;
}

// What is returned stands before the model that was read, so that both can be freed.
struct pose {
    struct scene_model model;
    struct scene_model *read;
};

struct scene_model *cli_pose_read(const struct render *render, double time)
{
    const struct cli_render_job *const job = &render->job;
    const struct scene_model *const base = render->model;
    struct pose *const pose = malloc(sizeof *pose);
    struct scene_model *const read =
        pose ? cli_model_input_load(&render->input, &job->budget,
                                    (struct scene_model_options){.variant = job->variant,
                                                                 .is_posed = true,
                                                                 .animation = job->animation,
                                                                 .time = time,
                                                                 .without_images = true,
                                                                 .goes_on = render->goes_on,
                                                                 .user = render->user})
             : NULL;
    if (!read || read->material_count != base->material_count || read->image_count != base->image_count) {
        if (!pose || read) {
            cli_error(job->model_path, pose ? "the file has changed while it was drawn" : "out of memory");
        }
        if (read) {
            scene_model_free(read);
        }
        free(pose);
        return NULL;
    }
    *pose = (struct pose){*read, read};
    pose->model.materials = base->materials;
    pose->model.images = base->images;
    return &pose->model;
}

struct scene_model *cli_movement_pose(const struct cli_movement *movement, const struct render *render,
                                      int frame)
{
    return cli_pose_read(render, time_of(movement, frame));
}

void cli_movement_free_pose(struct scene_model *model)
{
    struct pose *const pose = (struct pose *)(void *)model;
    if (pose) {
        scene_model_free(pose->read);
        free(pose);
    }
}

// The camera ----------------------------------------------------------------------------------------

static void set_frame(struct scene_model *model, const struct scene_box *frame)
{
    for (int c = 0; c < 3; c++) {
        model->frame_min[c] = (float)frame->low[c];
        model->frame_max[c] = (float)frame->high[c];
    }
}

// All poses in one model, which borrows what they have.
static struct scene_model merge(struct scene_model *const *poses, int count, struct scene_mesh *meshes,
                                struct scene_instance *instances)
{
    struct scene_model all = *poses[0];
    all.meshes = meshes;
    all.instances = instances;
    all.mesh_count = all.instance_count = 0;
    for (int p = 0; p < count; p++) {
        all.is_framed = all.is_framed || poses[p]->is_framed;
    }
    const struct scene_box first = scene_subject_frame(poses[0]);
    set_frame(&all, &first);
    for (int p = 0; p < count; p++) {
        const struct scene_model *const pose = poses[p];
        const struct scene_box frame = scene_subject_frame(pose);
        double apart[3]; // from the origin of the first pose
        for (int c = 0; c < 3; c++) {
            apart[c] = pose->origin[c] - all.origin[c];
        }
        for (uint32_t i = 0; i < pose->instance_count; i++) {
            struct scene_instance *const instance = &all.instances[all.instance_count++];
            *instance = pose->instances[i];
            instance->mesh += all.mesh_count;
            for (int c = 0; c < 3; c++) {
                instance->world[12 + c] = (float)((double)instance->world[12 + c] + apart[c]);
                instance->place[c] = 0;
            }
        }
        memcpy(&all.meshes[all.mesh_count], pose->meshes, pose->mesh_count * sizeof *pose->meshes);
        all.mesh_count += pose->mesh_count;
        for (int c = 0; c < 3; c++) {
            all.bounds_min[c] = fminf(all.bounds_min[c], (float)((double)pose->bounds_min[c] + apart[c]));
            all.bounds_max[c] = fmaxf(all.bounds_max[c], (float)((double)pose->bounds_max[c] + apart[c]));
            all.frame_min[c] = fminf(all.frame_min[c], (float)(frame.low[c] + apart[c]));
            all.frame_max[c] = fmaxf(all.frame_max[c], (float)(frame.high[c] + apart[c]));
        }
    }
    return all;
}

static bool fit_to_all(struct cli_movement *movement, struct render *render, struct scene_model *const *poses,
                       int count)
{
    size_t meshes = 0, instances = 0;
    for (int p = 0; p < count; p++) {
        meshes += poses[p]->mesh_count;
        instances += poses[p]->instance_count;
    }
    struct scene_mesh *const mesh_list = malloc((meshes + 1) * sizeof *mesh_list);
    struct scene_instance *const instance_list = malloc((instances + 1) * sizeof *instance_list);
    const bool fitted = mesh_list && instance_list;
    if (fitted) {
        const struct scene_model all = merge(poses, count, mesh_list, instance_list);
        const struct scene_subject subject = scene_subject_find(&all);
        for (int c = 0; c < 3; c++) {
            movement->center[c] = 0.5 * (subject.box.low[c] + subject.box.high[c]) + all.origin[c];
        }
        const struct cli_render_job *const job = &render->job;
        const bool has_own = job->camera == CLI_CAMERA_AUTO && job->turntable == 0 &&
                             cli_camera_find(job, render->model) && !render->distrusts_camera;
        if (job->camera <= CLI_CAMERA_ORBIT && !has_own) {
            render->view.camera = job->turntable > 0 ? cli_camera_fit_turn(job, &all, movement->center)
                                                     : cli_camera_fit(job, &all);
        } else if (job->turntable > 0) {
            struct scene_orbit orbit = {.up = job->has_up ? job->up : all.up};
            memcpy(orbit.turn_center, movement->center, sizeof orbit.turn_center);
            scene_camera_enclose_turn(&render->view.camera, &all, &orbit);
        } else {
            scene_camera_enclose(&render->view.camera, &all);
        }
    } else {
        cli_error(render->job.model_path, "out of memory");
    }
    free(mesh_list);
    free(instance_list);
    return fitted;
}

bool cli_movement_camera(struct cli_movement *movement, struct render *render)
{
    struct scene_model *poses[POSES_SEEN] = {render->model};
    const int most = movement->frame_count < POSES_SEEN ? movement->frame_count : POSES_SEEN;
    const int count = movement->seconds > 0.0 ? most : 1;
    bool complete = true;
    for (int p = 0; p < count && movement->seconds > 0.0 && complete; p++) {
        poses[p] = cli_pose_read(render, movement->seconds * p / count);
        complete = poses[p] != NULL;
    }
    complete = complete && fit_to_all(movement, render, poses, count);
    for (int p = 0; p < count && movement->seconds > 0.0; p++) {
        cli_movement_free_pose(poses[p]);
    }
    return complete;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void turn(const struct cli_movement *movement, double sine, double cosine, const double center[3],
                 double point[3])
{
    // Rodrigues' formula.
    const double *const k = movement->axis;
    double v[3], turned[3];
    for (int c = 0; c < 3; c++) {
        v[c] = point[c] - center[c];
    }
    const double along = dot(k, v) * (1.0 - cosine);
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3, e = (c + 2) % 3;
        turned[c] = v[c] * cosine + (k[d] * v[e] - k[e] * v[d]) * sine + k[c] * along;
    }
    for (int c = 0; c < 3; c++) {
        point[c] = center[c] + turned[c];
    }
}

struct scene_camera cli_movement_turned(const struct cli_movement *movement, const struct scene_camera *first,
                                        const struct cli_render_job *job, int frame)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    struct scene_camera camera = *first;
    double sine, cosine;
    if (job->turntable > 0) {
        scene_sin_cos_degrees(360.0 * frame / job->turntable, &sine, &cosine);
        turn(movement, sine, cosine, movement->center, camera.eye);
        turn(movement, sine, cosine, movement->center, camera.target);
        turn(movement, sine, cosine, origin, camera.up);
    }
    return camera;
}
