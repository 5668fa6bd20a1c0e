// SPDX-License-Identifier: MIT
// See shaders_link.h.
#include "shaders_link.h"

#include <stdio.h>

#include "shaders_words.h"

static rhw_shader_program *link_stages(const rhw_shader *vertex, const rhw_shader *fragment,
                                       bool is_interpreted, char *message)
{
    struct rhw_shader_layout layout[2 + BENCH_DRAW_TEXTURES];
    rhw_shader_program *program = NULL;
    for (uint32_t i = 0; i < 2 + BENCH_DRAW_TEXTURES; i++) {
        layout[i] = (struct rhw_shader_layout){.set = i >= 2, .binding = i >= 2 ? i - 2 : i, .count = 1};
    }
    const struct rhw_shader_program_def def = {.vertex = vertex,
                                               .fragment = fragment,
                                               .layout = layout,
                                               .layout_count = 2 + BENCH_DRAW_TEXTURES,
                                               .is_interpreted = is_interpreted};
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

rhw_shader_program *bench_link_shader(enum bench_shader shader, bool is_interpreted, char *message)
{
    struct bench_words words[2];
    if (shader == BENCH_SHADER_INPUT) {
        snprintf(message, RHW_SHADER_MESSAGE, "an input attachment is a texture, and not what is drawn into");
        return NULL;
    }
    bench_shader_words(shader, &words[0], &words[1]);
    rhw_shader *const vertex = translate(&words[0], RHW_SHADER_VERTEX, message);
    rhw_shader *const fragment = vertex ? translate(&words[1], RHW_SHADER_FRAGMENT, message) : NULL;
    rhw_shader_program *const program =
        fragment ? link_stages(vertex, fragment, is_interpreted, message) : NULL;
    rhw_shader_destroy(vertex);
    rhw_shader_destroy(fragment);
    return program;
}
