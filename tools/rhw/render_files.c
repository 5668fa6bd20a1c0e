// SPDX-License-Identifier: MIT
// The files of one model's pictures: their names, and how they come to be, all or none.
#include "output_file.h"
#include "render_state.h"
#include "thumb_mark.h"

#include "message.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { JPEG_QUALITY = 92 };

// OUT with the names of the model, the output, and of the view or the frame, which count from 0; −1: there is none.
static bool expand_out(struct render *render, int number, enum scene_output_kind kind)
{
    const struct cli_render_job *const job = &render->job;
    const char *const slash = strrchr(job->model_path, '/'), *const base =
                                                                 slash ? slash + 1 : job->model_path;
    const char *const dot = strrchr(base, '.');
    const int stem = dot && dot > base ? (int)(dot - base) : (int)strlen(base);
    size_t at = 0;
    for (const char *in = job->out; *in && at < sizeof render->out;) {
        const size_t room = sizeof render->out - at;
        if (job->is_literal) {
            render->out[at++] = *in++;
        } else if (strncmp(in, "{}", 2) == 0) {
            at += (size_t)snprintf(render->out + at, room, "%s", scene_outputs[kind].word);
            in += 2;
        } else if (strncmp(in, "{name}", 6) == 0) {
            at += (size_t)snprintf(render->out + at, room, "%.*s", stem, base);
            in += 6;
        } else if (number >= 0 && number < job->view_count && strncmp(in, "{view}", 6) == 0) {
            at += (size_t)snprintf(render->out + at, room, "%s", cli_view_name(job->views[number]));
            in += 6;
        } else if (number >= 0 && strncmp(in, "{frame}", 7) == 0) {
            at += (size_t)snprintf(render->out + at, room, "%04d", number);
            in += 7;
        } else {
            render->out[at++] = *in++;
        }
    }
    if (at >= sizeof render->out) {
        cli_error(job->out, "is longer than %zu bytes", sizeof render->out - 1);
        return false;
    }
    render->out[at] = '\0';
    return true;
}

// `out`, or with several outputs that with the output's name in it, where it has had no {} for that.
static char *make_path(const struct cli_render_job *job, const char *out, enum scene_output_kind kind)
{
    const char *name = scene_outputs[kind].word;
    const size_t size = strlen(out) + strlen(name) + 2;
    char *path = malloc(size);
    if (!path) {
        return NULL;
    }
    const bool several = (job->kinds & (job->kinds - 1)) != 0;
    if (job->format == CLI_PICTURE_EXR || !several || kind == SCENE_KIND_COLOR || cli_out_has(job, "{}")) {
        snprintf(path, size, "%s", out);
    } else {
        const char *base = strrchr(out, '/') ? strrchr(out, '/') : out;
        const char *dot = strrchr(base, '.');
        const int stem = dot ? (int)(dot - out) : (int)strlen(out);
        snprintf(path, size, "%.*s.%s%s", stem, out, name, dot ? dot : "");
    }
    return path;
}

void cli_render_files_forget(struct render *render)
{
    for (int kind = 0; kind < CLI_OUTPUT_KINDS; kind++) {
        free(render->paths[kind]);
        render->paths[kind] = NULL;
    }
    render->file_count = 0;
}

bool cli_render_files_plan(struct render *render, int number)
{
    const struct cli_render_job *job = &render->job;
    for (int kind = 0; kind < CLI_OUTPUT_KINDS; kind++) {
        if (!(job->kinds >> kind & 1)) {
            continue;
        }
        if (!expand_out(render, number, (enum scene_output_kind)kind)) {
            return false;
        }
        render->paths[kind] = make_path(job, render->out, (enum scene_output_kind)kind);
        if (!render->paths[kind]) {
            cli_error(render->out, "out of memory");
            return false;
        }
        if (!cli_output_file_check(render->paths[kind]) ||
            cli_model_input_is(&render->input, render->paths[kind])) {
            return false;
        }
        if (job->stats && cli_output_file_is_same(render->paths[kind], job->stats_path)) {
            cli_error("--stats", "%s is the picture's file; name another", job->stats_path);
            return false;
        }
        if (job->format == CLI_PICTURE_EXR) {
            break; // one file for all
        }
    }
    return !job->stats ||
           (cli_output_file_check(job->stats_path) && !cli_model_input_is(&render->input, job->stats_path));
}

bool cli_render_files_name(struct render *render, const char *path)
{
    const int kind = __builtin_ctz(render->job.kinds);
    render->paths[kind] = strdup(path);
    if (!render->paths[kind]) {
        cli_error(path, "out of memory");
        return false;
    }
    return cli_output_file_check(path) && !cli_model_input_is(&render->input, path);
}

static bool encode_exr(struct render *render, struct cli_output_file *file)
{
    struct cli_exr_channel channels[CLI_EXR_CHANNELS_MAX];
    float *positions;
    const int count = cli_outputs_exr_channels(&render->pictures, render->job.kinds, channels, &positions);
    struct cli_exr_about about;
    const double aspect = (double)render->view.width / render->view.height;
    if (count == 0 || !cli_outputs_exr_describe(render->model, &render->view.camera, aspect,
                                                render->pictures.origin, &about)) {
        free(positions);
        cli_error(file->path, "out of memory");
        return false;
    }
    const bool is_sheet = render->job.view_count > 0 && !cli_render_has_file_per_view(&render->job);
    about.has_camera = !is_sheet;
    const bool written = cli_exr_write(file, render->pictures.width, render->pictures.height, channels, count,
                                       &about, rhw_context_threads(render->context));
    free(about.objects);
    free(positions);
    return written;
}

void cli_render_rasterize(const struct render *render, enum scene_output_kind kind,
                          struct cli_output_raster *output)
{
    const struct cli_render_job *job = &render->job;
    const struct scene_model *const model = render->model;
    float low[3], high[3];
    for (int c = 0; c < 3; c++) {
        const double moved = model->origin[c] - render->pictures.origin[c];
        low[c] = (float)((double)model->bounds_min[c] + moved);
        high[c] = (float)((double)model->bounds_max[c] + moved);
    }
    cli_output_rasterize(output, &render->pictures, kind, job->bits,
                         job->background == SCENE_BACKGROUND_TRANSPARENT, low, high);
}

static bool encode_raster(struct render *render, struct cli_output_file *file, enum scene_output_kind kind)
{
    const struct cli_render_job *job = &render->job;
    struct cli_output_raster output;
    cli_render_rasterize(render, kind, &output);
    const struct cli_raster_text mark = {.keyword = CLI_THUMB_MARK_KEYWORD, .text = job->thumb_mark};
    output.raster.texts = &mark;
    output.raster.text_count = job->thumb_mark != NULL;
    switch (job->format) {
    case CLI_PICTURE_PNG: return cli_png_write(file, &output.raster);
    case CLI_PICTURE_JPEG:
        return cli_jpeg_write(file, &output.raster, job->quality ? job->quality : JPEG_QUALITY);
    case CLI_PICTURE_WEBP: return cli_webp_write(file, &output.raster, job->quality);
    default: return cli_ppm_write(file, &output.raster);
    }
}

// All files are complete before the first gets its name, so that a full disk leaves none of them.
bool cli_render_files_write(struct render *render)
{
    const double start = cli_milliseconds();
    bool written = true;
    for (int kind = 0; written && kind < CLI_OUTPUT_KINDS; kind++) {
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
                       : encode_raster(render, file, (enum scene_output_kind)kind)) &&
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
    render->times.encode_ms = cli_milliseconds() - start;
    return written;
}

bool cli_render_has_file_per_view(const struct cli_render_job *job)
{
    return cli_out_has(job, "{view}");
}

bool cli_render_files_check(struct render *render)
{
    const int files = cli_render_has_file_per_view(&render->job) ? render->job.view_count : 1;
    bool planned = true;
    for (int i = 0; i < files && planned; i++) {
        cli_render_files_forget(render);
        const bool has_number = cli_render_has_file_per_view(&render->job) || cli_render_moves(&render->job);
        planned = cli_render_files_plan(render, has_number ? i : -1);
    }
    return planned;
}
