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

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void scale_to_one(double v[3])
{
    const double length = sqrt(dot(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] /= length;
    }
}

// The direction from the eye through a pixel's centre.
static void find_ray(int column, int row, double direction[3])
{
    double ahead[3], right[3] = {0}, up[3];
    for (int k = 0; k < 3; k++) {
        ahead[k] = (double)target_point[k] - (double)eye[k];
    }
    scale_to_one(ahead);
    right[0] = -ahead[2], right[2] = ahead[0];
    scale_to_one(right);
    up[0] = right[1] * ahead[2], up[1] = right[2] * ahead[0] - right[0] * ahead[2],
    up[2] = -right[1] * ahead[0];
    up[0] -= right[2] * ahead[1], up[2] += right[0] * ahead[1];
    const double x = (2 * (column + 0.5) / SIZE - 1) / (double)zoom,
                 y = (1 - 2 * (row + 0.5) / SIZE) / (double)zoom;
    for (int k = 0; k < 3; k++) {
        direction[k] = ahead[k] + x * right[k] + y * up[k];
    }
    scale_to_one(direction);
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
        find_ray(p % SIZE, p / SIZE, direction);
        for (int k = 0; k < 3; k++) {
            to[k] = (double)point[k] * (k == 1 ? side : 1) - (double)eye[k];
        }
        scale_to_one(to);
        assert_true(dot(to, direction) > 1 - 1e-6); // corners are rounded to 1/256 pixel
        if (id <= THINGS) {
            const struct thing *const thing = &things[id - 1];
            assert_true(distance_to(thing, point) < 3e-3);
            double out[3] = {0}; // from its middle: balls are seen from outside
            for (int k = 0; k < 3 && thing->is_ball; k++) {
                out[k] = ((double)point[k] - (double)thing->center[k]) * (k == 1 ? side : 1);
            }
            assert_true(dot(out, direction) < 0.03);
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
        find_ray(p % SIZE, p / SIZE, direction);
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
