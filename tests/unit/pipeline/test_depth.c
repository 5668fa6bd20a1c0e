// SPDX-License-Identifier: MIT
// The depth test: every compare function, write on and off, load and clear, depth from the fragment
// function, discard with early and late tests, and the values of slanted planes.
#include "harness.h"
#include "reference.h"

#include <math.h>
#include <string.h>

enum { SIZE = 64 };

static const float red[4] = {1, 0, 0, 1}, green[4] = {0, 1, 0, 1};

static void draw_layer(struct rig *rig, float depth, const float color[4])
{
    struct rig_vertex all[6];
    rig_cover(rig, depth, color, all);
    rig_draw(rig, all, 6);
}

static bool passes(enum rhw_compare compare, float incoming, float stored)
{
    switch (compare) {
    case RHW_COMPARE_NEVER: return false;
    case RHW_COMPARE_LESS: return incoming < stored;
    case RHW_COMPARE_EQUAL: return incoming == stored;
    case RHW_COMPARE_LESS_EQUAL: return incoming <= stored;
    case RHW_COMPARE_GREATER: return incoming > stored;
    case RHW_COMPARE_NOT_EQUAL: return incoming != stored;
    case RHW_COMPARE_GREATER_EQUAL: return incoming >= stored;
    case RHW_COMPARE_ALWAYS: return true;
    }
    return false;
}

static void test_every_compare_function(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    const float stored[] = {0.25f, 0.5f, 0.75f, 0, 1};
    const float incoming[] = {0.25f, 0.5f, 0.75f, 0, 1};
    for (int compare = 0; compare < 8; compare++) {
        for (int s = 0; s < 5; s++) {
            for (int i = 0; i < 5; i++) {
                for (int write = 0; write < 2; write++) {
                    rig.pass.depth.clear = stored[s];
                    rig.pipeline.depth_compare = (enum rhw_compare)compare;
                    rig.pipeline.depth_read_only = write == 0;
                    rig_begin(&rig);
                    draw_layer(&rig, incoming[i], red);
                    rig_end(&rig);
                    const bool pass = passes(rig.pipeline.depth_compare, incoming[i], stored[s]);
                    assert_true(rig_read_float4(&rig)[77][0] == (pass ? 1.0f : 0.0f));
                    const float depth = rig_read_depth(&rig)[77];
                    if (depth != (pass && write ? incoming[i] : stored[s])) {
                        fail_msg("compare %d, write %d: %g over %g leaves %g", compare, write,
                                 (double)incoming[i], (double)stored[s], (double)depth);
                    }
                }
            }
        }
    }
    rig_close(&rig);
}

// The same against values that draws of the same pass left, which hierarchical depth may have summed up.
static void test_compare_against_drawn_depth(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    for (int compare = 0; compare < 8; compare++) {
        for (int nearer = 0; nearer < 3; nearer++) {
            // A ramp over x, then the same ramp nearer, equal or farther.
            const float shift = (float)(nearer - 1) * 0.125f;
            struct rig_vertex ramp[6], shifted[6];
            rig_cover(&rig, 0.5f, red, ramp);
            rig_cover(&rig, 0.5f, green, shifted);
            for (int i = 0; i < 6; i++) {
                ramp[i].position[2] = 0.5f + ramp[i].position[0] * 0.25f;
                shifted[i].position[2] = ramp[i].position[2] + shift;
            }
            rig_begin(&rig);
            rig.pipeline.depth_compare = RHW_COMPARE_LESS;
            rig_draw(&rig, ramp, 6);
            rig.pipeline.depth_compare = (enum rhw_compare)compare;
            rig_draw(&rig, shifted, 6);
            rig_end(&rig);
            const bool pass = passes(rig.pipeline.depth_compare, 0.5f + shift, 0.5f);
            const float(*pixels)[4] = rig_read_float4(&rig);
            for (int i = 0; i < SIZE * SIZE; i++) {
                assert_true(pixels[i][pass ? 1 : 0] == 1);
            }
        }
    }
    rig_close(&rig);
}

static void test_without_depth_test_nothing_is_tested_or_written(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig.pass.depth.clear = 0.25f;
    rig.pipeline.depth_test = false;
    rig.pipeline.depth_compare = RHW_COMPARE_NEVER;
    rig_begin(&rig);
    draw_layer(&rig, 0.75f, red);
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[9][0] == 1);
    assert_true(rig_read_depth(&rig)[9] == 0.25f);
    rig_close(&rig);
}

static void test_depth_is_kept_between_passes(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    struct rig_vertex half[6];
    rig_rectangle(&rig, 0, 0, SIZE / 2, SIZE, 0.25f, red, half);
    rig_draw_once(&rig, half, 6);
    rig.pass.depth.load = RHW_LOAD_LOAD;
    rig.pass.colors[0].load = RHW_LOAD_LOAD;
    rig_begin(&rig);
    draw_layer(&rig, 0.5f, green);
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(pixels[i][i % SIZE < SIZE / 2 ? 0 : 1] == 1);
    }
    const float *depth = rig_read_depth(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(depth[i] == (i % SIZE < SIZE / 2 ? 0.25f : 0.5f));
    }
    rig_close(&rig);
}

static void test_depth_without_memory(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 200, 150);
    rig_set_depth(&rig);
    rhw_texture_destroy(rig.context, rig.pass.depth.texture);
    rig.pass.depth.texture = (rhw_texture){0};
    rig.pass.depth.store = RHW_STORE_DISCARD;
    rig_begin(&rig);
    draw_layer(&rig, 0.25f, red);
    draw_layer(&rig, 0.5f, green);
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < 200 * 150; i++) {
        assert_true(pixels[i][0] == 1 && pixels[i][1] == 0);
    }
    rig_close(&rig);
}

static void test_depth_of_slanted_triangles(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    uint64_t random = 3;
    for (int n = 0; n < 200; n++) {
        struct ref_triangle reference;
        struct rig_vertex vertices[3] = {0};
        double largest = 0;
        for (int i = 0; i < 3; i++) {
            reference.x_8[i] = rig_random_int(&random, 64 * 256);
            reference.y_8[i] = rig_random_int(&random, 64 * 256);
            // A power of two keeps Z/W exact, so that the test is about interpolation alone.
            // Planes of W that differ by more than 2^20 are combined from exact edges at every pixel.
            reference.w[i] = ldexp(1, rig_random_int(&random, n % 4 == 0 ? 30 : 8) - 3);
            reference.depth[i] = (double)rig_random_float(&random, 0, 1);
            largest = fmax(largest, reference.depth[i]);
            rig_place(&rig, (float)reference.x_8[i] / 256, (float)reference.y_8[i] / 256,
                      (float)reference.depth[i], (float)reference.w[i], vertices[i].position);
        }
        rig_draw_once(&rig, vertices, 3);
        const float *depth = rig_read_depth(&rig);
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                const double seen = (double)depth[y * SIZE + x];
                if (!ref_covers(&reference, x, y)) {
                    assert_true(seen == 1);
                    continue;
                }
                const struct ref_weights weights = ref_weights_at(&reference, x + 0.5, y + 0.5);
                const double expected = ref_mix(weights.screen, reference.depth);
                if (fabs(seen - expected) > 8 * rig_ulp(largest)) {
                    fail_msg("triangle %d pixel %d,%d: depth %.9g, not %.17g", n, x, y, seen, expected);
                }
            }
        }
    }
    rig_close(&rig);
}

static void coord_depth_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].coord[2];
    }
}

// The depth that a fragment function sees is what the depth buffer keeps, bit by bit.
static void test_fragments_see_the_depth_that_is_kept(void **state)
{
    (void)state;
    enum { TRIANGLES = 300 };
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig_set_program(&rig, rig_vertex_pass, coord_depth_fragment);
    rig.pipeline.program.uses = RHW_USE_COORD;
    rig.pass.colors[0].clear[0] = 1;
    struct rig_vertex vertices[3 * TRIANGLES] = {0};
    uint64_t random = 4;
    for (int i = 0; i < 3 * TRIANGLES; i++) {
        rig_place(&rig, rig_random_float(&random, 0, SIZE), rig_random_float(&random, 0, SIZE),
                  rig_random_float(&random, 0, 1), rig_random_float(&random, 0.5f, 4), vertices[i].position);
    }
    rig_draw_once(&rig, vertices, 3 * TRIANGLES);
    float kept[SIZE * SIZE];
    memcpy(kept, rig_read_depth(&rig), sizeof kept);
    const float(*seen)[4] = rig_read_float4(&rig);
    int drawn = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(seen[i][0] == kept[i]);
        drawn += kept[i] < 1;
    }
    assert_true(drawn > SIZE * SIZE / 2);
    rig_close(&rig);
}

// Depth = varying 1; lanes of odd columns are discarded when varying 2 says so.
static void depth_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        groups[g].depth = groups[g].varying[3];
    }
}

static void entry_depth_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        for (int c = 0; c < 4; c++) {
            groups[g].color[0][c] = groups[g].depth;
        }
        groups[g].depth = groups[g].depth * 0.5f;
    }
}

static void odd_columns_fragment(struct rhw_fragment *groups, int count)
{
    rig_fragment_pass(groups, count);
    for (int g = 0; g < count; g++) {
        const rhw_int column = __builtin_convertvector(groups[g].coord[0], rhw_int);
        groups[g].mask &= (column & 1) == 0;
    }
}

static void test_depth_from_the_fragment_function(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig_set_program(&rig, rig_vertex_pass, depth_fragment);
    rig.pipeline.program.uses = RHW_USE_DEPTH;
    // Geometry says far, then near; the written depth says the opposite and wins.
    rig_begin(&rig);
    draw_layer(&rig, 0.125f, (const float[4]){1, 0, 0, 0.75f});
    draw_layer(&rig, 0.875f, (const float[4]){0, 1, 0, 0.5f});
    draw_layer(&rig, 0.25f, (const float[4]){0, 0, 1, 0.625f});
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[5][1] == 1);
    assert_true(rig_read_depth(&rig)[5] == 0.5f);
    rig_set_program(&rig, rig_vertex_pass, entry_depth_fragment);
    rig_begin(&rig);
    draw_layer(&rig, 0.75f, red);
    rig_end(&rig);
    assert_true(rig_read_float4(&rig)[5][0] == 0.75f);
    assert_true(rig_read_depth(&rig)[5] == 0.375f);
    rig_close(&rig);
}

static void test_a_written_depth_stays_in_range(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig_set_program(&rig, rig_vertex_pass, depth_fragment);
    rig.pipeline.program.uses = RHW_USE_DEPTH;
    rig.pipeline.depth_compare = RHW_COMPARE_ALWAYS;
    const float rows[][2] = {{-2, 0}, {3, 1}, {0.5f, 0.5f}};
    for (int i = 0; i < 3; i++) {
        rig_begin(&rig);
        draw_layer(&rig, 0.5f, (const float[4]){1, 0, 0, rows[i][0]});
        rig_end(&rig);
        assert_true(rig_read_depth(&rig)[5] == rows[i][1]);
    }
    rig_close(&rig);
}

static void test_discarded_lanes_leave_no_depth(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig_begin(&rig);
    rig_set_program(&rig, rig_vertex_pass, odd_columns_fragment);
    rig.pipeline.program.uses = RHW_USE_DISCARD | RHW_USE_COORD;
    draw_layer(&rig, 0.25f, red);
    rig_set_program(&rig, rig_vertex_pass, rig_fragment_pass);
    rig.pipeline.program.uses = 0;
    draw_layer(&rig, 0.5f, green);
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(pixels[i][i % 2] == 1 && pixels[i][1 - i % 2] == 0);
    }
    const float *depth = rig_read_depth(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(depth[i] == (i % 2 == 0 ? 0.25f : 0.5f));
    }
    rig_close(&rig);
}

static void test_discard_behind_what_is_there(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig_begin(&rig);
    struct rig_vertex half[6];
    rig_rectangle(&rig, 0, 0, SIZE, SIZE / 2, 0.25f, green, half);
    rig_draw(&rig, half, 6);
    rig_set_program(&rig, rig_vertex_pass, odd_columns_fragment);
    rig.pipeline.program.uses = RHW_USE_DISCARD | RHW_USE_COORD;
    draw_layer(&rig, 0.5f, red);
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            const float *p = pixels[y * SIZE + x];
            const bool front = y < SIZE / 2, back = !front && x % 2 == 0;
            assert_true(p[0] == (back ? 1.0f : 0.0f) && p[1] == (front ? 1.0f : 0.0f));
        }
    }
    rig_close(&rig);
}

// Without discard and depth output, fragments that fail the test are not shaded at all.
static void test_hidden_fragments_are_not_shaded(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig_begin(&rig);
    draw_layer(&rig, 0.25f, red);
    draw_layer(&rig, 0.5f, green);
    draw_layer(&rig, 0.75f, green);
    rig_end(&rig);
    assert_int_equal(rig.stats.fragments_shaded, SIZE * SIZE);
    rig_close(&rig);
}

// A block of 8×8 pixels that a triangle covers need not be one of those that hierarchical depth has a bound of: flat
// varyings let small triangles be drawn in blocks that start where the triangle does.
static void test_what_is_behind_shows_beside_a_small_triangle(void **state)
{
    (void)state;
    enum { X = 3, Y = 5, SIDE = 40 };
    for (int greater = 0; greater < 2; greater++) {
        struct rig rig;
        rig_open(&rig, SIZE, SIZE);
        rig_set_depth(&rig);
        rig.pipeline.program.varyings[0].qualifier = RHW_FLAT;
        rig.pipeline.depth_compare = greater ? RHW_COMPARE_GREATER : RHW_COMPARE_LESS;
        rig.pass.depth.clear = greater ? 0.0f : 1.0f;
        struct rig_vertex all[6];
        rig_begin(&rig);
        rig_rectangle(&rig, X, Y, X + SIDE, Y + SIDE, greater ? 0.75f : 0.25f, red, all);
        rig_draw(&rig, all, 6);
        draw_layer(&rig, 0.5f, green);
        rig_end(&rig);
        const float(*const pixels)[4] = rig_read_float4(&rig);
        for (int i = 0; i < SIZE * SIZE; i++) {
            const int x = i % SIZE - X, y = i / SIZE - Y;
            const bool inside = x >= 0 && x < SIDE && y >= 0 && y < SIDE;
            assert_memory_equal(pixels[i], inside ? red : green, sizeof red);
        }
        rig_close(&rig);
    }
}

static void test_depth_only_program(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig.pass.colors[0].texture = (rhw_texture){0};
    rig.pass.color_count = 0;
    rig.pipeline.target_count = 0;
    rig_set_program(&rig, rig_vertex_pass, NULL);
    rig_begin(&rig);
    draw_layer(&rig, 0.375f, red);
    rig_end(&rig);
    const float *depth = rig_read_depth(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(depth[i] == 0.375f);
    }
    rig_close(&rig);
}

// Draw a layer whose colours no target takes. Return how many fragments were shaded, or how many a query counts.
static uint64_t shaded_unseen(bool has_target, uint32_t uses, bool is_counted)
{
    struct rig rig;
    rig_open(&rig, SIZE, SIZE);
    rig_set_depth(&rig);
    rig.pipeline.program.uses = uses;
    rig.pipeline.targets[0].write_mask = RHW_WRITE_NONE;
    if (!has_target) {
        rig.pass.colors[0].texture = (rhw_texture){0};
        rig.pass.color_count = rig.pipeline.target_count = 0;
    }
    rhw_query query = {0};
    const struct rhw_query_def def = {.kind = RHW_QUERY_STATISTICS};
    assert_int_equal(rhw_query_create(rig.context, &def, &query), RHW_OK);
    rig_begin(&rig);
    rig_use_pipeline(&rig);
    if (is_counted) {
        rhw_pass_begin_query(rig.context, rig.recording, query);
    }
    draw_layer(&rig, 0.375f, red);
    if (is_counted) {
        rhw_pass_end_query(rig.context, rig.recording, query);
    }
    rig_end(&rig);
    const float *const depth = rig_read_depth(&rig);
    for (int i = 0; i < SIZE * SIZE; i++) {
        assert_true(depth[i] == 0.375f);
    }
    struct rhw_query_counts counts = {0};
    if (is_counted) {
        assert_int_equal(rhw_query_read(rig.context, query, &counts), RHW_OK);
    }
    rhw_query_destroy(rig.context, query);
    const uint64_t shaded = rig.stats.fragments_shaded;
    rig_close(&rig);
    return is_counted ? counts.statistics.fragment_shader_invocations : shaded;
}

static void test_colours_that_no_target_takes_are_not_shaded(void **state)
{
    (void)state;
    for (int has_target = 0; has_target < 2; has_target++) {
        assert_int_equal(shaded_unseen(has_target, 0, false), 0);
        assert_int_equal(shaded_unseen(has_target, RHW_USE_COORD, false), 0);
        assert_int_equal(shaded_unseen(has_target, 0, true), SIZE * SIZE);
        assert_int_equal(shaded_unseen(has_target, RHW_USE_DISCARD, false), SIZE * SIZE);
        assert_int_equal(shaded_unseen(has_target, RHW_USE_EFFECTS, false), SIZE * SIZE);
    }
}

// A prepass and a second draw of the same triangles with EQUAL must meet in every pixel.
static void test_equal_after_a_prepass(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 256, 256);
    rig_set_depth(&rig);
    uint64_t random = 4;
    struct rig_vertex vertices[300];
    for (int i = 0; i < 300; i++) {
        const float w = rig_random_float(&random, 0.5f, 20);
        rig_place(&rig, rig_random_float(&random, -50, 300), rig_random_float(&random, -50, 300),
                  rig_random_float(&random, 0, 1), w, vertices[i].position);
        memcpy(vertices[i].value, red, sizeof red);
    }
    rig_begin(&rig);
    rig_set_program(&rig, rig_vertex_pass, NULL);
    rig.pipeline.targets[0].write_mask = RHW_WRITE_NONE;
    rig_draw(&rig, vertices, 300);
    rig_set_program(&rig, rig_vertex_pass, rig_fragment_pass);
    rig.pipeline.targets[0].write_mask = 0;
    rig.pipeline.depth_compare = RHW_COMPARE_EQUAL;
    rig.pipeline.depth_read_only = true;
    rig_draw(&rig, vertices, 300);
    rig_end(&rig);
    static float depth[256 * 256];
    memcpy(depth, rig_read_depth(&rig), sizeof depth);
    const float(*pixels)[4] = rig_read_float4(&rig);
    int drawn = 0;
    for (int i = 0; i < 256 * 256; i++) {
        drawn += depth[i] != 1;
        assert_true((depth[i] != 1) == (pixels[i][0] == 1));
    }
    assert_true(drawn > 30000);
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_every_compare_function),
    cmocka_unit_test(test_compare_against_drawn_depth),
    cmocka_unit_test(test_without_depth_test_nothing_is_tested_or_written),
    cmocka_unit_test(test_depth_is_kept_between_passes),
    cmocka_unit_test(test_depth_without_memory),
    cmocka_unit_test(test_depth_of_slanted_triangles),
    cmocka_unit_test(test_fragments_see_the_depth_that_is_kept),
    cmocka_unit_test(test_depth_from_the_fragment_function),
    cmocka_unit_test(test_a_written_depth_stays_in_range),
    cmocka_unit_test(test_discarded_lanes_leave_no_depth),
    cmocka_unit_test(test_discard_behind_what_is_there),
    cmocka_unit_test(test_hidden_fragments_are_not_shaded),
    cmocka_unit_test(test_what_is_behind_shows_beside_a_small_triangle),
    cmocka_unit_test(test_depth_only_program),
    cmocka_unit_test(test_colours_that_no_target_takes_are_not_shaded),
    cmocka_unit_test(test_equal_after_a_prepass),
};

const struct unit_tests test_depth = UNIT_TESTS(tests, NULL, NULL);
