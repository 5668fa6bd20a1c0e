// SPDX-License-Identifier: MIT
// Cameras: fitted ones, those of files, their matrices, and the matrix of normals.
#include "tiny_model.h"

#include <math.h>
#include <string.h>

#include "draw/camera/coverage.h"
#include "draw/camera/orbit.h"
#include "draw/surface.h"

static const double pi = 3.14159265358979323846;

static void project(const double m[16], const double p[3], double ndc[3])
{
    double clip[4];
    for (int r = 0; r < 4; r++) {
        clip[r] = m[r] * p[0] + m[4 + r] * p[1] + m[8 + r] * p[2] + m[12 + r];
    }
    for (int i = 0; i < 3; i++) {
        ndc[i] = clip[i] / clip[3];
    }
}

static void view_projection(const struct scene_camera *camera, double aspect, double m[16])
{
    double view[16], projection[16];
    scene_camera_view(camera, view);
    scene_camera_projection(camera, aspect, projection);
    scene_matrix_multiply(projection, view, m);
}

// Whatever the angle and the aspect, all vertices lie within the margin, and some touch it unless the
// camera would come nearer than a fifth of the model's length along the view.
static void test_fit_touches_the_margin(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.positions[0][2] = 3.0f;
    t.positions[2][2] = -7.0f;
    t.positions[3][0] = 20.0f;
    tiny_set_bounds(&t);
    t.instances[0].world[12] = 1000.0f;
    t.instances[0].world[5] = 2.0f;
    for (double azimuth = -200.0; azimuth < 400.0; azimuth += 37.0) {
        for (double elevation = -90.0; elevation <= 90.0; elevation += 22.5) {
            for (double aspect = 0.25; aspect <= 4.0; aspect *= 2.0) {
                const struct scene_orbit orbit = {.azimuth = azimuth, .elevation = elevation};
                const struct scene_camera camera = scene_camera_fit(&t.model, orbit, 0.6, aspect);
                double m[16], view[16], widest = 0.0, nearest = INFINITY, furthest = 0.0;
                view_projection(&camera, aspect, m);
                scene_camera_view(&camera, view);
                for (int v = 0; v < 4; v++) {
                    const double p[3] = {(double)t.positions[v][0] + 1000.0, 2.0 * (double)t.positions[v][1],
                                         (double)t.positions[v][2]};
                    double ndc[3];
                    project(m, p, ndc);
                    widest = fmax(widest, fmax(fabs(ndc[0]), fabs(ndc[1])));
                    assert_true(ndc[2] > 0.0 && ndc[2] < 1.0);
                    const double z = -(view[2] * p[0] + view[6] * p[1] + view[10] * p[2] + view[14]);
                    nearest = fmin(nearest, z);
                    furthest = fmax(furthest, z);
                }
                const double least = 0.2 * (furthest - nearest);
                assert_true(widest < 0.92 + 1e-9 && nearest > least - 1e-9);
                if (nearest > least + 1e-9) {
                    tiny_assert_close(widest, 0.92, 1e-9);
                }
            }
        }
    }
}

// A model that turns stays within the margin all around, and touches it somewhere on the way.
static void test_fit_of_what_turns(void **state)
{
    (void)state;
    const double aspect = 1.5, center[3] = {0.5, -1.0, 2.0};
    struct tiny t;
    tiny_make(&t);
    t.positions[0][2] = 3.0f;
    t.positions[2][1] = 6.0f;
    t.positions[3][0] = -5.0f;
    tiny_set_bounds(&t);
    for (int up = SCENE_AXIS_Y; up <= SCENE_AXIS_Z; up++) {
        const int axis = up == SCENE_AXIS_Y ? 1 : 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        for (double elevation = -90.0; elevation <= 90.0; elevation += 30.0) {
            struct scene_orbit orbit = {
                .azimuth = 77.0, .elevation = elevation, .up = (enum scene_axis)up, .turns = true};
            memcpy(orbit.turn_center, center, sizeof center);
            const struct scene_camera camera = scene_camera_fit(&t.model, orbit, 0.6, aspect);
            double m[16], widest = 0.0, middle[3];
            view_projection(&camera, aspect, m);
            for (int i = 0; i < 4 * 3600; i++) {
                const double angle = i / 4 * (pi / 1800.0);
                const float *const from = t.positions[i % 4];
                const double a = (double)from[u] - center[u], b = (double)from[v] - center[v];
                double p[3], ndc[3];
                p[axis] = (double)from[axis];
                p[u] = center[u] + a * cos(angle) - b * sin(angle);
                p[v] = center[v] + a * sin(angle) + b * cos(angle);
                project(m, p, ndc);
                widest = fmax(widest, fmax(fabs(ndc[0]), fabs(ndc[1])));
                assert_true(ndc[2] > 0.0 && ndc[2] < 1.0);
            }
            assert_true(widest < 0.92 + 1e-9);
            assert_true(widest > 0.92 - 1e-5);
            project(m, center, middle);
            tiny_assert_close(middle[0], 0.0, 1e-9);
        }
    }
}

static void test_fit_angles(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    const double cases[][5] = {
        {0, 0, 0, 0, 1},    {90, 0, 1, 0, 0},
        {180, 0, 0, 0, -1}, {-90, 0, -1, 0, 0},
        {0, 90, 0, 1, 0},   {30, 20, 0.469846310392954, 0.342020143325669, 0.813797681349374}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct scene_orbit orbit = {.azimuth = cases[i][0], .elevation = cases[i][1]};
        const struct scene_camera camera = scene_camera_fit(&t.model, orbit, 0.5, 1.0);
        double back[3], length = 0.0;
        for (int c = 0; c < 3; c++) {
            back[c] = camera.eye[c] - camera.target[c];
            length += back[c] * back[c];
        }
        for (int c = 0; c < 3; c++) {
            tiny_assert_close(back[c] / sqrt(length), cases[i][2 + c], 1e-12);
        }
    }
}

// A point, a line seen end on and nothing at all still give a camera that can draw.
static void test_fit_of_degenerate_models(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    for (int what = 0; what < 3; what++) {
        for (int v = 0; v < 4; v++) {
            t.positions[v][0] = t.positions[v][1] = what == 2 ? 1e6f : 0.0f;
            t.positions[v][2] = what == 1 ? (float)v : 0.0f;
        }
        tiny_set_bounds(&t);
        struct scene_view view = tiny_view(&t, 8);
        view.camera = scene_camera_fit(&t.model, (struct scene_orbit){0}, 0.5, 1.0);
        char error[200];
        assert_true(scene_view_check(&view, error, sizeof error));
        assert_true(view.camera.eye[2] > (double)t.positions[3][2]);
    }
    t.model.instance_count = 0;
    const struct scene_camera camera = scene_camera_fit(&t.model, (struct scene_orbit){0}, 0.5, 1.0);
    assert_true(camera.znear > 0.0 && camera.zfar > camera.znear);
}

static void test_default_orbit_faces_flat_models(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    tiny_assert_close(scene_camera_default_orbit(&t.model, SCENE_AXIS_Y).azimuth, 0.0, 0.0);
    tiny_assert_close(scene_camera_default_orbit(&t.model, SCENE_AXIS_Y).elevation, 0.0, 0.0);
    t.indices[1] = 2;
    t.indices[2] = 1;
    t.indices[4] = 3;
    t.indices[5] = 2;
    tiny_assert_close(scene_camera_default_orbit(&t.model, SCENE_AXIS_Y).azimuth, 180.0, 0.0);
    // A mirrored instance turns its triangles round, and is drawn by their other side.
    t.instances[0].world[0] = -1;
    t.instances[0].mirrored = true;
    tiny_assert_close(scene_camera_default_orbit(&t.model, SCENE_AXIS_Y).azimuth, 180.0, 0.0);
    // A plate faces both sides, and one of them is a little larger by rounding. It is seen from its front.
    tiny_make(&t);
    for (int side = 0; side < 2; side++) {
        const uint32_t corners[2][6] = {{0, 1, 2, 0, 3, 2}, {0, 2, 1, 0, 2, 3}};
        memcpy(t.indices, corners[side], sizeof corners[side]);
        t.positions[3][0] = 1.001f * t.positions[3][0];
        tiny_set_bounds(&t);
        tiny_assert_close(scene_camera_default_orbit(&t.model, SCENE_AXIS_Y).azimuth, 0.0, 0.0);
    }
}

// A flat thing that lies is seen from below where it faces down and is not drawn from above.
static void test_default_orbit_of_lying_models(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    tiny_assert_close(scene_camera_default_orbit(&t.model, SCENE_AXIS_Z).elevation, 40.0, 0.0);
    t.indices[1] = 2;
    t.indices[2] = 1;
    t.indices[4] = 3;
    t.indices[5] = 2;
    for (int both = 0; both < 2; both++) {
        t.material.double_sided = both != 0;
        tiny_assert_close(scene_camera_default_orbit(&t.model, SCENE_AXIS_Z).elevation, both ? 40.0 : -40.0,
                          0.0);
    }
}

static void test_default_orbit_shows_the_front(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.positions[0][2] = t.positions[2][2] = 1.0f; // no longer flat
    tiny_set_bounds(&t);
    for (int back = 0; back < 2; back++) {
        t.model.faces_back = back != 0;
        tiny_assert_close(scene_camera_default_orbit(&t.model, SCENE_AXIS_Y).azimuth, 30.0 + 180.0 * back,
                          0.0);
        tiny_assert_close(scene_camera_front(&t.model), 180.0 * back, 0.0);
    }
}

// Make the square stand edge-on in the default picture, turned by `degrees` around its upper edge, and face as the
// winding says. Write its normal.
static void stand_edge_on(struct tiny *t, enum scene_axis up, double degrees, double normal[3])
{
    const struct scene_orbit usual = {.azimuth = 30, .elevation = 20, .up = up};
    double right[3], above[3], back[3], across[3];
    scene_orbit_axes(&usual, right, above, back);
    for (int i = 0; i < 3; i++) {
        across[i] = cos(degrees * pi / 180) * back[i] + sin(degrees * pi / 180) * above[i];
        for (int v = 0; v < 4; v++) {
            t->positions[v][i] = (float)((v & 1 ? 1 : -1) * right[i] + (v & 2 ? 1 : -1) * across[i]);
        }
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        normal[i] = right[j] * across[k] - right[k] * across[j];
    }
    tiny_set_bounds(t);
}

// A model that is flat but not along an axis, and of which next to nothing would be seen, is looked at from the side
// that it faces, and one that faces both ways from above. A few degrees are enough for the usual picture.
static void test_default_orbit_turns_from_an_edge(void **state)
{
    (void)state;
    static const uint32_t windings[3][6] = {{0, 1, 2, 2, 1, 3}, {0, 2, 1, 2, 3, 1}, {0, 1, 2, 2, 3, 1}};
    for (int i = 0; i < 6 * 3; i++) {
        const enum scene_axis up = (enum scene_axis)(i / 3);
        struct tiny t;
        double normal[3], above[3] = {0, 1, 0}, right[3], upright[3], back[3];
        tiny_make(&t);
        memcpy(t.indices, windings[i % 3], sizeof t.indices);
        stand_edge_on(&t, up, 1, normal);
        struct scene_orbit orbit = scene_camera_default_orbit(&t.model, up);
        scene_orbit_axes(&orbit, right, upright, back);
        scene_axis_turn(up, above);
        const double upper = normal[0] * above[0] + normal[1] * above[1] + normal[2] * above[2] > 0 ? 1 : -1;
        const double side = i % 3 == 2 ? upper : i % 3 == 0 ? 1 : -1;
        for (int c = 0; c < 3; c++) {
            tiny_assert_close(back[c], side * normal[c], 1e-6);
        }
        stand_edge_on(&t, up, 10, normal);
        orbit = scene_camera_default_orbit(&t.model, up);
        assert_true(orbit.azimuth == 30 && orbit.elevation == 20);
    }
}

// A sliver is flat along two axes, and the one that counts is that of its surface.
static void test_default_orbit_shows_a_sliver(void **state)
{
    (void)state;
    static const int axes[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    for (int i = 0; i < 3; i++) {
        struct tiny t;
        tiny_make(&t);
        for (int v = 0; v < 4; v++) {
            t.positions[v][axes[i][0]] = v & 1 ? 1.0f : -1.0f;
            t.positions[v][axes[i][1]] = v & 2 ? 0.02f : -0.02f;
            t.positions[v][3 - axes[i][0] - axes[i][1]] = 0.0f;
        }
        tiny_set_bounds(&t);
        const struct scene_camera camera = scene_camera_fit(
            &t.model, scene_camera_default_orbit(&t.model, SCENE_AXIS_Y), scene_camera_default_yfov(), 1.5);
        assert_true(scene_coverage_count(&t.model, &camera, 1.5, 400) >= 400);
    }
}

// A model whose up is another axis is one with y up, turned: the same picture of it.
static void test_fit_turns_with_up(void **state)
{
    (void)state;
    static const double directions[6][2][3] = {
        // up, and where azimuth 0 looks from
        [SCENE_AXIS_Y] = {{0, 1, 0}, {0, 0, 1}},        [SCENE_AXIS_Z] = {{0, 0, 1}, {0, -1, 0}},
        [SCENE_AXIS_X] = {{1, 0, 0}, {0, 0, 1}},        [SCENE_AXIS_MINUS_Y] = {{0, -1, 0}, {0, 0, 1}},
        [SCENE_AXIS_MINUS_Z] = {{0, 0, -1}, {0, 1, 0}}, [SCENE_AXIS_MINUS_X] = {{-1, 0, 0}, {0, 0, 1}}};
    for (int up = 0; up < 6; up++) {
        struct tiny t;
        tiny_make(&t);
        const double *y = directions[up][0], *z = directions[up][1];
        const double x[3] = {y[1] * z[2] - y[2] * z[1], y[2] * z[0] - y[0] * z[2], y[0] * z[1] - y[1] * z[0]};
        struct scene_camera upright =
            scene_camera_fit(&t.model, (struct scene_orbit){.azimuth = 50, .elevation = 35}, 0.5, 1.5);
        for (int v = 0; v < 4; v++) {
            const double p[3] = {(double)t.positions[v][0], (double)t.positions[v][1],
                                 (double)t.positions[v][2]};
            for (int i = 0; i < 3; i++) {
                t.positions[v][i] = (float)(p[0] * x[i] + p[1] * y[i] + p[2] * z[i]);
            }
        }
        tiny_set_bounds(&t);
        const struct scene_camera camera = scene_camera_fit(
            &t.model, (struct scene_orbit){.azimuth = 50, .elevation = 35, .up = (enum scene_axis)up}, 0.5,
            1.5);
        for (int i = 0; i < 3; i++) {
            const double *e = upright.eye, *u = upright.up;
            tiny_assert_close(camera.eye[i], e[0] * x[i] + e[1] * y[i] + e[2] * z[i], 1e-12);
            tiny_assert_close(camera.up[i], u[0] * x[i] + u[1] * y[i] + u[2] * z[i], 1e-12);
        }
        // The square faces where azimuth 0 looks from, and so the orbit of a flat model does.
        const struct scene_orbit orbit = scene_camera_default_orbit(&t.model, (enum scene_axis)up);
        assert_true(orbit.azimuth == 0 && orbit.elevation == 0 && orbit.up == (enum scene_axis)up);
    }
}

// Two instances of one mesh: a cube-like square of corners, and a ground.
static void test_fit_leaves_a_vast_ground_out(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.positions[0][2] = t.positions[2][2] = 1.0f; // no longer flat
    tiny_set_bounds(&t);
    const struct scene_orbit orbit = {.azimuth = 30, .elevation = 20},
                             whole = {.azimuth = 30, .elevation = 20, .whole = true};
    const double alone = scene_camera_fit(&t.model, orbit, 0.5, 1.0).zfar;
    t.model.instance_count = 2;
    for (int large = 0; large < 2; large++) {
        const float side = large ? 10.01f : 9.99f; // times the side, 100 times the area
        t.instances[1].world[0] = t.instances[1].world[5] = side;
        t.instances[1].world[10] = 0.001f;
        const struct scene_camera camera = scene_camera_fit(&t.model, orbit, 0.5, 1.0);
        const struct scene_camera all = scene_camera_fit(&t.model, whole, 0.5, 1.0);
        const double far = sqrt(camera.eye[0] * camera.eye[0] + camera.eye[2] * camera.eye[2]);
        const double far_all = sqrt(all.eye[0] * all.eye[0] + all.eye[2] * all.eye[2]);
        assert_true(far_all > 25 && (far < 8) == (large == 1));
        assert_true(camera.zfar > alone); // the ground is drawn all the same
    }
    t.instances[0].world[10] = 0; // everything is flat: all is the subject
    assert_true(scene_camera_fit(&t.model, orbit, 0.5, 1.0).eye[2] > 20);
}

// What is not seen, and what lies outside the frame, moves no camera. What is far away does not cut off what is near.
static void test_fit_is_about_the_frame(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.positions[0][2] = t.positions[2][2] = 1.0f; // not flat
    tiny_set_bounds(&t);
    const struct scene_orbit orbit = {.azimuth = 30, .elevation = 20},
                             whole = {.azimuth = 30, .elevation = 20, .whole = true};
    const struct scene_camera alone = scene_camera_fit(&t.model, orbit, 0.5, 1.0);
    t.model.instance_count = 2;
    t.instances[1].world[12] = t.instances[1].world[14] = -1e6f;
    t.model.bounds_min[0] = t.model.bounds_min[2] = -1e6f - 1;
    for (int unseen = 0; unseen < 2; unseen++) {
        t.instances[1].unseen = unseen;
        t.model.is_framed = true;
        memcpy(t.model.frame_min, t.mesh.bounds_min, sizeof t.model.frame_min);
        memcpy(t.model.frame_max, t.mesh.bounds_max, sizeof t.model.frame_max);
        const struct scene_camera camera = scene_camera_fit(&t.model, orbit, 0.5, 1.0);
        const struct scene_camera all = scene_camera_fit(&t.model, whole, 0.5, 1.0);
        for (int c = 0; c < 3; c++) {
            tiny_assert_close(camera.eye[c], alone.eye[c], 0.0);
        }
        tiny_assert_close(camera.znear, alone.znear, 1e-3);
        assert_true(camera.zfar > 1e6);
        assert_true(unseen ? all.eye[2] == alone.eye[2] : all.eye[2] > 1e5);
        t.model.is_framed = false;
        assert_true((scene_camera_fit(&t.model, orbit, 0.5, 1.0).eye[2] > 1e5) == (unseen == 0));
    }
}

// Of 8 vertices one is in the picture: enough from outside, not from within.
static void test_what_a_camera_must_show(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.model.instance_count = 2;
    t.instances[1].world[14] = 9;
    t.model.bounds_max[2] = 9;
    const double up[3] = {0, 1, 0}, corner[3] = {1, 1, 9}, before[3] = {1, 1, 12},
                 beside[3] = {0.5, 0.5, 8.9};
    struct scene_camera camera;
    char error[200];
    assert_true(scene_camera_look(&camera, &t.model, before, corner, up, 0.02, error, sizeof error));
    camera.zfar = 4;
    assert_true(scene_camera_is_believable(&t.model, &camera, 1.0));
    assert_true(scene_camera_look(&camera, &t.model, beside, corner, up, 0.02, error, sizeof error));
    assert_false(scene_camera_is_believable(&t.model, &camera, 1.0));
    assert_true(
        scene_camera_look(&camera, &t.model, before, (double[]){1, 1, 30}, up, 0.02, error, sizeof error));
    assert_false(scene_camera_is_believable(&t.model, &camera, 1.0));
}

// A camera from which the model is a quarter as large as it is when fitted is the limit, of surfaces, lines and points. A
// model covers a picture also where none of its corners is in it.
static void test_a_camera_shows_more_than_a_thumbnail(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    const double up[3] = {0, 1, 0}, middle[3] = {0, 0, 0};
    const struct {
        enum scene_primitive primitive;
        double distance; // times that of the fit
        enum scene_sight sight;
    } cases[] = {
        {SCENE_PRIMITIVE_TRIANGLES, 1, SCENE_SIGHT_ENOUGH},
        {SCENE_PRIMITIVE_TRIANGLES, 0.01, SCENE_SIGHT_ENOUGH},
        {SCENE_PRIMITIVE_TRIANGLES, 3.8, SCENE_SIGHT_ENOUGH},
        {SCENE_PRIMITIVE_TRIANGLES, 4.2, SCENE_SIGHT_NEXT_TO_NOTHING},
        {SCENE_PRIMITIVE_TRIANGLES, 14, SCENE_SIGHT_NEXT_TO_NOTHING},
        {SCENE_PRIMITIVE_TRIANGLES, 2000, SCENE_SIGHT_NEXT_TO_NOTHING},
        {SCENE_PRIMITIVE_TRIANGLES, -1, SCENE_SIGHT_NOTHING},
        {SCENE_PRIMITIVE_LINES, 9, SCENE_SIGHT_ENOUGH},
        {SCENE_PRIMITIVE_LINES, 300, SCENE_SIGHT_NEXT_TO_NOTHING},
        {SCENE_PRIMITIVE_POINTS, 9, SCENE_SIGHT_ENOUGH},
        {SCENE_PRIMITIVE_POINTS, -1, SCENE_SIGHT_NOTHING},
    };
    const double fit = scene_camera_fit(&t.model, (struct scene_orbit){0}, 0.5, 1.5).eye[2];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double eye[3] = {0, 0, (cases[i].distance < 0 ? 1 : cases[i].distance) * fit};
        const double *target = cases[i].distance < 0 ? (const double[]){0, 0, 9 * fit} : middle;
        struct scene_camera camera;
        char error[200];
        t.mesh.primitive = cases[i].primitive;
        assert_true(scene_camera_look(&camera, &t.model, eye, target, up, 0.5, error, sizeof error));
        const enum scene_sight sight = scene_camera_sight(&t.model, &camera, 1.5);
        if (sight != cases[i].sight) {
            fail_msg("case %zu: %d instead of %d", i, sight, cases[i].sight);
        }
        // Who asks for a camera may see less.
        const bool is_dot = cases[i].distance < 0 || cases[i].distance > 20;
        assert_true(scene_camera_shows_a_dot(&t.model, &camera, 1.5) == is_dot);
    }
}

// A line that is partly in the picture covers the cells of its places there, of 256 steps along it.
static void test_lines_cover_what_is_in_the_picture(void **state)
{
    (void)state;
    static const struct {
        float from[3], to[3];
        uint32_t cells;
    } cases[] = {
        {{-0.999f, 0.001f, 0}, {0.999f, 0.001f, 0}, 256},
        {{-3.999f, 0.001f, 0}, {3.999f, 0.001f, 0}, 64},
        {{-3.999f, 0.001f, 0}, {0, 0.001f, 0}, 64},
        {{0, 3.999f, 0}, {0, 0, 0}, 64},
        {{0.1f, 0.1f, -9}, {0.1f, 0.1f, 9}, 1},
        {{-9, 0, 0}, {-2, 0, 0}, 0},
        {{2, -9, 0}, {2, 9, 0}, 0},
        {{-3, 0, 0}, {0, 3, 0}, 0},
        {{0, 0, 9}, {0, 0, 20}, 0},
    };
    struct tiny t;
    tiny_make(&t);
    t.mesh.primitive = SCENE_PRIMITIVE_LINES;
    t.indices[0] = 0;
    t.indices[1] = 1;
    t.mesh.index_count = 2;
    t.model.instance_count = 1;
    const struct scene_camera camera = {
        .eye = {0, 0, 8}, .up = {0, 1, 0}, .orthographic = true, .ymag = 1, .znear = 1, .zfar = 15};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        memcpy(t.mesh.positions[0], cases[i].from, sizeof cases[i].from);
        memcpy(t.mesh.positions[1], cases[i].to, sizeof cases[i].to);
        const uint32_t cells = scene_coverage_count(&t.model, &camera, 1, UINT32_MAX);
        if (cells + 2 < cases[i].cells || cells > cases[i].cells + 2) {
            fail_msg("case %zu: %u cells instead of %u", i, cells, cases[i].cells);
        }
    }
}

static void test_look_refuses_what_is_no_camera(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_camera camera;
    char error[200];
    const double eye[3] = {1, 2, 3}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0}, zero[3] = {0, 0, 0};
    const double bad[3] = {0, NAN, 0};
    assert_true(scene_camera_look(&camera, &t.model, eye, target, up, 0.7, error, sizeof error));
    assert_false(scene_camera_look(&camera, &t.model, eye, eye, up, 0.7, error, sizeof error));
    assert_false(scene_camera_look(&camera, &t.model, eye, target, zero, 0.7, error, sizeof error));
    assert_false(scene_camera_look(&camera, &t.model, bad, target, up, 0.7, error, sizeof error));
    assert_false(scene_camera_look(&camera, &t.model, eye, target, up, 0.0, error, sizeof error));
    assert_false(scene_camera_look(&camera, &t.model, eye, target, up, pi, error, sizeof error));
    assert_non_null(strstr(error, "179 degrees"));
    const double along[3] = {-2, -4, -6.000001}; // 2e-8 radians from it
    assert_false(scene_camera_look(&camera, &t.model, eye, target, eye, 0.7, error, sizeof error));
    assert_false(scene_camera_look(&camera, &t.model, eye, target, along, 0.7, error, sizeof error));
    assert_string_equal(error, "not a camera: up must not be parallel to the view");
    assert_true(scene_camera_look_orthographic(&camera, &t.model, eye, target, up, 3.0, error, sizeof error));
    assert_true(camera.orthographic && camera.zfar > camera.znear);
    tiny_assert_close(camera.ymag, 1.5, 0.0);
    assert_false(scene_camera_look_orthographic(&camera, &t.model, eye, eye, up, 3.0, error, sizeof error));
    for (int i = 0; i < 4; i++) {
        const double heights[4] = {0.0, -1.0, NAN, INFINITY};
        assert_false(scene_camera_look_orthographic(&camera, &t.model, eye, target, up, heights[i], error,
                                                    sizeof error));
        assert_string_equal(error, "not a camera: the height of what is seen must be above 0");
    }
    // A camera of a file may look along its `up`: the rows of the view matrix are still perpendicular and of length 1.
    memcpy(camera.up, eye, sizeof eye);
    double m[16];
    scene_camera_view(&camera, m);
    for (int a = 0; a < 3; a++) {
        for (int b = 0; b < 3; b++) {
            const double product = m[a] * m[b] + m[4 + a] * m[4 + b] + m[8 + a] * m[8 + b];
            tiny_assert_close(product, a == b, 1e-12);
        }
    }
}

static void test_projection_against_formulas(void **state)
{
    (void)state;
    struct scene_camera camera = {
        .eye = {0, 0, 10}, .up = {0, 1, 0}, .yfov = 1.1, .znear = 2.0, .zfar = 50.0};
    double m[16], ndc[3];
    view_projection(&camera, 1.5, m);
    const double near_top[3] = {2.0 * tan(0.55) * 1.5, 2.0 * tan(0.55), 8.0}, far_middle[3] = {0, 0, -40};
    project(m, near_top, ndc);
    tiny_assert_close(ndc[0], 1.0, 1e-12);
    tiny_assert_close(ndc[1], 1.0, 1e-12);
    tiny_assert_close(ndc[2], 0.0, 1e-12);
    project(m, far_middle, ndc);
    tiny_assert_close(ndc[2], 1.0, 1e-12);
    camera.zfar = 0.0;
    view_projection(&camera, 1.5, m);
    const double very_far[3] = {0, 0, -1e12};
    project(m, very_far, ndc);
    tiny_assert_close(ndc[2], 1.0, 1e-11);
}

// A camera whose frame is wider than the picture keeps its width.
static void test_file_camera_in_a_narrow_picture(void **state)
{
    (void)state;
    struct scene_model_camera source = {.yfov = 0.8f, .aspect = 2.0f, .znear = 0.1f, .zfar = 100.0f};
    const struct scene_model near = {0};
    tiny_identity(source.world);
    for (double aspect = 0.01; aspect < 2.0; aspect *= 1.7) {
        const struct scene_camera camera = scene_camera_from_model(&near, &source, aspect);
        tiny_assert_close(tan(camera.yfov / 2.0) * aspect, tan((double)source.yfov / 2.0) * 2.0, 1e-9);
    }
    tiny_assert_close(scene_camera_from_model(&near, &source, 3.0).yfov, (double)source.yfov, 0.0);
    source.orthographic = true;
    source.xmag = 3.0f;
    source.ymag = 1.0f;
    tiny_assert_close(scene_camera_from_model(&near, &source, 1.0).ymag, 3.0, 0.0);
    tiny_assert_close(scene_camera_from_model(&near, &source, 6.0).ymag, 1.0, 0.0);
}

// A normal stays perpendicular to what lies in the surface, and on its outer side, under any matrix.
static void test_normal_matrix(void **state)
{
    (void)state;
    const double matrices[3][16] = {{2, 0, 0, 0, 0, 5, 0, 0, 0, 0, 0.1, 0, 3, 4, 5, 1},
                                    {1, 2, 3, 0, -4, 1, 0.5, 0, 0.2, 0.3, 7, 0, 0, 0, 0, 1},
                                    {-1, 0, 0, 0, 0, 3, 1, 0, 0, 0, 2, 0, 0, 0, 0, 1}};
    const double tangents[2][3] = {{1, 2, -1}, {0, 1, 3}}, normal[3] = {7, -3, 1}; // perpendicular to both
    for (int k = 0; k < 3; k++) {
        const double *m = matrices[k];
        double n[9], turned[3], outward = 0.0;
        scene_matrix_normal(m, n);
        for (int r = 0; r < 3; r++) {
            turned[r] = n[r] * normal[0] + n[3 + r] * normal[1] + n[6 + r] * normal[2];
            outward += turned[r] * (m[r] * normal[0] + m[4 + r] * normal[1] + m[8 + r] * normal[2]);
        }
        for (int t = 0; t < 2; t++) {
            double product = 0.0;
            for (int r = 0; r < 3; r++) {
                product += turned[r] *
                           (m[r] * tangents[t][0] + m[4 + r] * tangents[t][1] + m[8 + r] * tangents[t][2]);
            }
            tiny_assert_close(product, 0.0, 1e-9);
        }
        assert_true(outward > 0.0);
    }
}

// A model that is counted from an origin far away is seen from there as it is without: by a fitted camera, by one of the
// file, with the planes of both, and in the same picture.
static void test_far_from_the_origin(void **state)
{
    (void)state;
    const double far[3] = {5e7, -1.25e7, 3e6};
    struct tiny t;
    tiny_make(&t);
    const struct scene_orbit orbit = {.azimuth = 35.0, .elevation = 15.0};
    struct scene_view view = tiny_view(&t, 32);
    view.outputs = SCENE_OUTPUT_COLOR | SCENE_OUTPUT_POSITION;
    view.camera = scene_camera_fit(&t.model, orbit, 0.5, 1.0);
    struct scene_pictures here = tiny_draw(&t, &view);
    memcpy(t.model.origin, far, sizeof far);
    const struct scene_camera camera = scene_camera_fit(&t.model, orbit, 0.5, 1.0);
    for (int c = 0; c < 3; c++) {
        tiny_assert_close(camera.eye[c] - far[c], view.camera.eye[c], 1e-7);
        tiny_assert_close(camera.target[c] - far[c], view.camera.target[c], 1e-7);
    }
    tiny_assert_close(camera.znear, view.camera.znear, 1e-6);
    tiny_assert_close(camera.zfar, view.camera.zfar, 1e-6);
    assert_true(scene_camera_shows_most(&t.model, &camera, 1.0));
    assert_false(scene_camera_shows_most(&t.model, &view.camera, 1.0));
    view.camera = camera;
    struct scene_pictures there = tiny_draw(&t, &view);
    assert_memory_equal(there.color, here.color, 32 * 32 * 4);
    for (int i = 0; i < 4 * 32 * 32; i++) {
        tiny_assert_close((double)there.position[i], (double)here.position[i], 1e-6);
    }
    assert_memory_equal(there.origin, far, sizeof far);
    scene_pictures_free(&here);
    scene_pictures_free(&there);
    assert_int_equal(scene_camera_digits(camera.eye, camera.target), 15);
    assert_int_equal(scene_camera_digits((const double[]){1, 2, 3}, (const double[]){0, 0, 0}), 9);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_fit_touches_the_margin),
    cmocka_unit_test(test_fit_of_what_turns),
    cmocka_unit_test(test_fit_angles),
    cmocka_unit_test(test_fit_of_degenerate_models),
    cmocka_unit_test(test_default_orbit_faces_flat_models),
    cmocka_unit_test(test_default_orbit_of_lying_models),
    cmocka_unit_test(test_default_orbit_shows_the_front),
    cmocka_unit_test(test_default_orbit_turns_from_an_edge),
    cmocka_unit_test(test_default_orbit_shows_a_sliver),
    cmocka_unit_test(test_fit_turns_with_up),
    cmocka_unit_test(test_fit_leaves_a_vast_ground_out),
    cmocka_unit_test(test_fit_is_about_the_frame),
    cmocka_unit_test(test_what_a_camera_must_show),
    cmocka_unit_test(test_a_camera_shows_more_than_a_thumbnail),
    cmocka_unit_test(test_lines_cover_what_is_in_the_picture),
    cmocka_unit_test(test_look_refuses_what_is_no_camera),
    cmocka_unit_test(test_projection_against_formulas),
    cmocka_unit_test(test_file_camera_in_a_narrow_picture),
    cmocka_unit_test(test_far_from_the_origin),
    cmocka_unit_test(test_normal_matrix),
};

const struct unit_tests test_camera = UNIT_TESTS(tests, NULL, NULL);
