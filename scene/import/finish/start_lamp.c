// SPDX-License-Identifier: MIT
// A lamp that somebody moved was meant, so the one that stands where all versions put it is looked for.
#include "start_lamp.h"

#include "draw/camera/camera.h"

// Blender's z is up; what it exports has the axes in another order, with other signs, as its options say.
static bool is_start_lamp(const struct scene_model_light *light)
{
    static const double start[3] = {4.07624531, 1.00545394, 5.903862};
    bool is_there = light->type == SCENE_LIGHT_POINT;
    for (int c = 0; c < 3; c++) {
        bool has = false;
        for (int k = 0; k < 3; k++) {
            const double off = __builtin_fabs((double)light->position[k]) - start[c];
            has = has || (off < 1e-4 && off > -1e-4);
        }
        is_there = is_there && has;
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
    if (lamps == 1) {
        scene_import_warn(import,
                          "the lamp of Blender's start file: left out, as its camera sees next to nothing");
    } else {
        scene_import_warn(
            import, "%u lamps of Blender's start file: left out, as its camera sees next to nothing", lamps);
    }
}
