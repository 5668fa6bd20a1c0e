// SPDX-License-Identifier: MIT
// Draws whose parameters stand in buffers draw what the same parameters draw by hand.
#include "harness.h"

#include <string.h>

enum { COLUMNS = 8 };

// Column i, of COLUMNS, is a quad of vertices 6 i .. 6 i + 5 with the value (i + 1, instance, draw, 1).
static void fill_column(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        struct rhw_fragment *const f = &groups[g];
        f->color[0][0] = f->varying[0];
        f->color[0][1] = rhw_float_from_int(f->instance);
        f->color[0][2] = rhw_float_from_int(f->draw);
        f->color[0][3] = rhw_splat(1);
    }
}

struct stage {
    struct rig rig;
    rhw_buffer commands, counts;
};

static rhw_buffer make_buffer(struct rig *rig, const void *data, size_t size)
{
    const struct rhw_buffer_def def = {.size = size, .data = data, .label = "commands"};
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    return buffer;
}

static void open_stage(struct stage *stage, const void *commands, size_t size)
{
    struct rig *const rig = &stage->rig;
    rig_open(rig, COLUMNS, 1);
    rig_set_program(rig, rig_vertex_pass, fill_column);
    rig->pipeline.program.uses = RHW_USE_IDS;
    struct rig_vertex vertices[6 * COLUMNS];
    for (int i = 0; i < COLUMNS; i++) {
        const float value[4] = {(float)(i + 1), 0, 0, 1};
        rig_rectangle(rig, (float)i, 0, (float)(i + 1), 1, 0, value, vertices + 6 * i);
    }
    uint16_t indices[6 * COLUMNS];
    for (int i = 0; i < 6 * COLUMNS; i++) {
        indices[i] = (uint16_t)(6 * COLUMNS - 6 - i / 6 * 6 + i % 6); // columns from right to left
    }
    stage->commands = make_buffer(rig, commands, size);
    stage->counts = make_buffer(rig, (const uint32_t[4]){7, 1, 2, 99}, 16);
    rig_begin(rig);
    rig_use_pipeline(rig);
    rig_use_vertices(rig, 0, vertices, sizeof vertices);
    rig_use_indices(rig, RHW_INDEX_UINT16, indices, sizeof indices);
}

// `columns` has 0 where nothing is drawn, else 100 · column + 10 · instance + draw + 1.
static void expect_columns(struct rig *rig, const int columns[COLUMNS])
{
    rig_end(rig);
    const float(*const pixels)[4] = rig_read_float4(rig);
    for (int x = 0; x < COLUMNS; x++) {
        const float *const p = pixels[x];
        const int seen = p[3] == 0 ? 0 : (int)(100 * p[0] + 10 * p[1] + p[2]) + 1;
        assert_int_equal(seen, columns[x]);
    }
}

static void test_draws(void **state)
{
    (void)state;
    const struct rhw_draw_command commands[3] = {{6, 1, 0, 2}, {12, 1, 12, 0}, {6, 2, 36, 3}};
    struct stage stage;
    open_stage(&stage, commands, sizeof commands);
    rhw_pass_draw_indirect(stage.rig.context, stage.rig.recording,
                           &(struct rhw_draw_commands){.buffer = stage.commands, .count = 3});
    assert_int_equal(stage.rig.misuses, 0);
    // What is written afterwards is not seen.
    assert_int_equal(rhw_buffer_write(stage.rig.context, stage.commands, 0, (const uint32_t[4]){0}, 16),
                     RHW_OK);
    expect_columns(&stage.rig, (const int[COLUMNS]){121, 0, 302, 402, 0, 0, 743, 0});
    assert_int_equal(stage.rig.stats.draws, 3);
    rig_close(&stage.rig);
}

static void test_indexed_draws_with_a_stride(void **state)
{
    (void)state;
    const struct {
        uint32_t padding;
        struct rhw_draw_indexed_command command;
        uint32_t more;
    } commands[3] = {{9, {6, 1, 0, 0, 0}, 9}, {9, {6, 1, 6, -6, 4}, 9}, {9, {6, 1, 42, 6, 0}, 9}};
    struct stage stage;
    open_stage(&stage, commands, sizeof commands);
    rhw_pass_draw_indexed_indirect(
        stage.rig.context, stage.rig.recording,
        &(struct rhw_draw_commands){
            .buffer = stage.commands, .offset = 4, .count = 3, .stride = sizeof commands[0]});
    expect_columns(&stage.rig, (const int[COLUMNS]){0, 203, 0, 0, 0, 642, 0, 801});
    rig_close(&stage.rig);
}

// The count is that of the buffer, and never more than the most.
static void test_counts_from_a_buffer(void **state)
{
    (void)state;
    const struct rhw_draw_command commands[3] = {{6, 1, 0, 0}, {6, 1, 6, 0}, {6, 1, 12, 0}};
    for (int i = 0; i < 4; i++) {
        struct stage stage;
        open_stage(&stage, commands, sizeof commands);
        const struct rhw_draw_commands indirect = {.buffer = stage.commands,
                                                   .count = i == 0 ? 0 : 3,
                                                   .count_buffer = stage.counts,
                                                   .count_offset = 4 * (size_t)i};
        rhw_pass_draw_indirect(stage.rig.context, stage.rig.recording, &indirect);
        assert_int_equal(stage.rig.misuses, 0);
        expect_columns(&stage.rig,
                       (const int[COLUMNS]){i >= 1 ? 101 : 0, i >= 2 ? 202 : 0, i >= 3 ? 303 : 0});
        rig_close(&stage.rig);
    }
}

// As many vertices as there are whole ones in the bytes that a counter says.
static void test_byte_counts(void **state)
{
    (void)state;
    enum { SIZE = sizeof(struct rig_vertex) };
    const uint32_t counters[] = {4 + 12 * SIZE + SIZE - 1, 4 + 12 * SIZE - 1, 4 + 6 * SIZE, 3, 0};
    static const uint64_t triangles[] = {4, 3, 2, 0, 0};
    for (size_t i = 0; i < sizeof counters / sizeof *counters; i++) {
        struct stage stage;
        struct rig *const rig = &stage.rig;
        open_stage(&stage, counters, sizeof counters);
        const struct rhw_draw_byte_count draw = {.buffer = stage.commands,
                                                 .offset = 4 * i,
                                                 .counter_offset = 4,
                                                 .stride = SIZE,
                                                 .first_instance = 3,
                                                 .instances = 1};
        rhw_pass_draw_indirect_byte_count(rig->context, rig->recording, &draw);
        // What is written afterwards is not seen.
        assert_int_equal(rhw_buffer_fill(rig->context, stage.commands, 0, 0, 0), RHW_OK);
        rig_end(rig);
        assert_int_equal(rig->misuses, 0);
        assert_int_equal(rig->stats.triangles_in, triangles[i]);
        const float *const first = rig_read_float4(rig)[0];
        assert_true(triangles[i] ? first[0] == 1 && first[1] == 3 : first[3] == 0);
        rig_close(rig);
    }
}

static void test_misuse_of_byte_counts(void **state)
{
    (void)state;
    struct stage stage;
    open_stage(&stage, (const uint32_t[2]){64, 64}, 8);
    struct rig *const rig = &stage.rig;
    rhw_context *const context = rig->context;
    rhw_pass_draw_indirect_byte_count(context, rig->recording, NULL);
    rig_expect_misuse(rig, "rhw_pass_draw_indirect_byte_count: draw is NULL");
    struct rhw_draw_byte_count draw = {.buffer = stage.commands, .instances = 1};
    rhw_pass_draw_indirect_byte_count(context, rig->recording, &draw);
    rig_expect_misuse(rig, "stride is 0; it must be at least 1 byte");
    draw.stride = 32;
    draw.offset = 2;
    rhw_pass_draw_indirect_byte_count(context, rig->recording, &draw);
    rig_expect_misuse(rig, "offset is 2; it must be a multiple of 4");
    draw.offset = 8;
    rhw_pass_draw_indirect_byte_count(context, rig->recording, &draw);
    rig_expect_misuse(rig, "offset is 8 and 4 bytes are read there");
    draw.offset = 4;
    rhw_pass_set_storage_buffer(context, rig->recording, 0, stage.commands, 4, 0);
    rhw_pass_draw_indirect_byte_count(context, rig->recording, &draw);
    rig_expect_misuse(rig,
                      "it reads bytes 4 to 8 of buffer 1 \"commands\"; storage of this pass may write bytes");
    rig_end(rig);
    assert_int_equal(rig->stats.draws, 0);
    rig_close(rig);
}

static void test_misuse(void **state)
{
    (void)state;
    const struct rhw_draw_command commands[2] = {{6, 1, 0, 0}, {6, 1, 6, 0}};
    struct stage stage;
    open_stage(&stage, commands, sizeof commands);
    struct rig *const rig = &stage.rig;
    const struct {
        struct rhw_draw_commands commands;
        const char *message;
    } wrong[] = {
        {{.buffer = stage.commands, .count = 3},
         "offset is 0 and 48 bytes are read there; together they must stay within the 32 bytes of buffer 1 "
         "\"commands\""},
        {{.buffer = stage.commands, .count = 1, .offset = 20}, "offset is 20 and 16 bytes are read there"},
        {{.buffer = stage.commands, .count = 1, .offset = 40}, "offset is 40"},
        {{.buffer = stage.commands, .count = 1, .offset = 2}, "offset is 2; it must be a multiple of 4"},
        {{.buffer = stage.commands, .count = 1, .stride = 12},
         "stride is 12; it must be 0, or a multiple of 4 of at least 16"},
        {{.buffer = stage.commands, .count = UINT32_MAX, .stride = 0x80000000}, "bytes are read there"},
        {{.buffer = stage.commands, .count = 1, .count_buffer = stage.counts, .count_offset = 16},
         "count_offset is 16 and 4 bytes are read there"},
        {{.count = 1}, "rhw_pass_draw_indirect: the buffer id is null"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        rhw_pass_draw_indirect(rig->context, rig->recording, &wrong[i].commands);
        rig_expect_misuse(rig, wrong[i].message);
    }
    rhw_pass_draw_indirect(rig->context, rig->recording, NULL);
    rig_expect_misuse(rig, "rhw_pass_draw_indirect: commands is NULL");
    rhw_pass_draw_indexed_indirect(rig->context, rig->recording,
                                   &(struct rhw_draw_commands){.buffer = stage.commands, .count = 2});
    rig_expect_misuse(rig, "rhw_pass_draw_indexed_indirect: offset is 0 and 40 bytes are read there");
    // What the pass itself may write is not there before its end.
    rhw_pass_set_storage_buffer(rig->context, rig->recording, 0, stage.commands, 0, 0);
    rhw_pass_draw_indirect(rig->context, rig->recording,
                           &(struct rhw_draw_commands){.buffer = stage.commands, .count = 1});
    rig_expect_misuse(
        rig, "it reads bytes 0 to 16 of buffer 1 \"commands\"; storage of this pass may write bytes");
    rig_end(rig);
    assert_int_equal(rig->stats.draws, 0);
    rig_close(rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_draws),
    cmocka_unit_test(test_indexed_draws_with_a_stride),
    cmocka_unit_test(test_counts_from_a_buffer),
    cmocka_unit_test(test_byte_counts),
    cmocka_unit_test(test_misuse_of_byte_counts),
    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_indirect = UNIT_TESTS(tests, NULL, NULL);
