// SPDX-License-Identifier: MIT
// Shadows: filters against maps whose shadows are known, and small scenes whose shadows can be worked out by hand.
#include "tiny_model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/shading/shade_shadow.h"
#include "draw/shadow.h"

enum { SIZE = 128 };

static float texels[SIZE * SIZE];

// Looks down −Z from z = 0 over −1..1; depth is 1 + z / range.
static struct scene_shadow_map parallel_map(float softness)
{
    const float half = 0.5f * SIZE, range = 4.0f;
    return (struct scene_shadow_map){
        .depth = texels,
        .size = SIZE,
        .pitch = SIZE,
        .rows = {{half, 0, 0, half}, {0, -half, 0, half}, {0, 0, 1.0f / range, 1.0f}, {0, 0, 0, 1.0f}},
        .unit = half,
        .range = range,
        .softness = softness};
}

// The same from the origin, with a right angle: column = half (x / −z + 1).
static struct scene_shadow_map perspective_map(float softness)
{
    const float half = 0.5f * SIZE, near = 0.125f;
    return (struct scene_shadow_map){
        .depth = texels,
        .size = SIZE,
        .pitch = SIZE,
        .rows = {{half, 0, -half, 0}, {0, -half, -half, 0}, {0, 0, 0, near}, {0, 0, -1.0f, 0}},
        .perspective = 1,
        .unit = half,
        .range = near,
        .softness = softness};
}

struct plane {
    double x, y, at; // z = at + x·X + y·Y
};

static double plane_depth(const struct scene_shadow_map *map, const struct plane *p, double column,
                          double row)
{
    const double u = column / (0.5 * SIZE) - 1.0, v = 1.0 - row / (0.5 * SIZE);
    if (!map->perspective) {
        return 1.0 + (p->at + p->x * u + p->y * v) / (double)map->range;
    }
    // z = at + x·u·(−z) + y·v·(−z)
    const double z = p->at / (1.0 + p->x * u + p->y * v);
    return (double)map->range / -z;
}

static void fill(const struct scene_shadow_map *map, const struct plane *p)
{
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            texels[y * SIZE + x] = (float)plane_depth(map, p, x + 0.5, y + 0.5);
        }
    }
}

// Of the light at 8 points of a plane beside each other from x on, with derivatives as a screen would have.
static rhw_float look_at(const struct scene_shadow_map *map, const struct plane *p, double x, double y,
                         double step, bool casts)
{
    rhw_float position[3], ddx[3], ddy[3];
    for (int i = 0; i < RHW_LANES; i++) {
        position[0][i] = (float)(x + step * i);
        position[1][i] = (float)y;
        position[2][i] = (float)(p->at + p->x * (x + step * i) + p->y * y);
    }
    ddx[0] = rhw_splat(0.01f);
    ddx[1] = rhw_splat(0.003f);
    ddx[2] = rhw_splat((float)(0.01 * p->x + 0.003 * p->y));
    ddy[0] = rhw_splat(-0.002f);
    ddy[1] = rhw_splat(-0.01f);
    ddy[2] = rhw_splat((float)(-0.002 * p->x - 0.01 * p->y));
    const struct scene_shader_light light = {.map_count = 1, .maps = map};
    return scene_shadow(&light, position, ddx, ddy, NULL, casts, rhw_splat_int(-1));
}

static rhw_float look(const struct scene_shadow_map *map, const struct plane *p, double x, double y,
                      double step)
{
    return look_at(map, p, x, y, step, true);
}

static void test_a_plane_does_not_shade_itself(void **state)
{
    (void)state;
    const struct plane planes[] = {{0, 0, -2}, {1, 0, -2}, {0, -1.5, -2}, {0.7, 0.7, -2}, {-0.6, 0.3, -1.7}};
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
        const struct scene_shadow_map maps[] = {parallel_map(0.3f), perspective_map(0.3f)};
        for (int m = 0; m < 2; m++) {
            fill(&maps[m], &planes[i]);
            for (double y = -0.7; y < 0.71; y += 0.1) {
                const rhw_float open = look(&maps[m], &planes[i], -0.7, y, 0.19);
                for (int lane = 0; lane < RHW_LANES; lane++) {
                    tiny_assert_close((double)open[lane], 1.0, 1e-6);
                }
            }
        }
    }
}

// Two planes that meet along x = 0: neither shades the other where both face the light.
static void test_a_fold_does_not_shade_itself(void **state)
{
    (void)state;
    const double slopes[][2] = {{0, 1}, {-1, 1}, {-0.5, 0.9}, {0, 1.5}};
    for (size_t i = 0; i < sizeof slopes / sizeof *slopes; i++) {
        const struct scene_shadow_map map = parallel_map(0.12f);
        const struct plane left = {slopes[i][0], 0, -2}, right = {slopes[i][1], 0, -2};
        for (int y = 0; y < SIZE; y++) {
            for (int x = 0; x < SIZE; x++) {
                const struct plane *p = x < SIZE / 2 ? &left : &right;
                texels[y * SIZE + x] = (float)plane_depth(&map, p, x + 0.5, y + 0.5);
            }
        }
        for (double x = -0.4; x < 0.4; x += 0.003) {
            const double open = (double)look(&map, x < 0.0 ? &left : &right, x, 0.1, 0.0)[0];
            tiny_assert_close(open, 1.0, 0.005);
        }
    }
}

// A wall that leans over a floor from `texels` of the map beyond x = 0 on, and keeps the light from it. The map is empty
// before the wall. At most `most` of the light arrives.
static void check_inner_corner(const struct scene_shadow_map *map, double slope, double texels_off,
                               double most)
{
    const double texel = map->perspective ? 2.0 / 64 : 1.0 / 64, at = texels_off * texel;
    const struct plane floor = {0.1, 0.2, -2}, wall = {0.1 + slope, 0.2, -2 - slope * at};
    for (int y = 0; y < SIZE; y++) {
        for (int x = 0; x < SIZE; x++) {
            const double depth = plane_depth(map, &wall, x + 0.5, y + 0.5);
            texels[y * SIZE + x] = x < SIZE / 2 ? 0.0f : (float)depth;
        }
    }
    for (double x = 0.002; x < 0.2; x += 0.001) {
        tiny_assert_close((double)look(map, &floor, at + x, 0.1, 0.0)[0], 0.0, most);
    }
}

// There is no bright line where wall and floor meet, although the penumbra is wide away from there. Where the wall begins
// at the centre of a texel it is no higher there than a plane may be that the map has.
static void test_no_light_along_an_inner_corner(void **state)
{
    (void)state;
    const double slopes[] = {1, 4, 16};
    for (size_t i = 0; i < sizeof slopes / sizeof *slopes; i++) {
        const struct scene_shadow_map maps[] = {parallel_map(0.12f), perspective_map(0.12f)};
        for (int m = 0; m < 2; m++) {
            check_inner_corner(&maps[m], slopes[i], 0.0, 0.001);
            check_inner_corner(&maps[m], slopes[i], 0.46, 0.12);
        }
    }
}

// A half plane of height z = −1 over x < 0 above a floor at z = −2: the penumbra is as wide as softness · 1 on either side
// of the edge, and half of the light arrives below the edge itself. So it is on a ground, which the map does not have.
static void check_penumbra(bool casts)
{
    const float softness = 0.2f;
    const struct scene_shadow_map map = parallel_map(softness);
    const struct plane floor = {0, 0, -2}, block = {0, 0, -1};
    fill(&map, &block);
    for (int y = 0; y < SIZE; y++) {
        for (int x = SIZE / 2; x < SIZE; x++) {
            texels[y * SIZE + x] = casts ? (float)plane_depth(&map, &floor, x + 0.5, y + 0.5) : 0.0f;
        }
    }
    double before = -1.0;
    for (double x = -0.4; x < 0.4; x += 0.01) {
        const double open = (double)look_at(&map, &floor, x, 0.1, 0.0, casts)[0];
        // A disc of light behind a straight edge: the part of a circle beyond a chord at t radii.
        const double t = fmax(-1.0, fmin(1.0, x / (double)softness));
        const double expected = 0.5 + (t * sqrt(1.0 - t * t) + asin(t)) / 3.14159265358979;
        tiny_assert_close(open, expected, 0.06);
        assert_true(open >= before - 1e-6);
        before = open;
    }
    tiny_assert_close((double)look_at(&map, &floor, -0.3, 0.0, 0.0, casts)[0], 0.0, 0.0);
    tiny_assert_close((double)look_at(&map, &floor, 0.3, 0.0, 0.0, casts)[0], 1.0, 0.0);
}

static void test_penumbra(void **state)
{
    (void)state;
    check_penumbra(true);
    check_penumbra(false);
}

static void test_beyond_the_map_is_light(void **state)
{
    (void)state;
    const struct scene_shadow_map map = parallel_map(0.1f);
    const struct plane floor = {0, 0, -2}, block = {0, 0, -1};
    fill(&map, &block);
    const rhw_float open = look(&map, &floor, -1.3, 0.0, 0.5); // −1.3, −0.8, .. 0.7, 1.2 ..
    const double expected[RHW_LANES] = {1, 0, 0, 0, 0, 1, 1, 1};
    for (int lane = 0; lane < RHW_LANES; lane++) {
        tiny_assert_close((double)open[lane], expected[lane], 0.0);
    }
}

// Scenes --------------------------------------------------------------------------------------------

enum {
    RINGS = 8,
    SECTORS = 16,
    BODY_VERTICES = (RINGS + 1) * (SECTORS + 1),
    BODY_INDICES = RINGS * SECTORS * 6
};

// A ball of radius 1, or a waist that widens from 0.9 to 1 at its ends: a hyperboloid about the Y axis. They have few facets,
// and the normals of what they stand for.
enum shape { BALL, BALL_INSIDE_OUT, WAIST };

struct body {
    struct tiny t;
    float positions[BODY_VERTICES][3], normals[BODY_VERTICES][3];
    uint32_t indices[BODY_INDICES];
};

static void set_corner(struct body *body, enum shape shape, int ring, int sector)
{
    float *p = body->positions[ring * (SECTORS + 1) + sector],
          *n = body->normals[ring * (SECTORS + 1) + sector];
    const double around = 2.0 * 3.14159265358979 * sector / SECTORS;
    if (shape == WAIST) {
        const double y = 1.0 - 2.0 * ring / RINGS, radius = sqrt(0.8 + 0.2 * y * y),
                     length = sqrt(radius * radius + 0.04 * y * y);
        p[0] = (float)(radius * sin(around));
        p[1] = (float)y;
        p[2] = (float)(radius * cos(around));
        n[0] = (float)(radius * sin(around) / length);
        n[1] = (float)(-0.2 * y / length);
        n[2] = (float)(radius * cos(around) / length);
        return;
    }
    const double down = 3.14159265358979 * ring / RINGS, side = shape == BALL ? 1.0 : -1.0;
    p[0] = (float)(sin(down) * cos(around));
    p[1] = (float)(sin(down) * sin(around));
    p[2] = (float)cos(down);
    for (int c = 0; c < 3; c++) {
        n[c] = (float)(side * (double)p[c]);
    }
}

static void make_body(struct body *body, enum shape shape)
{
    tiny_make(&body->t);
    body->t.material.unlit = false;
    body->t.material.roughness = 1;
    body->t.material.double_sided = shape == BALL_INSIDE_OUT;
    for (int r = 0; r <= RINGS; r++) {
        for (int s = 0; s <= SECTORS; s++) {
            set_corner(body, shape, r, s);
        }
    }
    uint32_t *index = body->indices;
    for (uint32_t r = 0; r < RINGS; r++) {
        for (uint32_t s = 0; s < SECTORS; s++) {
            const uint32_t a = r * (SECTORS + 1) + s, b = a + SECTORS + 1;
            const uint32_t corners[6] = {a, b, b + 1, a, b + 1, a + 1},
                           turned[6] = {a, b + 1, b, a, a + 1, b + 1};
            memcpy(index, shape == BALL_INSIDE_OUT ? turned : corners, sizeof corners);
            index += 6;
        }
    }
    body->t.mesh = (struct scene_mesh){.name = "",
                                       .vertex_count = BODY_VERTICES,
                                       .index_count = BODY_INDICES,
                                       .indices = body->indices,
                                       .positions = body->positions,
                                       .normals = body->normals};
    tiny_identity(body->t.instances[0].world);
    for (int c = 0; c < 3; c++) {
        body->t.model.bounds_min[c] = -1;
        body->t.model.bounds_max[c] = 1;
    }
    body->t.model.light_count = 1;
}

static void check_no_shadow(enum shape shape, const float direction[3])
{
    struct body body;
    make_body(&body, shape);
    body.t.light =
        (struct scene_model_light){.type = SCENE_LIGHT_DIRECTIONAL, .color = {1, 1, 1}, .intensity = 1};
    memcpy(body.t.light.direction, direction, sizeof body.t.light.direction);
    struct scene_view view = tiny_view(&body.t, 256);
    view.outputs = SCENE_OUTPUT_LINEAR;
    view.ambient_occlusion = false;
    struct scene_pictures with = tiny_draw(&body.t, &view);
    view.shadows = false;
    struct scene_pictures without = tiny_draw(&body.t, &view);
    for (size_t k = 0; k < 256 * 256 * 4; k++) {
        tiny_assert_close((double)with.linear[k], (double)without.linear[k], 0.025);
    }
    scene_pictures_free(&with);
    scene_pictures_free(&without);
}

// Light from the side: facets along its limit are turned away from it while the normals of their corners are not. They do
// not lie in the shadow of the ball, which stands for a sphere; of a ball whose front is inside, the back is seen.
static void test_a_ball_of_few_facets_does_not_shade_itself(void **state)
{
    (void)state;
    static const float directions[][3] = {
        {-1, 0, 0}, {-0.8f, 0.6f, 0}, {-0.64f, 0.48f, -0.6f}, {0, -0.28f, 0.96f}};
    for (size_t i = 0; i < sizeof directions / sizeof *directions; i++) {
        check_no_shadow(BALL, directions[i]);
        check_no_shadow(BALL_INSIDE_OUT, directions[i]);
    }
}

// Light across a waist meets circles alone, which do not shade themselves. But along its axis the surface rises above its
// tangent planes, into what a filter looks at.
static void test_a_waist_of_few_facets_does_not_shade_itself(void **state)
{
    (void)state;
    static const float directions[][3] = {{-1, 0, 0}, {-0.8f, 0, -0.6f}, {-0.96f, 0, 0.28f}};
    for (size_t i = 0; i < sizeof directions / sizeof *directions; i++) {
        check_no_shadow(WAIST, directions[i]);
    }
}

static void place(struct scene_instance *instance, float scale, float x, float y, float z)
{
    tiny_identity(instance->world);
    for (int c = 0; c < 3; c++) {
        instance->world[5 * c] = scale;
    }
    instance->world[12] = x;
    instance->world[13] = y;
    instance->world[14] = z;
}

// A floor of −2..2 and a square of −0.5..0.5 at height 1 above it.
static void make_floor(struct tiny *t)
{
    tiny_make(t);
    t->material.unlit = false;
    t->model.instance_count = 2;
    place(&t->instances[0], 2.0f, 0, 0, 0);
    place(&t->instances[1], 0.5f, 0, 0, 1);
    for (int c = 0; c < 3; c++) {
        t->model.bounds_min[c] = c < 2 ? -2.0f : 0.0f;
        t->model.bounds_max[c] = c < 2 ? 2.0f : 1.0f;
    }
}

static struct scene_view floor_view(const struct tiny *t, int size)
{
    struct scene_view view = tiny_view(t, size);
    view.outputs = SCENE_OUTPUT_LINEAR;
    view.ambient_occlusion = false;
    return view;
}

static void check_shadow(struct tiny *t)
{
    struct scene_view view = floor_view(t, 64);
    struct scene_pictures with = tiny_draw(t, &view);
    view.shadows = false;
    struct scene_pictures without = tiny_draw(t, &view);
    // The square's shadow lies a unit to the right; light comes from the left at 45 degrees.
    static const double points[][3] = {{1.0, 0.0, 1},  {0.6, 0.4, 1}, {1.4, -0.4, 1},
                                       {-1.0, 0.0, 0}, {0.0, 0.0, 0}, {1.0, 0.7, 0},
                                       {1.0, -0.7, 0}, {1.7, 0.0, 0}, {0.0, 1.5, 0}};
    for (size_t i = 0; i < sizeof points / sizeof *points; i++) {
        const double lit = tiny_light_at(&without, points[i][0], points[i][1]);
        const double now = tiny_light_at(&with, points[i][0], points[i][1]);
        if (points[i][2] > 0.0) {
            assert_true(now < 0.7 * lit);
        } else {
            tiny_assert_close(now, lit, 1e-6);
        }
    }
    scene_pictures_free(&with);
    scene_pictures_free(&without);
}

static void test_shadow_of_a_sun(void **state)
{
    (void)state;
    struct tiny t;
    make_floor(&t);
    t.model.light_count = 1;
    t.light = (struct scene_model_light){.type = SCENE_LIGHT_DIRECTIONAL,
                                         .direction = {(float)sqrt(0.5), 0, -(float)sqrt(0.5)},
                                         .color = {1, 1, 1},
                                         .intensity = 1};
    check_shadow(&t);
}

// From 30 units away rays through the square are nearly parallel.
static void test_shadow_of_lamps(void **state)
{
    (void)state;
    for (int spot = 0; spot < 2; spot++) {
        struct tiny t;
        make_floor(&t);
        t.model.light_count = 1;
        t.light = (struct scene_model_light){.type = spot ? SCENE_LIGHT_SPOT : SCENE_LIGHT_POINT,
                                             .position = {-30, 0, 31},
                                             .direction = {(float)sqrt(0.5), 0, -(float)sqrt(0.5)},
                                             .color = {1, 1, 1},
                                             .intensity = 1000,
                                             .inner_cos = 0.97f,
                                             .outer_cos = 0.95f};
        check_shadow(&t);
    }
}

// What is culled, and what is less than half opaque, casts none.
static void test_what_casts_no_shadow(void **state)
{
    (void)state;
    for (int how = 0; how < 2; how++) {
        struct tiny t;
        make_floor(&t);
        t.model.light_count = 1;
        t.light = (struct scene_model_light){.type = SCENE_LIGHT_DIRECTIONAL,
                                             .direction = {(float)sqrt(0.5), 0, -(float)sqrt(0.5)},
                                             .color = {1, 1, 1},
                                             .intensity = 1};
        if (how == 0) {
            t.instances[1].world[0] = -0.5f; // turned over: its back is up
            t.instances[1].world[10] = -0.5f;
        } else {
            t.material.alpha_mode = SCENE_ALPHA_BLEND;
            t.material.base_color[3] = 0.4f;
        }
        struct scene_view view = floor_view(&t, 64);
        struct scene_pictures with = tiny_draw(&t, &view);
        view.shadows = false;
        struct scene_pictures without = tiny_draw(&t, &view);
        tiny_assert_close(tiny_light_at(&with, 1.0, 0.0), tiny_light_at(&without, 1.0, 0.0), 1e-6);
        scene_pictures_free(&with);
        scene_pictures_free(&without);
    }
}

// A square that stands on the floor along the line x = 0, half a unit high, and light from the left at 45 degrees: the
// shadow begins where the square does, to within two texels of the map.
static void test_contact(void **state)
{
    (void)state;
    struct tiny t;
    make_floor(&t);
    t.material.double_sided = true;
    float *m = t.instances[1].world;
    tiny_identity(m); // x to z, z to −x
    m[0] = 0;
    m[2] = 0.25f;
    m[8] = -1;
    m[10] = 0;
    m[14] = 0.25f;
    t.model.light_count = 1;
    t.light = (struct scene_model_light){.type = SCENE_LIGHT_DIRECTIONAL,
                                         .direction = {(float)sqrt(0.5), 0, -(float)sqrt(0.5)},
                                         .color = {1, 1, 1},
                                         .intensity = 1};
    struct scene_view view = floor_view(&t, 512);
    struct scene_pictures with = tiny_draw(&t, &view);
    view.shadows = false;
    struct scene_pictures without = tiny_draw(&t, &view);
    const double texel = 4.0 / SCENE_SHADOW_SIZE;
    for (double y = -0.9; y < 0.91; y += 0.1) {
        for (double x = 0.0; x < 0.45; x += 0.01) {
            const double at = x + 2.0 * texel;
            assert_true(tiny_light_at(&with, at, y) < 0.7 * tiny_light_at(&without, at, y));
        }
        for (double x = 0.0; x < 0.5; x += 0.01) {
            const double at = -x - 4.0 * texel;
            tiny_assert_close(tiny_light_at(&with, at, y), tiny_light_at(&without, at, y), 1e-6);
        }
    }
    scene_pictures_free(&with);
    scene_pictures_free(&without);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(test_a_plane_does_not_shade_itself),
    cmocka_unit_test(test_a_fold_does_not_shade_itself),
    cmocka_unit_test(test_no_light_along_an_inner_corner),
    cmocka_unit_test(test_penumbra),
    cmocka_unit_test(test_beyond_the_map_is_light),
    cmocka_unit_test(test_shadow_of_a_sun),
    cmocka_unit_test(test_shadow_of_lamps),
    cmocka_unit_test(test_what_casts_no_shadow),
    cmocka_unit_test(test_a_ball_of_few_facets_does_not_shade_itself),
    cmocka_unit_test(test_a_waist_of_few_facets_does_not_shade_itself),
    cmocka_unit_test(test_contact),
};

const struct unit_tests test_shadow = UNIT_TESTS(tests, NULL, NULL);
