// SPDX-License-Identifier: MIT
// Golden scenes of queries and transform feedback: cells that are counted, their counts, and what was kept of their
// vertices, drawn again.
#include "golden_cells.h"
#include "golden_scenes.h"

#include <string.h>

enum { SIDE = 40, COLUMNS = 6, ROWS = 4, CELLS = COLUMNS * ROWS, VERTICES = 14, KEPT = 36 };

// By column; what they become, and vertices of one of these.
static const enum rhw_topology topologies[COLUMNS] = {RHW_POINT_LIST,    RHW_LINE_STRIP,
                                                      RHW_TRIANGLE_LIST, RHW_TRIANGLE_STRIP,
                                                      RHW_TRIANGLE_FAN,  RHW_TRIANGLE_STRIP_ADJACENCY};
static const enum rhw_topology lists[COLUMNS] = {RHW_POINT_LIST,    RHW_LINE_LIST,     RHW_TRIANGLE_LIST,
                                                 RHW_TRIANGLE_LIST, RHW_TRIANGLE_LIST, RHW_TRIANGLE_LIST};

struct asked {
    rhw_query occlusion, any, statistics, kept;
};

static rhw_query make_query(rhw_context *context, enum rhw_query_kind kind)
{
    rhw_query query;
    golden_check(rhw_query_create(context, &(struct rhw_query_def){.kind = kind}, &query), "query");
    return query;
}

static void begin(const struct golden_board *board, struct asked *asked)
{
    asked->occlusion = make_query(board->context, RHW_QUERY_OCCLUSION);
    asked->any = make_query(board->context, RHW_QUERY_ANY_PASSED);
    asked->statistics = make_query(board->context, RHW_QUERY_STATISTICS);
    asked->kept = make_query(board->context, RHW_QUERY_TRANSFORM_FEEDBACK);
    rhw_pass_begin_query(board->context, board->pass, asked->occlusion);
    rhw_pass_begin_query(board->context, board->pass, asked->any);
    rhw_pass_begin_query(board->context, board->pass, asked->statistics);
    rhw_pass_begin_query(board->context, board->pass, asked->kept);
}

static void end(const struct golden_board *board, const struct asked *asked)
{
    rhw_pass_end_query(board->context, board->pass, asked->any);
    rhw_pass_end_query(board->context, board->pass, asked->occlusion);
    rhw_pass_end_query(board->context, board->pass, asked->kept);
    rhw_pass_end_query(board->context, board->pass, asked->statistics);
}

// Corners in and around a cell, some behind the eye.
static void fill_vertices(struct golden_vertex vertices[VERTICES])
{
    uint64_t random = 16;
    for (int i = 0; i < VERTICES; i++) {
        const float w = i == 9 ? -0.5f : 1 + (float)(i % 3);
        for (int c = 0; c < 4; c++) {
            vertices[i].position[c] = golden_random(&random, c == 2 ? -0.1f : -1.3f, 1.3f) * w;
            vertices[i].value[c] = golden_random(&random, 0, 1);
        }
        vertices[i].position[3] = w;
    }
}

static struct rhw_pipeline_def def_of(int cell, enum rhw_format format)
{
    const int row = cell / COLUMNS;
    struct rhw_pipeline_def def =
        golden_cells_def(row == 3 ? GOLDEN_CELL_HEIGHTS : GOLDEN_CELL_VALUE, format);
    def.topology = topologies[cell % COLUMNS];
    def.depth_test = row != 1;
    def.alpha_to_coverage = row == 2;
    def.feedback_outputs[0] = (struct rhw_feedback_output){.source = RHW_FEEDBACK_POSITION};
    def.feedback_outputs[1] = (struct rhw_feedback_output){.source = RHW_FEEDBACK_VARYING, .offset = 16};
    def.feedback_output_count = 2;
    return def;
}

static void keep_counts(struct golden_images *images, rhw_context *context, const struct asked *asked)
{
    enum { COUNTS = 10 };
    float row[CELLS][COUNTS];
    for (int i = 0; i < CELLS; i++) {
        struct rhw_query_counts occlusion, any, statistics, kept;
        golden_check(rhw_query_read(context, asked[i].occlusion, &occlusion), "occlusion");
        golden_check(rhw_query_read(context, asked[i].any, &any), "any passed");
        golden_check(rhw_query_read(context, asked[i].statistics, &statistics), "statistics");
        golden_check(rhw_query_read(context, asked[i].kept, &kept), "transform feedback");
        const struct rhw_pipeline_statistics *const s = &statistics.statistics;
        const float counts[COUNTS] = {
            (float)occlusion.samples_passed,     any.any_passed,
            (float)s->input_assembly_vertices,   (float)s->input_assembly_primitives,
            (float)s->vertex_shader_invocations, (float)s->clipping_invocations,
            (float)s->clipping_primitives,       (float)s->fragment_shader_invocations,
            (float)kept.primitives_written,      (float)kept.primitives_needed};
        memcpy(row[i], counts, sizeof counts);
    }
    const rhw_texture texture = golden_texture(context, RHW_FORMAT_R32_FLOAT, COUNTS, CELLS, 1);
    golden_check(rhw_texture_write(context, texture, 0, row, 0), "counts");
    golden_keep(images, context, texture);
}

// Fragment kinds and depth by rows, topologies by columns; 1 and 4 samples by `number`. Two draws each: the second finds
// what the first left, and has no room for all that it keeps.
void golden_queries_draw(rhw_context *context, int number, struct golden_images *images)
{
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_D32_FLOAT};
    const size_t cell_bytes = KEPT * sizeof(struct golden_vertex);
    struct golden_vertex vertices[VERTICES];
    struct asked asked[CELLS];
    struct golden_board board;
    static const unsigned char zeros[CELLS * KEPT * sizeof(struct golden_vertex)];
    fill_vertices(vertices);
    golden_board_make(&board, context, COLUMNS * SIDE, ROWS * SIDE, formats, 2);
    board.def.samples = number == 0 ? 1 : 4;
    const rhw_buffer kept = golden_buffer(context, zeros, sizeof zeros);
    const struct golden_cell_uniforms uniforms = {.targets = 1};
    golden_board_begin(&board);
    rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, golden_buffer(context, vertices, sizeof vertices), 0);
    for (int cell = 0; cell < CELLS; cell++) {
        const struct rhw_pipeline_def def = def_of(cell, formats[0]);
        const struct rhw_feedback_target target = {
            .buffer = kept, .offset = (size_t)cell * cell_bytes, .size = cell_bytes};
        golden_cell(context, board.pass, cell % COLUMNS, cell / COLUMNS, SIDE, SIDE);
        rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
        rhw_pass_begin_transform_feedback(context, board.pass, &target, 1);
        rhw_pass_draw(context, board.pass, 2, VERTICES - 2, 0, 1);
        begin(&board, &asked[cell]);
        rhw_pass_draw(context, board.pass, 0, VERTICES, 0, 2);
        end(&board, &asked[cell]);
        rhw_pass_end_transform_feedback(context, board.pass, NULL);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
    keep_counts(images, context, asked);
    golden_board_begin(&board);
    rhw_pass_set_uniforms(context, board.pass, &uniforms, sizeof uniforms);
    rhw_pass_set_vertex_buffer(context, board.pass, 0, kept, 0);
    for (int cell = 0; cell < CELLS; cell++) {
        struct rhw_pipeline_def def = def_of(cell, formats[0]);
        def.topology = lists[cell % COLUMNS];
        def.feedback_output_count = 0;
        golden_cell(context, board.pass, cell % COLUMNS, cell / COLUMNS, SIDE, SIDE);
        rhw_pass_set_pipeline(context, board.pass, golden_pipeline(context, &def));
        rhw_pass_draw(context, board.pass, (uint32_t)(cell * KEPT), KEPT, 0, 1);
    }
    golden_board_end(&board);
    golden_board_keep(&board, images);
}
