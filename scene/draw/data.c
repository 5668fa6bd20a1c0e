// SPDX-License-Identifier: MIT
// The data pass: what is nearest at the centre of every pixel, in as many targets as were asked for; and a pass of its own,
// without depth, that counts what there is at all.
#include "drawing.h"

#include "screen.h"

#include <string.h>

// The data outputs, by enum scene_data_output.
static const struct {
    uint32_t output;
    enum rhw_format format;
} data_outputs[SCENE_DATA_OUTPUTS] = {
    [SCENE_DATA_DEPTH] = {SCENE_OUTPUT_DEPTH, RHW_FORMAT_R32_FLOAT},
    [SCENE_DATA_DISTANCE] = {SCENE_OUTPUT_DISTANCE, RHW_FORMAT_R32_FLOAT},
    [SCENE_DATA_NORMAL] = {SCENE_OUTPUT_NORMAL, RHW_FORMAT_RGBA32_FLOAT},
    [SCENE_DATA_POSITION] = {SCENE_OUTPUT_POSITION, RHW_FORMAT_RGBA32_FLOAT},
    [SCENE_DATA_UV] = {SCENE_OUTPUT_UV, RHW_FORMAT_RGBA32_FLOAT},
    [SCENE_DATA_OBJECT] = {SCENE_OUTPUT_OBJECT, RHW_FORMAT_R32_UINT},
    [SCENE_DATA_TRIANGLE] = {SCENE_OUTPUT_TRIANGLE, RHW_FORMAT_R32_UINT},
    [SCENE_DATA_BARYCENTRIC] = {SCENE_OUTPUT_BARYCENTRIC, RHW_FORMAT_RGBA32_FLOAT},
    [SCENE_DATA_OVERDRAW] = {SCENE_OUTPUT_OVERDRAW, RHW_FORMAT_R32_FLOAT},
};

static bool is_drawn(const struct draw *draw, int i)
{
    return draw->data[i] && draw->data_pass & data_outputs[i].output;
}

static bool is_any_drawn(const struct draw *draw)
{
    bool any = false;
    for (int i = 0; i < SCENE_DATA_OUTPUTS; i++) {
        any = any || is_drawn(draw, i);
    }
    return any;
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
        const enum rhw_result result = scene_draw_target(draw, TARGET_DATA + i, data_outputs[i].format,
                                                         draw->view->width, draw->band_rows);
        if (result != RHW_OK) {
            return result;
        }
        struct rhw_color_attachment *color = &def.colors[def.color_count];
        *color = (struct rhw_color_attachment){.texture = scene->targets[TARGET_DATA + i].texture};
        color->clear[0] = i == SCENE_DATA_DEPTH ? 1.0f : i == SCENE_DATA_DISTANCE ? __builtin_inff() : 0.0f;
        draw->frame.output_slot[i] = def.color_count;
        surfaces.formats[def.color_count++] = data_outputs[i].format;
        surfaces.data_outputs |= data_outputs[i].output;
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
            scene_band_read(draw, TARGET_DATA + i, draw->data[i]);
        }
    }
    draw->stats.data_ms += drawn - start;
    draw->stats.read_ms += scene_milliseconds() - drawn;
    return result;
}

enum rhw_result scene_draw_data(struct draw *draw)
{
    size_t pixel = 0;
    for (int i = 0; i < SCENE_DATA_OUTPUTS; i++) {
        pixel += draw->view->outputs & data_outputs[i].output ? rhw_format_size(data_outputs[i].format) : 0;
    }
    if (pixel == 0) {
        return RHW_OK;
    }
    draw->band_rows = scene_band_rows(draw->view->height, (size_t)draw->view->width * pixel);
    bool allocated = true;
    for (int i = 0; i < SCENE_DATA_OUTPUTS; i++) {
        if (draw->view->outputs & data_outputs[i].output) {
            allocated = scene_band_allocate(draw, data_outputs[i].format, &draw->data[i]) && allocated;
        }
    }
    struct scene_pictures *pictures = draw->pictures;
    pictures->depth = draw->data[SCENE_DATA_DEPTH];
    pictures->distance = draw->data[SCENE_DATA_DISTANCE];
    pictures->normal = draw->data[SCENE_DATA_NORMAL];
    pictures->position = draw->data[SCENE_DATA_POSITION];
    pictures->uv = draw->data[SCENE_DATA_UV];
    pictures->object = draw->data[SCENE_DATA_OBJECT];
    pictures->triangle = draw->data[SCENE_DATA_TRIANGLE];
    pictures->barycentric = draw->data[SCENE_DATA_BARYCENTRIC];
    pictures->overdraw = draw->data[SCENE_DATA_OVERDRAW];
    if (!allocated) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    draw->frame.plain = 0;
    scene_draw_set_samples(draw, 1);
    enum rhw_result result = RHW_OK;
    const uint32_t passes[2] = {draw->view->outputs & ~(uint32_t)SCENE_OUTPUT_OVERDRAW,
                                draw->view->outputs & SCENE_OUTPUT_OVERDRAW};
    for (int i = 0; i < 2 && result == RHW_OK; i++) {
        draw->data_pass = passes[i];
        result = is_any_drawn(draw) ? scene_draw_bands(draw, draw_data_band) : RHW_OK;
    }
    return result;
}
