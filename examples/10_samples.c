// SPDX-License-Identifier: MIT
// Lesson 10: several samples of a pixel, and what they smooth.
//
// Rays run together in the middle, and on the disc there lies a pattern finer than the pixels. Enlarged three times,
// from left to right:
//
//     1 sample        a pixel has the colour of what covers its centre
//     4 samples       the fragment function runs once for a pixel and triangle, at its centre; how much of the pixel the
//                     triangle gets is counted by samples: edges are smooth, what is inside is as before
//     16 samples      the same with finer steps
//     4 × 4 pixels    supersampling: the fragment function runs 16 times, and the pattern is smooth as well
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"

enum { PANEL = 100, PANELS = 4, ENLARGED = 3, RAYS = 24, SIDES = 48, SCALE = 4, SCALE_LEVELS = 3 };
enum { VERTICES = 3 * RAYS + 3 * SIDES };

static const struct {
    int samples;
    bool supersampled;
    const char *name;
} panels[PANELS] = {
    {1, false, "1 sample"}, {4, false, "4 samples"}, {16, false, "16 samples"}, {1, true, "4 x 4 pixels"}};

static const float background[4] = {0.80f, 0.82f, 0.84f, 1}, ray_color[3] = {0.85f, 0.12f, 0.05f};
static const float star_center[2] = {-0.02f, 0.13f}, disc_center[2] = {0.47f, -0.55f}, disc_radius = 0.37f;

struct vertex {
    float position[2]; // −1..1 over the panel
    float pattern[2];  // in fields of the pattern; 0 on the rays
};

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        groups[i].position[0] = groups[i].attribute[0][0];
        groups[i].position[1] = groups[i].attribute[0][1];
        groups[i].position[2] = rhw_splat(0);
        groups[i].position[3] = rhw_splat(1);
        groups[i].varying[0] = groups[i].attribute[1][0];
        groups[i].varying[1] = groups[i].attribute[1][1];
    }
}

// Red on the rays; on the disc fields of light and dark blue in turn.
static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const rhw_float *at = groups[i].varying;
        const rhw_float field = rhw_floor(at[0]) + rhw_floor(at[1]);
        const rhw_int dark = rhw_less(rhw_fract(field * 0.5f), 0.25f);
        const rhw_int on_ray = rhw_equal(at[0], rhw_splat(0)) & rhw_equal(at[1], rhw_splat(0));
        static const float light_blue[3] = {0.65f, 0.75f, 0.9f}, dark_blue[3] = {0.02f, 0.07f, 0.25f};
        for (int k = 0; k < 3; k++) {
            const rhw_float blue = rhw_select(dark, dark_blue[k], light_blue[k]);
            groups[i].color[0][k] = rhw_select(on_ray, ray_color[k], blue);
        }
        groups[i].color[0][3] = rhw_splat(1);
    }
}

// Rays that touch in the middle, each as wide at its end as the gap beside it; then the disc, a fan.
static void fill(struct vertex vertices[VERTICES])
{
    const float turn = 6.28318531f;
    for (int i = 0; i < RAYS; i++) {
        for (int k = 0; k < 3; k++) {
            const float angle = turn * ((float)i + 0.5f * (float)(k == 2)) / RAYS,
                        radius = k == 0 ? 0 : 0.84f;
            vertices[3 * i + k] = (struct vertex){
                {star_center[0] + radius * rhw_sin1(angle), star_center[1] + radius * rhw_cos1(angle)},
                {0, 0}};
        }
    }
    for (int i = 0; i < SIDES; i++) {
        for (int k = 0; k < 3; k++) {
            const float angle = turn * (float)(i + (k == 2)) / SIDES, radius = k == 0 ? 0 : disc_radius;
            const float x = radius * rhw_sin1(angle), y = radius * rhw_cos1(angle);
            vertices[3 * (RAYS + i) + k] = (struct vertex){{disc_center[0] + x, disc_center[1] + y},
                                                           {100 + 30 * x + 11 * y, 100 + 30 * y - 11 * x}};
        }
    }
}

static void draw(rhw_context *context, rhw_texture target, int samples)
{
    struct vertex vertices[VERTICES];
    fill(vertices);
    struct rhw_pipeline_def def = {
        .program = {.vertex = {place},
                    .fragment = {paint},
                    .varyings = {{.components = 2, .qualifier = RHW_NOPERSPECTIVE}},
                    .varying_count = 1},
        .attributes = {{RHW_VERTEX_FLOAT2, 0, offsetof(struct vertex, position)},
                       {RHW_VERTEX_FLOAT2, 0, offsetof(struct vertex, pattern)}},
        .attribute_count = 2,
        .buffer_count = 1,
        .targets = {{.format = rhw_texture_format(context, target)}},
        .target_count = 1,
        .label = "lesson 10"};
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    // The target has one sample: those of the pass are averaged into it, tile by tile, and take no memory of their own.
    struct rhw_pass_def attachments = {
        .colors = {{.texture = target}}, .color_count = 1, .samples = samples, .label = "samples"};
    memcpy(attachments.colors[0].clear, background, sizeof background);
    const rhw_buffer buffer = picture_vertices(context, vertices, sizeof vertices);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, buffer, 0);
    rhw_pass_draw(context, pass, 0, VERTICES, 0, 1);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_buffer_destroy(context, buffer);
    rhw_pipeline_destroy(context, pipeline);
}

// Draws a panel, PANEL × PANEL pixels, in a format of four channels.
static void draw_panel(rhw_context *context, int number, enum rhw_format format, void *pixels)
{
    const bool supersampled = panels[number].supersampled;
    const int size = supersampled ? SCALE * PANEL : PANEL, level = supersampled ? SCALE_LEVELS - 1 : 0;
    const rhw_texture target = picture_target(context, format, size, size, level + 1);
    draw(context, target, panels[number].samples);
    if (supersampled) {
        must(rhw_texture_generate_mips(context, target), "mips");
    }
    must(rhw_texture_read(context, target, level, pixels, 0), "read");
    rhw_texture_destroy(context, target);
}

// What part of the pixel the rays cover, but for 64 × 64 steps.
static double coverage(int column, int row)
{
    const int steps = 64;
    int inside = 0;
    for (int i = 0; i < steps * steps; i++) {
        const double x = (column + (i % steps + 0.5) / steps) * 2 / PANEL - 1 - (double)star_center[0];
        const double y = 1 - (row + (i / steps + 0.5) / steps) * 2 / PANEL - (double)star_center[1];
        const double radius = sqrt(x * x + y * y), turn = atan2(x, y) / 6.283185307 * RAYS + RAYS;
        // A ray's end is straight: at the middle it is nearer.
        const double off = (turn - floor(turn) - 0.25) * 6.283185307 / RAYS;
        const double end = 0.84 * cos(6.283185307 / 4 / RAYS) / cos(off);
        inside += turn - floor(turn) < 0.5 && radius < end;
    }
    return (double)inside / (steps * steps);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const size_t width = (size_t)PANELS * PANEL * ENLARGED, height = (size_t)PANEL * ENLARGED;
    uint8_t(*picture)[4] = malloc(width * height * sizeof *picture);
    static uint8_t panel[PANEL * PANEL][4];
    for (int i = 0; i < PANELS && picture; i++) {
        draw_panel(context, i, RHW_FORMAT_RGBA8_SRGB, panel);
        for (size_t p = 0; p < height * height; p++) {
            const size_t x = p % height, y = p / height;
            memcpy(picture[y * width + (size_t)i * height + x], panel[y / ENLARGED * PANEL + x / ENLARGED],
                   4);
        }
    }
    if (!picture) {
        fprintf(stderr, "out of memory\n");
        return 1;
    }
    picture_write_png(directory, "10_samples.png", (int)width, (int)height, picture[0]);
    free(picture);

    static float values[PANEL * PANEL][4];
    static double meant[PANEL * PANEL / 2]; // above the disc
    for (int p = 0; p < PANEL * PANEL / 2; p++) {
        meant[p] = coverage(p % PANEL, p / PANEL);
    }
    printf("the rays' part of pixels, and what is drawn:\n");
    for (int i = 0; i < PANELS; i++) {
        double squares = 0;
        int count = 0;
        draw_panel(context, i, RHW_FORMAT_RGBA32_FLOAT, values);
        for (int p = 0; p < PANEL * PANEL / 2; p++) {
            const double red = ((double)values[p][1] - (double)background[1]) /
                               ((double)ray_color[1] - (double)background[1]);
            const double error = red - meant[p];
            squares += error * error;
            count++;
        }
        printf("  %-14s %.4f apart (root mean square)\n", panels[i].name, sqrt(squares / count));
    }
    rhw_context_destroy(context);
    return 0;
}
