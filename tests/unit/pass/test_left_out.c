// SPDX-License-Identifier: MIT
// Colour attachments that a pass leaves out: what is written to them goes nowhere, and the others keep their numbers,
// by every path.
#include "harness.h"

#include <string.h>

enum { SIDE = 80, TARGETS = 4 };

static rhw_texture make(const struct rig *rig, enum rhw_format format, int samples)
{
    const struct rhw_texture_def def = {.format = format, .width = SIDE, .height = SIDE, .samples = samples};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

// Target t gets the value and t; but not target 2, whose rubbish nobody sees.
static void write_all(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int t = 0; t < TARGETS; t++) {
            for (int c = 0; c < 4 && t != 2; c++) {
                groups[g].color[t][c] = groups[g].varying[c] + (float)t;
            }
        }
    }
}

// Target 3 gets what is in the others.
static void add_inputs(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            const rhw_float all =
                groups[g].color[0][c] + groups[g].color[1][c] * 10 + groups[g].color[2][c] * 100;
            groups[g].color[3][c] = all;
        }
    }
}

// Targets 1 and 3 of four, of 4 bytes, or of 16 and 4.
static void set_targets(struct rig *rig, bool is_wide, int samples)
{
    const enum rhw_format format = is_wide ? RHW_FORMAT_RGBA32_FLOAT : RHW_FORMAT_R32_FLOAT;
    memset(rig->pass.colors, 0, sizeof rig->pass.colors);
    memset(rig->pipeline.targets, 0, sizeof rig->pipeline.targets);
    rig->pass.color_count = rig->pipeline.target_count = TARGETS;
    rig->pass.colors[1].texture = make(rig, RHW_FORMAT_R32_FLOAT, 1);
    rig->pass.colors[3].texture = make(rig, format, 1);
    rig->pipeline.targets[1].format = RHW_FORMAT_R32_FLOAT;
    rig->pipeline.targets[3].format = format;
    rig->pipeline.targets[3].blend = true;
    rig->pipeline.targets[3].color =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    rig->pass.samples = samples;
}

static float red_of(const void *texels, int i, bool is_wide)
{
    float value;
    memcpy(&value, (const char *)texels + (size_t)i * (is_wide ? 16 : 4), sizeof value);
    return value;
}

// Two rectangles over each other, the nearer one first, in each of two halves.
static void draw(const struct rhw_context_def *def, bool is_wide, int samples, bool has_depth)
{
    struct rig rig;
    struct rig_vertex vertices[6];
    rig_open_with(&rig, SIDE, SIDE, def);
    if (has_depth) {
        rig_set_depth(&rig);
        rig.pass.depth = (struct rhw_depth_attachment){.enabled = true, .store = RHW_STORE_DISCARD};
    }
    rig_set_program(&rig, rig_vertex_pass, write_all);
    set_targets(&rig, is_wide, samples);
    rig_begin(&rig);
    for (int i = 0; i < 4; i++) {
        const float value[4] = {(float)(1 << i), 0, 0, 1}, x = (float)(i / 2 * SIDE / 2);
        rig_rectangle(&rig, x, 3, x + SIDE / 2, SIDE, i % 2 ? 0.75f : 0.25f, value, vertices);
        rig_draw(&rig, vertices, 6);
    }
    rig_end(&rig);
    const float *const tops = rig_read(&rig, rig.pass.colors[1].texture);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const float first = i % SIDE < SIDE / 2 ? 1 : 4;
        assert_true(tops[i] == (i / SIDE < 3 ? 0 : has_depth ? first + 1 : 2 * first + 1));
    }
    const void *const sums = rig_read(&rig, rig.pass.colors[3].texture);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const float first = i % SIDE < SIDE / 2 ? 1 : 4;
        assert_true(red_of(sums, i, is_wide) == (i / SIDE < 3 ? 0 : has_depth ? first + 3 : 3 * first + 6));
    }
    rig_close(&rig);
}

static void test_outputs(void **state)
{
    (void)state;
    static const struct rhw_context_def defs[] = {{.threads = 2},
                                                  {.threads = 2, .paths = RHW_PATHS_GENERAL},
                                                  {.threads = 2, .isa_limit = RHW_ISA_UP_TO_BASELINE},
                                                  {.threads = 2, .validate = RHW_VALIDATE_ON},
                                                  {.threads = 2, .bin_memory = 1}};
    for (size_t i = 0; i < sizeof defs / sizeof defs[0]; i++) {
        for (int bits = 0; bits < 8; bits++) {
            draw(&defs[i], bits & 1, bits & 2 ? 4 : 1, bits & 4);
        }
    }
}

// As inputs they are 0, and clears pass them by.
static void test_inputs_and_clears(void **state)
{
    (void)state;
    for (int samples = 1; samples <= 4; samples += 3) {
        struct rig rig;
        struct rig_vertex vertices[6];
        static const float zero[4];
        rig_open(&rig, SIDE, SIDE);
        rig_set_program(&rig, rig_vertex_pass, add_inputs);
        set_targets(&rig, false, samples);
        rig.pipeline.targets[3].blend = false;
        rig.pipeline.program.uses = RHW_USE_COLOR_INPUT;
        rig_cover(&rig, 0, zero, vertices);
        const struct rhw_rect rect = {0, 0, SIDE, 5};
        const struct rhw_clear clear = {
            .colors = 0xf, .color = {{7}, {2}, {7}, {7}}, .rects = &rect, .rect_count = 1};
        rig_begin(&rig);
        rhw_pass_clear_attachments(rig.context, rig.recording, &clear);
        rig_draw(&rig, vertices, 6);
        rhw_pass_clear_attachments(rig.context, rig.recording,
                                   &(struct rhw_clear){.colors = 1, .color = {{9}}});
        rig_end(&rig);
        const float *const sums = rig_read(&rig, rig.pass.colors[3].texture);
        for (int i = 0; i < SIDE * SIDE; i++) {
            assert_true(sums[i] == (i / SIDE < 5 ? 20 : 0));
        }
        rig_close(&rig);
    }
}

// The pass has the size, samples and layers of the first that is there.
static void test_first_attachment(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    const struct rhw_texture_def def = {
        .format = RHW_FORMAT_R8_UNORM, .width = 100, .height = 70, .layers = 3, .samples = 4};
    rhw_texture layers;
    assert_int_equal(rhw_texture_create(rig.context, &def, &layers), RHW_OK);
    const struct rhw_pass_def pass = {.color_count = 3,
                                      .colors = {[2] = {.texture = layers, .layer_count = 3}}};
    assert_int_equal(rhw_pass_begin(rig.context, &pass, &rig.recording), RHW_OK);
    assert_int_equal(rhw_pass_tile_count(rig.context, rig.recording), 2 * 2 * 3);
    rhw_pass_cancel(rig.context, rig.recording);
    // None is there, which is no definition that leaves some out.
    const struct rhw_pass_def none = {.color_count = 2, .width = 8, .height = 8};
    assert_int_equal(rhw_pass_begin(rig.context, &none, &rig.recording), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "colors[0].texture is null, and so are all others; give one of them a texture");
    rig.pipeline.targets[0].format = RHW_FORMAT_NONE;
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "targets[0].format is not set (RHW_FORMAT_NONE), nor is that of another target");
    rig_close(&rig);
}

static void test_pipelines_match(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIDE, SIDE);
    set_targets(&rig, false, 1);
    rig.pipeline.targets[3].blend = false;
    rig_begin(&rig);
    rig.pipeline.targets[0].format = RHW_FORMAT_RGBA8_UNORM;
    rig_use_pipeline(&rig);
    rig_expect_misuse(&rig, "target 0 of pipeline 1 is RHW_FORMAT_RGBA8_UNORM; the attachment is left out");
    rig.pipeline.targets[0].format = rig.pipeline.targets[3].format = RHW_FORMAT_NONE;
    rig_use_pipeline(&rig);
    rig_expect_misuse(&rig, "target 3 of pipeline 2 is left out; the attachment is RHW_FORMAT_R32_FLOAT");
    rhw_pass_cancel(rig.context, rig.recording);
    rig_close(&rig);
}

// In waves too what is left out takes no memory.
static void test_memory(void **state)
{
    (void)state;
    enum { WIDE = 512, TRIANGLES = 4000 };
    static struct rig_vertex vertices[3 * TRIANGLES];
    size_t peaks[2];
    for (int leaves_out = 0; leaves_out < 2; leaves_out++) {
        struct rig rig;
        rig_open_with(&rig, WIDE, WIDE, &(struct rhw_context_def){.threads = 1, .bin_memory = 1});
        rig.pass.color_count = rig.pipeline.target_count = leaves_out ? RHW_MAX_COLOR_ATTACHMENTS : 1;
        memset(rig.pipeline.targets + 1, 0, sizeof rig.pipeline.targets - sizeof rig.pipeline.targets[0]);
        for (int i = 0; i < 3 * TRIANGLES; i++) {
            const int t = i / 3, x = t % 64 * 8, y = t / 64 * 8;
            rig_place(&rig, (float)(x + i % 3 % 2 * 8), (float)(y + i % 3 / 2 * 8), 0.5f, 1,
                      vertices[i].position);
        }
        rig_draw_once(&rig, vertices, 3 * TRIANGLES);
        assert_true(rig.stats.flushes > 0);
        peaks[leaves_out] = rig.stats.memory_peak;
        rig_close(&rig);
    }
    assert_true(peaks[1] < peaks[0] + (size_t)WIDE * WIDE * 4);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_outputs), cmocka_unit_test(test_inputs_and_clears),
    cmocka_unit_test(test_first_attachment), cmocka_unit_test(test_memory),
    cmocka_unit_test(test_pipelines_match)};

const struct unit_tests test_left_out = UNIT_TESTS(tests, NULL, NULL);
