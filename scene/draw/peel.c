// SPDX-License-Identifier: MIT
// Exact transparency draws the blended surfaces of every sample from the farthest to the nearest, one layer after the
// other (C. Everitt, Interactive Order-Independent Transparency, 2001, from behind). Opaque surfaces are drawn first. A
// layer has of each sample the farthest fragment that is nearer than the layer before; it is drawn apart and then laid
// over what is there. Fragments are shaded at every sample. Of two fragments at the same depth one is drawn.
#include "drawing.h"

#include "screen.h"

#include <string.h>

enum { MOST_LAYERS = 256 };

static bool any_blends(const struct scene_model *model)
{
    bool found = false;
    for (uint32_t i = 0; i < model->instance_count && !found; i++) {
        const uint32_t material = model->meshes[model->instances[i].mesh].material;
        found = model->materials[material].alpha_mode == SCENE_ALPHA_BLEND;
    }
    return found;
}

bool scene_peel_wanted(const struct draw *draw)
{
    return draw->view->transparency == SCENE_TRANSPARENCY_EXACT && !draw->frame.plain &&
           any_blends(draw->scene->upload.model);
}

size_t scene_peel_bytes(const struct draw *draw, int format_count)
{
    const size_t colors = 32 * (size_t)format_count, depths = 8;
    return (colors + depths) * (size_t)draw->view->samples;
}

// Where colours gather: with one sample what is resolved already.
static const struct scene_target *color_target(const struct draw *draw, int i)
{
    struct scene *const scene = draw->scene;
    const int target = draw->color_targets[i];
    return draw->view->samples > 1 ? &scene->peel.colors[target] : &scene->targets[target];
}

// What is drawn into, of as many samples as the picture has.
static enum rhw_result get_targets(struct draw *draw, const enum rhw_format *formats, int format_count)
{
    struct scene_peel *const peel = &draw->scene->peel;
    rhw_context *const context = draw->scene->upload.context;
    const int width = draw->view->width * draw->side, height = draw->band_rows * draw->side;
    const int samples = draw->view->samples;
    enum rhw_result result = RHW_OK;
    for (int i = 0; i < format_count && result == RHW_OK; i++) {
        result = scene_target_get_samples(context, &peel->layers[i], RHW_FORMAT_RGBA32_FLOAT, width, height,
                                          samples);
        if (result == RHW_OK && samples > 1) {
            result = scene_target_get_samples(context, &peel->colors[draw->color_targets[i]], formats[i],
                                              width, height, samples);
        }
    }
    for (int i = 0; i < 2 && result == RHW_OK; i++) {
        result =
            scene_target_get_samples(context, &peel->depths[i], RHW_FORMAT_D32_FLOAT, width, height, samples);
    }
    if (result == RHW_OK && !peel->any.generation) {
        const struct rhw_query_def def = {.kind = RHW_QUERY_ANY_PASSED, .label = "layer"};
        result = rhw_query_create(context, &def, &peel->any);
    }
    return result;
}

// A pass that clears its depth.
static struct rhw_pass_def pass_def(int format_count, const struct scene_target *depth, float clear_depth)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = format_count;
    def.depth = (struct rhw_depth_attachment){
        .enabled = true, .texture = depth->texture, .load = RHW_LOAD_CLEAR, .clear = clear_depth};
    return def;
}

static enum rhw_result draw_opaque(struct draw *draw)
{
    const enum rhw_format *const formats = draw->color_formats;
    const int format_count = draw->color_count;
    struct scene *const scene = draw->scene;
    rhw_context *const context = scene->upload.context;
    struct rhw_pass_def def = pass_def(format_count, &scene->peel.depths[0], 0.0f);
    for (int i = 0; i < format_count; i++) {
        def.colors[i].texture = color_target(draw, i)->texture;
    }
    struct scene_background_pass background;
    scene_background_set(draw, draw->side, draw->first_row, &background);
    memcpy(def.colors[0].clear, background.gradient.top, sizeof background.gradient.top);
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    result = scene_background_record(draw, pass, false, formats, format_count, &background);
    scene_band_viewport(draw, pass, draw->side);
    struct scene_surface_pass surfaces;
    scene_color_surfaces(draw, formats, format_count, &surfaces);
    surfaces.part = SCENE_SURFACES_OPAQUE;
    if (result == RHW_OK) {
        result = scene_color_record(draw, &surfaces, pass);
    }
    struct rhw_stats stats = {0};
    result = scene_pass_end(context, pass, result, &stats);
    scene_draw_add_stats(draw, &stats);
    return result;
}

// The layer nearer than depth `from` into depth `to`; `any`: whether there is one.
static enum rhw_result draw_layer(struct draw *draw, int format_count, int from, int to, bool *any)
{
    static const enum rhw_format formats[2] = {RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_RGBA32_FLOAT};
    struct scene *const scene = draw->scene;
    rhw_context *const context = scene->upload.context;
    // Where there is no fragment, depth stays 1, which nothing is nearer than.
    struct rhw_pass_def def = pass_def(format_count, &scene->peel.depths[to], 1.0f);
    for (int i = 0; i < format_count; i++) {
        def.colors[i].texture = scene->peel.layers[i].texture;
    }
    struct scene_frame frame = draw->frame;
    frame.peel_samples = draw->view->samples;
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    scene_band_viewport(draw, pass, draw->side);
    struct scene_surface_pass surfaces;
    scene_color_surfaces(draw, formats, format_count, &surfaces);
    surfaces.frame = &frame;
    surfaces.part = SCENE_SURFACES_PEELED;
    surfaces.peeled = scene->peel.depths[from].texture;
    surfaces.peeled_sampler = scene->nearest;
    rhw_pass_begin_query(context, pass, scene->peel.any);
    result = scene_surfaces_record(&scene->upload, &scene->pipelines, &surfaces, pass);
    rhw_pass_end_query(context, pass, scene->peel.any);
    struct rhw_stats stats = {0};
    result = scene_pass_end(context, pass, result, &stats);
    scene_draw_add_stats(draw, &stats);
    struct rhw_query_counts counts = {0};
    if (result == RHW_OK) {
        result = rhw_query_read(context, scene->peel.any, &counts);
    }
    *any = counts.any_passed;
    return result;
}

static enum rhw_result lay_over(struct draw *draw, const enum rhw_format *formats, int format_count)
{
    struct scene *const scene = draw->scene;
    rhw_context *const context = scene->upload.context;
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = format_count;
    for (int i = 0; i < format_count; i++) {
        def.colors[i] =
            (struct rhw_color_attachment){.texture = color_target(draw, i)->texture, .load = RHW_LOAD_LOAD};
    }
    def.depth = (struct rhw_depth_attachment){.enabled = false};
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    for (int i = 0; i < format_count; i++) {
        rhw_pass_set_texture(context, pass, i, scene->peel.layers[i].texture, scene->nearest);
    }
    const struct scene_layer layer = {draw->view->samples, format_count};
    result = scene_screen_lay(context, pass, formats, format_count, &layer);
    return scene_pass_end(context, pass, result, NULL);
}

// Samples to pixels, which is what a pass does in its end.
static enum rhw_result gather_samples(struct draw *draw, int format_count)
{
    struct scene *const scene = draw->scene;
    rhw_context *const context = scene->upload.context;
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = format_count;
    for (int i = 0; i < format_count; i++) {
        const int target = draw->color_targets[i];
        def.colors[i] = (struct rhw_color_attachment){.texture = scene->peel.colors[target].texture,
                                                      .resolve = scene->targets[target].texture,
                                                      .load = RHW_LOAD_LOAD,
                                                      .store = RHW_STORE_DISCARD};
    }
    def.depth = (struct rhw_depth_attachment){.enabled = false};
    rhw_pass pass;
    const enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    return result == RHW_OK ? scene_pass_end(context, pass, RHW_OK, NULL) : result;
}

enum rhw_result scene_peel_opaque(struct draw *draw)
{
    const enum rhw_result result = get_targets(draw, draw->color_formats, draw->color_count);
    return result == RHW_OK ? draw_opaque(draw) : result;
}

enum rhw_result scene_peel_blended(struct draw *draw)
{
    const int count = draw->color_count;
    enum rhw_result result = RHW_OK;
    bool any = true;
    for (int layer = 0; layer < MOST_LAYERS && any && result == RHW_OK; layer++) {
        result = draw_layer(draw, count, layer % 2, (layer + 1) % 2, &any);
        if (result == RHW_OK && any) {
            result = lay_over(draw, draw->color_formats, count);
        }
    }
    return result == RHW_OK && draw->view->samples > 1 ? gather_samples(draw, count) : result;
}

void scene_peel_destroy(rhw_context *context, struct scene_peel *peel)
{
    for (int i = 0; i < 3; i++) {
        scene_target_destroy(context, &peel->colors[i]);
    }
    for (int i = 0; i < 2; i++) {
        scene_target_destroy(context, &peel->layers[i]);
        scene_target_destroy(context, &peel->depths[i]);
    }
    if (peel->any.generation) {
        rhw_query_destroy(context, peel->any);
    }
    *peel = (struct scene_peel){0};
}
