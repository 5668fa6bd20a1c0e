// SPDX-License-Identifier: MIT
// Passes with a render area: inside of it they draw what the whole pass would, and outside everything stays to the last
// byte, whatever is loaded, cleared, drawn, resolved and stored.
#include "harness.h"

#include <string.h>

enum { WIDTH = 150, HEIGHT = 140, TEXEL_BYTES = 16, ALL_BYTES = WIDTH * HEIGHT * TEXEL_BYTES };

// What a pass draws into.
struct targets {
    rhw_texture color, resolve, depth, depth_resolve;
};

struct setup {
    enum rhw_format color, depth;
    int samples;
    bool keeps_samples;
    size_t bin_memory;
};

static rhw_texture make(const struct rig *rig, enum rhw_format format, int samples)
{
    const struct rhw_texture_def def = {
        .format = format, .width = WIDTH, .height = HEIGHT, .samples = samples};
    rhw_texture texture;
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static struct targets make_targets(const struct rig *rig, const struct setup *setup)
{
    const int kept = setup->keeps_samples ? setup->samples : 1;
    struct targets targets = {.color = make(rig, setup->color, kept), .depth = make(rig, setup->depth, kept)};
    if (kept > 1) {
        targets.resolve = make(rig, setup->color, 1);
        targets.depth_resolve = make(rig, setup->depth, 1);
    }
    return targets;
}

static void attach(struct rig *rig, const struct targets *targets, const struct setup *setup)
{
    rig->pass = (struct rhw_pass_def){
        .color_count = 1,
        .colors = {{.texture = targets->color, .resolve = targets->resolve}},
        .depth = {.enabled = true, .texture = targets->depth, .resolve = targets->depth_resolve},
        .samples = setup->samples};
}

// Triangles anywhere, none at times, with blending, depth and stencil.
static void draw(struct rig *rig, uint64_t random)
{
    struct rig_vertex vertices[150];
    const int count = 3 * rig_random_int(&random, 51);
    for (int i = 0; i < count; i++) {
        const float depth = rig_random_float(&random, 0, 1);
        rig_place(rig, rig_random_float(&random, -20, WIDTH + 20),
                  rig_random_float(&random, -20, HEIGHT + 20), depth, 1, vertices[i].position);
        for (int c = 0; c < 4; c++) {
            vertices[i].value[c] = rig_random_float(&random, 0, 1);
        }
    }
    if (count > 0) {
        rig_draw(rig, vertices, count);
    }
}

// Draws what the seed says. `load`: what attachments do that are not cleared. `area`: NULL for all.
static void run(struct rig *rig, const struct setup *setup, const struct targets *targets, uint64_t seed,
                enum rhw_load load, const struct rhw_rect *area)
{
    uint64_t random = seed;
    attach(rig, targets, setup);
    rig->pass.colors[0].load = rig_random_int(&random, 2) ? load : RHW_LOAD_CLEAR;
    rig->pass.depth.load = rig_random_int(&random, 2) ? load : RHW_LOAD_CLEAR;
    rig->pass.depth.stencil_load = rig_random_int(&random, 2) ? load : RHW_LOAD_CLEAR;
    rig->pass.depth.stencil_clear = (uint8_t)rig_random_int(&random, 256);
    rig->pass.depth.clear = rig_random_float(&random, 0.5f, 1);
    for (int c = 0; c < 4; c++) {
        rig->pass.colors[0].clear[c] = rig_random_float(&random, 0, 1);
    }
    if (area) {
        rig->pass.render_area = *area;
    }
    rig_begin(rig);
    draw(rig, random);
    rig_end(rig);
}

// All that a texture holds, a sample and an aspect at a time.
static void read_all(const struct rig *rig, rhw_texture texture, int samples, enum rhw_aspect aspect,
                     unsigned char *bytes)
{
    for (int s = 0; s < samples; s++, bytes += ALL_BYTES) {
        const struct rhw_texture_region region = {.sample = s, .aspect = aspect};
        assert_int_equal(rhw_texture_read_region(rig->context, texture, &region, bytes, 0, 0), RHW_OK);
    }
}

// What the textures of a pass hold.
struct contents {
    unsigned char color[4][ALL_BYTES], resolve[ALL_BYTES], depth[4][ALL_BYTES], depth_resolve[ALL_BYTES],
        stencil[4][ALL_BYTES], stencil_resolve[ALL_BYTES];
};

static void read_targets(const struct rig *rig, const struct targets *targets, const struct setup *setup,
                         struct contents *to)
{
    const int kept = setup->keeps_samples ? setup->samples : 1;
    memset(to, 0, sizeof *to);
    read_all(rig, targets->color, kept, RHW_ASPECT_DEFAULT, to->color[0]);
    read_all(rig, targets->depth, kept, RHW_ASPECT_DEFAULT, to->depth[0]);
    read_all(rig, targets->depth, kept, RHW_ASPECT_STENCIL, to->stencil[0]);
    if (kept > 1) {
        read_all(rig, targets->resolve, 1, RHW_ASPECT_DEFAULT, to->resolve);
        read_all(rig, targets->depth_resolve, 1, RHW_ASPECT_DEFAULT, to->depth_resolve);
        read_all(rig, targets->depth_resolve, 1, RHW_ASPECT_STENCIL, to->stencil_resolve);
    }
}

// Checks one plane of texels.
static void check_plane(const unsigned char *drawn, const unsigned char *before, const unsigned char *whole,
                        size_t size, const struct rhw_rect *area)
{
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const bool inside =
                x >= area->x && x < area->x + area->width && y >= area->y && y < area->y + area->height;
            const size_t at = (size_t)(y * WIDTH + x) * size;
            assert_memory_equal(drawn + at, (inside ? whole : before) + at, size);
        }
    }
}

static void check(const struct contents *drawn, const struct contents *before, const struct contents *whole,
                  const struct setup *setup, const struct rhw_rect *area)
{
    const size_t color = rhw_format_size(setup->color), depth = rhw_format_size(setup->depth);
    for (int s = 0; s < 4; s++) {
        check_plane(drawn->color[s], before->color[s], whole->color[s], color, area);
        check_plane(drawn->depth[s], before->depth[s], whole->depth[s], depth, area);
        check_plane(drawn->stencil[s], before->stencil[s], whole->stencil[s], 1, area);
    }
    check_plane(drawn->resolve, before->resolve, whole->resolve, color, area);
    check_plane(drawn->depth_resolve, before->depth_resolve, whole->depth_resolve, depth, area);
    check_plane(drawn->stencil_resolve, before->stencil_resolve, whole->stencil_resolve, 1, area);
}

static struct rhw_rect random_area(uint64_t *random)
{
    const int x = rig_random_int(random, WIDTH), y = rig_random_int(random, HEIGHT);
    return (struct rhw_rect){x, y, 1 + rig_random_int(random, WIDTH - x),
                             1 + rig_random_int(random, HEIGHT - y)};
}

static void compare(const struct setup *setup)
{
    static struct contents before, whole, drawn;
    struct rig rig;
    uint64_t random = 5;
    bool has_waves = false;
    rig_open_with(&rig, WIDTH, HEIGHT,
                  &(struct rhw_context_def){.threads = 2, .bin_memory = setup->bin_memory});
    rhw_texture_destroy(rig.context, rig.pass.colors[0].texture);
    const struct rhw_stencil_face face = {.pass = RHW_STENCIL_INCREMENT_WRAP,
                                          .depth_fail = RHW_STENCIL_INVERT};
    rig.pipeline.targets[0] =
        (struct rhw_color_target){.format = setup->color,
                                  .blend = true,
                                  .color = {RHW_BLEND_ONE, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD}};
    rig.pipeline.depth_test = rig.pipeline.stencil_test = true;
    rig.pipeline.stencil_front = rig.pipeline.stencil_back = face;
    const struct targets a = make_targets(&rig, setup), b = make_targets(&rig, setup);
    for (int i = 0; i < 6; i++) {
        const struct rhw_rect area = random_area(&random);
        const uint64_t old = rig_random(&random), seed = rig_random(&random);
        run(&rig, setup, &a, old, RHW_LOAD_CLEAR, NULL);
        run(&rig, setup, &b, old, RHW_LOAD_CLEAR, NULL);
        read_targets(&rig, &b, setup, &before);
        run(&rig, setup, &a, seed, RHW_LOAD_LOAD, NULL);
        read_targets(&rig, &a, setup, &whole);
        run(&rig, setup, &b, seed, RHW_LOAD_LOAD, &area);
        has_waves |= rig.stats.flushes > 0;
        read_targets(&rig, &b, setup, &drawn);
        check(&drawn, &before, &whole, setup, &area);
    }
    assert_true(has_waves == (setup->bin_memory != 0));
    rig_close(&rig);
}

static void test_the_same_inside(void **state)
{
    (void)state;
    static const enum rhw_format colors[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_R8_UNORM,
                                             RHW_FORMAT_RGBA32_FLOAT};
    for (int i = 0; i < 12; i++) {
        const struct setup setup = {.color = colors[i % 3],
                                    .depth =
                                        i & 1 ? RHW_FORMAT_D24_UNORM_S8_UINT : RHW_FORMAT_D32_FLOAT_S8_UINT,
                                    .samples = i < 4 ? 1 : 4,
                                    .keeps_samples = i >= 8,
                                    .bin_memory = i & 2 ? 1 : 0};
        compare(&setup);
    }
}

// Passes of one size clear areas to what is there already, or not; others clear everything.
static void test_clean_tiles(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    static const float one[4] = {1, 1, 1, 1};
    static float expected[HEIGHT][WIDTH];
    uint64_t random = 7;
    rig_open(&rig, WIDTH, HEIGHT);
    rig.pass.colors[0].texture = make(&rig, RHW_FORMAT_R32_FLOAT, 1);
    rig.pipeline.targets[0].format = RHW_FORMAT_R32_FLOAT;
    for (int pass = 0; pass < 100; pass++) {
        const struct rhw_rect all = {0, 0, WIDTH, HEIGHT};
        const struct rhw_rect area = rig_random_int(&random, 3) ? random_area(&random) : all;
        const float clear = (float)rig_random_int(&random, 2) / 2;
        const int x0 = rig_random_int(&random, WIDTH - 20), y0 = rig_random_int(&random, HEIGHT - 20);
        const bool draws = rig_random_int(&random, 2);
        rig.pass.render_area = area;
        rig.pass.colors[0].clear[0] = clear;
        rig_rectangle(&rig, (float)x0, (float)y0, (float)x0 + 20, (float)y0 + 20, 0, one, vertices);
        rig_begin(&rig);
        if (draws) {
            rig_draw(&rig, vertices, 6);
        }
        rig_end(&rig);
        for (int y = area.y; y < area.y + area.height; y++) {
            for (int x = area.x; x < area.x + area.width; x++) {
                const bool is_drawn = draws && x >= x0 && x < x0 + 20 && y >= y0 && y < y0 + 20;
                expected[y][x] = is_drawn ? 1 : clear;
            }
        }
        assert_memory_equal(rig_read(&rig, rig.pass.colors[0].texture), expected, sizeof expected);
    }
    rig_close(&rig);
}

// Clears and counts within a pass keep to the area, and a scissor cannot leave it.
static void test_clear_and_count(void **state)
{
    (void)state;
    struct rig rig;
    struct rig_vertex vertices[6];
    rhw_query query;
    static const float one[4] = {1, 1, 1, 1};
    rig_open(&rig, 20, 10);
    rig_cover(&rig, 0, one, vertices);
    rig.pass.render_area = (struct rhw_rect){3, 2, 8, 5};
    const struct rhw_query_def def = {.kind = RHW_QUERY_OCCLUSION};
    assert_int_equal(rhw_query_create(rig.context, &def, &query), RHW_OK);
    const struct rhw_rect scissors[] = {{-5, -5, 100, 100}, {0, 0, 5, 4}, {5, 4, 15, 6}};
    const uint64_t counts[] = {8 * 5, 2 * 2, 6 * 3};
    for (int i = 0; i < 3; i++) {
        struct rhw_query_counts counted;
        rig_begin(&rig);
        rhw_pass_set_scissor(rig.context, rig.recording, &scissors[i]);
        rhw_pass_begin_query(rig.context, rig.recording, query);
        rig_draw(&rig, vertices, 6);
        rhw_pass_end_query(rig.context, rig.recording, query);
        rig_end(&rig);
        assert_int_equal(rhw_query_read(rig.context, query, &counted), RHW_OK);
        assert_int_equal(counted.samples_passed, counts[i]);
    }
    for (int with_rect = 0; with_rect < 2; with_rect++) {
        const struct rhw_rect part = {4, 3, 7, 4};
        const struct rhw_clear clear = {.colors = 1, .color = {{5}}, .rects = &part, .rect_count = with_rect};
        rig_begin(&rig);
        rhw_pass_clear_attachments(rig.context, rig.recording, &clear);
        rig_end(&rig);
        for (int i = 0; i < 200; i++) {
            const int x = i % 20, y = i / 20;
            const bool is_cleared = x >= 3 + with_rect && x < 11 && y >= 2 + with_rect && y < 7;
            assert_true(rig_read_float4(&rig)[i][0] == (is_cleared ? 5.0f : 0.0f));
        }
    }
    rhw_query_destroy(rig.context, query);
    rig_close(&rig);
}

static void explain(void *user, const struct rhw_explained_fragment *fragment)
{
    (void)user;
    (void)fragment;
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 20, 10);
    const struct rhw_rect areas[] = {{0, 0, 21, 10}, {-1, 0, 5, 5}, {4, 4, 0, 0},
                                     {5, 5, 5, -1},  {20, 0, 1, 1}, {1, 9, 0x7fffffff, 1}};
    for (size_t i = 0; i < sizeof areas / sizeof areas[0]; i++) {
        rig.pass.render_area = areas[i];
        rig_expect_refused_pass(&rig, "it lies within the pass, which is 20x10, or is all 0");
    }
    rig.pass.render_area = (struct rhw_rect){3, 2, 8, 5};
    rig_begin(&rig);
    const struct rhw_rect beyond = {3, 2, 9, 5};
    const struct rhw_clear clear = {.colors = 1, .rects = &beyond, .rect_count = 1};
    rhw_pass_clear_attachments(rig.context, rig.recording, &clear);
    rig_expect_misuse(&rig, "rects[0] is 3,2 9x5; it lies within the pass's render area, 3,2 8x5");
    const struct rhw_explain ask = {.fragment = explain, .x = 11, .y = 2};
    rhw_pass_explain(rig.context, rig.recording, &ask);
    rig_expect_misuse(&rig, "(11, 2) lies outside of what the pass draws, 3,2 8x5");
    assert_int_equal(rhw_pass_end(rig.context, rig.recording, NULL), RHW_ERROR_MISUSE);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_the_same_inside), cmocka_unit_test(test_clean_tiles),
    cmocka_unit_test(test_clear_and_count), cmocka_unit_test(test_misuse)};

const struct unit_tests test_render_area = UNIT_TESTS(tests, NULL, NULL);
