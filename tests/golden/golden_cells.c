// SPDX-License-Identifier: MIT
// Puts the copies of the golden shaders into programs; see golden_cells.h and golden_shaders.h.
#include "golden_cells.h"

#include "golden_shaders.h"

void golden_shaders_fill(struct rhw_program *program, enum golden_shader shader)
{
    static golden_shaders_function *const copies[RHW_ISA_COUNT] = RHW_ISA_TABLE(golden_shaders);
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (copies[isa]) {
            copies[isa](program, (enum rhw_isa)isa, shader);
        }
    }
}

void golden_cells_fill(struct rhw_program *program, enum golden_cell_vertex vertex,
                       enum golden_cell_fragment fragment)
{
    static const uint32_t uses[GOLDEN_CELL_FRAGMENTS] = {
        [GOLDEN_CELL_FACING] = RHW_USE_FACING,
        [GOLDEN_CELL_IDS] = RHW_USE_IDS,
        [GOLDEN_CELL_BUILTINS] = RHW_USE_COORD | RHW_USE_FACING | RHW_USE_IDS | RHW_USE_BARYCENTRIC |
                                 RHW_USE_BARYCENTRIC_DERIVATIVES,
        [GOLDEN_CELL_HEIGHTS] = RHW_USE_DISCARD | RHW_USE_DEPTH,
        [GOLDEN_CELL_POINT] = RHW_USE_POINT_COORD,
        [GOLDEN_CELL_ROUTE] = RHW_USE_LAYER,
        [GOLDEN_CELL_COVERED] = RHW_USE_FULLY_COVERED,
        [GOLDEN_CELL_OFFSET] = RHW_USE_COORD,
    };
    static golden_cells_function *const copies[RHW_ISA_COUNT] = RHW_ISA_TABLE(golden_cells);
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        if (copies[isa]) {
            copies[isa](program, (enum rhw_isa)isa, vertex, fragment);
        }
    }
    program->uses = uses[fragment];
    program->writes_point_size = vertex == GOLDEN_CELL_SIZED;
    program->writes_viewport_index = program->writes_layer = vertex == GOLDEN_CELL_ROUTED;
    program->clip_distance_count = vertex == GOLDEN_CELL_SIZED ? 2 : 0;
    program->cull_distance_count = vertex == GOLDEN_CELL_SIZED ? 1 : 0;
    if (fragment == GOLDEN_CELL_VALUE || fragment == GOLDEN_CELL_MATHS) {
        program->uniform_size = sizeof(struct golden_cell_uniforms);
    }
    if (fragment == GOLDEN_CELL_KINDS) {
        program->uniform_size = sizeof(struct golden_kind_uniforms);
    }
}

struct rhw_pipeline_def golden_cells_def(enum golden_cell_fragment fragment, enum rhw_format format)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    golden_cells_fill(&def.program, GOLDEN_CELL_PLAIN, fragment);
    def.program.varyings[0] = (struct rhw_varying){.components = 4, .derivatives = true};
    def.program.varying_count = 1;
    def.attributes[0] =
        (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct golden_vertex, position)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct golden_vertex, value)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct golden_vertex);
    def.buffer_count = 1;
    def.targets[0].format = format;
    return def;
}
