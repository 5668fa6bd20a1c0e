// SPDX-License-Identifier: MIT
// Lesson 18: every face of the cube holds what rays from the lamp meet, and a point is in the light where a ray from it
// reaches the lamp.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "18_layers.c"
#undef main

static float *faces;
static float drawn[SIZE][SIZE][4];
static double at_lamp[3];

static int draw_floats(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        at_lamp[k] = (double)lamp[k];
    }
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, SIZE, SIZE, 1),
                      cube = make_cube(context);
    draw_faces(context, cube, solid_buffer(context), 0, FACES);
    faces = read_faces(context, cube);
    draw(context, show_light, target);
    must(rhw_texture_read(context, target, 0, drawn, 0), "read");
    rhw_context_destroy(context);
    return 0;
}

static int free_faces(void **state)
{
    (void)state;
    free(faces);
    return 0;
}

// How many `direction`s it is from `from` to a thing: nothing from within it, a large number where the ray passes it by.
static double meet_thing(const struct thing *thing, const double from[3], const double direction[3])
{
    double a = 0, b = 0, c = -1, near = -1e9, far = 1e9;
    for (int k = 0; k < 3; k++) {
        const double at = (from[k] - (double)thing->center[k]) / (double)thing->size[k];
        const double step = direction[k] / (double)thing->size[k];
        a += step * step, b += at * step, c += at * at;
        near = fmax(near, step != 0 ? (-copysign(1, step) - at) / step : fabs(at) < 1 ? -1e9 : 1e9);
        far = fmin(far, step != 0 ? (copysign(1, step) - at) / step : 1e9);
    }
    if (thing->is_ball) {
        const double root = sqrt(fmax(b * b - a * c, 0));
        near = root > 0 ? (-b - root) / a : 1e9;
        far = root > 0 ? (-b + root) / a : -1e9;
    }
    return near >= far || far < 0 ? 1e9 : fmax(near, 0);
}

// The first thing that a ray meets, −1 for none.
static int meet(const double from[3], const double direction[3], double *where)
{
    int met = -1;
    *where = 1e8;
    for (int i = 0; i < THINGS; i++) {
        const struct thing thing = find_thing(i);
        const double at = meet_thing(&thing, from, direction);
        if (at < *where) {
            *where = at;
            met = i;
        }
    }
    return met;
}

// The direction of a place on a face; its longest component is 1 (Vulkan 1.3, table 19).
static void find_direction(int face, double column, double row, double direction[3])
{
    const double s = 2 * column / FACE - 1, t = 2 * row / FACE - 1;
    const double directions[FACES][3] = {{1, -t, -s}, {-1, -t, s}, {s, 1, t},
                                         {s, -1, -t}, {s, -t, 1},  {-s, -t, -1}};
    memcpy(direction, directions[face], 3 * sizeof(double));
}

static void faces_hold_what_rays_meet(void **state)
{
    (void)state;
    enum { STEP = 5 };
    for (int face = 0; face < FACES; face++) {
        int compared = 0, things = 0;
        for (int y = 2; y < FACE; y += STEP) {
            for (int x = 2; x < FACE; x += STEP) {
                double direction[3], where, beside;
                find_direction(face, x + 0.5, y + 0.5, direction);
                const int met = meet(at_lamp, direction, &where);
                bool is_inside = true; // not where a thing ends, or its corners
                for (int k = 0; k < 4; k++) {
                    find_direction(face, x + (k % 2 ? 3.5 : -2.5), y + (k / 2 ? 3.5 : -2.5), direction);
                    is_inside = is_inside && meet(at_lamp, direction, &beside) == met &&
                                fabs(beside - where) < 0.05 * where;
                }
                if (!is_inside) {
                    continue;
                }
                const double expected = met < 0 ? 1 : 1 - (double)near_plane / where;
                assert_float_equal(faces[(face * FACE + y) * FACE + x], expected, 2e-4);
                compared++;
                things |= met < 0 ? 0 : 1 << met;
            }
        }
        assert_true(compared > 20000);
        assert_true((things & (things - 1)) != 0); // more than one of them
    }
}

// Whether rays from around a point to around the lamp are all free (1), none is (0), or some are (−1).
static int light_at(const double point[3], double reach)
{
    int free_rays = 0;
    for (int i = 0; i < 8; i++) {
        double from[3], to[3], where;
        for (int k = 0; k < 3; k++) {
            to[k] = at_lamp[k];
            from[k] = point[k] + ((i >> k & 1) ? reach : k == 1 ? 1e-3 : -reach); // not below the ground
            to[k] -= from[k];
        }
        free_rays += meet(from, to, &where) < 0 || where > 1;
    }
    return free_rays == 8 ? 1 : free_rays == 0 ? 0 : -1;
}

static void light_is_what_rays_say(void **state)
{
    (void)state;
    int counts[2] = {0, 0};
    for (int p = 0; p < SIZE * SIZE; p++) {
        const float *pixel = drawn[p / SIZE][p % SIZE];
        const double point[3] = {(double)pixel[1], (double)pixel[2], (double)pixel[3]};
        if (pixel[2] > 0 ||
            fmin(point[0], point[2]) < -2.95) { // the ground alone: elsewhere normals have a say
            continue;
        }
        const int expected = light_at(point, 0.03);
        if (expected >= 0) {
            counts[expected]++;
            assert_float_equal(pixel[0], expected, 0);
        }
    }
    assert_true(counts[0] > 3000 && counts[1] > 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(faces_hold_what_rays_meet),
                                       cmocka_unit_test(light_is_what_rays_say)};
    return cmocka_run_group_tests(tests, draw_floats, free_faces);
}
