// SPDX-License-Identifier: MIT
// Lesson 10: the more samples, the nearer to the part that the rays cover; inside the disc they change nothing.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "10_samples.c"
#undef main

static float drawn[PANELS][PANEL * PANEL][4];
static double parts[PANEL * PANEL / 2];

static int draw_floats(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    for (int i = 0; i < PANELS; i++) {
        draw_panel(context, i, RHW_FORMAT_RGBA32_FLOAT, drawn[i]);
    }
    rhw_context_destroy(context);
    for (int p = 0; p < PANEL * PANEL / 2; p++) {
        parts[p] = coverage(p % PANEL, p / PANEL);
    }
    return 0;
}

static double red_part(const float pixel[4])
{
    return ((double)pixel[1] - (double)background[1]) / ((double)ray_color[1] - (double)background[1]);
}

static void more_samples_are_nearer(void **state)
{
    (void)state;
    double error[PANELS] = {0};
    for (int i = 0; i < PANELS; i++) {
        for (int p = 0; p < PANEL * PANEL / 2; p++) {
            const double part = red_part(drawn[i][p]);
            error[i] += (part - parts[p]) * (part - parts[p]);
            // Parts are whole numbers of samples.
            const double samples = panels[i].supersampled ? 16 : panels[i].samples;
            assert_true(fabs(part * samples - rint(part * samples)) < 1e-4);
        }
    }
    // An edge through n samples spread evenly is off by about 1/n of what it is off by one.
    assert_true(error[1] < error[0] / 4 && error[2] < error[1] / 4);
    assert_true(error[3] < error[0] / 16);
}

static void samples_leave_the_pattern_as_it_is(void **state)
{
    (void)state;
    int inside = 0, smoothed = 0;
    for (int p = 0; p < PANEL * PANEL; p++) {
        const double x = (p % PANEL + 0.5) * 2 / PANEL - 1 - (double)disc_center[0];
        const double y = 1 - (p / PANEL + 0.5) * 2 / PANEL - (double)disc_center[1];
        if (sqrt(x * x + y * y) < (double)disc_radius * 0.99 - 2.0 / PANEL) {
            inside++;
            assert_memory_equal(drawn[1][p], drawn[0][p], sizeof drawn[0][p]);
            assert_memory_equal(drawn[2][p], drawn[0][p], sizeof drawn[0][p]);
            smoothed += drawn[3][p][0] > 0.1f && drawn[3][p][0] < 0.6f; // between dark and light
        }
    }
    assert_true(inside > 800 && smoothed > inside / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(more_samples_are_nearer),
        cmocka_unit_test(samples_leave_the_pattern_as_it_is),
    };
    return cmocka_run_group_tests(tests, draw_floats, NULL);
}
