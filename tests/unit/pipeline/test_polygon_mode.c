// SPDX-License-Identifier: MIT
// Triangles as edges and corners: the very lines and points, with the facing, the number and the flat values of the
// triangle; culling, clipping and order.
#include "harness.h"

#include <string.h>

enum { SIZE = 96 };

static void identity_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = rhw_float_from_int(groups[g].primitive) + 1.0f;
        groups[g].color[0][1] = rhw_select(groups[g].front_facing, rhw_splat(2), rhw_splat(1));
        groups[g].color[0][2] = groups[g].varying[0];
        groups[g].color[0][3] = groups[g].varying[1];
    }
}

static void open_rig(struct rig *rig, enum rhw_paths paths)
{
    struct rhw_context_def def = rhw_context_def_default();
    def.paths = paths;
    def.threads = 2;
    rig_open_with(rig, SIZE, SIZE, &def);
    rig_set_program(rig, rig_vertex_pass, identity_fragment);
    rig->pipeline.program.uses = RHW_USE_FACING | RHW_USE_IDS;
    rig->pipeline.program.varyings[0] = (struct rhw_varying){.components = 1, .qualifier = RHW_FLAT};
    rig->pipeline.program.varyings[1] = (struct rhw_varying){.components = 3};
    rig->pipeline.program.varying_count = 2;
}

static struct rig_vertex vertex_at(const struct rig *rig, float x, float y, float z, float value)
{
    struct rig_vertex v = {.value = {value, 10 * value, 0, 0}};
    rig_place(rig, x, y, z, 1, v.position);
    return v;
}

// A triangle's edges as lines whose flat values are those of its provoking vertex.
static void test_edges_are_lines(void **state)
{
    (void)state;
    for (int last = 0; last < 2; last++) {
        struct rig rig;
        open_rig(&rig, RHW_PATHS_ALL);
        rig.pipeline.provoking = last ? RHW_PROVOKING_LAST : RHW_PROVOKING_FIRST;
        rig.pipeline.line_width = 2.5f;
        struct rig_vertex t[3] = {vertex_at(&rig, 10, 12, 0.5f, 3), vertex_at(&rig, 80, 30, 0.5f, 4),
                                  vertex_at(&rig, 30, 85, 0.5f, 5)};
        const int pairs[3][2] = {{0, 1}, {1, 2}, {2, 0}};
        struct rig_vertex lines[6];
        for (int i = 0; i < 6; i++) {
            lines[i] = t[pairs[i / 2][i % 2]];
            lines[i].value[0] = last ? 5 : 3;
        }
        rig.pipeline.topology = RHW_LINE_LIST;
        rig_draw_once(&rig, lines, 6);
        static float expected[SIZE * SIZE][4];
        memcpy(expected, rig_read_float4(&rig), sizeof expected);
        rig.pipeline.topology = RHW_TRIANGLE_LIST;
        rig.pipeline.polygon_mode = RHW_POLYGON_LINE;
        for (int turned = 0; turned < 2; turned++) {
            rig.pipeline.front = turned ? RHW_COUNTER_CLOCKWISE : RHW_CLOCKWISE;
            rig_draw_once(&rig, t, 3);
            assert_int_equal(rig.stats.triangles_in, 1);
            assert_int_equal(rig.stats.triangles_rasterized, 1);
            const float(*pixels)[4] = rig_read_float4(&rig);
            for (int i = 0; i < SIZE * SIZE; i++) {
                const bool in = expected[i][0] != 0;
                assert_true(pixels[i][0] == (in ? 1 : 0)); // the triangle's number, not the line's
                assert_true(pixels[i][1] == (!in ? 0 : turned ? 1 : 2));
                assert_true(memcmp(&pixels[i][2], &expected[i][2], 2 * sizeof(float)) == 0);
            }
        }
        rig_close(&rig);
    }
}

static void test_corners_are_points(void **state)
{
    (void)state;
    for (int last = 0; last < 2; last++) {
        struct rig rig;
        open_rig(&rig, RHW_PATHS_ALL);
        rig.pipeline.provoking = last ? RHW_PROVOKING_LAST : RHW_PROVOKING_FIRST;
        const struct rig_vertex t[3] = {vertex_at(&rig, 10, 12, 0.5f, 3), vertex_at(&rig, 80, 30, 0.5f, 4),
                                        vertex_at(&rig, 30, 85, 1.5f, 5)}; // the third behind the far plane
        rig.pipeline.polygon_mode = RHW_POLYGON_POINT;
        rig_draw_once(&rig, t, 3);
        const float(*pixels)[4] = rig_read_float4(&rig);
        int seen = 0;
        for (int i = 0; i < SIZE * SIZE; i++) {
            seen += pixels[i][0] != 0;
        }
        assert_int_equal(seen, 2);
        const float *const a = pixels[11 * SIZE + 9], *const b = pixels[29 * SIZE + 79];
        assert_true(a[2] == (last ? 5 : 3) && a[3] == 30);
        assert_true(b[2] == (last ? 5 : 3) && b[3] == 40);
        rig_close(&rig);
    }
}

static void test_culling_takes_the_triangle(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    const struct rig_vertex t[3] = {vertex_at(&rig, 10, 12, 0.5f, 3), vertex_at(&rig, 80, 30, 0.5f, 4),
                                    vertex_at(&rig, 30, 85, 0.5f, 5)};
    for (int mode = RHW_POLYGON_LINE; mode <= RHW_POLYGON_POINT; mode++) {
        rig.pipeline.polygon_mode = (enum rhw_polygon_mode)mode;
        for (int cull = RHW_CULL_FRONT; cull <= RHW_CULL_BACK; cull++) {
            rig.pipeline.cull = (enum rhw_cull)cull;
            rig_draw_once(&rig, t, 3);
            // On the screen, where y points down, it turns clockwise.
            assert_int_equal(rig.stats.triangles_culled, cull == RHW_CULL_BACK);
            assert_int_equal(rig.stats.triangles_rasterized, cull == RHW_CULL_FRONT);
        }
    }
    rig_close(&rig);
}

// Small and large, cut by planes or from behind the eye: the same bytes on every path.
static void test_paths_agree(void **state)
{
    (void)state;
    enum { TRIANGLES = 1500 };
    static struct rig_vertex v[3 * TRIANGLES];
    for (int mode = RHW_POLYGON_LINE; mode <= RHW_POLYGON_POINT; mode++) {
        uint64_t hashes[3];
        for (int k = 0; k < 3; k++) {
            struct rig rig;
            open_rig(&rig, k == 0 ? RHW_PATHS_ALL : k == 1 ? RHW_PATHS_IN_ORDER : RHW_PATHS_GENERAL);
            rig.pipeline.polygon_mode = (enum rhw_polygon_mode)mode;
            uint64_t random = 21;
            for (int i = 0; i < 3 * TRIANGLES; i++) {
                v[i] = vertex_at(&rig, rig_random_float(&random, -20, SIZE + 20),
                                 rig_random_float(&random, -20, SIZE + 20),
                                 rig_random_float(&random, -0.3f, 1.2f), (float)i);
                if (i % 17 == 0) {
                    v[i].position[3] = rig_random_float(&random, -1, 0.2f);
                }
            }
            rig_draw_once(&rig, v, 3 * TRIANGLES);
            assert_int_equal(rig.stats.triangles_in, rig.stats.triangles_culled +
                                                         rig.stats.triangles_dropped +
                                                         rig.stats.triangles_rasterized);
            hashes[k] = rig_hash(&rig, 0);
            rig_close(&rig);
        }
        assert_true(hashes[0] == hashes[1]);
        assert_true(hashes[0] == hashes[2]);
    }
}

static void test_an_unknown_mode_is_misuse(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL);
    rig.pipeline.polygon_mode = (enum rhw_polygon_mode)3;
    rhw_pipeline pipeline;
    assert_int_equal(rhw_pipeline_create(rig.context, &rig.pipeline, &pipeline), RHW_ERROR_MISUSE);
    rig_expect_misuse(&rig, "polygon_mode is 3; it must be 0..2 (enum rhw_polygon_mode)");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_edges_are_lines),
    cmocka_unit_test(test_corners_are_points),
    cmocka_unit_test(test_culling_takes_the_triangle),
    cmocka_unit_test(test_paths_agree),
    cmocka_unit_test(test_an_unknown_mode_is_misuse),
};

const struct unit_tests test_polygon_mode = UNIT_TESTS(tests, NULL, NULL);
