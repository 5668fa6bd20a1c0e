// SPDX-License-Identifier: MIT
// See shaders_emitted.h.
#include "shaders_emitted.h"

#include "emitted.inc"

#define DECLARE(number) extern const struct rhw_program bench_emitted_##number##_program;
PROGRAMS(DECLARE)

#define ROW(number) [number] = &bench_emitted_##number##_program,
static const struct rhw_program *const programs[BENCH_SHADERS] = {PROGRAMS(ROW)};

const struct rhw_program *bench_emitted_program(enum bench_shader shader)
{
    return programs[shader];
}
