// SPDX-License-Identifier: MIT
// Shaders that are given together make a program.
#include "shader_job.h"

#include <glsl_names.h>

static const uint32_t screen_words[] = {
#include "screen.inc"
};

// Link a fragment shader with a vertex shader that covers the picture.
static rhw_shader_program *link_screen(const struct cli_shader_file *file)
{
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *vertex;
    rhw_shader_program *program = NULL;
    const struct rhw_shader_info *const info = rhw_shader_get_info(file->shader);
    for (uint32_t i = 0; i < info->input_count; i++) {
        if (info->inputs[i].location != 0 || info->inputs[i].is_integer ||
            info->inputs[i].component + info->inputs[i].components > 2) {
            cli_error(file->path,
                      "reads %s at location %u; a vertex shader beside it gives that, and alone it has a "
                      "vec2 at location 0",
                      info->inputs[i].name[0] ? info->inputs[i].name : "an input",
                      (unsigned)info->inputs[i].location);
            return NULL;
        }
    }
    const struct rhw_shader_def def = {.stage = RHW_SHADER_VERTEX};
    enum rhw_result result = rhw_shader_create(screen_words, sizeof screen_words, &def, &vertex, message);
    if (result == RHW_OK) {
        const struct rhw_shader_program_def linked = {.vertex = vertex, .fragment = file->shader};
        result = rhw_shader_program_create(&linked, &program, message);
        rhw_shader_destroy(vertex);
    }
    if (result != RHW_OK) {
        cli_error(file->path, "%s", message);
    }
    return program;
}

bool cli_shader_match(const struct cli_shader_file *files, int count)
{
    struct glsl_code codes[RHW_SHADER_STAGE_COUNT] = {{0}};
    char message[RHW_SHADER_MESSAGE];
    for (int i = 0; i < count && files[i].is_text; i++) {
        codes[files[i].stage] = (struct glsl_code){
            .words = files[i].words, .size = files[i].size, .is_relaxed = files[i].is_relaxed};
    }
    const struct glsl_code *const vertex = &codes[RHW_SHADER_VERTEX], *const fragment =
                                                                          &codes[RHW_SHADER_FRAGMENT];
    if (!vertex->words || !fragment->words || glsl_match(vertex, fragment, message, sizeof message)) {
        return true;
    }
    cli_error(files[count - 1].path, "%s", message);
    return false;
}

bool cli_shader_link(const struct cli_shader_file *files, int count, bool needs_program,
                     rhw_shader_program **linked)
{
    struct rhw_shader_program_def def = {0};
    *linked = NULL;
    for (int i = 0; i < count; i++) {
        const rhw_shader **const stages[] = {&def.vertex, &def.fragment, &def.compute};
        if (*stages[files[i].stage]) {
            cli_error(files[i].path, "is a %s shader, and another is one, too",
                      cli_shader_stage_names[files[i].stage]);
            return false;
        }
        *stages[files[i].stage] = files[i].shader;
    }
    if (count > 1 && def.compute) {
        cli_error(files[files[0].stage == RHW_SHADER_COMPUTE ? 0 : 1].path, "a compute shader goes alone");
        return false;
    }
    if (!def.compute && !def.vertex) {
        *linked = needs_program ? link_screen(&files[0]) : NULL;
        return *linked || !needs_program;
    }
    char message[RHW_SHADER_MESSAGE];
    if (rhw_shader_program_create(&def, linked, message) != RHW_OK) {
        cli_error(files[count - 1].path, "%s", message);
        return false;
    }
    return true;
}
