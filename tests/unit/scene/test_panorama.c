// SPDX-License-Identifier: MIT
// Light from panoramas whose light is known: even ones, halves, a sun, patches in known directions.
#include "patience.h"
#include "tiny_model.h"

#include <math.h>
#include <string.h>

#include "draw/panorama.h"
#include "draw/shading/pbr.h"

enum { WIDTH = 256, HEIGHT = 128 };

static const double pi = 3.14159265358979323846;
static float texels[WIDTH * HEIGHT][4];
static const struct scene_panorama panorama = {WIDTH, HEIGHT, texels};

static void fill(int first_row, int last_row, float red, float green, float blue)
{
    for (int i = first_row * WIDTH; i < last_row * WIDTH; i++) {
        texels[i][0] = red;
        texels[i][1] = green;
        texels[i][2] = blue;
    }
}

// A patch of `side` texels around a column and a row.
static void patch(int column, int row, int side, float red, float green, float blue)
{
    for (int y = row - side / 2; y < row + side / 2; y++) {
        for (int x = column - side / 2; x < column + side / 2; x++) {
            float *texel = texels[y * WIDTH + (x + WIDTH) % WIDTH];
            texel[0] = red;
            texel[1] = green;
            texel[2] = blue;
        }
    }
}

static rhw_context *context;

static int open_context(void **state)
{
    (void)state;
    const struct rhw_context_def def = rhw_context_def_default();
    return rhw_context_create(&def, &context) == RHW_OK ? 0 : 1;
}

static int close_context(void **state)
{
    (void)state;
    rhw_context_destroy(context);
    return 0;
}

static struct scene_surroundings make(enum scene_axis up, double rotation)
{
    struct scene_surroundings s = {0};
    const struct scene_view view = {.panorama = &panorama, .up = up, .panorama_rotation = rotation};
    assert_int_equal(scene_surroundings_make(&s, context, &view), RHW_OK);
    return s;
}

static void irradiance(const struct scene_surroundings *s, double x, double y, double z, double result[3])
{
    const double length = sqrt(x * x + y * y + z * z);
    const rhw_float normal[3] = {rhw_splat((float)(x / length)), rhw_splat((float)(y / length)),
                                 rhw_splat((float)(z / length))};
    rhw_float light[3];
    struct scene_environment_lanes lanes;
    scene_environment_lanes_set(&lanes, &s->environment);
    scene_environment_diffuse(&lanes, normal, light);
    for (int c = 0; c < 3; c++) {
        result[c] = (double)light[c][3];
    }
}

static void test_even_light(void **state)
{
    (void)state;
    fill(0, HEIGHT, 5, 5, 5);
    struct scene_surroundings s = make(SCENE_AXIS_Y, 0);
    tiny_assert_close((double)s.environment.strength, 0.75 / 5, 1e-5);
    tiny_assert_close((double)s.sun.color[1], 0.0, 0.0);
    for (int i = 0; i < 7; i++) {
        double light[3];
        irradiance(&s, i - 3, i % 3 - 1, 1 - i % 2 * 2, light);
        tiny_assert_close(light[0], 0.75, 1e-3);
    }
    // All levels of the cube are as bright.
    for (int level = 0; level < 6; level++) {
        uint16_t face[512 * 512][4];
        assert_int_equal(rhw_texture_read(context, s.cube, level, face, (size_t)(512 >> level) * 8), RHW_OK);
        assert_int_equal(face[(512 >> level) / 2][0], 0x4500); // 5
    }
    scene_surroundings_destroy(context, &s);
}

// Light from the upper half alone: (1 + cos) / 2 of it arrives.
static void test_half_sky(void **state)
{
    (void)state;
    static const struct {
        enum scene_axis up;
        double direction[3];
    } ups[] = {{SCENE_AXIS_Y, {0, 1, 0}}, {SCENE_AXIS_Z, {0, 0, 1}}, {SCENE_AXIS_MINUS_Y, {0, -1, 0}}};
    fill(0, HEIGHT / 2, 2, 2, 2);
    fill(HEIGHT / 2, HEIGHT, 0, 0, 0);
    for (int i = 0; i < 3; i++) {
        struct scene_surroundings s = make(ups[i].up, 40);
        const double *up = ups[i].direction;
        double light[3];
        irradiance(&s, up[0], up[1], up[2], light);
        tiny_assert_close(light[1], 1.5, 0.02); // order 2 of the harmonics has all of an even half there
        irradiance(&s, -up[0], -up[1], -up[2], light);
        tiny_assert_close(light[1], 0.0, 0.02);
        irradiance(&s, up[1], up[2], up[0], light);
        tiny_assert_close(light[1], 0.75, 0.02);
        scene_surroundings_destroy(context, &s);
    }
}

// A small spot that outshines all becomes a light from there, with the irradiance that it had, and is gone from the rest.
static void test_sun(void **state)
{
    (void)state;
    fill(0, HEIGHT, 1, 1, 1);
    patch(WIDTH * 3 / 4, HEIGHT / 2, 4, 3000, 2000, 1000);
    struct scene_surroundings s = make(SCENE_AXIS_Y, 0);
    const double expected[3] = {0, 0, 1};
    for (int c = 0; c < 3; c++) {
        tiny_assert_close((double)s.sun.direction[c], expected[c], 1e-3);
    }
    const double angle = 2 * pi / WIDTH, solid = 16 * angle * angle;
    const double strength = (double)s.environment.strength;
    tiny_assert_close((double)s.sun.color[0] / strength, 3000 * solid, 0.02 * 3000 * solid);
    assert_true(s.sun.color[0] > 2.5f * s.sun.color[2]);
    double there[3], away[3];
    irradiance(&s, 0, 0, 1, there);
    irradiance(&s, 0, 0, -1, away);
    tiny_assert_close(there[0], away[0], 0.15 * away[0]); // ten times the mean is left of it
    scene_surroundings_destroy(context, &s);
}

// The square, a mirror that faces +Z, shows what is there; turned surroundings show it something else.
static void test_directions(void **state)
{
    (void)state;
    static const struct {
        enum scene_axis up;
        double rotation;
        int column, row; // what +Z sees
    } cases[] = {{SCENE_AXIS_Y, 0, WIDTH * 3 / 4, HEIGHT / 2},
                 {SCENE_AXIS_Y, 90, WIDTH / 2, HEIGHT / 2},
                 {SCENE_AXIS_Y, -90, 0, HEIGHT / 2},
                 {SCENE_AXIS_Z, 0, WIDTH / 2, 8}};
    for (int i = 0; i < 4; i++) {
        fill(0, HEIGHT, 0.1f, 0.1f, 0.1f);
        patch(cases[i].column, cases[i].row, 14, 0.1f, 1.0f, 0.1f);
        if (i == 3) {
            fill(0, 16, 0.1f, 1.0f, 0.1f);
        }
        struct tiny t;
        tiny_make(&t);
        t.material.unlit = false;
        t.material.metallic = 1;
        t.material.roughness = 0;
        struct scene_view view = tiny_view(&t, 8);
        view.outputs = SCENE_OUTPUT_LINEAR;
        view.panorama = &panorama;
        view.panorama_rotation = cases[i].rotation;
        view.up = cases[i].up;
        struct scene *scene;
        struct scene_pictures pictures;
        assert_int_equal(scene_create(context, &t.model, &scene), RHW_OK);
        assert_int_equal(scene_draw(scene, &view, &pictures, NULL), RHW_OK);
        const float *middle = &pictures.linear[4 * (4 * 8 + 4)];
        if (!(middle[1] > 5.0f * middle[0])) {
            fail_msg("case %d: %g %g %g", i, (double)middle[0], (double)middle[1], (double)middle[2]);
        }
        scene_pictures_free(&pictures);
        scene_destroy(scene);
    }
}

// The background shows the panorama itself, also what the sun was taken from.
static void test_background(void **state)
{
    (void)state;
    fill(0, HEIGHT, 0.5f, 0.5f, 0.5f);
    patch(0, HEIGHT / 2, 20, 0.0f, 0.0f, 0.5f); // −X
    struct tiny t;
    tiny_make(&t);
    struct scene_view view = tiny_view(&t, 64);
    view.camera = (struct scene_camera){
        .eye = {0, 0, 5}, .target = {-5, 0, 5}, .up = {0, 1, 0}, .yfov = 1.0, .znear = 1.0, .zfar = 9.0};
    view.panorama = &panorama;
    view.background = SCENE_BACKGROUND_PANORAMA;
    view.tone = SCENE_TONE_NONE;
    struct scene *scene;
    struct scene_pictures pictures;
    assert_int_equal(scene_create(context, &t.model, &scene), RHW_OK);
    assert_int_equal(scene_draw(scene, &view, &pictures, NULL), RHW_OK);
    const uint8_t *middle = &pictures.color[4 * (32 * 64 + 32)], *corner = pictures.color;
    assert_int_equal(middle[0], 0);
    assert_true(middle[2] > 150);
    assert_true(corner[0] > 150);
    scene_pictures_free(&pictures);
    scene_destroy(scene);
    char error[200];
    view.panorama = NULL;
    assert_false(scene_view_check(&view, error, sizeof error));
    assert_string_equal(error, "background: there is no environment to show");
}

// Each row that is measured is preceded by a question, the mips and passes ask too, and the first no ends it all.
static void test_given_up(void **state)
{
    (void)state;
    fill(0, HEIGHT, 0.1f, 0.1f, 0.1f);
    patch(100, 40, 4, 5000, 4000, 3000); // a sun: all passes over the texels
    struct patience patience = {.left = 1 << 30};
    const struct scene_view view = {.panorama = &panorama, .goes_on = goes_on, .user = &patience};
    struct scene_surroundings s = {0};
    struct rhw_context_def def = rhw_context_def_default();
    rhw_context *alone;
    def.threads = 1; // others would take some of the questions
    assert_int_equal(rhw_context_create(&def, &alone), RHW_OK);
    rhw_context_set_goes_on(alone, goes_on, &patience);
    assert_int_equal(scene_surroundings_make(&s, alone, &view), RHW_OK);
    scene_surroundings_destroy(alone, &s);
    const int all = patience.asked, measured = 6 * HEIGHT;
    assert_true(all > measured + 100);
    const int places[] = {0, HEIGHT + 1, measured - 1, measured, measured + 1, all - 1};
    for (int i = 0; i < 6; i++) {
        patience = (struct patience){.left = places[i]};
        const enum rhw_result result = scene_surroundings_make(&s, alone, &view);
        // A machine that is busy holds some draws up, and they ask more often.
        const bool is_refused = places[i] <= measured + 1 || patience.asked > places[i];
        assert_int_equal(result, is_refused ? RHW_ERROR_GIVEN_UP : RHW_OK);
        assert_int_equal(patience.asked, is_refused ? places[i] + 1 : patience.asked);
        assert_true(is_refused == !s.panorama);
        scene_surroundings_destroy(alone, &s);
    }
    patience = (struct patience){.left = 1 << 30};
    assert_int_equal(scene_surroundings_make(&s, alone, &view), RHW_OK);
    assert_true(s.sun.color[0] > 0.0f);
    scene_surroundings_destroy(alone, &s);
    rhw_context_destroy(alone);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_even_light), cmocka_unit_test(test_half_sky),   cmocka_unit_test(test_sun),
    cmocka_unit_test(test_directions), cmocka_unit_test(test_background), cmocka_unit_test(test_given_up),
};

const struct unit_tests test_panorama = UNIT_TESTS(tests, open_context, close_context);
