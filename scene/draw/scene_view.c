// SPDX-License-Identifier: MIT
// The view that a model shows best in, and what a view may not ask for.
#include "scene_view.h"

#include <stdio.h>

int scene_view_grid_side(const struct scene_view *view)
{
    for (int side = 1; side <= 4; side++) {
        if (side * side == view->supersample) {
            return side;
        }
    }
    return 0;
}

struct scene_view scene_view_default(const struct scene_model *model)
{
    struct scene_view view = {.width = 1280,
                              .height = 720,
                              .samples = 1,
                              .supersample = 1,
                              .up = model->up,
                              .shadows = true,
                              .ambient_occlusion = true,
                              .outputs = SCENE_OUTPUT_COLOR};
    view.camera = scene_camera_fit(model, scene_camera_default_orbit(model, model->up),
                                   scene_camera_default_yfov(), 1280.0 / 720.0);
    return view;
}

bool scene_view_check(const struct scene_view *view, char *error, size_t error_size)
{
    const int side = scene_view_grid_side(view);
    const int limit = RHW_MAX_TARGET_SIZE;
    const char *place = "";
    if (view->width < 1 || view->height < 1 || view->width > limit || view->height > limit) {
        snprintf(error, error_size, "size %dx%d: width and height must lie between 1 and %d", view->width,
                 view->height, limit);
    } else if (side == 0) {
        snprintf(error, error_size, "supersample %d: must be 1, 4, 9 or 16", view->supersample);
    } else if (view->samples < 1 || view->samples > 16 || (view->samples & (view->samples - 1)) != 0) {
        snprintf(error, error_size, "samples %d: must be 1, 2, 4, 8 or 16", view->samples);
    } else if (view->width * side > limit || view->height * side > limit) {
        snprintf(error, error_size,
                 "size %dx%d with %d pixels for one: %d times width and height must not exceed %d",
                 view->width, view->height, view->supersample, side, limit);
    } else if (view->outputs == 0 || (view->outputs & ~(uint32_t)(SCENE_OUTPUT_ALL | SCENE_OUTPUT_WORK))) {
        snprintf(error, error_size, "outputs: none, or unknown ones, asked for");
    } else if (view->interpolate != RHW_SMOOTH && view->interpolate != RHW_NOPERSPECTIVE) {
        snprintf(error, error_size, "interpolate: must be smooth or noperspective");
    } else if (view->background == SCENE_BACKGROUND_PANORAMA && !view->panorama) {
        snprintf(error, error_size, "background: there is no environment to show");
    } else if (view->panorama_rotation - view->panorama_rotation != 0.0) {
        snprintf(error, error_size, "environment: its rotation must be a finite number of degrees");
    } else if ((unsigned)view->transparency > SCENE_TRANSPARENCY_EXACT) {
        snprintf(error, error_size, "transparency: must be sorted or exact");
    } else if (view->transparency == SCENE_TRANSPARENCY_EXACT &&
               view->outputs & (SCENE_OUTPUT_TILES | SCENE_OUTPUT_PLAN)) {
        snprintf(error, error_size, "transparency: of exact there is no one pass whose tiles could be shown");
    } else if (view->program &&
               (view->outputs & SCENE_OUTPUT_LINEAR || view->wireframe != SCENE_WIREFRAME_NONE ||
                view->interpolate != RHW_SMOOTH || view->transparency == SCENE_TRANSPARENCY_EXACT)) {
        snprintf(
            error, error_size,
            "fragment shader: has no light before tone mapping, no wireframe, no noperspective and no exact "
            "transparency");
    } else if (!(view->exposure >= -20.0 && view->exposure <= 20.0)) {
        snprintf(error, error_size, "exposure: must lie between -20 and 20 stops");
    } else {
        const struct scene_camera *c = &view->camera;
        const bool infinite = c->zfar == 0.0 && !c->orthographic;
        if (!(c->orthographic ? c->ymag > 0.0 : c->yfov > 0.0 && c->yfov < 3.14159)) {
            place = c->orthographic ? "the height" : "the field of view";
        } else if (!(infinite || c->zfar > c->znear) || !(c->orthographic || c->znear > 0.0)) {
            place = "the distance of the near or far plane";
        } else {
            return true;
        }
        snprintf(error, error_size, "camera: %s is out of range", place);
    }
    return false;
}
