// SPDX-License-Identifier: MIT
// Lesson 11: the more samples along the long side, the nearer to the mean of the floor that a pixel sees.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "11_anisotropy.c"
#undef main

static float drawn[HEIGHT][PANELS * WIDTH][4];

static int draw_floats(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, PANELS * WIDTH, HEIGHT, 1);
    draw(context, target);
    must(rhw_texture_read(context, target, 0, drawn, 0), "read");
    rhw_context_destroy(context);
    return 0;
}

static void more_samples_see_more(void **state)
{
    (void)state;
    double error[PANELS] = {0};
    int count = 0;
    for (int p = 0; p < WIDTH * HEIGHT; p++) {
        double at[2], mean;
        const int x = p % WIDTH, y = p / WIDTH;
        if (!find_floor(x + 0.5, y + 0.5, at) || at[1] < 4 || at[1] > 24 || !find_mean(x, y, &mean)) {
            continue;
        }
        count++;
        for (int i = 0; i < PANELS; i++) {
            const double off = (double)drawn[y][i * WIDTH + x][0] - mean;
            error[i] += off * off;
        }
    }
    assert_true(count > 5000);
    assert_true(error[1] < error[0] / 2 && error[2] < error[1] / 2);
}

static void the_horizon_is_where_it_was_asked_for(void **state)
{
    (void)state;
    for (int p = 0; p < WIDTH * HEIGHT; p++) {
        double at[2];
        const int x = p % WIDTH, y = p / WIDTH;
        const bool ahead =
            find_floor(x + 0.5, y + 0.5, at) && at[1] > 0.31 && at[1] < 399 && fabs(at[0]) < 399;
        const bool floor = memcmp(drawn[y][x], sky, sizeof sky) != 0;
        if (at[1] == 0 || ahead) {
            assert_int_equal(floor, ahead);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(more_samples_see_more),
        cmocka_unit_test(the_horizon_is_where_it_was_asked_for),
    };
    return cmocka_run_group_tests(tests, draw_floats, NULL);
}
