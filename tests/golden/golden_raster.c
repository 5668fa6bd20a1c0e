// SPDX-License-Identifier: MIT
// Golden scenes of what lies between the vertex and the fragment function: assembly, clipping, culling, the
// viewport and the depth test.
#include "golden_cells.h"
#include "golden_scenes.h"

#include <string.h>

static void set_value_uniforms(const struct golden_board *board, int targets)
{
    const struct golden_cell_uniforms uniforms = {.targets = targets};
    rhw_pass_set_uniforms(board->context, board->pass, &uniforms, sizeof uniforms);
}

static void use(const struct golden_board *board, const struct rhw_pipeline_def *def)
{
    rhw_pass_set_pipeline(board->context, board->pass, golden_pipeline(board->context, def));
}

void golden_depth_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 40, COMPARES = 8, ROWS = 5 };
    static const enum rhw_compare compares[COMPARES] = {
        RHW_COMPARE_NEVER,   RHW_COMPARE_LESS,      RHW_COMPARE_EQUAL,         RHW_COMPARE_LESS_EQUAL,
        RHW_COMPARE_GREATER, RHW_COMPARE_NOT_EQUAL, RHW_COMPARE_GREATER_EQUAL, RHW_COMPARE_ALWAYS};
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_D32_FLOAT};
    // Two slopes that cut each other, one that leaves 0..1 on either side, and a copy of the first.
    static const struct golden_vertex vertices[] = {
        {{-1, -1, 0.9f, 1}, {1, 0.2f, 0, 1}},           {{1, -1, 0.1f, 1}, {1, 0.9f, 0, 1}},
        {{0, 1, 0.5f, 1}, {1, 0.5f, 0.5f, 1}},          {{-1.6f, 0.6f, 0.4f, 2}, {0, 0.5f, 1, 1}},
        {{1.6f, 0.6f, 1.8f, 2}, {0, 1, 0.5f, 1}},       {{0, -1.8f, 1, 2}, {0.5f, 0.5f, 1, 1}},
        {{-0.9f, 0, -0.5f, 1}, {0.9f, 0.9f, 0.9f, 1}},  {{0.9f, -0.2f, 1.5f, 1}, {0.4f, 0.4f, 0.4f, 1}},
        {{0.9f, 0.2f, 1.5f, 1}, {0.4f, 0.4f, 0.4f, 1}}, {{-1, -1, 0.9f, 1}, {0.2f, 0.8f, 0.2f, 1}},
        {{1, -1, 0.1f, 1}, {0.2f, 0.8f, 0.2f, 1}},      {{0, 1, 0.5f, 1}, {0.2f, 0.8f, 0.2f, 1}},
    };
    struct golden_board board;
    golden_board_make(&board, context, COMPARES * SIDE, ROWS * SIDE, formats, 2);
    board.def.depth.clear = 0.75f;
    golden_board_begin(&board);
    set_value_uniforms(&board, 1);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, vertices, sizeof vertices), 0);
    for (int cell = 0; cell < COMPARES * ROWS; cell++) {
        const int row = cell / COMPARES;
        struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, RHW_FORMAT_RGBA8_UNORM);
        def.depth_test = row != 1;
        def.depth_read_only = row == 2;
        def.depth_compare = compares[cell % COMPARES];
        def.depth_range = row == 3 ? RHW_DEPTH_MINUS_ONE_TO_ONE : RHW_DEPTH_ZERO_TO_ONE;
        golden_cell(context, board.pass, cell % COMPARES, row, SIDE, SIDE);
        const struct rhw_viewport reversed = {
            (float)(cell % COMPARES * SIDE), (float)(row * SIDE), SIDE, SIDE, 0.875f, 0.125f};
        if (row == 4) {
            rhw_pass_set_viewport(context, board.pass, &reversed);
        }
        use(&board, &def);
        rhw_pass_draw(context, board.pass, 0, 12, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_culling_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 48 };
    const enum rhw_format format = RHW_FORMAT_RGBA8_UNORM;
    // Counter-clockwise, clockwise, and one that its vertex behind the eye turns round.
    static const struct golden_vertex vertices[] = {
        {{-0.9f, -0.9f, 0, 1}, {1, 0.8f, 0.2f, 1}},   {{-0.1f, -0.9f, 0, 1}, {1, 0.8f, 0.2f, 1}},
        {{-0.5f, 0.5f, 0, 1}, {1, 0.2f, 0.2f, 1}},    {{0.1f, -0.9f, 0, 1}, {0.2f, 0.8f, 1, 1}},
        {{0.5f, 0.5f, 0, 1}, {0.2f, 0.2f, 1, 1}},     {{0.9f, -0.9f, 0, 1}, {0.2f, 0.8f, 1, 1}},
        {{-0.9f, 0.6f, 0.1f, 1}, {0.2f, 1, 0.4f, 1}}, {{0.9f, 0.6f, 0.1f, 1}, {0.2f, 1, 0.4f, 1}},
        {{0, 0.2f, 0.1f, -0.5f}, {0.8f, 1, 0.8f, 1}},
    };
    struct golden_board board;
    golden_board_make(&board, context, 6 * SIDE, 2 * SIDE, &format, 1);
    golden_board_begin(&board);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, vertices, sizeof vertices), 0);
    for (int cell = 0; cell < 12; cell++) {
        struct rhw_pipeline_def def =
            golden_cells_def(cell < 6 ? GOLDEN_CELL_FACING : GOLDEN_CELL_VALUE, format);
        def.cull = (enum rhw_cull)(cell % 3);
        def.front = (enum rhw_winding)(cell / 3 % 2);
        set_value_uniforms(&board, 1);
        golden_cell(context, board.pass, cell % 6, cell / 6, SIDE, SIDE);
        use(&board, &def);
        rhw_pass_draw(context, board.pass, 0, 9, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

// A ring of points in turn near the middle and near the edge: a band as a strip, a star as a fan.
static void make_ring(struct golden_vertex vertices[16])
{
    static const float circle[8][2] = {{1, 0},  {0.7f, 0.7f},   {0, 1},  {-0.7f, 0.7f},
                                       {-1, 0}, {-0.7f, -0.7f}, {0, -1}, {0.7f, -0.7f}};
    for (int i = 0; i < 16; i++) {
        const float radius = i % 2 ? 0.95f : 0.4f;
        vertices[i] =
            (struct golden_vertex){{circle[i / 2][0] * radius, circle[i / 2][1] * radius, 0, 1},
                                   {(float)(i % 4) / 3, (float)(i / 4) / 3, (float)((i * 7) % 16) / 15, 1}};
    }
}

void golden_topology_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 56 };
    const enum rhw_format format = RHW_FORMAT_RGBA8_UNORM;
    struct golden_vertex vertices[16];
    make_ring(vertices);
    // With restarts, degenerate triangles and an index outside the vertex buffer.
    static const uint32_t order[] = {0,  1,  2,          3, 4,  5,  6,  UINT32_MAX, 8, 9, 10, 11,
                                     12, 13, UINT32_MAX, 2, 15, 14, 14, 7,          0, 6, 200};
    enum { INDICES = sizeof order / sizeof *order };
    uint8_t order8[INDICES];
    uint16_t order16[INDICES + 1];
    order16[0] = 3;
    for (int i = 0; i < INDICES; i++) {
        order8[i] = (uint8_t)order[i];
        order16[i + 1] = (uint16_t)order[i];
    }
    const rhw_buffer indices[3] = {golden_buffer(context, order8, sizeof order8),
                                   golden_buffer(context, order16, sizeof order16),
                                   golden_buffer(context, order, sizeof order)};
    struct golden_board board;
    golden_board_make(&board, context, 8 * SIDE, 6 * SIDE, &format, 1);
    golden_board_begin(&board);
    set_value_uniforms(&board, 1);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, vertices, sizeof vertices), 0);
    for (int cell = 0; cell < 48; cell++) {
        const int topology = cell / 16, how = cell % 4; // how: not indexed, 8, 16 or 32 bits
        struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, format);
        def.topology = (enum rhw_topology)topology;
        def.provoking = cell / 4 % 2 ? RHW_PROVOKING_LAST : RHW_PROVOKING_FIRST;
        def.primitive_restart = cell / 8 % 2 && def.topology != RHW_TRIANGLE_LIST;
        def.program.varyings[0].qualifier = RHW_FLAT;
        golden_cell(context, board.pass, cell % 8, cell / 8, SIDE, SIDE);
        use(&board, &def);
        if (how == 0) {
            rhw_pass_draw(context, board.pass, 1, 15, 0, 1);
            continue;
        }
        rhw_pass_set_index_buffer(context, board.pass, indices[how - 1], (enum rhw_index_type)(how - 1),
                                  how == 2 ? 2 : 0);
        rhw_pass_draw_indexed(context, board.pass, how == 3 ? 1 : 0, INDICES,
                              how == 1   ? 2
                              : how == 2 ? -1
                                         : 0,
                              0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_viewport_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { WIDTH = 333, HEIGHT = 221 };
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_D32_FLOAT};
    struct golden_vertex vertices[16];
    make_ring(vertices);
    static const struct {
        struct rhw_viewport viewport;
        struct rhw_rect scissor;
    } views[] = {
        {{0, 0, WIDTH, HEIGHT, 0.5f, 1}, {0, 0, WIDTH, HEIGHT}},
        {{10.3f, 20.7f, 90.1f, 60.9f, 0, 0.25f}, {0, 0, WIDTH, HEIGHT}},
        {{-40.5f, 120.25f, 150, 150, 0.25f, 0}, {3, 130, 91, 77}},
        {{200, -60, 200, 160, 0, 0.5f}, {210, 0, 123, 90}},
        {{150.5f, 100.5f, 0.5f, 100, 0, 0.1f}, {0, 0, WIDTH, HEIGHT}},
        {{220, 120, 64, 64, 0.3f, 0.3f}, {221, 121, 1, 1}},
        {{240, 110, 80, 100, 0.3f, 0.3f}, {250, 120, 63, 64}},
        {{-16000, -16000, 16384, 16384, 0, 0.1f}, {0, 0, 40, 400}},
        {{100, 100, 50, 50, 0, 1}, {120, 120, 0, 10}},
        {{-5000, -5000, 10000, 10000, 0.9f, 0.2f}, {100, 90, 60, 70}},
    };
    struct golden_board board;
    golden_board_make(&board, context, WIDTH, HEIGHT, formats, 2);
    golden_board_begin(&board);
    set_value_uniforms(&board, 1);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, vertices, sizeof vertices), 0);
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, formats[0]);
    def.topology = RHW_TRIANGLE_STRIP;
    def.depth_test = true;
    use(&board, &def);
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        rhw_pass_set_viewport(context, board.pass, &views[i].viewport);
        rhw_pass_set_scissor(context, board.pass, &views[i].scissor);
        rhw_pass_draw(context, board.pass, 0, 16, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_clipping_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 64, CASES = 10 };
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_D32_FLOAT};
    // One corner leaves the view through each plane; behind the eye; far outside; all around; not a number.
    static const float cases[CASES][3][4] = {
        {{-2, 0, 0.5f, 1}, {0.8f, -0.8f, 0.5f, 1}, {0.8f, 0.8f, 0.2f, 2}},
        {{2, 0, 0.5f, 1}, {-0.8f, 0.8f, 0.5f, 1}, {-0.8f, -0.8f, 0.2f, 2}},
        {{0, -2, 0.5f, 1}, {0.8f, 0.8f, 0.5f, 1}, {-0.8f, 0.8f, 0.2f, 2}},
        {{0, 2, 0.5f, 1}, {-0.8f, -0.8f, 0.5f, 1}, {0.8f, -0.8f, 0.2f, 2}},
        {{0, 0.9f, -1, 1}, {-0.9f, -0.8f, 0.5f, 1}, {0.9f, -0.8f, 0.9f, 2}},
        {{0, 0.9f, 3, 1}, {-0.9f, -0.8f, 0.5f, 1}, {0.9f, -0.8f, 0.2f, 2}},
        {{0.3f, 3, 0.1f, -1}, {-0.9f, -0.8f, 0.5f, 1}, {0.9f, -0.8f, 0.5f, 3}},
        {{-300000, 5000, 0.1f, 1}, {0.9f, -90000, 0.5f, 1}, {4000, 60000, 0.9f, 1.5f}},
        {{-9, -7, 0.1f, -1}, {8, -6, 0.2f, 0.5f}, {1, 30, 2, 4}},
        {{0.5f, 2, 0, 0}, {0.9f, -0.9f, 0.5f, 1}, {-0.9f, -0.5f, 0.5f, 1}},
    };
    static const float values[3][4] = {{1, 0, 0.1f, 1}, {0.1f, 1, 0, 0.5f}, {0, 0.1f, 1, 0}};
    struct golden_vertex vertices[3 * CASES + 3];
    for (int i = 0; i < 3 * CASES; i++) {
        memcpy(vertices[i].position, cases[i / 3][i % 3], sizeof vertices[i].position);
        memcpy(vertices[i].value, values[i % 3], sizeof vertices[i].value);
    }
    memcpy(vertices + 3 * CASES, vertices, 3 * sizeof *vertices);
    vertices[3 * CASES].position[3] = __builtin_nanf("");
    struct golden_board board;
    golden_board_make(&board, context, CASES * SIDE, 4 * SIDE, formats, 3);
    golden_board_begin(&board);
    set_value_uniforms(&board, 2);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, vertices, sizeof vertices), 0);
    for (int cell = 0; cell < CASES * 4; cell++) {
        const int row = cell / CASES;
        struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, formats[0]);
        def.targets[1] = (struct rhw_color_target){.format = formats[1], .write_mask = 15};
        def.target_count = 2;
        def.depth_test = true;
        def.program.varyings[0].qualifier = row < 3 ? (enum rhw_qualifier)row : RHW_SMOOTH;
        def.depth_range = row == 3 ? RHW_DEPTH_MINUS_ONE_TO_ONE : RHW_DEPTH_ZERO_TO_ONE;
        golden_cell(context, board.pass, cell % CASES, row, SIDE, SIDE);
        use(&board, &def);
        rhw_pass_draw(context, board.pass, (uint32_t)(cell % CASES * 3), cell % CASES == CASES - 1 ? 6 : 3, 0,
                      1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
