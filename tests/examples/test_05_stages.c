// SPDX-License-Identifier: MIT
// Lesson 5: the lesson checks the pipeline; this checks the lesson. Its cut points are compared with numbers
// worked out on paper, the pipeline's values with the homogeneous triangle (Cramer's rule, no clipping at
// all), and its comparisons must notice values that are a little off.
#include "lesson.h"

#include <math.h>
#include <string.h>

#define main lesson_main
#include "05_stages.c"
#undef main

static struct pixel pixels[SIZE * SIZE], spoiled[SIZE * SIZE];
static struct polygon polygon;

static int ask(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    polygon = clip_near();
    snap(&polygon);
    ask_pipeline(context, RHW_TRIANGLE_LIST, triangle, 3, pixels);
    rhw_context_destroy(context);
    return 0;
}

static void cut_points(void **state)
{
    (void)state;
    static const double expected[4][7] = {
        {-1.75, 0.375, 3, 4, 1, 0, 0},
        {2.5, 4, 9, 10, 0, 1, 0},
        {0.8125, -0.5, 0, 1, 0, 0.25, 0.75}, // a quarter of B, three quarters of C
        {-0.75, -0.8125, 0, 1, 0.5, 0, 0.5}, // half A, half C
    };
    static const int64_t snapped[4][2] = {
        {72 * 256, 116 * 256}, {160 * 256, 19661}, {232 * 256, 192 * 256}, {32 * 256, 232 * 256}};
    assert_int_equal(polygon.count, 4);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 7; k++) {
            const double value = k < 4 ? polygon.points[i].clip[k] : polygon.points[i].weight[k - 4];
            assert_true(value == expected[i][k]);
        }
        assert_int_equal(polygon.x_24_8[i], snapped[i][0]);
        assert_int_equal(polygon.y_24_8[i], snapped[i][1]);
    }
}

static void homogeneous_triangle(void **state)
{
    (void)state;
    double vertices[3][3];
    for (int i = 0; i < 3; i++) {
        const double x = (double)triangle[i].clip[0], y = (double)triangle[i].clip[1];
        const double w = (double)triangle[i].clip[3];
        vertices[i][0] = (w + x) / 2 * SIZE;
        vertices[i][1] = (w - y) / 2 * SIZE;
        vertices[i][2] = w;
    }
    int count = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        const struct pixel *pixel = &pixels[i];
        const int x = i % SIZE, y = i / SIZE;
        if (pixel->covered != 1) {
            continue;
        }
        count++;
        const struct ref_weights truth =
            ref_weights_homogeneous((const double(*)[3])vertices, x + 0.5, y + 0.5);
        const struct recovered ours = recover(&polygon, x, y);
        for (int k = 0; k < 3; k++) {
            lesson_near("weight in space", x, y, pixel->space[k], truth.space[k], 1);
            lesson_near("weight on the screen", x, y, pixel->screen[k], truth.screen[k], 2.5);
            lesson_close(ours.space[k], truth.space[k], 1e-12);
            lesson_close(ours.screen[k], truth.screen[k], 1e-12);
        }
        lesson_near("1/w", x, y, pixel->coord[3], 1 / truth.w, 1);
        lesson_near("z/w", x, y, pixel->coord[2], 1 - 1 / truth.w, 1); // Z = W − 1
        lesson_near("u", x, y, pixel->smooth_uv[0], truth.space[1], 1);
        lesson_near("v", x, y, pixel->smooth_uv[1], truth.space[0], 1);
        lesson_near("u noperspective", x, y, pixel->noperspective_u, truth.screen[1], 2.5);
        assert_true(pixel->flat_u == 0);
        assert_true(pixel->coord[0] == (float)x + 0.5f && pixel->coord[1] == (float)y + 0.5f);
    }
    assert_in_range(count, 15000, 25000);
}

static void expect_mismatches(int count)
{
    assert_int_equal(check_values(&polygon, spoiled), count);
    memcpy(spoiled, pixels, sizeof spoiled);
}

static void notices_what_is_off(void **state)
{
    (void)state;
    struct pixel *pixel = &spoiled[ROW * SIZE + COLUMN];
    memcpy(spoiled, pixels, sizeof spoiled);
    expect_mismatches(0);
    pixel->space[1] += 2e-6f;
    expect_mismatches(1);
    pixel->screen[2] = NAN;
    expect_mismatches(1);
    pixel->coord[2] -= 2e-6f;
    pixel->coord[3] += 2e-6f;
    expect_mismatches(2);
    pixel->smooth_uv[1] += 2e-6f;
    pixel->noperspective_u += 1e-5f;
    pixel->flat_u = 1e-7f;
    expect_mismatches(3);

    assert_int_equal(check_coverage("nothing spoiled", &polygon, pixels), 0);
    pixel->covered = 0;
    assert_int_equal(check_coverage("a pixel removed", &polygon, spoiled), 1);
    struct polygon moved = polygon;
    moved.x_24_8[2] += 256;
    assert_int_equal(check_coverage("a corner moved", &moved, pixels), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cut_points),
        cmocka_unit_test(homogeneous_triangle),
        cmocka_unit_test(notices_what_is_off),
        cmocka_unit_test(lesson_run),
    };
    return cmocka_run_group_tests(tests, ask, NULL);
}
