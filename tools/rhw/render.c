// SPDX-License-Identifier: MIT
// rhw render: model file in, picture files out. This file is the order of things; what the command line
// means stands in render_options.c, what becomes of an output in outputs.c.
#include "model_input.h"
#include "options.h"
#include "output_file.h"
#include "panorama_load.h"
#include "render_camera.h"
#include "render_job.h"
#include "verbs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WARNINGS_SHOWN = 32, JPEG_QUALITY = 92 };

struct render {
    struct cli_render_job job;
    struct cli_model_input input;
    struct scene_model *model;
    struct scene_panorama panorama; // with job.environment
    rhw_context *context;
    struct scene *scene;
    struct scene_view view;
    struct scene_pictures pictures;
    struct scene_draw_stats stats;
    struct cli_render_times times;
    char *paths[CLI_KIND_COUNT]; // NULL: not written
    struct cli_output_file files[CLI_KIND_COUNT];
    int file_count;        // open ones
    bool distrusts_camera; // the file's first camera gave way to the fit
};

static double now_ms(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

// OUT, or with several outputs OUT with the output's name in it.
static char *make_path(const struct cli_render_job *job, enum cli_output_kind kind)
{
    const char *name = cli_output_name(kind), *out = job->out;
    const size_t size = strlen(out) + strlen(name) + 2;
    char *path = malloc(size);
    if (!path) {
        return NULL;
    }
    const char *place = strstr(out, "{}");
    const bool several = (job->kinds & (job->kinds - 1)) != 0;
    if (job->format != CLI_PICTURE_EXR && place) {
        snprintf(path, size, "%.*s%s%s", (int)(place - out), out, name, place + 2);
    } else if (job->format == CLI_PICTURE_EXR || !several || kind == CLI_KIND_COLOR) {
        snprintf(path, size, "%s", out);
    } else {
        const char *base = strrchr(out, '/') ? strrchr(out, '/') : out;
        const char *dot = strrchr(base, '.');
        const int stem = dot ? (int)(dot - out) : (int)strlen(out);
        snprintf(path, size, "%.*s.%s%s", stem, out, name, dot ? dot : "");
    }
    return path;
}

static bool plan_files(struct render *render)
{
    const struct cli_render_job *job = &render->job;
    for (int kind = 0; kind < CLI_KIND_COUNT; kind++) {
        if (!(job->kinds >> kind & 1)) {
            continue;
        }
        render->paths[kind] = make_path(job, (enum cli_output_kind)kind);
        if (!render->paths[kind]) {
            cli_error(job->out, "out of memory");
            return false;
        }
        if (!cli_output_file_check(render->paths[kind]) ||
            cli_model_input_is(&render->input, render->paths[kind])) {
            return false;
        }
        if (job->format == CLI_PICTURE_EXR) {
            break; // one file for all
        }
    }
    return !job->stats ||
           (cli_output_file_check(job->stats_path) && !cli_model_input_is(&render->input, job->stats_path));
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
    const double start = now_ms();
    render->model = cli_model_input_load(
        &render->input, &job->budget,
        (struct scene_model_options){.variant = job->variant, .texture_side = job->budget.texture});
    render->times.import_ms = now_ms() - start;
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

// False: the command line asks for a view that cannot be.
static bool set_view(struct render *render)
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

static bool draw(struct render *render)
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
    if (result == RHW_OK) {
        result = scene_draw(render->scene, &render->view, &render->pictures, &render->stats);
    }
    if (result == RHW_OK && render->stats.pipeline.triangles_rasterized == 0) {
        result = draw_again(render);
    } else if (result == RHW_OK) {
        warn_of_a_partial_view(render);
    }
    cli_stage_end();
    if (result != RHW_OK) {
        const bool limited = result == RHW_ERROR_OUT_OF_MEMORY && render->job.budget.memory > 0;
        cli_error(render->job.model_path, "%s%s", rhw_result_string(result),
                  limited ? "; --max-memory allows no more" : "");
    }
    return result == RHW_OK;
}

static bool encode_exr(struct render *render, struct cli_output_file *file)
{
    struct cli_exr_channel channels[CLI_EXR_CHANNELS_MAX];
    const int count = cli_outputs_exr_channels(&render->pictures, render->job.kinds, channels);
    return cli_exr_write(file, render->pictures.width, render->pictures.height, channels, count,
                         rhw_context_threads(render->context));
}

static bool encode_raster(struct render *render, struct cli_output_file *file, enum cli_output_kind kind)
{
    const struct cli_render_job *job = &render->job;
    struct cli_output_raster output;
    cli_output_rasterize(&output, &render->pictures, kind, job->bits,
                         job->background == SCENE_BACKGROUND_TRANSPARENT, render->model->bounds_min,
                         render->model->bounds_max);
    switch (job->format) {
    case CLI_PICTURE_PNG: return cli_png_write(file, &output.raster);
    case CLI_PICTURE_JPEG:
        return cli_jpeg_write(file, &output.raster, job->quality ? job->quality : JPEG_QUALITY);
    case CLI_PICTURE_WEBP: return cli_webp_write(file, &output.raster, job->quality);
    default: return cli_ppm_write(file, &output.raster);
    }
}

// All files are complete before the first gets its name, so that a full disk leaves none of them.
static bool write_files(struct render *render)
{
    const double start = now_ms();
    bool written = true;
    for (int kind = 0; written && kind < CLI_KIND_COUNT; kind++) {
        if (!render->paths[kind]) {
            continue;
        }
        cli_stage("writing", render->paths[kind]);
        struct cli_output_file *file = &render->files[render->file_count];
        written = cli_output_file_open(file, render->paths[kind]);
        if (!written) {
            break;
        }
        render->file_count++;
        written = (render->job.format == CLI_PICTURE_EXR
                       ? encode_exr(render, file)
                       : encode_raster(render, file, (enum cli_output_kind)kind)) &&
                  cli_output_file_finish(file);
    }
    cli_stage_end();
    for (int i = 0; i < render->file_count; i++) {
        if (written) {
            written = cli_output_file_commit(&render->files[i]);
        } else {
            cli_output_file_discard(&render->files[i]);
        }
    }
    render->times.encode_ms = now_ms() - start;
    return written;
}

static int run(struct render *render)
{
    const double start = now_ms();
    const struct cli_render_job *job = &render->job;
    if (job->isa != RHW_ISA_COUNT && !rhw_isa_supported(job->isa)) {
        cli_error("--isa", "this computer or this build has no %s", rhw_isa_name(job->isa));
        return CLI_FAILED;
    }
    cli_budget_apply(&job->budget);
    if (!plan_files(render) ||
        (job->environment && !cli_panorama_load(&render->panorama, job->environment)) ||
        !import_model(render)) {
        return CLI_FAILED;
    }
    if (!set_view(render)) {
        return CLI_USAGE;
    }
    if (!draw(render) || !write_files(render)) {
        return CLI_FAILED;
    }
    if (job->print_camera) {
        cli_camera_print(&render->view.camera);
    }
    render->times.total_ms = now_ms() - start;
    if (job->stats && !cli_render_report(job, render->model, &render->stats, &render->times)) {
        return CLI_FAILED;
    }
    return CLI_OK;
}

int cli_render(int argc, char **argv)
{
    struct render render = {0};
    int status;
    if (!cli_render_job_parse(&render.job, argc, argv, &status)) {
        return status;
    }
    status = CLI_FAILED;
    if (cli_model_input_open(&render.input, render.job.model_path)) {
        render.job.model_path = render.input.name;
        status = run(&render);
    }
    cli_model_input_close(&render.input);
    scene_pictures_free(&render.pictures);
    if (render.scene) {
        scene_destroy(render.scene);
    }
    rhw_context_destroy(render.context);
    if (render.model) {
        scene_model_free(render.model);
    }
    free(render.panorama.texels);
    for (int kind = 0; kind < CLI_KIND_COUNT; kind++) {
        free(render.paths[kind]);
    }
    return status;
}
