// SPDX-License-Identifier: MIT
// Golden scenes of stencil and depth state, and of several samples a pixel.
#include "golden_cells.h"
#include "golden_scenes.h"

static void use(const struct golden_board *board, const struct rhw_pipeline_def *def, enum rhw_format format)
{
    struct rhw_pipeline_def of_format = *def;
    of_format.targets[0].format = format;
    rhw_pass_set_pipeline(board->context, board->pass, golden_pipeline(board->context, &of_format));
}

// Slopes of both facings that cut each other, one beyond the planes of depth, and fans of slivers.
static void set_vertices(const struct golden_board *board)
{
    static const struct golden_vertex vertices[] = {
        {{-0.9f, -0.8f, 0.9f, 1}, {1, 0.2f, 0, 1}},       {{0.8f, -0.9f, 0.1f, 1}, {1, 0.9f, 0, 0.7f}},
        {{0.1f, 0.9f, 0.5f, 1}, {1, 0.5f, 0.5f, 0.2f}},   {{-1.6f, 0.6f, 0.4f, 2}, {0, 0.5f, 1, 1}},
        {{0, -1.8f, 1, 2}, {0.5f, 0.5f, 1, 0.5f}},        {{1.6f, 0.6f, 1.8f, 2}, {0, 1, 0.5f, 0.1f}},
        {{-0.9f, 0, -0.5f, 1}, {0.9f, 0.9f, 0.9f, 1}},    {{0.9f, -0.2f, 1.5f, 1}, {0.4f, 0.4f, 0.4f, 1}},
        {{0.9f, 0.2f, 1.5f, 1}, {0.4f, 0.4f, 0.4f, 0}},   {{-0.7f, 0.3f, 0.3f, 1}, {0.2f, 0.8f, 0.2f, 1}},
        {{0.95f, 0.31f, 0.2f, 1}, {0.2f, 0.8f, 0.2f, 1}}, {{0.9f, 0.36f, 0.4f, 1}, {0.9f, 0.1f, 0.2f, 1}},
    };
    rhw_pass_set_vertex_buffer(board->context, board->pass, 0,
                               golden_buffer(board->context, vertices, sizeof vertices), 0);
}

static void set_uniforms(const struct golden_board *board)
{
    const struct golden_cell_uniforms uniforms = {.targets = 1};
    rhw_pass_set_uniforms(board->context, board->pass, &uniforms, sizeof uniforms);
}

// Every operation, on both facings, in every row another comparison, mask and depth state; `number`: the format of depth.
void golden_stencil_draw(rhw_context *context, int number, struct golden_images *images)
{
    enum { SIDE = 40, OPERATIONS = 8, ROWS = 6 };
    static const enum rhw_format depths[] = {RHW_FORMAT_D32_FLOAT_S8_UINT, RHW_FORMAT_D24_UNORM_S8_UINT};
    const enum rhw_format format = RHW_FORMAT_RGBA8_UNORM;
    struct golden_board board;
    golden_board_make(&board, context, OPERATIONS * SIDE, ROWS * SIDE, &format, 1);
    board.def.depth = (struct rhw_depth_attachment){
        .enabled = true,
        .texture = golden_texture(context, depths[number], OPERATIONS * SIDE, ROWS * SIDE, 1),
        .clear = 0.75f,
        .stencil_clear = 2};
    golden_board_begin(&board);
    set_uniforms(&board);
    set_vertices(&board);
    rhw_pass_set_stencil_reference(context, board.pass, 1, 3);
    rhw_pass_set_depth_bounds(context, board.pass, 0.2f, 0.8f);
    for (int cell = 0; cell < OPERATIONS * ROWS; cell++) {
        const enum rhw_stencil_operation operation = (enum rhw_stencil_operation)(cell % OPERATIONS);
        const int row = cell / OPERATIONS;
        struct rhw_pipeline_def def =
            golden_cells_def(row == 5 ? GOLDEN_CELL_HEIGHTS : GOLDEN_CELL_VALUE, format);
        def.depth_test = true;
        def.depth_bias = (struct rhw_depth_bias){.constant = row == 1 ? 3000 : 0, .slope = row == 2 ? 2 : 0};
        def.depth_clip_disabled = row >= 3;
        def.depth_clamp = row == 4;
        def.depth_bounds_test = row == 4;
        def.stencil_test = true;
        def.stencil_front = (struct rhw_stencil_face){.pass = operation, .depth_fail = RHW_STENCIL_INVERT};
        def.stencil_back = (struct rhw_stencil_face){.compares = true,
                                                     .compare = RHW_COMPARE_LESS_EQUAL,
                                                     .fail = RHW_STENCIL_INCREMENT_WRAP,
                                                     .pass = operation,
                                                     .write_mask = row == 2 ? 0x0e : 0};
        golden_cell(context, board.pass, cell % OPERATIONS, row, SIDE, SIDE);
        use(&board, &def, format);
        rhw_pass_draw(context, board.pass, 0, 12, 0, 1);
        // What the stencil holds becomes visible.
        def = golden_cells_def(GOLDEN_CELL_VALUE, format);
        def.stencil_test = true;
        def.stencil_front = (struct rhw_stencil_face){.compares = true, .compare = RHW_COMPARE_LESS};
        def.stencil_back = def.stencil_front;
        def.targets[0].blend = true;
        def.targets[0].color = def.targets[0].alpha =
            (struct rhw_blend_component){RHW_BLEND_DST, RHW_BLEND_SRC, RHW_BLEND_ADD};
        use(&board, &def, format);
        rhw_pass_draw(context, board.pass, 0, 12, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
    golden_keep(images, context, board.def.depth.texture);
}

// 2, 4, 8 and 16 samples by `number`: where values are taken, by columns; what drops samples and how they are tested, by
// rows.
void golden_samples_draw(rhw_context *context, int number, struct golden_images *images)
{
    enum { SIDE = 40, COLUMNS = 3, ROWS = 6 };
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_D32_FLOAT};
    struct golden_board board;
    golden_board_make(&board, context, COLUMNS * SIDE, ROWS * SIDE, formats, 2);
    board.def.samples = 2 << number;
    board.def.depth.clear = 0.75f;
    board.def.depth.resolve_mode = RHW_RESOLVE_MIN;
    golden_board_begin(&board);
    set_uniforms(&board);
    set_vertices(&board);
    for (int cell = 0; cell < COLUMNS * ROWS; cell++) {
        const int row = cell / COLUMNS;
        struct rhw_pipeline_def def =
            golden_cells_def(row == 4 ? GOLDEN_CELL_HEIGHTS : GOLDEN_CELL_VALUE, formats[0]);
        def.program.varyings[0].sampling = (enum rhw_sampling)(cell % COLUMNS);
        def.depth_test = row != 1;
        def.sample_mask = row == 2 ? 0x5556 : 0;
        def.alpha_to_coverage = row == 3;
        def.alpha_to_one = row == 3;
        if (row == 1) {
            def.targets[0].blend = true;
            def.targets[0].color = def.targets[0].alpha = (struct rhw_blend_component){
                RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
        }
        def.topology = row == 5 ? RHW_LINE_STRIP : RHW_TRIANGLE_LIST;
        def.line_width = row == 5 ? 1.5f : 0;
        golden_cell(context, board.pass, cell % COLUMNS, row, SIDE, SIDE);
        use(&board, &def, formats[0]);
        rhw_pass_draw(context, board.pass, 0, 12, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
