// SPDX-License-Identifier: MIT
// Lesson 16: both smooth ways put as much ink into pixels as lines cover of them; one sample is far from it.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "16_lines.c"
#undef main

static float drawn[PANELS][PANEL * PANEL][4];
static double parts[PANEL * PANEL];

static int draw_floats(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    for (int i = 0; i < PANELS; i++) {
        draw_panel(context, i, RHW_FORMAT_RGBA32_FLOAT, drawn[i]);
    }
    for (int p = 0; p < PANEL * PANEL; p++) {
        parts[p] = coverage(p % PANEL, p / PANEL);
    }
    rhw_context_destroy(context);
    return 0;
}

static void smooth_lines_are_near(void **state)
{
    (void)state;
    double error[PANELS] = {0}, all[PANELS] = {0}, exact = 0;
    for (int p = 0; p < PANEL * PANEL; p++) {
        exact += parts[p];
        for (int i = 0; i < PANELS; i++) {
            const double part =
                ((double)paper[0] - (double)drawn[i][p][0]) / ((double)paper[0] - (double)ink[0]);
            assert_true(part > -1e-6 && part < 1 + 1e-6);
            error[i] += (part - parts[p]) * (part - parts[p]);
            all[i] += part;
        }
    }
    assert_true(error[1] < error[0] / 20 && error[2] < error[0] / 20);
    for (int i = 0; i < PANELS; i++) {
        assert_true(fabs(all[i] / exact - 1) < 0.02);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(smooth_lines_are_near)};
    return cmocka_run_group_tests(tests, draw_floats, NULL);
}
