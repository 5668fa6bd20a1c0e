// SPDX-License-Identifier: MIT
// Lesson 12: every point lies on the ray through its pixel, straight or by way of the mirror, on what it belongs to; and
// nothing mirrored is seen beside the mirror, or where the mirror is hidden.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "12_mirror.c"
#undef main

static float points[SIZE * SIZE][4];

static int draw_points(void **state)
{
    (void)state;
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, SIZE, SIZE, 1);
    draw(context, show_point, target);
    must(rhw_texture_read(context, target, 0, points, 0), "read");
    rhw_context_destroy(context);
    return 0;
}

// How far the point is from the surface of a thing.
static double distance_to(const struct thing *thing, const float point[3])
{
    double most = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        const double at = ((double)point[k] - (double)thing->center[k]) / (double)thing->size[k];
        most = fmax(most, fabs(at));
        square += at * at;
    }
    return thing->is_ball ? fabs(sqrt(square) - 1) : fabs(most - 1);
}

static void points_lie_on_their_rays(void **state)
{
    (void)state;
    int mirrored = 0;
    for (int p = 0; p < SIZE * SIZE; p++) {
        const float *const point = points[p];
        const int id = (int)fabsf(point[3]), side = point[3] < 0 ? -1 : 1;
        if (id == 0) {
            continue;
        }
        double direction[3], to[3];
        lesson_ray(eye, target_point, zoom, SIZE, p % SIZE + 0.5, p / SIZE + 0.5, direction);
        for (int k = 0; k < 3; k++) {
            to[k] = (double)point[k] * (k == 1 ? side : 1) - (double)eye[k];
        }
        assert_true(lesson_dot(to, direction) >
                    (1 - 1e-6) * sqrt(lesson_dot(to, to))); // corners are rounded to 1/256 pixel
        if (id <= THINGS) {
            const struct thing *const thing = &things[id - 1];
            assert_true(distance_to(thing, point) < 3e-3);
            double out[3] = {0}; // from its middle: balls are seen from outside
            for (int k = 0; k < 3 && thing->is_ball; k++) {
                out[k] = ((double)point[k] - (double)thing->center[k]) * (k == 1 ? side : 1);
            }
            assert_true(lesson_dot(out, direction) < 0.03);
        }
        mirrored += side < 0;
    }
    assert_true(mirrored > 5000);
}

static void the_mirror_ends_at_its_edges(void **state)
{
    (void)state;
    for (int p = 0; p < SIZE * SIZE; p++) {
        double direction[3];
        lesson_ray(eye, target_point, zoom, SIZE, p % SIZE + 0.5, p / SIZE + 0.5, direction);
        const double ahead = -(double)eye[1] / direction[1]; // to the ground
        const double x = (double)eye[0] + ahead * direction[0], z = (double)eye[2] + ahead * direction[2];
        const double inside = fmin(fmin(x - (double)quads[0][0], (double)quads[0][2] - x),
                                   fmin(z - (double)quads[0][1], (double)quads[0][3] - z));
        if (points[p][3] < 0) { // seen in the mirror
            assert_true(direction[1] < 0 && inside > -1e-3);
        } else if (points[p][3] > THINGS) { // the ground around it
            assert_true(direction[1] < 0 && inside < 1e-3);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_lie_on_their_rays),
        cmocka_unit_test(the_mirror_ends_at_its_edges),
    };
    return cmocka_run_group_tests(tests, draw_points, NULL);
}
