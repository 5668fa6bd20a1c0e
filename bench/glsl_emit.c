// SPDX-License-Identifier: MIT
// Writes the benchmark's shaders, as rhw-shader translates them, as C for rhw_add_shaders.
//   glsl_emit FOLDER COUNT    writes NUMBER.c for each enum bench_shader, of which there are COUNT, and emitted.inc: the
//                             macro PROGRAMS(X) with an X(number) for each that could be written
#include "shaders_link.h"

#include <stdio.h>
#include <stdlib.h>

static bool write_text(const char *folder, const char *name, const char *text)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *const file = fopen(path, "w");
    if (!file) {
        perror(path);
        return false;
    }
    fputs(text, file);
    return fclose(file) == 0;
}

// A shader that cannot be written leaves a file without anything in it, and `text` NULL.
static bool write_shader(const char *folder, enum bench_shader shader, bool *is_written)
{
    char message[RHW_SHADER_MESSAGE], name[32], file[32];
    char *text = NULL;
    rhw_shader_program *const program = bench_link_shader(shader, true, message);
    snprintf(name, sizeof name, "bench_emitted_%d", (int)shader);
    snprintf(file, sizeof file, "%d.c", (int)shader);
    const struct rhw_shader_c_def def = {.name = name};
    *is_written = program && rhw_shader_program_emit_c(program, &def, &text, message) == RHW_OK;
    if (!*is_written) {
        fprintf(stderr, "glsl_emit: shader %d is left out: %s\n", (int)shader, message);
    }
    const bool works = write_text(folder, file, *is_written ? text : "typedef int nothing;\n");
    rhw_shader_free_text(text);
    rhw_shader_program_destroy(program);
    return works;
}

int main(int argc, char **argv)
{
    char rows[32 * BENCH_SHADERS + 64];
    int length = snprintf(rows, sizeof rows, "#define PROGRAMS(X)");
    if (argc != 3 || atoi(argv[2]) != BENCH_SHADERS) {
        fprintf(stderr, "usage: glsl_emit FOLDER %d\n", (int)BENCH_SHADERS);
        return 2;
    }
    for (int shader = 0; shader < BENCH_SHADERS; shader++) {
        bool is_written;
        if (!write_shader(argv[1], (enum bench_shader)shader, &is_written)) {
            return 1;
        }
        length += is_written ? snprintf(rows + length, sizeof rows - (size_t)length, " X(%d)", shader) : 0;
    }
    snprintf(rows + length, sizeof rows - (size_t)length, "\n");
    return write_text(argv[1], "emitted.inc", rows) ? 0 : 1;
}
