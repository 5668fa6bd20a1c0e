// SPDX-License-Identifier: MIT
// What is seen through surfaces that light passes through: everything else, drawn before them, as light before tone
// mapping, with a chain of levels, of which rough surfaces read the blurred ones. Such surfaces do not see each other.
#include "drawing.h"

#include "screen.h"

#include <string.h>

enum { LARGEST_SIDE = 2048, SAMPLES = 4 };

static bool any_transmits(const struct scene_model *model)
{
    bool found = false;
    for (uint32_t i = 0; i < model->instance_count && !found; i++) {
        found = scene_material_transmits(&model->materials[model->meshes[model->instances[i].mesh].material]);
    }
    return found;
}

static enum rhw_result draw_surfaces(struct draw *draw, int width, int height)
{
    static const enum rhw_format format = RHW_FORMAT_RGBA16_FLOAT;
    struct scene *scene = draw->scene;
    rhw_context *context = scene->upload.context;
    struct scene_frame frame = draw->frame;
    frame.display_slot = -1;
    frame.linear_slot = 0;
    // As if the picture had that size: its pixels are as many of this one's.
    const float side = (float)width / (float)draw->view->width;
    frame.samples = side;
    frame.first_row = 0.0f;
    frame.pixel[0] = 2.0f / (float)width;
    frame.pixel[1] = 2.0f / (float)height;
    struct scene_background_pass background;
    scene_background_set(draw, 1, 0, &background);
    background.gradient.inverse_side *= 1.0f / side;
    for (int i = 0; i < 2; i++) {
        background.panorama.scale[i] *= 1.0f / side;
    }
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 1;
    def.colors[0] = (struct rhw_color_attachment){.texture = scene->backdrop.texture};
    memcpy(def.colors[0].clear, background.gradient.top, sizeof background.gradient.top);
    def.depth =
        (struct rhw_depth_attachment){.enabled = true, .load = RHW_LOAD_CLEAR, .store = RHW_STORE_DISCARD};
    def.samples = SAMPLES;
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    result = scene_background_record(draw, pass, true, &format, 1, &background);
    struct scene_surface_pass surfaces = {.frame = &frame,
                                          .solid = true,
                                          .order = &scene->order,
                                          .interpolate = draw->view->interpolate,
                                          .formats = {format},
                                          .format_count = 1,
                                          .environment = scene->surroundings.cube,
                                          .environment_sampler = scene->surroundings.cube_sampler};
    memcpy(surfaces.view_projection, draw->view_projection, sizeof surfaces.view_projection);
    if (result == RHW_OK) {
        result = scene_surfaces_record(&scene->upload, &scene->pipelines, &surfaces, pass);
    }
    return scene_pass_end(context, pass, result, NULL);
}

static enum rhw_result get_sampler(struct scene *scene)
{
    if (scene->backdrop_sampler.generation) {
        return RHW_OK;
    }
    struct rhw_sampler_def def = rhw_sampler_def_default();
    def.address_u = def.address_v = RHW_ADDRESS_CLAMP;
    return rhw_sampler_create(scene->upload.context, &def, &scene->backdrop_sampler);
}

enum rhw_result scene_draw_backdrop(struct draw *draw)
{
    struct scene *scene = draw->scene;
    const struct scene_view *view = draw->view;
    if (draw->frame.plain || !any_transmits(scene->upload.model)) {
        return RHW_OK;
    }
    const int longer = view->width > view->height ? view->width : view->height;
    const double part = longer > LARGEST_SIDE ? (double)LARGEST_SIDE / longer : 1.0;
    const int width = (int)(view->width * part + 0.5), height = (int)(view->height * part + 0.5);
    const int least_width = width > 0 ? width : 1, least_height = height > 0 ? height : 1;
    enum rhw_result result = get_sampler(scene);
    if (result == RHW_OK) {
        result = scene_target_get_levels(scene->upload.context, &scene->backdrop, RHW_FORMAT_RGBA16_FLOAT,
                                         least_width, least_height);
    }
    if (result == RHW_OK) {
        result = draw_surfaces(draw, least_width, least_height);
    }
    if (result == RHW_OK) {
        result = rhw_texture_generate_mips(scene->upload.context, scene->backdrop.texture);
    }
    int levels = 0;
    for (int side = least_width > least_height ? least_width : least_height; side > 1; side /= 2) {
        levels++;
    }
    draw->frame.backdrop_levels = (float)levels;
    return result;
}
