// SPDX-License-Identifier: MIT
// Recordings: each run draws what a pass draws that is recorded anew; what is copied and what is read when it runs; what
// is refused; recorders on threads of their own.
#include "harness.h"

#include <pthread.h>
#include <string.h>

enum { SIZE = 80, QUADS = 40 };

// A rig with all that a recording uses. Colours are tint · texel, and every fragment adds 1 to a counter.
struct scene {
    struct rig rig;
    rhw_context *recorder;
    rhw_buffer vertices, indices, counter;
    rhw_texture texture;
    rhw_sampler sampler;
    rhw_pipeline pipeline;
    float tint[4]; // memory of the program
};

static void shade(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const float *const tint = groups[g].uniforms;
        const rhw_float at[2] = {groups[g].varying[0], groups[g].varying[1]};
        const struct rhw_sample_request request = {.coordinates = at};
        rhw_float texel[4];
        rhw_sample(groups[g].bindings, 0, &request, texel);
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = texel[c] * rhw_splat(tint[c]) + groups[g].varying[2];
        }
        rhw_storage_atomic(groups[g].bindings, 0, RHW_STORAGE_ADD, rhw_splat_int(0), rhw_splat_int(1),
                           groups[g].mask);
    }
}

static void make_buffers(struct scene *s)
{
    static struct rig_vertex vertices[4 * QUADS];
    uint16_t indices[5 * QUADS]; // strips of four and a restart
    uint64_t random = 5;
    for (int i = 0; i < 4 * QUADS; i++) {
        const int quad = i / 4, x = quad * 7 % SIZE, y = quad * 11 % SIZE;
        rig_place(&s->rig, (float)(x + 20 * (i & 1)), (float)(y + 10 * (i & 2)), 0, 1, vertices[i].position);
        for (int c = 0; c < 4; c++) {
            vertices[i].value[c] = rig_random_float(&random, 0, 1);
        }
    }
    for (int i = 0; i < 5 * QUADS; i++) {
        indices[i] = (uint16_t)(i % 5 == 4 ? 0xffff : i / 5 * 4 + i % 5);
    }
    const struct rhw_buffer_def defs[] = {{.size = sizeof vertices, .data = vertices, .label = "vertices"},
                                          {.size = sizeof indices, .data = indices, .label = "indices"},
                                          {.size = 4, .label = "counter"}};
    assert_int_equal(rhw_buffer_create(s->rig.context, &defs[0], &s->vertices), RHW_OK);
    assert_int_equal(rhw_buffer_create(s->rig.context, &defs[1], &s->indices), RHW_OK);
    assert_int_equal(rhw_buffer_create(s->rig.context, &defs[2], &s->counter), RHW_OK);
}

static void write_texture(struct scene *s, uint8_t value)
{
    uint8_t texels[8 * 8 * 4];
    memset(texels, value, sizeof texels);
    assert_int_equal(rhw_texture_write(s->rig.context, s->texture, 0, texels, 0), RHW_OK);
}

static void open_scene(struct scene *s, const struct rhw_context_def *context_def)
{
    *s = (struct scene){.tint = {1, 1, 1, 1}};
    rig_open_with(&s->rig, SIZE, SIZE, context_def);
    make_buffers(s);
    struct rhw_texture_def def = rhw_texture_def_default();
    def.format = RHW_FORMAT_RGBA8_SRGB;
    def.width = def.height = 8;
    def.label = "texture";
    assert_int_equal(rhw_texture_create(s->rig.context, &def, &s->texture), RHW_OK);
    write_texture(s, 100);
    struct rhw_sampler_def sampler = rhw_sampler_def_default();
    sampler.label = "sampler";
    assert_int_equal(rhw_sampler_create(s->rig.context, &sampler, &s->sampler), RHW_OK);
    struct rhw_pipeline_def pipeline = s->rig.pipeline;
    pipeline.program.fragment[RHW_ISA_BASELINE] = shade;
    pipeline.program.uniform_size = sizeof s->tint;
    pipeline.program.uses = RHW_USE_EFFECTS;
    pipeline.topology = RHW_TRIANGLE_STRIP;
    pipeline.primitive_restart = true;
    pipeline.label = "pipeline";
    assert_int_equal(rhw_pipeline_create(s->rig.context, &pipeline, &s->pipeline), RHW_OK);
    assert_int_equal(rhw_recorder_create(s->rig.context, &s->recorder), RHW_OK);
}

static void open_usual(struct scene *s)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 2;
    open_scene(s, &def);
}

static void close_scene(struct scene *s)
{
    rhw_context_destroy(s->recorder);
    rig_close(&s->rig);
}

// Record the scene in a context, which may be a recorder.
static rhw_pass record(const struct scene *s, rhw_context *context, bool copies_tint)
{
    const struct rhw_clear clear = {.colors = 1,
                                    .color = {{0.5f, 0.25f, 0, 1}},
                                    .rects = &(struct rhw_rect){3, 4, 50, 20},
                                    .rect_count = 1};
    const struct rhw_rect scissor = {5, 6, SIZE - 10, SIZE - 9};
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(context, &s->rig.pass, &pass), RHW_OK);
    rhw_pass_clear_attachments(context, pass, &clear);
    rhw_pass_set_pipeline(context, pass, s->pipeline);
    rhw_pass_set_scissor(context, pass, &scissor);
    rhw_pass_set_vertex_buffer(context, pass, 0, s->vertices, 0);
    rhw_pass_set_index_buffer(context, pass, s->indices, RHW_INDEX_UINT16, 0);
    rhw_pass_set_texture(context, pass, 0, s->texture, s->sampler);
    rhw_pass_set_storage_buffer(context, pass, 0, s->counter, 0, 0);
    if (copies_tint) {
        rhw_pass_set_uniforms(context, pass, s->tint, sizeof s->tint);
    } else {
        rhw_pass_set_uniform_memory(context, pass, s->tint, sizeof s->tint);
    }
    rhw_pass_draw_indexed(context, pass, 0, 5 * QUADS, 0, 0, 1);
    return pass;
}

static rhw_recording *keep(const struct scene *s, bool copies_tint)
{
    rhw_recording *recording;
    const rhw_pass pass = record(s, s->recorder, copies_tint);
    assert_int_equal(
        rhw_pass_keep(s->recorder, pass, &(struct rhw_recording_def){.label = "scene"}, &recording), RHW_OK);
    return recording;
}

static uint64_t drawn_once(struct scene *s)
{
    const rhw_pass pass = record(s, s->rig.context, true);
    assert_int_equal(rhw_pass_end(s->rig.context, pass, NULL), RHW_OK);
    return rig_hash(&s->rig, 0);
}

static uint64_t drawn_again(struct scene *s, rhw_recording *recording)
{
    assert_int_equal(rhw_recording_run(s->rig.context, recording, NULL), RHW_OK);
    return rig_hash(&s->rig, 0);
}

static uint32_t counted(struct scene *s)
{
    uint32_t count;
    assert_int_equal(rhw_buffer_read(s->rig.context, s->counter, 0, &count, sizeof count), RHW_OK);
    return count;
}

static void clear_target(struct scene *s)
{
    const struct rhw_clear_value value = {.color = {9, 9, 9, 9}};
    assert_int_equal(rhw_texture_clear(s->rig.context, s->rig.pass.colors[0].texture, NULL, &value), RHW_OK);
}

static void test_runs_draw_what_a_pass_draws(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    const uint64_t whole = drawn_once(&s);
    const uint32_t once = counted(&s);
    assert_true(once > 0);
    rhw_recording *const recording = keep(&s, true);
    for (uint32_t i = 2; i < 5; i++) {
        clear_target(&s); // also what tiles know of clear values
        struct rhw_stats stats;
        assert_int_equal(rhw_recording_run(s.rig.context, recording, &stats), RHW_OK);
        assert_int_equal(stats.draws, 2);
        assert_int_equal(rig_hash(&s.rig, 0), whole);
        assert_int_equal(counted(&s), i * once); // storage is written by each run
    }
    rhw_recording_destroy(recording);
    close_scene(&s);
}

// What is copied is the uniforms that were set; what buffers, textures and memory hold is read by each run.
static void test_runs_read_what_things_hold(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    const uint64_t whole = drawn_once(&s);
    rhw_recording *const copied = keep(&s, true), *const read = keep(&s, false);
    s.tint[0] = 0.5f;
    assert_int_equal(drawn_again(&s, copied), whole);
    const uint64_t tinted = drawn_again(&s, read);
    assert_int_not_equal(tinted, whole);
    assert_int_equal(tinted, drawn_once(&s));

    write_texture(&s, 200);
    const uint64_t textured = drawn_once(&s);
    assert_int_not_equal(textured, tinted);
    write_texture(&s, 100);
    assert_int_equal(drawn_again(&s, read), tinted);
    write_texture(&s, 200);
    assert_int_equal(drawn_again(&s, read), textured);

    struct rig_vertex vertex = {{0, 0, 0, 1}, {1, 1, 1, 1}};
    assert_int_equal(rhw_buffer_write(s.rig.context, s.vertices, 0, &vertex, sizeof vertex), RHW_OK);
    const uint64_t moved = drawn_again(&s, read);
    assert_int_not_equal(moved, textured);
    assert_int_equal(moved, drawn_once(&s));
    void *mapped;
    assert_int_equal(rhw_buffer_map(s.rig.context, s.vertices, 0, sizeof vertex, RHW_MAP_READ_WRITE, &mapped),
                     RHW_OK);
    vertex.value[2] = 0;
    memcpy(mapped, &vertex, sizeof vertex);
    rhw_buffer_unmap(s.rig.context, s.vertices);
    assert_int_not_equal(drawn_again(&s, read), moved);

    // Indices of strips with restart are those that were recorded.
    const uint64_t before = drawn_again(&s, read);
    const uint16_t index = 3;
    assert_int_equal(rhw_buffer_write(s.rig.context, s.indices, 0, &index, sizeof index), RHW_OK);
    assert_int_equal(drawn_again(&s, read), before);
    assert_int_not_equal(drawn_once(&s), before);
    rhw_recording_destroy(copied);
    rhw_recording_destroy(read);
    close_scene(&s);
}

// A run loads what the attachment holds, and passes between see what it drew.
static void test_runs_load_attachments(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    s.rig.pass.colors[0].load = RHW_LOAD_LOAD;
    rhw_recording *const recording = keep(&s, true);
    clear_target(&s);
    const uint64_t loaded = drawn_again(&s, recording);
    clear_target(&s);
    assert_int_equal(drawn_once(&s), loaded);
    s.rig.pass.colors[0].load = RHW_LOAD_CLEAR;
    assert_int_not_equal(drawn_once(&s), loaded);
    clear_target(&s);
    assert_int_equal(drawn_again(&s, recording), loaded);
    rhw_recording_destroy(recording);
    close_scene(&s);
}

static void test_queries_answer_for_the_last_run(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    rhw_query queries[2];
    for (int i = 0; i < 2; i++) {
        const struct rhw_query_def def = {.kind = i ? RHW_QUERY_STATISTICS : RHW_QUERY_OCCLUSION};
        assert_int_equal(rhw_query_create(s.rig.context, &def, &queries[i]), RHW_OK);
    }
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(s.recorder, &s.rig.pass, &pass), RHW_OK);
    rhw_pass_set_pipeline(s.recorder, pass, s.pipeline);
    rhw_pass_set_vertex_buffer(s.recorder, pass, 0, s.vertices, 0);
    rhw_pass_set_uniforms(s.recorder, pass, s.tint, sizeof s.tint);
    rhw_pass_begin_query(s.recorder, pass, queries[0]);
    rhw_pass_begin_query(s.recorder, pass, queries[1]);
    rhw_pass_draw(s.recorder, pass, 0, 4 * QUADS, 0, 1);
    rhw_pass_end_query(s.recorder, pass, queries[0]);
    rhw_pass_end_query(s.recorder, pass, queries[1]);
    rhw_pass_begin_query(s.recorder, pass, queries[0]); // a query is used once in a pass
    rig_expect_misuse(&s.rig, "was used in this pass");
    rhw_recording *recording;
    assert_int_equal(rhw_pass_keep(s.recorder, pass, NULL, &recording), RHW_ERROR_MISUSE);
    assert_null(recording);

    assert_int_equal(rhw_pass_begin(s.recorder, &s.rig.pass, &pass), RHW_OK);
    rhw_pass_set_pipeline(s.recorder, pass, s.pipeline);
    rhw_pass_set_vertex_buffer(s.recorder, pass, 0, s.vertices, 0);
    rhw_pass_set_uniforms(s.recorder, pass, s.tint, sizeof s.tint);
    rhw_pass_begin_query(s.recorder, pass, queries[0]);
    rhw_pass_begin_query(s.recorder, pass, queries[1]);
    rhw_pass_draw(s.recorder, pass, 0, 4 * QUADS, 0, 1);
    rhw_pass_end_query(s.recorder, pass, queries[0]);
    rhw_pass_end_query(s.recorder, pass, queries[1]);
    assert_int_equal(rhw_pass_keep(s.recorder, pass, NULL, &recording), RHW_OK);
    struct rhw_query_counts first[2], counts;
    for (int run = 0; run < 3; run++) {
        assert_int_equal(rhw_recording_run(s.rig.context, recording, NULL), RHW_OK);
        for (int i = 0; i < 2; i++) {
            assert_int_equal(rhw_query_read(s.rig.context, queries[i], &counts), RHW_OK);
            first[i] = run == 0 ? counts : first[i];
            assert_int_equal(counts.samples_passed, first[i].samples_passed);
            assert_memory_equal(&counts.statistics, &first[i].statistics, sizeof counts.statistics);
        }
    }
    assert_true(first[0].samples_passed > 0 && first[1].statistics.fragment_shader_invocations > 0);
    assert_int_equal(first[1].statistics.input_assembly_vertices, 4 * QUADS);
    rhw_query_destroy(s.rig.context, queries[0]); // nobody misses it
    assert_int_equal(rhw_recording_run(s.rig.context, recording, NULL), RHW_OK);
    rhw_query_destroy(s.rig.context, queries[1]);
    rhw_recording_destroy(recording);
    close_scene(&s);
}

// Vertices with effects are written anew by each run, and so is what transform feedback captures.
static void test_feedback_is_captured_by_each_run(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    struct rhw_pipeline_def def = s.rig.pipeline;
    def.topology = RHW_POINT_LIST;
    def.feedback_outputs[0] = (struct rhw_feedback_output){.source = RHW_FEEDBACK_VARYING};
    def.feedback_output_count = 1;
    def.program.vertex_effects = true;
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(s.rig.context, &def, &pipeline), RHW_OK);
    rhw_buffer captured;
    assert_int_equal(
        rhw_buffer_create(s.rig.context, &(struct rhw_buffer_def){.size = 64 * QUADS}, &captured), RHW_OK);
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(s.recorder, &s.rig.pass, &pass), RHW_OK);
    rhw_pass_set_pipeline(s.recorder, pass, pipeline);
    rhw_pass_set_vertex_buffer(s.recorder, pass, 0, s.vertices, 0);
    rhw_pass_begin_transform_feedback(s.recorder, pass, &(struct rhw_feedback_target){.buffer = captured}, 1);
    rhw_pass_draw(s.recorder, pass, 0, 4 * QUADS, 0, 1);
    size_t written[RHW_MAX_FEEDBACK_TARGETS];
    rhw_pass_end_transform_feedback(s.recorder, pass, written);
    assert_int_equal(written[0], 64 * QUADS);
    rhw_recording *recording;
    assert_int_equal(rhw_pass_keep(s.recorder, pass, NULL, &recording), RHW_OK);
    for (int run = 0; run < 2; run++) {
        const struct rig_vertex vertex = {{0, 0, 0, 1}, {(float)run, 2, 3, 4}};
        float values[4];
        assert_int_equal(rhw_buffer_write(s.rig.context, s.vertices, 0, &vertex, sizeof vertex), RHW_OK);
        assert_int_equal(rhw_recording_run(s.rig.context, recording, NULL), RHW_OK);
        assert_int_equal(rhw_buffer_read(s.rig.context, captured, 0, values, sizeof values), RHW_OK);
        assert_memory_equal(values, vertex.value, sizeof values);
    }
    rhw_recording_destroy(recording);
    rhw_buffer_destroy(s.rig.context, captured);
    rhw_pipeline_destroy(s.rig.context, pipeline);
    close_scene(&s);
}

// Triangles ---------------------------------------------------------------------------------------------

static _Atomic int vertex_calls;
static float shift; // what the vertex function reads beside its inputs

static void count_vertices(struct rhw_vertex *groups, int count)
{
    vertex_calls++;
    rig_vertex_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].position[0] += rhw_splat(shift);
    }
}

static bool calls_vertices(struct scene *s, rhw_recording *recording)
{
    vertex_calls = 0;
    (void)drawn_again(s, recording);
    return vertex_calls != 0;
}

static void check_kept_triangles(size_t bin_memory, enum rhw_validation validate, bool keeps)
{
    struct scene s;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 2;
    def.bin_memory = bin_memory;
    def.validate = validate;
    open_scene(&s, &def);
    struct rhw_pipeline_def pipeline = s.rig.pipeline;
    rig_set_program(&s.rig, count_vertices, shade);
    pipeline.program = s.rig.pipeline.program;
    pipeline.program.uniform_size = sizeof s.tint;
    pipeline.program.uses = RHW_USE_EFFECTS;
    rhw_pipeline_destroy(s.rig.context, s.pipeline);
    assert_int_equal(rhw_pipeline_create(s.rig.context, &pipeline, &s.pipeline), RHW_OK);
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(s.recorder, &s.rig.pass, &pass), RHW_OK);
    rhw_pass_set_pipeline(s.recorder, pass, s.pipeline);
    rhw_pass_set_vertex_buffer(s.recorder, pass, 0, s.vertices, 0);
    rhw_pass_set_texture(s.recorder, pass, 0, s.texture, s.sampler);
    rhw_pass_set_storage_buffer(s.recorder, pass, 0, s.counter, 0, 0);
    rhw_pass_set_uniform_memory(s.recorder, pass, s.tint, sizeof s.tint);
    for (uint32_t i = 0; i < 20; i++) {
        rhw_pass_draw(s.recorder, pass, 0, 4 * QUADS / 3 * 3, 0, 20);
    }
    rhw_recording *recording;
    assert_int_equal(
        rhw_pass_keep(s.recorder, pass, &(struct rhw_recording_def){.keeps_triangles = true}, &recording),
        RHW_OK);
    shift = 0;
    vertex_calls = 0;
    const uint64_t whole = drawn_again(&s, recording);
    assert_true(vertex_calls != 0);
    clear_target(&s);
    const uint32_t fragments = counted(&s);
    vertex_calls = 0;
    struct rhw_stats stats;
    assert_int_equal(rhw_recording_run(s.rig.context, recording, &stats), RHW_OK);
    assert_int_equal(vertex_calls == 0, keeps);
    assert_int_equal(stats.vertices_shaded == 0, keeps);
    assert_true(stats.triangles_rasterized != 0);
    assert_int_equal(rig_hash(&s.rig, 0), whole);
    assert_int_equal(counted(&s), 2 * fragments);
    s.tint[0] = 0.5f; // fragments are shaded by each run
    assert_int_not_equal(drawn_again(&s, recording), whole);
    s.tint[0] = 1;

    // What is written is seen; what the library does not see is told.
    assert_int_equal(calls_vertices(&s, recording), !keeps);
    struct rig_vertex vertex = {{0.5f, 0.5f, 0, 1}, {1, 1, 1, 1}};
    assert_int_equal(rhw_buffer_write(s.rig.context, s.vertices, 0, &vertex, sizeof vertex), RHW_OK);
    assert_true(calls_vertices(&s, recording));
    void *mapped;
    assert_int_equal(rhw_buffer_map(s.rig.context, s.vertices, 0, 0, RHW_MAP_READ_WRITE, &mapped), RHW_OK);
    rhw_buffer_unmap(s.rig.context, s.vertices);
    assert_true(calls_vertices(&s, recording));
    const uint64_t before = drawn_again(&s, recording);
    shift = 0.25f;
    rhw_recording_changed(recording);
    assert_int_not_equal(drawn_again(&s, recording), before);
    rhw_recording_destroy(recording);
    close_scene(&s);
}

static void test_triangles_are_kept(void **state)
{
    (void)state;
    check_kept_triangles(0, RHW_VALIDATE_OFF, true);
}

static void test_triangles_that_are_not_kept(void **state)
{
    (void)state;
    check_kept_triangles(1 << 12, RHW_VALIDATE_OFF, false); // several waves
    check_kept_triangles(0, RHW_VALIDATE_ON, false);
}

// Refusals ----------------------------------------------------------------------------------------------

static void expect_refused(struct scene *s, rhw_recording *recording, const char *part)
{
    clear_target(s);
    const uint64_t before = rig_hash(&s->rig, 0);
    assert_int_equal(rhw_recording_run(s->rig.context, recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&s->rig, part);
    assert_int_equal(rig_hash(&s->rig, 0), before);
}

static void test_what_was_destroyed_is_told(void **state)
{
    (void)state;
    for (int i = 0; i < 5; i++) {
        struct scene s;
        open_usual(&s);
        rhw_recording *const recording = keep(&s, true);
        (void)drawn_again(&s, recording);
        static const char *const labels[] = {"\"vertices\"", "\"counter\"", "\"texture\"", "\"sampler\"",
                                             "\"pipeline\""};
        switch (i) {
        case 0: rhw_buffer_destroy(s.rig.context, s.vertices); break;
        case 1: rhw_buffer_destroy(s.rig.context, s.counter); break;
        case 2: rhw_texture_destroy(s.rig.context, s.texture); break;
        case 3: rhw_sampler_destroy(s.rig.context, s.sampler); break;
        default: rhw_pipeline_destroy(s.rig.context, s.pipeline); break;
        }
        expect_refused(&s, recording, labels[i]);
        assert_non_null(strstr(s.rig.message, "rhw_recording_run \"scene\": "));
        assert_non_null(strstr(s.rig.message, "it was destroyed"));
        rhw_recording_destroy(recording);
        close_scene(&s);
    }
    struct scene s;
    open_usual(&s);
    rhw_recording *const recording = keep(&s, true);
    rhw_texture_destroy(s.rig.context, s.rig.pass.colors[0].texture);
    assert_int_equal(rhw_recording_run(s.rig.context, recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&s.rig, "it was destroyed");
    rhw_recording_destroy(recording);
    close_scene(&s);
}

// A write between draws of a pass gives a texture that it reads other memory. A buffer stays where it is, unless it is
// in a read-only slot.
static void test_other_memory_is_told(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    rhw_recording *const recording = keep(&s, true);
    const rhw_pass pass = record(&s, s.rig.context, true);
    const struct rig_vertex vertex = {{0, 0, 0, 1}, {1, 1, 1, 1}};
    assert_int_equal(rhw_buffer_write(s.rig.context, s.vertices, 0, &vertex, sizeof vertex), RHW_OK);
    assert_int_equal(rhw_pass_end(s.rig.context, pass, NULL), RHW_OK);
    assert_int_equal(drawn_again(&s, recording), drawn_once(&s));
    const rhw_pass bound = record(&s, s.rig.context, true);
    rhw_pass_set_read_only_storage_buffer(s.rig.context, bound, 1, s.vertices, 0, 0);
    rhw_pass_draw(s.rig.context, bound, 0, 3, 0, 1);
    assert_int_equal(rhw_buffer_write(s.rig.context, s.vertices, 0, &vertex, sizeof vertex), RHW_OK);
    assert_int_equal(rhw_pass_end(s.rig.context, bound, NULL), RHW_OK);
    expect_refused(&s, recording, "\"vertices\" was written between draws");
    rhw_recording *const again = keep(&s, true);
    assert_int_equal(drawn_again(&s, again), drawn_once(&s));

    const rhw_pass other = record(&s, s.rig.context, true);
    write_texture(&s, 3);
    assert_int_equal(rhw_pass_end(s.rig.context, other, NULL), RHW_OK);
    expect_refused(&s, again, "\"texture\" was written between draws");
    rhw_recording_destroy(recording);
    rhw_recording_destroy(again);
    close_scene(&s);
}

static void test_mapped_bytes_are_told(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    rhw_recording *const recording = keep(&s, true);
    void *mapped;
    assert_int_equal(rhw_buffer_map(s.rig.context, s.vertices, 64, 64, RHW_MAP_READ, &mapped), RHW_OK);
    (void)drawn_again(&s, recording); // both read
    rhw_buffer_unmap(s.rig.context, s.vertices);
    assert_int_equal(rhw_buffer_map(s.rig.context, s.vertices, 64, 64, RHW_MAP_READ_WRITE, &mapped), RHW_OK);
    expect_refused(&s, recording, "are mapped for writing");
    rhw_buffer_unmap(s.rig.context, s.vertices);
    assert_int_equal(rhw_buffer_map(s.rig.context, s.counter, 0, 0, RHW_MAP_READ, &mapped), RHW_OK);
    expect_refused(&s, recording, "\"counter\" are mapped");
    rhw_buffer_unmap(s.rig.context, s.counter);
    (void)drawn_again(&s, recording);
    rhw_recording_destroy(recording);
    close_scene(&s);
}

static void test_what_recorders_do_not_do(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    rhw_recording *const recording = keep(&s, true), *none = recording;
    rhw_buffer buffer;
    assert_int_equal(rhw_buffer_create(s.recorder, &(struct rhw_buffer_def){.size = 4}, &buffer),
                     RHW_ERROR_MISUSE);
    rig_expect_misuse(&s.rig, "the context is a recorder");
    assert_int_equal(rhw_recording_run(s.recorder, recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&s.rig, "the context is a recorder");
    rhw_context_destroy(s.rig.context);
    rig_expect_misuse(&s.rig, "a recorder of the context lives");

    rhw_pass pass = record(&s, s.recorder, true);
    assert_int_equal(rhw_pass_end(s.recorder, pass, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&s.rig, "call rhw_pass_keep");
    rhw_pass_cancel(s.recorder, pass);
    assert_int_equal(rhw_pass_keep(s.recorder, pass, NULL, &none), RHW_ERROR_MISUSE);
    rig_expect_misuse(&s.rig, "its pass has ended");
    assert_null(none);

    pass = record(&s, s.rig.context, true);
    assert_int_equal(rhw_pass_keep(s.rig.context, pass, NULL, &none), RHW_ERROR_MISUSE);
    rig_expect_misuse(&s.rig, "the context is no recorder");
    assert_int_equal(rhw_recording_run(s.rig.context, recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&s.rig, "a pass is being recorded");
    rhw_pass_cancel(s.rig.context, pass);
    expect_refused(&s, NULL, "recording is NULL");

    // Each recorder has passes of its own.
    rhw_context *second;
    rhw_pass own;
    assert_int_equal(rhw_recorder_create(s.rig.context, &second), RHW_OK);
    assert_int_equal(rhw_pass_begin(second, &s.rig.pass, &own), RHW_OK);
    pass = record(&s, s.recorder, true);
    rhw_pass_set_pipeline(second, pass, s.pipeline);
    rig_expect_misuse(&s.rig, "the pass belongs to another context");
    rhw_pass_set_pipeline(s.recorder, own, s.pipeline);
    rig_expect_misuse(&s.rig, "the pass belongs to another context");
    rhw_pass_cancel(second, own);
    rhw_pass_cancel(s.recorder, pass);
    rhw_context_destroy(second);

    // A level that is attached is not sampled, in recordings too.
    assert_int_equal(rhw_pass_begin(s.recorder, &s.rig.pass, &pass), RHW_OK);
    rhw_pass_set_texture(s.recorder, pass, 0, s.rig.pass.colors[0].texture, s.sampler);
    rig_expect_misuse(&s.rig, "is an attachment of this pass");
    rhw_pass_set_vertex_buffer(s.recorder, pass, 0, s.vertices, 0);
    rhw_pass_set_storage_buffer(s.recorder, pass, 0, s.vertices, 16, 16);
    rig_expect_misuse(&s.rig, "they must lie apart");
    assert_int_equal(rhw_pass_keep(s.recorder, pass, NULL, &none), RHW_ERROR_MISUSE);

    struct scene other;
    open_usual(&other);
    assert_int_equal(rhw_recording_run(other.rig.context, recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&other.rig, "belongs to another context");
    close_scene(&other);
    close_scene(&s);
    rhw_recording_destroy(recording); // it outlives its context
    rhw_recording_destroy(NULL);
}

// What a recorder has set may be destroyed before it draws: nothing that has gone is looked at.
static void test_indices_that_were_destroyed(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(s.recorder, &s.rig.pass, &pass), RHW_OK);
    rhw_pass_set_pipeline(s.recorder, pass, s.pipeline);
    rhw_pass_set_vertex_buffer(s.recorder, pass, 0, s.vertices, 0);
    rhw_pass_set_index_buffer(s.recorder, pass, s.indices, RHW_INDEX_UINT16, 0);
    rhw_pass_set_uniforms(s.recorder, pass, s.tint, sizeof s.tint);
    rhw_buffer_destroy(s.rig.context, s.indices);
    rhw_pass_draw_indexed(s.recorder, pass, 0, 5 * QUADS, 0, 0, 1);
    rig_expect_misuse(&s.rig, "it was destroyed");
    rhw_pass_cancel(s.recorder, pass);
    close_scene(&s);
}

// What a pass of a recorder looks at stays, also where the texture got other memory meanwhile.
static void test_replaced_memory_stays(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    struct rhw_pass_def def = rhw_pass_def_default();
    def.color_count = 1;
    def.colors[0].texture = s.texture;
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(s.recorder, &def, &pass), RHW_OK);
    const rhw_pass other = record(&s, s.rig.context, true);
    write_texture(&s, 3);
    assert_int_equal(rhw_pass_end(s.rig.context, other, NULL), RHW_OK);
    rhw_pass_set_texture(s.recorder, pass, 0, s.rig.pass.colors[0].texture, s.sampler);
    rhw_pass_cancel(s.recorder, pass);
    close_scene(&s);
}

// Under validation a recording tells what a pass tells.
static void shade_nothing(struct rhw_fragment *groups, int count)
{
    (void)groups;
    (void)count;
}

static void test_validation_tells(void **state)
{
    (void)state;
    struct scene s;
    struct rhw_context_def def = rhw_context_def_default();
    def.threads = 1;
    def.validate = RHW_VALIDATE_ON;
    open_scene(&s, &def);
    struct rhw_pipeline_def bad = s.rig.pipeline;
    bad.program.fragment[RHW_ISA_BASELINE] = shade_nothing;
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(s.rig.context, &bad, &pipeline), RHW_OK);
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(s.recorder, &s.rig.pass, &pass), RHW_OK);
    rhw_pass_set_vertex_buffer(s.recorder, pass, 0, s.vertices, 0);
    rhw_pass_push_debug_group(s.recorder, pass, "group");
    rhw_pass_set_pipeline(s.recorder, pass, pipeline);
    rhw_pass_draw(s.recorder, pass, 0, 3, 0, 1);
    rhw_pass_pop_debug_group(s.recorder, pass);
    rhw_recording *recording;
    assert_int_equal(
        rhw_pass_keep(s.recorder, pass, &(struct rhw_recording_def){.label = "told"}, &recording), RHW_OK);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(rhw_recording_run(s.rig.context, recording, NULL), RHW_ERROR_MISUSE);
        rig_expect_misuse(&s.rig, "[draw 0 in group of pass \"told\"]");
    }
    rhw_recording_destroy(recording);
    rhw_recording *const good = keep(&s, true);
    assert_int_equal(drawn_again(&s, good), drawn_once(&s));
    rhw_recording_destroy(good);
    close_scene(&s);
}

// Threads -----------------------------------------------------------------------------------------------

struct recording_thread {
    struct scene *scene;
    float tint;
    rhw_context *recorder;
    rhw_recording *kept;
};

static void *record_many(void *user)
{
    struct recording_thread *const thread = user;
    struct scene scene = *thread->scene;
    for (int c = 0; c < 4; c++) {
        scene.tint[c] = thread->tint;
    }
    scene.recorder = thread->recorder;
    for (int i = 0; i < 20; i++) {
        rhw_recording_destroy(thread->kept);
        const rhw_pass pass = record(&scene, scene.recorder, true);
        if (rhw_pass_keep(scene.recorder, pass, NULL, &thread->kept) != RHW_OK) {
            return NULL;
        }
    }
    rhw_context_destroy(scene.recorder); // any thread may do this
    return thread;
}

// Two threads record while the first one works with the context.
static void test_threads_record_at_once(void **state)
{
    (void)state;
    struct scene s;
    open_usual(&s);
    rhw_recording *const own = keep(&s, true);
    struct recording_thread users[2] = {{&s, 0.25f, NULL, NULL}, {&s, 0.75f, NULL, NULL}};
    pthread_t threads[2];
    const uint64_t whole = drawn_once(&s);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(rhw_recorder_create(s.rig.context, &users[i].recorder), RHW_OK);
    }
    for (int i = 0; i < 2; i++) {
        assert_int_equal(pthread_create(&threads[i], NULL, record_many, &users[i]), 0);
    }
    for (int i = 0; i < 20; i++) {
        assert_int_equal(drawn_again(&s, own), whole);
        rhw_buffer buffer;
        assert_int_equal(rhw_buffer_create(s.rig.context, &(struct rhw_buffer_def){.size = 4}, &buffer),
                         RHW_OK);
    }
    for (int i = 0; i < 2; i++) {
        void *result;
        assert_int_equal(pthread_join(threads[i], &result), 0);
        assert_ptr_equal(result, &users[i]);
    }
    uint64_t hashes[2];
    for (int i = 0; i < 2; i++) {
        memcpy(s.tint, (float[4]){users[i].tint, users[i].tint, users[i].tint, users[i].tint}, sizeof s.tint);
        hashes[i] = drawn_once(&s);
    }
    assert_int_not_equal(hashes[0], hashes[1]);
    for (int i = 0; i < 4; i++) { // in any order
        assert_int_equal(drawn_again(&s, users[i & 1].kept), hashes[i & 1]);
    }
    assert_int_equal(drawn_again(&s, own), whole);
    rhw_recording_destroy(own);
    rhw_recording_destroy(users[0].kept);
    rhw_recording_destroy(users[1].kept);
    close_scene(&s);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_runs_draw_what_a_pass_draws),
    cmocka_unit_test(test_runs_read_what_things_hold),
    cmocka_unit_test(test_runs_load_attachments),
    cmocka_unit_test(test_queries_answer_for_the_last_run),
    cmocka_unit_test(test_feedback_is_captured_by_each_run),
    cmocka_unit_test(test_triangles_are_kept),
    cmocka_unit_test(test_triangles_that_are_not_kept),
    cmocka_unit_test(test_what_was_destroyed_is_told),
    cmocka_unit_test(test_other_memory_is_told),
    cmocka_unit_test(test_mapped_bytes_are_told),
    cmocka_unit_test(test_what_recorders_do_not_do),
    cmocka_unit_test(test_indices_that_were_destroyed),
    cmocka_unit_test(test_replaced_memory_stays),
    cmocka_unit_test(test_validation_tells),
    cmocka_unit_test(test_threads_record_at_once),
};

const struct unit_tests test_recording = UNIT_TESTS(tests, NULL, NULL);
