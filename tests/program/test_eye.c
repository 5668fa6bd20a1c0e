// SPDX-License-Identifier: MIT
// How the mouse and the keys of the window move its camera, with perspective and without.
#include "eye.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static const double vertical[3] = {0, 1, 0};

// A box of 4×2×2 around the origin; nothing but its bounds is looked at.
static const struct scene_model box = {.bounds_min = {-2, -1, -1}, .bounds_max = {2, 1, 1}};

static struct view_eye see(bool orthographic, double distance)
{
    const struct scene_camera camera = {
        .eye = {0, 0, distance}, .up = {0, 1, 0}, .orthographic = orthographic, .yfov = 0.5, .ymag = 1.5};
    struct view_eye eye;
    view_eye_set(&eye, &camera, &box);
    return eye;
}

static void assert_close(double a, double b)
{
    assert_true(fabs(a - b) <= 1e-7 * (1.0 + fabs(b)));
}

static double distance_of(const struct view_eye *eye)
{
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
        square += (eye->eye[c] - eye->target[c]) * (eye->eye[c] - eye->target[c]);
    }
    return sqrt(square);
}

// Where a point is seen: right of and above the middle, in half heights of the picture.
static void project(const struct view_eye *eye, const double point[3], double seen[2])
{
    struct scene_camera camera = {.orthographic = eye->orthographic,
                                  .yfov = eye->fovy * (3.14159265358979323846 / 180.0),
                                  .ymag = 0.5 * eye->height,
                                  .znear = 0.01,
                                  .zfar = 100.0};
    double view[16], projection[16], all[16], clip[4];
    memcpy(camera.eye, eye->eye, sizeof camera.eye);
    memcpy(camera.target, eye->target, sizeof camera.target);
    memcpy(camera.up, eye->up, sizeof camera.up);
    scene_camera_view(&camera, view);
    scene_camera_projection(&camera, 1.0, projection);
    scene_matrix_multiply(projection, view, all);
    for (int r = 0; r < 4; r++) {
        clip[r] = all[r] * point[0] + all[4 + r] * point[1] + all[8 + r] * point[2] + all[12 + r];
    }
    seen[0] = clip[0] / clip[3];
    seen[1] = clip[1] / clip[3];
}

static void test_a_lens_stays_what_it_is(void **state)
{
    (void)state;
    double numbers[10];
    struct view_eye eye = see(true, 5.0);
    assert_true(eye.orthographic);
    view_eye_numbers(&eye, numbers);
    assert_close(numbers[9], 3.0);
    assert_close(eye.target[2], 0.0);
    assert_true(distance_of(&eye) > sqrt(24.0) / 2.0); // nothing comes to lie behind it when it turns
    eye = see(true, 0.5);                              // an eye within the model stays there
    assert_close(eye.eye[2], 0.5);
    eye = see(false, 5.0);
    assert_false(eye.orthographic);
    view_eye_numbers(&eye, numbers);
    assert_close(numbers[9], 0.5 * 180.0 / 3.14159265358979323846);
    assert_close(eye.eye[2], 5.0);
}

static void test_zoom_keeps_what_is_under_the_pointer(void **state)
{
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        struct view_eye eye = see(orthographic, 5.0);
        const double before = view_eye_scale(&eye), distance = distance_of(&eye);
        // The point of the target's plane that is seen there.
        const double half = orthographic ? 1.5 : distance * tan(0.25), right = 0.4, up = -0.3;
        const double point[3] = {right * half, up * half, 0.0};
        double seen[2];
        view_eye_zoom(&eye, right, up, 0.5);
        project(&eye, point, seen);
        assert_close(seen[0], right);
        assert_close(seen[1], up);
        assert_close(view_eye_scale(&eye), 0.5 * before);
        assert_close(distance_of(&eye), orthographic ? distance : 0.5 * distance);
    }
}

static void test_pan_follows_the_pointer(void **state)
{
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        struct view_eye eye = see(orthographic, 5.0);
        const double origin[3] = {0, 0, 0};
        double seen[2];
        view_eye_pan(&eye, 0.25, 0.125);
        project(&eye, origin, seen);
        assert_close(seen[0], 0.5);
        assert_close(seen[1], 0.25);
    }
}

static void test_orbit_and_flight(void **state)
{
    (void)state;
    struct view_eye eye = see(true, 5.0);
    const double distance = distance_of(&eye);
    view_eye_orbit(&eye, vertical, 0.7, 0.2);
    assert_close(distance_of(&eye), distance);
    assert_close(eye.height, 3.0);
    assert_close(eye.target[0], 0.0);
    eye = see(true, 5.0);
    view_eye_fly(&eye, (double[]){1.0, 0.5, 0.0});
    assert_close(eye.target[0], 1.0);
    assert_close(eye.target[1], 0.5);
    assert_close(eye.height, 3.0);
    view_eye_fly(&eye, (double[]){0.0, 0.0, 1.0}); // ahead: larger, from the same place
    assert_close(distance_of(&eye), distance);
    assert_true(eye.height < 3.0);
    eye = see(false, 5.0);
    view_eye_fly(&eye, (double[]){0.0, 0.0, 1.0});
    assert_close(eye.eye[2], 4.0);
    assert_close(eye.target[2], -1.0);
}

// However far it is turned. The unit vector along (1, 1, 1) is longer than 1 by a rounding, which has no arcsine.
static void test_turning_stops_before_straight_up(void **state)
{
    (void)state;
    const double steep = sin(89.5 / 180.0 * 3.14159265358979323846), part = 1.0 / sqrt(3.0);
    const double diagonal[3] = {part, part, part};
    struct view_eye eye = see(false, 5.0);
    view_eye_turn(&eye, vertical, 0.0, 9.0);
    assert_true(fabs((eye.target[1] - eye.eye[1]) / distance_of(&eye) - steep) < 1e-6);
    eye = see(false, 5.0);
    for (int c = 0; c < 3; c++) {
        eye.target[c] = eye.eye[c] + 1.0;
    }
    view_eye_turn(&eye, diagonal, 0.0, 0.0);
    double rise = 0.0;
    for (int c = 0; c < 3; c++) {
        rise += part * (eye.target[c] - eye.eye[c]);
    }
    assert_true(fabs(rise / distance_of(&eye) - steep) < 1e-6);
}

// The ball touches the picture's edge and no more, in wide and in narrow pictures.
static void test_fit_shows_the_ball(void **state)
{
    (void)state;
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        for (int narrow = 0; narrow < 2; narrow++) {
            const double middle[3] = {3.0, 1.0, -2.0}, aspect = narrow ? 0.5 : 2.0, radius = 1.25;
            struct view_eye eye = see(orthographic, 5.0);
            view_eye_fit(&eye, middle, radius, aspect);
            const double distance = distance_of(&eye);
            const double edge = orthographic ? 0.5 * eye.height : distance * tan(0.25);
            const double short_edge = narrow ? edge * aspect : edge;
            assert_close(orthographic ? short_edge : distance * sin(atan(short_edge / distance)), radius);
            assert_close(eye.target[0], middle[0]);
            assert_true(distance > radius);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_lens_stays_what_it_is),
        cmocka_unit_test(test_zoom_keeps_what_is_under_the_pointer),
        cmocka_unit_test(test_pan_follows_the_pointer),
        cmocka_unit_test(test_orbit_and_flight),
        cmocka_unit_test(test_turning_stops_before_straight_up),
        cmocka_unit_test(test_fit_shows_the_ball),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
