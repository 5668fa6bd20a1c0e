// SPDX-License-Identifier: MIT
// Writes modules as C, for tests that compile what is written: a vertex and a fragment shader, or a compute shader.
// usage: emit_tool NAME OUT.c MODULE.STAGE.spv...
#include <rhw/spirv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void fail(const char *file, const char *message)
{
    fprintf(stderr, "emit_tool: %s: %s\n", file, message);
    exit(1);
}

static rhw_shader *read_shader(const char *path, enum rhw_shader_stage stage)
{
    static unsigned char words[1 << 22];
    FILE *const file = fopen(path, "rb");
    if (!file) {
        fail(path, "it cannot be read");
    }
    const size_t size = fread(words, 1, sizeof words, file);
    fclose(file);
    const struct rhw_shader_def def = {.stage = stage};
    char message[RHW_SHADER_MESSAGE];
    rhw_shader *shader;
    if (rhw_shader_create(words, size, &def, &shader, message) != RHW_OK) {
        fail(path, message);
    }
    return shader;
}

static enum rhw_shader_stage stage_of(const char *path)
{
    return strstr(path, ".vert.")   ? RHW_SHADER_VERTEX
           : strstr(path, ".frag.") ? RHW_SHADER_FRAGMENT
                                    : RHW_SHADER_COMPUTE;
}

int main(int argc, char **argv)
{
    struct rhw_shader_program_def def = {.vertex = NULL};
    const rhw_shader **const stages[] = {&def.vertex, &def.fragment, &def.compute};
    char message[RHW_SHADER_MESSAGE], *text;
    rhw_shader_program *program;
    if (argc < 4) {
        fail("usage", "emit_tool NAME OUT.c MODULE.STAGE.spv...");
    }
    for (int i = 3; i < argc; i++) {
        const enum rhw_shader_stage stage = stage_of(argv[i]);
        *stages[stage] = read_shader(argv[i], stage);
    }
    const struct rhw_shader_c_def how = {.name = argv[1]};
    if (rhw_shader_program_create(&def, &program, message) != RHW_OK ||
        rhw_shader_program_emit_c(program, &how, &text, message) != RHW_OK) {
        fail(argv[3], message);
    }
    FILE *const file = fopen(argv[2], "wb");
    if (!file || fputs(text, file) < 0 || fclose(file) != 0) {
        fail(argv[2], "it cannot be written");
    }
    rhw_shader_free_text(text);
    rhw_shader_program_destroy(program);
    for (int s = 0; s < RHW_SHADER_STAGE_COUNT; s++) {
        rhw_shader_destroy((rhw_shader *)*stages[s]);
    }
    return 0;
}
