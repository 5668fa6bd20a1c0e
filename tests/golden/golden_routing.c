// SPDX-License-Identifier: MIT
// The golden scene of viewports and layers that the vertex function names.
#include "golden_cells.h"
#include "golden_scenes.h"

enum { SIDE = 80, FACES = 6, TRIANGLES = 60, LARGE = 128 };

// Anywhere in the view and a little outside, behind the eye too.
static rhw_buffer triangles(rhw_context *context)
{
    struct golden_vertex vertices[3 * TRIANGLES];
    uint64_t random = 7;
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        const float w = i % 23 == 7 ? -0.4f : golden_random(&random, 0.5f, 2);
        vertices[i].position[0] = golden_random(&random, -1.1f, 1.1f) * w;
        vertices[i].position[1] = golden_random(&random, -1.1f, 1.1f) * w;
        vertices[i].position[2] = golden_random(&random, -0.1f, 1.05f) * w;
        vertices[i].position[3] = w;
        for (int c = 0; c < 4; c++) {
            vertices[i].value[c] = golden_random(&random, 0.2f, 1);
        }
    }
    return golden_buffer(context, vertices, sizeof vertices);
}

static rhw_texture draw_cube(rhw_context *context)
{
    static const struct rhw_viewport views[4] = {{0, 0, SIDE, SIDE, 0, 0},
                                                 {4.5f, 3.25f, 30, 50, 0, 0.5f},
                                                 {40, -10, 60, 70, 1, 0},
                                                 {10, 45, 66, 30, 0.2f, 0.7f}};
    static const struct rhw_rect scissors[2] = {{45, 0, 30, 50}, {0, 50, 70, 20}};
    const struct rhw_texture_def cube = {
        .format = RHW_FORMAT_RGBA8_UNORM, .width = SIDE, .height = SIDE, .kind = RHW_TEXTURE_CUBE};
    rhw_texture texture;
    golden_check(rhw_texture_create(context, &cube, &texture), "texture");
    struct rhw_pass_def def = {
        .color_count = 1,
        .colors = {{.texture = texture, .layer_count = FACES, .clear = {0.1f, 0, 0.2f, 1}}},
        .depth = {.enabled = true, .clear = 1, .store = RHW_STORE_DISCARD}};
    rhw_pass pass;
    golden_check(rhw_pass_begin(context, &def, &pass), "pass");
    struct rhw_pipeline_def pipeline = golden_cells_def(GOLDEN_CELL_ROUTE, RHW_FORMAT_RGBA8_UNORM);
    golden_cells_fill(&pipeline.program, GOLDEN_CELL_ROUTED, GOLDEN_CELL_ROUTE);
    pipeline.depth_test = true;
    rhw_pass_set_vertex_buffer(context, pass, 0, triangles(context), 0);
    rhw_pass_set_viewports(context, pass, 0, 4, views);
    rhw_pass_set_scissors(context, pass, 2, 2, scissors);
    for (int part = 0; part < 2; part++) { // triangles, then lines; the last instance has no layer
        pipeline.topology = part == 0 ? RHW_TRIANGLE_LIST : RHW_LINE_STRIP;
        pipeline.provoking = part == 0 ? RHW_PROVOKING_FIRST : RHW_PROVOKING_LAST;
        rhw_pass_set_pipeline(context, pass, golden_pipeline(context, &pipeline));
        rhw_pass_draw(context, pass, 0, part == 0 ? 3 * TRIANGLES : 40, 0, FACES + 1);
    }
    golden_check(rhw_pass_end(context, pass, NULL), "pass");
    return texture;
}

void golden_routing_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    const enum rhw_format format = RHW_FORMAT_RGBA8_UNORM;
    const struct rhw_sampler_def state = {0};
    const rhw_texture cube = draw_cube(context);
    rhw_sampler sampler;
    golden_check(rhw_sampler_create(context, &state, &sampler), "sampler");
    struct golden_board board;
    golden_board_make(&board, context, FACES * LARGE, LARGE, &format, 1);
    golden_board_begin(&board);
    const struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_KINDS, format);
    const struct golden_kind_uniforms uniforms = {GOLDEN_ASK_GRADIENT, 3};
    rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
    rhw_pass_set_texture(context, board.pass, 0, cube, sampler);
    rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
    for (int face = 0; face < FACES; face++) {
        struct golden_vertex corners[3]; // a triangle over the cell; directions to the face and a little more
        for (int i = 0; i < 3; i++) {
            const float x = i == 1 ? 3 : -1, y = i == 2 ? 3 : -1;
            corners[i] = (struct golden_vertex){.position = {x, y, 0.5f, 1}};
            corners[i].value[face / 2] = face % 2 == 0 ? 1 : -1;
            corners[i].value[(face / 2 + 1) % 3] = 1.2f * x;
            corners[i].value[(face / 2 + 2) % 3] = 1.2f * y;
        }
        golden_cell(context, board.pass, face, 0, LARGE, LARGE);
        rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, corners, sizeof corners),
                                   0);
        rhw_pass_draw(context, board.pass, 0, 3, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
