// SPDX-License-Identifier: MIT
// Lesson 14: with targets that lose nothing, light in two passes is light at once, bit for bit; with the lesson's, each
// value is off by what its format may lose.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "14_deferred.c"
#undef main

static float deferred[SIZE * SIZE][4], forward[SIZE * SIZE][4];

static void draw_both(const enum rhw_format target_formats[TARGETS])
{
    rhw_context *context = picture_context();
    rhw_texture kept[TARGETS];
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, SIZE, SIZE, 1);
    draw(context, target_formats, target, kept);
    must(rhw_texture_read(context, target, 0, deferred, 0), "read");
    draw_world(context, shade_at_once, &target, 1);
    must(rhw_texture_read(context, target, 0, forward, 0), "read");
    rhw_context_destroy(context);
}

static void floats_lose_nothing(void **state)
{
    (void)state;
    const enum rhw_format exact[TARGETS] = {RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_RGBA32_FLOAT,
                                            RHW_FORMAT_RGBA32_FLOAT, RHW_FORMAT_R32_UINT};
    draw_both(exact);
    int seen = 0;
    for (int p = 0; p < SIZE * SIZE; p++) {
        if (forward[p][3] == 1) {
            assert_memory_equal(deferred[p], forward[p], sizeof forward[p]);
            seen++;
        } else {
            assert_true(deferred[p][0] == 0.01f);
        }
    }
    assert_true(seen > 50000);
}

static void small_targets_lose_a_little(void **state)
{
    (void)state;
    draw_both(formats);
    float most = 0, brightest = 0;
    for (int p = 0; p < SIZE * SIZE; p++) {
        for (int k = 0; k < 3 && forward[p][3] == 1; k++) {
            most = fmaxf(most, fabsf(deferred[p][k] - forward[p][k]));
            brightest = fmaxf(brightest, forward[p][k]);
        }
    }
    // A code of 8 bits is off by 1/510 of 1, and the least colour there is 0.25.
    assert_true(most > 0 && most < brightest * (1 / 510.0f / 0.25f + 0x1p-10f));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_lose_nothing),
        cmocka_unit_test(small_targets_lose_a_little),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
