// SPDX-License-Identifier: MIT
// Lesson 20: the texts draw, bit for bit, what shaders in C draw that compute the same formulas in the same order.
#include "lesson.h"

#include <math.h>

#include <rhw/shader.h>

#define main lesson_main
#include "20_glsl.c"
#undef main

enum { ALONG = 320, AROUND = 24, PIXELS = 160 };

struct stuff {
    struct scene scene;
    int number;
};

static void normalize(float v[3])
{
    const float scale = rhw_rsqrt1(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++) {
        v[k] *= scale;
    }
}

static void cross(const float a[3], const float b[3], float product[3])
{
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        product[k] = a[i] * b[j] - b[i] * a[j];
    }
}

static float mix(float a, float b, float part)
{
    return a * (1.0f - part) + b * part;
}

static float smooth_step(float from, float to, float v)
{
    const float part = (v - from) / (to - from), t = part < 0.0f ? 0.0f : part < 1.0f ? part : 1.0f;
    return t * t * (3.0f - 2.0f * t);
}

static float above_zero(float v)
{
    return v < 0.0f ? 0.0f : v;
}

// Vertices -------------------------------------------------------------------------------------------

static void find_knot(float t, float at[3])
{
    const float ring = 1.0f + 0.42f * rhw_cos1(3.0f * t);
    at[0] = ring * rhw_cos1(2.0f * t);
    at[1] = 0.5f * rhw_sin1(3.0f * t);
    at[2] = ring * rhw_sin1(2.0f * t);
}

static void place_vertex(struct rhw_vertex1 *v)
{
    const struct stuff *const stuff = v->uniforms;
    const int face = v->vertex_index / 6, corner = v->vertex_index % 6;
    const int along = face / AROUND + (0x32 >> corner & 1), around = face % AROUND + (0x2c >> corner & 1);
    const float turn = 6.2831853f;
    const float t = turn * (float)along / (float)ALONG, angle = turn * (float)around / (float)AROUND;
    float at[3], before[3], behind[3], ahead[3], side[3], up[3];
    find_knot(t, at);
    find_knot(t + 0.01f, ahead);
    find_knot(t - 0.01f, before);
    for (int k = 0; k < 3; k++) {
        ahead[k] -= before[k];
    }
    normalize(ahead);
    cross(ahead, (const float[3]){0, 1, 0}, side);
    normalize(side);
    cross(side, ahead, up);
    for (int k = 0; k < 3; k++) {
        behind[k] = rhw_cos1(angle) * side[k] + rhw_sin1(angle) * up[k];
        v->varying[k] = at[k] + 0.27f * behind[k];
        v->varying[3 + k] = behind[k];
    }
    const float *const m = stuff->scene.to_clip, *const p = v->varying;
    for (int k = 0; k < 4; k++) {
        v->position[k] = m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k];
    }
}

// Fragments ------------------------------------------------------------------------------------------

static float random_of(const int32_t corner[3])
{
    const uint32_t mixed = ((uint32_t)corner[0] * 73856093u ^ (uint32_t)corner[1] * 19349663u ^
                            (uint32_t)corner[2] * 83492791u) *
                           1274126177u;
    return (float)((mixed ^ mixed >> 15) & 0xffffu) / 65535.0f;
}

static float noise(float x, float y, float z)
{
    const float p[3] = {x, y, z};
    float whole[3], part[3], sum = 0;
    for (int k = 0; k < 3; k++) {
        whole[k] = floorf(p[k]);
        part[k] = p[k] - whole[k];
        part[k] = part[k] * part[k] * (3.0f - 2.0f * part[k]);
    }
    for (int i = 0; i < 8; i++) {
        float near[3];
        int32_t corner[3];
        for (int k = 0; k < 3; k++) {
            const int32_t bit = i >> k & 1;
            corner[k] = (int32_t)whole[k] + bit;
            near[k] = mix(1.0f - part[k], part[k], (float)bit);
        }
        sum += near[0] * near[1] * near[2] * random_of(corner);
    }
    return sum;
}

static float clouds(const struct rhw_fragment1 *f, float zoom)
{
    float square = 0, sum = 0.5f, size = 0.5f;
    for (int k = 0; k < 3; k++) {
        const float width = fabsf(f->ddx[k]) + fabsf(f->ddy[k]);
        square += width * width;
    }
    const float pixel = sqrtf(square);
    for (float scale = 1; scale < 64.0f && scale * pixel < 1.0f; scale *= 2.0f) {
        const float *const p = f->varying;
        const float here = noise(scale * (zoom * p[0]), scale * (zoom * p[1]), scale * (zoom * p[2]));
        sum += size * (here - 0.5f) * (1.0f - scale * pixel);
        size *= 0.5f;
    }
    return sum;
}

// What a stuff is without light. Return its gloss.
static float find_stuff(const struct rhw_fragment1 *f, int number, float base[3], float glow[3])
{
    static const float light_stone[3] = {0.86f, 0.87f, 0.82f}, dark_stone[3] = {0.10f, 0.22f, 0.20f},
                       light_wood[3] = {0.55f, 0.28f, 0.11f}, dark_wood[3] = {0.23f, 0.09f, 0.03f},
                       crust[3] = {0.05f, 0.045f, 0.045f}, fire[3] = {2.2f, 0.55f, 0.06f};
    const float *const p = f->varying;
    if (number == 0) {
        const float vein = fabsf(rhw_sin1(4.0f * p[0] + 3.0f * p[1] + 9.0f * clouds(f, 2.0f)));
        for (int k = 0; k < 3; k++) {
            base[k] = mix(dark_stone[k], light_stone[k], rhw_pow1(vein, 0.35f));
        }
        return 0.5f;
    }
    if (number == 1) {
        const float x = p[0] + 0.35f, y = p[1] + 1.1f;
        const float rings = 9.0f * sqrtf(x * x + y * y) + 2.5f * clouds(f, 1.0f);
        const float fiber = noise(40.0f * p[0], 40.0f * p[1], 3.0f * p[2]);
        const float ring = rings - floorf(rings);
        const float late = smooth_step(0.1f, 0.85f, ring) * (1.0f - smooth_step(0.85f, 1.0f, ring));
        for (int k = 0; k < 3; k++) {
            base[k] = mix(light_wood[k], dark_wood[k], late) * (0.8f + 0.3f * fiber);
        }
        return 0.25f;
    }
    const float heat = 1.0f - fabsf(2.0f * clouds(f, 3.0f) - 1.0f);
    for (int k = 0; k < 3; k++) {
        glow[k] = rhw_pow1(heat, 14.0f) * fire[k];
        base[k] = crust[k];
    }
    return 0.12f;
}

static void paint_fragment(struct rhw_fragment1 *f)
{
    static const float warm[3] = {1.0f, 0.93f, 0.82f}, blue[3] = {0.16f, 0.20f, 0.28f};
    const struct stuff *const stuff = f->uniforms;
    const float *const sun = stuff->scene.sun;
    float n[3], back[3], base[3], glow[3] = {0};
    for (int k = 0; k < 3; k++) {
        n[k] = f->varying[3 + k];
        back[k] = stuff->scene.eye[k] - f->varying[k];
    }
    normalize(n);
    normalize(back);
    const float gloss = find_stuff(f, stuff->number, base, glow);
    const float direct = above_zero(n[0] * sun[0] + n[1] * sun[1] + n[2] * sun[2]), sky = 0.5f + 0.5f * n[1];
    const float twice = 2.0f * (n[0] * -back[0] + n[1] * -back[1] + n[2] * -back[2]);
    float bounce[3];
    for (int k = 0; k < 3; k++) {
        bounce[k] = -back[k] - twice * n[k];
    }
    const float shine =
        rhw_pow1(above_zero(bounce[0] * sun[0] + bounce[1] * sun[1] + bounce[2] * sun[2]), 40.0f);
    for (int k = 0; k < 3; k++) {
        const float light = warm[k] * direct + blue[k] * sky + 0.04f;
        f->color[0][k] = base[k] * light + gloss * shine + glow[k];
    }
    f->color[0][3] = 1;
}

// ----------------------------------------------------------------------------------------------------

static void glsl_draws_what_c_draws(void **state)
{
    (void)state;
    static float by_glsl[PIXELS * PIXELS][4], by_c[PIXELS * PIXELS][4];
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, PIXELS, PIXELS, 1);
    const struct rhw_program program = {
        .vertex1 = place_vertex,
        .fragment1 = paint_fragment,
        .varyings = {{.components = 3, .derivatives = true}, {.components = 3}},
        .varying_count = 2,
        .uniform_size = sizeof(struct stuff)};
    for (int number = 0; number < STUFFS; number++) {
        struct stuff stuff = {.number = number};
        fill_scene(&stuff.scene);
        draw(context, target, &program, &stuff, sizeof stuff);
        must(rhw_texture_read(context, target, 0, by_c, 0), "read");
        draw_glsl(context, target, number);
        must(rhw_texture_read(context, target, 0, by_glsl, 0), "read");
        int different = 0, drawn = 0;
        for (int p = 0; p < PIXELS * PIXELS; p++) {
            different += memcmp(by_c[p], by_glsl[p], sizeof by_c[p]) != 0;
            drawn += by_c[p][0] != by_c[0][0];
        }
        assert_int_equal(different, 0);
        assert_true(drawn > PIXELS * PIXELS / 5);
    }
    rhw_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(glsl_draws_what_c_draws)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
