// SPDX-License-Identifier: MIT
// Golden scenes of textures that are no plain 2D ones, and of anisotropy.
#include "golden_cells.h"
#include "golden_scenes.h"

#include <stdlib.h>

enum { KINDS = 7, SIDE = 40 };

// `components` of coordinates, without the layer.
static const struct {
    struct rhw_texture_def def;
    int components;
} kinds[KINDS] = {
    {{.format = RHW_FORMAT_RGBA8_UNORM, .width = 21, .kind = RHW_TEXTURE_1D}, 1},
    {{.format = RHW_FORMAT_RGBA32_FLOAT, .width = 16, .kind = RHW_TEXTURE_1D, .layers = 3}, 1},
    {{.format = RHW_FORMAT_RGBA8_SRGB, .width = 32, .height = 16}, 2},
    {{.format = RHW_FORMAT_RGBA8_SRGB, .width = 19, .height = 24, .layers = 4}, 2},
    {{.format = RHW_FORMAT_RGBA8_UNORM, .width = 12, .height = 9, .depth = 7, .kind = RHW_TEXTURE_3D}, 3},
    {{.format = RHW_FORMAT_RGBA32_FLOAT, .width = 8, .height = 8, .kind = RHW_TEXTURE_CUBE}, 3},
    {{.format = RHW_FORMAT_RGBA8_UNORM, .width = 9, .height = 9, .kind = RHW_TEXTURE_CUBE, .layers = 2}, 3},
};

static rhw_texture make(rhw_context *context, struct rhw_texture_def def)
{
    rhw_texture texture;
    def.mip_levels = RHW_MIP_LEVELS_ALL;
    golden_check(rhw_texture_create(context, &def, &texture), "texture");
    return texture;
}

static int slices_of(const rhw_context *context, rhw_texture texture)
{
    return rhw_texture_depth(context, texture, 0) * rhw_texture_layers(context, texture);
}

static rhw_texture filled(rhw_context *context, const struct rhw_texture_def *def)
{
    const rhw_texture texture = make(context, *def);
    const int count = rhw_texture_width(context, texture, 0) * rhw_texture_height(context, texture, 0);
    const bool floats = def->format == RHW_FORMAT_RGBA32_FLOAT;
    unsigned char *const bytes = malloc((size_t)count * 4);
    float *const numbers = malloc((size_t)count * 4 * sizeof *numbers);
    for (int slice = 0; bytes && numbers && slice < slices_of(context, texture); slice++) {
        for (int i = 0; i < count * 4; i++) {
            const int texel = i / 4, shade = texel * 7 + slice * 31 + i % 4 * 40;
            bytes[i] = (unsigned char)(shade % 5 == 0 ? 255 : shade % 200);
            numbers[i] = (float)bytes[i] / 255.0f;
        }
        golden_check(
            rhw_texture_write_layer(context, texture, 0, slice, floats ? (const void *)numbers : bytes, 0),
            "layer");
    }
    free(bytes);
    free(numbers);
    golden_check(rhw_texture_generate_mips(context, texture), "levels");
    return texture;
}

// A floor in perspective that fills the cell: coordinates of all kinds, far outside 0..1 and out of every layer.
static rhw_buffer receding(rhw_context *context)
{
    static const float corner[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}};
    struct golden_vertex vertices[6];
    for (int i = 0; i < 6; i++) {
        const float x = corner[i][0], y = corner[i][1], w = 1 + 5 * y;
        vertices[i] = (struct golden_vertex){{(2 * x - 1) * w, (2 * y - 1) * w, 0.5f * w, w},
                                             {3 * x - 1.25f, 4 * y - 1.1f, 3 * y + x - 1, 3 * x - y}};
    }
    return golden_buffer(context, vertices, sizeof vertices);
}

void golden_kinds_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { ROWS = GOLDEN_QUESTIONS + 2 };
    const enum rhw_format format = RHW_FORMAT_RGBA32_FLOAT;
    struct golden_board board;
    golden_board_make(&board, context, KINDS * SIDE, ROWS * SIDE, &format, 1);
    golden_board_begin(&board);
    const struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_KINDS, format);
    rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
    rhw_pass_set_vertex_buffer(context, board.pass, 0, receding(context), 0);
    for (int column = 0; column < KINDS; column++) {
        const rhw_texture texture = filled(context, &kinds[column].def);
        for (int row = 0; row < ROWS; row++) {
            // Below the questions: gradients again, with anisotropy and with the greatest texel.
            struct rhw_sampler_def state = {.address_u = (enum rhw_address)((row + column) % 4),
                                            .address_v = (enum rhw_address)(row % 4),
                                            .address_w = (enum rhw_address)(column % 4),
                                            .border = {1, 0.5f, 0, 0.5f}};
            state.max_anisotropy = row == GOLDEN_QUESTIONS ? 6 : 0;
            state.reduction = row > GOLDEN_QUESTIONS ? RHW_REDUCTION_MAX : RHW_REDUCTION_AVERAGE;
            rhw_sampler sampler;
            golden_check(rhw_sampler_create(context, &state, &sampler), "sampler");
            const struct golden_kind_uniforms uniforms = {row < GOLDEN_QUESTIONS ? row : GOLDEN_ASK_GRADIENT,
                                                          kinds[column].components};
            golden_cell(context, board.pass, column, row, SIDE, SIDE);
            rhw_pass_set_texture(context, board.pass, 0, texture, sampler);
            rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
            rhw_pass_draw(context, board.pass, 0, 6, 0, 1);
        }
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

// Draws into one layer, through the pattern of `plain`.
static void draw_layer(rhw_context *context, rhw_texture target, int layer, rhw_texture plain,
                       rhw_sampler sampler)
{
    struct rhw_pass_def def = rhw_pass_def_default();
    def.colors[0].texture = target;
    def.colors[0].layer = layer;
    def.colors[0].clear[layer % 3] = 0.25f;
    rhw_pass pass;
    golden_check(rhw_pass_begin(context, &def, &pass), "pass");
    const struct rhw_pipeline_def pipeline =
        golden_cells_def(GOLDEN_CELL_TEXTURE, rhw_texture_format(context, target));
    rhw_pass_set_pipeline(context, pass, golden_pipeline(context, &pipeline));
    rhw_pass_set_vertex_buffer(context, pass, 0, receding(context), 0);
    rhw_pass_set_texture(context, pass, 0, plain, sampler);
    const struct rhw_viewport part = {(float)layer,
                                      2,
                                      (float)rhw_texture_width(context, target, 0) * 0.75f,
                                      (float)rhw_texture_height(context, target, 0) * 0.75f,
                                      0,
                                      1};
    rhw_pass_set_viewport(context, pass, &part);
    rhw_pass_draw(context, pass, 0, 6, 0, 1);
    golden_check(rhw_pass_end(context, pass, NULL), "pass");
}

void golden_layers_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    static const struct rhw_texture_def targets[] = {
        {.format = RHW_FORMAT_RGBA8_SRGB, .width = 70, .height = 33, .layers = 3},
        {.format = RHW_FORMAT_RGBA8_UNORM, .width = 24, .height = 20, .depth = 5, .kind = RHW_TEXTURE_3D},
        {.format = RHW_FORMAT_RGBA16_FLOAT, .width = 20, .height = 20, .kind = RHW_TEXTURE_CUBE},
    };
    enum { TARGETS = sizeof targets / sizeof *targets, LARGE = 96 };
    const enum rhw_format format = RHW_FORMAT_RGBA32_FLOAT;
    const struct rhw_sampler_def state = {0};
    const rhw_texture plain = filled(context, &kinds[2].def);
    rhw_sampler sampler;
    golden_check(rhw_sampler_create(context, &state, &sampler), "sampler");
    rhw_texture drawn[TARGETS];
    for (int i = 0; i < TARGETS; i++) {
        drawn[i] = make(context, targets[i]);
        for (int layer = 0; layer < slices_of(context, drawn[i]); layer++) {
            draw_layer(context, drawn[i], layer, plain, sampler);
        }
        golden_check(rhw_texture_generate_mips(context, drawn[i]), "levels");
    }
    struct golden_board board;
    golden_board_make(&board, context, TARGETS * LARGE, LARGE, &format, 1);
    golden_board_begin(&board);
    const struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_KINDS, format);
    rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
    rhw_pass_set_vertex_buffer(context, board.pass, 0, receding(context), 0);
    for (int i = 0; i < TARGETS; i++) {
        const struct golden_kind_uniforms uniforms = {GOLDEN_ASK_GRADIENT, i == 0 ? 2 : 3};
        golden_cell(context, board.pass, i, 0, LARGE, LARGE);
        rhw_pass_set_texture(context, board.pass, 0, drawn[i], sampler);
        rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
        rhw_pass_draw(context, board.pass, 0, 6, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

// Views of the textures above, by number, and components of their coordinates, without the layer.
static const struct {
    int parent;
    struct rhw_texture_view_def def;
    int components;
} views[] = {
    {1, {.kind = RHW_TEXTURE_1D, .layer = 2, .swizzle = {RHW_SWIZZLE_BLUE, RHW_SWIZZLE_ONE}}, 1},
    {2, {.format = RHW_FORMAT_RGBA8_UNORM, .level = 1}, 2},
    {2, {.layers = 1, .swizzle = {RHW_SWIZZLE_ALPHA, RHW_SWIZZLE_RED, RHW_SWIZZLE_ZERO}}, 2},
    {3, {.layer = 3, .levels = 2}, 2},
    {4, {.layer = 2}, 2},
    {4, {.kind = RHW_TEXTURE_3D, .level = 1}, 3},
    {5, {.layer = 4}, 2},
    {6, {.layer = 1, .layers = 9, .level = 1}, 2},
    {6, {.kind = RHW_TEXTURE_CUBE, .layer = 5, .format = RHW_FORMAT_RGBA8_SRGB}, 3},
};

// Asked as the textures are; then drawn into, and their textures kept.
void golden_views_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { VIEWS = sizeof views / sizeof *views };
    const enum rhw_format format = RHW_FORMAT_RGBA32_FLOAT;
    struct golden_board board;
    golden_board_make(&board, context, VIEWS * SIDE, GOLDEN_QUESTIONS * SIDE, &format, 1);
    golden_board_begin(&board);
    const struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_KINDS, format);
    rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
    rhw_pass_set_vertex_buffer(context, board.pass, 0, receding(context), 0);
    const struct rhw_sampler_def state = {.address_v = RHW_ADDRESS_MIRROR};
    rhw_sampler sampler;
    golden_check(rhw_sampler_create(context, &state, &sampler), "sampler");
    rhw_texture parents[VIEWS], made[VIEWS];
    for (int column = 0; column < VIEWS; column++) {
        struct rhw_texture_view_def view = views[column].def;
        view.texture = parents[column] = filled(context, &kinds[views[column].parent].def);
        golden_check(rhw_texture_view_create(context, &view, &made[column]), "view");
        for (int row = 0; row < GOLDEN_QUESTIONS; row++) {
            const struct golden_kind_uniforms uniforms = {row, views[column].components};
            golden_cell(context, board.pass, column, row, SIDE, SIDE);
            rhw_pass_set_texture(context, board.pass, 0, made[column], sampler);
            rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
            rhw_pass_draw(context, board.pass, 0, 6, 0, 1);
        }
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
    const rhw_texture plain = filled(context, &kinds[2].def);
    for (int i = 0; i < VIEWS; i++) {
        if (views[i].def.swizzle[0] == RHW_SWIZZLE_IDENTITY) {
            draw_layer(context, made[i], slices_of(context, made[i]) - 1, plain, sampler);
            golden_keep(images, context, made[i]);
            golden_keep(images, context, parents[i]);
        }
    }
}
