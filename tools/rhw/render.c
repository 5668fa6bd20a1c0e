// SPDX-License-Identifier: MIT
// rhw render: model file in, picture files out. This file is the order of things; what the command line
// means stands in render_options.c, what becomes of an output in outputs.c.
#include "options.h"
#include "render_camera.h"
#include "render_state.h"
#include "verbs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WARNINGS_SHOWN = 32 };

double cli_milliseconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

// What was wrong with the file, and what of it is not drawn. Returns how many lines there are.
static uint32_t warn(const struct render *render)
{
    const struct scene_model *model = render->model;
    const uint32_t count = model->warning_count + model->unsupported_count;
    for (uint32_t i = 0; i < count && i < WARNINGS_SHOWN && !render->job.quiet; i++) {
        cli_warning(render->job.model_path, "%s",
                    i < model->warning_count ? model->warnings[i]
                                             : model->unsupported[i - model->warning_count]);
    }
    if (count > WARNINGS_SHOWN && !render->job.quiet) {
        cli_warning(render->job.model_path, "%u more warnings; rhw info prints them all",
                    count - WARNINGS_SHOWN);
    }
    return count;
}

static bool import_model(struct render *render)
{
    const struct cli_render_job *job = &render->job;
    const double start = cli_milliseconds();
    render->model =
        cli_model_input_load(&render->input, &job->budget,
                             (struct scene_model_options){.variant = job->variant,
                                                          .is_posed = job->is_posed || job->rate > 0.0,
                                                          .animation = job->animation,
                                                          .time = job->time,
                                                          .texture_side = job->budget.texture,
                                                          .progress = render->progress});
    render->times.import_ms = cli_milliseconds() - start;
    if (!render->model) {
        return false;
    }
    const struct scene_model *model = render->model;
    if (!(model->bounds_min[0] <= model->bounds_max[0])) { // one line, with the reason if there is one
        const bool reason = model->warning_count > 0;
        cli_error(job->model_path, "the file has nothing to draw%s%s", reason ? ": " : "",
                  reason ? model->warnings[0] : "");
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
    view->up = job->has_up ? job->up : render->model->up;
    view->exposure = (double)job->exposure;
    view->outputs = cli_outputs_needed(job->kinds, job->format, job->bits);
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

// Nothing was seen. Who asked for that view gets it, with a warning; but a camera that merely stands in the
// file, as many exporters leave one, is no reason for an empty picture.
static enum rhw_result draw_again(struct render *render)
{
    const struct cli_render_job *job = &render->job;
    const bool refit =
        job->camera == CLI_CAMERA_AUTO && cli_camera_find(job, render->model) && !render->distrusts_camera;
    if (!job->quiet) {
        cli_warning(job->model_path, refit ? "its camera sees nothing of the model, which is fitted instead"
                                           : "nothing of the model is in the picture");
    }
    if (!refit) {
        return RHW_OK;
    }
    render->view.camera = cli_camera_fit(job, render->model);
    scene_pictures_free(&render->pictures);
    return scene_draw(render->scene, &render->view, &render->pictures, &render->stats);
}

// The camera of a file that nobody asked for may stand within the model, or look past most of it.
static void warn_of_a_partial_view(const struct render *render)
{
    const struct cli_render_job *job = &render->job;
    if (!job->quiet && job->camera == CLI_CAMERA_AUTO && cli_camera_find(job, render->model) &&
        !render->distrusts_camera &&
        !scene_camera_shows_most(render->model, &render->view.camera,
                                 (double)job->width / (double)job->height)) {
        cli_warning(job->model_path, "the file's camera shows part of the model; --fit shows all");
    }
}

static bool report(const struct render *render, enum rhw_result result)
{
    cli_stage_end();
    if (result != RHW_OK) {
        const bool limited = result == RHW_ERROR_OUT_OF_MEMORY && render->job.budget.memory > 0;
        cli_error(render->job.model_path, "%s%s", rhw_result_string(result),
                  limited ? "; --max-memory allows no more" : "");
    }
    return result == RHW_OK;
}

bool cli_render_open_scene(struct render *render)
{
    struct rhw_context_def def = rhw_context_def_default();
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

static bool draw(struct render *render)
{
    scene_pictures_free(&render->pictures);
    cli_stage("drawing", render->job.model_path);
    enum rhw_result result = scene_draw(render->scene, &render->view, &render->pictures, &render->stats);
    if (result == RHW_OK && render->stats.pipeline.triangles_rasterized == 0) {
        result = draw_again(render);
    } else if (result == RHW_OK) {
        warn_of_a_partial_view(render);
    }
    return report(render, result);
}

// A file for each view.
static int draw_views(struct render *render)
{
    struct cli_render_job *const job = &render->job;
    int status = CLI_OK;
    for (int i = 0; i < job->view_count && status == CLI_OK; i++) {
        cli_render_files_forget(render);
        job->orbit = cli_view_orbit(job->views[i]);
        const bool drawn = cli_render_files_plan(render, i) && cli_render_set_view(render) && draw(render) &&
                           cli_render_files_write(render);
        status = drawn ? CLI_OK : CLI_FAILED;
    }
    return status;
}

// All views on one sheet.
static int draw_sheet(struct render *render)
{
    struct cli_render_job *const job = &render->job;
    struct scene_pictures sheet = {0};
    int columns, rows, status = CLI_OK;
    cli_sheet_grid(job->view_count, &columns, &rows);
    for (int i = 0; i < job->view_count && status == CLI_OK; i++) {
        job->orbit = cli_view_orbit(job->views[i]);
        status = cli_render_set_view(render) && draw(render) ? CLI_OK : CLI_FAILED;
        if (status == CLI_OK && i == 0 && !cli_sheet_create(&sheet, &render->pictures, columns, rows)) {
            cli_error(job->model_path, "there is not enough memory for a sheet of %d views", job->view_count);
            status = CLI_FAILED;
        }
        if (status == CLI_OK) {
            cli_sheet_place(&sheet, &render->pictures, i);
        }
    }
    if (status == CLI_OK) {
        cli_sheet_end(&sheet, &render->pictures, job->view_count);
        const struct scene_pictures last = render->pictures;
        render->pictures = sheet;
        sheet = last;
        status = cli_render_files_write(render) ? CLI_OK : CLI_FAILED;
    }
    scene_pictures_free(&sheet);
    return status;
}

int cli_render_open(struct render *render, const char *path)
{
    render->job.model_path = path;
    if (!cli_model_input_open(&render->input, path)) {
        return CLI_FAILED;
    }
    render->job.model_path = render->input.name;
    return !import_model(render) ? CLI_FAILED : cli_render_set_view(render) ? CLI_OK : CLI_USAGE;
}

static int run(struct render *render)
{
    const double start = cli_milliseconds();
    const struct cli_render_job *job = &render->job;
    if (!cli_render_files_check(render) || !import_model(render)) {
        return CLI_FAILED;
    }
    if (!cli_render_set_view(render)) { // before anything is uploaded
        return CLI_USAGE;
    }
    if (!cli_render_open_scene(render)) {
        return CLI_FAILED;
    }
    if (cli_render_moves(job)) {
        return cli_render_frames(render) ? CLI_OK : CLI_FAILED;
    }
    const int status = cli_render_has_file_per_view(job)                ? draw_views(render)
                       : job->view_count > 0                            ? draw_sheet(render)
                       : draw(render) && cli_render_files_write(render) ? CLI_OK
                                                                        : CLI_FAILED;
    if (status != CLI_OK) {
        return status;
    }
    if (job->print_camera) {
        cli_camera_print(&render->view.camera);
    }
    render->times.total_ms = cli_milliseconds() - start;
    if (job->stats && !cli_render_report(job, render->model, &render->stats, &render->times)) {
        return CLI_FAILED;
    }
    return CLI_OK;
}

void cli_render_forget_model(struct render *render)
{
    cli_model_input_close(&render->input);
    scene_pictures_free(&render->pictures);
    if (render->scene) {
        scene_destroy(render->scene);
    }
    rhw_context_destroy(render->context);
    if (render->model) {
        scene_model_free(render->model);
    }
    cli_render_files_forget(render);
    render->scene = NULL;
    render->context = NULL;
    render->model = NULL;
}

static int render_model(struct render *render, const char *path)
{
    render->job.model_path = path;
    int status = CLI_FAILED;
    if (cli_model_input_open(&render->input, path)) {
        render->job.model_path = render->input.name;
        status = run(render);
    }
    cli_render_forget_model(render);
    return status;
}

bool cli_render_prepare(struct render *render)
{
    const struct cli_render_job *job = &render->job;
    if (job->isa != RHW_ISA_COUNT && !rhw_isa_supported(job->isa)) {
        cli_error("--isa", "this computer or this build has no %s", rhw_isa_name(job->isa));
        return false;
    }
    cli_budget_apply(&job->budget, job->model_count > 1 ? "render" : job->model_paths[0]);
    return !job->environment || cli_panorama_load(&render->panorama, job->environment);
}

int cli_render(int argc, char **argv)
{
    struct render render = {0};
    int status;
    if (!cli_render_job_parse(&render.job, argc, argv, &status)) {
        return status;
    }
    if (!cli_render_prepare(&render)) {
        return CLI_FAILED;
    }
    status = CLI_OK;
    for (int i = 0; i < render.job.model_count && status != CLI_USAGE; i++) {
        const int each = render_model(&render, render.job.model_paths[i]); // a failure keeps no other from it
        status = each == CLI_OK ? status : each;
    }
    free(render.panorama.texels);
    return status;
}
