// SPDX-License-Identifier: MIT
// What every colour pass records of the surfaces, whoever begins it.
#include "drawing.h"

#include "explain_sample.h"

#include <string.h>

void scene_color_surfaces(const struct draw *draw, const enum rhw_format *formats, int format_count,
                          struct scene_surface_pass *surfaces)
{
    const struct scene *const scene = draw->scene;
    *surfaces = (struct scene_surface_pass){.frame = &draw->frame,
                                            .order = &scene->order,
                                            .program = &scene->program_draws,
                                            .interpolate = draw->view->interpolate,
                                            .wireframe = draw->view->wireframe,
                                            .format_count = format_count,
                                            .environment = scene->surroundings.cube,
                                            .environment_sampler = scene->surroundings.cube_sampler,
                                            .backdrop = scene->backdrop.picture.texture,
                                            .backdrop_sampler = scene->backdrop.sampler};
    memcpy(surfaces->formats, formats, (size_t)format_count * sizeof *formats);
    memcpy(surfaces->view_projection, draw->view_projection, sizeof surfaces->view_projection);
}

enum rhw_result scene_color_record(const struct draw *draw, const struct scene_surface_pass *surfaces,
                                   rhw_pass pass)
{
    struct scene *const scene = draw->scene;
    enum rhw_result result = RHW_OK;
    if (scene->ground.is_made) {
        struct scene_surface_pass below = *surfaces;
        below.part = SCENE_SURFACES_ALL;
        below.order = NULL;
        below.wireframe = SCENE_WIREFRAME_NONE;
        result = scene_surfaces_record(&scene->ground.upload, &scene->pipelines, &below, pass);
        for (uint32_t i = 0; below.log && i < below.log->count; i++) {
            below.log->draws[i].instance =
                below.log->draws[i].instance >= 0 ? SCENE_DRAWN_GROUND : below.log->draws[i].instance;
        }
    }
    return result == RHW_OK ? scene_surfaces_record(&scene->upload, &scene->pipelines, surfaces, pass)
                            : result;
}
