// SPDX-License-Identifier: MIT
// Lesson 2: texture coordinates naive and correct, and the field they fall into.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "02_checkerboard.c"
#undef main

static float coordinates[ROWS][2 * COLUMNS][4], fields[ROWS][2 * COLUMNS][4];

static void show_st(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        groups[i].color[0][0] = groups[i].varying[0];
        groups[i].color[0][1] = groups[i].varying[1];
        groups[i].color[0][2] = rhw_splat(0);
        groups[i].color[0][3] = rhw_splat(1);
    }
}

static void draw_floats(rhw_fragment_function *fragment, void *pixels)
{
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, 2 * COLUMNS, ROWS, 1);
    draw(context, fragment, target, 1);
    rhw_texture_read(context, target, 0, pixels, 0);
    rhw_context_destroy(context);
}

// The triangle of lesson 1 in the left or the right half.
static struct ref_triangle expected_triangle(int half)
{
    static const float clip[3][4] = {{13, -34, 0, 114}, {29, 15, 0, 44}, {-48, 10, 0, 82}};
    const struct rhw_viewport viewport = panel_viewport(half, 1);
    return lesson_triangle(clip, &viewport);
}

static void expected_st(const struct ref_triangle *t, int half, int x, int y, double st[2])
{
    static const double s[3] = {0, 1, 0}, t_[3] = {1, 0, 0};
    const struct ref_weights weights = lesson_weights(t, x, y);
    st[0] = ref_mix(half == 0 ? weights.screen : weights.space, s);
    st[1] = ref_mix(half == 0 ? weights.screen : weights.space, t_);
}

static void texture_coordinates(void **state)
{
    (void)state;
    draw_floats(show_st, coordinates);
    for (int i = 0; i < 2 * COLUMNS * ROWS; i++) {
        const int x = i % (2 * COLUMNS), y = i / (2 * COLUMNS), half = x / COLUMNS;
        const struct ref_triangle t = expected_triangle(half);
        if (lesson_covered(&t, x, y, coordinates[y][x][3] == 1)) {
            double st[2];
            expected_st(&t, half, x, y, st);
            lesson_near("s", x, y, coordinates[y][x][0], st[0], 1);
            lesson_near("t", x, y, coordinates[y][x][1], st[1], 1);
        }
    }
}

// Light where (fmod(5·s, 1) < ½) = (fmod(5·t, 1) < ½), leaving out pixels that lie on a line between fields.
static void checkerboard(void **state)
{
    (void)state;
    draw_floats(checker, fields);
    int light_pixels[2] = {0}, dark_pixels[2] = {0};
    for (int i = 0; i < 2 * COLUMNS * ROWS; i++) {
        const int x = i % (2 * COLUMNS), y = i / (2 * COLUMNS), half = x / COLUMNS;
        const struct ref_triangle t = expected_triangle(half);
        if (fields[y][x][3] != 1) {
            continue;
        }
        double st[2];
        expected_st(&t, half, x, y, st);
        if (fabs(st[0] * 10 - rint(st[0] * 10)) < 1e-4 || fabs(st[1] * 10 - rint(st[1] * 10)) < 1e-4) {
            continue;
        }
        const bool light = (fmod(5 * st[0], 1) < 0.5) == (fmod(5 * st[1], 1) < 0.5);
        if (fields[y][x][0] != (light ? 0.90f : 0.04f)) {
            fail_msg("pixel %d, %d with s = %f, t = %f is not %s", x, y, st[0], st[1],
                     light ? "light" : "dark");
        }
        light_pixels[half] += light;
        dark_pixels[half] += !light;
    }
    for (int half = 0; half < 2; half++) {
        assert_in_range(light_pixels[half], 15000, 32000);
        assert_in_range(dark_pixels[half], 15000, 32000);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texture_coordinates),
        cmocka_unit_test(checkerboard),
        cmocka_unit_test(lesson_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
