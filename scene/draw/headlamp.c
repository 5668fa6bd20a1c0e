// SPDX-License-Identifier: MIT
#include "headlamp.h"

#include "draw/camera/camera_math.h"
#include "draw/camera/subject.h"

// This share of a model's size and of its distance from a camera counts as no distance.
static const double least_share = 1e-4;
// Directions whose cosine is larger are one.
static const double same_way = 0.999;

static void normalize(double vector[3])
{
    const double length = __builtin_sqrt(scene_dot(vector, vector));
    for (int c = 0; c < 3; c++) {
        vector[c] /= length;
    }
}

static double distance_between(const double a[3], const double b[3])
{
    const double way[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return __builtin_sqrt(scene_dot(way, way));
}

static void find_camera(const struct scene_model_camera *camera, double eye[3], double forward[3])
{
    scene_exact_place(camera->world + 12, camera->place, eye);
    for (int c = 0; c < 3; c++) {
        forward[c] = -(double)camera->world[8 + c];
    }
    normalize(forward);
}

// Return what is no distance from a camera at `eye`.
static double find_room(const struct scene_model *model, const double eye[3])
{
    const struct scene_box frame = scene_subject_frame(model);
    double middle[3], longest = 0.0;
    for (int c = 0; c < 3; c++) {
        const double side = frame.high[c] - frame.low[c];
        middle[c] = 0.5 * (frame.low[c] + frame.high[c]);
        longest = side > longest ? side : longest;
    }
    return least_share * (longest + distance_between(eye, middle));
}

struct scene_headlamp scene_headlamp_find(const struct scene_model *model, const struct scene_camera *camera)
{
    struct scene_headlamp headlamp = {.is_carried = false};
    for (int c = 0; c < 3; c++) {
        headlamp.bearer[c] = camera->eye[c];
        headlamp.onward[c] = camera->target[c] - camera->eye[c];
    }
    normalize(headlamp.onward);
    if (model->camera_count > 0) {
        find_camera(&model->cameras[0], headlamp.eye, headlamp.forward);
        headlamp.room = find_room(model, headlamp.eye);
        headlamp.is_carried = !(distance_between(headlamp.eye, headlamp.bearer) <= headlamp.room &&
                                scene_dot(headlamp.forward, headlamp.onward) >= same_way);
    }
    return headlamp;
}

struct scene_model_light scene_headlamp_carry(const struct scene_headlamp *headlamp,
                                              const struct scene_model_light *light)
{
    struct scene_model_light carried = *light;
    double place[3], cosine = 0.0;
    scene_exact_place(light->position, light->place, place);
    for (int c = 0; c < 3; c++) {
        cosine += headlamp->forward[c] * (double)light->direction[c];
    }
    if (headlamp->is_carried && distance_between(place, headlamp->eye) <= headlamp->room &&
        (light->type == SCENE_LIGHT_POINT || cosine >= same_way)) {
        for (int c = 0; c < 3; c++) {
            carried.place[c] = headlamp->bearer[c];
            carried.position[c] = (float)headlamp->bearer[c];
            carried.direction[c] = (float)headlamp->onward[c];
        }
        carried.range = 0.0f; // it was chosen for another distance
    }
    return carried;
}
