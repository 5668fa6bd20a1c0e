// SPDX-License-Identifier: MIT
// The history of a sample (rhw/explain.h): numbers worked out by hand, what becomes of fragments, and that the history leads
// from the clear value to what the attachments have in the end, over random scenes on every kind of path.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 80, MOST = 400 }; // two tiles each way

struct history {
    int count;
    struct rhw_explained_fragment fragments[MOST];
    float varyings[MOST][8];
};

static void keep(void *user, const struct rhw_explained_fragment *fragment)
{
    struct history *const history = user;
    assert_true(history->count < MOST);
    history->fragments[history->count] = *fragment;
    for (int i = 0; i < fragment->component_count && i < 8; i++) {
        history->varyings[history->count][i] = fragment->varyings[i];
    }
    history->count++;
}

static void ask(struct rig *rig, struct history *history, int x, int y, int sample)
{
    history->count = 0;
    rig_begin(rig);
    rhw_pass_explain(
        rig->context, rig->recording,
        &(struct rhw_explain){.x = x, .y = y, .sample = sample, .fragment = keep, .user = history});
}

// By hand ---------------------------------------------------------------------------------------------

// The right triangle (0, 0), (16, 0), (0, 16) with W = 1, 2, 4, at the centre of pixel (3, 2): r, s, t = 5/8, 7/32, 5/32,
// 1/W = 5/8 + 7/64 + 5/128 = 99/128, so a, b, c = 80/99, 14/99, 5/99.
static void test_a_triangle_by_hand(void **state)
{
    (void)state;
    struct rig rig;
    static struct history history;
    rig_open(&rig, SIZE, SIZE);
    struct rig_vertex vertices[3] = {
        {.value = {1, 0, 0, 3}}, {.value = {0, 1, 0, 5}}, {.value = {0, 0, 1, 7}}};
    rig_place(&rig, 0, 0, 0.25f, 1, vertices[0].position);
    rig_place(&rig, 16, 0, 0.25f, 2, vertices[1].position);
    rig_place(&rig, 0, 16, 0.25f, 4, vertices[2].position);
    rig.pipeline.label = "by hand";
    ask(&rig, &history, 3, 2, 0);
    rig_draw(&rig, vertices, 3);
    rig_end(&rig);
    assert_int_equal(history.count, 1);
    const struct rhw_explained_fragment *const f = &history.fragments[0];
    assert_int_equal(f->draw, 0);
    assert_int_equal(f->primitive, 0);
    assert_int_equal(f->instance, 0);
    assert_int_equal(f->fate, RHW_FRAGMENT_WRITTEN);
    assert_int_equal(f->covered, 1);
    assert_true(f->is_snapped && !f->is_clipped && f->is_shaded);
    const int32_t x[3] = {0, 4096, 0}, y[3] = {0, 0, 4096};
    assert_memory_equal(f->x, x, sizeof x);
    assert_memory_equal(f->y, y, sizeof y);
    assert_int_equal(f->sample_x, 3 * 256 + 128);
    assert_int_equal(f->sample_y, 2 * 256 + 128);
    assert_int_equal(f->edge[0], 5 << 21);
    assert_int_equal(f->edge[1], 7 << 19);
    assert_int_equal(f->edge[2], 5 << 19);
    assert_true(f->screen[0] == 0.625 && f->screen[1] == 7 / 32.0 && f->screen[2] == 5 / 32.0);
    assert_true(f->inverse_w == 99 / 128.0);
    assert_true(fabsf(f->weights[0] - 80 / 99.0f) < 1e-6f && f->weights[1] == (float)(14 / 99.0) &&
                f->weights[2] == (float)(5 / 99.0));
    assert_true(f->place[0] == 0.5f && f->place[1] == 0.5f);
    assert_true(f->depth == 0.25f);
    for (int i = 0; i < 3; i++) {
        assert_memory_equal(f->position[i], vertices[i].position, sizeof f->position[i]);
    }
    assert_int_equal(f->component_count, 4);
    const float w = (3 * 80 + 5 * 14 + 7 * 5) / 99.0f;
    assert_true(fabsf(history.varyings[0][3] - w) < 1e-6f);
    assert_memory_equal(history.varyings[0], rig_read_float4(&rig)[2 * SIZE + 3], 4 * sizeof(float));
    assert_memory_equal(f->output[0], history.varyings[0], 4 * sizeof(float));
    assert_memory_equal(f->color_after[0], history.varyings[0], 4 * sizeof(float));
    assert_true(f->color_before[0][3] == 0);
    rig_close(&rig);
}

// Fates -----------------------------------------------------------------------------------------------

static void discarding_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].mask &= rhw_less(rhw_splat(1.5f), groups[g].color[0][0]);
    }
}

static void draw_layer(struct rig *rig, float depth, float red, bool discards)
{
    struct rig_vertex all[6];
    rig_cover(rig, depth, (const float[4]){red, 0, 0, 1}, all);
    rig->pipeline.program.uses = discards ? RHW_USE_DISCARD : 0;
    rig_set_program(rig, rig_vertex_pass, discards ? discarding_fragment : rig_fragment_pass);
    rig_draw(rig, all, 6);
}

static void test_what_becomes_of_fragments(void **state)
{
    (void)state;
    struct rig rig;
    static struct history history;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig.pipeline.targets[0].blend = true;
    rig.pipeline.targets[0].color = rig.pipeline.targets[0].alpha =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    ask(&rig, &history, 70, 9, 0);
    draw_layer(&rig, 0.5f, 1, false);
    draw_layer(&rig, 0.75f, 2, false); // behind
    draw_layer(&rig, 0.25f, 1, true);  // discards 1
    draw_layer(&rig, 0.75f, 2, true);  // would keep 2, but lies behind
    draw_layer(&rig, 0.25f, 4, true);
    rig_end(&rig);
    assert_int_equal(history.count, 5);
    static const enum rhw_fragment_fate fates[5] = {RHW_FRAGMENT_WRITTEN, RHW_FRAGMENT_FAILED_EARLY,
                                                    RHW_FRAGMENT_DISCARDED, RHW_FRAGMENT_FAILED_EARLY,
                                                    RHW_FRAGMENT_WRITTEN};
    static const float colors[6] = {0, 1, 1, 1, 1, 5}, depths[6] = {1, 0.5f, 0.5f, 0.5f, 0.5f, 0.25f};
    for (int i = 0; i < 5; i++) {
        const struct rhw_explained_fragment *const f = &history.fragments[i];
        assert_int_equal(f->draw, i);
        // What is discarded is also tested early, as far as that is allowed.
        assert_true(f->fate == fates[i] || (i == 3 && f->fate == RHW_FRAGMENT_FAILED_LATE));
        assert_true(f->color_before[0][0] == colors[i] && f->color_after[0][0] == colors[i + 1]);
        assert_true(f->depth_before == depths[i] && f->depth_after == depths[i + 1]);
    }
    rig_close(&rig);
}

static void masking_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].sample_mask &= rhw_int_from_float(groups[g].color[0][0]);
    }
}

// What the function's sample mask and alpha to coverage leave out, in passes of one sample and of four, with a depth
// test that waits for them and without.
static void test_masked_samples(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        const bool by_alpha = i & 1, tests_depth = i & 2;
        struct rig rig;
        static struct history history;
        struct rig_vertex all[6];
        rig_open(&rig, SIZE, SIZE);
        rig_set_depth(&rig);
        rig.pass.samples = i & 4 ? 4 : 1;
        rig.pipeline.depth_test = tests_depth;
        rig.pipeline.alpha_to_coverage = by_alpha;
        if (!by_alpha) {
            rig_set_program(&rig, rig_vertex_pass, masking_fragment);
            rig.pipeline.program.uses = RHW_USE_SAMPLE_MASK;
        }
        const int sample = i & 4 ? 2 : 0;
        ask(&rig, &history, 70, 9, sample);
        for (int n = 0; n < 3; n++) { // left out; kept; behind that
            const float kept = (float)(n > 0), mask = (float)(1 << sample) * kept;
            rig_cover(&rig, n == 2 ? 0.75f : 0.5f, (const float[4]){mask, 0, 0, kept}, all);
            rig_draw(&rig, all, 6);
        }
        rig_end(&rig);
        assert_int_equal(history.count, 3);
        assert_int_equal(history.fragments[0].fate, RHW_FRAGMENT_DISCARDED);
        assert_int_equal(history.fragments[1].fate, RHW_FRAGMENT_WRITTEN);
        const enum rhw_fragment_fate last = history.fragments[2].fate;
        assert_true(tests_depth ? last == RHW_FRAGMENT_FAILED_EARLY || last == RHW_FRAGMENT_FAILED_LATE
                                : last == RHW_FRAGMENT_WRITTEN);
        rig_close(&rig);
    }
}

static void test_depth_alone(void **state)
{
    (void)state;
    struct rig rig;
    static struct history history;
    struct rig_vertex all[6];
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig.pipeline.targets[0].write_mask = RHW_WRITE_NONE;
    rig_set_program(&rig, rig_vertex_pass, NULL);
    rig_cover(&rig, 0.5f, (const float[4]){0}, all);
    ask(&rig, &history, 0, 79, 0);
    rig_draw(&rig, all, 6);
    rig_draw(&rig, all, 6);
    rig_end(&rig);
    assert_int_equal(history.count, 2);
    assert_int_equal(history.fragments[0].fate, RHW_FRAGMENT_WRITTEN);
    assert_int_equal(history.fragments[1].fate, RHW_FRAGMENT_FAILED_EARLY);
    assert_false(history.fragments[0].is_shaded);
    rig_close(&rig);
}

// Samples ---------------------------------------------------------------------------------------------

// A rectangle from x = 40.5 on covers of pixel 40 the samples on the right: Vulkan's standard positions 2 and 3 of 4.
static void test_samples(void **state)
{
    (void)state;
    struct rig rig;
    static struct history history;
    rig_open(&rig, SIZE, SIZE);
    rig.pass.samples = 4;
    struct rig_vertex half[6];
    rig_rectangle(&rig, 40.5f, 0, SIZE, SIZE, 0.5f, (const float[4]){1, 2, 3, 4}, half);
    for (int sample = 0; sample < 4; sample++) {
        ask(&rig, &history, 40, 17, sample);
        rig_draw(&rig, half, 6);
        rig_end(&rig);
        const bool right = sample == 1 || sample == 3; // x = 0.875, 0.625
        assert_int_equal(history.count, right);
        if (right) {
            assert_int_equal(history.fragments[0].covered, 1 << 1 | 1 << 3);
            assert_true(history.fragments[0].color_after[0][1] == 2 && history.fragments[0].place[0] == 0.5f);
            assert_int_equal(history.fragments[0].sample_x, 40 * 256 + (sample == 1 ? 224 : 160));
        }
    }
    assert_true(rig_read_float4(&rig)[17 * SIZE + 40][0] == 0.5f); // resolved
    rig_close(&rig);
}

// Whole scenes ----------------------------------------------------------------------------------------

static void draw_scene(struct rig *rig, uint64_t seed)
{
    uint64_t random = seed;
    for (int i = 0; i < 60; i++) {
        struct rig_vertex vertices[3];
        const float size = rig_random_int(&random, 3) == 0 ? 200.0f : 20.0f;
        const float x = rig_random_float(&random, 0, SIZE), y = rig_random_float(&random, 0, SIZE);
        for (int k = 0; k < 3; k++) {
            const float w = rig_random_int(&random, 15) == 0 ? -0.5f : rig_random_float(&random, 0.5f, 3);
            rig_place(rig, x + rig_random_float(&random, -size, size),
                      y + rig_random_float(&random, -size, size), rig_random_float(&random, 0, 1), w,
                      vertices[k].position);
            for (int c = 0; c < 4; c++) {
                vertices[k].value[c] = rig_random_float(&random, 0, 2);
            }
        }
        const bool discards = rig_random_int(&random, 3) == 0;
        rig->pipeline.program.uses = discards ? RHW_USE_DISCARD : 0;
        rig->pipeline.targets[0].blend = rig_random_int(&random, 2);
        rig->pipeline.targets[0].color = rig->pipeline.targets[0].alpha =
            (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
        rig->pipeline.depth_read_only = rig_random_int(&random, 3) == 0;
        rig_set_program(rig, rig_vertex_pass, discards ? discarding_fragment : rig_fragment_pass);
        rig_draw(rig, vertices, 3);
    }
}

// The clear values become what the picture has, step by step; and the picture is that of a pass without a question.
static void expect_chain(const struct history *history, const float color[4], float depth)
{
    float last[4] = {0}, last_depth = 1;
    int draw = -1;
    for (int i = 0; i < history->count; i++) {
        const struct rhw_explained_fragment *const f = &history->fragments[i];
        assert_true((int)f->draw > draw);
        assert_memory_equal(f->color_before[0], last, sizeof last);
        assert_true(f->depth_before == last_depth);
        const bool passes = f->depth < f->depth_before;
        assert_true(passes || f->fate == RHW_FRAGMENT_FAILED_EARLY || f->fate == RHW_FRAGMENT_FAILED_LATE ||
                    f->fate == RHW_FRAGMENT_DISCARDED);
        assert_true(!passes || f->fate == RHW_FRAGMENT_WRITTEN || f->fate == RHW_FRAGMENT_DISCARDED);
        if (f->fate != RHW_FRAGMENT_WRITTEN) {
            assert_memory_equal(f->color_after[0], last, sizeof last);
        } else {
            assert_true(f->is_shaded && f->inverse_w > 0);
            assert_true(f->is_clipped || (f->edge[0] >= 0 && f->edge[1] >= 0 && f->edge[2] >= 0));
        }
        draw = (int)f->draw;
        memcpy(last, f->color_after[0], sizeof last);
        last_depth = f->depth_after;
    }
    assert_memory_equal(last, color, sizeof last);
    assert_true(last_depth == depth);
}

static void test_histories_lead_to_the_picture(void **state)
{
    (void)state;
    static struct history history;
    static float colors[SIZE * SIZE][4], depths[SIZE * SIZE];
    struct rig rig, waves;
    rig_open(&rig, SIZE, SIZE);
    rig_open_with(&waves, SIZE, SIZE, &(struct rhw_context_def){.threads = 3, .bin_memory = 1});
    rig_set_depth(&rig);
    rig_set_depth(&waves);
    int most = 0;
    for (uint64_t scene = 1; scene <= 4; scene++) {
        rig_begin(&rig);
        draw_scene(&rig, scene);
        rig_end(&rig);
        memcpy(colors, rig_read_float4(&rig), sizeof colors);
        memcpy(depths, rig_read_depth(&rig), sizeof depths);
        for (int i = 0; i < 40; i++) {
            const int x = i * 31 % SIZE, y = i * 17 % SIZE;
            struct rig *const asked = i % 2 ? &waves : &rig;
            ask(asked, &history, x, y, 0);
            draw_scene(asked, scene);
            rig_end(asked);
            assert_memory_equal(rig_read_float4(asked), colors, sizeof colors);
            assert_memory_equal(rig_read_depth(asked), depths, sizeof depths);
            expect_chain(&history, colors[y * SIZE + x], depths[y * SIZE + x]);
            most = history.count > most ? history.count : most;
        }
    }
    assert_true(most > 8);
    rig_close(&rig);
    rig_close(&waves);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    static struct history history;
    rig_open(&rig, SIZE, SIZE);
    struct rig_vertex all[6];
    rig_cover(&rig, 0.5f, (const float[4]){0}, all);
    struct rhw_explain explain = {.x = SIZE, .y = 1, .fragment = keep, .user = &history};
    rig_begin(&rig);
    rhw_pass_explain(rig.context, rig.recording, NULL);
    rig_expect_misuse(&rig, "rhw_pass_explain: explain.fragment is NULL");
    rhw_pass_explain(rig.context, rig.recording, &explain);
    rig_expect_misuse(&rig, "rhw_pass_explain: (80, 1) lies outside of what the pass draws, 0,0 80x80");
    explain.x = 1;
    explain.layer = 1;
    rhw_pass_explain(rig.context, rig.recording, &explain);
    rig_expect_misuse(&rig, "rhw_pass_explain: layer is 1; the pass has 1");
    explain.layer = 0;
    explain.sample = 1;
    rhw_pass_explain(rig.context, rig.recording, &explain);
    rig_expect_misuse(&rig, "rhw_pass_explain: sample is 1; a pixel has 1");
    explain.sample = 0;
    rhw_pass_explain(rig.context, rig.recording, &explain);
    rhw_pass_explain(rig.context, rig.recording, &explain);
    rig_expect_misuse(&rig, "rhw_pass_explain: the pass explains a sample already");
    rig_end(&rig);
    rig_begin(&rig);
    rig_draw(&rig, all, 6);
    rhw_pass_explain(rig.context, rig.recording, &explain);
    rig_expect_misuse(&rig, "rhw_pass_explain: the pass has drawn already; call it before");
    rig_end(&rig);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_a_triangle_by_hand),
    cmocka_unit_test(test_what_becomes_of_fragments),
    cmocka_unit_test(test_masked_samples),
    cmocka_unit_test(test_depth_alone),
    cmocka_unit_test(test_samples),
    cmocka_unit_test(test_histories_lead_to_the_picture),
    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_explain = UNIT_TESTS(tests, NULL, NULL);
