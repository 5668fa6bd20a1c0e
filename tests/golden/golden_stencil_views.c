// SPDX-License-Identifier: MIT
// The golden scene of stencil that shaders read: a pass counts layers in it, of every format that has one, and the next
// samples views of it as bytes, with channels swapped and mirrored.
#include "golden_cells.h"
#include "golden_scenes.h"

enum { SIDE = 48, FORMATS = 3, LAYERS = 9 };

static const enum rhw_format formats[FORMATS] = {RHW_FORMAT_S8_UINT, RHW_FORMAT_D24_UNORM_S8_UINT,
                                                 RHW_FORMAT_D32_FLOAT_S8_UINT};

// Triangles above each other, each of which counts up where it is drawn.
static void count_layers(rhw_context *context, rhw_texture stencil, int first)
{
    struct golden_vertex vertices[3 * LAYERS];
    uint64_t random = 27;
    for (int i = 0; i < 3 * LAYERS; i++) {
        const float w = 1 + (float)(i % 4);
        for (int c = 0; c < 4; c++) {
            vertices[i].position[c] = c == 3   ? w
                                      : c == 2 ? 0.5f * w
                                               : golden_random(&random, -1.2f, 1.2f) * w;
            vertices[i].value[c] = 1;
        }
    }
    struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, RHW_FORMAT_NONE);
    def.stencil_test = true;
    def.stencil_front.pass = def.stencil_back.pass = RHW_STENCIL_INCREMENT_WRAP;
    def.target_count = 0;
    struct rhw_pass_def pass_def = rhw_pass_def_default();
    rhw_pass pass;
    pass_def.color_count = 0;
    pass_def.depth = (struct rhw_depth_attachment){
        .enabled = true, .texture = stencil, .clear = 0.5f, .stencil_clear = (uint8_t)first};
    golden_check(rhw_pass_begin(context, &pass_def, &pass), "pass");
    const struct golden_cell_uniforms uniforms = {.targets = 0};
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    rhw_pass_set_pipeline(context, pass, golden_pipeline(context, &def));
    rhw_pass_set_vertex_buffer(context, pass, 0, golden_buffer(context, vertices, sizeof vertices), 0);
    rhw_pass_draw(context, pass, 0, 3 * LAYERS, 0, 1);
    golden_check(rhw_pass_end(context, pass, NULL), "pass");
}

void golden_stencil_views_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { VIEWS = 3 };
    static const enum rhw_swizzle swizzles[VIEWS][4] = {
        {0},
        {RHW_SWIZZLE_ALPHA, RHW_SWIZZLE_RED, RHW_SWIZZLE_RED, RHW_SWIZZLE_ZERO},
        {RHW_SWIZZLE_ONE, RHW_SWIZZLE_BLUE}};
    const enum rhw_format target = RHW_FORMAT_RGBA32_UINT;
    const struct rhw_sampler_def state = {.min_filter = RHW_FILTER_NEAREST,
                                          .mag_filter = RHW_FILTER_NEAREST,
                                          .address_u = RHW_ADDRESS_MIRROR,
                                          .address_v = RHW_ADDRESS_MIRROR};
    static const struct golden_vertex corners[] = {
        {{-1, -1, 0, 1}, {-1.5f, -0.5f, 0, 0}}, {{2, -2, 0, 2}, {1.5f, -0.25f, 0, 0}},
        {{-1, 1, 0, 1}, {-1, 2, 0, 0}},         {{-1, 1, 0, 1}, {-1, 2, 0, 0}},
        {{2, -2, 0, 2}, {1.5f, -0.25f, 0, 0}},  {{1, 1, 0, 1}, {2, 1.5f, 0, 0}}};
    struct golden_board board;
    rhw_texture stencils[FORMATS];
    rhw_sampler sampler;
    for (int i = 0; i < FORMATS; i++) {
        stencils[i] = golden_texture(context, formats[i], SIDE + i, SIDE - 5 * i, 1);
        count_layers(context, stencils[i], 100 * i + 50);
    }
    golden_board_make(&board, context, FORMATS * SIDE, VIEWS * SIDE, &target, 1);
    golden_check(rhw_sampler_create(context, &state, &sampler), "sampler");
    golden_board_begin(&board);
    const struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_TEXTURE, target);
    rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, corners, sizeof corners), 0);
    for (int cell = 0; cell < FORMATS * VIEWS; cell++) {
        struct rhw_texture_view_def view = {.texture = stencils[cell % FORMATS],
                                            .format = RHW_FORMAT_R8_UINT};
        rhw_texture made;
        for (int c = 0; c < 4; c++) {
            view.swizzle[c] = swizzles[cell / FORMATS][c];
        }
        golden_check(rhw_texture_view_create(context, &view, &made), "view");
        golden_cell(context, board.pass, cell % FORMATS, cell / FORMATS, SIDE, SIDE);
        rhw_pass_set_texture(context, board.pass, 0, made, sampler);
        rhw_pass_draw(context, board.pass, 0, 6, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
