// SPDX-License-Identifier: MIT
// The data pass finds what is nearest at the centre of every pixel, in as many targets as were asked for. The pass that
// counts all surfaces of a pixel has no depth.
#include "drawing.h"

#include "screen.h"

#include <string.h>

_Static_assert(SCENE_KIND_OVERDRAW - SCENE_KIND_DEPTH == (int)SCENE_DATA_OVERDRAW,
               "rows in the order of data");

static const struct scene_output_row *row_of(int i)
{
    return &scene_outputs[SCENE_KIND_DEPTH + i];
}

static bool is_drawn(const struct draw *draw, int i)
{
    return (draw->data_pass & row_of(i)->output) != 0;
}

static enum rhw_result draw_data_band(struct draw *draw)
{
    struct scene *scene = draw->scene;
    rhw_context *context = scene->upload.context;
    const double start = scene_milliseconds();
    struct scene_surface_pass surfaces = {.frame = &draw->frame, .interpolate = draw->view->interpolate};
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 0;
    def.depth = (struct rhw_depth_attachment){.enabled = draw->data_pass != SCENE_OUTPUT_OVERDRAW,
                                              .load = RHW_LOAD_CLEAR,
                                              .store = RHW_STORE_DISCARD,
                                              .clear = 0.0f};
    for (int i = 0; i < SCENE_DATA_OUTPUTS; i++) {
        draw->frame.output_slot[i] = -1;
        if (!is_drawn(draw, i)) {
            continue;
        }
        const enum rhw_result result =
            scene_draw_target(draw, TARGET_DATA + i, row_of(i)->format, draw->view->width, draw->band_rows);
        if (result != RHW_OK) {
            return result;
        }
        struct rhw_color_attachment *color = &def.colors[def.color_count];
        *color = (struct rhw_color_attachment){.texture = scene->targets[TARGET_DATA + i].texture};
        color->clear[0] = row_of(i)->empty;
        draw->frame.output_slot[i] = def.color_count;
        surfaces.formats[def.color_count++] = row_of(i)->format;
        surfaces.data_outputs |= row_of(i)->output;
    }
    surfaces.format_count = def.color_count;
    memcpy(surfaces.view_projection, draw->view_projection, sizeof surfaces.view_projection);
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    scene_band_viewport(draw, pass, 1);
    result = scene_surfaces_record(&scene->upload, &scene->pipelines, &surfaces, pass);
    struct rhw_stats stats = {0};
    result = scene_pass_end(context, pass, result, &stats);
    scene_draw_add_stats(draw, &stats);
    const double drawn = scene_milliseconds();
    for (int i = 0; i < SCENE_DATA_OUTPUTS && result == RHW_OK; i++) {
        if (is_drawn(draw, i)) {
            scene_band_read(
                draw, TARGET_DATA + i,
                scene_picture_get(draw->pictures, (enum scene_output_kind)(SCENE_KIND_DEPTH + i)));
        }
    }
    draw->stats.data_ms += drawn - start;
    draw->stats.read_ms += scene_milliseconds() - drawn;
    return result;
}

enum rhw_result scene_draw_data(struct draw *draw, uint32_t outputs)
{
    size_t pixel = 0;
    draw->data_pass = outputs & draw->view->outputs;
    for (int i = 0; i < SCENE_DATA_OUTPUTS; i++) {
        pixel += is_drawn(draw, i) ? rhw_format_size(row_of(i)->format) : 0;
    }
    if (pixel == 0) {
        return RHW_OK;
    }
    draw->frame.plain = 0;
    draw->band_rows = scene_band_rows(draw->view->height, (size_t)draw->view->width * pixel);
    scene_draw_set_samples(draw, 1);
    return scene_draw_bands(draw, draw_data_band);
}
