// SPDX-License-Identifier: MIT
// The golden scene of compressed formats: random blocks of each, in two levels that end within a block.
#include "golden_cells.h"
#include "golden_scenes.h"

#include "random_block.h"

#include <stdlib.h>

enum { COLUMNS = 9, SIDE = 40, WIDTH = 45, HEIGHT = 29, LEVELS = 2 };

static rhw_texture make_texture(rhw_context *context, enum rhw_format format)
{
    const rhw_texture texture = golden_texture(context, format, WIDTH, HEIGHT, LEVELS);
    const int block_width = rhw_format_block_width(format), block_height = rhw_format_block_height(format);
    const size_t bytes = rhw_format_block_bytes(format);
    uint64_t random = (uint64_t)(format - RHW_FORMAT_BC1_RGB_UNORM);
    for (int level = 0; level < LEVELS; level++) {
        const int columns = ((WIDTH >> level) + block_width - 1) / block_width;
        const int rows = ((HEIGHT >> level) + block_height - 1) / block_height;
        unsigned char *const blocks = malloc((size_t)(rows * columns) * bytes);
        for (int i = 0; blocks && i < rows * columns; i++) {
            random_block(format, &random, blocks + (size_t)i * bytes);
        }
        golden_check(rhw_texture_write(context, texture, level, blocks, 0), "blocks");
        free(blocks);
    }
    return texture;
}

void golden_blocks_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { ROWS = 6, FORMATS = RHW_FORMAT_ASTC_12X12_SRGB - RHW_FORMAT_BC1_RGB_UNORM + 1 };
    _Static_assert(FORMATS == COLUMNS * ROWS, "a cell for each format");
    const enum rhw_format target = RHW_FORMAT_RGBA32_FLOAT;
    struct golden_board board;
    golden_board_make(&board, context, COLUMNS * SIDE, ROWS * SIDE, &target, 1);
    golden_board_begin(&board);
    // Magnified on the left, minified on the right.
    static const float corner[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};
    struct golden_vertex corners[6];
    for (int i = 0; i < 6; i++) {
        const float x = corner[i][0], y = corner[i][1], w = 1 + 2 * x;
        corners[i] = (struct golden_vertex){{(2 * x - 1) * w, (2 * y - 1) * w, 0, w}, {x, 2 * x * y, 0, 0}};
    }
    const struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_TEXTURE, target);
    const struct rhw_sampler_def state = rhw_sampler_def_default();
    rhw_sampler sampler;
    golden_check(rhw_sampler_create(context, &state, &sampler), "sampler");
    rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, corners, sizeof corners), 0);
    for (int i = 0; i < FORMATS; i++) {
        golden_cell(context, board.pass, i % COLUMNS, i / COLUMNS, SIDE, SIDE);
        const enum rhw_format format = (enum rhw_format)(RHW_FORMAT_BC1_RGB_UNORM + i);
        rhw_pass_set_texture(context, board.pass, 0, make_texture(context, format), sampler);
        rhw_pass_draw(context, board.pass, 0, 6, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
