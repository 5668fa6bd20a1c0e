// SPDX-License-Identifier: MIT
// Lesson 15: every pixel is what the formula gives in the order of its panel.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "15_order.c"
#undef main

static float drawn[PANEL][PANELS * PANEL][4];

static int draw_floats(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, PANELS * PANEL, PANEL, 1);
    draw(context, target, PANEL);
    must(rhw_texture_read(context, target, 0, drawn, 0), "read");
    rhw_context_destroy(context);
    return 0;
}

static bool covers(const struct pane *pane, double x, double y)
{
    const float *const r = pane->rectangle;
    return x > (double)r[0] && x < (double)r[2] && y > (double)r[1] && y < (double)r[3];
}

static void every_pixel_is_what_the_formula_gives(void **state)
{
    (void)state;
    int threefold = 0;
    for (int p = 0; p < PANEL * PANEL; p++) {
        const int column = p % PANEL, row = p / PANEL;
        const double x = (column + 0.5) * 2 / PANEL - 1, y = 1 - (row + 0.5) * 2 / PANEL;
        for (int panel = 0; panel < PANELS; panel++) {
            double color[3], nearest = 0.9;
            int count = 0;
            for (int k = 0; k < 3; k++) {
                color[k] = (double)board[x < 0 ? 0 : 1][k];
            }
            for (int i = 0; i < PANES; i++) {
                const struct pane *const pane = &panes[panel == 2 ? PANES - 1 - i : i];
                if (!covers(pane, x, y) || (panel == 1 && (double)pane->depth > nearest)) {
                    continue;
                }
                nearest = (double)pane->depth;
                count++;
                const double alpha = (double)pane->color[3];
                for (int k = 0; k < 3; k++) {
                    const double light = panel == 3 ? color[k] : 1;
                    color[k] = alpha * (double)pane->color[k] * light + (1 - alpha) * color[k];
                }
            }
            threefold += count == 3;
            for (int k = 0; k < 3; k++) {
                assert_true(fabs((double)drawn[row][panel * PANEL + column][k] - color[k]) < 1e-6);
            }
        }
    }
    assert_true(threefold > 3 * 4500);
}

static void order_matters_where_panes_overlap(void **state)
{
    (void)state;
    const float *const listed = drawn[PANEL / 2][PANEL / 2 + 4],
                       *const sorted = drawn[PANEL / 2][2 * PANEL + PANEL / 2 + 4];
    assert_true(sorted[0] > listed[0] + 0.3f); // the red pane is in front
    assert_true(sorted[2] < listed[2] - 0.2f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pixel_is_what_the_formula_gives),
        cmocka_unit_test(order_matters_where_panes_overlap),
    };
    return cmocka_run_group_tests(tests, draw_floats, NULL);
}
