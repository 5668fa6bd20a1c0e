// SPDX-License-Identifier: MIT
// The golden scenes of points and lines, and of triangles drawn as such; the second with Bresenham lines, the
// third with conservative triangles.
#include "golden_cells.h"
#include "golden_scenes.h"

enum { SIDE = 72, COLUMNS = 10, ROWS = 8, VERTICES = 48 };

// Anywhere in the view and a little outside, on every side and behind the eye.
static void make_vertices(struct golden_vertex vertices[VERTICES])
{
    uint64_t random = 99;
    for (int i = 0; i < VERTICES; i++) {
        const float w = i % 11 == 7 ? -0.4f : golden_random(&random, 0.5f, 2);
        vertices[i].position[0] = golden_random(&random, -1.1f, 1.1f) * w;
        vertices[i].position[1] = golden_random(&random, -1.1f, 1.1f) * w;
        vertices[i].position[2] = golden_random(&random, -0.1f, 1.05f) * w;
        vertices[i].position[3] = w;
        for (int c = 0; c < 4; c++) {
            vertices[i].value[c] = golden_random(&random, 0, 1);
        }
    }
}

static const enum rhw_topology topologies[COLUMNS] = {RHW_POINT_LIST,
                                                      RHW_LINE_LIST,
                                                      RHW_LINE_STRIP,
                                                      RHW_LINE_LIST_ADJACENCY,
                                                      RHW_TRIANGLE_LIST,
                                                      RHW_LINE_STRIP_ADJACENCY,
                                                      RHW_TRIANGLE_STRIP,
                                                      RHW_TRIANGLE_FAN,
                                                      RHW_TRIANGLE_LIST_ADJACENCY,
                                                      RHW_TRIANGLE_STRIP_ADJACENCY};

// Rows: by polygon mode, with sizes, widths, distances, culling and flat values in turn.
static struct rhw_pipeline_def row_def(int row, enum rhw_topology topology, int number)
{
    const bool is_lines = topology == RHW_LINE_LIST || topology == RHW_LINE_STRIP ||
                          topology == RHW_LINE_LIST_ADJACENCY || topology == RHW_LINE_STRIP_ADJACENCY;
    const bool is_points = topology == RHW_POINT_LIST || (row % 4 == 2 && !is_lines);
    const enum golden_cell_fragment fragment = is_points     ? GOLDEN_CELL_POINT
                                               : number == 4 ? GOLDEN_CELL_COVERED
                                                             : GOLDEN_CELL_FACING;
    struct rhw_pipeline_def def = golden_cells_def(fragment, RHW_FORMAT_RGBA8_UNORM);
    if (row != 0) {
        golden_cells_fill(&def.program, GOLDEN_CELL_SIZED, fragment);
    }
    def.topology = topology;
    def.polygon_mode = (enum rhw_polygon_mode)(row % 4 == 3 ? 0 : row % 4);
    def.line_width = row < 2 ? 0 : 0.75f * (float)row;
    def.line_mode = number == 1 ? RHW_LINE_BRESENHAM : RHW_LINE_RECTANGULAR;
    if (number == 5) {
        def.line_mode = RHW_LINE_RECTANGULAR_SMOOTH;
        def.line_stipple = (struct rhw_line_stipple){row % 3 == 2 ? 3 : 0, 0x6d36};
        def.targets[0].blend = true;
        def.targets[0].color =
            (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    }
    if (number == 3) {
        def.line_mode = row % 2 == 0 ? RHW_LINE_BRESENHAM : RHW_LINE_RECTANGULAR;
        def.line_stipple = (struct rhw_line_stipple){1 + row / 2, 0x72e5};
    }
    def.conservative = number != 2 && number != 4 ? RHW_CONSERVATIVE_OFF
                       : row % 2 == 0             ? RHW_CONSERVATIVE_OVERESTIMATE
                                                  : RHW_CONSERVATIVE_UNDERESTIMATE;
    def.depth_test = row >= 4;
    def.cull = row == 5 ? RHW_CULL_BACK : RHW_CULL_NONE;
    def.primitive_restart = row % 2 == 1;
    def.provoking = row % 3 == 1 ? RHW_PROVOKING_LAST : RHW_PROVOKING_FIRST;
    def.program.varyings[0].qualifier = row == 5 ? RHW_FLAT : row == 6 ? RHW_NOPERSPECTIVE : RHW_SMOOTH;
    return def;
}

void golden_primitives_draw(rhw_context *context, int number, struct golden_images *images)
{
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_D32_FLOAT};
    struct golden_vertex vertices[VERTICES];
    make_vertices(vertices);
    uint16_t indices[VERTICES];
    for (int i = 0; i < VERTICES; i++) {
        indices[i] = (uint16_t)(i % 13 == 12 ? UINT16_MAX : i);
    }
    struct golden_board board;
    golden_board_make(&board, context, COLUMNS * SIDE, ROWS * SIDE, formats, 2);
    golden_board_begin(&board);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, vertices, sizeof vertices), 0);
    rhw_pass_set_index_buffer(context, board.pass, golden_buffer(context, indices, sizeof indices),
                              RHW_INDEX_UINT16, 0);
    for (int cell = 0; cell < COLUMNS * ROWS; cell++) {
        const int row = cell / COLUMNS;
        const struct rhw_pipeline_def def = row_def(row, topologies[cell % COLUMNS], number);
        golden_cell(context, board.pass, cell % COLUMNS, row, SIDE, SIDE);
        rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
        if (def.primitive_restart) {
            rhw_pass_draw_indexed(context, board.pass, 0, VERTICES, 0, 0, 1);
        } else {
            rhw_pass_draw(context, board.pass, 0, VERTICES, 0, 1);
        }
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
