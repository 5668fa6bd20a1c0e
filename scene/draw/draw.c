// SPDX-License-Identifier: MIT
// A scene, and the order of a draw.
//
// Depth is reversed (1 near, 0 far): floats are densest where perspective leaves least, at the far end.
#include "drawing.h"

#include "draw/shading/color.h"

#include <stdlib.h>
#include <string.h>

// Scene ---------------------------------------------------------------------------------------------

enum rhw_result scene_create(rhw_context *context, const struct scene_model *model, struct scene **scene)
{
    const double start = scene_milliseconds();
    *scene = calloc(1, sizeof **scene);
    if (!*scene) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    struct rhw_sampler_def sampler = rhw_sampler_def_default();
    sampler.min_filter = sampler.mag_filter = RHW_FILTER_NEAREST;
    sampler.mip_filter = RHW_MIP_FILTER_NONE;
    sampler.address_u = sampler.address_v = RHW_ADDRESS_CLAMP;
    enum rhw_result result = scene_upload_create(context, model, &(*scene)->upload);
    if (result == RHW_OK) {
        result = rhw_sampler_create(context, &sampler, &(*scene)->nearest);
        if (result != RHW_OK) {
            scene_upload_destroy(&(*scene)->upload);
        }
    }
    if (result != RHW_OK) {
        free(*scene);
        *scene = NULL;
        return result;
    }
    (*scene)->upload_ms = scene_milliseconds() - start;
    return RHW_OK;
}

enum rhw_result scene_set_pose(struct scene *scene, const struct scene_model *pose)
{
    scene_triangle_order_destroy(scene->upload.context, &scene->order);
    scene_vicinity_free(&scene->vicinity);
    return scene_upload_pose(&scene->upload, pose);
}

void scene_destroy(struct scene *scene)
{
    if (!scene) {
        return;
    }
    rhw_context *context = scene->upload.context;
    scene_surface_pipelines_destroy(context, &scene->pipelines);
    for (int i = 0; i < TARGET_COUNT; i++) {
        scene_target_destroy(context, &scene->targets[i]);
    }
    scene_guide_destroy(context, &scene->guide);
    scene_guide_destroy(context, &scene->solid_guide);
    scene_ground_destroy(&scene->ground);
    scene_shadows_destroy(context, &scene->shadows);
    scene_surroundings_destroy(context, &scene->surroundings);
    scene_backdrop_destroy(context, &scene->backdrop);
    scene_peel_destroy(context, &scene->peel);
    scene_program_destroy(context, &scene->program_draws);
    scene_triangle_order_destroy(context, &scene->order);
    rhw_sampler_destroy(context, scene->nearest);
    scene_vicinity_free(&scene->vicinity);
    scene_upload_destroy(&scene->upload);
    free(scene);
}

// The order of a picture ----------------------------------------------------------------------------

static enum rhw_result set_frame(struct draw *draw)
{
    const struct scene_view *view = draw->view;
    struct scene_frame *frame = &draw->frame;
    scene_frame_look(frame, &view->camera, (double)view->width / view->height, &draw->lighting,
                     draw->view_projection);
    frame->tone = view->tone;
    frame->plain = view->wireframe == SCENE_WIREFRAME_PLAIN;
    for (int c = 0; c < 3; c++) {
        frame->line_color[c] = scene_color_decode(28);
        frame->plain_color[c] = scene_color_decode(226);
    }
    return RHW_OK;
}

static enum rhw_result sort_triangles(struct draw *draw)
{
    return scene_triangle_order_make(&draw->scene->order, &draw->scene->upload, &draw->frame);
}

// The light of the whole picture, before any of it is drawn.
static enum rhw_result draw_light(struct draw *draw)
{
    static enum rhw_result (*const steps[])(struct draw *) = {
        scene_draw_ground,    // the ground's surface and what lies on it
        scene_draw_guide,     // distances and normals
        scene_draw_occlusion, // how much of the surroundings each pixel's surface sees
        scene_draw_shadows,   // shadow maps
        sort_triangles,       // sorts blended surfaces from back to front
        scene_draw_backdrop,  // what is seen through surfaces
    };
    const double start = scene_milliseconds();
    enum rhw_result result = RHW_OK;
    for (size_t i = 0; i < sizeof steps / sizeof *steps && result == RHW_OK; i++) {
        result = steps[i](draw);
    }
    draw->stats.light_ms += scene_milliseconds() - start;
    return result;
}

// Colour is drawn into samples of a band and becomes rows of the pictures.
static enum rhw_result draw_samples(struct draw *draw, bool is_wide)
{
    draw->is_wide = is_wide;
    const double start = scene_milliseconds();
    enum rhw_result result = scene_color_begin(draw);
    if (result == RHW_OK && scene_peel_wanted(draw)) {
        result = scene_peel_opaque(draw); // background, ground, opaque surfaces
        if (result == RHW_OK) {
            result = scene_peel_blended(draw);
        }
    } else if (result == RHW_OK) {
        result =
            scene_color_draw(draw); // background, ground, opaque surfaces, blended ones; work on the tiles
    }
    draw->stats.color_ms += scene_milliseconds() - start;
    return result == RHW_OK ? scene_color_end(draw) : result;
}

// Colours of 8 bits and of more are drawn apart, since what is rounded and dithered differs.
static enum rhw_result draw_color_band(struct draw *draw)
{
    const struct scene_pictures *pictures = draw->pictures;
    enum rhw_result result = RHW_OK;
    if (pictures->color || !pictures->display) {
        result = draw_samples(draw, false);
    }
    return result == RHW_OK && pictures->display ? draw_samples(draw, true) : result;
}

static enum rhw_result draw_color(struct draw *draw)
{
    static const uint32_t colors = SCENE_OUTPUT_COLOR | SCENE_OUTPUT_LINEAR | SCENE_OUTPUT_DISPLAY |
                                   SCENE_OUTPUT_TILES | SCENE_OUTPUT_PLAN;
    if (!(draw->view->outputs & colors)) {
        return RHW_OK;
    }
    enum rhw_result result =
        scene_program_prepare(&draw->scene->program_draws, &draw->scene->upload, draw->view->program);
    if (result == RHW_OK) {
        result = draw_light(draw);
    }
    if (result != RHW_OK) {
        return result;
    }
    draw->band_rows = scene_color_rows(draw);
    scene_draw_set_samples(draw, draw->side);
    return scene_draw_bands(draw, draw_color_band);
}

// What is nearest at the centre of every pixel.
static enum rhw_result draw_data(struct draw *draw)
{
    return scene_draw_data(draw, SCENE_OUTPUT_ALL);
}

// How many surfaces there are at all; what work the tiles took was noted with the colours.
static enum rhw_result draw_work(struct draw *draw)
{
    return scene_draw_data(draw, SCENE_OUTPUT_OVERDRAW);
}

static enum rhw_result draw_picture(struct draw *draw)
{
    static enum rhw_result (*const steps[])(struct draw *) = {
        scene_draw_surround, set_frame, draw_color, draw_data, draw_work,
    };
    enum rhw_result result = scene_pictures_allocate(draw) ? RHW_OK : RHW_ERROR_OUT_OF_MEMORY;
    for (size_t i = 0; i < sizeof steps / sizeof *steps && result == RHW_OK; i++) {
        result = steps[i](draw);
    }
    return result;
}

// Draw from the origin of the model.
static enum rhw_result draw_near(struct scene *scene, const struct scene_view *view,
                                 struct scene_pictures *pictures, struct scene_draw_stats *stats)
{
    const struct scene_model *const model = scene->upload.model;
    *pictures = (struct scene_pictures){.width = view->width, .height = view->height};
    memcpy(pictures->origin, model->origin, sizeof pictures->origin);
    // All that is drawn is counted from the model's origin, where floats are dense.
    struct scene_view own = *view;
    own.camera = scene_camera_from_origin(&view->camera, model->origin);
    struct draw draw = {
        .scene = scene, .view = &own, .pictures = pictures, .side = scene_view_grid_side(view)};
    draw.stats.upload_ms = scene->upload_ms;
    enum rhw_result result = RHW_ERROR_OUT_OF_MEMORY;
    rhw_context_set_goes_on(scene->upload.context, view->goes_on, view->user);
    if (scene_lighting_create(&draw.lighting, model, &own.camera, view->up, view->default_lights,
                              view->exposure)) {
        draw.lighting.count = view->no_lights ? 0 : draw.lighting.count;
        result = draw_picture(&draw);
    }
    scene_lighting_destroy(&draw.lighting);
    rhw_context_set_goes_on(scene->upload.context, NULL, NULL);
    if (result != RHW_OK) {
        scene_pictures_free(pictures);
    }
    if (stats) {
        *stats = draw.stats;
    }
    return result;
}

enum rhw_result scene_draw(struct scene *scene, const struct scene_view *view,
                           struct scene_pictures *pictures, struct scene_draw_stats *stats)
{
    const struct scene_model *const model = scene->upload.model;
    double origin[3];
    scene_vicinity_origin(model, &view->camera, origin);
    if (memcmp(origin, model->origin, sizeof origin) == 0) {
        return draw_near(scene, view, pictures, stats);
    }
    if (!scene_vicinity_get(&scene->vicinity, model, origin)) {
        *pictures = (struct scene_pictures){.width = 0};
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    scene->upload.model = &scene->vicinity.model;
    const enum rhw_result result = draw_near(scene, view, pictures, stats);
    scene->upload.model = model;
    return result;
}

const struct scene_panorama *scene_lit_by(const struct scene *scene)
{
    return scene->surroundings.panorama;
}
