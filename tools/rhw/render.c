// SPDX-License-Identifier: MIT
// rhw render: model file in, picture files out. This file is the order of things; what the command line
// means stands in render_options.c, what becomes of an output in outputs.c.
#include "options.h"
#include "output_file.h"
#include "render_job.h"
#include "verbs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WARNINGS_SHOWN = 8 };

static const double degree = 3.14159265358979323846 / 180.0;

struct render {
    struct rhw_render_job job;
    struct rhw_model *model;
    rhw_context *context;
    struct rhw_scene *scene;
    struct rhw_view view;
    struct rhw_pictures pictures;
    struct rhw_draw_stats stats;
    struct rhw_render_times times;
    char *paths[RHW_KIND_COUNT]; // NULL: not written
    struct rhw_output_file files[RHW_KIND_COUNT];
    int file_count; // open ones
};

static double now_ms(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
}

// OUT, or with several outputs OUT with the output's name in it.
static char *make_path(const struct rhw_render_job *job, enum rhw_output_kind kind)
{
    const char *name = rhw_output_name(kind), *out = job->out;
    const size_t size = strlen(out) + strlen(name) + 2;
    char *path = malloc(size);
    if (!path) {
        return NULL;
    }
    const char *place = strstr(out, "{}");
    const bool several = (job->kinds & (job->kinds - 1)) != 0;
    if (job->format != RHW_PICTURE_EXR && place) {
        snprintf(path, size, "%.*s%s%s", (int)(place - out), out, name, place + 2);
    } else if (job->format == RHW_PICTURE_EXR || !several || kind == RHW_KIND_COLOR) {
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
    const struct rhw_render_job *job = &render->job;
    for (int kind = 0; kind < RHW_KIND_COUNT; kind++) {
        if (!(job->kinds >> kind & 1)) {
            continue;
        }
        render->paths[kind] = make_path(job, (enum rhw_output_kind)kind);
        if (!render->paths[kind]) {
            rhw_tool_error(job->out, "out of memory");
            return false;
        }
        if (!rhw_output_file_check(render->paths[kind])) {
            return false;
        }
        if (job->format == RHW_PICTURE_EXR) {
            break; // one file for all
        }
    }
    return !job->stats || rhw_output_file_check(job->stats_path);
}

static bool import_model(struct render *render)
{
    const struct rhw_render_job *job = &render->job;
    char error[512];
    const double start = now_ms();
    rhw_tool_stage("reading", job->model_path);
    render->model = rhw_model_load(job->model_path, NULL, error, sizeof error);
    rhw_tool_stage_end();
    render->times.import_ms = now_ms() - start;
    if (!render->model) {
        rhw_tool_error(job->model_path, "%s", error);
        return false;
    }
    const uint32_t count = job->quiet ? 0 : render->model->warning_count;
    for (uint32_t i = 0; i < count && i < WARNINGS_SHOWN; i++) {
        rhw_tool_warning(job->model_path, "%s", render->model->warnings[i]);
    }
    if (count > WARNINGS_SHOWN) {
        rhw_tool_warning(job->model_path, "%u more warnings; rhw info prints them all",
                         count - WARNINGS_SHOWN);
    }
    if (!(render->model->bounds_min[0] <= render->model->bounds_max[0])) {
        rhw_tool_error(job->model_path, "the file has nothing to draw");
        return false;
    }
    return true;
}

// The camera the job names in the file, or NULL when there is none.
static const struct rhw_model_camera *find_camera(const struct rhw_render_job *job,
                                                  const struct rhw_model *model)
{
    if (job->camera == RHW_CAMERA_AUTO) {
        return model->camera_count && job->fovy == 0.0f ? &model->cameras[0] : NULL;
    }
    for (uint32_t i = 0; i < model->camera_count; i++) {
        const bool wanted = job->camera == RHW_CAMERA_INDEX
                                ? i == (uint32_t)job->camera_index
                                : strcmp(model->cameras[i].name, job->camera_name) == 0;
        if (wanted) {
            return &model->cameras[i];
        }
    }
    return NULL;
}

static bool report_missing_camera(const struct rhw_render_job *job, const struct rhw_model *model)
{
    if (model->camera_count == 0) {
        rhw_tool_error(job->camera_option, "%s has no cameras", job->model_path);
    } else if (job->camera == RHW_CAMERA_INDEX) {
        rhw_tool_error(job->camera_option, "%s has the cameras 0..%u only", job->model_path,
                       model->camera_count - 1);
    } else {
        rhw_tool_error(job->camera_option, "%s has no camera named '%s'", job->model_path, job->camera_name);
    }
    return false;
}

static bool look_from_numbers(const struct render *render, struct rhw_camera *camera)
{
    double vectors[3][3];
    char error[256];
    for (int i = 0; i < 9; i++) {
        vectors[i / 3][i % 3] = (double)render->job.look[i];
    }
    const double yfov = (double)render->job.look[9] * degree;
    if (rhw_camera_look(camera, render->model, vectors[0], vectors[1], vectors[2], yfov, error,
                        sizeof error)) {
        return true;
    }
    rhw_tool_error("--camera", "%s", error);
    return false;
}

static struct rhw_camera fit_camera(const struct render *render)
{
    const struct rhw_render_job *job = &render->job;
    const struct rhw_orbit orbit =
        job->camera == RHW_CAMERA_ORBIT ? job->orbit : rhw_camera_default_orbit(render->model);
    const double yfov = job->fovy > 0.0f ? (double)job->fovy * degree : rhw_camera_default_yfov();
    return rhw_camera_fit(render->model, orbit, yfov, (double)job->width / (double)job->height);
}

static bool choose_camera(const struct render *render, struct rhw_camera *camera)
{
    const struct rhw_render_job *job = &render->job;
    if (job->camera == RHW_CAMERA_LOOK) {
        return look_from_numbers(render, camera);
    }
    const bool fitted = job->camera == RHW_CAMERA_FIT || job->camera == RHW_CAMERA_ORBIT;
    const struct rhw_model_camera *found = fitted ? NULL : find_camera(job, render->model);
    if (!fitted && !found && job->camera != RHW_CAMERA_AUTO) {
        return report_missing_camera(job, render->model);
    }
    *camera =
        found ? rhw_camera_from_model(found, (double)job->width / (double)job->height) : fit_camera(render);
    return true;
}

// False: the command line asks for a view that cannot be.
static bool set_view(struct render *render)
{
    const struct rhw_render_job *job = &render->job;
    struct rhw_view *view = &render->view;
    char error[256];
    *view = rhw_view_default(render->model);
    view->width = job->width;
    view->height = job->height;
    view->samples = job->samples;
    view->interpolate = job->interpolate;
    view->wireframe = job->wireframe;
    view->background = job->background;
    memcpy(view->background_color, job->background_color, sizeof view->background_color);
    view->default_lights = job->default_lights;
    view->exposure = (double)job->exposure;
    view->outputs = rhw_outputs_needed(job->kinds, job->format, job->bits);
    if (!choose_camera(render, &view->camera)) {
        return false;
    }
    if (rhw_view_check(view, error, sizeof error)) {
        return true;
    }
    rhw_tool_error("render", "%s", error);
    return false;
}

static void log_line(void *user, enum rhw_log_level level, const char *message)
{
    const struct rhw_render_job *job = user;
    if (level == RHW_LOG_WARNING && !job->quiet) {
        rhw_tool_warning(job->model_path, "%s", message);
    }
}

// Nothing was seen. Who asked for that view gets it, with a warning; but a camera that merely stands in the
// file, as many exporters leave one, is no reason for an empty picture.
static enum rhw_result draw_again(struct render *render)
{
    const struct rhw_render_job *job = &render->job;
    const bool refit = job->camera == RHW_CAMERA_AUTO && find_camera(job, render->model);
    if (!job->quiet) {
        rhw_tool_warning(job->model_path,
                         refit ? "its camera sees nothing of the model, which is fitted instead"
                               : "nothing of the model is in the picture");
    }
    if (!refit) {
        return RHW_OK;
    }
    render->view.camera = fit_camera(render);
    rhw_pictures_free(&render->pictures);
    return rhw_scene_draw(render->scene, &render->view, &render->pictures, &render->stats);
}

static bool draw(struct render *render)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = render->job.threads;
    def.isa = render->job.isa;
    def.log = log_line;
    def.user = &render->job;
    rhw_tool_stage("drawing", render->job.model_path);
    enum rhw_result result = rhw_context_create(&def, &render->context);
    if (result == RHW_OK) {
        result = rhw_scene_create(render->context, render->model, &render->scene);
    }
    if (result == RHW_OK) {
        result = rhw_scene_draw(render->scene, &render->view, &render->pictures, &render->stats);
    }
    if (result == RHW_OK && render->stats.pipeline.triangles_rasterized == 0) {
        result = draw_again(render);
    }
    rhw_tool_stage_end();
    if (result != RHW_OK) {
        rhw_tool_error(render->job.model_path, "%s", rhw_result_string(result));
    }
    return result == RHW_OK;
}

static bool encode_exr(struct render *render, struct rhw_output_file *file)
{
    struct rhw_exr_channel channels[RHW_EXR_CHANNELS_MAX];
    const int count = rhw_outputs_exr_channels(&render->pictures, render->job.kinds, channels);
    return rhw_exr_write(file, render->pictures.width, render->pictures.height, channels, count,
                         rhw_context_threads(render->context));
}

static bool encode_raster(struct render *render, struct rhw_output_file *file, enum rhw_output_kind kind)
{
    const struct rhw_render_job *job = &render->job;
    struct rhw_output_raster output;
    rhw_output_rasterize(&output, &render->pictures, kind, job->bits,
                         job->background == RHW_BACKGROUND_TRANSPARENT, render->model->bounds_min,
                         render->model->bounds_max);
    return job->format == RHW_PICTURE_PNG ? rhw_png_write(file, &output.raster)
                                          : rhw_ppm_write(file, &output.raster);
}

// All files are complete before the first gets its name, so that a full disk leaves none of them.
static bool write_files(struct render *render)
{
    const double start = now_ms();
    bool written = true;
    for (int kind = 0; written && kind < RHW_KIND_COUNT; kind++) {
        if (!render->paths[kind]) {
            continue;
        }
        rhw_tool_stage("writing", render->paths[kind]);
        struct rhw_output_file *file = &render->files[render->file_count];
        written = rhw_output_file_open(file, render->paths[kind]);
        if (!written) {
            break;
        }
        render->file_count++;
        written = (render->job.format == RHW_PICTURE_EXR
                       ? encode_exr(render, file)
                       : encode_raster(render, file, (enum rhw_output_kind)kind)) &&
                  rhw_output_file_finish(file);
    }
    rhw_tool_stage_end();
    for (int i = 0; i < render->file_count; i++) {
        if (written) {
            written = rhw_output_file_commit(&render->files[i]);
        } else {
            rhw_output_file_discard(&render->files[i]);
        }
    }
    render->times.encode_ms = now_ms() - start;
    return written;
}

static int run(struct render *render)
{
    const double start = now_ms();
    const struct rhw_render_job *job = &render->job;
    if (job->isa != RHW_ISA_COUNT && !rhw_isa_supported(job->isa)) {
        rhw_tool_error("--isa", "this computer or this build has no %s", rhw_isa_name(job->isa));
        return RHW_TOOL_FAILED;
    }
    if (!plan_files(render) || !import_model(render)) {
        return RHW_TOOL_FAILED;
    }
    if (!set_view(render)) {
        return RHW_TOOL_USAGE;
    }
    if (!draw(render) || !write_files(render)) {
        return RHW_TOOL_FAILED;
    }
    render->times.total_ms = now_ms() - start;
    if (job->stats && !rhw_render_report(job, render->model, &render->stats, &render->times)) {
        return RHW_TOOL_FAILED;
    }
    return RHW_TOOL_OK;
}

int rhw_tool_render(int argc, char **argv)
{
    struct render render = {0};
    int status;
    if (!rhw_render_job_parse(&render.job, argc, argv, &status)) {
        return status;
    }
    status = run(&render);
    rhw_pictures_free(&render.pictures);
    if (render.scene) {
        rhw_scene_destroy(render.scene);
    }
    rhw_context_destroy(render.context);
    if (render.model) {
        rhw_model_free(render.model);
    }
    for (int kind = 0; kind < RHW_KIND_COUNT; kind++) {
        free(render.paths[kind]);
    }
    return status;
}
