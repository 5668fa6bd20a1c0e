// SPDX-License-Identifier: MIT
// Where things land: y up, origin top left, pixel centres at .5, both depth conventions, viewport with
// depth range, scissor, winding and culling.
#include "harness.h"

#include <math.h>
#include <string.h>

static const float white[4] = {1, 1, 1, 1};

static int count_covered(struct rig *rig)
{
    const float(*pixels)[4] = rig_read_float4(rig);
    int covered = 0;
    for (int i = 0; i < rig->width * rig->height; i++) {
        covered += pixels[i][0] != 0;
    }
    return covered;
}

static void expect_rect(struct rig *rig, int x0, int y0, int x1, int y1)
{
    const float(*pixels)[4] = rig_read_float4(rig);
    for (int y = 0; y < rig->height; y++) {
        for (int x = 0; x < rig->width; x++) {
            const bool inside = x >= x0 && x < x1 && y >= y0 && y < y1;
            if ((pixels[y * rig->width + x][0] != 0) != inside) {
                fail_msg("pixel %d,%d is %s where %d,%d..%d,%d was to be drawn", x, y,
                         inside ? "empty" : "drawn", x0, y0, x1, y1);
            }
        }
    }
}

static void test_y_is_up_and_row_0_is_the_top(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 64, 32);
    // The quarter of NDC where x < 0 and y > 0, as two triangles: the top left quarter of the picture.
    const struct rig_vertex quarter[6] = {
        {{-1, 0, 0, 1}, {1, 1, 1, 1}}, {{0, 0, 0, 1}, {1, 1, 1, 1}}, {{-1, 1, 0, 1}, {1, 1, 1, 1}},
        {{-1, 1, 0, 1}, {1, 1, 1, 1}}, {{0, 0, 0, 1}, {1, 1, 1, 1}}, {{0, 1, 0, 1}, {1, 1, 1, 1}},
    };
    rig_draw_once(&rig, quarter, 6);
    expect_rect(&rig, 0, 0, 32, 16);
    rig_close(&rig);
}

static void test_pixel_centres_are_at_one_half(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 64, 64);
    uint64_t random = 1;
    for (int i = 0; i < 200; i++) {
        const int x = rig_random_int(&random, 64), y = rig_random_int(&random, 64);
        struct rig_vertex tiny[6];
        // A square of 1/64 pixel around the centre has that pixel; the same square beside it has none.
        const float cx = (float)x + 0.5f, cy = (float)y + 0.5f, r = 1.0f / 128;
        rig_rectangle(&rig, cx - r, cy - r, cx + r, cy + r, 0.5f, white, tiny);
        rig_draw_once(&rig, tiny, 6);
        expect_rect(&rig, x, y, x + 1, y + 1);
        rig_rectangle(&rig, cx + r, cy - r, cx + 3 * r, cy + r, 0.5f, white, tiny);
        rig_draw_once(&rig, tiny, 6);
        assert_int_equal(count_covered(&rig), 0);
    }
    rig_close(&rig);
}

static float depth_of(struct rig *rig, float z, float w)
{
    const struct rig_vertex triangle[3] = {
        {{-w, -w, z, w}, {1, 1, 1, 1}}, {{3 * w, -w, z, w}, {1, 1, 1, 1}}, {{-w, 3 * w, z, w}, {1, 1, 1, 1}}};
    rig_draw_once(rig, triangle, 3);
    const float *depth = rig_read_depth(rig);
    for (int i = 1; i < rig->width * rig->height; i++) {
        assert_true(depth[i] == depth[0]);
    }
    return depth[0];
}

static void test_depth_conventions(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 16, 16);
    rig_set_depth(&rig);
    rig.pass.depth.clear = 0.875f;
    rig.pipeline.depth_compare = RHW_COMPARE_ALWAYS;
    assert_true(depth_of(&rig, 0.25f, 1) == 0.25f);
    assert_true(depth_of(&rig, 0.5f, 2) == 0.25f);
    assert_true(depth_of(&rig, 0, 1) == 0);
    assert_true(depth_of(&rig, 1, 1) == 1);
    assert_true(depth_of(&rig, -0.125f, 1) == 0.875f); // before the near plane: only the clear value
    assert_true(depth_of(&rig, 1.125f, 1) == 0.875f);  // behind the far plane
    rig.pipeline.depth_range = RHW_DEPTH_MINUS_ONE_TO_ONE;
    assert_true(depth_of(&rig, -1, 1) == 0);
    assert_true(depth_of(&rig, -0.5f, 1) == 0.25f);
    assert_true(depth_of(&rig, 0, 1) == 0.5f);
    assert_true(depth_of(&rig, 2, 2) == 1);
    assert_true(depth_of(&rig, -1.125f, 1) == 0.875f);
    assert_true(depth_of(&rig, 1.125f, 1) == 0.875f);
    rig_close(&rig);
}

static void draw_with_viewport(struct rig *rig, const struct rhw_viewport *viewport, float z)
{
    // Twice as large as the view, so that what lies outside the viewport has to be cut off.
    const struct rig_vertex large[6] = {
        {{-2, -2, z, 1}, {1, 1, 1, 1}}, {{2, -2, z, 1}, {1, 1, 1, 1}}, {{-2, 2, z, 1}, {1, 1, 1, 1}},
        {{-2, 2, z, 1}, {1, 1, 1, 1}},  {{2, -2, z, 1}, {1, 1, 1, 1}}, {{2, 2, z, 1}, {1, 1, 1, 1}},
    };
    rig_begin(rig);
    rhw_pass_set_viewport(rig->context, rig->recording, viewport);
    rig_draw(rig, large, 6);
    rig_end(rig);
}

static void test_viewport_places_and_cuts(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 96, 80);
    draw_with_viewport(&rig, &(struct rhw_viewport){10, 20, 30, 40, 0, 1}, 0.5f);
    expect_rect(&rig, 10, 20, 40, 60);
    draw_with_viewport(&rig, &(struct rhw_viewport){-10, -20, 30, 40, 0, 1}, 0.5f);
    expect_rect(&rig, 0, 0, 20, 20);
    draw_with_viewport(&rig, &(struct rhw_viewport){90, 70, 300, 400, 0, 1}, 0.5f);
    expect_rect(&rig, 90, 70, 96, 80);
    draw_with_viewport(&rig, &(struct rhw_viewport){-500, -500, 1000, 1000, 0, 1}, 0.5f);
    expect_rect(&rig, 0, 0, 96, 80);
    draw_with_viewport(&rig, &(struct rhw_viewport){200, 0, 50, 50, 0, 1}, 0.5f);
    assert_int_equal(count_covered(&rig), 0);
    rig_close(&rig);
}

static void test_viewport_maps_positions(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 128, 128);
    // NDC x −0.5..0.25 and y −0.25..0.5 of a viewport at 16,32 of 64×32 pixels.
    const struct rig_vertex inner[6] = {
        {{-0.5f, -0.25f, 0, 1}, {1, 1, 1, 1}}, {{0.25f, -0.25f, 0, 1}, {1, 1, 1, 1}},
        {{-0.5f, 0.5f, 0, 1}, {1, 1, 1, 1}},   {{-0.5f, 0.5f, 0, 1}, {1, 1, 1, 1}},
        {{0.25f, -0.25f, 0, 1}, {1, 1, 1, 1}}, {{0.25f, 0.5f, 0, 1}, {1, 1, 1, 1}},
    };
    rig_begin(&rig);
    rhw_pass_set_viewport(rig.context, rig.recording, &(struct rhw_viewport){16, 32, 64, 32, 0, 1});
    rig_draw(&rig, inner, 6);
    rig_end(&rig);
    expect_rect(&rig, 16 + 16, 32 + 8, 16 + 40, 32 + 20);
    rig_close(&rig);
}

static void test_viewport_depth_range(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 32, 32);
    rig_set_depth(&rig);
    rig.pipeline.depth_compare = RHW_COMPARE_ALWAYS;
    const struct {
        float min, max, z, expected;
    } rows[] = {
        {0, 1, 0.25f, 0.25f},          {0.5f, 0.75f, 0, 0.5f},   {0.5f, 0.75f, 1, 0.75f},
        {0.5f, 0.75f, 0.5f, 0.625f},   {0.75f, 0.25f, 0, 0.75f}, {0.75f, 0.25f, 1, 0.25f},
        {0.75f, 0.25f, 0.25f, 0.625f}, {0.5f, 0.5f, 0.3f, 0.5f},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        draw_with_viewport(&rig, &(struct rhw_viewport){0, 0, 32, 32, rows[i].min, rows[i].max}, rows[i].z);
        assert_true(rig_read_depth(&rig)[17] == rows[i].expected);
    }
    rig_close(&rig);
}

static void draw_with_scissor(struct rig *rig, struct rhw_rect scissor)
{
    struct rig_vertex all[6];
    rig_cover(rig, 0.5f, white, all);
    rig_begin(rig);
    rhw_pass_set_scissor(rig->context, rig->recording, &scissor);
    rig_draw(rig, all, 6);
    rig_end(rig);
}

static void test_scissor(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 150, 140);
    uint64_t random = 2;
    for (int i = 0; i < 50; i++) {
        const int x = rig_random_int(&random, 150), y = rig_random_int(&random, 140);
        const int w = rig_random_int(&random, 151 - x), h = rig_random_int(&random, 141 - y);
        draw_with_scissor(&rig, (struct rhw_rect){x, y, w, h});
        expect_rect(&rig, x, y, x + w, y + h);
        assert_int_equal(rig.stats.fragments_shaded, w * h);
    }
    draw_with_scissor(&rig, (struct rhw_rect){-10, -20, 30, 25});
    expect_rect(&rig, 0, 0, 20, 5);
    draw_with_scissor(&rig, (struct rhw_rect){140, 130, 1000, 1000});
    expect_rect(&rig, 140, 130, 150, 140);
    draw_with_scissor(&rig, (struct rhw_rect){-30, -30, 30, 30});
    assert_int_equal(count_covered(&rig), 0);
    draw_with_scissor(&rig, (struct rhw_rect){INT32_MIN / 2, INT32_MIN / 2, INT32_MAX, INT32_MAX});
    expect_rect(&rig, 0, 0, 150, 140);
    rig_close(&rig);
}

static void test_scissor_does_not_cut_the_clear(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 40, 40);
    rig.pass.colors[0].clear[0] = 0.5f;
    draw_with_scissor(&rig, (struct rhw_rect){3, 4, 5, 6});
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int y = 0; y < 40; y++) {
        for (int x = 0; x < 40; x++) {
            const bool inside = x >= 3 && x < 8 && y >= 4 && y < 10;
            assert_true(pixels[y * 40 + x][0] == (inside ? 1.0f : 0.5f));
        }
    }
    rig_close(&rig);
}

static void facing_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = rhw_select(groups[g].front_facing, rhw_splat(2), rhw_splat(1));
        for (int c = 1; c < 4; c++) {
            groups[g].color[0][c] = rhw_splat(0);
        }
    }
}

static void test_winding_and_culling(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 32, 32);
    rig.pipeline.program.uses = RHW_USE_FACING;
    rig_set_program(&rig, rig_vertex_pass, facing_fragment);
    // Counter-clockwise as seen with y up; then the other way round.
    const float corners[3][2] = {{-0.75f, -0.75f}, {0.75f, -0.75f}, {0, 0.75f}};
    for (int clockwise = 0; clockwise < 2; clockwise++) {
        for (int front = 0; front < 2; front++) {
            for (int cull = RHW_CULL_NONE; cull <= RHW_CULL_BOTH; cull++) {
                for (int mirrored = 0; mirrored < 2; mirrored++) {
                    struct rig_vertex triangle[3] = {0};
                    for (int i = 0; i < 3; i++) {
                        const int corner = clockwise ? 2 - i : i;
                        // A negative x scale mirrors the picture and turns the winding.
                        triangle[i].position[0] = corners[corner][0] * (mirrored ? -1.0f : 1.0f);
                        triangle[i].position[1] = corners[corner][1];
                        triangle[i].position[3] = 1;
                    }
                    rig.pipeline.front = front ? RHW_CLOCKWISE : RHW_COUNTER_CLOCKWISE;
                    rig.pipeline.cull = (enum rhw_cull)cull;
                    rig_draw_once(&rig, triangle, 3);
                    const bool is_front = (clockwise ^ mirrored) == front;
                    const bool gone =
                        cull == RHW_CULL_BOTH || cull == (is_front ? RHW_CULL_FRONT : RHW_CULL_BACK);
                    const float seen = rig_read_float4(&rig)[16 * 32 + 16][0];
                    assert_true(seen == (gone ? 0.0f : is_front ? 2.0f : 1.0f));
                    assert_int_equal(rig.stats.triangles_culled, gone ? 1 : 0);
                }
            }
        }
    }
    rig_close(&rig);
}

static void test_facing_of_a_triangle_with_a_vertex_behind_the_eye(void **state)
{
    (void)state;
    struct rig rig;
    rig_open(&rig, 64, 64);
    rig.pipeline.program.uses = RHW_USE_FACING;
    rig_set_program(&rig, rig_vertex_pass, facing_fragment);
    // A floor below the eye, seen from above; its near edge lies behind the eye. Camera space x, y, z with W = −z.
    const float floor[4][3] = {{-4, -1, 3}, {4, -1, 3}, {4, -1, -20}, {-4, -1, -20}};
    for (int turned = 0; turned < 2; turned++) {
        struct rig_vertex vertices[6] = {0};
        const int order[2][6] = {{0, 1, 2, 0, 2, 3}, {2, 1, 0, 3, 2, 0}};
        for (int i = 0; i < 6; i++) {
            const float *p = floor[order[turned][i]];
            const float near = 0.125f, far = 64, w = -p[2];
            vertices[i].position[0] = p[0];
            vertices[i].position[1] = p[1];
            vertices[i].position[2] = (w - near) * far / (far - near);
            vertices[i].position[3] = w;
        }
        rig_draw_once(&rig, vertices, 6);
        const float(*pixels)[4] = rig_read_float4(&rig);
        assert_true(pixels[60 * 64 + 32][0] == (turned ? 1.0f : 2.0f));
        assert_true(pixels[40 * 64 + 32][0] == (turned ? 1.0f : 2.0f));
    }
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_y_is_up_and_row_0_is_the_top),
    cmocka_unit_test(test_pixel_centres_are_at_one_half),
    cmocka_unit_test(test_depth_conventions),
    cmocka_unit_test(test_viewport_places_and_cuts),
    cmocka_unit_test(test_viewport_maps_positions),
    cmocka_unit_test(test_viewport_depth_range),
    cmocka_unit_test(test_scissor),
    cmocka_unit_test(test_scissor_does_not_cut_the_clear),
    cmocka_unit_test(test_winding_and_culling),
    cmocka_unit_test(test_facing_of_a_triangle_with_a_vertex_behind_the_eye),
};

const struct unit_tests test_conventions = UNIT_TESTS(tests, NULL, NULL);
