// SPDX-License-Identifier: MIT
// A golden scene of passes that draw parts of the same attachments, whose samples are kept and resolved besides.
#include <stdlib.h>

#include "golden_cells.h"
#include "golden_scenes.h"

enum { SIDE = 150, PASSES = 6 };

static rhw_texture samples_of(rhw_context *context, enum rhw_format format)
{
    const struct rhw_texture_def def = {.format = format, .width = SIDE, .height = SIDE, .samples = 4};
    rhw_texture texture;
    golden_check(rhw_texture_create(context, &def, &texture), "rhw_texture_create");
    return texture;
}

// Triangles that cut each other and a loop of lines around them, with depth and stencil.
static void draw(const struct golden_board *board, int number)
{
    static const struct golden_vertex vertices[] = {
        {{-0.9f, -0.8f, 0.9f, 1}, {1, 0.2f, 0, 1}},     {{0.8f, -0.9f, 0.1f, 1}, {1, 0.9f, 0, 0.7f}},
        {{0.1f, 0.9f, 0.5f, 1}, {1, 0.5f, 0.5f, 0.2f}}, {{-1.6f, 0.6f, 0.4f, 2}, {0, 0.5f, 1, 1}},
        {{0, -1.8f, 1, 2}, {0.5f, 0.5f, 1, 0.5f}},      {{1.6f, 0.6f, 1.8f, 2}, {0, 1, 0.5f, 0.1f}}};
    const struct golden_cell_uniforms uniforms = {.targets = 1};
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, RHW_FORMAT_RGBA8_UNORM);
    def.depth_test = true;
    def.depth_compare = number % 2 ? RHW_COMPARE_GREATER : RHW_COMPARE_LESS;
    def.stencil_test = true;
    def.stencil_front.pass = RHW_STENCIL_INCREMENT_WRAP;
    def.stencil_back.pass = RHW_STENCIL_INVERT;
    def.topology = RHW_TRIANGLE_LIST;
    rhw_pass_set_pipeline(board->context, board->pass, golden_pipeline(board->context, &def));
    rhw_pass_set_uniforms(board->context, board->pass, &uniforms, sizeof uniforms);
    rhw_pass_set_vertex_buffer(board->context, board->pass, 0,
                               golden_buffer(board->context, vertices, sizeof vertices), 0);
    rhw_pass_draw(board->context, board->pass, 0, 6, 0, 1);
    def.topology = RHW_LINE_LOOP;
    def.line_width = 3;
    def.depth_test = false;
    rhw_pass_set_pipeline(board->context, board->pass, golden_pipeline(board->context, &def));
    rhw_pass_draw(board->context, board->pass, 0, 6, 0, 1);
}

void golden_areas_draw(rhw_context *context, int number, struct golden_images *images)
{
    static const struct rhw_rect areas[PASSES] = {
        {0}, {10, 20, 70, 5}, {64, 64, 64, 64}, {3, 61, 130, 44}, {101, 0, 49, 150}, {149, 149, 1, 1}};
    const enum rhw_format color = RHW_FORMAT_RGBA8_UNORM, depth = RHW_FORMAT_D32_FLOAT_S8_UINT;
    struct golden_board board;
    (void)number;
    golden_board_make(&board, context, SIDE, SIDE, &color, 1);
    board.def.colors[0].resolve = board.def.colors[0].texture;
    board.def.colors[0].texture = samples_of(context, color);
    board.def.depth = (struct rhw_depth_attachment){.enabled = true,
                                                    .texture = samples_of(context, depth),
                                                    .resolve = golden_texture(context, depth, SIDE, SIDE, 1),
                                                    .clear = 0.75f,
                                                    .stencil_clear = 100};
    for (int pass = 0; pass < PASSES; pass++) {
        board.def.render_area = areas[pass];
        board.def.colors[0].load = pass % 3 ? RHW_LOAD_LOAD : RHW_LOAD_CLEAR;
        board.def.colors[0].clear[pass % 3] = 0.4f;
        board.def.depth.load = pass % 2 ? RHW_LOAD_LOAD : RHW_LOAD_CLEAR;
        board.def.depth.stencil_load = pass ? RHW_LOAD_LOAD : RHW_LOAD_CLEAR;
        board.def.depth.resolve_mode = (enum rhw_resolve)(RHW_RESOLVE_AVERAGE + pass % 4);
        board.def.depth.stencil_resolve_mode = pass == 4 ? RHW_RESOLVE_NONE : RHW_RESOLVE_MAX;
        golden_board_begin(&board);
        draw(&board, pass);
        golden_board_end(&board);
    }
    golden_board_keep(&board, images);
    golden_keep(images, context, board.def.depth.resolve);
    const struct rhw_texture_region stencil = {.aspect = RHW_ASPECT_STENCIL};
    unsigned char *const bytes = malloc(SIDE * SIDE);
    if (!bytes) {
        abort();
    }
    golden_check(rhw_texture_read_region(context, board.def.depth.resolve, &stencil, bytes, 0, 0),
                 "rhw_texture_read_region");
    golden_give(images, RHW_FORMAT_S8_UINT, SIDE, SIDE, bytes);
}
