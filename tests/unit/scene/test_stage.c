// SPDX-License-Identifier: MIT
// The page's stage (web/stage): numbers against the formulas, the three methods against each other, columns, and what is refused.
#include "harness.h"
#include "stage.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIZE = 512, X = 260, Y = 240 };

// The places of stage_number_names that the tests look at.
static int place_of(const char *name)
{
    char names[1024];
    int place = 0;
    snprintf(names, sizeof names, "%s", stage_number_names());
    for (char *word = strtok(names, ","); word; word = strtok(NULL, ","), place++) {
        if (strcmp(word, name) == 0) {
            return place;
        }
    }
    fail_msg("no number is called %s", name);
    return -1;
}

static double number_of(const double *numbers, const char *name)
{
    return numbers[place_of(name)];
}

// Corners 82, 44 and 114 away, seen at 90 degrees: a point lands at (1 + x/z)/2 of the picture.
static void set_triangle(void)
{
    assert_true(stage_resize(SIZE, SIZE, 1));
    assert_true(stage_camera(0, 0, 0, 0, 0, -1, 90, 40, 200));
    stage_clear(0, 0, 0);
    assert_true(stage_corner(0, -48, 10, -82, 1, 0, 0, 0, 1));
    assert_true(stage_corner(1, 29, 15, -44, 0, 1, 0, 1, 1));
    assert_true(stage_corner(2, 13, -34, -114, 0, 0, 1, 0.5, 0));
}

static int open_stage(void **state)
{
    (void)state;
    assert_true(stage_open(1));
    set_triangle();
    return 0;
}

static int close_stage(void **state)
{
    (void)state;
    stage_close();
    return 0;
}

static void test_numbers_follow_the_formulas(void **state)
{
    (void)state;
    static const double corners[3][3] = {{-48, 10, 82}, {29, 15, 44}, {13, -34, 114}};
    assert_true(stage_triangle(STAGE_CORRECT, STAGE_COLORS, 0, SIZE));
    const double *const n = stage_explain(X, Y);
    assert_non_null(n);
    double x[3], y[3], e[3], sum = 0;
    for (int i = 0; i < 3; i++) {
        x[i] = rint((1 + corners[i][0] / corners[i][2]) / 2 * SIZE * 256);
        y[i] = rint((1 - corners[i][1] / corners[i][2]) / 2 * SIZE * 256);
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double px = X * 256 + 128, py = Y * 256 + 128;
        e[i] = fabs((x[k] - x[j]) * (py - y[j]) - (y[k] - y[j]) * (px - x[j]));
        sum += e[i];
    }
    const char *const edges[] = {"e_0", "e_1", "e_2"}, *const screen[] = {"r", "s", "t"},
                      *const space[] = {"a", "b", "c"};
    double inverse_w = 0;
    for (int i = 0; i < 3; i++) {
        assert_true(fabs(number_of(n, edges[i])) == e[i]);
        assert_true(fabs(number_of(n, screen[i]) - e[i] / sum) < 1e-15);
        inverse_w += e[i] / sum / corners[i][2];
    }
    assert_true(fabs(number_of(n, "inverse_w") - inverse_w) < 1e-17);
    for (int i = 0; i < 3; i++) {
        const double weight = e[i] / sum / corners[i][2] / inverse_w;
        assert_true(fabs(number_of(n, space[i]) - weight) < 1e-7);
    }
    assert_true(fabs(number_of(n, "green") - number_of(n, "b")) < 1e-7);
    assert_true(number_of(n, "smooth") == 1 && number_of(n, "snapped") == 1 && number_of(n, "clipped") == 0);
}

static void test_naive_is_what_the_screen_says(void **state)
{
    (void)state;
    stage_clear(0, 0, 0);
    assert_true(stage_triangle(STAGE_NAIVE, STAGE_COLORS, 0, SIZE));
    const double *const n = stage_explain(X, Y);
    assert_non_null(n);
    assert_true(number_of(n, "smooth") == 0);
    assert_true(fabs(number_of(n, "green") - number_of(n, "s")) < 1e-7);
    assert_true(number_of(n, "b") - number_of(n, "s") > 0.17); // a large mistake
}

// By way of the world the same numbers come out, but for what floats lose.
static void test_by_world(void **state)
{
    (void)state;
    stage_clear(0, 0, 0);
    assert_true(stage_triangle(STAGE_WORLD, STAGE_COLORS, 0, SIZE));
    const double *const n = stage_explain(X, Y);
    assert_non_null(n);
    assert_true(fabs(number_of(n, "output_red") - number_of(n, "a")) < 1e-4);
    assert_true(fabs(number_of(n, "output_green") - number_of(n, "b")) < 1e-4);
    assert_true(fabs(number_of(n, "output_blue") - number_of(n, "c")) < 1e-4);
    // What it went by: the point of the world, its areas, and what they mix.
    static const double corners[3][3] = {{-48, 10, -82}, {29, 15, -44}, {13, -34, -114}};
    static const char *const weights[] = {"a", "b", "c"}, *const areas[] = {"world_a", "world_b", "world_c"},
                             *const axes[] = {"world_x", "world_y", "world_z"};
    for (int i = 0; i < 3; i++) {
        double place = 0;
        for (int k = 0; k < 3; k++) {
            place += number_of(n, weights[k]) * corners[k][i];
        }
        assert_true(fabs(number_of(n, axes[i]) - place) < 0.01);
        assert_true(fabs(number_of(n, areas[i]) - number_of(n, weights[i])) < 1e-4);
    }
    assert_true(number_of(n, "method") == STAGE_WORLD);
    assert_true(fabs(number_of(n, "world_u") - number_of(n, "u")) < 1e-4 &&
                fabs(number_of(n, "world_v") - number_of(n, "v")) < 1e-4);
    assert_true(number_of(n, "world_green") == number_of(n, "output_green"));
}

static void test_other_methods_have_no_point_of_the_world(void **state)
{
    (void)state;
    stage_clear(0, 0, 0);
    assert_true(stage_triangle(STAGE_WORLD, STAGE_COLORS, 0, SIZE));
    assert_true(stage_triangle(STAGE_CORRECT, STAGE_COLORS, 0, SIZE)); // over it
    const double *const n = stage_explain(X, Y);
    assert_true(number_of(n, "method") == STAGE_CORRECT && number_of(n, "triangle") == 1);
    assert_true(isnan(number_of(n, "world_x")) && isnan(number_of(n, "world_green")));
}

static void test_pictures_show_what_they_say(void **state)
{
    (void)state;
    const struct {
        enum stage_pattern pattern;
        const char *red, *green;
    } rows[] = {{STAGE_COLORS, "red", "green"}, {STAGE_DEPTH, "depth", "depth"}, {STAGE_UV, "u", "v"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        stage_clear(0, 0, 0);
        assert_true(stage_triangle(STAGE_CORRECT, (int)rows[i].pattern, 0, SIZE));
        const uint8_t *const pixel = stage_draw() + 4 * (Y * SIZE + X);
        const int red = pixel[0], green = pixel[1];
        const double *const n = stage_explain(X, Y);
        assert_int_equal(red, lrint(number_of(n, rows[i].red) * 255));
        assert_int_equal(green, lrint(number_of(n, rows[i].green) * 255));
    }
    // 1/W over the largest, and u/W the same way.
    stage_clear(0, 0, 0);
    assert_true(stage_triangle(STAGE_CORRECT, STAGE_UV_OVER_W, 0, SIZE));
    const int red = stage_draw()[4 * (Y * SIZE + X)];
    const double *const n = stage_explain(X, Y);
    assert_int_equal(red, lrint(number_of(n, "u") * number_of(n, "inverse_w") * 44 * 255));
}

static void test_columns(void **state)
{
    (void)state;
    stage_clear(0, 0, 0);
    assert_true(stage_triangle(STAGE_CORRECT, STAGE_COLORS, 0, X));
    assert_true(stage_triangle(STAGE_NAIVE, STAGE_COLORS, X, SIZE));
    assert_true(stage_triangle(STAGE_NAIVE, STAGE_COLORS, X, X)); // no column at all
    assert_true(number_of(stage_explain(X - 1, Y), "triangle") == 0);
    assert_true(number_of(stage_explain(X, Y), "triangle") == 1);
    assert_null(stage_explain(2, 2));
}

// Corner 2 behind the eye: there are no edges to tell of, but weights in space stay within 0..1.
static void test_behind_the_eye(void **state)
{
    (void)state;
    assert_true(stage_camera(0, 0, 0, 0, 0, -1, 90, 0.5, 50));
    stage_clear(0, 0, 0);
    assert_true(stage_corner(0, -1.6, -0.9, -3.4, 1, 0, 0, 0, 0));
    assert_true(stage_corner(1, 1.9, 0.9, -4.2, 0, 1, 0, 1, 0));
    assert_true(stage_corner(2, 0.2, -0.55, 0.6, 0, 0, 1, 0.5, 1));
    assert_true(stage_triangle(STAGE_CORRECT, STAGE_CHECKER, 0, SIZE));
    const double *const n = stage_explain(SIZE / 2, 300);
    assert_non_null(n);
    assert_true(number_of(n, "W_2") < 0 && number_of(n, "snapped") == 0 && isnan(number_of(n, "e_0")));
    assert_true(number_of(n, "t") < 0);
    for (int i = 0; i < 3; i++) {
        const double weight = number_of(n, (const char *[]){"a", "b", "c"}[i]);
        assert_true(weight >= 0 && weight <= 1);
    }
}

static void test_threads_and_samples(void **state)
{
    (void)state;
    static uint8_t once[SIZE * SIZE * 4];
    set_triangle();
    assert_true(stage_resize(SIZE, SIZE, 4));
    assert_true(stage_triangle(STAGE_CORRECT, STAGE_FLOOR, 0, SIZE));
    memcpy(once, stage_draw(), sizeof once);
    assert_true(stage_open(3));
    set_triangle();
    assert_true(stage_resize(SIZE, SIZE, 4));
    assert_true(stage_triangle(STAGE_CORRECT, STAGE_FLOOR, 0, SIZE));
    assert_memory_equal(stage_draw(), once, sizeof once);
}

static void test_what_is_refused(void **state)
{
    (void)state;
    assert_false(stage_resize(0, 4, 1));
    assert_false(stage_resize(4, STAGE_MAX_SIZE + 1, 1));
    assert_false(stage_resize(4, 4, 3));
    assert_string_equal(stage_error(),
                        "a picture is 1 to 4096 pixels wide and high, of 1, 2, 4, 8 or 16 samples");
    assert_false(stage_camera(1, 1, 1, 1, 1, 1, 45, 1, 2));
    assert_false(stage_camera(0, 0, 0, 1, 1, 1, (double)NAN, 1, 2));
    assert_false(stage_corner(3, 0, 0, 0, 0, 0, 0, 0, 0));
    assert_false(stage_triangle(STAGE_METHODS, 0, 0, 1));
    assert_false(stage_triangle(0, -1, 0, 1));
    stage_clear(0, 0, 0);
    for (int i = 0; i < STAGE_MAX_TRIANGLES; i++) {
        assert_true(stage_triangle(0, 0, 0, 1));
    }
    assert_false(stage_triangle(0, 0, 0, 1));
    assert_null(stage_explain(-1, 0));
    assert_null(stage_explain(0, SIZE));
    stage_close();
    assert_null(stage_draw());
    assert_false(stage_resize(4, 4, 1));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_numbers_follow_the_formulas),
    cmocka_unit_test(test_naive_is_what_the_screen_says),
    cmocka_unit_test(test_by_world),
    cmocka_unit_test(test_other_methods_have_no_point_of_the_world),
    cmocka_unit_test(test_pictures_show_what_they_say),
    cmocka_unit_test(test_columns),
    cmocka_unit_test(test_behind_the_eye),
    cmocka_unit_test(test_threads_and_samples),
    cmocka_unit_test(test_what_is_refused),
};

const struct unit_tests test_stage = UNIT_TESTS(tests, open_stage, close_stage);
