// SPDX-License-Identifier: MIT
// Lesson 8: the coordinates that the shader computes, and their derivatives by duals, against the iteration in double
// and its differences over a hundredth of a pixel; and that gradients by duals come nearer to many samples a pixel.
#include "lesson.h"

#define main lesson_main
#include "08_julia.c"
#undef main

struct exit_point {
    double u, v;
    int steps; ///< −1: never left
};

// What the shader computes for the point of the floor behind pixel coordinates x, y.
static struct exit_point leave(double x, double y)
{
    double clip[16], z[2];
    for (int i = 0; i < 16; i++) {
        clip[i] = (double)julia.clip[i];
    }
    // X − ndc_x W = 0 and Y − ndc_y W = 0 in the floor's two coordinates.
    const double ndc[2] = {2 * x / PANEL - 1, 1 - 2 * y / PANEL};
    double a[2][3];
    for (int r = 0; r < 2; r++) {
        a[r][0] = clip[r] - ndc[r] * clip[3];
        a[r][1] = clip[8 + r] - ndc[r] * clip[11];
        a[r][2] = clip[12 + r] - ndc[r] * clip[15];
    }
    const double area = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    z[0] = (a[0][1] * a[1][2] - a[1][1] * a[0][2]) / area;
    z[1] = (a[1][0] * a[0][2] - a[0][0] * a[1][2]) / area;
    for (int n = 0; n < julia.steps; n++) {
        const double real = z[0] * z[0] - z[1] * z[1] + (double)julia.c[0];
        z[1] = 2 * z[0] * z[1] + (double)julia.c[1];
        z[0] = real;
        const double square = z[0] * z[0] + z[1] * z[1];
        if (square > (double)julia.escape) {
            return (struct exit_point){atan2(z[1], z[0]) / 3.14159265358979323846,
                                       log2(log2(square)) - log2(log2((double)julia.escape)), n + 1};
        }
    }
    return (struct exit_point){.steps = -1};
}

// Whether the tile is the same all around the pixel: then u and v have derivatives here.
static bool smooth_around(double x, double y, double h, struct exit_point around[4])
{
    const struct exit_point middle = leave(x, y);
    static const double step[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    bool smooth = middle.steps > 0 && middle.steps <= 7;
    for (int i = 0; i < 4; i++) {
        around[i] = leave(x + h * step[i][0], y + h * step[i][1]);
        smooth &= around[i].steps == middle.steps && fabs(around[i].u - middle.u) < 0.5;
    }
    return smooth;
}

static void numbers(void **state)
{
    (void)state;
    static float drawn[PANEL][PANEL][4];
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, PANEL, PANEL, 1);
    draw(context, target, true, true);
    rhw_texture_read(context, target, 0, drawn, 0);
    rhw_context_destroy(context);
    const double h = 0.01;
    int compared = 0, never = 0;
    for (int i = 0; i < PANEL * PANEL; i++) {
        const double x = i % PANEL + 0.5, y = i / PANEL + 0.5;
        const float *number = drawn[i / PANEL][i % PANEL];
        struct exit_point around[4];
        if (y < PANEL / 4.0) {
            continue; // the floor ends somewhere up there
        }
        never += leave(x, y).steps < 0 && number[0] == -1 && number[1] == -1;
        if (!smooth_around(x, y, h, around)) {
            continue;
        }
        compared++;
        const struct exit_point middle = leave(x, y);
        const double du = (around[1].u - around[0].u) / (2 * h), dv = (around[3].v - around[2].v) / (2 * h);
        const double across[2] = {(around[3].u - around[2].u) / (2 * h),
                                  (around[1].v - around[0].v) / (2 * h)};
        const double reach = hypot(du, across[0]) + hypot(dv, across[1]);
        // Corners stand at multiples of 1/256 pixel.
        lesson_close((double)number[0], middle.u, 1e-4 + 0.02 * reach);
        lesson_close((double)number[1], middle.v, 1e-4 + 0.02 * reach);
        lesson_close((double)number[2], du, 0.01 * reach + 1e-5);
        lesson_close((double)number[3], dv, 0.01 * reach + 1e-5);
    }
    assert_in_range(compared, 60000, 110000);
    assert_in_range(never, 8000, 30000);
}

static void duals_come_nearer(void **state)
{
    (void)state;
    static float truth[PANEL][PANEL][4], naive[PANEL][PANEL][4], duals[PANEL][PANEL][4];
    rhw_context *context = picture_context();
    draw_values(context, true, true, truth);
    draw_values(context, false, false, naive);
    draw_values(context, true, false, duals);
    rhw_context_destroy(context);
    assert_true(difference(duals, truth) < 0.85 * difference(naive, truth));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers),
        cmocka_unit_test(duals_come_nearer),
        cmocka_unit_test(lesson_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
