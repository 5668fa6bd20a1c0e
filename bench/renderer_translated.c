// SPDX-License-Identifier: MIT
// rhw under measurement, with shaders that are translated from GLSL in place of those in C: the renderer of
// renderer_rhw.c with other programs. Those of the interpreter and of machine code are made the first time a scene asks for them; emitted C is a
// part of this program.
#include "renderer.h"

#include "measure.h"
#include "renderer_rhw.h"
#include "shaders_emitted.h"
#include "shaders_link.h"
#include "shaders_words.h"

#include <stdio.h>
#include <stdlib.h>

struct programs {
    rhw_shader_program *made[BENCH_SHADERS];
    bool are_interpreted;
    struct bench_renderer *renderer;
    void (*close)(struct bench_renderer *renderer);
};

static const struct rhw_program *linked(void *user, enum bench_shader shader)
{
    struct programs *const programs = user;
    struct bench_renderer *const renderer = programs->renderer;
    char message[RHW_SHADER_MESSAGE] = "";
    const double start = bench_now_ms();
    if (!programs->made[shader]) {
        programs->made[shader] = bench_link_shader(shader, programs->are_interpreted, message);
        renderer->shaders_ms += bench_now_ms() - start;
    }
    if (!programs->made[shader]) {
        snprintf(renderer->why, sizeof renderer->why, "%s", message);
        return NULL;
    }
    return rhw_shader_program_get(programs->made[shader]);
}

static const struct rhw_program *emitted(void *user, enum bench_shader shader)
{
    struct programs *const programs = user;
    const struct rhw_program *const program = bench_emitted_program(shader);
    if (!program) {
        snprintf(programs->renderer->why, sizeof programs->renderer->why,
                 "a shader of it is not written as C");
    }
    return program;
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

// Return why there are no programs of a kind, or NULL.
static const char *find_lack(enum bench_translation translation)
{
    struct bench_words vertex, fragment;
    bench_shader_words(BENCH_SHADER_FLAT, &vertex, &fragment);
    if (translation != BENCH_EMITTED) {
        return vertex.size == 0 ? "this program was built without glslangValidator" : NULL;
    }
    return bench_emitted_program(BENCH_SHADER_FLAT) ? NULL
                                                    : "this program was built without RHW_BENCH_EMITTED";
}

bool bench_open_translated(struct bench_renderer *renderer, enum bench_translation translation, int threads,
                           enum rhw_isa isa, const char **why)
{
    *why = find_lack(translation);
    if (*why) {
        return false;
    }
    struct programs *const programs = calloc(1, sizeof *programs);
    if (!programs || !bench_open_rhw(renderer, threads, isa, why)) {
        *why = programs ? *why : "out of memory";
        free(programs);
        return false;
    }
    struct bench_state *const state = renderer->state;
    *programs = (struct programs){
        .are_interpreted = translation == BENCH_INTERPRETER, .renderer = renderer, .close = renderer->close};
    state->translated = translation == BENCH_EMITTED ? emitted : linked;
    state->programs = programs;
    renderer->close = close_translated;
    static const char *const names[] = {"interpreter", "machine code", "emitted C"};
    snprintf(renderer->name, sizeof renderer->name, "%s of rhw %s, %d thread%s", names[translation],
             rhw_version(), renderer->threads, renderer->threads == 1 ? "" : "s");
    return true;
}
