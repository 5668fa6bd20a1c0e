// SPDX-License-Identifier: MIT
#include "vicinity.h"

#include <stdlib.h>
#include <string.h>

#include "camera/camera_math.h"
#include "camera/subject.h"

// Return the distance of a point from a box, plus the size of the box. A picture of the box from there shows no detail
// that is much smaller than this.
static double distance_from(const struct scene_box *box, const double point[3])
{
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
        const double below = box->low[c] - point[c], above = point[c] - box->high[c];
        const double apart = below > 0.0 ? below : above > 0.0 ? above : 0.0;
        square += apart * apart;
    }
    return __builtin_sqrt(square) + scene_box_longest(box);
}

void scene_vicinity_origin(const struct scene_model *model, const struct scene_camera *camera,
                           double origin[3])
{
    const struct scene_camera own = scene_camera_from_origin(camera, model->origin);
    const double *const eye = own.orthographic ? own.target : own.eye;
    double least = 1e300, place[3] = {0.0, 0.0, 0.0};
    memcpy(origin, model->origin, sizeof place);
    for (uint32_t i = 0; i < model->instance_count && model->is_scattered; i++) {
        const struct scene_box box = scene_subject_box(model, i);
        const double distance = distance_from(&box, eye);
        if (!model->instances[i].unseen && distance < least) {
            least = distance;
            scene_exact_place(model->instances[i].world + 12, model->instances[i].place, place);
        }
    }
    if (scene_dot(place, place) > SCENE_REMOTE * least * (SCENE_REMOTE * least)) {
        for (int c = 0; c < 3; c++) {
            origin[c] += place[c];
        }
    }
}

// Move a place by what the new origin is away from the old one.
static void move(float floats[3], double exact[3], const double way[3])
{
    double place[3];
    scene_exact_place(floats, exact, place);
    for (int c = 0; c < 3; c++) {
        exact[c] = place[c] - way[c];
        floats[c] = (float)exact[c];
    }
}

static void move_box(float low[3], float high[3], const double way[3])
{
    for (int c = 0; c < 3; c++) {
        low[c] = (float)((double)low[c] - way[c]);
        high[c] = (float)((double)high[c] - way[c]);
    }
}

void scene_vicinity_free(struct scene_vicinity *vicinity)
{
    free(vicinity->instances);
    free(vicinity->cameras);
    free(vicinity->lights);
    *vicinity = (struct scene_vicinity){.instances = NULL};
}

bool scene_vicinity_get(struct scene_vicinity *vicinity, const struct scene_model *model,
                        const double origin[3])
{
    struct scene_model *const own = &vicinity->model;
    if (vicinity->instances && memcmp(own->origin, origin, sizeof own->origin) == 0) {
        return true;
    }
    scene_vicinity_free(vicinity);
    *vicinity =
        (struct scene_vicinity){.model = *model,
                                .instances = calloc(model->instance_count + 1, sizeof *own->instances),
                                .cameras = calloc(model->camera_count + 1, sizeof *own->cameras),
                                .lights = calloc(model->light_count + 1, sizeof *own->lights)};
    if (!vicinity->instances || !vicinity->cameras || !vicinity->lights) {
        scene_vicinity_free(vicinity);
        return false;
    }
    double way[3];
    for (int c = 0; c < 3; c++) {
        way[c] = origin[c] - model->origin[c];
        own->origin[c] = origin[c];
    }
    own->instances = vicinity->instances;
    own->cameras = vicinity->cameras;
    own->lights = vicinity->lights;
    for (uint32_t i = 0; i < model->instance_count; i++) {
        own->instances[i] = model->instances[i];
        move(own->instances[i].world + 12, own->instances[i].place, way);
    }
    for (uint32_t i = 0; i < model->camera_count; i++) {
        own->cameras[i] = model->cameras[i];
        move(own->cameras[i].world + 12, own->cameras[i].place, way);
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        own->lights[i] = model->lights[i];
        move(own->lights[i].position, own->lights[i].place, way);
    }
    move_box(own->bounds_min, own->bounds_max, way);
    move_box(own->frame_min, own->frame_max, way);
    return true;
}
