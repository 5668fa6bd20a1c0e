// SPDX-License-Identifier: MIT
// The families of triangles hold what their names promise, and a scene depends on (family, seed, index) alone.
// A family that stopped to reach its extreme would make the table of docs/exactness.md say less than it claims.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "oracle.h"
#include "scene.h"

enum { SEED = 1, SCENES = 2000 };
// Sides of the view: near, far, and the four of the guard band.
enum { NEAR, FAR, LEFT, RIGHT, TOP, BOTTOM, SIDES };

static const double guard_pixels = 32768;

static struct scene scene, again;

static const float *position_of(int triangle, int corner)
{
    return scene.vertex[scene.triangle[triangle][corner]].position;
}

// Pixels of the target; W > 0.
static void on_screen(const float p[4], double xy[2])
{
    const struct oracle_view *const v = &scene.view;
    const double w = (double)p[3];
    xy[0] = (double)v->x + (double)v->width / 2 * (1 + (double)p[0] / w);
    xy[1] = (double)v->y + (double)v->height / 2 * (1 - (double)p[1] / w);
}

// Which sides a vertex with W > 0 lies beyond, as bits.
static int beyond(const float p[4])
{
    double xy[2];
    on_screen(p, xy);
    const bool near = scene.view.minus_one_to_one ? p[2] < -p[3] : p[2] < 0;
    return near << NEAR | (p[2] > p[3]) << FAR | (xy[0] < -guard_pixels) << LEFT |
           (xy[0] > guard_pixels) << RIGHT | (xy[1] < -guard_pixels) << TOP |
           (xy[1] > guard_pixels) << BOTTOM;
}

static int sides_crossed(int triangle)
{
    int any = 0, all = (1 << SIDES) - 1;
    for (int i = 0; i < 3; i++) {
        const float *const p = position_of(triangle, i);
        if (!(p[3] > 0)) {
            return 0;
        }
        any |= beyond(p);
        all &= beyond(p);
    }
    return any & ~all;
}

static int bits_of(int set)
{
    int count = 0;
    for (; set != 0; set &= set - 1) {
        count++;
    }
    return count;
}

static void test_each_side_is_crossed_alone_and_with_others(void **state)
{
    (void)state;
    int alone[SIDES] = {0}, pairs[SIDES][SIDES] = {{0}}, three = 0;
    static const enum family families[] = {FAMILY_NEAR_FAR, FAMILY_GUARD_BAND, FAMILY_EVERYTHING};
    for (int f = 0; f < 3; f++) {
        for (uint64_t index = 0; index < SCENES; index++) {
            scene_make(&scene, families[f], SEED, index);
            const int sides = sides_crossed(0);
            three += bits_of(sides) >= 3;
            for (int a = 0; a < SIDES; a++) {
                alone[a] += sides == 1 << a;
                for (int b = 0; b < a; b++) {
                    pairs[a][b] += (sides >> a & sides >> b & 1) != 0;
                }
            }
        }
    }
    for (int a = 0; a < SIDES; a++) {
        assert_true(alone[a] >= 10);
        for (int b = 0; b < a; b++) {
            assert_true(pairs[a][b] >= 10);
        }
    }
    assert_true(three >= 10);
}

static void test_w_reaches_its_extremes(void **state)
{
    (void)state;
    double least = INFINITY, most = 0;
    int zero = 0, negative = 0;
    for (uint64_t index = 0; index < SCENES; index++) {
        scene_make(&scene, FAMILY_PERSPECTIVE, SEED, index);
        double low = INFINITY, high = 0;
        for (int i = 0; i < 3; i++) {
            low = fmin(low, (double)position_of(0, i)[3]);
            high = fmax(high, (double)position_of(0, i)[3]);
        }
        least = fmin(least, high / low);
        most = fmax(most, high / low);
        scene_make(&scene, FAMILY_BEHIND, SEED, index);
        for (int i = 0; i < 3; i++) {
            zero += position_of(0, i)[3] == 0;
            negative += position_of(0, i)[3] < 0;
        }
    }
    assert_true(least < 1.05 && most > 9e5 && most < 1.02e6);
    assert_true(zero >= 100 && negative >= 1000);
}

// Shorter and longer side of the box around a triangle, in pixels.
static void extent(int triangle, double *shorter, double *longer)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < 3; i++) {
        double xy[2];
        on_screen(position_of(triangle, i), xy);
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], xy[k]);
            high[k] = fmax(high[k], xy[k]);
        }
    }
    *shorter = fmin(high[0] - low[0], high[1] - low[1]);
    *longer = fmax(high[0] - low[0], high[1] - low[1]);
}

// Twice the area over the longest edge, in pixels.
static double thickness(int triangle)
{
    double p[3][2], longest = 0;
    for (int i = 0; i < 3; i++) {
        on_screen(position_of(triangle, i), p[i]);
    }
    for (int i = 0; i < 3; i++) {
        longest = fmax(longest, hypot(p[i][0] - p[(i + 1) % 3][0], p[i][1] - p[(i + 1) % 3][1]));
    }
    return fabs((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[2][0] - p[0][0]) * (p[1][1] - p[0][1])) /
           longest;
}

static void test_sizes_reach_their_extremes(void **state)
{
    (void)state;
    double largest = 0, longest_sliver = 0, shorter, longer;
    int micro = 0;
    for (uint64_t index = 0; index < SCENES; index++) {
        scene_make(&scene, FAMILY_LARGE, SEED, index);
        extent(0, &shorter, &longer);
        largest = fmax(largest, shorter);
        assert_true(longer > 64);
        scene_make(&scene, FAMILY_SLIVER, SEED, index);
        for (int t = 0; t < scene.triangle_count && index % 20 == 0; t++) {
            extent(t, &shorter, &longer);
            longest_sliver = fmax(longest_sliver, longer);
            assert_true(thickness(t) < 0.1);
        }
        scene_make(&scene, FAMILY_MICRO, SEED, index % 20);
        for (int t = 0; t < scene.triangle_count && index < 20; t++, micro++) {
            extent(t, &shorter, &longer);
            assert_true(longer < 2.01);
        }
    }
    assert_true(largest > 16384 && longest_sliver > 16384 && micro > 1000);
}

// The smallest and the largest magnitude of component k, and whether both signs occur.
static void test_values_are_of_their_kind(void **state)
{
    (void)state;
    int mixed[VALUE_KINDS] = {0}, seen[VALUE_KINDS] = {0};
    for (uint64_t index = 0; index < SCENES; index++) {
        scene_make(&scene, FAMILY_ORDINARY, SEED, index);
        for (int k = 0; k < SCENE_VALUES; k++) {
            double low = INFINITY, high = -INFINITY, magnitude = 0;
            for (int i = 0; i < 3; i++) {
                const double v = (double)scene.vertex[scene.triangle[0][i]].value[k];
                low = fmin(low, v);
                high = fmax(high, v);
                magnitude = fmax(magnitude, fabs(v));
            }
            seen[scene.kind[k]]++;
            mixed[scene.kind[k]] += low < 0 && high > 0;
            switch (scene.kind[k]) {
            case VALUE_OFFSET: assert_true(low >= 1e6 && high <= 1e6 + 16); break;
            case VALUE_DENORMAL: assert_true(magnitude < 0x1p-126 && magnitude > 0); break;
            case VALUE_CONSTANT: assert_true(low == high); break;
            default: break;
            }
        }
    }
    for (int kind = 0; kind < VALUE_KINDS; kind++) {
        assert_true(seen[kind] > 100);
    }
    assert_true(mixed[VALUE_SIGNED] > 100 && mixed[VALUE_OPPOSITE] > 100 && mixed[VALUE_DENORMAL] > 100);
}

// Not byte for byte: a structure's padding is whatever the compiler left there.
static bool same_view(const struct oracle_view *a, const struct oracle_view *b)
{
    return a->target_width == b->target_width && a->target_height == b->target_height && a->x == b->x &&
           a->y == b->y && a->width == b->width && a->height == b->height && a->depth_min == b->depth_min &&
           a->depth_max == b->depth_max && a->minus_one_to_one == b->minus_one_to_one;
}

static void test_a_scene_is_its_family_seed_and_index(void **state)
{
    (void)state;
    for (int family = 0; family < FAMILY_COUNT; family++) {
        assert_int_equal(scene_family_named(scene_family_name((enum family)family)), family);
        for (uint64_t index = 0; index < 20; index++) {
            memset(&scene, 0, sizeof scene);
            memset(&again, 0xff, sizeof again);
            scene_make(&again, (enum family)((family + 1) % FAMILY_COUNT), SEED, index + 1);
            scene_make(&again, (enum family)family, SEED, index);
            scene_make(&scene, (enum family)family, SEED, index);
            assert_int_equal(scene.vertex_count, again.vertex_count);
            assert_int_equal(scene.triangle_count, again.triangle_count);
            assert_memory_equal(scene.vertex, again.vertex,
                                (size_t)scene.vertex_count * sizeof *scene.vertex);
            assert_memory_equal(scene.triangle, again.triangle,
                                (size_t)scene.triangle_count * sizeof *scene.triangle);
            assert_true(same_view(&scene.view, &again.view));
            scene_make(&again, (enum family)family, SEED + 1, index);
            assert_true(memcmp(scene.vertex, again.vertex, sizeof *scene.vertex) != 0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_side_is_crossed_alone_and_with_others),
        cmocka_unit_test(test_w_reaches_its_extremes),
        cmocka_unit_test(test_sizes_reach_their_extremes),
        cmocka_unit_test(test_values_are_of_their_kind),
        cmocka_unit_test(test_a_scene_is_its_family_seed_and_index),
    };
    return cmocka_run_group_tests_name("families", tests, NULL, NULL);
}
