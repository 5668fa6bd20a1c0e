// SPDX-License-Identifier: MIT
// Passes that draw into nothing: what their shaders do to storage buffers and what queries count is as elsewhere.
#include "harness.h"

#include <string.h>

enum { WIDTH = 130, HEIGHT = 70, LAYERS = 3 };

// Layers go round by the triangle.
static void layer_vertex(struct rhw_vertex *groups, int count)
{
    rig_vertex_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].layer = rhw_int_from_float(groups[g].attribute[1][0]);
    }
}

// Word 0 counts fragments, words 1.. those of a layer.
static void count_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        const struct rhw_fragment *const f = &groups[g];
        const rhw_int one = rhw_splat_int(1);
        rhw_storage_atomic(f->textures, 0, RHW_STORAGE_ADD, rhw_splat_int(0), one, f->mask);
        rhw_storage_atomic(f->textures, 0, RHW_STORAGE_ADD, f->layer + 1, one, f->mask);
    }
}

static rhw_query make_query(struct rig *rig)
{
    rhw_query query;
    const struct rhw_query_def def = {.kind = RHW_QUERY_OCCLUSION};
    assert_int_equal(rhw_query_create(rig->context, &def, &query), RHW_OK);
    return query;
}

static void check(enum rhw_paths paths, int samples)
{
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, &(struct rhw_context_def){.threads = 2, .paths = paths});
    uint32_t words[1 + LAYERS] = {0};
    rhw_buffer buffer;
    const struct rhw_buffer_def storage = {.size = sizeof words, .data = words};
    assert_int_equal(rhw_buffer_create(rig.context, &storage, &buffer), RHW_OK);
    const rhw_query query = make_query(&rig);
    rig.pass = (struct rhw_pass_def){.width = WIDTH, .height = HEIGHT, .samples = samples, .layers = LAYERS};
    rig.pipeline.target_count = 0;
    rig.pipeline.program.writes_layer = true;
    rig.pipeline.program.uses = RHW_USE_EFFECTS | RHW_USE_LAYER;
    rig_set_program(&rig, layer_vertex, count_fragment);
    rig_begin(&rig);
    rhw_pass_set_storage_buffer(rig.context, rig.recording, 0, buffer, 0, 0);
    rhw_pass_begin_query(rig.context, rig.recording, query);
    for (int i = 0; i < LAYERS + 1; i++) { // the last has no layer
        const float value[4] = {(float)i, 0, 0, 0};
        struct rig_vertex vertices[6];
        rig_rectangle(&rig, 10, 5, 20 + 30 * (float)i, 60, 0.5f, value, vertices);
        rig_draw(&rig, vertices, 6);
    }
    rhw_pass_end_query(rig.context, rig.recording, query);
    rig_end(&rig);
    assert_int_equal(rhw_buffer_read(rig.context, buffer, 0, words, sizeof words), RHW_OK);
    for (int i = 0; i < LAYERS && samples == 1;
         i++) { // of several, a pixel of the diagonal is a fragment of both triangles
        assert_int_equal(words[1 + i], 55 * (10 + 30 * i));
    }
    const uint32_t pixels = 55 * (10 + 40 + 70);
    assert_true(samples == 1 ? words[0] == pixels : words[0] > pixels && words[0] < 2 * pixels);
    assert_int_equal(words[0], words[1] + words[2] + words[3]);
    struct rhw_query_counts counts;
    assert_int_equal(rhw_query_read(rig.context, query, &counts), RHW_OK);
    assert_int_equal(counts.samples_passed, (uint64_t)samples * pixels);
    rig_close(&rig);
}

static void test_effects_and_queries(void **state)
{
    (void)state;
    for (int samples = 1; samples <= 4; samples *= 4) {
        check(RHW_PATHS_ALL, samples);
        check(RHW_PATHS_GENERAL, samples);
    }
}

static void expect_refused(struct rig *rig, const struct rhw_pass_def *def, const char *part)
{
    rhw_pass pass;
    assert_int_equal(rhw_pass_begin(rig->context, def, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(rig, part);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 8, 8);
    expect_refused(&rig, &(struct rhw_pass_def){.width = 8},
                   "no attachment, so width and height must be set");
    expect_refused(&rig, &(struct rhw_pass_def){.width = 8, .height = 20000}, "the size is 8x20000");
    expect_refused(&rig, &(struct rhw_pass_def){.width = 8, .height = 8, .samples = 3}, "samples is 3");
    expect_refused(&rig, &(struct rhw_pass_def){.width = 8, .height = 8, .layers = -1}, "layers is -1");
    struct rhw_pass_def def = rig.pass;
    def.layers = 2;
    expect_refused(&rig, &def, "layers is 2 and the pass has an attachment");
    // A pipeline with a target finds none.
    rig.pass = (struct rhw_pass_def){.width = 8, .height = 8};
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    rig_expect_misuse(&rig, "target");
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(test_effects_and_queries),
                                          cmocka_unit_test(test_misuse)};

const struct unit_tests test_no_attachments = UNIT_TESTS(tests, NULL, NULL);
