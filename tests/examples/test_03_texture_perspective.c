// SPDX-License-Identifier: MIT
// Lesson 3: texture coordinates of the square found in the three ways, and how far they are apart.
#include "lesson.h"

#define main lesson_main
#include "03_texture_perspective.c"
#undef main

static float found[ROWS][WAYS * SIZE][4];

static void draw_floats(void)
{
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, WAYS * SIZE, ROWS, 1);
    draw(context, show_uv, target, 1);
    rhw_texture_read(context, target, 0, found, 0);
    rhw_context_destroy(context);
}

// The camera written down a second time: at distance 1.5·√2 from the origin, looking along (0, −1, −1)/√2.
// The float products of the lesson's matrix differ from this by rounding, which may move a vertex by a
// snapping step; so the clip coordinates come from the lesson and are only checked here.
static void clip_coordinates(float clip[6][4])
{
    rhw_float attributes[2][4], varyings[4];
    for (int i = 0; i < RHW_LANES; i++) {
        const struct corner *corner = &square[i < 6 ? i : 0];
        for (int k = 0; k < 3; k++) {
            attributes[0][k][i] = corner->world[k];
        }
        attributes[1][0][i] = corner->uv[0];
        attributes[1][1][i] = corner->uv[1];
    }
    const struct rhw_viewport panel = panel_viewport(SCREEN, 1);
    const struct uniforms uniforms = make_uniforms(SCREEN, &panel);
    struct rhw_vertex vertex = {
        .attribute = (const rhw_float(*)[4])attributes, .uniforms = &uniforms, .varying = varyings};
    place(&vertex, 1);
    for (int i = 0; i < 6; i++) {
        for (int k = 0; k < 4; k++) {
            clip[i][k] = vertex.position[k][i];
        }
        const double x = (double)square[i].world[0], z = (double)square[i].world[2], h = sqrt(0.5);
        const double forward = h * (3 - z), up = -h * z;
        lesson_close((double)clip[i][0], 1.35 * x, 1e-6);
        lesson_close((double)clip[i][1], 1.35 * up, 1e-6);
        lesson_close((double)clip[i][2], (forward - 1) * 4 / 3, 1e-6);
        lesson_close((double)clip[i][3], forward, 1e-6);
    }
}

static void check_panel(enum way way, const float clip[6][4])
{
    const struct rhw_viewport panel = panel_viewport(way, 1);
    const struct ref_triangle halves[2] = {lesson_triangle(clip, &panel), lesson_triangle(clip + 3, &panel)};
    int count = 0;
    for (int i = 0; i < SIZE * ROWS; i++) {
        const int x = i % SIZE + (int)way * SIZE, y = i / SIZE;
        const float *value = found[y][x];
        const bool drawn = value[3] == 1;
        const bool in[2] = {lesson_covered(&halves[0], x, y, drawn && value[2] == 0),
                            lesson_covered(&halves[1], x, y, drawn && value[2] == 1)};
        if (!in[0] && !in[1]) {
            continue;
        }
        count++;
        const struct corner *corner = &square[in[0] ? 0 : 3];
        const struct ref_weights weights = lesson_weights(&halves[in[0] ? 0 : 1], x, y);
        for (int k = 0; k < 2; k++) {
            const double values[3] = {(double)corner[0].uv[k], (double)corner[1].uv[k],
                                      (double)corner[2].uv[k]};
            const double truth = ref_mix(way == SCREEN ? weights.screen : weights.space, values);
            if (way == WORLD) {
                // Not the pipeline's promise: the lesson's corners are not snapped, and half a step of 1/256
                // pixel is 1.1e−5 of the square's far edge, 180 pixels long; depth and matrix are 32-bit.
                lesson_close((double)value[k], truth, 2e-5);
            } else {
                lesson_near(k == 0 ? "u" : "v", x, y, value[k], truth, 1);
            }
        }
    }
    assert_in_range(count, 20000, 60000);
}

static void three_ways(void **state)
{
    (void)state;
    float clip[6][4];
    clip_coordinates(clip);
    draw_floats();
    for (int way = 0; way < WAYS; way++) {
        check_panel((enum way)way, (const float(*)[4])clip);
    }
}

static void differences(void **state)
{
    (void)state;
    draw_floats();
    const float(*uv)[4] = (const float(*)[4])found[0];
    assert_true(largest_difference(uv, WORLD, PIPELINE) < 2e-5f);
    assert_true(largest_difference(uv, SCREEN, PIPELINE) > 0.1f);
}

static void inverse_matrix(void **state)
{
    (void)state;
    const struct rhw_viewport panel = panel_viewport(PIPELINE, 1);
    const struct matrix view = view_matrix(), projection = projection_matrix();
    const struct matrix viewport = viewport_matrix(&panel);
    const struct matrix clip = multiply(&projection, &view), screen = multiply(&viewport, &clip);
    const struct matrix inverse = invert(screen);
    const struct matrix identity = multiply(&screen, &inverse);
    for (int i = 0; i < 16; i++) {
        lesson_close(identity.m[i / 4][i % 4], i / 4 == i % 4 ? 1 : 0, 1e-12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inverse_matrix),
        cmocka_unit_test(three_ways),
        cmocka_unit_test(differences),
        cmocka_unit_test(lesson_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
