// SPDX-License-Identifier: MIT
// Writes the benchmark's shaders as GLSL for Vulkan, which the build compiles to SPIR-V.
//   glsl_texts FOLDER    writes NUMBER.vert and NUMBER.frag for each enum bench_shader
#include "shaders_glsl.h"

#include <stdio.h>

static bool write_pieces(const char *folder, int number, const char *stage,
                         const char *const pieces[BENCH_GLSL_PIECES])
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%d.%s", folder, number, stage);
    FILE *const file = fopen(path, "w");
    if (!file) {
        perror(path);
        return false;
    }
    for (int i = 0; i < BENCH_GLSL_PIECES; i++) {
        fputs(pieces[i], file);
    }
    return fclose(file) == 0;
}

int main(int argc, char **argv)
{
    if (argc != 2) {
        fputs("usage: glsl_texts FOLDER\n", stderr);
        return 2;
    }
    for (int shader = 0; shader < BENCH_SHADERS; shader++) {
        const char *vertex[BENCH_GLSL_PIECES], *fragment[BENCH_GLSL_PIECES];
        bench_glsl(BENCH_GLSL_VULKAN, (enum bench_shader)shader, vertex, fragment);
        if (!write_pieces(argv[1], shader, "vert", vertex) ||
            !write_pieces(argv[1], shader, "frag", fragment)) {
            return 1;
        }
    }
    return 0;
}
