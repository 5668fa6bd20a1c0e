// SPDX-License-Identifier: MIT
// rhw under measurement, with translated shaders in place of those in C: the renderer of renderer_rhw.c, and programs that
// are made of SPIR-V the first time a scene asks for them.
#include "renderer.h"

#include "renderer_rhw.h"
#include "shaders_words.h"

#include <stdio.h>
#include <stdlib.h>

struct programs {
    rhw_shader_program *made[BENCH_SHADERS];
    struct bench_renderer *renderer;
    void (*close)(struct bench_renderer *renderer);
};

// All programs have the same sets, so that draws of any shader fill them alike.
static rhw_shader_program *link_stages(const rhw_shader *vertex, const rhw_shader *fragment, char *message)
{
    struct rhw_shader_layout layout[2 + BENCH_DRAW_TEXTURES];
    rhw_shader_program *program = NULL;
    for (uint32_t i = 0; i < 2 + BENCH_DRAW_TEXTURES; i++) {
        layout[i] = (struct rhw_shader_layout){.set = i >= 2, .binding = i >= 2 ? i - 2 : i, .count = 1};
    }
    const struct rhw_shader_program_def def = {
        .vertex = vertex, .fragment = fragment, .layout = layout, .layout_count = 2 + BENCH_DRAW_TEXTURES};
    (void)rhw_shader_program_create(&def, &program, message);
    return program;
}

static rhw_shader *translate(const struct bench_words *words, enum rhw_shader_stage stage, char *message)
{
    const struct rhw_shader_def def = {.stage = stage};
    rhw_shader *shader;
    (void)rhw_shader_create(words->words, words->size, &def, &shader, message);
    return shader;
}

static const struct rhw_program *translated(void *user, enum bench_shader shader)
{
    struct programs *const programs = user;
    struct bench_words words[2];
    char message[RHW_SHADER_MESSAGE] = "";
    if (!programs->made[shader]) {
        bench_shader_words(shader, &words[0], &words[1]);
        rhw_shader *const vertex = translate(&words[0], RHW_SHADER_VERTEX, message);
        rhw_shader *const fragment = vertex ? translate(&words[1], RHW_SHADER_FRAGMENT, message) : NULL;
        programs->made[shader] = fragment ? link_stages(vertex, fragment, message) : NULL;
        rhw_shader_destroy(vertex);
        rhw_shader_destroy(fragment);
    }
    if (!programs->made[shader]) {
        snprintf(programs->renderer->why, sizeof programs->renderer->why, "%s", message);
        return NULL;
    }
    return rhw_shader_program_get(programs->made[shader]);
}

static void close_translated(struct bench_renderer *renderer)
{
    struct programs *const programs = ((struct bench_state *)renderer->state)->programs;
    programs->close(renderer);
    for (int i = 0; i < BENCH_SHADERS; i++) {
        rhw_shader_program_destroy(programs->made[i]);
    }
    free(programs);
}

bool bench_open_translated(struct bench_renderer *renderer, int threads, enum rhw_isa isa, const char **why)
{
    struct bench_words vertex, fragment;
    bench_shader_words(BENCH_SHADER_FLAT, &vertex, &fragment);
    if (vertex.size == 0) {
        *why = "this program was built without glslangValidator";
        return false;
    }
    struct programs *const programs = calloc(1, sizeof *programs);
    if (!programs || !bench_open_rhw(renderer, threads, isa, why)) {
        *why = programs ? *why : "out of memory";
        free(programs);
        return false;
    }
    struct bench_state *const state = renderer->state;
    *programs = (struct programs){.renderer = renderer, .close = renderer->close};
    state->translated = translated;
    state->programs = programs;
    renderer->close = close_translated;
    snprintf(renderer->name, sizeof renderer->name, "interpreter of rhw %s, %d thread%s", rhw_version(),
             renderer->threads, renderer->threads == 1 ? "" : "s");
    return true;
}
