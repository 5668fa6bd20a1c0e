// SPDX-License-Identifier: MIT
// From a job and a model in memory to pictures in memory: the part of rhw render that opens no file, which the
// WebAssembly module shares.
#include "render_camera.h"
#include "render_state.h"

#include "message.h"

#include <stdio.h>
#include <string.h>

enum { WARNINGS_SHOWN = 32 };

// What the user can do about what a line says; "" where there is nothing, or where the surface has no such means.
static const char *advice_on(const struct render *render, const char *line)
{
    const uint32_t count = render->model->animation_count;
    char rest[64];
    snprintf(rest, sizeof rest, "%u animation%s: drawn at rest", (unsigned)count, count == 1 ? "" : "s");
    return render->job.offers_time && strcmp(line, rest) == 0 ? "; --time shows another moment" : "";
}

// What was wrong with the file, and what of it is not drawn. Returns how many lines there are.
static uint32_t warn(const struct render *render)
{
    const struct scene_model *model = render->model;
    const uint32_t count = model->warning_count + model->unsupported_count;
    for (uint32_t i = 0; i < count && i < WARNINGS_SHOWN && !render->job.quiet; i++) {
        const char *const line =
            i < model->warning_count ? model->warnings[i] : model->unsupported[i - model->warning_count];
        cli_warning(render->job.model_path, "%s%s", line, advice_on(render, line));
    }
    if (count > WARNINGS_SHOWN && !render->job.quiet) {
        cli_warning(render->job.model_path, "%u more warnings; rhw info prints them all",
                    count - WARNINGS_SHOWN);
    }
    return count;
}

// Refuse a model without anything to draw in one line, with the first of what its file has that is not drawn.
static void refuse_empty(const struct render *render)
{
    enum { REASONS = 3 };
    const struct scene_model *model = render->model;
    char reasons[1024] = "";
    size_t length = 0;
    for (uint32_t i = 0; i < model->warning_count + model->unsupported_count && i < REASONS; i++) {
        const char *const line =
            i < model->warning_count ? model->warnings[i] : model->unsupported[i - model->warning_count];
        const int written =
            snprintf(reasons + length, sizeof reasons - length, "%s%s", i == 0 ? ": " : "; ", line);
        length += written > 0 && (size_t)written < sizeof reasons - length ? (size_t)written : 0;
    }
    cli_error(render->job.model_path, "the file has nothing to draw%s", reasons);
}

bool cli_render_accept(const struct render *render)
{
    const struct cli_render_job *job = &render->job;
    const struct scene_model *model = render->model;
    if (!(model->bounds_min[0] <= model->bounds_max[0])) {
        refuse_empty(render);
        return false;
    }
    const uint32_t lines = warn(render);
    if (job->strict && lines > 0) {
        cli_error(job->model_path,
                  "is not drawn as it is meant, for the reasons above (%u); --strict allows none", lines);
        return false;
    }
    return true;
}

bool cli_render_set_view(struct render *render)
{
    const struct cli_render_job *job = &render->job;
    struct scene_view *view = &render->view;
    char error[256];
    if (job->fragment_shader && !render->program) {
        cli_error("--fragment-shader", "is for rhw render alone");
        return false;
    }
    *view = scene_view_default(render->model);
    view->width = job->width;
    view->height = job->height;
    view->samples = job->samples;
    view->supersample = job->supersample;
    view->interpolate = job->interpolate;
    view->wireframe = job->wireframe;
    view->background = job->background;
    memcpy(view->background_color, job->background_color, sizeof view->background_color);
    view->default_lights = job->default_lights;
    view->no_lights = job->no_lights;
    view->shadows = job->shadows;
    view->ground = job->ground;
    view->ambient_occlusion = job->ambient_occlusion;
    view->panorama = job->environment ? &render->panorama : NULL;
    view->panorama_rotation = (double)job->environment_rotation;
    view->tone = job->tone;
    view->transparency = job->transparency;
    view->program = render->program;
    view->up = job->has_up ? job->up : render->model->up;
    view->exposure = (double)job->exposure;
    view->outputs = cli_outputs_needed(job->kinds, job->format, job->bits);
    view->goes_on = render->goes_on;
    view->user = render->user;
    if (!cli_camera_choose(job, render->model, &view->camera, &render->distrusts_camera)) {
        return false;
    }
    if (scene_view_check(view, error, sizeof error)) {
        return true;
    }
    cli_error("render", "%s", error);
    return false;
}

static void log_line(void *user, enum rhw_log_level level, const char *message)
{
    const struct cli_render_job *job = user;
    if (level == RHW_LOG_WARNING && !job->quiet) {
        cli_warning(job->model_path, "%s", message);
    }
}

static bool report(const struct render *render, enum rhw_result result)
{
    cli_stage_end();
    if (result != RHW_OK && result != RHW_ERROR_GIVEN_UP) {
        const bool limited = result == RHW_ERROR_OUT_OF_MEMORY && render->job.budget.memory > 0;
        cli_error(render->job.model_path, "%s%s", rhw_result_string(result),
                  limited ? "; --max-memory allows no more" : "");
    }
    return result == RHW_OK;
}

// With --strict a camera of the file does not give way. Reports failure.
static bool accept_camera(const struct render *render)
{
    const bool accepted = !render->job.strict || !render->distrusts_camera;
    if (!accepted) {
        cli_error(render->job.model_path,
                  "its camera does not show the model; --strict lets none take its place, --fit does");
    }
    return accepted;
}

bool cli_render_open_scene(struct render *render)
{
    struct rhw_context_def def = rhw_context_def_default();
    if (!accept_camera(render)) {
        return false;
    }
    def.threads = render->job.threads;
    def.isa_limit = rhw_isa_up_to(render->job.isa);
    def.paths = render->job.paths;
    def.log = log_line;
    def.user = &render->job;
    cli_stage("drawing", render->job.model_path);
    enum rhw_result result = rhw_context_create(&def, &render->context);
    if (result == RHW_OK) {
        result = scene_create(render->context, render->model, &render->scene);
    }
    return report(render, result);
}

bool cli_render_draw(struct render *render)
{
    scene_pictures_free(&render->pictures);
    return report(render, scene_draw(render->scene, &render->view, &render->pictures, &render->stats));
}

// Who asked for a view in which nothing is seen gets it, with a warning; with --strict nobody gets a picture.
static bool accept_blank(const struct render *render, const char *sight)
{
    const struct cli_render_job *job = &render->job;
    if (job->strict) {
        cli_error(job->model_path, "%s of the model is in the picture; --strict allows no such picture",
                  sight);
    } else if (!job->quiet) {
        cli_warning(job->model_path, "%s of the model is in the picture", sight);
    }
    return !job->strict;
}

static bool takes_own_camera(const struct render *render)
{
    return render->job.camera == CLI_CAMERA_AUTO && cli_camera_find(&render->job, render->model) &&
           !render->distrusts_camera;
}

// Nothing was seen. A camera that merely stands in the file, as many exporters leave one, is no reason for an empty
// picture. Reports failure.
static bool draw_again(struct render *render)
{
    const struct cli_render_job *job = &render->job;
    if (render->model->lacks_area) {
        return true; // a warning about the model has said why
    }
    if (!takes_own_camera(render)) {
        return accept_blank(render, "nothing");
    }
    if (!job->quiet && !job->strict) {
        cli_warning(job->model_path, "its camera sees nothing of the model, which is fitted instead");
    }
    render->distrusts_camera = true;
    if (!accept_camera(render)) {
        return false;
    }
    render->view.camera = cli_camera_fit(job, render->model);
    return cli_render_draw(render);
}

// The camera of a file that nobody asked for may stand within the model, or look past most of it. One that was asked
// for may see next to nothing. Reports failure.
static bool judge_view(const struct render *render)
{
    const struct cli_render_job *job = &render->job;
    const struct scene_camera *const camera = &render->view.camera;
    const double aspect = (double)job->width / (double)job->height;
    if (!takes_own_camera(render)) {
        return job->camera <= CLI_CAMERA_FIT || job->camera == CLI_CAMERA_VIEWS ||
               !scene_camera_shows_a_dot(render->model, camera, aspect) ||
               accept_blank(render, "next to nothing");
    }
    if (!job->quiet && !scene_camera_shows_most(render->model, camera, aspect)) {
        cli_warning(job->model_path, "the file's camera shows part of the model; --fit shows all");
    }
    return true;
}

bool cli_render_draw_seen(struct render *render)
{
    cli_stage("drawing", render->job.model_path);
    return accept_camera(render) && cli_render_draw(render) &&
           (render->stats.pipeline.triangles_rasterized == 0 ? draw_again(render) : judge_view(render));
}
