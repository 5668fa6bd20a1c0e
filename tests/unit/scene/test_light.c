// SPDX-License-Identifier: MIT
// Light: reflection, tone mapping, surroundings and lamps against their formulas in double.
#include "tiny_model.h"

#include <math.h>
#include <string.h>

#include "draw/light.h"
#include "draw/shading/pbr.h"
#include "draw/shading/tone.h"

static const double pi = 3.14159265358979323846;

static void normalize3(double v[3])
{
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int c = 0; c < 3; c++) {
        v[c] /= length;
    }
}

static double dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// glTF 2.0, appendix B.3, as it stands there: the half vector made, every term by itself.
static double brdf(const double n[3], const double v[3], const double l[3], double base, double metallic,
                   double roughness)
{
    double h[3] = {l[0] + v[0], l[1] + v[1], l[2] + v[2]};
    normalize3(h);
    const double a2 = pow(roughness, 4.0), nl = fmax(dot3(n, l), 0.0), nv = dot3(n, v), nh = dot3(n, h);
    const double d = a2 / (pi * pow(nh * nh * (a2 - 1.0) + 1.0, 2.0));
    const double g =
        2.0 * nl / (nl + sqrt(a2 + (1.0 - a2) * nl * nl)) * 2.0 * nv / (nv + sqrt(a2 + (1.0 - a2) * nv * nv));
    const double f0 = 0.04 * (1.0 - metallic) + base * metallic;
    const double f = f0 + (1.0 - f0) * pow(1.0 - dot3(v, h), 5.0);
    return nl <= 0.0 ? 0.0 : nl * ((1.0 - f) * base * (1.0 - metallic) / pi + f * d * g / (4.0 * nl * nv));
}

static void test_reflection_against_gltf_appendix_b(void **state)
{
    (void)state;
    const double lights[][3] = {
        {0, 0, 1}, {1, 0.2, 0.7}, {-0.9, 0.1, 0.2}, {0.1, -0.3, 0.95}, {0.2, 0.1, -1}};
    const double views[][3] = {{0, 0, 1}, {-1, -0.2, 0.7}, {0.3, 0.8, 0.1}};
    const double materials[][3] = {{0.8, 0.0, 0.5}, {0.8, 1.0, 0.3}, {0.2, 0.5, 1.0}, {0.9, 1.0, 0.05}};
    const double normal[3] = {0, 0, 1};
    for (size_t i = 0; i < 5 * 3 * 4; i++) {
        double l[3], v[3];
        memcpy(l, lights[i % 5], sizeof l);
        memcpy(v, views[i / 5 % 3], sizeof v);
        normalize3(l);
        normalize3(v);
        const double *m = materials[i / 15];
        struct scene_reflector reflector;
        rhw_float base[3], to_light[3], irradiance[3], sum[3];
        for (int c = 0; c < 3; c++) {
            reflector.normal[c] = rhw_splat((float)normal[c]);
            reflector.view[c] = rhw_splat((float)v[c]);
            to_light[c] = rhw_splat((float)l[c]);
            base[c] = rhw_splat((float)m[0]);
            irradiance[c] = rhw_splat((float)(c + 1));
            sum[c] = rhw_splat((float)c);
        }
        scene_reflector_set(&reflector, base, rhw_splat((float)m[1]), rhw_splat((float)m[2]));
        scene_reflect_light(&reflector, to_light, irradiance, 0.0f, sum);
        const double expected = brdf(normal, v, l, m[0], m[1], m[2]);
        for (int c = 0; c < 3; c++) {
            // The peak of a mirror is 1 / α⁴ high: there 1 − (n·h)² has few of its bits left.
            const double tolerance = m[2] < 0.1 ? 1e-2 : 1e-4;
            tiny_assert_close((double)sum[c][3], c + (c + 1) * expected,
                              1e-5 + tolerance * (c + 1) * expected);
        }
    }
}

// The published code of Khronos PBR Neutral, in double.
static void neutral(double c[3])
{
    const double start = 0.8 - 0.04, desaturation = 0.15;
    const double x = fmin(c[0], fmin(c[1], c[2]));
    const double offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
    for (int i = 0; i < 3; i++) {
        c[i] -= offset;
    }
    const double peak = fmax(c[0], fmax(c[1], c[2]));
    if (peak < start) {
        return;
    }
    const double d = 1.0 - start, new_peak = 1.0 - d * d / (peak + d - start);
    const double g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    for (int i = 0; i < 3; i++) {
        c[i] = c[i] * new_peak / peak * (1.0 - g) + new_peak * g;
    }
}

static void test_tone_map_against_its_definition(void **state)
{
    (void)state;
    const double values[] = {0.0, 0.01, 0.05, 0.08, 0.2, 0.5, 0.76, 0.8, 0.81, 1.0, 2.0, 30.0, 1e4};
    for (size_t i = 0; i < 13 * 13 * 13; i++) {
        double expected[3] = {values[i % 13], values[i / 13 % 13], values[i / 169]};
        rhw_float color[3];
        for (int c = 0; c < 3; c++) {
            color[c] = rhw_splat(0.25f); // other lanes: dark
            color[c][5] = (float)expected[c];
        }
        neutral(expected);
        scene_tone_map(SCENE_TONE_NEUTRAL, color);
        for (int c = 0; c < 3; c++) {
            tiny_assert_close((double)color[c][5], expected[c], 3e-6);
            tiny_assert_close((double)color[c][0], 0.21, 1e-7);
        }
    }
}

// The published shaders of ACES' fit and of AgX, in double.
static void aces(double c[3])
{
    const double in[3][3] = {
        {0.59719, 0.35458, 0.04823}, {0.07600, 0.90834, 0.01566}, {0.02840, 0.13383, 0.83777}};
    const double out[3][3] = {
        {1.60475, -0.53108, -0.07367}, {-0.10208, 1.10813, -0.00605}, {-0.00327, -0.07276, 1.07602}};
    double v[3];
    for (int i = 0; i < 3; i++) {
        v[i] = (in[i][0] * c[0] + in[i][1] * c[1] + in[i][2] * c[2]) / 0.6;
        v[i] = (v[i] * (v[i] + 0.0245786) - 0.000090537) / (v[i] * (0.983729 * v[i] + 0.4329510) + 0.238081);
    }
    for (int i = 0; i < 3; i++) {
        c[i] = fmin(fmax(out[i][0] * v[0] + out[i][1] * v[1] + out[i][2] * v[2], 0.0), 1.0);
    }
}

static void agx(double c[3])
{
    const double in[3][3] = {{0.842479062253094, 0.0784335999999992, 0.0792237451477643},
                             {0.0423282422610123, 0.878468636469772, 0.0791661274605434},
                             {0.0423756549057051, 0.0784336, 0.879142973793104}};
    const double out[3][3] = {{1.19687900512017, -0.0980208811401368, -0.0990297440797205},
                              {-0.0528968517574562, 1.15190312990417, -0.0989611768448433},
                              {-0.0529716355144438, -0.0980434501171241, 1.15107367264116}};
    double v[3];
    for (int i = 0; i < 3; i++) {
        const double light = fmax(in[i][0] * c[0] + in[i][1] * c[1] + in[i][2] * c[2], 1e-10);
        const double x = (fmin(fmax(log2(light), -12.47393), 4.026069) + 12.47393) / (4.026069 + 12.47393);
        v[i] = 15.5 * pow(x, 6) - 40.14 * pow(x, 5) + 31.96 * pow(x, 4) - 6.868 * pow(x, 3) + 0.4298 * x * x +
               0.1191 * x - 0.00232;
    }
    for (int i = 0; i < 3; i++) {
        c[i] = pow(fmin(fmax(out[i][0] * v[0] + out[i][1] * v[1] + out[i][2] * v[2], 0.0), 1.0), 2.2);
    }
}

static void cut(double c[3])
{
    for (int i = 0; i < 3; i++) {
        c[i] = fmin(c[i], 1.0);
    }
}

static void test_other_tone_maps(void **state)
{
    (void)state;
    static void (*const maps[])(double[3]) = {
        [SCENE_TONE_NEUTRAL] = neutral, [SCENE_TONE_ACES] = aces, [SCENE_TONE_AGX] = agx, [SCENE_TONE_NONE] = cut};
    const double values[] = {0.0, 1e-4, 0.02, 0.18, 0.5, 1.0, 7.0, 900.0};
    for (int tone = SCENE_TONE_ACES; tone <= SCENE_TONE_NONE; tone++) {
        for (size_t i = 0; i < 8 * 8 * 8; i++) {
            double expected[3] = {values[i % 8], values[i / 8 % 8], values[i / 64]};
            rhw_float color[3];
            for (int c = 0; c < 3; c++) {
                color[c] = rhw_splat((float)expected[c]);
            }
            maps[tone](expected);
            scene_tone_map((enum scene_tone)tone, color);
            for (int c = 0; c < 3; c++) {
                tiny_assert_close((double)color[c][5], expected[c], 2e-5);
            }
        }
    }
}

// Radiance of the surroundings' soft boxes in one direction.
static double lobes_at(const struct scene_environment *e, const double d[3])
{
    double sum = 0.0;
    for (int i = 0; i < SCENE_LOBES; i++) {
        const double axis[3] = {(double)e->lobe_direction[i][0], (double)e->lobe_direction[i][1],
                                (double)e->lobe_direction[i][2]};
        sum += (double)e->lobe_color[i][0] * exp((double)e->sharpness * (dot3(axis, d) - 1.0));
    }
    return sum;
}

// The closed form of the diffuse light of the soft boxes against a sum over the sphere. Order 2 of the
// harmonics is all there is to a cosine lobe but a few percent.
static void test_environment_irradiance(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_lighting lighting;
    const struct scene_view view = tiny_view(&t, 8);
    assert_true(scene_lighting_create(&lighting, &t.model, &view.camera, SCENE_AXIS_Y, false, 0.0));
    struct scene_environment e = lighting.environment;
    for (int c = 0; c < 3; c++) {
        e.sky[c] = e.ground[c] = 0.0f;
    }
    const double normals[][3] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {-1, 1, 1}, {0, -1, 0}};
    for (int k = 0; k < 5; k++) {
        double n[3] = {normals[k][0], normals[k][1], normals[k][2]}, sum = 0.0;
        normalize3(n);
        const int rows = 200, columns = 400;
        for (int i = 0; i < rows * columns; i++) {
            const double z = 1.0 - 2.0 * (i / columns + 0.5) / rows, phi = 2.0 * pi * (i % columns) / columns;
            const double d[3] = {sqrt(1.0 - z * z) * cos(phi), sqrt(1.0 - z * z) * sin(phi), z};
            sum += fmax(dot3(n, d), 0.0) * lobes_at(&e, d) * 4.0 * pi / (rows * columns);
        }
        rhw_float normal[3], irradiance[3];
        for (int c = 0; c < 3; c++) {
            normal[c] = rhw_splat((float)n[c]);
        }
        struct scene_environment_lanes lanes;
        scene_environment_lanes_set(&lanes, &e);
        scene_environment_diffuse(&lanes, normal, irradiance);
        tiny_assert_close((double)irradiance[0][2], sum / pi, 0.03);
    }
    scene_lighting_destroy(&lighting);
}

// What the surroundings call the power of 2 has the bits of the general one.
static void test_bounded_power_of_two(void **state)
{
    (void)state;
    for (float a = -126.0f; a <= 127.0f; a += 0.0078125f + 1e-4f * a * a) {
        const rhw_float bounded = scene_exp2(rhw_splat(a)), general = rhw_exp2(rhw_splat(a));
        assert_memory_equal(&bounded, &general, sizeof general);
    }
    assert_true(isnan(scene_exp2(rhw_splat(NAN))[0]));
}

// A mirror shows the soft boxes themselves; a rough surface shows less contrast.
static void test_environment_reflection(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    struct scene_lighting lighting;
    const struct scene_view view = tiny_view(&t, 8);
    assert_true(scene_lighting_create(&lighting, &t.model, &view.camera, SCENE_AXIS_Y, false, 1.0));
    const struct scene_environment *e = &lighting.environment;
    rhw_float direction[3], sharp[3], rough[3];
    const double axis[3] = {(double)e->lobe_direction[0][0], (double)e->lobe_direction[0][1],
                            (double)e->lobe_direction[0][2]};
    for (int c = 0; c < 3; c++) {
        direction[c] = rhw_splat((float)axis[c]);
    }
    struct scene_environment_lanes lanes;
    scene_environment_lanes_set(&lanes, e);
    scene_environment_reflection(&lanes, NULL, direction, rhw_splat(0.0f), sharp);
    scene_environment_reflection(&lanes, NULL, direction, rhw_splat(1.0f), rough);
    const double height = axis[1];
    const double above = 0.5 + 0.5 * height / sqrt(height * height + 0.03);
    const double sky = (double)e->ground[0] + (double)(e->sky[0] - e->ground[0]) * above;
    tiny_assert_close((double)sharp[0][7], sky + lobes_at(e, axis), 1e-4);
    assert_true(rough[0][7] < 0.5f * sharp[0][7]);
    scene_lighting_destroy(&lighting);
}

// A file's light, whatever its unit's size, lights a white surface in the middle to about white.
static void test_exposure_follows_the_lights(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.light =
        (struct scene_model_light){.type = SCENE_LIGHT_POINT, .position = {0, 0, 10}, .color = {1, 1, 1}};
    t.model.light_count = 1;
    const struct scene_view view = tiny_view(&t, 8);
    for (float intensity = 0.01f; intensity < 1e7f; intensity *= 100.0f) {
        t.light.intensity = intensity;
        struct scene_lighting lighting;
        assert_true(scene_lighting_create(&lighting, &t.model, &view.camera, SCENE_AXIS_Y, false, 0.0));
        const rhw_float middle[3] = {rhw_splat(0.0f), rhw_splat(0.0f), rhw_splat(0.0f)};
        rhw_float to_light[3], irradiance[3];
        scene_light_at(&lighting.lights[0], middle, to_light, irradiance);
        tiny_assert_close((double)irradiance[1][0], 0.9 * pi, 1e-4);
        tiny_assert_close((double)to_light[2][0], 1.0, 1e-6);
        scene_lighting_destroy(&lighting);
    }
}

// A spot light is whole inside its inner cone, gone outside the outer one, and ends at its range.
static void test_spot_and_range(void **state)
{
    (void)state;
    struct tiny t;
    tiny_make(&t);
    t.light = (struct scene_model_light){.type = SCENE_LIGHT_SPOT,
                                         .position = {0, 0, 4},
                                         .direction = {0, 0, -1},
                                         .color = {1, 1, 1},
                                         .intensity = 5,
                                         .range = 8,
                                         .inner_cos = 0.95f,
                                         .outer_cos = 0.8f};
    t.model.light_count = 1;
    const struct scene_view view = tiny_view(&t, 8);
    struct scene_lighting lighting;
    assert_true(scene_lighting_create(&lighting, &t.model, &view.camera, SCENE_AXIS_Y, false, 0.0));
    const double scale = (double)lighting.lights[0].color[0];
    const double points[][3] = {{0, 0, 0}, {0.5, 0, 0}, {2.0, 0, 0}, {4, 0, 0}, {0, 0, -3.9}, {0, 0, -5}};
    for (int i = 0; i < 6; i++) {
        rhw_float p[3], to_light[3], irradiance[3];
        for (int c = 0; c < 3; c++) {
            p[c] = rhw_splat((float)points[i][c]);
        }
        scene_light_at(&lighting.lights[0], p, to_light, irradiance);
        const double dx = points[i][0], dz = 4.0 - points[i][2], d2 = dx * dx + dz * dz;
        const double cone = fmin(fmax((dz / sqrt(d2) - 0.8) / (0.95 - 0.8), 0.0), 1.0);
        const double window = fmin(fmax(1.0 - pow(d2 / 64.0, 2.0), 0.0), 1.0);
        tiny_assert_close((double)irradiance[0][0], scale * cone * cone * window / d2, 1e-4 * scale);
    }
    scene_lighting_destroy(&lighting);
}

// A light that stands in the file's first camera and shines as it looks is carried by the camera that takes the picture,
// unless this is that one.
static void test_headlamps_are_carried(void **state)
{
    (void)state;
    static const struct {
        enum scene_light_type type;
        float x, direction[3];
        bool is_carried;
    } cases[] = {
        {SCENE_LIGHT_SPOT, 100, {1, 0, 0}, true},          {SCENE_LIGHT_POINT, 100, {0, 0, -1}, true},
        {SCENE_LIGHT_DIRECTIONAL, 100, {1, 0, 0}, true},   {SCENE_LIGHT_SPOT, 100, {0.96f, 0.28f, 0}, false},
        {SCENE_LIGHT_DIRECTIONAL, 100, {-1, 0, 0}, false}, {SCENE_LIGHT_POINT, 100.1f, {1, 0, 0}, false},
        {SCENE_LIGHT_SPOT, -100, {1, 0, 0}, false},        {SCENE_LIGHT_POINT, 100.005f, {1, 0, 0}, true},
    };
    struct tiny t;
    tiny_make(&t);
    struct scene_model_camera cameras[2] = {{.yfov = 1, .znear = 1}, {.yfov = 1, .znear = 1}};
    tiny_identity(cameras[0].world);
    tiny_identity(cameras[1].world);
    memcpy(cameras[0].world, (const float[16]){0, 0, 1, 0, 0, 1, 0, 0, -2, 0, 0, 0, 100, 0, 0, 1},
           sizeof cameras[0].world); // it looks along x, away from the square
    cameras[1].world[14] = 7;
    t.model.cameras = cameras;
    t.model.light_count = 1;
    for (size_t i = 0; i < 4 * (sizeof cases / sizeof cases[0]); i++) {
        const size_t k = i / 4,
                     taker = i % 4; // a camera beside the file's, each of these, and none in the file
        t.light = (struct scene_model_light){.type = cases[k].type,
                                             .position = {cases[k].x, 0, 0},
                                             .color = {1, 1, 1},
                                             .intensity = 5,
                                             .range = 8,
                                             .inner_cos = 0.95f,
                                             .outer_cos = 0.8f};
        memcpy(t.light.direction, cases[k].direction, sizeof t.light.direction);
        t.model.camera_count = taker == 3 ? 0 : 2;
        struct scene_camera camera = tiny_view(&t, 8).camera;
        if (taker == 1 || taker == 2) {
            camera = scene_camera_from_model(&t.model, &cameras[taker - 1], 1.0);
        }
        struct scene_lighting lighting;
        assert_true(scene_lighting_create(&lighting, &t.model, &camera, SCENE_AXIS_Y, false, 0.0));
        const bool is_carried = cases[k].is_carried && (taker == 0 || taker == 2);
        const float sign = cases[k].type == SCENE_LIGHT_DIRECTIONAL ? -1 : 1;
        for (int c = 0; c < 3; c++) {
            const double place = is_carried ? camera.eye[c] : (double)t.light.position[c];
            const double way = is_carried ? -(c == 2) : (double)t.light.direction[c];
            tiny_assert_close((double)lighting.lights[0].position[c], place, 1e-6);
            tiny_assert_close((double)(sign * lighting.lights[0].direction[c]), way, 1e-6);
        }
        tiny_assert_close((double)lighting.lights[0].inverse_range, is_carried ? 0 : 1.0 / 8, 1e-6);
        if (is_carried && cases[k].type == SCENE_LIGHT_POINT) { // it lights the middle from there
            const double distance = camera.eye[2], light = (double)lighting.lights[0].color[1];
            tiny_assert_close(light / (distance * distance), 0.9 * pi, 1e-4);
        }
        scene_lighting_destroy(&lighting);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_reflection_against_gltf_appendix_b),
    cmocka_unit_test(test_tone_map_against_its_definition),
    cmocka_unit_test(test_other_tone_maps),
    cmocka_unit_test(test_environment_irradiance),
    cmocka_unit_test(test_bounded_power_of_two),
    cmocka_unit_test(test_environment_reflection),
    cmocka_unit_test(test_exposure_follows_the_lights),
    cmocka_unit_test(test_spot_and_range),
    cmocka_unit_test(test_headlamps_are_carried),
};

const struct unit_tests test_light = UNIT_TESTS(tests, NULL, NULL);
