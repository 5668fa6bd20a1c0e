// SPDX-License-Identifier: MIT
// Lesson 1: the raster formula as it stands in the lesson, naive and correct colours, depth.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "01_triangle.c"
#undef main

static float drawn[SIZE][SIZE][4], depth_drawn[SIZE][SIZE];

static void draw_floats(enum rhw_qualifier qualifier, const struct rhw_program *functions)
{
    rhw_context *context = picture_context();
    const rhw_texture color = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, SIZE, SIZE, 1);
    const rhw_texture depth = picture_target(context, RHW_FORMAT_D32_FLOAT, SIZE, SIZE, 1);
    draw(context, functions, qualifier, color, depth);
    rhw_texture_read(context, color, 0, drawn, 0);
    rhw_texture_read(context, depth, 0, depth_drawn, 0);
    rhw_context_destroy(context);
}

// Column (1 + x/z)/2·512 and row (1 + y/z)/2·512, snapped; z is W; depth from 40 to 200.
static struct ref_triangle expected_triangle(void)
{
    static const double camera[3][3] = {{13, 34, 114}, {29, -15, 44}, {-48, -10, 82}};
    struct ref_triangle t;
    for (int i = 0; i < 3; i++) {
        const double *p = camera[i];
        t.x_8[i] = (int64_t)rint((1 + p[0] / p[2]) / 2 * 512 * 256);
        t.y_8[i] = (int64_t)rint((1 + p[1] / p[2]) / 2 * 512 * 256);
        t.w[i] = p[2];
        t.depth[i] = 1.25 * (1 - 40 / p[2]);
    }
    return t;
}

static void check_colors(const struct rhw_program *functions)
{
    static const double colors[3][3] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}; // blue, green, red
    const struct ref_triangle t = expected_triangle();
    for (int qualifier = RHW_SMOOTH; qualifier <= RHW_NOPERSPECTIVE; qualifier++) {
        draw_floats((enum rhw_qualifier)qualifier, functions);
        int count = 0;
        for (int i = 0; i < SIZE * SIZE; i++) {
            const int x = i % SIZE, y = i / SIZE;
            if (!lesson_covered(&t, x, y, drawn[y][x][3] == 1)) {
                continue;
            }
            count++;
            const struct ref_weights weights = lesson_weights(&t, x, y);
            const double *w = qualifier == RHW_SMOOTH ? weights.space : weights.screen;
            for (int c = 0; c < 3; c++) {
                const double truth = w[0] * colors[0][c] + w[1] * colors[1][c] + w[2] * colors[2][c];
                lesson_near("colour", x, y, drawn[y][x][c], truth, 1);
            }
        }
        assert_in_range(count, 15000, 30000);
    }
}

static void colors_by_lanes(void **state)
{
    (void)state;
    check_colors(&by_lanes);
}

static void colors_one_by_one(void **state)
{
    (void)state;
    check_colors(&one_by_one);
}

static void depth_is_linear_on_the_screen(void **state)
{
    (void)state;
    const struct ref_triangle t = expected_triangle();
    draw_floats(RHW_SMOOTH, &by_lanes);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const int x = i % SIZE, y = i / SIZE;
        if (drawn[y][x][3] == 1) {
            const struct ref_weights weights = lesson_weights(&t, x, y);
            lesson_near("depth", x, y, depth_drawn[y][x], ref_mix(weights.screen, t.depth), t.depth[0]);
        } else {
            assert_true(depth_drawn[y][x] == 1);
        }
    }
}

// The PPM says the same as the PNG's source: bytes of the 8-bit target, top row first.
static void ppm_holds_the_picture(void **state)
{
    (void)state;
    lesson_run(NULL);
    draw_floats(RHW_SMOOTH, &by_lanes);
    FILE *file = fopen("01_triangle.ppm", "rb");
    assert_non_null(file);
    int width = 0, height = 0, highest = 0;
    assert_int_equal(fscanf(file, "P6 %d %d %d", &width, &height, &highest), 3);
    assert_int_equal(fgetc(file), '\n');
    assert_true(width == SIZE && height == SIZE && highest == 255);
    for (int i = 0; i < SIZE * SIZE * 3; i++) {
        const float value = drawn[i / 3 / SIZE][i / 3 % SIZE][i % 3];
        lesson_close(fgetc(file), (double)value * 255, 0.50001); // the nearest byte
    }
    assert_int_equal(fgetc(file), EOF);
    fclose(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(colors_by_lanes),
        cmocka_unit_test(colors_one_by_one),
        cmocka_unit_test(depth_is_linear_on_the_screen),
        cmocka_unit_test(ppm_holds_the_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
