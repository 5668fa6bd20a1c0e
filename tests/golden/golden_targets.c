// SPDX-License-Identifier: MIT
// Golden scenes of colour formats: eight at once, replaced, masked, combined by bits and blended.
#include "golden_cells.h"
#include "golden_scenes.h"

#include <string.h>

enum { TARGETS = 8, SIDE = 24, ROWS = 5, COLUMNS = 4 };

// Those that no other scene draws into.
static const enum rhw_format groups[][TARGETS] = {
    {RHW_FORMAT_R8_UNORM, RHW_FORMAT_RG8_UNORM, RHW_FORMAT_BGRA8_UNORM, RHW_FORMAT_ABGR8_UNORM,
     RHW_FORMAT_R8_SRGB, RHW_FORMAT_RG8_SRGB, RHW_FORMAT_BGRA8_SRGB, RHW_FORMAT_ABGR8_SRGB},
    {RHW_FORMAT_R8_SNORM, RHW_FORMAT_RG8_SNORM, RHW_FORMAT_RGBA8_SNORM, RHW_FORMAT_R16_UNORM,
     RHW_FORMAT_RG16_UNORM, RHW_FORMAT_RGBA16_UNORM, RHW_FORMAT_R16_SNORM, RHW_FORMAT_RGBA16_SNORM},
    {RHW_FORMAT_R16_FLOAT, RHW_FORMAT_RG16_FLOAT, RHW_FORMAT_RG32_FLOAT, RHW_FORMAT_RGB10A2_UNORM,
     RHW_FORMAT_RG11B10_FLOAT, RHW_FORMAT_RGB565_UNORM, RHW_FORMAT_RGBA4_UNORM, RHW_FORMAT_RGB5A1_UNORM},
    {RHW_FORMAT_R8_UINT, RHW_FORMAT_RG8_SINT, RHW_FORMAT_RGBA8_UINT, RHW_FORMAT_R16_SINT,
     RHW_FORMAT_RG16_UINT, RHW_FORMAT_RGBA16_SINT, RHW_FORMAT_RG32_UINT, RHW_FORMAT_RGBA32_SINT}};

// A quad over the viewport whose value goes a little over and under 0..1, and −1 too.
static rhw_buffer quad(rhw_context *context)
{
    static const float corner[6][2] = {{-1, -1}, {1, -1}, {-1, 1}, {-1, 1}, {1, -1}, {1, 1}};
    struct golden_vertex vertices[6];
    for (int i = 0; i < 6; i++) {
        const float x = corner[i][0], y = corner[i][1];
        vertices[i] =
            (struct golden_vertex){{x, y, 0.5f, 1}, {1.2f * x, 0.5f + 0.7f * y, 0.6f, 0.5f - 0.5f * x}};
    }
    return golden_buffer(context, vertices, sizeof vertices);
}

// One cell of a row's state.
static void set_state(struct rhw_pipeline_def *def, const enum rhw_format *formats, int row, int column)
{
    static const enum rhw_logic logic[COLUMNS] = {RHW_LOGIC_XOR, RHW_LOGIC_AND_REVERSE, RHW_LOGIC_NOR,
                                                  RHW_LOGIC_INVERT};
    static const enum rhw_blend_factor src[COLUMNS] = {RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE,
                                                       RHW_BLEND_CONSTANT_ALPHA, RHW_BLEND_DST};
    static const enum rhw_blend_factor dst[COLUMNS] = {RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ONE,
                                                       RHW_BLEND_ONE_MINUS_CONSTANT_ALPHA, RHW_BLEND_ZERO};
    def->target_count = TARGETS;
    def->logic = row == 3 ? logic[column] : RHW_LOGIC_OFF;
    for (int i = 0; i < TARGETS; i++) {
        const bool blends = row == 4 && rhw_format_features(formats[i]) & RHW_FEATURE_BLENDED;
        def->targets[i] = (struct rhw_color_target){
            .format = formats[i], .blend = blends, .write_mask = (uint8_t)(row == 2 ? 1 + 3 * column : 15)};
        if (blends) {
            def->targets[i].color = def->targets[i].alpha =
                (struct rhw_blend_component){src[column], dst[column], RHW_BLEND_ADD};
        }
    }
}

void golden_targets_draw(rhw_context *context, int number, struct golden_images *images)
{
    const enum rhw_format *const formats = groups[number];
    struct golden_board board;
    golden_board_make(&board, context, COLUMNS * SIDE, ROWS * SIDE, formats, TARGETS);
    golden_board_begin(&board);
    const struct golden_cell_uniforms uniforms = {.targets = TARGETS};
    rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, quad(context), 0);
    rhw_pass_set_blend_constant(context, board.pass, (const float[]){0.5f, 2, -1, 0.375f});
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, RHW_FORMAT_RGBA8_UNORM);
    for (int cell = 0; cell < ROWS * COLUMNS; cell++) {
        const int row = cell / COLUMNS, column = cell % COLUMNS;
        golden_cell(context, board.pass, column, row, SIDE, SIDE);
        def.program.varyings[0].qualifier = row == 0 ? RHW_FLAT : RHW_SMOOTH;
        for (int layer = row < 2 ? 1 : 0; layer < 2; layer++) { // over a backdrop
            set_state(&def, formats, layer == 0 ? 1 : row, column);
            rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
            rhw_pass_draw(context, board.pass, 0, 6, 0, 1);
        }
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
