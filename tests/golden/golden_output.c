// SPDX-License-Identifier: MIT
// Golden scenes of what is stored: blending, write masks, colour formats, loading and storing.
#include "golden_cells.h"
#include "golden_scenes.h"

#include <string.h>

// Every format that can be drawn into with blending.
static const enum rhw_format blend_formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB,
                                                RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_RGBA32_FLOAT,
                                                RHW_FORMAT_R32_FLOAT};
enum {
    BLEND_FORMATS = sizeof blend_formats / sizeof *blend_formats,
    FACTORS = 13,
    OPERATIONS = 5,
    CELL = 10
};

// A quad over the viewport whose value runs from one colour to another; a little over and under 0..1.
static void fill_quads(struct golden_vertex vertices[12])
{
    static const float corner[6][2] = {{-1, -1}, {1, -1}, {-1, 1}, {-1, 1}, {1, -1}, {1, 1}};
    for (int i = 0; i < 6; i++) {
        const float x = 0.5f + 0.5f * corner[i][0], y = 0.5f + 0.5f * corner[i][1];
        vertices[i] = (struct golden_vertex){{corner[i][0], corner[i][1], 0.5f, 1},
                                             {0.9f - 0.7f * x, 0.2f + 0.7f * y, 0.6f, 0.75f - 0.5f * x}};
        vertices[6 + i] = (struct golden_vertex){{corner[i][0], corner[i][1], 0.25f, 1},
                                                 {1.25f * x - 0.125f, 0.5f, 1.1f - y, 0.1f + 0.8f * y}};
    }
}

static rhw_buffer quads(rhw_context *context)
{
    struct golden_vertex vertices[12];
    fill_quads(vertices);
    return golden_buffer(context, vertices, sizeof vertices);
}

static void set_targets(struct rhw_pipeline_def *def, const enum rhw_format *formats, int count)
{
    def->target_count = count;
    for (int i = 0; i < count; i++) {
        def->targets[i] = (struct rhw_color_target){.format = formats[i], .write_mask = 15};
    }
}

// The first quad everywhere, then what is tested over it.
static void draw_backdrop(struct golden_board *board, const struct rhw_pipeline_def *def)
{
    rhw_pass_set_pipeline(board->context, board->pass, golden_pipeline(board->context, def));
    rhw_pass_draw(board->context, board->pass, 0, 6, 0, 1);
}

void golden_blend_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    struct golden_board board;
    golden_board_make(&board, context, FACTORS * CELL, FACTORS * OPERATIONS * CELL, blend_formats,
                      BLEND_FORMATS);
    golden_board_begin(&board);
    const struct golden_cell_uniforms uniforms = {.targets = BLEND_FORMATS};
    rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, quads(context), 0);
    rhw_pass_set_blend_constant(context, board.pass, (const float[]){0.25f, 0.5f, 1.25f, 0.75f});
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, RHW_FORMAT_RGBA8_UNORM);
    set_targets(&def, blend_formats, BLEND_FORMATS);
    draw_backdrop(&board, &def);
    for (int cell = 0; cell < FACTORS * FACTORS * OPERATIONS; cell++) {
        const enum rhw_blend_factor src = (enum rhw_blend_factor)(RHW_BLEND_ZERO + cell % FACTORS);
        const enum rhw_blend_factor dst = (enum rhw_blend_factor)(RHW_BLEND_ZERO + cell / FACTORS % FACTORS);
        const int operation = cell / FACTORS / FACTORS;
        for (int i = 0; i < BLEND_FORMATS; i++) {
            def.targets[i].blend = true;
            def.targets[i].color =
                (struct rhw_blend_component){src, dst, (enum rhw_blend_operation)operation};
            def.targets[i].alpha = (struct rhw_blend_component){
                dst, src, (enum rhw_blend_operation)((operation + 1) % OPERATIONS)};
        }
        rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
        golden_cell(context, board.pass, cell % FACTORS, cell / FACTORS, CELL, CELL);
        rhw_pass_draw(context, board.pass, 6, 6, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_write_mask_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 24 };
    struct golden_board board;
    golden_board_make(&board, context, 4 * SIDE, 8 * SIDE, blend_formats, BLEND_FORMATS);
    golden_board_begin(&board);
    const struct golden_cell_uniforms uniforms = {.targets = BLEND_FORMATS};
    rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, quads(context), 0);
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, RHW_FORMAT_RGBA8_UNORM);
    set_targets(&def, blend_formats, BLEND_FORMATS);
    for (int cell = 0; cell < 32; cell++) { // the lower half blends
        for (int i = 0; i < BLEND_FORMATS; i++) {
            def.targets[i].write_mask = (uint8_t)(cell & 15 ? cell & 15 : RHW_WRITE_NONE);
            def.targets[i].blend = cell >= 16;
            def.targets[i].color = (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA,
                                                                RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
            def.targets[i].alpha =
                (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
        }
        rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
        golden_cell(context, board.pass, cell % 4, cell / 4, SIDE, SIDE);
        rhw_pass_draw(context, board.pass, 6, 6, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_formats_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 96, COUNT = 8 };
    // All eight attachments, integers too; each with its own mask and values far outside 0..1.
    enum rhw_format formats[COUNT] = {
        [BLEND_FORMATS] = RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_R32_UINT};
    memcpy(formats, blend_formats, sizeof blend_formats);
    struct golden_board board;
    golden_board_make(&board, context, SIDE, SIDE, formats, COUNT);
    const float hostile[COUNT - 1] = {-2, 3, 70000, -1e-42f, 1e30f, -1e30f, 1e-40f};
    for (int i = 0; i < COUNT - 1; i++) {
        board.def.colors[i].clear[0] = hostile[i];
    }
    board.def.colors[COUNT - 1].clear_integer[0] = (int32_t)4000000000u;
    golden_board_begin(&board);
    const struct golden_cell_uniforms uniforms = {.targets = COUNT};
    rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
    // Values per row of cells: ordinary, large, tiny, infinite and NaN.
    const float inf = __builtin_inff(), nan = __builtin_nanf("");
    const float values[6][2] = {{0, 1}, {-3, 4}, {-70000, 70000}, {1e-45f, 1e-38f}, {-inf, inf}, {nan, -nan}};
    struct golden_vertex vertices[6 * 12];
    for (int row = 0; row < 6; row++) {
        fill_quads(vertices + 12 * row);
        for (int i = 0; i < 6; i++) {
            struct golden_vertex *vertex = &vertices[12 * row + i];
            const int side = vertex->position[0] > 0;
            for (int c = 0; c < 4; c++) {
                vertex->value[c] = values[row][c % 2 ? 1 - side : side];
            }
        }
    }
    const rhw_buffer buffer = golden_buffer(context, vertices, sizeof vertices);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, buffer, 0);
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, RHW_FORMAT_RGBA8_UNORM);
    set_targets(&def, formats, COUNT);
    for (int row = 0; row < 6; row++) {
        for (int column = 0; column < 4; column++) { // replaced; flat; blended; the largest of both
            def.program.varyings[0].qualifier = column == 1 ? RHW_FLAT : RHW_SMOOTH;
            // The bits of a NaN that arithmetic makes are the processor's own; only an integer target shows them.
            def.targets[COUNT - 1].write_mask = row >= 4 && column != 1 ? RHW_WRITE_NONE : 0;
            for (int i = 0; i < COUNT - 1; i++) {
                def.targets[i].blend = column >= 2;
                def.targets[i].color = def.targets[i].alpha = (struct rhw_blend_component){
                    RHW_BLEND_CONSTANT, RHW_BLEND_DST, column == 2 ? RHW_BLEND_ADD : RHW_BLEND_MAX};
            }
            rhw_pass_set_blend_constant(context, board.pass, (const float[]){0.5f, 2, -1, 1});
            rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
            golden_cell(context, board.pass, column, row, SIDE / 4, SIDE / 6);
            rhw_pass_draw(context, board.pass, (uint32_t)(12 * row), 6, 0, 1);
        }
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_passes_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 150 }; // more than two tiles, and not whole ones
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_D32_FLOAT};
    struct golden_board board;
    golden_board_make(&board, context, SIDE, SIDE, formats, 3);
    const struct golden_cell_uniforms uniforms = {.targets = 2};
    const rhw_buffer buffer = quads(context);
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, RHW_FORMAT_RGBA8_UNORM);
    set_targets(&def, formats, 2);
    def.depth_test = true;
    for (int pass = 0; pass < 4; pass++) {
        // 0 clears and keeps all; 1 adds to it; 2 keeps no depth and drops the second colour; 3 starts that anew.
        static const enum rhw_load load[4] = {RHW_LOAD_CLEAR, RHW_LOAD_LOAD, RHW_LOAD_LOAD, RHW_LOAD_LOAD};
        board.def.colors[0].load = board.def.depth.load = load[pass];
        board.def.colors[1].load = pass == 3 ? RHW_LOAD_DISCARD : load[pass];
        board.def.colors[1].store = pass == 2 ? RHW_STORE_DISCARD : RHW_STORE_STORE;
        board.def.depth.store = pass >= 2 ? RHW_STORE_DISCARD : RHW_STORE_STORE;
        golden_board_begin(&board);
        rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
        rhw_pass_set_vertex_buffer(context, board.pass, 0, buffer, 0);
        rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
        // What is loaded by DISCARD is covered whole.
        const struct rhw_rect scissor = {pass * 20, pass * 25, SIDE - pass * 40, SIDE - pass * 45};
        if (pass < 3) {
            rhw_pass_set_scissor(context, board.pass, &scissor);
        }
        rhw_pass_draw(context, board.pass, pass % 2 ? 6 : 0, 6, 0, 1);
        golden_board_end(&board);
        if (pass == 1) {
            golden_keep(images, context, board.targets[1]);
            golden_keep(images, context, board.targets[2]);
        }
        def.depth_compare = pass == 2 ? RHW_COMPARE_ALWAYS : RHW_COMPARE_LESS_EQUAL;
        def.targets[0].write_mask = pass == 2 ? 4 : 15;
    }
    golden_keep(images, context, board.targets[0]);
    golden_keep(images, context, board.targets[1]);
}
