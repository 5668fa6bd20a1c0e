// SPDX-License-Identifier: MIT
// Golden scenes of sampling: every state of a sampler, every format and level, and textures just drawn.
#include "golden_cells.h"
#include "golden_scenes.h"

#include "base/half.h"

#include <stdlib.h>
#include <string.h>

static void use(const struct golden_board *board, const struct rhw_pipeline_def *def)
{
    rhw_pass_set_pipeline(board->context, board->pass, golden_pipeline(board->context, def));
}

static rhw_sampler sampler(rhw_context *context, const struct rhw_sampler_def *def)
{
    rhw_sampler made;
    golden_check(rhw_sampler_create(context, def, &made), "sampler");
    return made;
}

// Texel x, y of a pattern that tells left from right and top from bottom; 0..1 unless `wild`.
static float pattern(int x, int y, int channel, bool wild)
{
    static const float odd[] = {-2, 100, 1e-40f, 60000, 0.001f};
    const bool dark = (x / 4 + y / 3) % 2;
    const float value[4] = {dark ? 0.1f : 1.0f - (float)y / 40, dark ? (float)x / 60 : 0.9f,
                            dark ? 0.4f : (float)x / 50, (float)((x + y) % 17) / 16};
    return wild && (x * 7 + y * 3) % 11 == 0 ? odd[(x + y + channel) % 5] : value[channel];
}

static rhw_texture make_texture(rhw_context *context, enum rhw_format format, int width, int height)
{
    const rhw_texture texture = golden_texture(context, format, width, height, RHW_MIP_LEVELS_ALL);
    const size_t size = rhw_format_size(format);
    unsigned char *const texels = calloc((size_t)width * (size_t)height, size);
    for (int i = 0; texels != NULL && i < width * height; i++) {
        unsigned char *const at = texels + (size_t)i * size;
        const bool floats = format == RHW_FORMAT_RGBA16_FLOAT || format == RHW_FORMAT_RGBA32_FLOAT;
        for (int c = 0; c < 4; c++) {
            const float value = pattern(i % width, i / width, c, floats);
            const uint16_t half = rhw_half_from_float(value);
            if (format == RHW_FORMAT_RGBA16_FLOAT) {
                memcpy(at + 2 * c, &half, sizeof half);
            } else if (size >= 4 * sizeof value * (size_t)(c + 1) / 4 && size != 4) {
                memcpy(at + 4 * c, &value, sizeof value);
            } else if (c == 0 && (format == RHW_FORMAT_R32_FLOAT || format == RHW_FORMAT_D32_FLOAT)) {
                memcpy(at, &value, sizeof value);
            } else if ((size_t)c < size && format != RHW_FORMAT_R32_FLOAT && format != RHW_FORMAT_D32_FLOAT) {
                at[c] = (unsigned char)(value * 255.0f);
            }
        }
    }
    rhw_texture_write(context, texture, 0, texels, 0);
    free(texels);
    golden_check(rhw_texture_generate_mips(context, texture), "levels");
    return texture;
}

// A floor in perspective under a piece of wall: minified, magnified, and coordinates far outside 0..1.
static rhw_buffer floor_and_wall(rhw_context *context)
{
    static const float corner[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};
    struct golden_vertex vertices[18];
    for (int i = 0; i < 6; i++) {
        const float x = corner[i][0], y = corner[i][1], w = 1 + 9 * y;
        vertices[i] =
            (struct golden_vertex){{(2 * x - 1) * w * (1 - 0.2f * y), (1.1f * y - 1) * w, 0.5f * w, w},
                                   {3 * x - 1, 7 * y - 2.5f, 0, 0}};
        vertices[6 + i] = (struct golden_vertex){{2 * x - 1, 0.1f + 0.9f * y, 0.5f, 1},
                                                 {1.5f * x - 0.25f, 1.2f - 1.4f * y + 0.3f * x, 0, 0}};
        vertices[12 + i] = (struct golden_vertex){{2 * x - 1, 2 * y - 1, 0.5f, 1}, {x, 1 - y, 0, 0}};
    }
    return golden_buffer(context, vertices, sizeof vertices);
}

void golden_sampler_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 40, COLUMNS = 12, ROWS = 6 };
    const enum rhw_format format = RHW_FORMAT_RGBA8_SRGB;
    const rhw_texture texture = make_texture(context, RHW_FORMAT_RGBA8_SRGB, 37, 24);
    const rhw_texture square = make_texture(context, RHW_FORMAT_RGBA8_UNORM, 32, 32);
    struct golden_board board;
    golden_board_make(&board, context, COLUMNS * SIDE, ROWS * SIDE, &format, 1);
    golden_board_begin(&board);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, floor_and_wall(context), 0);
    const struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_TEXTURE, format);
    use(&board, &def);
    for (int cell = 0; cell < COLUMNS * ROWS; cell++) {
        // Columns: both filters with each mip filter. Rows: addresses, then bounds and bias of the level.
        const int column = cell % COLUMNS, row = cell / COLUMNS;
        struct rhw_sampler_def state = rhw_sampler_def_default();
        state.min_filter = column % 2 ? RHW_FILTER_LINEAR : RHW_FILTER_NEAREST;
        state.mag_filter = column / 2 % 2 ? RHW_FILTER_LINEAR : RHW_FILTER_NEAREST;
        state.mip_filter = (enum rhw_mip_filter)(RHW_MIP_FILTER_NONE - column / 4);
        state.address_u = (enum rhw_address)(row % 4);
        state.address_v = (enum rhw_address)((row + column) % 4);
        memcpy(state.border, (const float[]){1, 0.5f, 0, 0.5f}, sizeof state.border);
        if (row == 4) {
            state.lod_bias = (float)column * 0.625f - 3;
            state.lod_max = 3.5f;
        } else if (row == 5) {
            state.lod_min = (float)(column % 4) * 0.375f;
            state.lod_max = (float)(column % 3) + 1.25f;
        }
        golden_cell(context, board.pass, column, row, SIDE, SIDE);
        rhw_pass_set_texture(context, board.pass, 0, row % 2 ? square : texture, sampler(context, &state));
        rhw_pass_draw(context, board.pass, 0, 12, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_texel_draw(rhw_context *context, int number, struct golden_images *images)
{
    enum { SIDE = 48, LEVELS = 6 };
    static const enum rhw_format sampled[] = {
        RHW_FORMAT_R8_UNORM,     RHW_FORMAT_RG8_UNORM, RHW_FORMAT_RGBA8_UNORM,  RHW_FORMAT_RGBA8_SRGB,
        RHW_FORMAT_RGBA16_FLOAT, RHW_FORMAT_R32_FLOAT, RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_D32_FLOAT};
    enum { COUNT = sizeof sampled / sizeof *sampled };
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA32_FLOAT};
    struct golden_board board;
    golden_board_make(&board, context, COUNT * SIDE, (LEVELS + 1) * SIDE, formats, 1);
    golden_board_begin(&board);
    struct golden_vertex corners[6 * LEVELS];
    static const float corner[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};
    for (int i = 0; i < 6 * LEVELS; i++) {
        const float x = corner[i % 6][0], y = corner[i % 6][1];
        corners[i] = (struct golden_vertex){{2 * x - 1, 2 * y - 1, 0, 1},
                                            {1.5f * x - 0.25f, y, (float)(i / 6) * 0.875f, 0}};
    }
    const rhw_buffer levels = golden_buffer(context, corners, sizeof corners),
                     perspective = floor_and_wall(context);
    struct rhw_sampler_def state = rhw_sampler_def_default();
    state.address_u = number == 0 ? RHW_ADDRESS_MIRROR : RHW_ADDRESS_MIRROR_ONCE;
    const rhw_sampler linear = sampler(context, &state);
    const struct rhw_pipeline_def by_level = golden_cells_def(GOLDEN_CELL_LEVEL, formats[0]),
                                  by_slope = golden_cells_def(GOLDEN_CELL_TEXTURE, formats[0]);
    for (int i = 0; i < COUNT; i++) {
        // Odd sizes, and one that is a power of two.
        const rhw_texture texture = make_texture(context, sampled[i], i == 2 ? 32 : 45, i == 2 ? 16 : 29);
        rhw_pass_set_texture(context, board.pass, 0, texture, linear);
        use(&board, &by_level);
        rhw_pass_set_vertex_buffer(context, board.pass, 0, levels, 0);
        for (int row = 0; row < LEVELS; row++) {
            golden_cell(context, board.pass, i, row, SIDE, SIDE);
            rhw_pass_draw(context, board.pass, (uint32_t)row * 6, 6, 0, 1);
        }
        use(&board, &by_slope);
        rhw_pass_set_vertex_buffer(context, board.pass, 0, perspective, 0);
        golden_cell(context, board.pass, i, LEVELS, SIDE, SIDE);
        rhw_pass_draw(context, board.pass, 0, 12, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_chain_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 120 };
    // Each pass draws the last one's target, turned a little in perspective, over a pattern; depth at the end.
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_RGBA16_FLOAT,
                                       RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_RGBA8_UNORM};
    rhw_texture last = make_texture(context, RHW_FORMAT_RGBA8_UNORM, 30, 30);
    const struct rhw_sampler_def state = {.min_filter = RHW_FILTER_LINEAR,
                                          .mag_filter = RHW_FILTER_LINEAR,
                                          .address_u = RHW_ADDRESS_BORDER,
                                          .address_v = RHW_ADDRESS_CLAMP,
                                          .border = {0.25f, 0.25f, 0, 1},
                                          .lod_max = 1000};
    const rhw_sampler bordered = sampler(context, &state);
    const rhw_buffer buffer = floor_and_wall(context);
    for (int i = 0; i < 5; i++) {
        struct golden_board board;
        const enum rhw_format pair[] = {formats[i % 4], RHW_FORMAT_D32_FLOAT};
        golden_board_make(&board, context, SIDE, SIDE, pair, 2);
        golden_board_begin(&board);
        struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_TEXTURE, pair[0]);
        def.depth_test = true;
        use(&board, &def);
        rhw_pass_set_vertex_buffer(context, board.pass, 0, buffer, 0);
        rhw_pass_set_texture(context, board.pass, 0, last, bordered);
        const struct rhw_viewport corner = {10, 8, SIDE - 16, SIDE - 20, 0, 1};
        rhw_pass_set_viewport(context, board.pass, &corner);
        rhw_pass_draw(context, board.pass, i % 2 ? 0 : 12, i % 2 ? 12 : 6, 0, 1);
        golden_board_end(&board);
        golden_keep(images, context, board.targets[0]);
        last = i == 3 ? board.targets[1] : board.targets[0];
    }
}
