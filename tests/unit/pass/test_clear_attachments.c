// SPDX-License-Identifier: MIT
// Attachments cleared within a pass: against a model among random draws; layers, samples, integers, what is left alone, and
// what is refused.
#include "harness.h"

#include <string.h>

enum { WIDTH = 100, HEIGHT = 75, PIXELS = WIDTH * HEIGHT, TARGETS = 2 };

struct model {
    float color[TARGETS][PIXELS], depth[PIXELS];
    uint8_t stencil[PIXELS];
};

static void two_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int t = 0; t < TARGETS; t++) {
            for (int c = 0; c < 4; c++) {
                groups[g].color[t][c] = groups[g].varying[0] + (float)t;
            }
        }
    }
}

static rhw_texture make_target(struct rig *rig, enum rhw_format format, int samples, int layers)
{
    rhw_texture texture;
    const struct rhw_texture_def def = {
        .format = format, .width = WIDTH, .height = HEIGHT, .samples = samples, .layers = layers};
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static struct rhw_rect random_rect(uint64_t *random)
{
    struct rhw_rect r;
    r.x = rig_random_int(random, WIDTH);
    r.y = rig_random_int(random, HEIGHT);
    r.width = 1 + rig_random_int(random, WIDTH - r.x);
    r.height = 1 + rig_random_int(random, HEIGHT - r.y);
    return r;
}

static bool is_in(const struct rhw_rect *r, int i)
{
    const int x = i % WIDTH, y = i / WIDTH;
    return x >= r->x && x < r->x + r->width && y >= r->y && y < r->y + r->height;
}

// A rectangle that passes where it is nearer and the stencil is even, and increments that.
static void draw_some(struct rig *rig, struct model *model, uint64_t *random)
{
    const struct rhw_rect r = random_rect(random);
    const float depth = (float)rig_random_int(random, 9) / 8, value = (float)rig_random_int(random, 1000);
    struct rig_vertex vertices[6];
    rig_rectangle(rig, (float)r.x, (float)r.y, (float)(r.x + r.width), (float)(r.y + r.height), depth,
                  (const float[4]){value, value, value, value}, vertices);
    rig_draw(rig, vertices, 6);
    for (int i = 0; i < PIXELS; i++) {
        if (is_in(&r, i) && model->stencil[i] % 2 == 0 && depth < model->depth[i]) {
            model->color[0][i] = value;
            model->color[1][i] = value + 1;
            model->depth[i] = depth;
            model->stencil[i]++;
        }
    }
}

static void clear_some(struct rig *rig, struct model *model, uint64_t *random)
{
    struct rhw_rect rects[2] = {random_rect(random), random_rect(random)};
    struct rhw_clear clear = {.colors = (uint32_t)rig_random_int(random, 4),
                              .depth = rig_random_int(random, 2),
                              .stencil = rig_random_int(random, 2),
                              .depth_value = (float)rig_random_int(random, 9) / 8,
                              .stencil_value = (uint8_t)(2 * rig_random_int(random, 128)),
                              .rects = rects,
                              .rect_count = rig_random_int(random, 3)};
    if (clear.colors == 0 && !clear.depth) {
        clear.stencil = true;
    }
    for (int t = 0; t < TARGETS; t++) {
        for (int c = 0; c < 4; c++) {
            clear.color[t][c] = (float)-rig_random_int(random, 1000) + 0.1f;
        }
    }
    rhw_pass_clear_attachments(rig->context, rig->recording, &clear);
    for (int i = 0; i < PIXELS; i++) {
        if (clear.rect_count > 0 && !is_in(&rects[0], i) && (clear.rect_count < 2 || !is_in(&rects[1], i))) {
            continue;
        }
        for (int t = 0; t < TARGETS; t++) {
            model->color[t][i] = clear.colors >> t & 1 ? clear.color[t][3] : model->color[t][i];
        }
        model->depth[i] = clear.depth ? clear.depth_value : model->depth[i];
        model->stencil[i] = clear.stencil ? clear.stencil_value : model->stencil[i];
    }
}

static void set_state(struct rig *rig)
{
    rig_set_program(rig, rig_vertex_pass, two_fragment);
    rig->pipeline.depth_test = rig->pipeline.stencil_test = true;
    rig->pipeline.stencil_front = (struct rhw_stencil_face){
        .compares = true, .compare = RHW_COMPARE_EQUAL, .pass = RHW_STENCIL_INCREMENT_WRAP, .read_mask = 1};
    rig->pipeline.stencil_back = rig->pipeline.stencil_front;
    rig->pipeline.target_count = TARGETS;
    for (int t = 0; t < TARGETS; t++) {
        rig->pipeline.targets[t].format = RHW_FORMAT_RGBA32_FLOAT;
    }
}

static void compare_with_model(const struct rhw_context_def *context, int samples)
{
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, context);
    static struct model model;
    uint64_t random = (uint64_t)samples + 11;
    set_state(&rig);
    rig.pass.color_count = TARGETS;
    rig.pass.samples = samples;
    rig.pass.colors[1].texture = make_target(&rig, RHW_FORMAT_RGBA32_FLOAT, 1, 0);
    rig.pass.depth = (struct rhw_depth_attachment){
        .enabled = true, .texture = make_target(&rig, RHW_FORMAT_D32_FLOAT_S8_UINT, 1, 0), .clear = 1};
    for (int scene = 0; scene < 25; scene++) {
        memset(&model, 0, sizeof model);
        for (int i = 0; i < PIXELS; i++) {
            model.depth[i] = 1;
        }
        rig_begin(&rig);
        for (int i = 0; i < 14; i++) {
            if (rig_random_int(&random, 3) == 0) {
                clear_some(&rig, &model, &random);
            } else {
                draw_some(&rig, &model, &random);
            }
        }
        rig_end(&rig);
        for (int t = 0; t < TARGETS; t++) {
            const float *const texels = rig_read(&rig, rig.pass.colors[t].texture);
            for (int i = 0; i < PIXELS; i++) {
                assert_true(texels[4 * i + 3] == model.color[t][i]);
            }
        }
        assert_memory_equal(rig_read_depth(&rig), model.depth, sizeof model.depth);
        static uint8_t stencil[PIXELS];
        assert_int_equal(rhw_texture_read_stencil(rig.context, rig.pass.depth.texture, 0, stencil, 0),
                         RHW_OK);
        assert_memory_equal(stencil, model.stencil, sizeof stencil);
    }
    rig_close(&rig);
}

static void test_among_draws(void **state)
{
    (void)state;
    for (int samples = 1; samples <= 4; samples *= 4) {
        compare_with_model(&(struct rhw_context_def){.threads = 2}, samples);
        compare_with_model(&(struct rhw_context_def){.threads = 1, .paths = RHW_PATHS_GENERAL}, samples);
        compare_with_model(&(struct rhw_context_def){.threads = 2, .bin_memory = 1}, samples);
        compare_with_model(&(struct rhw_context_def){.threads = 2, .validate = RHW_VALIDATE_ON}, samples);
    }
}

// Integers are bits; the layers that are named and no other; nothing that validation finds fault with.
static void test_layers_and_integers(void **state)
{
    (void)state;
    struct rig rig;
    rig_open_with(&rig, WIDTH, HEIGHT, &(struct rhw_context_def){.validate = RHW_VALIDATE_ON});
    const rhw_texture texture = make_target(&rig, RHW_FORMAT_RGBA16_SINT, 1, 4);
    rig.pass.colors[0] = (struct rhw_color_attachment){.texture = texture, .layer_count = 4};
    const struct rhw_rect rect = {3, 5, 70, 9};
    rig_begin(&rig);
    struct rhw_clear clear = {
        .colors = 1, .color_integer = {{-5, 32767, -32768, 9}}, .layer = 1, .layer_count = 2};
    rhw_pass_clear_attachments(rig.context, rig.recording, &clear);
    clear = (struct rhw_clear){
        .colors = 1, .color_integer = {{7, 7, 7, 7}}, .layer = 2, .rects = &rect, .rect_count = 1};
    rhw_pass_clear_attachments(rig.context, rig.recording, &clear); // 2 and 3
    rig_end(&rig);
    for (int layer = 0; layer < 4; layer++) {
        static int16_t texels[PIXELS][4];
        assert_int_equal(rhw_texture_read_layer(rig.context, texture, 0, layer, texels, 0), RHW_OK);
        for (int i = 0; i < PIXELS; i++) {
            const int16_t first = layer == 1 || layer == 2 ? -5 : 0, last = first ? 9 : 0;
            const bool is_seven = layer >= 2 && is_in(&rect, i);
            assert_int_equal(texels[i][0], is_seven ? 7 : first);
            assert_int_equal(texels[i][3], is_seven ? 7 : last);
        }
    }
    rig_close(&rig);
}

// Steps of a UNORM depth, sRGB, and what recording has set.
static void test_what_is_set_stays(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    rhw_query query;
    const struct rhw_query_def occlusion = {.kind = RHW_QUERY_OCCLUSION};
    assert_int_equal(rhw_query_create(rig.context, &occlusion, &query), RHW_OK);
    rig.pass.colors[0].texture = make_target(&rig, RHW_FORMAT_RGBA8_SRGB, 1, 0);
    rig.pass.depth = (struct rhw_depth_attachment){
        .enabled = true, .texture = make_target(&rig, RHW_FORMAT_D16_UNORM, 1, 0), .clear = 1};
    rig.pipeline.targets[0].format = RHW_FORMAT_RGBA8_SRGB;
    const struct rhw_rect scissor = {10, 10, 20, 20};
    struct rig_vertex all[6];
    rig_cover(&rig, 0.25f, (const float[4]){1, 1, 1, 1}, all);
    rig_begin(&rig);
    rhw_pass_set_scissor(rig.context, rig.recording, &scissor);
    rhw_pass_set_depth_bias(rig.context, rig.recording, &(struct rhw_depth_bias){.constant = 9000});
    rhw_pass_begin_query(rig.context, rig.recording, query);
    rig_draw(&rig, all, 6);
    const struct rhw_clear clear = {
        .colors = 1, .color = {{0.2158605f, 0, 1, 0.5f}}, .depth = true, .depth_value = 0.3f};
    rhw_pass_clear_attachments(rig.context, rig.recording, &clear);
    rhw_pass_draw(rig.context, rig.recording, 0, 6, 0, 1); // the same pipeline, buffer and scissor
    rhw_pass_end_query(rig.context, rig.recording, query);
    rig_end(&rig);
    static uint8_t texels[PIXELS][4];
    static uint16_t depth[PIXELS];
    assert_int_equal(rhw_texture_read(rig.context, rig.pass.colors[0].texture, 0, texels, 0), RHW_OK);
    assert_int_equal(rhw_texture_read(rig.context, rig.pass.depth.texture, 0, depth, 0), RHW_OK);
    for (int i = 0; i < PIXELS; i++) {
        static const uint8_t cleared[4] = {128, 0, 255, 128}, white[4] = {255, 255, 255, 255};
        assert_memory_equal(texels[i], is_in(&scissor, i) ? white : cleared, 4);
        assert_int_equal(depth[i], 19661); // round(0.3 · 65535)
    }
    struct rhw_query_counts counts;
    assert_int_equal(rhw_query_read(rig.context, query, &counts), RHW_OK);
    assert_int_equal(counts.samples_passed, 800);
    rig_close(&rig);
}

static void expect_refused(struct rig *rig, const struct rhw_clear *clear, const char *part)
{
    rhw_pass_clear_attachments(rig->context, rig->recording, clear);
    rig_expect_misuse(rig, part);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, WIDTH, HEIGHT);
    const struct rhw_rect outside = {90, 0, 11, 5}, empty = {0, 0, 0, 5};
    rig_begin(&rig);
    expect_refused(&rig, NULL, "clear is NULL");
    expect_refused(&rig, &(struct rhw_clear){0}, "nothing is to be cleared");
    expect_refused(&rig, &(struct rhw_clear){.colors = 2},
                   "colors is 0x2; the pass has 1 colour attachments");
    expect_refused(&rig, &(struct rhw_clear){.depth = true}, "the pass has no depth attachment");
    expect_refused(&rig, &(struct rhw_clear){.stencil = true}, "the pass has no stencil attachment");
    expect_refused(&rig, &(struct rhw_clear){.colors = 1, .depth_value = 1.5f}, "depth_value is 1.5");
    expect_refused(&rig, &(struct rhw_clear){.colors = 1, .layer = 1}, "layer is 1 and layer_count 0");
    expect_refused(&rig, &(struct rhw_clear){.colors = 1, .rect_count = 1},
                   "rect_count is 1 and rects is NULL");
    expect_refused(&rig, &(struct rhw_clear){.colors = 1, .rects = &outside, .rect_count = 1},
                   "rects[0] is 90,0 11x5; it lies within the pass's render area, 0,0 100x75");
    expect_refused(&rig, &(struct rhw_clear){.colors = 1, .rects = &empty, .rect_count = 1}, "rects[0] is");
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
    rhw_pass_clear_attachments(rig.context, rig.recording, &(struct rhw_clear){.colors = 1});
    rig_expect_misuse(&rig, "rhw_pass_clear_attachments");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_among_draws), cmocka_unit_test(test_layers_and_integers),
    cmocka_unit_test(test_what_is_set_stays), cmocka_unit_test(test_misuse)};

const struct unit_tests test_clear_attachments = UNIT_TESTS(tests, NULL, NULL);
