// SPDX-License-Identifier: MIT
// See shaders_bench.h; this puts the functions of every instruction set into a program. They stand in
// shaders_lanes.c.
#include "shaders_bench.h"

#include <string.h>

static const struct bench_shader_table *const tables[RHW_ISA_COUNT] = RHW_ISA_TABLE(&bench_shader_table),
                                              *const pass_tables[RHW_ISA_COUNT] =
                                                  RHW_ISA_TABLE(&bench_pass_shader_table);

static const uint32_t uses[BENCH_SHADERS] = {
    [BENCH_SHADER_LIT_FLAT] = RHW_USE_IDS,      [BENCH_SHADER_LIT_MASKED] = RHW_USE_DISCARD,
    [BENCH_SHADER_COORD] = RHW_USE_COORD,       [BENCH_SHADER_COORD_SLOPES] = RHW_USE_COORD,
    [BENCH_SHADER_DISCARD] = RHW_USE_DISCARD,   [BENCH_SHADER_MOVE] = RHW_USE_DEPTH,
    [BENCH_SHADER_INPUT] = RHW_USE_COLOR_INPUT, [BENCH_SHADER_SURFACE] = RHW_USE_COORD,
    [BENCH_SHADER_LIGHTS] = RHW_USE_COORD,
};

static void add_varying(struct rhw_program *program, int components, bool derivatives)
{
    program->varyings[program->varying_count++] =
        (struct rhw_varying){.components = components, .derivatives = derivatives};
}

static void add_flat(struct rhw_program *program, int components)
{
    program->varyings[program->varying_count++] =
        (struct rhw_varying){.components = components, .qualifier = RHW_FLAT};
}

// The colour, as the shader wants it.
static void add_color(struct rhw_program *program, enum bench_shader shader)
{
    const bool slopes = shader == BENCH_SHADER_SLOPES || shader == BENCH_SHADER_COORD_SLOPES;
    for (int first = 0; first < 4; first += slopes ? 2 : 4) {
        add_varying(program, slopes ? 2 : 4, slopes && first == 0);
        struct rhw_varying *const color = &program->varyings[program->varying_count - 1];
        color->qualifier = shader == BENCH_SHADER_SCREEN ? RHW_NOPERSPECTIVE : RHW_SMOOTH;
        color->sampling = shader == BENCH_SHADER_SAMPLE ? RHW_SAMPLING_SAMPLE : RHW_SAMPLING_CENTER;
    }
}

void bench_program(struct rhw_program *program, enum bench_shader shader)
{
    *program = (struct rhw_program){.uniform_size = (uint32_t)sizeof(struct bench_uniforms) +
                                                    16 * bench_shader_shared[shader]};
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        const struct bench_shader_table *const table =
            shader >= BENCH_SHADER_SHADOWED ? pass_tables[isa] : tables[isa];
        if (table) {
            program->vertex[isa] = table->vertex[shader];
            program->fragment[isa] = table->fragment[shader];
        }
    }
    const uint32_t attributes = bench_shader_attributes[shader];
    for (int i = 0; i < BENCH_MANY && shader == BENCH_SHADER_MANY; i++) {
        add_varying(program, 4, false);
    }
    if (attributes & 1 << BENCH_COLOR && shader != BENCH_SHADER_MANY) {
        add_color(program, shader);
    }
    if ((attributes & 1 << BENCH_NORMAL) && shader != BENCH_SHADER_VOLUME) {
        add_varying(program, 3, false); // normal, or ray
    }
    if ((attributes & 1 << BENCH_NORMAL) && shader != BENCH_SHADER_VOLUME && shader != BENCH_SHADER_LIGHTS) {
        add_varying(program, 3, false); // position
    }
    if (attributes & 1 << BENCH_UV) {
        add_varying(program, 2, true);
    }
    if (attributes & 1 << BENCH_TINT) {
        add_varying(program, 2, false); // corner
        add_flat(program, 4);
    }
    if (shader == BENCH_SHADER_LIT_FLAT) {
        add_flat(program, 3);
    }
    if (shader == BENCH_SHADER_SHADOWED) {
        add_varying(program, 3, false); // place in the map
    }
    program->uses = uses[shader];
}
