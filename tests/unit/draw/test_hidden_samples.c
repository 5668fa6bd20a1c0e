// SPDX-License-Identifier: MIT
// What multisampled tiles leave out, since a block shows nothing behind it or a triangle covers no sample, and what they
// resolve in one step: the samples are those of the general path, which leaves nothing out.
#include "harness.h"

#include <string.h>

enum { SIZE = 136, PIXELS = SIZE * SIZE, TRIANGLES = 2600, LARGE = 40, FAILING = LARGE / 2, COUNTS = 4 };

static const int counts[COUNTS] = {2, 4, 8, 16};

static rhw_texture make_texture(struct rig *rig, enum rhw_format format, int samples)
{
    rhw_texture texture;
    const struct rhw_texture_def def = {.format = format, .width = SIZE, .height = SIZE, .samples = samples};
    assert_int_equal(rhw_texture_create(rig->context, &def, &texture), RHW_OK);
    return texture;
}

static void open_samples(struct rig *rig, enum rhw_format format, int samples, enum rhw_paths paths)
{
    rig_open_with(rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig_set_depth(rig);
    rig_set_target(rig, 0, format);
    rhw_texture_destroy(rig->context, rig->pass.colors[0].texture);
    rhw_texture_destroy(rig->context, rig->pass.depth.texture);
    rig->pass.colors[0].texture = make_texture(rig, format, samples);
    rig->pass.depth.texture = make_texture(rig, RHW_FORMAT_D32_FLOAT, samples);
}

// A vertex on one of two slanted planes that are hardly apart, or anywhere behind them; W is 1, so that depth is linear.
static void put_vertex(struct rig *rig, uint64_t *random, float x, float y, int layer,
                       struct rig_vertex *vertex)
{
    const float plane = 0.3f + 0.0011f * x - 0.0007f * y;
    const float depth = layer < 2 ? plane + 1e-6f * (float)layer : rig_random_float(random, plane, 0.95f);
    rig_place(rig, x, y, depth, 1, vertex->position);
    for (int c = 0; c < 4; c++) {
        vertex->value[c] = rig_random_float(random, 0, 1);
    }
}

// Large triangles, then small ones, then such of the size of pixels, over each other.
static void make_layers(struct rig *rig, uint64_t seed, struct rig_vertex *vertices)
{
    uint64_t random = seed;
    for (int t = 0; t < TRIANGLES; t++) {
        const float size = t < LARGE ? 200 : t < 4 * LARGE ? 14 : 1.2f;
        const float x = rig_random_float(&random, 0, SIZE), y = rig_random_float(&random, 0, SIZE);
        const int layer = rig_random_int(&random, 4);
        for (int i = 0; i < 3; i++) {
            put_vertex(rig, &random, x + rig_random_float(&random, -size, size),
                       y + rig_random_float(&random, -size, size), layer, &vertices[3 * t + i]);
        }
    }
}

static uint64_t hash_of_layers(enum rhw_compare compare, int samples, uint64_t seed, enum rhw_paths paths)
{
    static struct rig_vertex vertices[3 * TRIANGLES];
    static unsigned char texels[PIXELS * 16];
    uint64_t hash = 0;
    struct rig rig;
    open_samples(&rig, RHW_FORMAT_RGBA32_FLOAT, samples, paths);
    rig.pipeline.depth_compare = compare;
    rig.pass.depth.clear = compare == RHW_COMPARE_GREATER ? 0.05f : 1;
    make_layers(&rig, seed, vertices);
    rig_draw_once(&rig, vertices, 3 * TRIANGLES);
    for (int s = 0; s < samples; s++) {
        rhw_texture_read_sample(rig.context, rig.pass.colors[0].texture, s, texels, 0);
        hash = rig_hash_bytes(hash, texels, sizeof texels);
        rhw_texture_read_sample(rig.context, rig.pass.depth.texture, s, texels, 0);
        hash = rig_hash_bytes(hash, texels, PIXELS * 4);
    }
    rig_close(&rig);
    return hash;
}

static void test_what_is_hidden_is_not_missed(void **state)
{
    (void)state;
    const enum rhw_compare compare[] = {RHW_COMPARE_LESS, RHW_COMPARE_LESS_EQUAL, RHW_COMPARE_GREATER};
    for (int i = 0; i < COUNTS; i++) {
        for (int n = 0; n < 3; n++) {
            const uint64_t seed = (uint64_t)(10 * i + n);
            assert_true(hash_of_layers(compare[n], counts[i], seed, RHW_PATHS_ALL) ==
                        hash_of_layers(compare[n], counts[i], seed, RHW_PATHS_GENERAL));
        }
    }
}

// Half of the large triangles fail a test of another kind in every sample, so that they write no depth and hide nothing.
static uint64_t hash_behind_failures(bool by_stencil, int samples, enum rhw_paths paths)
{
    static struct rig_vertex vertices[3 * TRIANGLES];
    static unsigned char texels[PIXELS * 16];
    uint64_t hash = 0;
    struct rig rig;
    open_samples(&rig, RHW_FORMAT_RGBA32_FLOAT, samples, paths);
    rhw_texture_destroy(rig.context, rig.pass.depth.texture);
    rig.pass.depth.texture = make_texture(&rig, RHW_FORMAT_D32_FLOAT_S8_UINT, samples);
    make_layers(&rig, 9, vertices);
    rig_begin(&rig);
    rig.pipeline.stencil_test = by_stencil;
    rig.pipeline.depth_bounds_test = !by_stencil;
    rig.pipeline.stencil_front = rig.pipeline.stencil_back =
        (struct rhw_stencil_face){.compares = true, .compare = RHW_COMPARE_EQUAL};
    rig_use_pipeline(&rig);
    rig_use_vertices(&rig, 0, vertices, sizeof vertices);
    rhw_pass_set_stencil_reference(rig.context, rig.recording, 1, 1); // it is 0 everywhere
    rhw_pass_set_depth_bounds(rig.context, rig.recording, 0, 0.9f);   // it is 1
    rhw_pass_draw(rig.context, rig.recording, 0, 3 * FAILING, 0, 1);
    rig.pipeline.stencil_test = rig.pipeline.depth_bounds_test = false;
    rig_use_pipeline(&rig);
    rhw_pass_draw(rig.context, rig.recording, 3 * FAILING, 3 * (TRIANGLES - FAILING), 0, 1);
    rig_end(&rig);
    for (int s = 0; s < samples; s++) {
        rhw_texture_read_sample(rig.context, rig.pass.colors[0].texture, s, texels, 0);
        hash = rig_hash_bytes(hash, texels, sizeof texels);
    }
    rig_close(&rig);
    return hash;
}

static void test_what_fails_other_tests_hides_nothing(void **state)
{
    (void)state;
    for (int i = 0; i < COUNTS; i++) {
        for (int by_stencil = 0; by_stencil <= 1; by_stencil++) {
            assert_true(hash_behind_failures(by_stencil, counts[i], RHW_PATHS_ALL) ==
                        hash_behind_failures(by_stencil, counts[i], RHW_PATHS_GENERAL));
        }
    }
}

// Triangles of a third of a pixel, of which most cover no sample.
static void draw_dust(enum rhw_paths paths, struct rhw_stats *stats, uint64_t *hash)
{
    enum { GRAINS = 1500 };
    static struct rig_vertex vertices[3 * GRAINS];
    static unsigned char texels[PIXELS * 16];
    uint64_t random = 5;
    struct rig rig;
    open_samples(&rig, RHW_FORMAT_RGBA32_FLOAT, 4, paths);
    for (int t = 0; t < GRAINS; t++) {
        const float x = rig_random_float(&random, 1, SIZE - 1), y = rig_random_float(&random, 1, SIZE - 1);
        for (int i = 0; i < 3; i++) {
            put_vertex(&rig, &random, x + rig_random_float(&random, -0.3f, 0.3f),
                       y + rig_random_float(&random, -0.3f, 0.3f), 0, &vertices[3 * t + i]);
        }
    }
    rig_draw_once(&rig, vertices, 3 * GRAINS);
    *stats = rig.stats;
    *hash = 0;
    for (int s = 0; s < 4; s++) {
        rhw_texture_read_sample(rig.context, rig.pass.colors[0].texture, s, texels, 0);
        *hash = rig_hash_bytes(*hash, texels, sizeof texels);
    }
    rig_close(&rig);
}

static void test_triangles_without_a_sample_are_culled(void **state)
{
    (void)state;
    struct rhw_stats all, general;
    uint64_t all_hash, general_hash;
    draw_dust(RHW_PATHS_ALL, &all, &all_hash);
    draw_dust(RHW_PATHS_GENERAL, &general, &general_hash);
    assert_true(all_hash == general_hash);
    assert_true(all.fragments_shaded == general.fragments_shaded && all.fragments_shaded > 50);
    assert_true(all.triangles_culled > general.triangles_culled + 300);
}

// A tile notes that a triangle is seen, and draws it, where it is seen in another sample than the first alone. These shapes
// note it by themselves.
enum shape { LINE, STIPPLED_LINE, CONSERVATIVE_TRIANGLE, SHAPES };

static void use_shape(struct rig *rig, enum shape shape)
{
    struct rhw_pipeline_def *const def = &rig->pipeline;
    def->topology = shape == CONSERVATIVE_TRIANGLE ? RHW_TRIANGLE_LIST : RHW_LINE_LIST;
    def->line_mode = shape == LINE ? RHW_LINE_BRESENHAM : RHW_LINE_RECTANGULAR;
    if (shape == STIPPLED_LINE) {
        def->line_stipple = (struct rhw_line_stipple){1, 0x5555};
    } else if (shape == CONSERVATIVE_TRIANGLE) {
        def->conservative = RHW_CONSERVATIVE_OVERESTIMATE;
    }
}

static void test_shapes_that_show_beside_the_first_sample(void **state)
{
    (void)state;
    enum { ROW = 20, FAR_LAYERS = 8 }; // enough to make a tile draw depth first
    static float colors[PIXELS][4];
    for (enum shape shape = LINE; shape < SHAPES; shape++) {
        struct rig rig;
        open_samples(&rig, RHW_FORMAT_RGBA32_FLOAT, 4, RHW_PATHS_ALL);
        rig_begin(&rig);
        struct rig_vertex far[6], front[6], shaped[3];
        rig_cover(&rig, 0.875f, (const float[4]){0, 0, 1, 1}, far);
        for (int i = 0; i < FAR_LAYERS; i++) {
            rig_draw(&rig, far, 6);
        }
        rig_cover(&rig, 0.25f, (const float[4]){1, 0, 0, 1}, front);
        for (int i = 0; i < 6; i++) { // samples lie 2, 6, 10 and 14 sixteenths below the upper end of a pixel
            rig_place(&rig, front[i].position[0] < 0 ? 0 : SIZE, front[i].position[1] > 0 ? ROW : ROW + 0.25f,
                      0.25f, 1, front[i].position);
        }
        rig_draw(&rig, front, 6);
        use_shape(&rig, shape);
        for (int i = 0; i < 3; i++) {
            shaped[i] = (struct rig_vertex){.value = {0, 1, 0, 1}};
            rig_place(&rig, i == 0 ? 4 : 40, i == 2 ? ROW + 0.6f : ROW + 0.5f, 0.75f, 1, shaped[i].position);
        }
        rig_draw(&rig, shaped, shape == CONSERVATIVE_TRIANGLE ? 3 : 2);
        rig_end(&rig);
        for (int s = 0; s < 4; s++) {
            rhw_texture_read_sample(rig.context, rig.pass.colors[0].texture, s, colors, 0);
            assert_true(colors[ROW * SIZE + 20][0] == (s == 0 ? 1 : 0));
            assert_true(colors[ROW * SIZE + 20][1] == (s == 0 ? 0 : 1));
        }
        rig_close(&rig);
    }
}

// The mean of 8-bit channels, which tiles make in one step, is that of rhw_texture_resolve, which knows all formats.
static void test_tiles_resolve_as_regions_do(void **state)
{
    (void)state;
    static struct rig_vertex vertices[3 * TRIANGLES];
    const enum rhw_format formats[] = {RHW_FORMAT_RGBA8_UNORM, RHW_FORMAT_BGRA8_UNORM};
    for (int i = 0; i < 2; i++) {
        struct rig rig;
        open_samples(&rig, formats[i], 4, RHW_PATHS_ALL);
        rig.pass.colors[0].resolve = make_texture(&rig, formats[i], 1);
        const rhw_texture region = make_texture(&rig, formats[i], 1);
        make_layers(&rig, 77, vertices);
        rig_draw_once(&rig, vertices, 3 * TRIANGLES);
        const rhw_texture samples = rig.pass.colors[0].texture;
        assert_int_equal(rhw_texture_resolve(rig.context, samples, NULL, region, NULL, RHW_RESOLVE_AVERAGE),
                         RHW_OK);
        static unsigned char tiles[PIXELS * 4];
        memcpy(tiles, rig_read(&rig, rig.pass.colors[0].resolve), sizeof tiles);
        assert_memory_equal(tiles, rig_read(&rig, region), sizeof tiles);
        rig_close(&rig);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_what_is_hidden_is_not_missed),
    cmocka_unit_test(test_what_fails_other_tests_hides_nothing),
    cmocka_unit_test(test_triangles_without_a_sample_are_culled),
    cmocka_unit_test(test_shapes_that_show_beside_the_first_sample),
    cmocka_unit_test(test_tiles_resolve_as_regions_do),
};

const struct unit_tests test_hidden_samples = UNIT_TESTS(tests, NULL, NULL);
