// SPDX-License-Identifier: MIT
// Queries: occlusion counts against an exact model of every sample, whatever the paths, threads, instruction set and
// waves; pipeline statistics by hand; timestamps; what is refused.
#include "harness.h"

#include <string.h>

enum { SIZE = 72, PIXELS = SIZE * SIZE, TRIANGLES = 60, PER_QUERY = 3, QUERIES = TRIANGLES / PER_QUERY };

static rhw_query make_query(struct rig *rig, enum rhw_query_kind kind)
{
    rhw_query query;
    const struct rhw_query_def def = {.kind = kind, .label = "asked"};
    assert_int_equal(rhw_query_create(rig->context, &def, &query), RHW_OK);
    return query;
}

static void begin_query(struct rig *rig, rhw_query query)
{
    rhw_pass_begin_query(rig->context, rig->recording, query);
}

static void end_query(struct rig *rig, rhw_query query)
{
    rhw_pass_end_query(rig->context, rig->recording, query);
}

static struct rhw_query_counts read_query(struct rig *rig, rhw_query query)
{
    struct rhw_query_counts counts;
    memset(&counts, 0xff, sizeof counts);
    assert_int_equal(rhw_query_read(rig->context, query, &counts), RHW_OK);
    return counts;
}

// Against a model ------------------------------------------------------------------------------------

struct triangle {
    int64_t x[3], y[3];
    float depth;
    bool depth_test, read_only, discards, constant, draws_nothing;
    enum rhw_compare compare;
};

static void place_only(struct rhw_vertex *groups, int count)
{
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].position, groups[g].attribute[0], sizeof groups[g].position);
    }
}

static void white(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(1);
        }
    }
}

// Keeps even columns.
static void discard(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].mask &= rhw_equal_int(rhw_int_from_float(groups[g].coord[0]) & 1, rhw_splat_int(0));
    }
}

// Whether a point is inside a triangle of 1/256-pixel vertices, by the top-left rule; exact.
static bool covers(const struct triangle *t, int64_t px, int64_t py)
{
    const int64_t area =
        (t->x[1] - t->x[0]) * (t->y[2] - t->y[0]) - (t->x[2] - t->x[0]) * (t->y[1] - t->y[0]);
    bool inside = area != 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int64_t sign = area < 0 ? -1 : 1, a = sign * (t->y[i] - t->y[j]),
                      b = sign * (t->x[j] - t->x[i]);
        const int64_t e = a * (px - t->x[i]) + b * (py - t->y[i]);
        inside = inside && (e > 0 || (e == 0 && (a > 0 || (a == 0 && b > 0))));
    }
    return inside;
}

static bool holds(enum rhw_compare compare, double a, double b)
{
    switch (compare) {
    case RHW_COMPARE_NEVER: return false;
    case RHW_COMPARE_LESS: return a < b;
    case RHW_COMPARE_EQUAL: return a == b;
    case RHW_COMPARE_LESS_EQUAL: return a <= b;
    case RHW_COMPARE_GREATER: return a > b;
    case RHW_COMPARE_NOT_EQUAL: return a != b;
    case RHW_COMPARE_GREATER_EQUAL: return a >= b;
    case RHW_COMPARE_ALWAYS: return true;
    }
    return false;
}

// Every third is large, and most test depth in the same way, so that many could be drawn depth first.
static struct triangle random_triangle(uint64_t *random, int i)
{
    const int size = (i % 3 == 0 ? 2 * SIZE : i % 3 == 1 ? 20 : 3) * 256;
    struct triangle t = {.depth = (float)rig_random_int(random, 256) / 256};
    const int x = rig_random_int(random, SIZE * 256), y = rig_random_int(random, SIZE * 256);
    for (int v = 0; v < 3; v++) {
        t.x[v] = x + rig_random_int(random, size) - size / 2;
        t.y[v] = y + rig_random_int(random, size) - size / 2;
    }
    const bool usual = rig_random_int(random, 3) != 0;
    t.depth_test = usual || rig_random_int(random, 2);
    t.read_only = !usual && t.depth_test && rig_random_int(random, 2);
    t.compare = usual || !t.depth_test ? RHW_COMPARE_LESS : (enum rhw_compare)rig_random_int(random, 8);
    t.discards = rig_random_int(random, 4) == 0;
    t.constant = !t.discards && rig_random_int(random, 3) == 0;
    t.draws_nothing = !t.discards && !t.constant && rig_random_int(random, 4) == 0;
    return t;
}

struct answer {
    uint64_t samples, fragments;
};

// Draws into the depth of every sample, and adds to what a query has to find.
static void model_triangle(float *depth, const struct triangle *t, int samples, struct answer *answer)
{
    for (int i = 0; i < PIXELS; i++) {
        int covered = 0, passed = 0;
        for (int s = 0; s < samples; s++) {
            float position[2];
            assert_true(rhw_sample_position(samples, s, position));
            float *const texel = &depth[i * samples + s];
            if (!covers(t, i % SIZE * 256 + (int64_t)(position[0] * 256),
                        i / SIZE * 256 + (int64_t)(position[1] * 256))) {
                continue;
            }
            covered++;
            if ((t->discards && i % SIZE % 2 != 0) ||
                (t->depth_test && !holds(t->compare, (double)t->depth, (double)*texel))) {
                continue;
            }
            passed++;
            if (t->depth_test && !t->read_only) {
                *texel = t->depth;
            }
        }
        answer->samples += (uint64_t)passed;
        answer->fragments += t->draws_nothing ? 0 : t->discards ? covered != 0 : passed != 0;
    }
}

static void draw_triangle(struct rig *rig, const struct triangle *t)
{
    struct rig_vertex vertices[3];
    for (int i = 0; i < 3; i++) {
        rig_place(rig, (float)t->x[i] / 256, (float)t->y[i] / 256, t->depth, 1, vertices[i].position);
        memset(vertices[i].value, 0, sizeof vertices[i].value);
    }
    struct rhw_pipeline_def *const def = &rig->pipeline;
    def->depth_test = t->depth_test;
    def->depth_read_only = t->read_only;
    def->depth_compare = t->compare;
    def->program.uses = t->discards ? RHW_USE_DISCARD | RHW_USE_COORD : 0;
    def->program.varying_count = t->constant || t->draws_nothing ? 0 : 1;
    def->program.varyings[0].components = 4 * def->program.varying_count;
    def->targets[0].write_mask = t->draws_nothing ? RHW_WRITE_NONE : 0;
    rig_set_program(rig, t->constant || t->draws_nothing ? place_only : rig_vertex_pass,
                    t->draws_nothing ? NULL
                    : t->constant    ? white
                    : t->discards    ? discard
                                     : rig_fragment_pass);
    rig_draw(rig, vertices, 3);
}

static void compare_with_model(const struct rhw_context_def *context, int samples)
{
    static struct triangle triangles[TRIANGLES];
    static float depth[PIXELS * RHW_MAX_SAMPLES];
    struct answer answers[QUERIES] = {{0}};
    rhw_query occlusion[QUERIES], any[QUERIES], statistics[QUERIES];
    struct rig rig;
    uint64_t random = (uint64_t)samples;
    rig_open_with(&rig, SIZE, SIZE, context);
    rig.pass.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD};
    rig.pass.samples = samples;
    for (int i = 0; i < PIXELS * samples; i++) {
        depth[i] = 1;
    }
    rig_begin(&rig);
    for (int i = 0; i < TRIANGLES; i++) {
        const int q = i / PER_QUERY, n = i % PER_QUERY;
        triangles[i] = random_triangle(&random, i);
        struct answer none = {0}; // the last of each is outside all queries
        model_triangle(depth, &triangles[i], samples, n == PER_QUERY - 1 ? &none : &answers[q]);
        if (n == 0) {
            occlusion[q] = make_query(&rig, RHW_QUERY_OCCLUSION);
            any[q] = make_query(&rig, RHW_QUERY_ANY_PASSED);
            statistics[q] = make_query(&rig, RHW_QUERY_STATISTICS);
            begin_query(&rig, any[q]);
            begin_query(&rig, occlusion[q]);
            begin_query(&rig, statistics[q]);
        } else if (n == PER_QUERY - 1) {
            end_query(&rig, any[q]);
            end_query(&rig, statistics[q]);
            end_query(&rig, occlusion[q]);
        }
        draw_triangle(&rig, &triangles[i]);
    }
    rig_end(&rig);
    assert_true(context->bin_memory == 0 || rig.stats.flushes > 0);
    for (int q = 0; q < QUERIES; q++) {
        assert_int_equal(read_query(&rig, occlusion[q]).samples_passed, answers[q].samples);
        assert_int_equal(read_query(&rig, any[q]).any_passed, answers[q].samples != 0);
        assert_int_equal(read_query(&rig, statistics[q]).statistics.fragment_shader_invocations,
                         answers[q].fragments);
    }
    rig_close(&rig);
}

static void test_samples_against_a_model(void **state)
{
    (void)state;
    for (int samples = 1; samples <= RHW_MAX_SAMPLES; samples *= 2) {
        for (int paths = RHW_PATHS_ALL; paths <= RHW_PATHS_GENERAL; paths++) {
            compare_with_model(
                &(struct rhw_context_def){.threads = 1 + paths, .paths = (enum rhw_paths)paths}, samples);
        }
    }
}

static void test_threads_waves_and_instruction_sets(void **state)
{
    (void)state;
    for (int isa = 0; isa < RHW_ISA_COUNT; isa++) {
        for (int samples = 1; samples <= 4; samples *= 4) {
            compare_with_model(&(struct rhw_context_def){.threads = 1 + 3 * isa,
                                                         .isa_limit = rhw_isa_up_to((enum rhw_isa)isa)},
                               samples);
        }
    }
    compare_with_model(&(struct rhw_context_def){.threads = 2, .bin_memory = 1}, 1);
    compare_with_model(&(struct rhw_context_def){.threads = 2, .bin_memory = 1}, 4);
}

// By hand --------------------------------------------------------------------------------------------

// 9 × 5 pixels, over which 10 × 10 pixels nearer are drawn later, then 9 × 5 behind those.
static void test_what_is_hidden_later_is_counted(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex far_[6], near_[6];
    const float value[4] = {1, 1, 1, 1};
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig_rectangle(&rig, 60, 60, 69, 65, 0.5f, value, far_);
    rig_rectangle(&rig, 60, 60, 70, 70, 0.25f, value, near_);
    const rhw_query before = make_query(&rig, RHW_QUERY_OCCLUSION),
                    behind = make_query(&rig, RHW_QUERY_OCCLUSION),
                    any = make_query(&rig, RHW_QUERY_ANY_PASSED);
    rig_begin(&rig);
    begin_query(&rig, before);
    rig_draw(&rig, far_, 6);
    end_query(&rig, before);
    rig_draw(&rig, near_, 6);
    begin_query(&rig, behind);
    begin_query(&rig, any);
    rig_draw(&rig, far_, 6);
    end_query(&rig, any);
    rig_draw(&rig, near_, 6); // which is not less
    end_query(&rig, behind);
    rig_end(&rig);
    assert_int_equal(read_query(&rig, before).samples_passed, 45);
    assert_int_equal(read_query(&rig, behind).samples_passed, 0);
    assert_false(read_query(&rig, any).any_passed);
    // The next pass asks anew; without draws nothing passes.
    rig_begin(&rig);
    begin_query(&rig, before);
    end_query(&rig, before);
    rig_end(&rig);
    assert_int_equal(read_query(&rig, before).samples_passed, 0);
    rig_close(&rig);
}

// Layers from far to near, which a tile would draw depth first if nobody counted, and backwards without depth.
static void test_overdraw_is_counted(void **state)
{
    (void)state;
    for (int depth_test = 0; depth_test < 2; depth_test++) {
        struct rig rig;
        struct rig_vertex vertices[6];
        rig_open(&rig, SIZE, SIZE);
        rig_set_depth(&rig);
        rig.pipeline.depth_test = depth_test;
        const rhw_query query = make_query(&rig, RHW_QUERY_OCCLUSION);
        rig_begin(&rig);
        begin_query(&rig, query);
        for (int i = 0; i < 16; i++) {
            rig_cover(&rig, 1 - (float)(i + 1) / 32, (const float[4]){1, 1, 1, 1}, vertices);
            rig_draw(&rig, vertices, 6);
        }
        end_query(&rig, query);
        rig_end(&rig);
        assert_int_equal(read_query(&rig, query).samples_passed, 16 * PIXELS);
        rig_close(&rig);
    }
}

// Half of the samples of 16: by the mask, and by alpha.
static void test_dropped_samples_are_not_counted(void **state)
{
    (void)state;
    for (int way = 0; way < 2; way++) {
        struct rig rig;
        struct rig_vertex vertices[6];
        rig_open(&rig, SIZE, SIZE);
        rig.pass.samples = 16;
        rig.pipeline.sample_mask = way == 0 ? 0x5555 : 0;
        rig.pipeline.alpha_to_coverage = way == 1;
        rig_rectangle(&rig, 3, 3, 10, 13, 0.5f, (const float[4]){1, 1, 1, 0.5f}, vertices);
        const rhw_query query = make_query(&rig, RHW_QUERY_OCCLUSION);
        rig_begin(&rig);
        begin_query(&rig, query);
        rig_draw(&rig, vertices, 6);
        end_query(&rig, query);
        rig_end(&rig);
        assert_int_equal(read_query(&rig, query).samples_passed, 7 * 10 * 8);
        rig_close(&rig);
    }
}

// The vertices 0..7 of an octagon; 8 outside on the left, 9 in front of the near plane, 10 nowhere.
static void fill_octagon(const struct rig *rig, struct rig_vertex vertices[11])
{
    static const float at[11][3] = {{30, 10, 0.5f}, {42, 10, 0.5f}, {52, 20, 0.5f}, {52, 32, 0.5f},
                                    {42, 42, 0.5f}, {30, 42, 0.5f}, {20, 32, 0.5f}, {20, 20, 0.5f},
                                    {-9, 20, 0.5f}, {30, 30, -1},   {30, 30, 0.5f}};
    memset(vertices, 0, 11 * sizeof *vertices);
    for (int i = 0; i < 11; i++) {
        rig_place(rig, at[i][0], at[i][1], at[i][2], 1, vertices[i].position);
    }
    const uint32_t nan_bits = 0x7fc00000;
    memcpy(&vertices[10].position[0], &nan_bits, sizeof nan_bits);
}

static struct rhw_pipeline_statistics statistics_of(enum rhw_topology topology, bool restarts,
                                                    const uint16_t *indices, uint32_t count,
                                                    uint32_t instances)
{
    struct rig rig;
    struct rig_vertex vertices[11];
    rig_open(&rig, SIZE, SIZE);
    rig.pipeline.topology = topology;
    rig.pipeline.primitive_restart = restarts;
    fill_octagon(&rig, vertices);
    const rhw_query query = make_query(&rig, RHW_QUERY_STATISTICS);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, vertices, sizeof vertices);
    rig_use_indices(&rig, RHW_INDEX_UINT16, indices, count * sizeof *indices);
    begin_query(&rig, query);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, count, 0, 0, instances);
    end_query(&rig, query);
    rhw_pass_draw_indexed(rig.context, rig.recording, 0, count, 0, 0, instances);
    rig_end(&rig);
    const struct rhw_pipeline_statistics statistics = read_query(&rig, query).statistics;
    rig_close(&rig);
    return statistics;
}

static void expect_statistics(struct rhw_pipeline_statistics s, uint64_t vertices, uint64_t primitives,
                              uint64_t clipping, uint64_t fragments)
{
    assert_int_equal(s.input_assembly_vertices, vertices);
    assert_int_equal(s.vertex_shader_invocations, vertices);
    assert_int_equal(s.input_assembly_primitives, primitives);
    assert_int_equal(s.clipping_invocations, primitives);
    assert_int_equal(s.clipping_primitives, clipping);
    assert_int_equal(s.fragment_shader_invocations, fragments);
}

static void test_statistics(void **state)
{
    (void)state;
    // 32 × 32 pixels, less four corners of 10 × 10 / 2, of which half of the pixels on the slanted edge are covered:
    // those whose centres the top-left rule gives to it, the two on the left side, 10 each.
    const uint16_t fan[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    const uint64_t octagon = 32 * 32 - 4 * 50;
    const struct rhw_pipeline_statistics s = statistics_of(RHW_TRIANGLE_FAN, false, fan, 8, 3);
    assert_true(s.fragment_shader_invocations >= 3 * (octagon - 20) &&
                s.fragment_shader_invocations <= 3 * (octagon + 20));
    expect_statistics(s, 24, 18, 18, s.fragment_shader_invocations);
    // One triangle each: unfinished; outside; cut; not finite; of no area.
    const uint16_t list[17] = {0, 2, 4, 8, 8, 8, 0, 2, 9, 0, 2, 10, 1, 1, 1, 3, 4};
    const struct rhw_pipeline_statistics mixed = statistics_of(RHW_TRIANGLE_LIST, false, list, 17, 1);
    expect_statistics(mixed, 17, 5, 3, mixed.fragment_shader_invocations);
    // A strip of two, a single vertex, a strip of one.
    const uint16_t strip[9] = {0, 1, 2, 3, 0xffff, 4, 0xffff, 0xffff, 5};
    expect_statistics(statistics_of(RHW_TRIANGLE_STRIP, true, strip, 9, 2), 12, 4, 4,
                      statistics_of(RHW_TRIANGLE_STRIP, true, strip, 9, 2).fragment_shader_invocations);
    // Points: one pixel each; two are not in the view, one is twice there.
    const uint16_t points[5] = {0, 0, 8, 10, 3};
    expect_statistics(statistics_of(RHW_POINT_LIST, false, points, 5, 1), 5, 5, 3, 3);
    // A line of 12 pixels, one outside.
    const uint16_t lines[5] = {0, 1, 8, 8, 2};
    expect_statistics(statistics_of(RHW_LINE_LIST, false, lines, 5, 1), 5, 2, 1, 12);
}

static void test_timestamps(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    rhw_query times[4];
    uint64_t ns[4];
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .bin_memory = 1});
    rig_cover(&rig, 0.5f, (const float[4]){1, 1, 1, 1}, vertices);
    rig_begin(&rig);
    for (int i = 0; i < 4; i++) {
        times[i] = make_query(&rig, RHW_QUERY_TIMESTAMP);
        rhw_pass_write_timestamp(rig.context, rig.recording, times[i]);
        if (i < 3) {
            rig_use_pipeline(&rig);
            rig_use_vertices(&rig, 0, vertices, sizeof vertices);
            rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 200);
        }
    }
    rig_end(&rig);
    assert_true(rig.stats.flushes >= 2);
    for (int i = 0; i < 4; i++) {
        ns[i] = read_query(&rig, times[i]).timestamp_ns;
        assert_true(ns[i] != 0 && (i == 0 || ns[i] > ns[i - 1]));
    }
    // The whole is what the stages took.
    const double ms = (double)(ns[3] - ns[0]) * 1e-6;
    assert_true(ms <= (rig.stats.front_ms + rig.stats.back_ms) * 1.5 + 50);
    assert_true(ms >= (rig.stats.front_ms + rig.stats.back_ms) * 0.5);
    rig_close(&rig);
}

// What is refused ------------------------------------------------------------------------------------

static void test_misuse_of_ids(void **state)
{
    (void)state;
    struct rig rig;
    struct rhw_query_counts counts;
    memset(&counts, 0xff, sizeof counts);
    rhw_query query;
    rig_open(&rig, SIZE, SIZE);
    const struct rhw_query_def bad = {.kind = RHW_QUERY_KIND_COUNT};
    assert_int_equal(rhw_query_create(rig.context, &bad, &query), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_query_create: kind is ");
    query = make_query(&rig, RHW_QUERY_OCCLUSION);
    assert_int_equal(rhw_query_read(rig.context, query, &counts), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "query 1 \"asked\" has no answer; no pass that used it has ended");
    assert_true(counts.samples_passed == 0 && !counts.any_passed && counts.timestamp_ns == 0);
    assert_int_equal(rhw_query_read(rig.context, query, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "counts is NULL");
    rhw_query_destroy(rig.context, query);
    assert_int_equal(rhw_query_read(rig.context, query, &counts), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "query 1 \"asked\" (generation 1) is stale");
    rhw_query_destroy(rig.context, (rhw_query){0});
    rig_begin(&rig);
    begin_query(&rig, query);
    rig_expect_misuse(&rig, "rhw_pass_begin_query: query 1 \"asked\" (generation 1) is stale");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_close(&rig);
}

static void test_misuse_in_a_pass(void **state)
{
    (void)state;
    struct rig rig;
    struct rhw_query_counts counts;
    rig_open(&rig, SIZE, SIZE);
    const rhw_query a = make_query(&rig, RHW_QUERY_OCCLUSION), b = make_query(&rig, RHW_QUERY_OCCLUSION),
                    time = make_query(&rig, RHW_QUERY_TIMESTAMP);
    rig_begin(&rig);
    end_query(&rig, a);
    rig_expect_misuse(&rig, "rhw_pass_end_query: query 1 \"asked\" is not under way; begin it first");
    begin_query(&rig, a);
    begin_query(&rig, b);
    rig_expect_misuse(&rig, "query 2 \"asked\" is of kind OCCLUSION; one of that kind is under way");
    end_query(&rig, b);
    rig_expect_misuse(&rig, "query 2 \"asked\" is not under way");
    assert_int_equal(rhw_query_read(rig.context, a, &counts), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "query 1 \"asked\" is used by the pass being recorded; end it first");
    end_query(&rig, a);
    begin_query(&rig, a);
    rig_expect_misuse(&rig, "query 1 \"asked\" was used in this pass; a query is used once in a pass");
    begin_query(&rig, time);
    rig_expect_misuse(&rig, "is of kind TIMESTAMP; it is for rhw_pass_write_timestamp");
    rhw_pass_write_timestamp(rig.context, rig.recording, b);
    rig_expect_misuse(&rig, "query 2 \"asked\" is of kind OCCLUSION; it must be TIMESTAMP");
    begin_query(&rig, b);
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "rhw_pass_end: query 2 \"asked\" was begun and not ended");
    // A pass that is cancelled answers nothing.
    rig_begin(&rig);
    begin_query(&rig, a);
    end_query(&rig, a);
    rhw_pass_cancel(rig.context, rig.recording);
    assert_int_equal(rhw_query_read(rig.context, a, &counts), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "query 1 \"asked\" has no answer");
    rig_close(&rig);
}

// It is gone when the pass ends, and another one has its place.
static void test_destroyed_while_under_way(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    struct rhw_query_counts counts;
    rig_open(&rig, SIZE, SIZE);
    rig_cover(&rig, 0.5f, (const float[4]){1, 1, 1, 1}, vertices);
    const rhw_query query = make_query(&rig, RHW_QUERY_OCCLUSION);
    rig_begin(&rig);
    begin_query(&rig, query);
    rig_draw(&rig, vertices, 6);
    rhw_query_destroy(rig.context, query);
    const rhw_query other = make_query(&rig, RHW_QUERY_OCCLUSION);
    rig_end(&rig);
    assert_int_equal(other.index, query.index);
    assert_int_equal(rhw_query_read(rig.context, other, &counts), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "has no answer");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_samples_against_a_model),
    cmocka_unit_test(test_threads_waves_and_instruction_sets),
    cmocka_unit_test(test_what_is_hidden_later_is_counted),
    cmocka_unit_test(test_overdraw_is_counted),
    cmocka_unit_test(test_dropped_samples_are_not_counted),
    cmocka_unit_test(test_statistics),
    cmocka_unit_test(test_timestamps),
    cmocka_unit_test(test_misuse_of_ids),
    cmocka_unit_test(test_misuse_in_a_pass),
    cmocka_unit_test(test_destroyed_while_under_way),
};

const struct unit_tests test_query = UNIT_TESTS(tests, NULL, NULL);
