// SPDX-License-Identifier: MIT
// Transform feedback: what stands in the buffers for every topology, against primitives taken apart by hand; strides,
// offsets and parts of varyings; the same bytes for any threads, chunks and waves; where a buffer is full; what is
// refused.
#include "harness.h"

#include <stdlib.h>
#include <string.h>

enum { SIZE = 16, FLOATS = 4096 };

static rhw_buffer make_buffer(struct rig *rig, size_t size)
{
    rhw_buffer buffer;
    const struct rhw_buffer_def def = {.size = size, .label = "kept"};
    assert_int_equal(rhw_buffer_create(rig->context, &def, &buffer), RHW_OK);
    return buffer;
}

// `size` bytes of a buffer, until the next read.
static const float *read_buffer(struct rig *rig, rhw_buffer buffer, size_t size)
{
    static float floats[2 * 2 * 3 * 3000 * 4];
    assert_true(size <= sizeof floats);
    assert_int_equal(rhw_buffer_read(rig->context, buffer, 0, floats, size), RHW_OK);
    return floats;
}

// Vertex i of instance k has the varying (i, k, i + 0.5, -i), and varying 1 (1000 + i).
static void number_vertices(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const rhw_float i = rhw_float_from_int(groups[g].vertex_index),
                        k = rhw_float_from_int(groups[g].instance_index);
        groups[g].position[0] = i * 0.125f - 2.0f; // many are outside
        groups[g].position[1] = rhw_splat(0.5f) - k;
        groups[g].position[2] = rhw_splat(0.5f);
        groups[g].position[3] = rhw_splat(1);
        groups[g].varying[0] = i;
        groups[g].varying[1] = k;
        groups[g].varying[2] = i + 0.5f;
        groups[g].varying[3] = -i;
        groups[g].varying[4] = i + 1000.0f;
        groups[g].point_size = i + 1.0f;
        groups[g].clip_distance[0] = i + 2.0f;
        groups[g].clip_distance[1] = i + 3.0f;
        groups[g].cull_distance[0] = i + 4.0f;
    }
}

static void open_feedback(struct rig *rig, const struct rhw_context_def *def)
{
    rig_open_with(rig, SIZE, SIZE, def);
    rig_set_program(rig, number_vertices, rig_fragment_pass);
    struct rhw_program *const program = &rig->pipeline.program;
    program->varyings[1] = (struct rhw_varying){.components = 1, .qualifier = RHW_FLAT};
    program->varyings[2].components = 3; // behind the last, so that it counts for nothing
    program->varying_count = 2;
    program->writes_point_size = true;
    program->clip_distance_count = 2;
    program->cull_distance_count = 1;
    rig->pipeline.attribute_count = rig->pipeline.buffer_count = 0;
    memset(rig->pipeline.attributes, 0, sizeof rig->pipeline.attributes);
    memset(rig->pipeline.buffers, 0, sizeof rig->pipeline.buffers);
}

// Asks for the number of each vertex alone.
static void keep_numbers(struct rig *rig)
{
    rig->pipeline.feedback_outputs[0] =
        (struct rhw_feedback_output){.source = RHW_FEEDBACK_VARYING, .component_count = 1};
    rig->pipeline.feedback_output_count = 1;
}

static void begin_feedback(struct rig *rig, const struct rhw_feedback_target *targets, int count)
{
    rhw_pass_begin_transform_feedback(rig->context, rig->recording, targets, count);
}

static void end_feedback(struct rig *rig, size_t *written)
{
    rhw_pass_end_transform_feedback(rig->context, rig->recording, written);
}

// Primitives taken apart ---------------------------------------------------------------------------------

// Draws 0 .. count − 1, or indices of them, and wants the vertices in that order.
static void expect_order(enum rhw_topology topology, const uint8_t *indices, uint32_t count, const int *order,
                         size_t length)
{
    struct rig rig;
    size_t written[RHW_MAX_FEEDBACK_TARGETS];
    open_feedback(&rig, &(struct rhw_context_def){.threads = 2});
    keep_numbers(&rig);
    rig.pipeline.topology = topology;
    rig.pipeline.primitive_restart = indices != NULL;
    const rhw_buffer buffer = make_buffer(&rig, FLOATS * sizeof(float));
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = buffer}, 1);
    if (indices) {
        rig_use_indices(&rig, RHW_INDEX_UINT8, indices, count);
        rhw_pass_draw_indexed(rig.context, rig.recording, 0, count, 0, 0, 1);
    } else {
        rhw_pass_draw(rig.context, rig.recording, 0, count, 0, 1);
    }
    end_feedback(&rig, written);
    rig_end(&rig);
    assert_int_equal(written[0], length * sizeof(float));
    for (size_t i = 0; i <= length; i++) {
        const float expected = i < length ? (float)order[i] : 0;
        assert_true(read_buffer(&rig, buffer, (i + 1) * sizeof(float))[i] == expected);
    }
    rig_close(&rig);
}

#define EXPECT_ORDER(topology, indices, count, ...)                    \
    expect_order(topology, indices, count, (const int[]){__VA_ARGS__}, \
                 sizeof(const int[]){__VA_ARGS__} / sizeof(int))

static void test_topologies(void **state)
{
    (void)state;
    EXPECT_ORDER(RHW_POINT_LIST, NULL, 3, 0, 1, 2);
    EXPECT_ORDER(RHW_LINE_LIST, NULL, 5, 0, 1, 2, 3);
    EXPECT_ORDER(RHW_LINE_STRIP, NULL, 4, 0, 1, 1, 2, 2, 3);
    EXPECT_ORDER(RHW_LINE_LOOP, NULL, 4, 0, 1, 1, 2, 2, 3, 3, 0);
    EXPECT_ORDER(RHW_TRIANGLE_LIST, NULL, 8, 0, 1, 2, 3, 4, 5);
    EXPECT_ORDER(RHW_TRIANGLE_STRIP, NULL, 5, 0, 1, 2, 1, 3, 2, 2, 3, 4);
    EXPECT_ORDER(RHW_TRIANGLE_FAN, NULL, 5, 1, 2, 0, 2, 3, 0, 3, 4, 0);
    EXPECT_ORDER(RHW_LINE_LIST_ADJACENCY, NULL, 8, 1, 2, 5, 6);
    EXPECT_ORDER(RHW_TRIANGLE_LIST_ADJACENCY, NULL, 6, 0, 2, 4);
    const uint8_t strip[] = {9, 8, 7, 6, 255, 1, 255, 2, 3, 4};
    EXPECT_ORDER(RHW_TRIANGLE_STRIP, strip, 10, 9, 8, 7, 8, 6, 7, 2, 3, 4);
    EXPECT_ORDER(RHW_LINE_STRIP, strip, 10, 9, 8, 8, 7, 7, 6, 2, 3, 3, 4);
    EXPECT_ORDER(RHW_LINE_LOOP, strip, 10, 9, 8, 8, 7, 7, 6, 6, 9, 2, 3, 3, 4, 4, 2);
}

// Places in a vertex -------------------------------------------------------------------------------------

static void test_sources_and_places(void **state)
{
    (void)state;
    struct rig rig;
    open_feedback(&rig, &(struct rhw_context_def){.threads = 1});
    const struct rhw_feedback_output outputs[] = {
        {.source = RHW_FEEDBACK_POSITION, .target = 1, .offset = 4},
        {.source = RHW_FEEDBACK_VARYING,
         .first_component = 1,
         .component_count = 2,
         .target = 1,
         .offset = 24},
        {.source = RHW_FEEDBACK_VARYING, .index = 1, .target = 3},
        {.source = RHW_FEEDBACK_POINT_SIZE, .target = 3, .offset = 4},
        {.source = RHW_FEEDBACK_CLIP_DISTANCES, .target = 3, .offset = 12},
        {.source = RHW_FEEDBACK_CULL_DISTANCES, .target = 3, .offset = 8},
    };
    memcpy(rig.pipeline.feedback_outputs, outputs, sizeof outputs);
    rig.pipeline.feedback_output_count = 6;
    rig.pipeline.feedback_strides[1] = 36;
    rig.pipeline.topology = RHW_POINT_LIST;
    const rhw_buffer one = make_buffer(&rig, FLOATS), three = make_buffer(&rig, FLOATS);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    begin_feedback(
        &rig,
        (const struct rhw_feedback_target[4]){[1] = {.buffer = one, .offset = 8}, [3] = {.buffer = three}},
        4);
    rhw_pass_draw(rig.context, rig.recording, 5, 2, 7, 2);
    end_feedback(&rig, NULL);
    rig_end(&rig);
    for (int n = 0; n < 4; n++) {
        const float i = (float)(5 + n % 2), k = (float)(7 + n / 2);
        const float a[9] = {0, i * 0.125f - 2, 0.5f - k, 0.5f, 1, 0, k, i + 0.5f, 0};
        const float b[5] = {i + 1000, i + 1, i + 4, i + 2, i + 3};
        assert_memory_equal(read_buffer(&rig, one, FLOATS) + 2 + 9 * n, a, sizeof a);
        assert_memory_equal(read_buffer(&rig, three, FLOATS) + 5 * n, b, sizeof b);
    }
    rig_close(&rig);
}

// Order and room -------------------------------------------------------------------------------------------

enum { TRIANGLES = 3000, INSTANCES = 4, VERTICES = 3 * TRIANGLES * INSTANCES };

// A strip of many chunks, drawn twice, with a vertex function that several threads run; in waves.
static void draw_many(const struct rhw_context_def *def, bool discards, float (*kept)[2])
{
    struct rig rig;
    open_feedback(&rig, def);
    rig.pipeline.feedback_outputs[0] =
        (struct rhw_feedback_output){.source = RHW_FEEDBACK_VARYING, .component_count = 2};
    rig.pipeline.feedback_output_count = 1;
    rig.pipeline.topology = RHW_TRIANGLE_STRIP;
    rig.pipeline.rasterizer_discard = discards;
    const rhw_buffer buffer = make_buffer(&rig, 2 * VERTICES * sizeof *kept);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = buffer}, 1);
    rhw_pass_draw(rig.context, rig.recording, 0, TRIANGLES + 2, 0, INSTANCES);
    rhw_pass_draw(rig.context, rig.recording, 100, TRIANGLES + 2, 0, INSTANCES);
    end_feedback(&rig, NULL);
    rig_end(&rig);
    assert_true(def->bin_memory == 0 || discards || rig.stats.flushes > 0);
    assert_true(!discards || rig.stats.triangles_rasterized == 0);
    memcpy(kept, read_buffer(&rig, buffer, 2 * VERTICES * sizeof *kept), 2 * VERTICES * sizeof *kept);
    rig_close(&rig);
}

static void test_any_threads_and_waves(void **state)
{
    (void)state;
    static float kept[2 * VERTICES][2];
    const struct rhw_context_def defs[] = {{.threads = 1},
                                           {.threads = 4},
                                           {.threads = 3, .bin_memory = 1},
                                           {.threads = 2, .paths = RHW_PATHS_GENERAL}};
    for (size_t d = 0; d < sizeof defs / sizeof *defs; d++) {
        for (int discards = 0; discards < 2; discards++) {
            memset(kept, 0xff, sizeof kept);
            draw_many(&defs[d], discards, kept);
            for (int n = 0; n < 2 * VERTICES; n++) {
                const int draw = n / VERTICES, k = n % VERTICES / (3 * TRIANGLES), t = n / 3 % TRIANGLES;
                const int odd = t & 1, corner[3] = {t, t + 1 + odd, t + 2 - odd};
                assert_true(kept[n][0] == (float)(corner[n % 3] + 100 * draw));
                assert_true(kept[n][1] == (float)k);
            }
        }
    }
}

// Room for two triangles and a half; then for none, as one of two targets is too small.
static void test_overflow(void **state)
{
    (void)state;
    for (int wide = 0; wide < 3; wide++) {
        struct rig rig;
        size_t written[RHW_MAX_FEEDBACK_TARGETS];
        open_feedback(&rig, &(struct rhw_context_def){.threads = 2});
        keep_numbers(&rig);
        if (wide) {
            rig.pipeline.feedback_outputs[1] = (struct rhw_feedback_output){.target = 1};
            rig.pipeline.feedback_output_count = 2;
        }
        const rhw_buffer buffer = make_buffer(&rig, 64), other = make_buffer(&rig, wide == 1 ? 44 : 64);
        rhw_query query;
        const struct rhw_query_def def = {.kind = RHW_QUERY_TRANSFORM_FEEDBACK};
        assert_int_equal(rhw_query_create(rig.context, &def, &query), RHW_OK);
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        rhw_pass_begin_query(rig.context, rig.recording, query);
        begin_feedback(&rig,
                       (const struct rhw_feedback_target[2]){
                           {.buffer = buffer, .offset = 4, .size = wide == 2 ? 8 : 30}, {.buffer = other}},
                       2);
        rhw_pass_draw(rig.context, rig.recording, 1, 3, 0, 1);
        rhw_pass_draw(rig.context, rig.recording, 4, 9, 0, 1);
        end_feedback(&rig, written);
        // Behind what was written, another one.
        if (!wide) {
            begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = buffer, .offset = 4 + written[0]},
                           1);
            rhw_pass_draw(rig.context, rig.recording, 50, 3, 0, 1);
            end_feedback(&rig, NULL);
        }
        rhw_pass_end_query(rig.context, rig.recording, query);
        rig_end(&rig);
        assert_int_equal(written[0], wide ? 0 : 24);
        const float full[16] = {0, 1, 2, 3, 4, 5, 6, 50, 51, 52}, empty[16] = {0};
        assert_memory_equal(read_buffer(&rig, buffer, sizeof full), wide ? empty : full, sizeof full);
        struct rhw_query_counts counts;
        assert_int_equal(rhw_query_read(rig.context, query, &counts), RHW_OK);
        assert_int_equal(counts.primitives_written, wide ? 0 : 3);
        assert_int_equal(counts.primitives_needed, wide ? 4 : 5);
        rig_close(&rig);
    }
}

// What one pass keeps the next draws, as much as it is.
static void test_kept_vertices_are_drawn(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    rig_open(&rig, SIZE, SIZE);
    rig_cover(&rig, 0.5f, (const float[4]){1, 2, 3, 4}, vertices);
    rig.pipeline.feedback_outputs[0] = (struct rhw_feedback_output){.source = RHW_FEEDBACK_POSITION};
    rig.pipeline.feedback_outputs[1] =
        (struct rhw_feedback_output){.source = RHW_FEEDBACK_VARYING, .offset = 16};
    rig.pipeline.feedback_output_count = 2;
    rig.pipeline.rasterizer_discard = true;
    const rhw_buffer buffer = make_buffer(&rig, sizeof vertices);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, vertices, sizeof vertices);
    begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = buffer}, 1);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1);
    size_t written[RHW_MAX_FEEDBACK_TARGETS];
    end_feedback(&rig, written);
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[0][3] == 0);
    const uint32_t counter = (uint32_t)written[0];
    const struct rhw_draw_byte_count draw = {
        .buffer = make_buffer(&rig, sizeof counter), .stride = sizeof *vertices, .instances = 1};
    assert_int_equal(rhw_buffer_write(rig.context, draw.buffer, 0, &counter, sizeof counter), RHW_OK);
    assert_memory_equal(read_buffer(&rig, buffer, sizeof vertices), vertices, sizeof vertices);
    rig.pipeline.rasterizer_discard = false;
    rig.pipeline.feedback_output_count = 0;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
    rhw_pass_draw_indirect_byte_count(rig.context, rig.recording, &draw);
    rig_end(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_memory_equal(rig_read_float4(&rig)[i], vertices[0].value, sizeof vertices[0].value);
    }
    rig_close(&rig);
}

// What is refused --------------------------------------------------------------------------------------

static void expect_refused(struct rig *rig, struct rhw_feedback_output a, struct rhw_feedback_output b,
                           uint32_t stride, const char *message)
{
    rhw_pipeline pipeline;
    rig->pipeline.feedback_outputs[0] = a;
    rig->pipeline.feedback_outputs[1] = b;
    rig->pipeline.feedback_output_count = 2;
    rig->pipeline.feedback_strides[0] = stride;
    assert_int_equal(rhw_pipeline_create(rig->context, &rig->pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(rig, message);
}

static void test_misuse_of_pipelines(void **state)
{
    (void)state;
    struct rig rig;
    open_feedback(&rig, &(struct rhw_context_def){.threads = 1});
    const struct rhw_feedback_output position = {.source = RHW_FEEDBACK_POSITION};
    struct rhw_feedback_output bad = position;
    bad.source = (enum rhw_feedback_source)5;
    expect_refused(&rig, bad, position, 0, "feedback_outputs[0].source is 5; it must be 0..4");
    bad = position;
    bad.target = 4;
    expect_refused(&rig, position, bad, 0, "feedback_outputs[1].target is 4; it must be 0..3");
    bad = (struct rhw_feedback_output){.source = RHW_FEEDBACK_VARYING, .index = 2, .offset = 16};
    expect_refused(&rig, position, bad, 0, "feedback_outputs[1].index is 2; the program has 2 varyings");
    bad.index = 0;
    bad.first_component = 2;
    bad.component_count = 3;
    expect_refused(&rig, position, bad, 0, "components from 2 on, 3 of them; the vertex function writes 4");
    bad = position;
    bad.offset = 18;
    expect_refused(&rig, position, bad, 0, "feedback_outputs[1].offset is 18");
    bad.offset = 16;
    expect_refused(&rig, position, bad, 28, "ends at byte 32 of a vertex; feedback_strides[0] is 28");
    bad.offset = 12;
    expect_refused(&rig, position, bad, 0, "feedback_outputs[0] and [1] share bytes of target 0");
    rhw_pipeline pipeline;
    rig.pipeline.feedback_output_count = RHW_MAX_FEEDBACK_OUTPUTS + 1;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "feedback_output_count is 65; it must be 0..64");
    rig_close(&rig);
}

static void test_misuse_in_a_pass(void **state)
{
    (void)state;
    struct rig rig;
    open_feedback(&rig, &(struct rhw_context_def){.threads = 1});
    const rhw_buffer buffer = make_buffer(&rig, 256), read = make_buffer(&rig, 256);
    const struct rhw_feedback_target target = {.buffer = buffer};
    rig_begin(&rig);
    begin_feedback(&rig, &target, 1);
    rig_expect_misuse(&rig,
                      "rhw_pass_begin_transform_feedback: no pipeline is set; one with feedback_outputs");
    rig_use_pipeline(&rig);
    begin_feedback(&rig, &target, 1);
    rig_expect_misuse(&rig, "the pipeline that is set has no outputs");
    keep_numbers(&rig);
    rig_use_pipeline(&rig);
    end_feedback(&rig, NULL);
    rig_expect_misuse(&rig, "rhw_pass_end_transform_feedback: it is not under way; begin it first");
    begin_feedback(&rig, &target, 5);
    rig_expect_misuse(&rig, "count is 5 and targets is set; 1..4 are asked for");
    begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = buffer, .offset = 6}, 1);
    rig_expect_misuse(&rig, "targets[0] has offset 6 and size 0");
    begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = buffer, .offset = 8, .size = 249}, 1);
    rig_expect_misuse(&rig, "targets[0] has offset 8 and size 249");
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, read, 0);
    begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = read}, 1);
    rig_expect_misuse(
        &rig, "it writes bytes 0 to 256 of buffer 2 \"kept\"; a vertex, index or read-only buffer of this "
              "pass reads bytes 0 to 256");
    begin_feedback(&rig, &target, 1);
    begin_feedback(&rig, &target, 1);
    rig_expect_misuse(&rig, "it is under way; end it first");
    rhw_pass_set_vertex_buffer(rig.context, rig.recording, 0, buffer, 0);
    rig_expect_misuse(
        &rig, "it reads bytes 0 to 256 of buffer 1 \"kept\"; the transform feedback of this pass writes "
              "bytes 0 to 256");
    assert_int_equal(rhw_buffer_write(rig.context, buffer, 0, "x", 1), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "it writes bytes 0 to 1 of buffer 1 \"kept\"; the transform feedback of this "
                            "pass writes bytes 0 to 256");
    char byte;
    assert_int_equal(rhw_buffer_read(rig.context, buffer, 0, &byte, 1), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_buffer_read: it reads bytes 0 to 1 of buffer 1 \"kept\"; the transform "
                            "feedback of this pass writes");
    rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, buffer, 0, 0);
    rig_expect_misuse(&rig,
                      "rhw_pass_set_storage_buffer: it may write bytes 0 to 256 of buffer 1 \"kept\"; the "
                      "transform feedback of this pass writes bytes 0 to 256");
    rig_use_pipeline(&rig);
    rig_expect_misuse(&rig, "rhw_pass_set_pipeline: transform feedback is under way; end it first");
    rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
    end_feedback(&rig, NULL);
    begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = buffer, .offset = 8, .size = 4}, 1);
    rig_expect_misuse(&rig, "it writes bytes 8 to 12 of buffer 1 \"kept\"; the transform feedback of this "
                            "pass writes bytes 0 to 12");
    // What it did not come to, and other bytes of what is read, are free.
    assert_int_equal(rhw_buffer_write(rig.context, buffer, 12, "x", 1), RHW_OK);
    assert_int_equal(rhw_buffer_read(rig.context, buffer, 12, &byte, 1), RHW_OK);
    assert_true(byte == 'x');
    rhw_buffer_read(rig.context, buffer, 8, &byte, 1);
    rig_expect_misuse(&rig, "it reads bytes 8 to 9");
    rhw_pass_set_vertex_buffer_range(rig.context, rig.recording, 0, buffer, 64, 64);
    assert_int_equal(rhw_buffer_write(rig.context, buffer, 70, "x", 1), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "this pass reads some of them and may write others; end the pass first");
    rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, buffer, 128, 0);
    begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = buffer, .offset = 60, .size = 8}, 1);
    rig_expect_misuse(&rig, "a vertex, index or read-only buffer of this pass reads bytes 64 to 128");
    begin_feedback(&rig, &(struct rhw_feedback_target){.buffer = buffer, .offset = 12, .size = 4}, 1);
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_pass_end: transform feedback was begun and not ended");
    // Both targets of one pipeline.
    rig.pipeline.feedback_outputs[1] = (struct rhw_feedback_output){.target = 1};
    rig.pipeline.feedback_output_count = 2;
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    begin_feedback(&rig, &target, 1);
    rig_expect_misuse(&rig, "count is 1; the pipeline that is set writes target 1");
    begin_feedback(&rig,
                   (const struct rhw_feedback_target[2]){{.buffer = buffer, .size = 128},
                                                         {.buffer = buffer, .offset = 124}},
                   2);
    rig_expect_misuse(&rig,
                      "it writes bytes 124 to 256 of buffer 1 \"kept\"; the transform feedback of this pass "
                      "writes bytes 0 to 128");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_close(&rig);
}

// Feedback that wrote nothing hides nothing of what was written beside it.
static void test_nothing_is_written(void **state)
{
    (void)state;
    struct rig rig;
    open_feedback(&rig, &(struct rhw_context_def){.threads = 1});
    keep_numbers(&rig);
    const rhw_buffer buffer = make_buffer(&rig, 256);
    for (int n = 0; n < 20; n++) { // ranges stand in another order each time
        static const uint8_t places[] = {0, 64, 128, 32, 96};
        char byte;
        rig_begin(&rig);
        rig_use_pipeline(&rig);
        for (int i = 0; i < 10; i++) {
            const size_t offset = places[(i * 3 + n) % 5];
            begin_feedback(&rig,
                           &(struct rhw_feedback_target){.buffer = buffer, .offset = offset, .size = 32}, 1);
            if (i >= 5) {
                rhw_pass_draw(rig.context, rig.recording, 0, 3, 0, 1);
            }
            end_feedback(&rig, NULL);
        }
        assert_int_equal(rig.misuses, 0);
        for (int i = 0; i < 5; i++) {
            assert_int_equal(rhw_buffer_read(rig.context, buffer, places[i], &byte, 1), RHW_ERROR_MISUSE);
            rig_expect_misuse(&rig, "the transform feedback of this pass writes");
            assert_int_equal(rhw_buffer_read(rig.context, buffer, places[i] + 12, &byte, 1), RHW_OK);
        }
        rhw_pass_cancel(rig.context, rig.recording);
    }
    rhw_buffer_destroy(rig.context, buffer);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_topologies),
    cmocka_unit_test(test_sources_and_places),
    cmocka_unit_test(test_any_threads_and_waves),
    cmocka_unit_test(test_overflow),
    cmocka_unit_test(test_kept_vertices_are_drawn),
    cmocka_unit_test(test_misuse_of_pipelines),
    cmocka_unit_test(test_misuse_in_a_pass),
    cmocka_unit_test(test_nothing_is_written),
};

const struct unit_tests test_transform_feedback = UNIT_TESTS(tests, NULL, NULL);
