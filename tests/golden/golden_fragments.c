// SPDX-License-Identifier: MIT
// Golden scenes of what fragment functions see and do: builtins, derivatives, depth, discard, maths, and the
// one-at-a-time form.
#include "golden_cells.h"
#include "golden_scenes.h"

#include <rhw/shader.h>

#include <string.h>

static void use(const struct golden_board *board, const struct rhw_pipeline_def *def)
{
    rhw_pass_set_pipeline(board->context, board->pass, golden_pipeline(board->context, def));
}

// A tilted quad whose far side is ten times as far, a back face, slivers, and a triangle from behind the eye.
static rhw_buffer assembly(rhw_context *context)
{
    static const struct golden_vertex vertices[] = {
        {{-0.9f, -0.9f, 0.2f, 1}, {0, 0, 0, 0}},
        {{0.9f, -0.9f, 0.2f, 1}, {1, 0, 1, 0}},
        {{-8, 4, 9, 10}, {0, 1, 0, 1}},
        {{-8, 4, 9, 10}, {0, 1, 0, 1}},
        {{0.9f, -0.9f, 0.2f, 1}, {1, 0, 1, 0}},
        {{8, 9, 9, 10}, {1, 1, 1, 1}},
        {{-0.2f, 0.9f, 0.1f, 1}, {1, 0, 0, 0.5f}},
        {{0.8f, 0.2f, 0.4f, 1}, {0, 1, 0, 0.5f}},
        {{0.1f, 0.5f, 0.1f, 2}, {0, 0, 1, 0.5f}},
        {{-0.95f, -0.95f, 0, 1}, {1, 1, 0, 1}},
        {{-0.94f, -0.95f, 0, 1}, {0, 1, 1, 1}},
        {{0.95f, 0.99f, 0, 1}, {1, 0, 1, 1}},
        {{-0.9f, 0.7f, 0.05f, 0.5f}, {0, 0.3f, 0.9f, 0}},
        {{-0.2f, -2, 0.1f, -0.3f}, {0.5f, 0, 0, 1}},
        {{-0.3f, 0.4f, 0.05f, 0.5f}, {0.2f, 0.9f, 0, 0}},
    };
    return golden_buffer(context, vertices, sizeof vertices);
}

void golden_builtins_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 128, COUNT = 8 };
    enum rhw_format formats[COUNT + 1];
    for (int i = 0; i < COUNT; i++) {
        formats[i] = RHW_FORMAT_RGBA32_FLOAT;
    }
    formats[COUNT - 1] = RHW_FORMAT_R32_UINT;
    formats[COUNT] = RHW_FORMAT_D32_FLOAT;
    struct golden_board board;
    golden_board_make(&board, context, SIDE, SIDE, formats, COUNT + 1);
    golden_board_begin(&board);
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_BUILTINS, formats[0]);
    for (int i = 0; i < COUNT; i++) {
        def.targets[i] = (struct rhw_color_target){.format = formats[i], .write_mask = 15};
    }
    def.target_count = COUNT;
    def.depth_test = true;
    rhw_pass_set_vertex_buffer(context, board.pass, 0, assembly(context), 0);
    for (int qualifier = 0; qualifier < 2; qualifier++) {
        def.program.varyings[0].qualifier = (enum rhw_qualifier)qualifier;
        use(&board, &def);
        rhw_pass_draw(context, board.pass, qualifier ? 6 : 0, qualifier ? 9 : 6, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

// Two slopes in perspective, one of which is cut; 1, 4 and 8 samples, from centres, centroids and samples.
void golden_offsets_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 64, SAMPLINGS = RHW_SAMPLING_SAMPLE + 1 };
    static const int counts[] = {1, 4, 8};
    static const struct golden_vertex vertices[] = {
        {{-0.9f, -0.9f, 0, 1}, {0, 1, 0.3f, 1}},       {{3.2f, -3.6f, 2, 4}, {1, 0, 0.9f, 4}},
        {{0, 1.8f, 1, 2}, {0.5f, -1, 0.1f, 2}},        {{-2.8f, 0.4f, 1, 3}, {1, 1, 0, 3}},
        {{0.4f, 0.1f, 0.2f, -0.5f}, {0, 1, 1, -0.5f}}, {{0.9f, 0.8f, 0.3f, 1}, {0, 0.2f, 1, 1}}};
    const enum rhw_format format = RHW_FORMAT_RGBA32_FLOAT;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        struct golden_board board;
        golden_board_make(&board, context, SAMPLINGS * SIDE, SIDE, &format, 1);
        board.def.samples = counts[i];
        golden_board_begin(&board);
        rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, vertices, sizeof vertices),
                                   0);
        for (int sampling = 0; sampling < SAMPLINGS; sampling++) {
            struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_OFFSET, format);
            def.program.varyings[0].sampling = (enum rhw_sampling)sampling;
            golden_cell(context, board.pass, sampling, 0, SIDE, SIDE);
            rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
            rhw_pass_draw(context, board.pass, 0, 6, 0, 1);
        }
        golden_board_end(&board);
        golden_board_keep(&board, images);
    }
}

void golden_heights_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 160 };
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_D32_FLOAT};
    struct golden_board board;
    golden_board_make(&board, context, SIDE, SIDE, formats, 2);
    golden_board_begin(&board);
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_HEIGHTS, formats[0]);
    def.depth_test = true;
    rhw_pass_set_vertex_buffer(context, board.pass, 0, assembly(context), 0);
    use(&board, &def);
    rhw_pass_draw(context, board.pass, 0, 15, 0, 1);
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

void golden_maths_draw(rhw_context *context, int number, struct golden_images *images)
{
    enum { COLUMNS = 8, ROWS = 4, CELL = 32 };
    const enum rhw_format format = RHW_FORMAT_R32_FLOAT;
    static const float ranges[][2] = {{-1.25f, 1.25f}, {0, 12}, {-30000, 30000}};
    const int count = number == 0 ? 3 : 1;
    for (int i = 0; i < count; i++) {
        struct golden_board board;
        golden_board_make(&board, context, COLUMNS * CELL, ROWS * CELL, &format, 1);
        golden_board_begin(&board);
        struct rhw_pipeline_def def = rhw_pipeline_def_default();
        golden_cells_fill(&def.program, GOLDEN_CELL_SCREEN, GOLDEN_CELL_MATHS);
        def.program.varyings[0] = (struct rhw_varying){.components = 4, .qualifier = RHW_NOPERSPECTIVE};
        def.program.varying_count = 1;
        def.targets[0].format = format;
        const struct golden_cell_uniforms uniforms = {1, ranges[i][0], ranges[i][1], number};
        rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
        use(&board, &def);
        rhw_pass_draw(context, board.pass, 0, 3, 0, 1);
        golden_board_end(&board);
        golden_board_keep(&board, images);
    }
}

static void single_vertex(struct rhw_vertex1 *vertex)
{
    const float turn = rhw_sin1((float)vertex->vertex_index) * 0.02f;
    for (int c = 0; c < 4; c++) {
        vertex->position[c] = vertex->attribute[0][c] + (c < 2 ? turn * vertex->attribute[0][3] : 0);
        vertex->varying[c] = vertex->attribute[1][c];
    }
    vertex->varying[4] = (float)vertex->instance_index;
}

static void single_fragment(struct rhw_fragment1 *fragment)
{
    const float *const v = fragment->varying;
    const float grad[4] = {fragment->ddx[0], fragment->ddx[1], fragment->ddy[0], fragment->ddy[1]};
    float texel[4];
    rhw_sample_grad1(fragment->bindings, 0, v, grad, texel);
    const float wave = rhw_pow1(0.5f + 0.5f * rhw_cos1(fragment->coord[0] * 0.3f), 2.2f);
    fragment->discard = fragment->front_facing && v[0] + v[1] < 0.1f;
    fragment->depth += 0.01f * wave;
    fragment->color[0][0] = texel[0] * (0.5f + 0.5f * wave);
    fragment->color[0][1] = texel[1] * fragment->barycentric[0];
    fragment->color[0][2] = fragment->barycentric_noperspective[1] + rhw_atan2_1(v[1], v[0]) * 0.1f;
    fragment->color[0][3] = 1 - 0.1f * (float)fragment->primitive - v[4];
    for (int c = 0; c < 3; c++) {
        fragment->color[1][c] = fragment->barycentric_ddx[c] * 16 + fragment->barycentric_ddy[c] * 8 + 0.5f;
    }
    fragment->color[1][3] = (float)(fragment->instance + fragment->draw);
}

void golden_single_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { SIDE = 128 };
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_SRGB, RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_D32_FLOAT};
    unsigned char texels[16][16][4];
    for (int i = 0; i < 16 * 16; i++) {
        const unsigned char texel[4] = {(unsigned char)(i % 16 * 16), (i / 16 + i) % 2 ? 255 : 80, 90, 255};
        memcpy(texels[i / 16][i % 16], texel, 4);
    }
    const rhw_texture texture = golden_texture(context, RHW_FORMAT_RGBA8_UNORM, 16, 16, RHW_MIP_LEVELS_ALL);
    rhw_texture_write(context, texture, 0, texels, 0);
    golden_check(rhw_texture_generate_mips(context, texture), "levels");
    const struct rhw_sampler_def state = rhw_sampler_def_default();
    rhw_sampler trilinear;
    golden_check(rhw_sampler_create(context, &state, &trilinear), "sampler");
    struct golden_board board;
    golden_board_make(&board, context, SIDE, SIDE, formats, 3);
    golden_board_begin(&board);
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, formats[0]);
    memset(&def.program, 0, sizeof def.program);
    def.program.vertex1 = single_vertex;
    def.program.fragment1 = single_fragment;
    def.program.varyings[0] = (struct rhw_varying){.components = 4, .derivatives = true};
    def.program.varyings[1] = (struct rhw_varying){.components = 1, .qualifier = RHW_FLAT};
    def.program.varying_count = 2;
    def.program.uses = RHW_USE_COORD | RHW_USE_FACING | RHW_USE_IDS | RHW_USE_BARYCENTRIC | RHW_USE_DISCARD |
                       RHW_USE_DEPTH | RHW_USE_BARYCENTRIC_DERIVATIVES;
    def.targets[1] = (struct rhw_color_target){.format = formats[1], .write_mask = 15};
    def.target_count = 2;
    def.depth_test = true;
    use(&board, &def);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, assembly(context), 0);
    rhw_pass_set_texture(context, board.pass, 0, texture, trilinear);
    rhw_pass_draw(context, board.pass, 0, 15, 0, 1);
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
