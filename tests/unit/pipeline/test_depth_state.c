// SPDX-License-Identifier: MIT
// Depth beyond a comparison of floats: formats with steps, bias, clipping switched off, clamping, bounds, reversed depth.
#include "harness.h"

#include <math.h>
#include <string.h>

enum { SIZE = 64 };

static const float red[4] = {1, 0, 0, 1}, green[4] = {0, 1, 0, 1};

static void set_format(struct rig *rig, enum rhw_format format)
{
    rig_set_depth(rig);
    rhw_texture_destroy(rig->context, rig->pass.depth.texture);
    const struct rhw_texture_def def = {.format = format, .width = SIZE, .height = SIZE};
    assert_int_equal(rhw_texture_create(rig->context, &def, &rig->pass.depth.texture), RHW_OK);
}

static void cover(struct rig *rig, float depth, const float color[4])
{
    struct rig_vertex all[6];
    rig_cover(rig, depth, color, all);
    rig_draw(rig, all, 6);
}

// Depth z at column x: `at` + x · `step`, over the whole target. The Z of clip coordinates is not clipped by this.
static void cover_ramp(struct rig *rig, float at, float step, const float color[4])
{
    struct rig_vertex all[6];
    rig_cover(rig, 0.5f, color, all);
    for (int i = 0; i < 6; i++) {
        all[i].position[2] = at + step * (all[i].position[0] < 0 ? 0 : SIZE);
    }
    rig_draw(rig, all, 6);
}

// The nearest of n / steps.
static double to_step(double depth, double steps)
{
    return nearbyint(depth * steps);
}

static void test_steps_of_unorm_depth(void **state)
{
    (void)state;
    const enum rhw_format formats[] = {RHW_FORMAT_D16_UNORM, RHW_FORMAT_D24_UNORM};
    for (int f = 0; f < 2; f++) {
        const double steps = f == 0 ? 65535 : 16777215;
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        set_format(&rig, formats[f]);
        uint64_t random = 3;
        for (int i = 0; i < 100; i++) {
            const float depth = rig_random_float(&random, 0, 1);
            rig.pass.depth.clear = 1;
            rig_begin(&rig);
            cover(&rig, depth, red);
            rig_end(&rig);
            const void *const texels = rig_read(&rig, rig.pass.depth.texture);
            uint16_t half;
            uint32_t word;
            memcpy(&half, texels, sizeof half);
            memcpy(&word, texels, sizeof word);
            assert_true((f == 0 ? (double)half : (double)word) == to_step((double)depth, steps));
        }
        // What rounds to the same step is equal, in one pass and in the next.
        for (int passes = 1; passes <= 2; passes++) {
            const float depth = (float)(1000 / steps);
            rig.pipeline.depth_compare = RHW_COMPARE_LESS;
            rig.pass.depth.load = RHW_LOAD_CLEAR;
            rig_begin(&rig);
            cover(&rig, depth, red);
            if (passes == 2) {
                rig_end(&rig);
                rig.pass.depth.load = rig.pass.colors[0].load = RHW_LOAD_LOAD;
                rig_begin(&rig);
            }
            rig.pipeline.depth_compare = RHW_COMPARE_EQUAL;
            cover(&rig, (float)(1000.4 / steps), green);
            rig_end(&rig);
            assert_memory_equal(rig_read_float4(&rig)[5], green, sizeof green);
            rig.pass.colors[0].load = RHW_LOAD_CLEAR;
        }
        rig_close(&rig);
    }
}

// Opaque layers, many of them, of which tiles draw depth first.
static void test_steps_draw_the_same_on_every_path(void **state)
{
    (void)state;
    uint64_t hash[2];
    for (int general = 0; general < 2; general++) {
        struct rig rig;
        rig_open_with(&rig, SIZE, SIZE,
                      &(struct rhw_context_def){.paths = general ? RHW_PATHS_GENERAL : RHW_PATHS_ALL});
        set_format(&rig, RHW_FORMAT_D16_UNORM);
        uint64_t random = 8;
        rig_begin(&rig);
        for (int i = 0; i < 40; i++) {
            const float color[4] = {(float)i, 0, 0, 1};
            cover_ramp(&rig, rig_random_float(&random, 0.3f, 0.7f),
                       rig_random_float(&random, -0.0002f, 0.0002f), color);
        }
        rig_end(&rig);
        hash[general] = rig_hash(&rig, 0);
        rig_close(&rig);
    }
    assert_true(hash[0] == hash[1]);
}

// slope · m + constant · r, on ramps whose plane is exact in binary.
static void test_bias(void **state)
{
    (void)state;
    const struct {
        struct rhw_depth_bias bias;
        enum rhw_format format;
        float at, step;
        double expected;
    } cases[] = {
        {{0, 1, 0}, RHW_FORMAT_D32_FLOAT, 0.25f, 0x1p-8f, 0x1p-8},
        {{0, -2, 0}, RHW_FORMAT_D32_FLOAT, 0.5f, -0x1p-8f, -0x1p-7},
        // The largest depth of 0.25 .. 0.5 has the exponent −1 there, so that a step is 2^-24.
        {{65536, 0, 0}, RHW_FORMAT_D32_FLOAT, 0.25f, 0x1p-8f, 0x1p-8},
        {{65536, 0, 0}, RHW_FORMAT_D32_FLOAT, 0.25f, 0, 0x1p-9},
        {{65536, 1, 0}, RHW_FORMAT_D32_FLOAT, 0.25f, 0x1p-8f, 0x1p-7},
        {{0, 4, 0x1p-8f}, RHW_FORMAT_D32_FLOAT, 0.25f, 0x1p-8f, 0x1p-8},
        {{0, -4, -0x1p-8f}, RHW_FORMAT_D32_FLOAT, 0.25f, 0x1p-8f, -0x1p-8},
        {{64, 0, 0}, RHW_FORMAT_D16_UNORM, 0.25f, 0, 0x1p-10},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        set_format(&rig, cases[i].format);
        for (int in_pass = 0; in_pass < 2; in_pass++) {
            rig.pipeline.depth_bias = in_pass ? (struct rhw_depth_bias){1e6f, 3, 0} : cases[i].bias;
            rig_begin(&rig);
            if (in_pass) {
                rhw_pass_set_depth_bias(rig.context, rig.recording, &cases[i].bias);
            }
            cover_ramp(&rig, cases[i].at, cases[i].step, red);
            rig_end(&rig);
            const void *const depth = rig_read(&rig, rig.pass.depth.texture);
            for (int x = 0; x < SIZE; x++) {
                const double z = (double)cases[i].at + (double)cases[i].step * (x + 0.5) + cases[i].expected;
                if (cases[i].format == RHW_FORMAT_D16_UNORM) {
                    assert_int_equal(((const uint16_t *)depth)[x], to_step((double)(float)z, 65535));
                } else {
                    assert_true((double)((const float *)depth)[x] == z);
                }
            }
        }
        rig_close(&rig);
    }
}

// The step of a float is that of the triangle's largest depth between near and far: of vertices however far aside, of
// those before the eye where others lie behind it, of the far plane where it is crossed.
static void test_bias_of_cut_triangles(void **state)
{
    (void)state;
    for (int i = 0; i < 2 * 3; i++) {
        const int what = i / 2;
        static const float clip[2][3][4] = {
            {{-1e6f, -1e6f, 0.25f, 1}, {3e6f, -1e6f, 0.25f, 1}, {-1e6f, 3e6f, 0.25f, 1}}, // not snapped
            {{-4, -4, 0.5f, 1}, {4, -4, 0.5f, 1}, {0, 12, -1.5f, -1}}};                   // Z = W − 1/2
        struct rig rig;
        rig_open_with(
            &rig, SIZE, SIZE,
            &(struct rhw_context_def){.threads = 1, .paths = i % 2 ? RHW_PATHS_GENERAL : RHW_PATHS_ALL});
        set_format(&rig, RHW_FORMAT_D32_FLOAT);
        rig.pipeline.depth_bias.constant = 65536;
        rig_begin(&rig);
        if (what < 2) {
            struct rig_vertex vertices[3] = {{.value = {1}}};
            for (int v = 0; v < 3; v++) {
                memcpy(vertices[v].position, clip[what][v], sizeof vertices[v].position);
            }
            rig_draw(&rig, vertices, 3);
        } else {
            rhw_pass_set_viewport(rig.context, rig.recording,
                                  &(struct rhw_viewport){0, 0, SIZE, SIZE, 0, 0.5f});
            cover_ramp(&rig, 0.5f, 2.5f / SIZE, red);
        }
        rig_end(&rig);
        const float *const depth = rig_read_depth(&rig);
        const int x = 3,
                  y = SIZE -
                      10; // where y = −1 + 19 / SIZE, t = (y + 4) / (16 + 2y) along the edges to the third
        const double ndc = -1 + 19.0 / SIZE, t = (ndc + 4) / (16 + 2 * ndc);
        const double expected[] = {0.25 + 0x1p-9, 1 - 0.5 / (1 - 2 * t) + 0x1p-8,
                                   0.25 + 1.25 * (x + 0.5) / SIZE + 0x1p-8};
        const double seen = (double)depth[y * SIZE + x];
        assert_true(fabs(seen - expected[what]) < 1e-6);
        rig_close(&rig);
    }
}

// Small triangles take other paths than large ones; biased near the ends of the range they are clamped.
static void test_bias_of_small_triangles(void **state)
{
    (void)state;
    for (int end = 0; end < 2; end++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        set_format(&rig, RHW_FORMAT_D32_FLOAT);
        rig.pipeline.depth_bias = (struct rhw_depth_bias){.constant = end ? 0x1p23f : 0x1p14f};
        rig.pipeline.depth_compare = RHW_COMPARE_ALWAYS;
        rig_begin(&rig);
        struct rig_vertex quad[6];
        for (int x = 0; x < SIZE; x += 4) {
            rig_rectangle(&rig, (float)x, 0, (float)x + 4, 3, 0.75f, red, quad);
            rig_draw(&rig, quad, 6);
        }
        rig_end(&rig);
        for (int x = 0; x < SIZE; x++) {
            assert_true(rig_read_depth(&rig)[x] == (end ? 1.0f : 0.75f + 0x1p-10f));
        }
        rig_close(&rig);
    }
}

// Bias may carry depth out of the viewport's range, and not out of 0..1.
static void test_bias_beyond_the_viewport(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    set_format(&rig, RHW_FORMAT_D32_FLOAT);
    rig.pipeline.depth_bias = (struct rhw_depth_bias){.constant = 0x1p22f}; // 1/8 at depths from 1/4 on
    rig_begin(&rig);
    rhw_pass_set_viewport(rig.context, rig.recording, &(struct rhw_viewport){0, 0, SIZE, SIZE, 0, 0.5f});
    cover(&rig, 0.875f, red);
    rig_end(&rig);
    assert_true(rig_read_depth(&rig)[0] == 0.4375f + 0.125f);
    rig_close(&rig);
}

// Depth that clipping switched off, or bias, carries from 3/4 to 5/4 is 1 from the middle on, on every path: where blocks are
// tested by masks too, which a draw with stencil is. What is drawn at 1 afterwards counts there, and nowhere else.
static void test_depth_beyond_one(void **state)
{
    (void)state;
    static const enum rhw_format formats[] = {RHW_FORMAT_D24_UNORM_S8_UINT, RHW_FORMAT_D32_FLOAT_S8_UINT};
    static const struct rhw_stencil_face count = {.pass = RHW_STENCIL_INCREMENT_WRAP};
    for (int i = 0; i < 8; i++) {
        const bool is_float = i & 1, biased = i & 2, general = i & 4;
        struct rig rig;
        uint8_t stencil[SIZE * SIZE];
        rig_open_with(&rig, SIZE, SIZE,
                      &(struct rhw_context_def){.paths = general ? RHW_PATHS_GENERAL : RHW_PATHS_ALL});
        set_format(&rig, formats[is_float]);
        struct rhw_pipeline_def *const def = &rig.pipeline;
        def->stencil_test = true;
        def->stencil_front = def->stencil_back = count;
        def->depth_compare = RHW_COMPARE_LESS_EQUAL;
        def->depth_clip_disabled = !biased;
        def->depth_bias.constant = !biased ? 0 : is_float ? 0x1p21f : 0x1p22f; // 1/4
        rig_begin(&rig);
        cover_ramp(&rig, biased ? 0.5f : 0.75f, 0.5f / SIZE, red);
        def->depth_bias.constant = 0;
        def->depth_compare = RHW_COMPARE_EQUAL;
        cover(&rig, 1, green);
        rig_end(&rig);
        assert_int_equal(rhw_texture_read_stencil(rig.context, rig.pass.depth.texture, 0, stencil, 0),
                         RHW_OK);
        for (int p = 0; p < SIZE * SIZE; p++) {
            assert_int_equal(stencil[p], p % SIZE < SIZE / 2 ? 1 : 2);
        }
        rig_close(&rig);
    }
}

// A ramp from −1 to 2 in front of, within and behind the view volume.
static void test_clip_and_clamp(void **state)
{
    (void)state;
    for (int clamp = 0; clamp < 2; clamp++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        set_format(&rig, RHW_FORMAT_D32_FLOAT);
        rig.pipeline.depth_compare = RHW_COMPARE_ALWAYS;
        rig.pipeline.depth_clip_disabled = true;
        rig.pipeline.depth_clamp = clamp;
        const struct rhw_viewport viewport = {0, 0, SIZE, SIZE, 0.25f, 0.75f};
        rig_begin(&rig);
        rhw_pass_set_viewport(rig.context, rig.recording, &viewport);
        cover_ramp(&rig, -1, 3.0f / SIZE, red);
        rig_end(&rig);
        for (int x = 0; x < SIZE; x++) {
            const double z = 0.25 + 0.5 * (-1 + 3.0 / SIZE * (x + 0.5));
            const double least = clamp ? 0.25 : 0, most = clamp ? 0.75 : 1;
            const double held = z < least ? least : z > most ? most : z;
            assert_true(fabs((double)rig_read_depth(&rig)[x] - held) < 1e-7);
            assert_memory_equal(rig_read_float4(&rig)[x], red, sizeof red);
        }
        rig_close(&rig);
    }
}

static void coord_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        memcpy(groups[g].color[0], groups[g].coord, sizeof groups[g].coord);
    }
}

// A triangle that covers the target all over, whose depth is one number, or another in each row.
static void test_clamped_coordinates(void **state)
{
    (void)state;
    for (int slopes = 0; slopes < 2; slopes++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        rig_set_program(&rig, rig_vertex_pass, coord_fragment);
        rig.pipeline.program.uses = RHW_USE_COORD;
        rig.pipeline.depth_clip_disabled = rig.pipeline.depth_clamp = true;
        const float slope = slopes ? 0.5f : 0, low = 1.25f - 2 * slope, high = 1.25f + 6 * slope;
        const struct rig_vertex all[3] = {
            {{-2, -2, low, 1}, {0}}, {{6, -2, low, 1}, {0}}, {{-2, 6, high, 1}, {0}}};
        rig_draw_once(&rig, all, 3);
        for (int p = 0; p < SIZE * SIZE; p++) {
            const double z = 1.25 + (double)slope * (1 - (p / SIZE + 0.5) * 2 / SIZE);
            const float *const coord = rig_read_float4(&rig)[p];
            assert_true(coord[0] == (float)(p % SIZE) + 0.5f && coord[1] == (float)(p / SIZE) + 0.5f);
            assert_true(fabs((double)coord[2] - fmin(z, 1)) < 1e-6 && coord[3] == 1);
        }
        rig_close(&rig);
    }
}

// A triangle through the eye's plane has no near plane to be cut by, and is drawn up to it.
static void test_no_near_plane(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig.pipeline.depth_clip_disabled = true;
    // The floor y = −1 from behind the eye (w = −1) to the far (w = 9): it covers the lower half.
    const struct rig_vertex floor[3] = {
        {{-100, -1, -2, -1}, {1, 0, 0, 1}}, {{100, -1, -2, -1}, {1, 0, 0, 1}}, {{0, -1, 9, 9}, {1, 0, 0, 1}}};
    rig_draw_once(&rig, floor, 3);
    const float(*const pixels)[4] = rig_read_float4(&rig);
    for (int y = 0; y < SIZE; y++) {
        // Below the horizon, which is y = −1/9: 35.6 pixels from the top.
        assert_true(pixels[y * SIZE + SIZE / 2][0] == (y >= 36 ? 1.0f : 0.0f));
    }
    rig_close(&rig);
}

static void test_depth_bounds(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    set_format(&rig, RHW_FORMAT_D32_FLOAT);
    rig_begin(&rig);
    cover_ramp(&rig, 0, 1.0f / SIZE, red);
    rig.pipeline.depth_test = false;
    rig.pipeline.depth_bounds_test = true;
    rhw_pass_set_depth_bounds(rig.context, rig.recording, 0.25f, 0.5f);
    cover(&rig, 0.9f, green);
    rig_end(&rig);
    for (int x = 0; x < SIZE; x++) {
        const float depth = rig_read_depth(&rig)[x];
        assert_true(depth == ((float)x + 0.5f) / SIZE);
        const bool inside = depth >= 0.25f && depth <= 0.5f;
        assert_memory_equal(rig_read_float4(&rig)[x], inside ? green : red, sizeof red);
    }
    rig_close(&rig);
}

static void test_reversed_depth(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    set_format(&rig, RHW_FORMAT_D24_UNORM);
    rig.pass.depth.clear = 0;
    rig.pass.depth.load = RHW_LOAD_CLEAR;
    rig.pipeline.depth_compare = RHW_COMPARE_GREATER;
    const struct rhw_viewport viewport = {0, 0, SIZE, SIZE, 1, 0};
    rig_begin(&rig);
    rhw_pass_set_viewport(rig.context, rig.recording, &viewport);
    cover(&rig, 0.25f, red);
    cover(&rig, 0.5f, green);
    rig_end(&rig);
    uint32_t texel;
    memcpy(&texel, rig_read(&rig, rig.pass.depth.texture), sizeof texel);
    assert_int_equal(texel, 12582911); // 0.75 · 16777215 = 12582911.25
    assert_memory_equal(rig_read_float4(&rig)[0], red, sizeof red);
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rhw_pipeline pipeline;
    rig.pipeline.depth_bias.slope = NAN;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "all must be finite");
    rig.pipeline.depth_bias.slope = 0;
    rig_begin(&rig);
    rhw_pass_set_depth_bounds(rig.context, rig.recording, 0.5f, 0.25f);
    rig_end(&rig);
    rig_expect_misuse(&rig, "they rise within 0..1");
    rhw_pass pass;
    rig_set_depth(&rig);
    rig.pass.depth.format = RHW_FORMAT_D16_UNORM;
    assert_int_equal(rhw_pass_begin(rig.context, &rig.pass, &pass), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "depth.format");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_steps_of_unorm_depth),
    cmocka_unit_test(test_steps_draw_the_same_on_every_path),
    cmocka_unit_test(test_bias),
    cmocka_unit_test(test_bias_of_small_triangles),
    cmocka_unit_test(test_bias_beyond_the_viewport),
    cmocka_unit_test(test_bias_of_cut_triangles),
    cmocka_unit_test(test_depth_beyond_one),
    cmocka_unit_test(test_clip_and_clamp),
    cmocka_unit_test(test_clamped_coordinates),
    cmocka_unit_test(test_no_near_plane),
    cmocka_unit_test(test_depth_bounds),
    cmocka_unit_test(test_reversed_depth),
    cmocka_unit_test(test_misuse),
};

const struct unit_tests test_depth_state = UNIT_TESTS(tests, NULL, NULL);
