// SPDX-License-Identifier: MIT
// How coarse the window's pictures get of what moves: fast enough where fewer pixels gain that, and no coarser than gains.
#include "coarseness.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { FRAMES = 40, SETTLED = 20 };

// What a picture takes, in ms: the triangles, once more for shadows; and the pixels, four samples each in full.
struct cost {
    double triangles, shadows, pixels;
};

static double ms_of(const struct cost *cost, int level)
{
    const struct view_coarse_look look = view_coarseness_look(level);
    const double pixels = cost->pixels / (look.divisor * look.divisor) * (look.one_sample ? 1.0 : 4.0);
    return cost->triangles + pixels + (look.plain ? 0.0 : cost->shadows);
}

// Draws one picture at rest and others in a hurry. All but the first of them have to be of the level that it settles on, or of
// one that is finer and was tried once. Returns the level.
static int settle(struct view_coarseness *c, const struct cost *cost)
{
    view_coarseness_learn(c, 0, false, ms_of(cost, 0));
    int settled = -1;
    for (int i = 0; i < FRAMES; i++) {
        const int level = c->level;
        assert_in_range(level, 0, VIEW_COARSENESS_LEVELS - 1);
        if (i >= SETTLED) {
            assert_true(settled < 0 || settled == level);
            settled = level;
        }
        view_coarseness_learn(c, level, true, ms_of(cost, level));
    }
    return settled;
}

static void test_a_first_picture_is_coarse(void **state)
{
    (void)state;
    const struct view_coarse_look look = view_coarseness_look(view_coarseness_start().level);
    assert_true(look.divisor > 1 && look.one_sample && look.plain);
    const struct view_coarse_look full = view_coarseness_look(0);
    assert_true(full.divisor == 1 && !full.one_sample && !full.plain);
}

static void test_what_is_fast_is_drawn_in_full(void **state)
{
    (void)state;
    struct view_coarseness c = view_coarseness_start();
    assert_int_equal(settle(&c, &(struct cost){2.0, 2.0, 5.0}), 0);
}

static void test_pixels_get_fewer_until_it_is_fast(void **state)
{
    (void)state;
    for (double pixels = 20.0; pixels < 2000.0; pixels *= 1.7) {
        const struct cost cost = {2.0, 1.0, pixels};
        struct view_coarseness c = view_coarseness_start();
        const int level = settle(&c, &cost);
        assert_true(ms_of(&cost, level) <= 50.0);
        assert_true(level == 0 || ms_of(&cost, level - 1) > 12.0);
    }
}

// The size of the picture stays where the triangles take the time.
static void test_triangles_do_not_get_fewer_with_the_pixels(void **state)
{
    (void)state;
    for (double triangles = 80.0; triangles < 1000.0; triangles *= 1.7) {
        struct view_coarseness c = view_coarseness_start();
        assert_int_equal(view_coarseness_look(settle(&c, &(struct cost){triangles, 0.0, 8.0})).divisor, 1);
        struct view_coarseness shadowed = view_coarseness_start();
        const struct view_coarse_look look =
            view_coarseness_look(settle(&shadowed, &(struct cost){triangles, triangles, 8.0}));
        assert_true(look.divisor == 1 && look.plain); // its shadows take as long again
    }
}

// Nearer to it the pixels take the time, and farther away it is fast.
static void test_another_view_is_learnt_anew(void **state)
{
    (void)state;
    struct view_coarseness c = view_coarseness_start();
    assert_int_equal(view_coarseness_look(settle(&c, &(struct cost){100.0, 0.0, 8.0})).divisor, 1);
    const struct cost near = {10.0, 0.0, 600.0};
    assert_true(ms_of(&near, settle(&c, &near)) <= 50.0);
    assert_int_equal(settle(&c, &(struct cost){2.0, 2.0, 4.0}), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_first_picture_is_coarse),
        cmocka_unit_test(test_what_is_fast_is_drawn_in_full),
        cmocka_unit_test(test_pixels_get_fewer_until_it_is_fast),
        cmocka_unit_test(test_triangles_do_not_get_fewer_with_the_pixels),
        cmocka_unit_test(test_another_view_is_learnt_anew),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
