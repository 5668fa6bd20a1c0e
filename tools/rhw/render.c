// SPDX-License-Identifier: MIT
// rhw render: model file in, picture files out. This file is the order of things; what the command line
// means stands in render_options.c, what becomes of an output in outputs.c.
#include "fragment_shader.h"
#include "options.h"
#include "render_camera.h"
#include "render_state.h"
#include "verbs.h"

#include <stdlib.h>
#include <time.h>

double cli_milliseconds(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec * 1e3 + (double)time.tv_nsec * 1e-6;
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
                                                          .progress = render->progress,
                                                          .goes_on = render->goes_on,
                                                          .user = render->user});
    render->times.import_ms = cli_milliseconds() - start;
    if (!render->model) {
        return false;
    }
    return cli_render_accept(render);
}

// A file for each view.
static int draw_views(struct render *render)
{
    struct cli_render_job *const job = &render->job;
    int status = CLI_OK;
    for (int i = 0; i < job->view_count && status == CLI_OK; i++) {
        cli_render_files_forget(render);
        job->orbit = cli_view_orbit(job->views[i]);
        const bool drawn = cli_render_files_plan(render, i) && cli_render_set_view(render) &&
                           cli_render_draw_seen(render) && cli_render_files_write(render);
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
        status = cli_render_set_view(render) && cli_render_draw_seen(render) ? CLI_OK : CLI_FAILED;
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

bool cli_render_take_input(struct render *render, const char *path)
{
    render->job.model_path = path;
    const bool opened = cli_model_input_open(&render->input, path, render->goes_on, render->user);
    render->job.model_path = render->input.name;
    return opened;
}

int cli_render_read(struct render *render)
{
    return !import_model(render) ? CLI_FAILED : cli_render_set_view(render) ? CLI_OK : CLI_USAGE;
}

int cli_render_open(struct render *render, const char *path)
{
    return cli_render_take_input(render, path) ? cli_render_read(render) : CLI_FAILED;
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
    const int status = cli_render_has_file_per_view(job)                                ? draw_views(render)
                       : job->view_count > 0                                            ? draw_sheet(render)
                       : cli_render_draw_seen(render) && cli_render_files_write(render) ? CLI_OK
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
    const int status = cli_render_take_input(render, path) ? run(render) : CLI_FAILED;
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
    if (job->fragment_shader) {
        render->shader = cli_fragment_shader_open(job->fragment_shader);
        render->program = render->shader ? rhw_shader_program_get(render->shader) : NULL;
        if (!render->program) {
            return false;
        }
    }
    return !job->environment || cli_panorama_load(&render->panorama, job->environment);
}

void cli_render_release(struct render *render)
{
    rhw_shader_program_destroy(render->shader);
    free(render->panorama.texels);
}

int cli_render(int argc, char **argv)
{
    struct render render = {0};
    int status;
    if (!cli_render_job_parse(&render.job, NULL, argc, argv, &status)) {
        if (render.job.wants_template && status == CLI_OK) {
            fputs(cli_fragment_shader_template, stdout);
        }
        return status;
    }
    render.job.offers_time = !render.job.thumb_mark;
    if (!cli_render_prepare(&render)) {
        cli_render_release(&render);
        return CLI_FAILED;
    }
    status = CLI_OK;
    for (int i = 0; i < render.job.model_count && status != CLI_USAGE; i++) {
        const int each = render_model(&render, render.job.model_paths[i]); // a failure keeps no other from it
        status = each == CLI_OK ? status : each;
    }
    cli_render_release(&render);
    return status;
}
