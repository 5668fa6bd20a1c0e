// SPDX-License-Identifier: MIT
// A lamp that somebody moved was meant, so the one that stands where all versions put it is looked for.
#include "start_lamp.h"

#include "draw/camera/camera.h"

// Blender's z is up; its exports to glTF and Collada have it as y.
static bool is_start_lamp(const struct scene_model_light *light)
{
    static const double start[2][3] = {{4.07624531, 1.00545394, 5.903862},
                                       {4.07624531, 5.903862, -1.00545394}};
    bool is_there[2] = {true, true};
    for (int c = 0; c < 3; c++) {
        for (int up = 0; up < 2; up++) {
            const double off = (double)light->position[c] - start[up][c];
            is_there[up] = is_there[up] && off < 1e-4 && off > -1e-4;
        }
    }
    return light->type == SCENE_LIGHT_POINT && (is_there[0] || is_there[1]);
}

static bool gives_way(const struct scene_model *model)
{
    const double aspect = 16.0 / 9.0;
    if (model->camera_count == 0) {
        return false;
    }
    const struct scene_camera camera = scene_camera_from_model(model, &model->cameras[0], aspect);
    return scene_camera_sight(model, &camera, aspect) != SCENE_SIGHT_ENOUGH;
}

void scene_import_drop_start_lamp(struct scene_import *import)
{
    struct scene_model *const model = &import->model;
    uint32_t lamps = 0, kept = 0;
    for (uint32_t i = 0; i < model->light_count; i++) {
        lamps += is_start_lamp(&model->lights[i]);
    }
    if (lamps == 0 || !gives_way(model)) {
        return;
    }
    for (uint32_t i = 0; i < model->light_count; i++) {
        if (!is_start_lamp(&model->lights[i])) {
            model->lights[kept++] = model->lights[i];
        }
    }
    model->light_count = kept;
    scene_import_warn(import,
                      "the lamp of Blender's start file: left out, as its camera sees next to nothing");
}
