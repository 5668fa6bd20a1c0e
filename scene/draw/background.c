// SPDX-License-Identifier: MIT
// What a picture shows where the model is not.
#include "drawing.h"

#include "draw/shading/color.h"
#include "screen.h"

// sRGB codes of the default background, top and bottom.
static const uint8_t gradient_top[3] = {134, 146, 160}, gradient_bottom[3] = {66, 72, 80};

static void set_gradient(const struct draw *draw, int side, int first_row, struct scene_backdrop *backdrop)
{
    const struct scene_view *view = draw->view;
    *backdrop = (struct scene_backdrop){.smooth = draw->is_wide,
                                        .inverse_height = 1.0f / (float)view->height,
                                        .first_row = (float)(first_row * side),
                                        .inverse_side = 1.0f / (float)side};
    if (view->background == SCENE_BACKGROUND_TRANSPARENT) {
        return;
    }
    const bool even = view->background == SCENE_BACKGROUND_COLOR;
    for (int c = 0; c < 3; c++) {
        backdrop->top[c] = scene_color_decode(even ? view->background_color[c] : gradient_top[c]);
        backdrop->codes[0][c] = (float)gradient_top[c];
        backdrop->codes[1][c] = (float)gradient_bottom[c];
    }
    backdrop->top[3] = 1.0f;
    for (int code = 0; code < 256 && !even; code++) {
        backdrop->decode[code] = scene_color_decode((uint8_t)code);
    }
}

static void set_panorama(const struct draw *draw, int side, int first_row, struct scene_panorama_pass *pass)
{
    const struct scene_view *view = draw->view;
    *pass = scene_surroundings_background(&draw->scene->surroundings, view);
    pass->strength = draw->frame.environment.strength;
    pass->tone = view->tone;
    pass->scale[0] = 2.0f / (float)(view->width * side);
    pass->scale[1] = 2.0f / (float)(view->height * side);
    pass->offset[0] = -1.0f;
    pass->offset[1] = 2.0f * (float)first_row / (float)view->height - 1.0f;
}

bool scene_background_is_drawn(const struct draw *draw)
{
    return draw->view->background == SCENE_BACKGROUND_DEFAULT ||
           draw->view->background == SCENE_BACKGROUND_PANORAMA;
}

void scene_background_set(const struct draw *draw, int side, int first_row,
                          struct scene_background_pass *background)
{
    set_gradient(draw, side, first_row, &background->gradient);
    if (draw->view->background == SCENE_BACKGROUND_PANORAMA) {
        set_panorama(draw, side, first_row, &background->panorama);
    }
}

enum rhw_result scene_background_record(const struct draw *draw, rhw_pass pass, bool as_light,
                                        const enum rhw_format *formats, int format_count,
                                        const struct scene_background_pass *background)
{
    const struct scene_surroundings *surroundings = &draw->scene->surroundings;
    rhw_context *context = draw->scene->upload.context;
    switch (draw->view->background) {
    case SCENE_BACKGROUND_DEFAULT:
        return scene_screen_record(context, pass, SCENE_SCREEN_BACKDROP, formats, format_count,
                                   &background->gradient);
    case SCENE_BACKGROUND_PANORAMA:
        rhw_pass_set_texture(context, pass, 0, surroundings->picture, surroundings->picture_sampler);
        return scene_screen_record(context, pass,
                                   as_light ? SCENE_SCREEN_PANORAMA : SCENE_SCREEN_SURROUNDINGS, formats,
                                   format_count, &background->panorama);
    default: return RHW_OK;
    }
}
