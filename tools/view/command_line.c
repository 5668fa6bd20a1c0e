// SPDX-License-Identifier: MIT
// See command_line.h. What is not said is as rhw render has it without being told; names are those of its options.
#include "command_line.h"

#include "growing.h"
#include "view_job.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// As one word of a shell.
static void put_word(FILE *out, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-+,:=@%";
    if (*word && strspn(word, plain) == strlen(word)) {
        fputs(word, out);
        return;
    }
    putc('\'', out);
    for (const char *c = word; *c; c++) {
        if (*c == '\'') {
            fputs("'\\''", out);
        } else {
            putc(*c, out);
        }
    }
    putc('\'', out);
}

static void put_option(FILE *out, const char *name, const char *argument)
{
    fprintf(out, " --%s ", name);
    put_word(out, argument);
}

// Which model, and as an animation has it when.
static void put_model(FILE *out, const struct cli_render_job *job)
{
    put_word(out, job->model_path);
    if (job->variant) {
        put_option(out, "variant", job->variant);
    }
    if (job->animation) {
        put_option(out, "animation", job->animation);
    }
    if (job->is_posed) {
        fprintf(out, " --time %.9g", job->time);
    }
    if (job->budget.texture != VIEW_TEXTURE_SIDE) {
        fprintf(out, " --max-texture %u", job->budget.texture);
    }
    if (job->budget.is_confined && job->budget.folder) {
        fputs(" --confine=", out);
        put_word(out, job->budget.folder);
    } else if (job->budget.is_confined) {
        fputs(" --confine", out);
    }
}

static void put_light(FILE *out, const struct cli_render_job *job)
{
    static const char *const tones[] = {"neutral", "aces", "agx", "none"};
    if (job->default_lights) {
        fprintf(out, " --lights %s", job->no_lights ? "none" : "default");
    }
    if (!job->shadows) {
        fputs(" --shadows off", out);
    }
    if (!job->ambient_occlusion) {
        fputs(" --ambient-occlusion off", out);
    }
    if (job->ground) {
        fputs(" --ground", out);
    }
    if (job->exposure != 0.0f) {
        fprintf(out, " --exposure %.9g", (double)job->exposure);
    }
    if (job->environment) {
        put_option(out, "environment", job->environment);
    }
    if (job->environment_rotation != 0.0f) {
        fprintf(out, " --environment-rotation %.9g", (double)job->environment_rotation);
    }
    if (job->tone != 0) {
        fprintf(out, " --tone-map %s", tones[job->tone]);
    }
}

static void put_look(FILE *out, const struct cli_render_job *job)
{
    const uint8_t *const color = job->background_color;
    switch (job->background) {
    case SCENE_BACKGROUND_DEFAULT: break;
    case SCENE_BACKGROUND_COLOR:
        fprintf(out, " --background %02x%02x%02x", color[0], color[1], color[2]);
        break;
    case SCENE_BACKGROUND_PANORAMA: fputs(" --background environment", out); break;
    case SCENE_BACKGROUND_TRANSPARENT: fputs(" --background transparent", out); break;
    }
    if (job->interpolate == RHW_NOPERSPECTIVE) {
        fputs(" --interpolate noperspective", out);
    }
    if (job->wireframe != SCENE_WIREFRAME_NONE) {
        fprintf(out, " --wireframe=%s", job->wireframe == SCENE_WIREFRAME_OVER ? "over" : "plain");
    }
    if (job->transparency == SCENE_TRANSPARENCY_EXACT) {
        fputs(" --transparency exact", out);
    }
    if (job->has_up) {
        fprintf(out, " --up %s", cli_axis_names[job->up]);
    }
}

char *view_command_line(const struct cli_render_job *job)
{
    struct system_growing line;
    if (!system_growing_open(&line)) {
        return NULL;
    }
    FILE *const out = line.stream;
    const enum scene_output_kind kind = (enum scene_output_kind)__builtin_ctz(job->kinds);
    fputs("rhw render ", out);
    put_model(out, job);
    fputs(job->orthographic ? " --ortho --camera " : " --camera ", out);
    const int digits = scene_camera_digits(job->look, job->look + 3);
    for (int i = 0; i < 10; i++) {
        fprintf(out, "%s%.*g", i > 0 ? "," : "", i < 6 ? digits : 9, job->look[i]);
    }
    fprintf(out, " --size %dx%d --samples %d", job->width, job->height, job->samples);
    if (job->supersample > 1) {
        fprintf(out, " --supersample %d", job->supersample);
    }
    if (kind != SCENE_KIND_COLOR) {
        fprintf(out, " --output %s", scene_outputs[kind].word);
    }
    if (job->bits) {
        fprintf(out, " --bits %d", job->bits);
    }
    put_light(out, job);
    put_look(out, job);
    fputs(" -o picture.png", out);
    return system_growing_close(&line) ? line.bytes : NULL;
}
