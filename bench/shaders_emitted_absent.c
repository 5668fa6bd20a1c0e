// SPDX-License-Identifier: MIT
// In place of shaders_emitted.c where the build leaves emitted C out.
#include "shaders_emitted.h"

const struct rhw_program *bench_emitted_program(enum bench_shader shader)
{
    (void)shader;
    return NULL;
}
