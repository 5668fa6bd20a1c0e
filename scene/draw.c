// SPDX-License-Identifier: MIT
// The passes of a draw.
//
// Colour is tone-mapped in the fragment function and blended as displayed light, as viewers on the web do:
// the background then keeps the colour it was given, unlit surfaces keep theirs, and a sample is four bytes.
// Large pictures are drawn in bands of rows, so that samples never take more than `band_bytes`; the pipeline
// promises that moving a triangle by whole pixels changes nothing, hence bands do not show.
//
// Depth is reversed (1 near, 0 far): floats are densest where perspective leaves least, at the far end.
#include "draw.h"

#include "color.h"
#include "guide.h"
#include "light.h"
#include "panorama.h"
#include "screen.h"
#include "shadow.h"
#include "subject.h"
#include "surface.h"
#include "target.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    BAND_BYTES = 1 << 28,
    BAND_ROWS = 64, // bands are cut at multiples: tiles stay whole
    TARGET_COUNT = SCENE_DATA_OUTPUTS + 5
};

// Of the subject's radius: how far things occlude each other.
static const double occlusion_reach = 0.12;

// sRGB codes of the default background, top and bottom.
static const uint8_t gradient_top[3] = {134, 146, 160}, gradient_bottom[3] = {66, 72, 80};

struct scene {
    struct scene_upload upload;
    struct scene_surface_pipelines pipelines;
    struct scene_target targets[TARGET_COUNT];
    struct scene_guide guide;
    struct scene_shadows shadows;
    struct scene_surroundings surroundings;
    rhw_sampler nearest;
    double upload_ms;
};

// Which of scene.targets is what.
enum { TARGET_SAMPLES, TARGET_LINEAR_SAMPLES, TARGET_COLOR, TARGET_LINEAR, TARGET_DISPLAY, TARGET_DATA };

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
};

// Everything one call of scene_draw works with.
struct draw {
    struct scene *scene;
    const struct scene_view *view;
    struct scene_pictures *pictures;
    struct scene_draw_stats stats;
    struct scene_lighting lighting;
    struct scene_frame frame;
    double view_projection[16];
    int side;                       // of the sample grid
    int band_rows, first_row;       // of the picture
    void *data[SCENE_DATA_OUTPUTS]; // the pictures of data outputs
};

static double milliseconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

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
    *pictures = (struct scene_pictures){0};
}

// Scene ---------------------------------------------------------------------------------------------

enum rhw_result scene_create(rhw_context *context, const struct scene_model *model, struct scene **scene)
{
    const double start = milliseconds();
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
    (*scene)->upload_ms = milliseconds() - start;
    return RHW_OK;
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
    scene_shadows_destroy(context, &scene->shadows);
    scene_surroundings_destroy(context, &scene->surroundings);
    rhw_sampler_destroy(context, scene->nearest);
    scene_upload_destroy(&scene->upload);
    free(scene);
}

static enum rhw_result get_target(struct scene *scene, int which, enum rhw_format format, int width,
                                  int height)
{
    return scene_target_get(scene->upload.context, &scene->targets[which], format, width, height);
}

// Passes --------------------------------------------------------------------------------------------

static uint64_t larger(uint64_t a, uint64_t b)
{
    return a > b ? a : b;
}

static void add_stats(struct rhw_stats *sum, const struct rhw_stats *pass)
{
    sum->record_ms += pass->record_ms;
    sum->front_ms += pass->front_ms;
    sum->back_ms += pass->back_ms;
    sum->front_busy_ms += pass->front_busy_ms;
    sum->back_busy_ms += pass->back_busy_ms;
    sum->vertex_busy_ms += pass->vertex_busy_ms;
    sum->setup_busy_ms += pass->setup_busy_ms;
    sum->bin_busy_ms += pass->bin_busy_ms;
    sum->draws += pass->draws;
    sum->vertices_shaded += pass->vertices_shaded;
    sum->triangles_in += pass->triangles_in;
    sum->triangles_dropped += pass->triangles_dropped;
    sum->triangles_clipped += pass->triangles_clipped;
    sum->triangles_culled += pass->triangles_culled;
    sum->triangles_rasterized += pass->triangles_rasterized;
    sum->bin_entries += pass->bin_entries;
    sum->fragments_shaded += pass->fragments_shaded;
    sum->fragment_groups += pass->fragment_groups;
    sum->flushes += pass->flushes;
    sum->memory_peak = larger(pass->memory_peak, sum->memory_peak);
    sum->geometry_peak = larger(pass->geometry_peak, sum->geometry_peak);
    sum->tiles = pass->tiles > sum->tiles ? pass->tiles : sum->tiles;
    sum->threads = pass->threads;
    sum->isa = pass->isa;
}

// Half the diagonal of the box around what the picture is about.
static double subject_radius(const struct scene_model *model)
{
    const struct scene_subject subject = scene_subject_find(model);
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
        const double side = subject.is_all ? (double)model->bounds_max[c] - (double)model->bounds_min[c]
                                           : subject.high[c] - subject.low[c];
        square += side * side;
    }
    return 0.5 * __builtin_sqrt(square);
}

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

// Sizes that depend on the pixels drawn along the side of one of the picture.
static void set_frame_samples(struct draw *draw, int side)
{
    draw->frame.samples = (float)side;
    draw->frame.pixel[0] = (float)(2.0 / ((double)draw->view->width * side));
    draw->frame.pixel[1] = (float)(2.0 / ((double)draw->view->height * side));
    draw->frame.line_half_width = 0.65f * (float)side;
}

// The viewport of the whole picture, moved so that the band's first row is the target's.
static void set_band_viewport(const struct draw *draw, rhw_pass pass, int side)
{
    const struct rhw_viewport viewport = {.x = 0.0f,
                                          .y = -(float)(draw->first_row * side),
                                          .width = (float)(draw->view->width * side),
                                          .height = (float)(draw->view->height * side),
                                          .depth_min = 0.0f,
                                          .depth_max = 1.0f};
    rhw_pass_set_viewport(draw->scene->upload.context, pass, &viewport);
}

static void set_background(const struct draw *draw, struct scene_backdrop *backdrop)
{
    const struct scene_view *view = draw->view;
    *backdrop = (struct scene_backdrop){.inverse_height = 1.0f / (float)(view->height * draw->side),
                                        .first_row = (float)(draw->first_row * draw->side)};
    if (view->background == SCENE_BACKGROUND_TRANSPARENT) {
        return;
    }
    const bool even = view->background == SCENE_BACKGROUND_COLOR;
    for (int c = 0; c < 3; c++) {
        backdrop->top[c] = scene_color_decode(even ? view->background_color[c] : gradient_top[c]);
        backdrop->bottom[c] = scene_color_decode(even ? view->background_color[c] : gradient_bottom[c]);
    }
    backdrop->top[3] = backdrop->bottom[3] = 1.0f;
}

static void set_panorama(const struct draw *draw, struct scene_panorama_pass *pass)
{
    const struct scene_view *view = draw->view;
    *pass = scene_surroundings_background(&draw->scene->surroundings, view);
    pass->strength = draw->frame.environment.strength;
    pass->tone = view->tone;
    pass->scale[0] = 2.0f / (float)(view->width * draw->side);
    pass->scale[1] = 2.0f / (float)(view->height * draw->side);
    pass->offset[0] = -1.0f;
    pass->offset[1] = 2.0f * (float)draw->first_row / (float)view->height - 1.0f;
}

static enum rhw_result draw_samples(struct draw *draw, const enum rhw_format formats[2], int format_count)
{
    struct scene *scene = draw->scene;
    rhw_context *context = scene->upload.context;
    struct rhw_pass_def def = rhw_pass_def_default();
    struct scene_backdrop backdrop;
    struct scene_panorama_pass panorama;
    set_background(draw, &backdrop);
    def.color_count = format_count;
    for (int i = 0; i < format_count; i++) {
        def.colors[i] = (struct rhw_color_attachment){.texture = scene->targets[TARGET_SAMPLES + i].texture};
    }
    memcpy(def.colors[0].clear, backdrop.top, sizeof backdrop.top);
    def.depth = (struct rhw_depth_attachment){
        .enabled = true, .load = RHW_LOAD_CLEAR, .store = RHW_STORE_DISCARD, .clear = 0.0f};
    def.samples = draw->view->samples;
    rhw_pass pass;
    enum rhw_result result = rhw_pass_begin(context, &def, &pass);
    if (result != RHW_OK) {
        return result;
    }
    const enum scene_background background = draw->view->background;
    const bool backdropped =
        background == SCENE_BACKGROUND_DEFAULT || background == SCENE_BACKGROUND_PANORAMA;
    if (background == SCENE_BACKGROUND_DEFAULT) {
        result = scene_screen_record(context, pass, SCENE_SCREEN_BACKDROP, formats, format_count, &backdrop);
    } else if (background == SCENE_BACKGROUND_PANORAMA) {
        set_panorama(draw, &panorama);
        rhw_pass_set_texture(context, pass, 0, scene->surroundings.picture,
                             scene->surroundings.picture_sampler);
        result =
            scene_screen_record(context, pass, SCENE_SCREEN_SURROUNDINGS, formats, format_count, &panorama);
    }
    set_band_viewport(draw, pass, draw->side);
    struct scene_surface_pass surfaces = {.frame = &draw->frame,
                                          .interpolate = draw->view->interpolate,
                                          .wireframe = draw->view->wireframe,
                                          .format_count = format_count,
                                          .environment = scene->surroundings.cube,
                                          .environment_sampler = scene->surroundings.cube_sampler};
    memcpy(surfaces.formats, formats, (size_t)format_count * sizeof *formats);
    memcpy(surfaces.view_projection, draw->view_projection, sizeof surfaces.view_projection);
    if (result == RHW_OK) {
        result = scene_surfaces_record(&scene->upload, &scene->pipelines, &surfaces, pass);
    }
    struct rhw_stats stats = {0};
    result = scene_pass_end(context, pass, result, &stats);
    if (backdropped && result == RHW_OK) { // the background is no part of the model
        stats.draws--;
        stats.vertices_shaded -= 3;
        stats.triangles_in--;
        stats.triangles_rasterized--;
        stats.bin_entries -= (uint64_t)stats.tiles;
    }
    add_stats(&draw->stats.pipeline, &stats);
    return result;
}

static enum rhw_result resolve(struct draw *draw, int from, int to, enum rhw_format format,
                               bool straight_alpha)
{
    struct scene *scene = draw->scene;
    rhw_context *context = scene->upload.context;
    enum rhw_result result = get_target(scene, to, format, draw->view->width, draw->band_rows);
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

static void read_band(struct draw *draw, int target, void *picture)
{
    const struct scene_target *t = &draw->scene->targets[target];
    const size_t row = (size_t)t->width * rhw_format_size(t->format);
    rhw_texture_read(draw->scene->upload.context, t->texture, 0,
                     (unsigned char *)picture + (size_t)draw->first_row * row, row);
}

// Reads the band of a picture, from the samples where one is the whole pixel.
static enum rhw_result finish_band(struct draw *draw, int samples, int resolved, enum rhw_format format,
                                   bool straight_alpha, void *picture)
{
    const double start = milliseconds();
    const struct scene_target *source = &draw->scene->targets[samples];
    const bool needed = draw->side > 1 || straight_alpha || source->format != format;
    const enum rhw_result result = needed ? resolve(draw, samples, resolved, format, straight_alpha) : RHW_OK;
    const double read = milliseconds();
    if (result == RHW_OK) {
        read_band(draw, needed ? resolved : samples, picture);
    }
    draw->stats.resolve_ms += read - start;
    draw->stats.read_ms += milliseconds() - read;
    return result;
}

static enum rhw_result draw_color_band(struct draw *draw)
{
    struct scene_pictures *pictures = draw->pictures;
    const bool transparent = draw->view->background == SCENE_BACKGROUND_TRANSPARENT;
    // Premultiplied colours of a transparent picture are divided by alpha later: 8 bits would not do.
    const enum rhw_format formats[2] = {pictures->display ? RHW_FORMAT_RGBA32_FLOAT
                                        : transparent     ? RHW_FORMAT_RGBA16_FLOAT
                                                          : RHW_FORMAT_RGBA8_SRGB,
                                        RHW_FORMAT_RGBA32_FLOAT};
    const int width = draw->view->width * draw->side, height = draw->band_rows * draw->side;
    const double start = milliseconds();
    enum rhw_result result = get_target(draw->scene, TARGET_SAMPLES, formats[0], width, height);
    if (result == RHW_OK && pictures->linear) {
        result = get_target(draw->scene, TARGET_LINEAR_SAMPLES, formats[1], width, height);
    }
    if (result == RHW_OK) {
        result = draw_samples(draw, formats, pictures->linear ? 2 : 1);
    }
    draw->stats.color_ms += milliseconds() - start;
    if (result == RHW_OK && pictures->color) {
        result = finish_band(draw, TARGET_SAMPLES, TARGET_COLOR, RHW_FORMAT_RGBA8_SRGB, transparent,
                             pictures->color);
    }
    if (result == RHW_OK && pictures->display) {
        result = finish_band(draw, TARGET_SAMPLES, TARGET_DISPLAY, RHW_FORMAT_RGBA32_FLOAT, transparent,
                             pictures->display);
    }
    if (result == RHW_OK && pictures->linear) {
        result = finish_band(draw, TARGET_LINEAR_SAMPLES, TARGET_LINEAR, RHW_FORMAT_RGBA32_FLOAT, false,
                             pictures->linear);
    }
    return result;
}

static enum rhw_result draw_data_band(struct draw *draw)
{
    struct scene *scene = draw->scene;
    rhw_context *context = scene->upload.context;
    const double start = milliseconds();
    struct scene_surface_pass surfaces = {.frame = &draw->frame, .interpolate = draw->view->interpolate};
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 0;
    def.depth = (struct rhw_depth_attachment){
        .enabled = true, .load = RHW_LOAD_CLEAR, .store = RHW_STORE_DISCARD, .clear = 0.0f};
    for (int i = 0; i < SCENE_DATA_OUTPUTS; i++) {
        draw->frame.output_slot[i] = -1;
        if (!draw->data[i]) {
            continue;
        }
        const enum rhw_result result =
            get_target(scene, TARGET_DATA + i, data_outputs[i].format, draw->view->width, draw->band_rows);
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
    set_band_viewport(draw, pass, 1);
    result = scene_surfaces_record(&scene->upload, &scene->pipelines, &surfaces, pass);
    struct rhw_stats stats = {0};
    result = scene_pass_end(context, pass, result, &stats);
    add_stats(&draw->stats.pipeline, &stats);
    const double drawn = milliseconds();
    for (int i = 0; i < SCENE_DATA_OUTPUTS && result == RHW_OK; i++) {
        if (draw->data[i]) {
            read_band(draw, TARGET_DATA + i, draw->data[i]);
        }
    }
    draw->stats.data_ms += drawn - start;
    draw->stats.read_ms += milliseconds() - drawn;
    return result;
}

// Rows of a band when a row of the picture takes `row_bytes` of targets.
static int choose_band(int height, size_t row_bytes)
{
    const size_t fit = (size_t)BAND_BYTES / row_bytes / BAND_ROWS * BAND_ROWS;
    const size_t rows = fit > 0 ? fit : BAND_ROWS;
    return rows >= (size_t)height ? height : (int)rows;
}

static enum rhw_result draw_bands(struct draw *draw, enum rhw_result (*draw_band)(struct draw *))
{
    enum rhw_result result = RHW_OK;
    for (draw->first_row = 0; draw->first_row < draw->view->height && result == RHW_OK;
         draw->first_row += draw->band_rows) {
        draw->frame.first_row = (float)draw->first_row;
        result = draw_band(draw);
    }
    return result;
}

// A picture has room for whole bands; rows beyond the height are never looked at.
static bool allocate_picture(const struct draw *draw, enum rhw_format format, void **picture)
{
    const size_t bands = ((size_t)draw->view->height + (size_t)draw->band_rows - 1) / (size_t)draw->band_rows;
    *picture = malloc(bands * (size_t)draw->band_rows * (size_t)draw->view->width * rhw_format_size(format));
    return *picture != NULL;
}

// What light needs to know of the whole picture before any of it is drawn.
static enum rhw_result prepare_light(struct draw *draw)
{
    struct scene *scene = draw->scene;
    const struct scene_view *view = draw->view;
    if (!(view->ambient_occlusion || view->shadows) || draw->frame.plain) {
        return RHW_OK;
    }
    const double start = milliseconds();
    enum rhw_result result = scene_guide_draw(&scene->guide, &scene->upload, &scene->pipelines, view,
                                              &draw->frame, draw->view_projection);
    if (result == RHW_OK && view->ambient_occlusion) {
        result = scene_guide_occlude(&scene->guide, scene->upload.context, scene->nearest, view,
                                     occlusion_reach * subject_radius(scene->upload.model));
        draw->frame.guide = scene_guide_lookup(&scene->guide, view);
    }
    if (result == RHW_OK && view->shadows) {
        result = scene_shadows_draw(&scene->shadows, &scene->upload, &scene->pipelines, view, &scene->guide,
                                    &draw->frame, &draw->lighting);
    }
    draw->stats.light_ms += milliseconds() - start;
    return result;
}

static enum rhw_result draw_color(struct draw *draw)
{
    const uint32_t outputs = draw->view->outputs;
    if (!(outputs & (SCENE_OUTPUT_COLOR | SCENE_OUTPUT_LINEAR | SCENE_OUTPUT_DISPLAY))) {
        return RHW_OK;
    }
    const size_t per_sample =
        (outputs & SCENE_OUTPUT_DISPLAY ? 16u : 8u) + (outputs & SCENE_OUTPUT_LINEAR ? 16u : 0u);
    const size_t samples = (size_t)draw->view->supersample;
    draw->band_rows = choose_band(draw->view->height, (size_t)draw->view->width * per_sample * samples);
    void *color = NULL, *linear = NULL, *display = NULL;
    const bool allocated =
        (!(outputs & SCENE_OUTPUT_COLOR) || allocate_picture(draw, RHW_FORMAT_RGBA8_SRGB, &color)) &&
        (!(outputs & SCENE_OUTPUT_LINEAR) || allocate_picture(draw, RHW_FORMAT_RGBA32_FLOAT, &linear)) &&
        (!(outputs & SCENE_OUTPUT_DISPLAY) || allocate_picture(draw, RHW_FORMAT_RGBA32_FLOAT, &display));
    draw->pictures->color = color;
    draw->pictures->linear = linear;
    draw->pictures->display = display;
    if (!allocated) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    draw->frame.write_linear = linear != NULL;
    const enum rhw_result result = prepare_light(draw);
    if (result != RHW_OK) {
        return result;
    }
    set_frame_samples(draw, draw->side);
    return draw_bands(draw, draw_color_band);
}

static enum rhw_result draw_data(struct draw *draw)
{
    size_t pixel = 0;
    for (int i = 0; i < SCENE_DATA_OUTPUTS; i++) {
        pixel += draw->view->outputs & data_outputs[i].output ? rhw_format_size(data_outputs[i].format) : 0;
    }
    if (pixel == 0) {
        return RHW_OK;
    }
    draw->band_rows = choose_band(draw->view->height, (size_t)draw->view->width * pixel);
    bool allocated = true;
    for (int i = 0; i < SCENE_DATA_OUTPUTS; i++) {
        if (draw->view->outputs & data_outputs[i].output) {
            allocated = allocate_picture(draw, data_outputs[i].format, &draw->data[i]) && allocated;
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
    if (!allocated) {
        return RHW_ERROR_OUT_OF_MEMORY;
    }
    draw->frame.plain = 0;
    draw->frame.write_linear = 0;
    set_frame_samples(draw, 1);
    return draw_bands(draw, draw_data_band);
}

static enum rhw_result surround(struct draw *draw)
{
    struct scene *scene = draw->scene;
    const struct scene_view *view = draw->view;
    if (!view->panorama) {
        scene_surroundings_destroy(scene->upload.context, &scene->surroundings);
        return RHW_OK;
    }
    const enum rhw_result result = scene_surroundings_make(&scene->surroundings, scene->upload.context,
                                                           view->panorama, view->up, view->panorama_rotation);
    if (result == RHW_OK) {
        scene_lighting_surround(&draw->lighting, &scene->surroundings, view->exposure);
    }
    return result;
}

enum rhw_result scene_draw(struct scene *scene, const struct scene_view *view,
                           struct scene_pictures *pictures, struct scene_draw_stats *stats)
{
    *pictures = (struct scene_pictures){.width = view->width, .height = view->height};
    struct draw draw = {
        .scene = scene, .view = view, .pictures = pictures, .side = scene_view_grid_side(view)};
    draw.stats.upload_ms = scene->upload_ms;
    enum rhw_result result = RHW_ERROR_OUT_OF_MEMORY;
    if (scene_lighting_create(&draw.lighting, scene->upload.model, &view->camera, view->up,
                              view->default_lights, view->exposure)) {
        result = surround(&draw);
    }
    if (result == RHW_OK) {
        set_frame(&draw);
        result = draw_color(&draw);
    }
    if (result == RHW_OK) {
        result = draw_data(&draw);
    }
    scene_lighting_destroy(&draw.lighting);
    if (result != RHW_OK) {
        scene_pictures_free(pictures);
    }
    if (stats) {
        *stats = draw.stats;
    }
    return result;
}
