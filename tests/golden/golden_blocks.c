// SPDX-License-Identifier: MIT
// The golden scenes of compressed formats: random blocks of each, in two levels that end within a block; and parts of such
// levels written, by the caller and from a buffer.
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

// Random blocks in place of those of the first level from `x`, `y` on, `columns` × `rows`, which may end with the level.
static void write_part(rhw_context *context, rhw_texture texture, int x, int y, int columns, int rows,
                       bool from_buffer)
{
    const enum rhw_format format = rhw_texture_format(context, texture);
    const int block_width = rhw_format_block_width(format), block_height = rhw_format_block_height(format);
    const size_t bytes = rhw_format_block_bytes(format);
    struct rhw_texture_region region = {.x = x * block_width, .y = y * block_height};
    unsigned char blocks[16 * 64];
    uint64_t random = (uint64_t)(1000 + format);
    region.width = WIDTH - region.x < columns * block_width ? WIDTH - region.x : columns * block_width;
    region.height = HEIGHT - region.y < rows * block_height ? HEIGHT - region.y : rows * block_height;
    for (int i = 0; i < columns * rows; i++) {
        random_block(format, &random, blocks + (size_t)i * bytes);
    }
    if (from_buffer) {
        const rhw_buffer buffer = golden_buffer(context, blocks, (size_t)(columns * rows) * bytes);
        const struct rhw_texel_layout layout = {.row_length = columns * block_width};
        golden_check(rhw_texture_copy_from_buffer(context, texture, &region, buffer, &layout), "part");
    } else {
        golden_check(rhw_texture_write_region(context, texture, &region, blocks, (size_t)columns * bytes, 0),
                     "part");
    }
}

static rhw_texture make_of_parts(rhw_context *context, enum rhw_format format)
{
    const rhw_texture texture = make_texture(context, format);
    const int columns = (WIDTH - 1) / rhw_format_block_width(format),
              rows = (HEIGHT - 1) / rhw_format_block_height(format); // of the last block
    write_part(context, texture, 1, 0, 2, 2, false);
    write_part(context, texture, columns, rows, 1, 1, false);
    write_part(context, texture, 0, rows - 1, 2, 2, true);
    write_part(context, texture, columns - 1, 0, 2, 1, true);
    return texture;
}

void golden_blocks_draw(rhw_context *context, int number, struct golden_images *images)
{
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
        const rhw_texture texture =
            number == 0 ? make_texture(context, format) : make_of_parts(context, format);
        rhw_pass_set_texture(context, board.pass, 0, texture, sampler);
        rhw_pass_draw(context, board.pass, 0, 6, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
