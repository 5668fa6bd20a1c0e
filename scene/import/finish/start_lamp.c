// SPDX-License-Identifier: MIT
// A lamp that somebody moved was meant, so the one that stands where all versions put it is looked for.
#include "start_lamp.h"

#include <string.h>
#include <strings.h>

#include "draw/camera/camera.h"

static bool is_start_lamp(const struct scene_model_light *light)
{
    static const double start[3] = {4.07624531, 1.00545394, 5.903862};
    bool is_there = light->type == SCENE_LIGHT_POINT;
    for (int c = 0; c < 3; c++) {
        const double off = (double)light->position[c] - start[c];
        is_there = is_there && off < 1e-4 && off > -1e-4;
    }
    return is_there;
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
    uint32_t lamp = 0;
    while (lamp < model->light_count && !is_start_lamp(&model->lights[lamp])) {
        lamp++;
    }
    // A model that is made of arrays has no ending.
    if (lamp == model->light_count || !import->ending || strcasecmp(import->ending, "blend") != 0 ||
        !gives_way(model)) {
        return;
    }
    scene_import_warn(import,
                      "light \"%s\" of Blender's start file: left out, as its camera sees next to nothing",
                      model->lights[lamp].name);
    model->light_count--;
    memmove(&model->lights[lamp], &model->lights[lamp + 1],
            (model->light_count - lamp) * sizeof *model->lights);
}
