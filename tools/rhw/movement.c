// SPDX-License-Identifier: MIT
// See movement.h.
#include "movement.h"

#include "elementary.h"
#include "message.h"
#include "render_camera.h"
#include "subject.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POSES_SEEN = 12, DEFAULT_RATE = 30, PROFILE = 128, SPOKES = 64 };

static double animation_seconds(const struct cli_render_job *job, const struct scene_model *model)
{
    uint32_t chosen = 0;
    bool named = false;
    for (uint32_t i = 0; job->animation && i < model->animation_count && !named; i++) {
        named = strcmp(model->animations[i].name, job->animation) == 0;
        chosen = named ? i : chosen;
    }
    if (job->animation && !named) {
        chosen = (uint32_t)atoi(job->animation); // the reader has looked at it
    }
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
        cli_error("--animate", "%.0f pictures are more than %d", frames, MOST_FRAMES);
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

static struct scene_model *read_pose(const struct render *render, double time)
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
                                                                 .without_images = true})
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
    return read_pose(render, time_of(movement, frame));
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

// All poses in one model, which borrows what they have.
static struct scene_model merge(struct scene_model *const *poses, int count, struct scene_mesh *meshes,
                                struct scene_instance *instances)
{
    struct scene_model all = *poses[0];
    all.meshes = meshes;
    all.instances = instances;
    all.mesh_count = all.instance_count = 0;
    for (int p = 0; p < count; p++) {
        const struct scene_model *const pose = poses[p];
        for (uint32_t i = 0; i < pose->instance_count; i++) {
            all.instances[all.instance_count] = pose->instances[i];
            all.instances[all.instance_count++].mesh += all.mesh_count;
        }
        memcpy(&all.meshes[all.mesh_count], pose->meshes, pose->mesh_count * sizeof *pose->meshes);
        all.mesh_count += pose->mesh_count;
        for (int c = 0; c < 3; c++) {
            all.bounds_min[c] = fminf(all.bounds_min[c], pose->bounds_min[c]);
            all.bounds_max[c] = fmaxf(all.bounds_max[c], pose->bounds_max[c]);
        }
    }
    return all;
}

// How far from the axis things are at each height.
struct profile {
    double low, high;       // along the axis
    double radius[PROFILE]; // negative: nothing is there
    double side[2][3];      // across it, with it a right-handed system
};

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void measure_profile(const struct cli_movement *movement, const struct scene_model *all,
                            struct profile *profile)
{
    for (int i = 0; i < PROFILE; i++) {
        profile->radius[i] = -1.0;
    }
    const struct scene_subject subject = scene_subject_find(all);
    for (uint32_t i = 0; i < all->instance_count; i++) {
        const struct scene_instance *const instance = &all->instances[i];
        const struct scene_mesh *const mesh = &all->meshes[instance->mesh];
        for (uint32_t v = 0; v < mesh->vertex_count && scene_subject_has(&subject, all, i); v++) {
            double from[3];
            for (int r = 0; r < 3; r++) {
                from[r] = (double)instance->world[12 + r] - movement->center[r];
                for (int c = 0; c < 3; c++) {
                    from[r] += (double)instance->world[4 * c + r] * (double)mesh->positions[v][c];
                }
            }
            const double x = dot(from, profile->side[0]), y = dot(from, profile->side[1]);
            const double part = (dot(from, movement->axis) - profile->low) / (profile->high - profile->low);
            const int at = part <= 0.0 ? 0 : part >= 1.0 ? PROFILE - 1 : (int)(part * PROFILE);
            profile->radius[at] = fmax(profile->radius[at], sqrt(x * x + y * y));
        }
    }
}

// The rings that the profile sweeps, around the axis, as vertices of a mesh.
static uint32_t make_rings(const struct cli_movement *movement, const struct profile *profile,
                           float (*positions)[3])
{
    uint32_t count = 0;
    for (int i = 0; i < 2 * PROFILE; i++) {
        const double radius = profile->radius[i / 2];
        const double height =
            profile->low + (profile->high - profile->low) * (double)((i + 1) / 2) / (double)PROFILE;
        for (int k = 0; k < SPOKES && radius >= 0.0; k++) {
            double sine, cosine;
            scene_sin_cos_degrees(360.0 * k / SPOKES, &sine, &cosine);
            for (int c = 0; c < 3; c++) {
                positions[count][c] =
                    (float)(movement->center[c] + movement->axis[c] * height +
                            radius * (profile->side[0][c] * cosine + profile->side[1][c] * sine));
            }
            count++;
        }
    }
    return count;
}

// What a turntable sweeps.
static bool fit_to_rings(struct cli_movement *movement, struct render *render, const struct scene_model *all)
{
    struct profile *const profile = malloc(sizeof *profile);
    float(*const positions)[3] = malloc((size_t)2 * PROFILE * SPOKES * sizeof *positions);
    if (!profile || !positions) {
        free(profile);
        free(positions);
        cli_error(render->job.model_path, "out of memory");
        return false;
    }
    profile->low = INFINITY;
    profile->high = -INFINITY;
    for (int k = 0; k < 8; k++) {
        double from[3];
        for (int c = 0; c < 3; c++) {
            from[c] = (double)(k >> c & 1 ? all->bounds_max[c] : all->bounds_min[c]) - movement->center[c];
        }
        profile->low = fmin(profile->low, dot(from, movement->axis));
        profile->high = fmax(profile->high, dot(from, movement->axis));
    }
    profile->high = profile->high > profile->low ? profile->high : profile->low + 1e-9;
    const int first = movement->axis[0] * movement->axis[0] > 0.5 ? 1 : 0;
    memset(profile->side, 0, sizeof profile->side);
    profile->side[0][first] = 1.0; // axes are those of the world
    profile->side[1][movement->axis[1] * movement->axis[1] > 0.5 || first == 1 ? 2 : 1] = 1.0;
    measure_profile(movement, all, profile);
    struct scene_mesh mesh = {.name = "", .primitive = SCENE_PRIMITIVE_POINTS, .positions = positions};
    mesh.vertex_count = make_rings(movement, profile, positions);
    struct scene_instance instance = {.name = ""};
    instance.world[0] = instance.world[5] = instance.world[10] = instance.world[15] = 1.0f;
    struct scene_model rings = *all;
    rings.meshes = &mesh;
    rings.instances = &instance;
    rings.mesh_count = rings.instance_count = 1;
    for (uint32_t v = 0; v < mesh.vertex_count; v++) {
        for (int c = 0; c < 3; c++) {
            rings.bounds_min[c] = v ? fminf(rings.bounds_min[c], positions[v][c]) : positions[v][c];
            rings.bounds_max[c] = v ? fmaxf(rings.bounds_max[c], positions[v][c]) : positions[v][c];
        }
    }
    memcpy(mesh.bounds_min, rings.bounds_min, sizeof mesh.bounds_min);
    memcpy(mesh.bounds_max, rings.bounds_max, sizeof mesh.bounds_max);
    // The angle at which the model itself shows best.
    if (render->job.camera != CLI_CAMERA_ORBIT) {
        const enum scene_axis up = render->job.has_up ? render->job.up : all->up;
        render->job.orbit = scene_camera_default_orbit(all, up);
        render->job.camera = CLI_CAMERA_ORBIT;
    }
    render->view.camera = cli_camera_fit(&render->job, &rings);
    free(profile);
    free(positions);
    return true;
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
    bool fitted = mesh_list && instance_list;
    if (fitted) {
        const struct scene_model all = merge(poses, count, mesh_list, instance_list);
        const struct scene_subject subject = scene_subject_find(&all);
        for (int c = 0; c < 3; c++) {
            movement->center[c] = subject.is_all
                                      ? 0.5 * ((double)all.bounds_min[c] + (double)all.bounds_max[c])
                                      : 0.5 * (subject.low[c] + subject.high[c]);
        }
        const struct cli_render_job *const job = &render->job;
        const bool has_own = job->camera == CLI_CAMERA_AUTO && job->turntable == 0 &&
                             cli_camera_find(job, render->model) && !render->distrusts_camera;
        if (job->camera > CLI_CAMERA_ORBIT || has_own) {
            scene_camera_enclose(&render->view.camera, &all);
        } else if (job->turntable > 0) {
            fitted = fit_to_rings(movement, render, &all);
        } else {
            render->view.camera = cli_camera_fit(job, &all);
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
        poses[p] = read_pose(render, movement->seconds * p / count);
        complete = poses[p] != NULL;
    }
    complete = complete && fit_to_all(movement, render, poses, count);
    for (int p = 0; p < count && movement->seconds > 0.0; p++) {
        cli_movement_free_pose(poses[p]);
    }
    return complete;
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
