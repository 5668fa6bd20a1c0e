// SPDX-License-Identifier: MIT
// The colour passes. Colour is tone-mapped in the fragment function and blended as displayed light, as viewers on the
// web do it: the background and unlit surfaces keep the colour that they were given, and a sample has four bytes.
#include "drawing.h"

#include "explain_sample.h"
#include "screen.h"

#include <string.h>

// A history that is told while a pass ends.
struct telling {
    const struct scene_explain *explain;
    struct scene_draw_log log;
    int first_row;
};

static void tell(void *user, const struct rhw_explained_fragment *fragment)
{
    const struct telling *const telling = user;
    if (fragment->draw < telling->log.count) {
        telling->explain->fragment(telling->explain->user, fragment, &telling->log.draws[fragment->draw],
                                   telling->first_row);
    }
}

// Asks for it where the view does and the sample lies in the band. False without memory.
static bool begin_telling(struct telling *telling, const struct draw *draw, rhw_pass pass)
{
    const struct scene_explain *const explain = draw->view->explain;
    const int first_row = draw->first_row * draw->side;
    *telling = (struct telling){.explain = explain, .first_row = first_row};
    const bool is_told = draw->is_wide && draw->pictures->color; // the history is told once
    if (!explain || is_told || explain->y < first_row ||
        explain->y >= first_row + draw->band_rows * draw->side) {
        telling->explain = NULL;
        return true;
    }
    const struct rhw_explain ask = {.x = explain->x,
                                    .y = explain->y - first_row,
                                    .sample = explain->sample,
                                    .fragment = tell,
                                    .user = telling};
    rhw_pass_explain(draw->scene->upload.context, pass, &ask);
    return !scene_background_is_drawn(draw) ||
           scene_draw_log_add(&telling->log, SCENE_DRAWN_BACKGROUND, NULL);
}

enum rhw_result scene_color_draw(struct draw *draw)
{
    const enum rhw_format *const formats = draw->color_formats;
    const int format_count = draw->color_count;
    struct scene *scene = draw->scene;
    rhw_context *context = scene->upload.context;
    struct rhw_pass_def def = rhw_pass_def_default();
    struct scene_background_pass background;
    scene_background_set(draw, draw->side, draw->first_row, &background);
    def.color_count = format_count;
    for (int i = 0; i < format_count; i++) {
        def.colors[i] =
            (struct rhw_color_attachment){.texture = scene->targets[draw->color_targets[i]].texture};
    }
    memcpy(def.colors[0].clear, background.gradient.top, sizeof background.gradient.top);
    def.depth = (struct rhw_depth_attachment){
        .enabled = true, .load = RHW_LOAD_CLEAR, .store = RHW_STORE_DISCARD, .clear = 0.0f};
    def.samples = draw->view->samples;
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    struct telling telling;
    struct scene_work work;
    const bool is_told = begin_telling(&telling, draw, pass), is_noted = scene_work_begin(draw, pass, &work);
    if (!is_told || !is_noted) {
        result = RHW_ERROR_OUT_OF_MEMORY;
    }
    if (result == RHW_OK) {
        result = scene_background_record(draw, pass, false, formats, format_count, &background);
    }
    scene_band_viewport(draw, pass, draw->side);
    struct scene_surface_pass surfaces;
    scene_color_surfaces(draw, formats, format_count, &surfaces);
    surfaces.log = telling.explain ? &telling.log : NULL;
    if (result == RHW_OK) {
        result = scene_color_record(draw, &surfaces, pass);
    }
    struct rhw_stats stats = {0};
    result = scene_pass_end(context, pass, result, &stats);
    scene_draw_log_free(&telling.log);
    scene_work_end(draw, &work);
    if (scene_background_is_drawn(draw) && result == RHW_OK) { // the background is no part of the model
        stats.draws--;
        stats.vertices_shaded -= 3;
        stats.triangles_in--;
        stats.triangles_rasterized--;
        stats.bin_entries -= (uint64_t)stats.tiles;
    }
    scene_draw_add_stats(draw, &stats);
    return result;
}

static enum rhw_result resolve(struct draw *draw, int from, int to, enum rhw_format format,
                               bool straight_alpha)
{
    struct scene *scene = draw->scene;
    rhw_context *context = scene->upload.context;
    enum rhw_result result = scene_draw_target(draw, to, format, draw->view->width, draw->band_rows);
    if (result != RHW_OK) {
        return result;
    }
    const struct scene_target *source = &scene->targets[from];
    const struct scene_resolve uniforms = {
        .side = draw->side,
        .straight_alpha = straight_alpha,
        .inverse_size = {1.0f / (float)source->width, 1.0f / (float)source->height}};
    rhw_pass pass;
    result = scene_screen_begin(context, scene->targets[to].texture, &pass);
    if (result != RHW_OK) {
        return result;
    }
    rhw_pass_set_texture(context, pass, 0, source->texture, scene->nearest);
    result = scene_screen_record(context, pass, SCENE_SCREEN_RESOLVE, &format, 1, &uniforms);
    return scene_pass_end(context, pass, result, NULL);
}

// Reads the band of a picture, from the samples where one is the whole pixel.
static enum rhw_result finish_band(struct draw *draw, int samples, int resolved, enum rhw_format format,
                                   bool straight_alpha, void *picture)
{
    const double start = scene_milliseconds();
    const struct scene_target *source = &draw->scene->targets[samples];
    const bool needed = draw->side > 1 || straight_alpha || source->format != format;
    const enum rhw_result result = needed ? resolve(draw, samples, resolved, format, straight_alpha) : RHW_OK;
    const double read = scene_milliseconds();
    if (result == RHW_OK) {
        scene_band_read(draw, needed ? resolved : samples, picture);
    }
    draw->stats.resolve_ms += read - start;
    draw->stats.read_ms += scene_milliseconds() - read;
    return result;
}

// Light before tone mapping is drawn once, with the last of the colours.
static bool draws_linear(const struct draw *draw)
{
    return draw->pictures->linear && draw->is_wide == (draw->pictures->display != NULL);
}

enum rhw_result scene_color_begin(struct draw *draw)
{
    const bool transparent = draw->view->background == SCENE_BACKGROUND_TRANSPARENT;
    const int width = draw->view->width * draw->side, height = draw->band_rows * draw->side;
    // Premultiplied colours of a transparent picture are divided by alpha later: 8 bits would not do.
    draw->color_targets[0] = draw->is_wide ? TARGET_WIDE_SAMPLES : TARGET_SAMPLES;
    draw->color_targets[1] = TARGET_LINEAR_SAMPLES;
    draw->color_formats[0] = draw->is_wide ? RHW_FORMAT_RGBA32_FLOAT
                             : transparent ? RHW_FORMAT_RGBA16_FLOAT
                                           : RHW_FORMAT_RGBA8_SRGB;
    draw->color_formats[1] = RHW_FORMAT_RGBA32_FLOAT;
    const bool has_linear = draws_linear(draw);
    draw->color_count = has_linear ? 2 : 1;
    draw->frame.linear_slot = has_linear ? 1 : -1;
    enum rhw_result result = RHW_OK;
    for (int i = 0; i < draw->color_count && result == RHW_OK; i++) {
        result = scene_draw_target(draw, draw->color_targets[i], draw->color_formats[i], width, height);
    }
    return result;
}

enum rhw_result scene_color_end(struct draw *draw)
{
    const struct scene_pictures *pictures = draw->pictures;
    const bool transparent = draw->view->background == SCENE_BACKGROUND_TRANSPARENT;
    enum rhw_result result = RHW_OK;
    if (pictures->color && !draw->is_wide) {
        result = finish_band(draw, TARGET_SAMPLES, TARGET_COLOR, RHW_FORMAT_RGBA8_SRGB, transparent,
                             pictures->color);
    }
    if (result == RHW_OK && draw->is_wide) {
        result = finish_band(draw, TARGET_WIDE_SAMPLES, TARGET_DISPLAY, RHW_FORMAT_RGBA32_FLOAT, transparent,
                             pictures->display);
    }
    if (result == RHW_OK && draws_linear(draw)) {
        result = finish_band(draw, TARGET_LINEAR_SAMPLES, TARGET_LINEAR, RHW_FORMAT_RGBA32_FLOAT, false,
                             pictures->linear);
    }
    return result;
}

int scene_color_rows(const struct draw *draw)
{
    const uint32_t outputs = draw->view->outputs;
    const bool is_wide = outputs & SCENE_OUTPUT_DISPLAY, is_narrow = outputs & SCENE_OUTPUT_COLOR || !is_wide;
    const int wide_count = is_wide + (outputs & SCENE_OUTPUT_LINEAR ? 1 : 0);
    const size_t per_sample = (is_narrow ? 8u : 0u) + 16u * (size_t)wide_count;
    const size_t samples = (size_t)draw->view->supersample;
    const size_t layers = scene_peel_wanted(draw) ? scene_peel_bytes(draw, is_narrow + wide_count) : 0;
    return scene_band_rows(draw->view->height, (size_t)draw->view->width * (per_sample + layers) * samples);
}
