// SPDX-License-Identifier: MIT
// Lesson 9: pixels that are clearly in shadow or in the light, found by rays, are so in all three ways; what lies
// between has the levels that each way can have.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "09_shadow_map.c"
#undef main

static float drawn[PANEL][3 * PANEL][4];

static int draw_floats(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, 3 * PANEL, PANEL, 1);
    draw(context, show_light, target, PANEL);
    must(rhw_texture_read(context, target, 0, drawn, 0), "read");
    rhw_context_destroy(context);
    return 0;
}

// The ray from the eye through a pixel's centre, as the matrix of the lesson has it.
static void find_ray(int column, int row, double eye[3], double direction[3])
{
    const double sine = 0.28f, cosine = 0.96f, zoom = 3.0f;
    const double x = (2 * (column + 0.5) / PANEL - 1) / zoom, y = (1 - 2 * (row + 0.5) / PANEL) / zoom;
    eye[0] = 0, eye[1] = 3.0f, eye[2] = 6.6f;
    direction[0] = x;
    direction[1] = -sine + y * cosine;
    direction[2] = -cosine - y * sine;
}

// The first thing that a ray meets: −1 the ground, else a sphere; −2 nothing. `slack`, the least distance in which it
// passes by the edge of a sphere, tells how sure that is.
static int meet(const double from[3], const double direction[3], double *where, double *slack)
{
    int met = -2;
    *where = 1e9;
    *slack = 1e9;
    if (direction[1] < 0) {
        *where = -from[1] / direction[1];
        met = -1;
    }
    for (int i = 0; i < SPHERES; i++) {
        const double to[3] = {(double)spheres[i].center[0] - from[0], (double)spheres[i].center[1] - from[1],
                              (double)spheres[i].center[2] - from[2]};
        const double length = sqrt(lesson_dot(direction, direction)),
                     middle = lesson_dot(to, direction) / (length * length);
        const double radius = (double)spheres[i].radius;
        const double square = lesson_dot(to, to) - middle * middle * length * length;
        *slack = fmin(*slack, fabs(sqrt(fmax(square, 0)) - radius));
        if (square < radius * radius && middle > 0) {
            const double at = middle - sqrt(radius * radius - square) / length;
            if (at > 0 && at < *where) {
                *where = at;
                met = i;
            }
        }
    }
    return met;
}

enum { UNKNOWN = -1 };

// 1 where the light arrives, 0 where it does not, UNKNOWN near the edges of shadows and of things.
static int light_at(const double point[3], int thing)
{
    // Two texels and a half of the map, as the lesson's filter reaches, and what the bias may take.
    const double margin = 2.5 * 2 * (double)map_radius / MAP + 0.06;
    const double towards[3] = {(double)sun[0], (double)sun[1], (double)sun[2]};
    bool shaded = false;
    for (int i = 0; i < SPHERES; i++) {
        const double to[3] = {(double)spheres[i].center[0] - point[0],
                              (double)spheres[i].center[1] - point[1],
                              (double)spheres[i].center[2] - point[2]};
        const double ahead = lesson_dot(to, towards), by = sqrt(fmax(lesson_dot(to, to) - ahead * ahead, 0));
        const double radius = (double)spheres[i].radius;
        if (i == thing) {
            if (-ahead < 0.5 * radius) { // the sun stands low there
                return UNKNOWN;
            }
        } else if (ahead > -radius && by < radius + margin) {
            if (by > radius - margin || ahead < radius) {
                return UNKNOWN;
            }
            shaded = true;
        }
    }
    return shaded ? 0 : 1;
}

static void light_is_what_rays_say(void **state)
{
    (void)state;
    int counts[2] = {0, 0};
    for (int i = 0; i < PANEL * PANEL; i++) {
        const int x = i % PANEL, y = i / PANEL;
        double eye[3], direction[3], where, slack, point[3];
        find_ray(x, y, eye, direction);
        const int thing = meet(eye, direction, &where, &slack);
        if (thing == -2 || slack < 0.03 || where > 12) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            point[k] = eye[k] + where * direction[k];
        }
        const int expected = light_at(point, thing);
        if (expected == UNKNOWN) {
            continue;
        }
        counts[expected]++;
        for (int way = 0; way < 3; way++) {
            assert_true(drawn[y][way * PANEL + x][3] == 1);
            if (drawn[y][way * PANEL + x][0] != (float)expected) {
                fail_msg("way %d, pixel %d, %d of thing %d: %g and not %d", way, x, y, thing,
                         (double)drawn[y][way * PANEL + x][0], expected);
            }
        }
    }
    assert_in_range(counts[0], 1000, 20000);
    assert_in_range(counts[1], 20000, 80000);
}

// One texel knows 0 and 1; one footprint has weights of two fractions; the mean of nine is finer still, and its edges
// are wider.
static void edges_have_their_levels(void **state)
{
    (void)state;
    int between[3] = {0, 0, 0};
    for (int i = 0; i < 3 * PANEL * PANEL; i++) {
        const int way = i % (3 * PANEL) / PANEL;
        const float *p = drawn[i / (3 * PANEL)][i % (3 * PANEL)];
        assert_true(p[3] == 0 || (p[0] >= 0 && p[0] <= 1));
        between[way] += p[3] == 1 && p[1] > 0 && p[0] > 0 && p[0] < 1;
    }
    assert_int_equal(between[0], 0);
    assert_true(between[1] > 500 && between[2] > 2 * between[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_is_what_rays_say),
        cmocka_unit_test(edges_have_their_levels),
        cmocka_unit_test(lesson_run),
    };
    return cmocka_run_group_tests(tests, draw_floats, NULL);
}
