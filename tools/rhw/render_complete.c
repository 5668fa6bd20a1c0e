// SPDX-License-Identifier: MIT
// What the options of rhw render mean together: what follows from those that were given, and which exclude each other.
#include "folder.h"
#include "render_job.h"

#include "options.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

bool cli_out_has(const struct cli_render_job *job, const char *word)
{
    return !job->is_literal && strstr(job->out, word);
}

// An argument that stands apart from its option, where that does not have to have one, is taken for a model; a picture
// to write, without its -o, too.
static bool check_models(const struct cli_render_job *job)
{
    static const char *const arguments[] = {"all", "subject", "over", "plain"};
    for (int i = 0; i < job->model_count && !job->out; i++) {
        if (cli_picture_format_of(job->model_paths[i]) != CLI_PICTURE_UNKNOWN) {
            cli_error(job->model_paths[i],
                      "is no model but a picture, by its name; a picture to write is named by -o");
            return false;
        }
    }
    const bool is_many = job->model_count > 1;
    for (int i = 0; i < job->model_count && is_many; i++) {
        const int found = cli_parse_name(job->model_paths[i], arguments, 4);
        if (found >= 0 && access(job->model_paths[i], F_OK) != 0) {
            cli_error(job->model_paths[i], "is no model; it belongs to %s=%s, with the sign between them",
                      found < 2 ? "--fit" : "--wireframe", arguments[found]);
            return false;
        }
        // What was meant for one model more likely than as another.
        if (!(job->out && cli_out_has(job, "{name}")) && strcmp(job->model_paths[i], "-") != 0 &&
            access(job->model_paths[i], F_OK) != 0) {
            cli_error(job->model_paths[i],
                      "stands behind no option, so it is a model, and there is no such file");
            return false;
        }
    }
    return true;
}

// MODEL's name with another ending; never over a file that is there, which may be a texture.
static bool choose_out(struct cli_render_job *job)
{
    if (job->out) {
        return true;
    }
    if (job->model_count > 1) {
        cli_error("render", "-o OUT is missing: several models need one with a {name} in it");
        return false;
    }
    static const char *const endings[] = {"png", "exr", "ppm", "jpg", "webp"};
    const char *slash = strrchr(job->model_path, '/'), *name = slash ? slash + 1 : job->model_path;
    const char *dot = strrchr(name, '.');
    const int length = dot && dot > name ? (int)(dot - name) : (int)strlen(name);
    if (length == 0 && !slash) {
        cli_error(job->model_path, "a model needs a name");
        return false;
    }
    if (length == 0) {
        cli_error(job->model_path,
                  "is named as a folder, and a model is wanted; rhw thumbs draws all models in a folder");
        return false;
    }
    const char *ending = endings[job->format == CLI_PICTURE_UNKNOWN ? CLI_PICTURE_PNG : job->format];
    snprintf(job->own_out, sizeof job->own_out, "%.*s.%s", length, name, ending);
    if (strcmp(job->model_path, "-") == 0 || length >= (int)sizeof job->own_out - 6) {
        cli_error("render", "-o OUT is missing: where should the picture go?");
        return false;
    }
    if (access(job->own_out, F_OK) == 0) {
        cli_error(job->own_out, "is there already; name the picture by -o OUT");
        return false;
    }
    job->out = job->own_out;
    job->is_literal = true;
    return true;
}

// A word in braces would be a part of the file's name.
static bool check_placeholders(const struct cli_render_job *job)
{
    static const char *const known[] = {"{name}", "{view}", "{frame}"};
    static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ",
                      others[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_:";
    for (const char *in = job->is_literal ? NULL : strchr(job->out, '{'); in; in = strchr(in + 1, '{')) {
        const size_t length = strspn(in + 1, others);
        if (strspn(in + 1, letters) == 0 || in[length + 1] != '}') {
            continue;
        }
        bool is_known = false;
        for (size_t i = 0; i < sizeof known / sizeof *known && !is_known; i++) {
            is_known = strlen(known[i]) == length + 2 && strncmp(known[i], in, length + 2) == 0;
        }
        if (!is_known) {
            cli_error(job->out,
                      "%.*s stands for nothing; there are {name}, {view}, {frame} and {}; --literal takes it "
                      "as it is",
                      (int)length + 2, in);
            return false;
        }
    }
    return true;
}

static bool check_exr(const struct cli_render_job *job)
{
    if (cli_out_has(job, "{}")) {
        cli_error(job->out,
                  "{} stands for an output's name, and an EXR file holds all outputs: leave it out, or "
                  "--literal takes it as it is");
        return false;
    }
    if (job->bits) {
        cli_error("--bits", "an EXR file always holds 32 bits per sample");
        return false;
    }
    return true;
}

static bool check_format(struct cli_render_job *job)
{
    const bool to_stdout = strcmp(job->out, "-") == 0;
    if (job->format == CLI_PICTURE_UNKNOWN) {
        job->format = to_stdout ? CLI_PICTURE_PNG : cli_picture_format_of(job->out);
    }
    if (job->format == CLI_PICTURE_UNKNOWN && cli_is_folder(job->out)) {
        return false;
    }
    if (job->format == CLI_PICTURE_UNKNOWN) {
        cli_error(job->out, "no format for this ending; name it %s, or give --format",
                  cli_render_moves(job) && !cli_out_has(job, "{frame}")
                      ? ".png or .webp, or .jpg, .exr or .ppm with a {frame}"
                      : ".png, .jpg, .webp, .exr or .ppm");
        return false;
    }
    if (to_stdout && job->stats && strcmp(job->stats_path, "-") == 0) {
        cli_error("--stats", "standard output takes the picture already; give --stats=FILE");
        return false;
    }
    if (to_stdout && job->format != CLI_PICTURE_EXR && (job->kinds & (job->kinds - 1))) {
        cli_error("--output", "standard output takes one output only");
        return false;
    }
    const bool jpeg = job->format == CLI_PICTURE_JPEG, webp = job->format == CLI_PICTURE_WEBP;
    if (job->background == SCENE_BACKGROUND_TRANSPARENT && (jpeg || job->format == CLI_PICTURE_PPM)) {
        cli_error("--background", "a %s file cannot be transparent", jpeg ? "JPEG" : "PPM");
        return false;
    }
    if (job->bits == 16 && (jpeg || webp)) {
        cli_error("--bits", "a %s file always holds 8 bits per sample", jpeg ? "JPEG" : "WebP");
        return false;
    }
    if (jpeg || webp) {
        job->bits = 8;
    }
    if (job->quality && !jpeg && !webp) {
        cli_error("--quality", "is for JPEG and WebP files");
        return false;
    }
    if (webp && (job->width > 16383 || job->height > 16383)) {
        cli_error("--size", "a WebP file has at most 16383 pixels each way");
        return false;
    }
    return job->format != CLI_PICTURE_EXR || check_exr(job);
}

static bool check_camera(struct cli_render_job *job)
{
    const int side = job->supersample == 16 ? 4 : job->supersample == 9 ? 3 : job->supersample == 4 ? 2 : 1;
    if (job->width * side > RHW_MAX_TARGET_SIZE || job->height * side > RHW_MAX_TARGET_SIZE) {
        cli_error("--supersample", "%d are too many for %dx%d: %d times each must not exceed %d",
                  job->supersample, job->width, job->height, side, RHW_MAX_TARGET_SIZE);
        return false;
    }
    const bool fitted = job->camera <= CLI_CAMERA_VIEWS;
    const bool is_look = job->camera == CLI_CAMERA_LOOK;
    const char *const fit_option = job->orthographic && !is_look ? "--ortho"
                                   : job->margin >= 0.0          ? "--margin"
                                   : job->zoom != 1.0            ? "--zoom"
                                                                 : NULL;
    if (fit_option && !fitted) {
        cli_error(fit_option, "cannot be together with %s", job->camera_option);
        return false;
    }
    if (fit_option && job->camera == CLI_CAMERA_AUTO) {
        job->camera = CLI_CAMERA_FIT;
        job->camera_option = fit_option;
    }
    if (job->orthographic && job->fovy > 0.0f) {
        cli_error("--ortho", "cannot be together with --fovy");
        return false;
    }
    if (job->print_camera && strcmp(job->out, "-") == 0) {
        cli_error("--print-camera", "standard output takes the picture already");
        return false;
    }
    if (job->fovy > 0.0f && !fitted) {
        cli_error("--fovy", "cannot be together with %s", job->camera_option);
        return false;
    }
    return true;
}

static bool check_sheet(const struct cli_render_job *job)
{
    int columns, rows;
    cli_sheet_grid(job->view_count, &columns, &rows);
    const int most = job->format == CLI_PICTURE_WEBP ? 16383 : RHW_MAX_TARGET_SIZE;
    if (job->width <= most / columns && job->height <= most / rows) {
        return true;
    }
    cli_error("--views", "a sheet of %dx%d pictures of %dx%d is larger than %d each way; use --size", columns,
              rows, job->width, job->height, most);
    return false;
}

static int name_length(const char *path, const char **name)
{
    const char *const slash = strrchr(path, '/');
    *name = slash ? slash + 1 : path;
    const char *const dot = strrchr(*name, '.');
    return dot && dot > *name ? (int)(dot - *name) : (int)strlen(*name);
}

// Whether each of several models has a name of its own.
static bool check_names(const struct cli_render_job *job)
{
    for (int i = 0; i < job->model_count; i++) {
        const char *name, *other;
        const int length = name_length(job->model_paths[i], &name);
        if (strcmp(job->model_paths[i], "-") == 0) {
            cli_error("render", "standard input cannot be one of several models");
            return false;
        }
        for (int k = 0; k < i; k++) {
            if (name_length(job->model_paths[k], &other) == length &&
                strncmp(name, other, (size_t)length) == 0) {
                cli_error(job->model_paths[i], "has the name of %s, and would have its picture",
                          job->model_paths[k]);
                return false;
            }
        }
    }
    return true;
}

// Several models or views: what one file or standard output cannot take.
static bool check_several(const struct cli_render_job *job)
{
    const bool has_name = cli_out_has(job, "{name}"), has_view = cli_out_has(job, "{view}");
    if (job->model_count > 1 && job->is_literal) {
        cli_error("--literal",
                  "is for one model: several need an OUT in which {name} stands for each one's name");
        return false;
    }
    if (job->model_count > 1 && !has_name) {
        cli_error(job->out, "several models need a {name} in OUT, which stands for each one's name");
        return false;
    }
    if (has_view && job->view_count == 0) {
        cli_error(job->out, "{view} needs --views");
        return false;
    }
    if (job->model_count > 1 && !check_names(job)) {
        return false;
    }
    if (job->model_count > 1 && (job->stats || job->print_camera)) {
        cli_error(job->stats ? "--stats" : "--print-camera", "is for one model");
        return false;
    }
    if (job->view_count > 0 && (job->stats || job->print_camera)) {
        cli_error(job->stats ? "--stats" : "--print-camera", "cannot be together with --views");
        return false;
    }
    return job->view_count == 0 || has_view || check_sheet(job);
}

// Pictures that follow one another.
static bool check_movement(const struct cli_render_job *job)
{
    const bool moves = cli_render_moves(job), is_sequence = cli_out_has(job, "{frame}");
    const char *const option = job->turntable > 0 ? "--turntable" : "--animate";
    const char *const other = job->view_count > 0                ? "--views"
                              : job->stats                       ? "--stats"
                              : job->print_camera                ? "--print-camera"
                              : job->rate > 0.0 && job->has_time ? "--time"
                                                                 : NULL;
    if (is_sequence && !moves) {
        cli_error(job->out, "{frame} needs --animate or --turntable");
        return false;
    }
    if (moves && other) {
        cli_error(option, "cannot be together with %s", other);
        return false;
    }
    if (moves && job->is_literal && job->format != CLI_PICTURE_PNG && job->format != CLI_PICTURE_WEBP) {
        cli_error(
            job->out,
            "only .png and .webp hold pictures that move; without --literal a {frame} gives each a file");
        return false;
    }
    if (moves && !is_sequence && job->format != CLI_PICTURE_PNG && job->format != CLI_PICTURE_WEBP) {
        cli_error(job->out, "only .png and .webp hold pictures that move; with a {frame} each gets a file");
        return false;
    }
    if (moves && !is_sequence && (job->kinds & (job->kinds - 1))) {
        cli_error("--output", "a file that moves has one output; with a {frame} in OUT there can be several");
        return false;
    }
    return true;
}

// Only of a fitted model, or one seen by its own camera, is it known that no part fills the picture many times.
static void choose_texture_side(struct cli_render_job *job)
{
    const int side = job->width > job->height ? job->width : job->height;
    const int across = job->supersample == 16 ? 4 : job->supersample == 9 ? 3 : job->supersample == 4 ? 2 : 1;
    if (job->budget.texture == 0 && job->camera <= CLI_CAMERA_VIEWS && job->zoom <= 1.0) {
        job->budget.texture = cli_budget_texture_side(side * across);
    }
}

bool cli_render_job_complete(struct cli_render_job *job)
{
    if (job->background == SCENE_BACKGROUND_PANORAMA && !job->environment) {
        cli_error("--background", "environment needs --environment FILE");
        return false;
    }
    if (!check_models(job) || !choose_out(job) || !check_placeholders(job) || !check_format(job) ||
        !check_camera(job) || !check_several(job) || !check_movement(job)) {
        return false;
    }
    choose_texture_side(job);
    return true;
}
