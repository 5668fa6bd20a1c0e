// SPDX-License-Identifier: MIT
// Shadows and ambient occlusion: filters against maps whose shadows are known, and small scenes whose shadows and corners
// can be worked out by hand.
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

// A wall that leans over a floor from x = 0 on, and keeps the light from it: there is no bright line where they meet,
// although the penumbra is wide away from there and the map is empty beyond the corner.
static void test_no_light_along_an_inner_corner(void **state)
{
    (void)state;
    const double slopes[] = {1, 4, 16};
    for (size_t i = 0; i < sizeof slopes / sizeof *slopes; i++) {
        const struct scene_shadow_map maps[] = {parallel_map(0.12f), perspective_map(0.12f)};
        for (int m = 0; m < 2; m++) {
            const struct plane floor = {0.1, 0.2, -2}, wall = {0.1 + slopes[i], 0.2, -2};
            for (int y = 0; y < SIZE; y++) {
                for (int x = 0; x < SIZE; x++) {
                    const double depth = plane_depth(&maps[m], &wall, x + 0.5, y + 0.5);
                    texels[y * SIZE + x] = x < SIZE / 2 ? 0.0f : (float)depth;
                }
            }
            // A texel of the floor is 1/64 wide, or 1/32.
            for (double x = 0.02; x < 0.2; x += 0.003) {
                tiny_assert_close((double)look(&maps[m], &floor, x, 0.1, 0.0)[0], 0.0, 0.001);
            }
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

// Of the pixel over (x, y), which light that is no lamp's cannot change.
static double brightness(const struct scene_pictures *pictures, double x, double y)
{
    const int column = (int)((x + 2.0) / 4.0 * pictures->width),
              row = (int)((2.0 - y) / 4.0 * pictures->height);
    return (double)pictures->linear[4 * (row * pictures->width + column)];
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
        const double lit = brightness(&without, points[i][0], points[i][1]);
        const double now = brightness(&with, points[i][0], points[i][1]);
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
        tiny_assert_close(brightness(&with, 1.0, 0.0), brightness(&without, 1.0, 0.0), 1e-6);
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
            assert_true(brightness(&with, at, y) < 0.7 * brightness(&without, at, y));
        }
        for (double x = 0.0; x < 0.5; x += 0.01) {
            const double at = -x - 4.0 * texel;
            tiny_assert_close(brightness(&with, at, y), brightness(&without, at, y), 1e-6);
        }
    }
    scene_pictures_free(&with);
    scene_pictures_free(&without);
}

// Ambient occlusion ---------------------------------------------------------------------------------

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
    return brightness(&corner->with, x, 0) / brightness(&corner->without, x, 0);
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
    const double light = brightness(&pictures, 0, 0);
    scene_pictures_free(&pictures);
    return light;
}

// A normal that leans away from the eye is lit as one whose surface is just seen, with n·v = 0.02: no highlight is of what
// lies behind. A mesh whose normals are on the other side of its facets is
// lit as it is, from behind.
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
    cmocka_unit_test(test_corner),
    cmocka_unit_test(test_no_crease_is_black),
    cmocka_unit_test(test_no_dots_along_a_crease),
    cmocka_unit_test(test_leaning_normals_do_not_occlude),
    cmocka_unit_test(test_normals_that_lean_away),
    cmocka_unit_test(test_open_square),
    cmocka_unit_test(test_open_floor),
};

const struct unit_tests test_shadow = UNIT_TESTS(tests, NULL, NULL);
