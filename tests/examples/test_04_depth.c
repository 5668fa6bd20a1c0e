// SPDX-License-Identifier: MIT
// Lesson 4: 1/w and z/w against the formulas and against a straight line, w against both.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "04_depth.c"
#undef main

static struct sample samples[ROWS][COLUMNS];
static float weights[ROWS][COLUMNS][4];

static int measure_all(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    measure_plane(context, samples[0], weights[0]);
    rhw_context_destroy(context);
    return 0;
}

static void formulas(void **state)
{
    (void)state;
    const struct rhw_viewport viewport = {0, 0, COLUMNS, ROWS, 0, 1};
    struct ref_triangle halves[2];
    for (int i = 0; i < 2; i++) {
        float clip[3][4];
        for (int k = 0; k < 12; k++) {
            clip[k / 4][k % 4] = plane[i * 3 + k / 4].clip[k % 4];
        }
        halves[i] = lesson_triangle((const float(*)[4])clip, &viewport);
    }
    for (int i = 0; i < COLUMNS * ROWS; i++) {
        const int x = i % COLUMNS, y = i / COLUMNS;
        const struct sample *sample = &samples[y][x];
        for (int half = 0; half < 2; half++) {
            const struct ref_triangle *t = &halves[half];
            if (!lesson_covered(t, x, y, sample->covered == 1 && sample->primitive == (float)half)) {
                continue;
            }
            const struct ref_weights truth = lesson_weights(t, x, y);
            lesson_near("1/w", x, y, sample->over_w, 1 / truth.w, 1);
            lesson_near("z/w", x, y, sample->depth, ref_mix(truth.screen, t->depth), 1);
            for (int k = 0; k < 3; k++) {
                lesson_near("weight on the screen", x, y, weights[y][x][k], truth.screen[k], 1);
            }
        }
    }
}

// How far values stray from the straight line through the first and the last.
static double bend(const double values[COLUMNS])
{
    double largest = 0;
    for (int x = 0; x < COLUMNS; x++) {
        const double line = values[0] + (values[COLUMNS - 1] - values[0]) * x / (COLUMNS - 1);
        largest = fmax(largest, fabs(values[x] - line));
    }
    return largest;
}

static void straight_and_bent(void **state)
{
    (void)state;
    static double over_w[COLUMNS], depth[COLUMNS], w[COLUMNS];
    for (int x = 0; x < COLUMNS; x++) {
        assert_true(samples[ROW][x].covered == 1);
        over_w[x] = (double)samples[ROW][x].over_w;
        depth[x] = (double)samples[ROW][x].depth;
        w[x] = 1 / over_w[x];
    }
    assert_true(bend(over_w) < 1e-6);
    assert_true(bend(depth) < 1e-6);
    // W of a line from 1 to 8 strays most where (8 − 1)·r − 1/(1 − 7/8·r) + 1 is largest: by 3.34.
    lesson_close(bend(w), 3.34, 0.05);
}

static void reciprocal_form(void **state)
{
    (void)state;
    const struct sample *sample = &samples[ROW][COLUMN];
    const struct corner *corner = &plane[(int)sample->primitive * 3];
    double over_w = 0;
    for (int k = 0; k < 3; k++) {
        over_w += (double)weights[ROW][COLUMN][k] / (double)corner[k].clip[3];
    }
    lesson_near("1/W = r/W_A + s/W_B + t/W_C", COLUMN, ROW, sample->over_w, over_w, 1);
    // The plane's W depends on the column alone: x runs from −1 to 1 while 1/W runs from 1 to 1/8.
    lesson_near("1/W", COLUMN, ROW, sample->over_w, 1 - 0.875 * (COLUMN + 0.5) / COLUMNS, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(formulas),
        cmocka_unit_test(straight_and_bent),
        cmocka_unit_test(reciprocal_form),
        cmocka_unit_test(lesson_run),
    };
    return cmocka_run_group_tests(tests, measure_all, NULL);
}
