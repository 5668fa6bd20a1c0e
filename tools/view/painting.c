// SPDX-License-Identifier: MIT
// See painting.h.
#include "painting.h"

#include "explain_draw.h"
#include "growing.h"
#include "movement.h"
#include "options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LEAST_SIDE = 16 }; // pixels

// The model on the screen ----------------------------------------------------------------------------

static void forget_scene(struct view_painting *p)
{
    struct render *const render = &p->render;
    scene_pictures_free(&render->pictures);
    scene_destroy(render->scene);
    rhw_context_destroy(render->context);
    cli_movement_free_pose(p->pose);
    render->scene = NULL;
    render->context = NULL;
    render->model = p->base;
    p->pose = NULL;
}

void view_painting_close(struct view_painting *p)
{
    forget_scene(p);
    cli_render_forget_model(&p->render);
    p->base = NULL;
}

static struct view_moment moment_of(const struct cli_render_job *job)
{
    return (struct view_moment){job->is_posed, job->time, job->animation};
}

void view_painting_open(struct view_painting *p, const struct scene_panorama *panorama)
{
    p->render.panorama = *panorama;
    p->render.goes_on = p->goes_on;
    p->render.user = p->user;
}

void view_painting_adopt(struct view_painting *p, const struct render *read)
{
    view_painting_close(p);
    p->render.model = p->base = read->model;
    p->render.input = read->input;
    p->base_moment = moment_of(&read->job);
    p->coarseness = view_coarseness_start();
}

static bool is_same_moment(struct view_moment a, struct view_moment b)
{
    const bool same_animation =
        a.animation == b.animation || (a.animation && b.animation && strcmp(a.animation, b.animation) == 0);
    return a.is_posed == b.is_posed && (!a.is_posed || (a.time == b.time && same_animation));
}

// The scene in the pose that the job asks for. Where there is none it keeps the one that it has.
static bool set_pose(struct view_painting *p)
{
    struct render *const render = &p->render;
    const struct view_moment wanted = moment_of(&render->job);
    if (is_same_moment(wanted, p->pose ? p->pose_moment : p->base_moment)) {
        return true;
    }
    p->say(p->user, "Posing");
    const bool is_base = is_same_moment(wanted, p->base_moment);
    render->model = p->base;
    struct scene_model *const pose = is_base ? NULL : cli_pose_read(render, wanted.time);
    render->model = p->pose ? p->pose : p->base;
    if (!is_base && !pose) {
        return false;
    }
    const enum rhw_result result = scene_set_pose(render->scene, is_base ? p->base : pose);
    if (result != RHW_OK) {
        cli_error(render->job.model_path, "%s", rhw_result_string(result));
        forget_scene(p); // first: it may stand on the pose
        cli_movement_free_pose(pose);
        return false;
    }
    cli_movement_free_pose(p->pose);
    p->pose = pose;
    p->pose_moment = wanted;
    render->model = is_base ? p->base : pose;
    return true;
}

// Whatever the order says of threads and instruction set.
static bool open_scene(struct view_painting *p, const struct cli_render_job *job)
{
    struct render *const render = &p->render;
    const bool fits = render->scene && job->threads == render->job.threads && job->isa == render->job.isa &&
                      job->paths == render->job.paths;
    const char *const path = render->input.name;
    render->job = *job;
    render->job.model_path = path;
    if (!fits) {
        p->say(p->user, "Preparing");
        forget_scene(p);
        if (!cli_render_open_scene(render)) {
            forget_scene(p);
            return false;
        }
    }
    return set_pose(p);
}

// Drawing --------------------------------------------------------------------------------------------

// Leaves out what a picture of something that moves can do without.
static void coarsen(struct cli_render_job *job, int level)
{
    const struct view_coarse_look look = view_coarseness_look(level);
    if (look.one_sample) {
        job->samples = job->supersample = 1;
    }
    if (look.plain) {
        job->shadows = job->ambient_occlusion = false;
    }
    job->width = job->width / look.divisor > LEAST_SIDE ? job->width / look.divisor : LEAST_SIDE;
    job->height = job->height / look.divisor > LEAST_SIDE ? job->height / look.divisor : LEAST_SIDE;
}

// Marks the cells of the picture in which something of the model is.
static void find_covered(const struct scene_pictures *pictures, uint16_t covered[VIEW_CELLS])
{
    enum { STEP = 2 }; // pixels from one that is looked at to the next
    for (int y = 0; y < pictures->height; y += STEP) {
        const uint32_t *const row = pictures->object + (size_t)y * (size_t)pictures->width;
        uint16_t *const cells = &covered[y * VIEW_CELLS / pictures->height];
        for (int x = 0; x < pictures->width; x += STEP) {
            const int cell = x * VIEW_CELLS / pictures->width;
            *cells = (uint16_t)(*cells | (row[x] != 0) << cell);
        }
    }
}

// A transparent pixel over fields, as it is usual.
static void lay_over_fields(uint8_t *pixel, int x, int y)
{
    enum { FIELD = 12, LIGHT = 205, DARK = 170 };
    const int field = (x / FIELD + y / FIELD) % 2 ? DARK : LIGHT, alpha = pixel[3];
    for (int c = 0; c < 3; c++) {
        pixel[c] = (uint8_t)((pixel[c] * alpha + field * (255 - alpha) + 127) / 255);
    }
    pixel[3] = UINT8_MAX;
}

// The output that is shown, as a file has it, in RGBA. NULL after a report.
static uint8_t *make_pixels(const struct render *render)
{
    struct cli_output_raster output;
    const enum scene_output_kind kind = (enum scene_output_kind)__builtin_ctz(render->job.kinds);
    cli_render_rasterize(render, kind, &output);
    const int width = output.raster.width, height = output.raster.height, channels = output.raster.channels;
    uint8_t *pixels = malloc((size_t)width * (size_t)height * 4);
    uint8_t *const row = malloc((size_t)width * (size_t)channels);
    for (int y = 0; y < height && pixels && row; y++) {
        output.raster.row(output.raster.user, y, row);
        for (int x = 0; x < width; x++) {
            const uint8_t *const from = row + x * channels;
            uint8_t *const to = pixels + 4 * ((size_t)y * (size_t)width + (size_t)x);
            for (int c = 0; c < 4; c++) {
                to[c] = channels == 1 && c < 3 ? from[0] : c < channels ? from[c] : UINT8_MAX;
            }
            if (channels == 4) {
                lay_over_fields(to, x, y);
            }
        }
    }
    if (!row) {
        free(pixels);
        pixels = NULL;
    }
    free(row);
    if (!pixels) {
        cli_error(render->job.model_path, "out of memory");
    }
    return pixels;
}

static bool draw(struct view_painting *p, const struct cli_render_job *job, int level)
{
    struct render *const render = &p->render;
    if (!p->base || !open_scene(p, job)) {
        return false;
    }
    p->say(p->user, "Drawing");
    coarsen(&render->job, level);
    const double start = cli_milliseconds();
    bool drawn = cli_render_set_view(render);
    if (job->kinds == 1u << SCENE_KIND_COLOR) {
        render->view.outputs |= SCENE_OUTPUT_OBJECT; // tells where there is room for other things
    }
    drawn = drawn && cli_render_draw(render);
    p->drawn_ms = cli_milliseconds() - start;
    return drawn;
}

struct view_picture view_painting_draw(struct view_painting *p, const struct view_order *order)
{
    const int level = order->hurries ? p->coarseness.level : 0;
    if (!draw(p, &order->job, level)) {
        return (struct view_picture){.version = order->version};
    }
    const struct render *const render = &p->render;
    view_coarseness_learn(&p->coarseness, level, order->hurries, p->drawn_ms);
    struct view_picture picture = {.pixels = make_pixels(render),
                                   .width = render->pictures.width,
                                   .height = render->pictures.height,
                                   .is_coarse = level > 0,
                                   .version = order->version,
                                   .ms = p->drawn_ms,
                                   .triangles = render->stats.pipeline.triangles_in,
                                   .threads = rhw_context_threads(render->context),
                                   .isa = rhw_context_isa(render->context)};
    if (render->pictures.object) {
        find_covered(&render->pictures, picture.covered);
    }
    return picture;
}

// Errands --------------------------------------------------------------------------------------------

char *view_painting_explain(struct view_painting *p, const struct view_order *order, int x, int y)
{
    struct cli_history history;
    struct cli_explanation explanation;
    struct cli_render_job job = order->job;
    job.kinds = 1u << SCENE_KIND_COLOR;
    if (!p->base || !open_scene(p, &job) || !cli_render_set_view(&p->render)) {
        return NULL;
    }
    p->say(p->user, "Explaining");
    if (!cli_explain_draw(&p->render, x, y, 0, &history, &explanation)) {
        return NULL;
    }
    struct system_growing text;
    const bool opened = system_growing_open(&text);
    if (opened) {
        cli_explain_text(text.stream, &explanation);
    }
    cli_history_free(&history);
    if (!opened || !system_growing_close(&text)) {
        cli_error(p->render.job.model_path, "out of memory");
        return NULL;
    }
    return text.bytes;
}

// The first name of a picture of the model that no file has.
static void name_picture(struct view_painting *p, char *name, size_t size)
{
    const char *const path = p->render.input.name, *const slash = strrchr(path, '/'),
                      *const base = slash ? slash + 1 : path;
    const char *const dot = strrchr(base, '.');
    const int stem = dot && dot > base ? (int)(dot - base) : (int)strlen(base);
    do {
        snprintf(name, size, "%.*s-%d.png", stem, base, ++p->saved);
    } while (access(name, F_OK) == 0);
}

char *view_painting_save(struct view_painting *p, const struct view_order *order)
{
    char name[512], text[600];
    if (!draw(p, &order->job, 0)) {
        return NULL;
    }
    name_picture(p, name, sizeof name);
    cli_render_files_forget(&p->render);
    const bool saved = cli_render_files_name(&p->render, name) && cli_render_files_write(&p->render);
    cli_render_files_forget(&p->render);
    snprintf(text, sizeof text, "Saved %s\n", name);
    return saved ? strdup(text) : NULL;
}
