// SPDX-License-Identifier: MIT
// What a fragment function is told of conservative coverage: the fragments of an overestimated triangle that it contains
// are those that it has where it is underestimated, which test_conservative holds against whole numbers.
#include "harness.h"

#include <string.h>

enum { SIZE = 100, PIXELS = SIZE * SIZE };

// Red 1, green where it is told so.
static void covered_fragment(struct rhw_fragment *groups, int count)
{
    for (int g = 0; g < count; g++) {
        groups[g].color[0][0] = groups[g].color[0][3] = rhw_splat(1);
        groups[g].color[0][1] = rhw_select(groups[g].fully_covered, rhw_splat(1), rhw_splat(0));
        groups[g].color[0][2] = groups[g].varying[0];
    }
}

static void covered_fragment1(struct rhw_fragment1 *f)
{
    f->color[0][0] = f->color[0][3] = 1;
    f->color[0][1] = f->fully_covered;
    f->color[0][2] = f->varying[0];
}

static void open_rig(struct rig *rig, enum rhw_paths paths, int samples)
{
    rig_open_with(rig, SIZE, SIZE, &(struct rhw_context_def){.threads = 2, .paths = paths});
    rig_set_program(rig, rig_vertex_pass, covered_fragment);
    rig->pipeline.program.uses = RHW_USE_FULLY_COVERED;
    rig->pipeline.conservative = RHW_CONSERVATIVE_OVERESTIMATE;
    rig->pass.samples = samples;
}

static struct rig_vertex vertex_at(const struct rig *rig, float x, float y, float w)
{
    struct rig_vertex v = {.value = {0.25f, 1, 0, 1}};
    rig_place(rig, x, y, 0.5f, w, v.position);
    return v;
}

// Of the 13 pixels that a right-angled triangle with sides of 2 pixels touches, on their borders, it contains one.
static void test_by_hand(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL, 1);
    const struct rig_vertex v[] = {vertex_at(&rig, 20, 20, 1), vertex_at(&rig, 22, 20, 1),
                                   vertex_at(&rig, 20, 22, 1)};
    rig_draw_once(&rig, v, 3);
    const float(*pixels)[4] = rig_read_float4(&rig);
    int touched = 0;
    for (int i = 0; i < PIXELS; i++) {
        touched += pixels[i][0] == 1;
        assert_int_equal(pixels[i][1] == 1, i == 20 * SIZE + 20);
    }
    assert_int_equal(touched, 13);
    rig_close(&rig);
}

static void random_triangle(const struct rig *rig, struct rig_vertex v[3], int n, uint64_t *random)
{
    const int range = n % 3 == 0 ? 3 : n % 3 == 1 ? 20 : SIZE;
    const float x = (float)rig_random_int(random, SIZE + 1 - range),
                y = (float)rig_random_int(random, SIZE + 1 - range);
    for (int i = 0; i < 3; i++) {
        const float w = i == 0 && n % 4 == 3 ? -1 : 1; // cut in front of the eye
        v[i] = vertex_at(rig, x + (float)rig_random_int(random, range * 256) / 256,
                         y + (float)rig_random_int(random, range * 256) / 256, w);
    }
}

static void test_contained(void **state)
{
    (void)state;
    for (int round = 0; round < 4; round++) {
        uint64_t random = 8;
        for (int n = 0; n < 60; n++) {
            static bool told[PIXELS];
            struct rig rig;
            struct rig_vertex v[3];
            open_rig(&rig, round == 1 ? RHW_PATHS_GENERAL : RHW_PATHS_ALL, round == 2 ? 4 : 1);
            if (round == 3) {
                rig_set_program(&rig, rig_vertex_pass, NULL);
                rig.pipeline.program.fragment1 = covered_fragment1;
            }
            random_triangle(&rig, v, n, &random);
            rig_draw_once(&rig, v, 3);
            const float(*pixels)[4] = rig_read_float4(&rig);
            for (int i = 0; i < PIXELS; i++) {
                told[i] = pixels[i][1] == 1;
            }
            rig.pipeline.conservative = RHW_CONSERVATIVE_UNDERESTIMATE;
            rig_draw_once(&rig, v, 3);
            pixels = rig_read_float4(&rig);
            for (int i = 0; i < PIXELS; i++) {
                if ((pixels[i][0] == 1) != told[i] || pixels[i][1] != pixels[i][0]) {
                    fail_msg("round %d, triangle %d, pixel %d, %d: expected %d", round, n, i % SIZE, i / SIZE,
                             pixels[i][0] == 1);
                }
            }
            rig_close(&rig);
        }
    }
}

// Without conservative rasterization, and of other primitives, nobody is told.
static void test_elsewhere(void **state)
{
    (void)state;
    static const enum rhw_topology topologies[] = {RHW_TRIANGLE_LIST, RHW_POINT_LIST, RHW_LINE_LIST};
    for (int i = 0; i < 3; i++) {
        struct rig rig;
        open_rig(&rig, RHW_PATHS_ALL, 1);
        rig.pipeline.topology = topologies[i];
        rig.pipeline.line_width = 20;
        rig.pipeline.conservative = i == 0 ? RHW_CONSERVATIVE_OFF : RHW_CONSERVATIVE_OVERESTIMATE;
        const struct rig_vertex v[] = {vertex_at(&rig, 5, 5, 1), vertex_at(&rig, 95, 10, 1),
                                       vertex_at(&rig, 20, 90, 1)};
        rig_draw_once(&rig, v, 3);
        const float(*pixels)[4] = rig_read_float4(&rig);
        int drawn = 0;
        for (int p = 0; p < PIXELS; p++) {
            drawn += pixels[p][0] == 1;
            assert_float_equal(pixels[p][1], 0, 0);
        }
        assert_true(drawn >= 3);
        rig_close(&rig);
    }
}

// Nor of small triangles whose fragments wait beside those of a conservative draw.
static void test_behind_another(void **state)
{
    (void)state;
    struct rig rig;
    open_rig(&rig, RHW_PATHS_ALL, 1);
    const struct rig_vertex large[] = {vertex_at(&rig, 0, 0, 1), vertex_at(&rig, SIZE, 0, 1),
                                       vertex_at(&rig, 0, SIZE, 1)};
    struct rig_vertex small[60];
    for (int i = 0; i < 20; i++) {
        const float x = 60 + (float)(i % 5) * 8, y = 60 + (float)(i / 5) * 8;
        small[3 * i] = vertex_at(&rig, x, y, 1);
        small[3 * i + 1] = vertex_at(&rig, x + 3, y, 1);
        small[3 * i + 2] = vertex_at(&rig, x, y + 3, 1);
    }
    rig_begin(&rig);
    rig_draw(&rig, large, 3);
    rig.pipeline.conservative = RHW_CONSERVATIVE_OFF;
    rig_draw(&rig, small, 60);
    rig_end(&rig);
    const float(*pixels)[4] = rig_read_float4(&rig);
    for (int i = 0; i < 20; i++) {
        const int p = (60 + i / 5 * 8) * SIZE + 60 + i % 5 * 8;
        assert_float_equal(pixels[p][0], 1, 0);
        assert_float_equal(pixels[p][1], 0, 0);
    }
    assert_float_equal(pixels[10 * SIZE + 10][1], 1, 0);
    rig_close(&rig);
}

static void test_misuse(void **state)
{
    (void)state;
    struct rig rig;
    rig_open_with(&rig, SIZE, SIZE, &(struct rhw_context_def){.validate = RHW_VALIDATE_ON});
    rig_set_program(&rig, rig_vertex_pass, covered_fragment);
    const struct rig_vertex v[] = {vertex_at(&rig, 5, 5, 1), vertex_at(&rig, 95, 10, 1),
                                   vertex_at(&rig, 20, 90, 1)};
    rig_draw_once(&rig, v, 3);
    rig_expect_misuse(&rig, "reads fully_covered; RHW_USE_FULLY_COVERED is missing");
    rig_close(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_by_hand), cmocka_unit_test(test_contained), cmocka_unit_test(test_elsewhere),
    cmocka_unit_test(test_behind_another), cmocka_unit_test(test_misuse)};

const struct unit_tests test_fully_covered = UNIT_TESTS(tests, NULL, NULL);
