// SPDX-License-Identifier: MIT
// Lesson 6: what each of the three answers leaves in the target, and what the average of 16 samples is.
#include "lesson.h"

#include <math.h>

#define main lesson_main
#include "06_fragment.c"
#undef main

enum { FINE = PANEL * SCALE };

static const double expected_background[3] = {0.015, 0.02, 0.03};
static float drawn[PANEL][PANELS * PANEL][4];

static void draw_floats(void)
{
    rhw_context *context = picture_context();
    const rhw_texture target = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, PANELS * PANEL, PANEL, 1);
    draw(context, target, PANEL);
    rhw_texture_read(context, target, 0, drawn, 0);
    rhw_context_destroy(context);
}

static struct ref_triangle expected_triangle(const struct corner corners[3], int panel)
{
    float clip[3][4];
    for (int i = 0; i < 3; i++) {
        clip[i][0] = corners[i].position[0];
        clip[i][1] = corners[i].position[1];
        clip[i][2] = 0;
        clip[i][3] = 1;
    }
    const struct rhw_viewport viewport = {(float)(panel * PANEL), 0, PANEL, PANEL, 0, 1};
    return lesson_triangle((const float(*)[4])clip, &viewport);
}

// Source over destination where the triangle covers the pixel; W = 1, so the weights of screen and space agree.
static void put_over(const struct corner corners[3], int panel, int x, int y, double opacity, double color[3])
{
    const struct ref_triangle t = expected_triangle(corners, panel);
    if (!ref_covers(&t, x, y)) {
        return;
    }
    const struct ref_weights weights = lesson_weights(&t, x, y);
    for (int c = 0; c < 3; c++) {
        const double values[3] = {(double)corners[0].color[c], (double)corners[1].color[c],
                                  (double)corners[2].color[c]};
        color[c] = opacity * ref_mix(weights.screen, values) + (1 - opacity) * color[c];
    }
}

static void expect_color(const double color[3], int x, int y)
{
    for (int c = 0; c < 3; c++) {
        lesson_near("colour", x, y, drawn[y][x][c], color[c], 1);
    }
}

static void color_and_blend(void **state)
{
    (void)state;
    draw_floats();
    for (int i = 0; i < PANEL * 2 * PANEL; i++) {
        const int x = i % (2 * PANEL), y = i / (2 * PANEL), panel = x / PANEL;
        double color[3] = {expected_background[0], expected_background[1], expected_background[2]};
        put_over(upright, panel, x, y, 1, color);
        if (panel == BLEND) {
            put_over(hanging, panel, x, y, (double)alpha, color);
        }
        expect_color(color, x, y);
    }
}

// A ring is missing where ⌊64·(x² + y²)⌋ is odd; pixels on a ring's border may go either way.
static void discarded_rings(void **state)
{
    (void)state;
    int kept = 0, discarded = 0;
    draw_floats();
    for (int i = 0; i < PANEL * PANEL; i++) {
        const int x = DISCARD * PANEL + i % PANEL, y = i / PANEL;
        const double px = (i % PANEL + 0.5) / PANEL * 2 - 1, py = 1 - (y + 0.5) / PANEL * 2;
        const double ring = (px * px + py * py) * 64;
        // The corners' positions are snapped, px and py are not: 1/512 pixel and what the slope makes of it.
        if (fabs(ring - rint(ring)) < 0.01) {
            continue;
        }
        double color[3] = {expected_background[0], expected_background[1], expected_background[2]};
        const bool gap = (int)ring % 2 == 1;
        if (!gap) {
            put_over(upright, DISCARD, x, y, 1, color);
        }
        const struct ref_triangle t = expected_triangle(upright, DISCARD);
        kept += !gap && ref_covers(&t, x, y);
        discarded += gap && ref_covers(&t, x, y);
        expect_color(color, x, y);
    }
    assert_in_range(kept, 5000, 20000);
    assert_in_range(discarded, 5000, 20000);
}

// The mean of the 16 samples, in linear light, and the byte it is encoded to.
static void supersampled(void **state)
{
    (void)state;
    static float samples[FINE][PANELS * FINE][4], means[PANEL][PANELS * PANEL][4];
    static uint8_t bytes[PANEL][PANELS * PANEL][4];
    rhw_context *context = picture_context();
    const rhw_texture floats =
        picture_target(context, RHW_FORMAT_RGBA32_FLOAT, PANELS * FINE, FINE, SCALE_LEVELS);
    const rhw_texture encoded =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, PANELS * FINE, FINE, SCALE_LEVELS);
    draw(context, floats, FINE);
    draw(context, encoded, FINE);
    rhw_texture_read(context, floats, 0, samples, 0);
    rhw_texture_read(context, floats, SCALE_LEVELS - 1, means, 0);
    rhw_texture_read(context, encoded, SCALE_LEVELS - 1, bytes, 0);
    rhw_context_destroy(context);
    for (int i = 0; i < PANEL * PANELS * PANEL * 3; i++) {
        const int c = i % 3, x = i / 3 % (PANELS * PANEL), y = i / 3 / (PANELS * PANEL);
        double sum = 0;
        for (int k = 0; k < SCALE * SCALE; k++) {
            sum += (double)samples[y * SCALE + k / SCALE][x * SCALE + k % SCALE][c];
        }
        const double mean = sum / (SCALE * SCALE);
        lesson_near("mean", x, y, means[y][x][c], mean, 1);
        // Levels are encoded on the way, so half a step of rounding may come in three times.
        lesson_close(bytes[y][x][c], ref_srgb_encode(mean) * 255, 1.6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(color_and_blend),
        cmocka_unit_test(discarded_rings),
        cmocka_unit_test(supersampled),
        cmocka_unit_test(lesson_run),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
