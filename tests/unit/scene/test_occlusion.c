// SPDX-License-Identifier: MIT
// Ambient occlusion, and surfaces that are seen aslant: corners, creases, leaning normals and floors whose light can be
// worked out by hand.
#include "tiny_model.h"

#include <math.h>

// Two squares of side 4 that meet along the line x = 0 and lean away from it, `angle` from the line of sight each, in the
// light of the surroundings alone: what is left of it with ambient occlusion.
struct corner {
    struct scene_pictures with, without;
};

static struct scene_view make_corner(struct tiny *t, double angle)
{
    tiny_make(t);
    t->material.unlit = false;
    t->material.roughness = 1;
    t->material.base_color[0] = 1;
    t->model.instance_count = 2;
    t->material.double_sided = true;
    const float across = (float)sin(angle), along = (float)cos(angle);
    for (int i = 0; i < 2; i++) {
        const float side = i ? 1.0f : -1.0f;
        float *m = t->instances[i].world;
        tiny_identity(m);
        m[0] = across * 2;
        m[2] = side * along * 2;
        m[5] = 4;
        m[8] = -side * along * 2;
        m[10] = across * 2;
        m[12] = side * across * 2;
        m[14] = along * 2;
    }
    for (int c = 0; c < 3; c++) {
        t->model.bounds_min[c] = c == 2 ? 0.0f : c == 1 ? -4.0f : -4 * across;
        t->model.bounds_max[c] = c == 2 ? 4 * along : c == 1 ? 4.0f : 4 * across;
    }
    struct scene_view view = tiny_view(t, 256);
    view.outputs = SCENE_OUTPUT_LINEAR;
    view.shadows = false;
    view.camera.zfar = 100;
    t->model.light_count = 1; // a lamp that shines from behind
    t->light = (struct scene_model_light){
        .type = SCENE_LIGHT_DIRECTIONAL, .direction = {0, 0, 1}, .color = {1, 1, 1}, .intensity = 1};
    return view;
}

static struct corner draw_corner(double angle)
{
    struct tiny t;
    struct scene_view view = make_corner(&t, angle);
    view.ambient_occlusion = true;
    struct corner corner = {.with = tiny_draw(&t, &view)};
    view.ambient_occlusion = false;
    corner.without = tiny_draw(&t, &view);
    return corner;
}

static double left_of_light(const struct corner *corner, double x)
{
    return tiny_light_at(&corner->with, x, 0) / tiny_light_at(&corner->without, x, 0);
}

static void free_corner(struct corner *corner)
{
    scene_pictures_free(&corner->with);
    scene_pictures_free(&corner->without);
}

// In a right angle each square sees half of its cosine-weighted hemisphere, and gets a quarter of the light of the other
// half back; far from the corner nearly all. The reach is 0.2 of half the diagonal of the bounds, which is 1.0 here.
static void test_corner(void **state)
{
    (void)state;
    struct corner corner = draw_corner(0.25 * 3.14159265358979);
    const double at_corner = left_of_light(&corner, 0.02), between = left_of_light(&corner, 0.25);
    tiny_assert_close(left_of_light(&corner, 1.6), 1.0, 0.002);
    assert_true(at_corner > 0.625 && at_corner < 0.75); // blurred with what is beside
    assert_true(between > at_corner + 0.1 && between < 1.0);
    free_corner(&corner);
}

// In narrow wedges, of 30 degrees and 12, light falls gradually to the edge, and is not gone there.
static void test_no_crease_is_black(void **state)
{
    (void)state;
    const double angles[] = {15.0, 6.0};
    for (int i = 0; i < 2; i++) {
        struct corner corner = draw_corner(angles[i] / 180.0 * 3.14159265358979);
        const double end = 4.0 * sin(angles[i] / 180.0 * 3.14159265358979) - 0.03;
        const double at_edge = left_of_light(&corner, 0.01);
        assert_true(at_edge > 0.25 && at_edge < 0.6);
        double before = at_edge;
        for (double x = 0.02; x < end; x += 1.0 / 64.0) {
            const double left = left_of_light(&corner, x);
            assert_true(left > before - 0.02 && left < before + 0.3);
            before = left;
        }
        free_corner(&corner);
    }
}

static float darkest_around(const struct scene_pictures *p, int x, int y)
{
    float darkest = INFINITY;
    for (int v = y - 1; v <= y + 1; v++) {
        for (int u = x - 1; u <= x + 1; u++) {
            darkest = fminf(darkest, p->linear[4 * (v * p->width + u)]);
        }
    }
    return darkest;
}

// A pixel of a crease that is seen aslant, whose centre one square covers, has samples of the other square too. The light
// reaches both squares, and so no such pixel is darker than what is around it in a picture of one sample.
static void test_no_dots_along_a_crease(void **state)
{
    (void)state;
    for (int i = 0; i < 4; i++) {
        struct tiny t;
        struct scene_view view = make_corner(&t, (i & 1 ? 70.0 : 50.0) / 180.0 * 3.14159265358979);
        view.camera.up[0] = 0.3;
        view.camera.orthographic = i & 2;
        view.camera.yfov = 0.8;
        view.shadows = true;
        const struct scene_model_light front = {
            .type = SCENE_LIGHT_DIRECTIONAL, .direction = {0, 0, -1}, .color = {1, 1, 1}, .intensity = 1};
        t.light = front;
        struct scene_pictures one = tiny_draw(&t, &view);
        view.samples = 4;
        struct scene_pictures four = tiny_draw(&t, &view);
        for (int y = 64; y < 192; y++) {
            for (int x = 64; x < 192; x++) {
                assert_true(four.linear[4 * (y * four.width + x)] > 0.98f * darkest_around(&one, x, y));
            }
        }
        scene_pictures_free(&one);
        scene_pictures_free(&four);
    }
}

static void set_normals(struct tiny *t, float x, float z)
{
    for (int i = 0; i < 4; i++) {
        t->normals[i][0] = x;
        t->normals[i][1] = 0;
        t->normals[i][2] = z;
    }
}

// Normals that lean far from a square in which they are, each way and apart, are no reason for it to occlude itself.
static void test_leaning_normals_do_not_occlude(void **state)
{
    (void)state;
    for (int apart = 0; apart < 2; apart++) {
        struct tiny t;
        tiny_make(&t);
        t.material.unlit = false;
        set_normals(&t, 0.96f, 0.28f);
        for (int i = 0; i < 4 && apart; i++) {
            t.normals[i][0] *= t.positions[i][0];
        }
        struct scene_view view = tiny_view(&t, 128);
        view.outputs = SCENE_OUTPUT_LINEAR;
        view.shadows = false;
        view.ambient_occlusion = true;
        struct scene_pictures with = tiny_draw(&t, &view);
        view.ambient_occlusion = false;
        struct scene_pictures without = tiny_draw(&t, &view);
        for (size_t i = 0; i < 4 * 128 * 128; i++) {
            tiny_assert_close((double)with.linear[i], (double)without.linear[i], 0.01);
        }
        scene_pictures_free(&with);
        scene_pictures_free(&without);
    }
}

// Return the red light of the middle of a square that is turned by 60 degrees, if its normals are (x, 0, z) in the world
// and a lamp shines from the side and behind.
static double light_of_normal(float x, float z)
{
    const float sine = 0.8660254f, cosine = 0.5f;
    struct tiny t;
    tiny_make(&t);
    t.material.unlit = false;
    t.material.roughness = 0.2f;
    float *m = t.instances[0].world;
    tiny_identity(m);
    m[0] = m[10] = cosine;
    m[8] = sine;
    m[2] = -sine;
    set_normals(&t, cosine * x - sine * z, sine * x + cosine * z);
    t.model.light_count = 1;
    t.light = (struct scene_model_light){
        .type = SCENE_LIGHT_DIRECTIONAL, .direction = {-0.96f, 0, 0.28f}, .color = {1, 1, 1}, .intensity = 9};
    struct scene_view view = tiny_view(&t, 32);
    view.outputs = SCENE_OUTPUT_LINEAR;
    view.shadows = view.ambient_occlusion = false;
    struct scene_pictures pictures = tiny_draw(&t, &view);
    const double light = tiny_light_at(&pictures, 0, 0);
    scene_pictures_free(&pictures);
    return light;
}

// A normal that leans away from the eye is lit as one whose surface is just seen, with n·v = 0.02: no highlight is of what
// lies behind. A mesh whose normals are on the other side of its facets is lit as it is, from behind.
static void test_normals_that_lean_away(void **state)
{
    (void)state;
    const double expected = light_of_normal(0.9998f, 0.02f);
    const float leaning[][2] = {{1, 0}, {0.9950f, -0.1f}, {0.96f, -0.28f}};
    for (int i = 0; i < 3; i++) {
        tiny_assert_close(light_of_normal(leaning[i][0], leaning[i][1]), expected, 0.01 * expected);
    }
    assert_true(light_of_normal(-0.1f, -0.995f) < 0.7 * expected);
}

// A square by itself has nothing above it.
static void test_open_square(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.material.unlit = false;
    for (int tilted = 0; tilted < 2; tilted++) {
        if (tilted) { // about the Y axis
            t.instances[0].world[2] = 1.0f;
            t.instances[0].world[8] = -1.0f;
            t.model.bounds_min[2] = -1;
            t.model.bounds_max[2] = 1;
        }
        struct scene_view view = tiny_view(&t, 128);
        view.outputs = SCENE_OUTPUT_LINEAR;
        view.camera.eye[2] = 20;
        view.camera.zfar = 100;
        struct scene_pictures with = tiny_draw(&t, &view);
        view.ambient_occlusion = false;
        view.shadows = false;
        struct scene_pictures without = tiny_draw(&t, &view);
        for (size_t i = 0; i < 4 * 128 * 128; i++) {
            tiny_assert_close((double)with.linear[i], (double)without.linear[i], 0.01);
        }
        scene_pictures_free(&with);
        scene_pictures_free(&without);
    }
}

// Not along the end of the floor, where a pattern of pixels is not seen as a whole.
static bool is_inside(const struct scene_pictures *pictures, int side, int x, int y)
{
    bool inside = true;
    for (int k = 0; k < 25; k++) {
        const int right = x + k % 5 - 2, down = y + k / 5 - 2;
        const bool is_beside = right < 0 || down < 0 || right >= side || down >= side;
        inside = inside && (is_beside || pictures->linear[4 * (down * side + right) + 3] == 1.0f);
    }
    return inside;
}

// A floor that goes on below and beyond the picture, as it is seen by someone who stands on it: no part of it is darker for
// being far away, at the side, or at the picture's edge.
static void test_open_floor(void **state)
{
    enum { SIDE = 160 };
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.material.unlit = false;
    t.material.roughness = 1;
    struct scene_view view = tiny_view(&t, SIDE);
    view.outputs = SCENE_OUTPUT_LINEAR;
    view.shadows = false;
    view.background = SCENE_BACKGROUND_TRANSPARENT;
    // The lamp shines from below: the surroundings alone are left.
    t.model.light_count = 1;
    t.light = (struct scene_model_light){
        .type = SCENE_LIGHT_DIRECTIONAL, .direction = {0, 0, 1}, .color = {1, 1, 1}, .intensity = 1};
    view.camera = (struct scene_camera){.up = {0, 0, 1}, .znear = 0.001, .zfar = 10};
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        view.camera.orthographic = orthographic;
        view.camera.ymag = 0.15;
        view.camera.yfov = 0.9;
        for (int k = 0; k < 3; k++) {
            const double rise = 0.1 + 0.1 * k; // of an eye that is 0.5 away
            view.camera.eye[0] = 0.03;
            view.camera.eye[1] = -0.5;
            view.camera.eye[2] = rise;
            view.ambient_occlusion = true;
            struct scene_pictures with = tiny_draw(&t, &view);
            view.ambient_occlusion = false;
            struct scene_pictures without = tiny_draw(&t, &view);
            size_t seen = 0;
            for (int i = 0; i < SIDE * SIDE; i++) {
                if (is_inside(&without, SIDE, i % SIDE, i / SIDE)) {
                    tiny_assert_close((double)with.linear[4 * i] / (double)without.linear[4 * i], 1.0, 0.002);
                    seen++;
                }
            }
            assert_true(seen > SIDE * SIDE / 2);
            scene_pictures_free(&with);
            scene_pictures_free(&without);
        }
    }
}
static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_corner),
    cmocka_unit_test(test_no_crease_is_black),
    cmocka_unit_test(test_no_dots_along_a_crease),
    cmocka_unit_test(test_leaning_normals_do_not_occlude),
    cmocka_unit_test(test_normals_that_lean_away),
    cmocka_unit_test(test_open_square),
    cmocka_unit_test(test_open_floor),
};

const struct unit_tests test_occlusion = UNIT_TESTS(tests, NULL, NULL);
