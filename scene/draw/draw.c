// SPDX-License-Identifier: MIT
// A scene, and the order of a draw.
//
// Depth is reversed (1 near, 0 far): floats are densest where perspective leaves least, at the far end.
#include "drawing.h"

#include "draw/shading/color.h"

#include <stdlib.h>

// Pictures ------------------------------------------------------------------------------------------

void scene_pictures_free(struct scene_pictures *pictures)
{
    free(pictures->color);
    free(pictures->linear);
    free(pictures->display);
    free(pictures->depth);
    free(pictures->distance);
    free(pictures->normal);
    free(pictures->position);
    free(pictures->uv);
    free(pictures->barycentric);
    free(pictures->object);
    free(pictures->triangle);
    free(pictures->overdraw);
    free(pictures->tiles);
    free(pictures->plan);
    *pictures = (struct scene_pictures){0};
}

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
    scene_ground_destroy(&scene->ground);
    scene_shadows_destroy(context, &scene->shadows);
    scene_surroundings_destroy(context, &scene->surroundings);
    scene_target_destroy(context, &scene->backdrop);
    scene_peel_destroy(context, &scene->peel);
    scene_triangle_order_destroy(context, &scene->order);
    if (scene->backdrop_sampler.generation) {
        rhw_sampler_destroy(context, scene->backdrop_sampler);
    }
    rhw_sampler_destroy(context, scene->nearest);
    scene_upload_destroy(&scene->upload);
    free(scene);
}

// Passes --------------------------------------------------------------------------------------------

static void set_frame(struct draw *draw)
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
}

enum rhw_result scene_draw(struct scene *scene, const struct scene_view *view,
                           struct scene_pictures *pictures, struct scene_draw_stats *stats)
{
    *pictures = (struct scene_pictures){.width = view->width, .height = view->height};
    struct draw draw = {
        .scene = scene, .view = view, .pictures = pictures, .side = scene_view_grid_side(view)};
    draw.stats.upload_ms = scene->upload_ms;
    enum rhw_result result = RHW_ERROR_OUT_OF_MEMORY;
    rhw_context_set_goes_on(scene->upload.context, view->goes_on, view->user);
    if (scene_lighting_create(&draw.lighting, scene->upload.model, &view->camera, view->up,
                              view->default_lights, view->exposure)) {
        draw.lighting.count = view->no_lights ? 0 : draw.lighting.count;
        result = scene_draw_surround(&draw);
    }
    if (result == RHW_OK) {
        set_frame(&draw);
        result = scene_draw_color(&draw);
    }
    if (result == RHW_OK) {
        result = scene_draw_data(&draw);
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

const struct scene_panorama *scene_lit_by(const struct scene *scene)
{
    return scene->surroundings.panorama;
}
