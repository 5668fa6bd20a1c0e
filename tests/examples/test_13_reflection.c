// SPDX-License-Identifier: MIT
// Lesson 13: what the ball shows is what a ray out of its middle meets in the direction of reflection.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "13_reflection.c"
#undef main

static float drawn[SIZE][SIZE][4];

static int draw_floats(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, SIZE, SIZE, 1);
    draw(context, target);
    must(rhw_texture_read(context, target, 0, drawn, 0), "read");
    rhw_context_destroy(context);
    return 0;
}

// Where a ray meets a ball; below 0 where it does not.
static double meet_ball(const double from[3], const double direction[3], const float center[3], double radius)
{
    double to[3];
    for (int k = 0; k < 3; k++) {
        to[k] = (double)center[k] - from[k];
    }
    const double middle = lesson_dot(to, direction), square = lesson_dot(to, to) - middle * middle;
    return square < radius * radius ? middle - sqrt(radius * radius - square) : -1;
}

// The colour of the world in a direction, which has length 1. False far away, where fields are smaller than texels.
static bool find_world(const double from[3], const double direction[3], double color[3])
{
    double nearest = 1e30, normal[3] = {0, 1, 0}, at[3];
    float of[3] = {0.75f, 0.72f, 0.66f};
    bool is_ground = false;
    if (direction[1] < 0 && -from[1] / direction[1] < 250) {
        nearest = -from[1] / direction[1];
        is_ground = true;
    }
    for (int i = 0; i < BALLS; i++) {
        float center[3], ball_color[3];
        find_ball(i, center, ball_color);
        const double where = meet_ball(from, direction, center, (double)ball_radius);
        if (where > 0 && where < nearest) {
            nearest = where;
            is_ground = false;
            for (int k = 0; k < 3; k++) {
                normal[k] = (from[k] + where * direction[k] - (double)center[k]) / (double)ball_radius;
                of[k] = ball_color[k];
            }
        }
    }
    const double direct =
        fmax(normal[0] * (double)sun[0] + normal[1] * (double)sun[1] + normal[2] * (double)sun[2], 0);
    for (int k = 0; k < 3; k++) {
        at[k] = from[k] + nearest * direction[k];
    }
    const double field = (floor(at[0]) + floor(at[2])) * 0.5;
    const double shade = is_ground ? 1 - 1.2 * (field - floor(field)) : 1;
    for (int k = 0; k < 3; k++) {
        color[k] = nearest > 1e29
                       ? (double)sky[k]
                       : (double)of[k] * shade * (0.8 * direct + (double)sky[k] * (0.3 + 0.2 * normal[1]));
    }
    return nearest < 8 || nearest > 1e29;
}

// What a pixel of the ball must show; false where it shows something else.
static bool find_reflection(double column, double row, double color[3])
{
    const double from[3] = {(double)eye[0], (double)eye[1], (double)eye[2]},
                 middle[3] = {(double)mirror_center[0], (double)mirror_center[1], (double)mirror_center[2]};
    double direction[3], normal[3], away[3];
    lesson_ray(eye, target_point, zoom, SIZE, column, row, direction);
    const double where = meet_ball(from, direction, mirror_center, (double)mirror_radius);
    for (int i = 0; i < BALLS; i++) { // in front of it
        float center[3], ball_color[3];
        find_ball(i, center, ball_color);
        const double hidden = meet_ball(from, direction, center, (double)ball_radius * 1.1);
        if (hidden > 0 && hidden < where) {
            return false;
        }
    }
    for (int k = 0; k < 3; k++) {
        normal[k] = (from[k] + where * direction[k] - middle[k]) / (double)mirror_radius;
    }
    if (where < 0 || lesson_dot(normal, direction) > -0.3) { // not its rim, where the ball has corners
        return false;
    }
    for (int k = 0; k < 3; k++) {
        away[k] = direction[k] - 2 * lesson_dot(normal, direction) * normal[k];
    }
    const bool is_near = find_world(middle, away, color);
    for (int k = 0; k < 3; k++) {
        color[k] *= k == 0 ? 0.92 : k == 1 ? 0.94 : 0.96;
    }
    return is_near;
}

static void the_ball_shows_what_rays_meet(void **state)
{
    (void)state;
    int compared = 0, wrong = 0;
    for (int p = 0; p < SIZE * SIZE; p++) {
        const int x = p % SIZE, y = p / SIZE;
        double color[3], corner[3];
        if (!find_reflection(x + 0.5, y + 0.5, color)) {
            continue;
        }
        // Only where the world's colours hardly change: elsewhere texels and the ball's facets matter.
        bool is_even = true;
        for (int i = 0; i < 4; i++) {
            is_even = is_even && find_reflection(x + (i % 2 ? 2.5 : -1.5), y + (i / 2 ? 2.5 : -1.5), corner);
            for (int k = 0; k < 3 && is_even; k++) {
                is_even = fabs(corner[k] - color[k]) < 0.03;
            }
        }
        compared += is_even;
        for (int k = 0; k < 3 && is_even; k++) {
            if (fabs((double)drawn[y][x][k] - color[k]) > 0.03) {
                wrong++;
                break;
            }
        }
    }
    assert_true(compared > 8000);
    assert_true(wrong < compared / 200); // corners of fields between the points that were looked at
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_ball_shows_what_rays_meet)};
    return cmocka_run_group_tests(tests, draw_floats, NULL);
}
