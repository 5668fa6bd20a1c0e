// SPDX-License-Identifier: MIT
// Lesson 7: each qualifier's formula at every pixel.
#include "lesson.h"

#define main lesson_main
#include "07_qualifiers.c"
#undef main

static float drawn[PANEL][3 * PANEL][4];

static int draw_floats(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, 3 * PANEL, PANEL, 1);
    draw(context, show_values, target, PANEL);
    rhw_texture_read(context, target, 0, drawn, 0);
    rhw_context_destroy(context);
    return 0;
}

// Of value `component`: the three vertices, red, green, blue, distance.
static double expected(const struct ref_weights *weights, int panel, int component)
{
    static const float values[3][4] = {
        {0.90f, 0.16f, 0.06f, 0}, {0.95f, 0.70f, 0.08f, 0}, {0.05f, 0.22f, 0.80f, 1}};
    const double corner[3] = {(double)values[0][component], (double)values[1][component],
                              (double)values[2][component]};
    if (panel == 2) {
        return corner[0];
    }
    return ref_mix(panel == 0 ? weights->space : weights->screen, corner);
}

static void check_panel(int panel)
{
    static const float clip[3][4] = {{-0.90f, -0.80f, 0, 1}, {0.90f, -0.80f, 0, 1}, {0.60f, 5.10f, 5, 6}};
    const struct rhw_viewport viewport = {(float)(panel * PANEL), 0, PANEL, PANEL, 0, 1};
    const struct ref_triangle t = lesson_triangle(clip, &viewport);
    int count = 0;
    for (int i = 0; i < PANEL * PANEL; i++) {
        const int x = panel * PANEL + i % PANEL, y = i / PANEL;
        const float *value = drawn[y][x];
        const bool background = value[0] == 0.80f && value[1] == 0.82f && value[2] == 0.84f && value[3] == 0;
        if (!lesson_covered(&t, x, y, !background)) {
            continue;
        }
        count++;
        const struct ref_weights weights = lesson_weights(&t, x, y);
        for (int c = 0; c < 4; c++) {
            const double truth = expected(&weights, panel, c);
            if (panel == 2) {
                assert_true((double)value[c] == truth);
            } else {
                lesson_near("value", x, y, value[c], truth, c == 3 ? 1 : 0.8);
            }
        }
    }
    assert_in_range(count, 15000, 60000);
}

static void smooth(void **state)
{
    (void)state;
    check_panel(0);
}

static void noperspective(void **state)
{
    (void)state;
    check_panel(1);
}

static void flat(void **state)
{
    (void)state;
    check_panel(2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(smooth),
        cmocka_unit_test(noperspective),
        cmocka_unit_test(flat),
        cmocka_unit_test(lesson_run),
    };
    return cmocka_run_group_tests(tests, draw_floats, NULL);
}
