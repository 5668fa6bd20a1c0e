// SPDX-License-Identifier: MIT
// Golden scenes of vertex input: formats, strides, steps and what instances see.
#include "golden_cells.h"
#include "golden_scenes.h"

#include <string.h>

// Words with z below x are no more than other shifts, which test_vertex_integers looks at.
enum { SIDE = 40, FORMATS = RHW_VERTEX_UNORM10_10_10_2_BGRA };

static void use(const struct golden_board *board, const struct rhw_pipeline_def *def)
{
    rhw_pass_set_pipeline(board->context, board->pass, golden_pipeline(board->context, def));
}

// A hexagon as a fan: six corners of the cell and a first one in its middle.
static rhw_buffer hexagon(rhw_context *context)
{
    static const float corner[8][2] = {{0, 0},     {0.9f, 0},       {0.45f, 0.8f},  {-0.45f, 0.8f},
                                       {-0.9f, 0}, {-0.45f, -0.8f}, {0.45f, -0.8f}, {0.9f, 0}};
    struct golden_vertex vertices[8];
    for (int i = 0; i < 8; i++) {
        vertices[i] = (struct golden_vertex){
            {corner[i][0], corner[i][1], 0.5f, 1},
            {i == 0 ? 1 : 0.25f * (float)(i % 4), i == 0 ? 1 : 0.125f * (float)i, 1 - 0.125f * (float)i, 1}};
    }
    return golden_buffer(context, vertices, sizeof vertices);
}

void golden_vertex_format_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    // One column per number of components, in turn all bits random and all within the format's ordinary range.
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_RGBA32_FLOAT};
    struct golden_board board;
    golden_board_make(&board, context, 8 * SIDE, (FORMATS + 3) / 4 * SIDE, formats, 2);
    golden_board_begin(&board);
    const struct golden_cell_uniforms uniforms = {.targets = 2};
    rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
    unsigned char bytes[512];
    uint64_t random = 3;
    for (size_t i = 0; i < sizeof bytes; i++) {
        bytes[i] = (unsigned char)golden_random(&random, 0, 256);
    }
    const rhw_buffer rough = golden_buffer(context, bytes, sizeof bytes);
    for (size_t i = 0; i + 1 < sizeof bytes; i += 2) { // halves, floats and large integers stay within 0..1
        bytes[i] &= 0x7f;
        bytes[i + 1] = (unsigned char)(i % 4 ? 0x30 + bytes[i + 1] % 15 : 0x30 + bytes[i + 1] % 12);
    }
    const rhw_buffer smooth = golden_buffer(context, bytes, sizeof bytes);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, hexagon(context), 0);
    for (int format = 0; format < FORMATS; format++) {
        for (int half = 0; half < 2; half++) {
            struct rhw_pipeline_def def = golden_cells_def(GOLDEN_CELL_VALUE, formats[0]);
            def.targets[1] = (struct rhw_color_target){.format = formats[1], .write_mask = 15};
            def.target_count = 2;
            def.topology = RHW_TRIANGLE_FAN;
            def.program.varyings[0].qualifier = half ? RHW_FLAT : RHW_SMOOTH;
            // Strides and offsets that align nothing.
            def.attributes[1] = (struct rhw_attribute){(enum rhw_vertex_format)format, 1, 1 + (uint32_t)half};
            def.buffers[1].stride = 18 + (uint32_t)format % 3;
            def.buffer_count = 2;
            use(&board, &def);
            rhw_pass_set_vertex_buffer(context, board.pass, 1, half ? rough : smooth, (size_t)(format % 5));
            golden_cell(context, board.pass, format % 4 * 2 + half, format / 4, SIDE, SIDE);
            rhw_pass_draw(context, board.pass, 0, 8, 0, 1);
        }
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}

// Offset x, y and scale; factor of the colour.
struct instance {
    float place[3];
    uint8_t factor[4];
};

void golden_instances_draw(rhw_context *context, int number, struct golden_images *images)
{
    (void)number;
    enum { COUNT = 60 };
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_R32_UINT, RHW_FORMAT_R32_UINT,
                                       RHW_FORMAT_R32_UINT};
    struct instance instances[COUNT];
    uint64_t random = 11;
    for (int i = 0; i < COUNT; i++) {
        for (int c = 0; c < 4; c++) {
            instances[i].factor[c] = (unsigned char)golden_random(&random, 64, 256);
            if (c < 3) {
                instances[i].place[c] = golden_random(&random, c < 2 ? -1.0f : 0.05f, c < 2 ? 1.0f : 0.3f);
            }
        }
    }
    const rhw_buffer buffer = golden_buffer(context, instances, sizeof instances);
    struct golden_board board;
    golden_board_make(&board, context, 200, 150, formats, 4);
    golden_board_begin(&board);
    const rhw_buffer shape = hexagon(context);
    static const uint16_t order[] = {0, 1, 2, 0, 3, 4, 0, 5, 6, 0, 4, 5};
    const rhw_buffer indices = golden_buffer(context, order, sizeof order);
    for (int draw = 0; draw < 4; draw++) { // colours from the shape; from the instance; ids; ids, indexed
        struct rhw_pipeline_def def =
            golden_cells_def(draw < 2 ? GOLDEN_CELL_VALUE : GOLDEN_CELL_IDS, formats[0]);
        golden_cells_fill(&def.program, GOLDEN_CELL_INSTANCED,
                          draw < 2 ? GOLDEN_CELL_VALUE : GOLDEN_CELL_IDS);
        def.program.varyings[1] = (struct rhw_varying){.components = 2, .qualifier = RHW_FLAT};
        def.program.varying_count = 2;
        for (int i = 1; i < 4; i++) {
            def.targets[i] =
                (struct rhw_color_target){.format = formats[i], .write_mask = draw < 2 ? RHW_WRITE_NONE : 0};
        }
        def.target_count = 4;
        def.topology = draw == 3 ? RHW_TRIANGLE_LIST : RHW_TRIANGLE_FAN;
        def.attributes[2] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 1, offsetof(struct instance, place)};
        def.attributes[3] = (struct rhw_attribute){RHW_VERTEX_UNORM8X4, 1, offsetof(struct instance, factor)};
        def.attribute_count = 4;
        def.buffers[1] = (struct rhw_vertex_layout){.stride = sizeof(struct instance), .per_instance = true};
        def.buffers[0].stride = draw == 1 ? 0 : sizeof(struct golden_vertex);
        def.buffers[0].constant = draw == 1;
        if (draw == 1) { // every vertex reads the same value; the position is another buffer's
            def.attributes[0].buffer = 2;
            def.buffers[2].stride = sizeof(struct golden_vertex);
        }
        def.buffer_count = 3;
        use(&board, &def);
        const struct golden_cell_uniforms uniforms = {.targets = 1};
        rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
        rhw_pass_set_vertex_buffer(context, board.pass, 0, shape, 0);
        rhw_pass_set_vertex_buffer(context, board.pass, 1, buffer, 0);
        rhw_pass_set_vertex_buffer(context, board.pass, 2, shape, 0);
        rhw_pass_set_index_buffer(context, board.pass, indices, RHW_INDEX_UINT16, 0);
        if (draw < 3) {
            rhw_pass_draw(context, board.pass, 0, 8, (uint32_t)draw * 15, 15);
        } else {
            rhw_pass_draw_indexed(context, board.pass, 0, 12, 1, 45, 20); // some instances outside the buffer
        }
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
