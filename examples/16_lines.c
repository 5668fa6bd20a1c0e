// SPDX-License-Identifier: MIT
// Lesson 16: smooth lines, in three ways, enlarged three times.
//
//     1 sample       a line is a rectangle around it; a pixel has it or has it not
//     16 samples     the part of the pixel that the rectangle covers, in sixteenths
//     by distance    a wider rectangle, whose alpha falls from 1 to 0 over a pixel at its edge: α = w/2 + 1/2 − d for a
//                    line of width w at the distance d; blended, at one sample a pixel
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"

enum { PANEL = 120, PANELS = 3, ENLARGED = 3, LINES = 40 };

static const char *const names[PANELS] = {"1 sample", "16 samples", "by distance"};
static const float paper[4] = {0.92f, 0.91f, 0.88f, 1}, ink[4] = {0.02f, 0.05f, 0.15f, 1}, line_width = 1.4f;

struct vertex {
    float position[2]; // pixels from the top left of the panel
    float distance;    // from the line's middle, in pixels
};

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        groups[i].position[0] = groups[i].attribute[0][0] * (2.0f / PANEL) - 1.0f;
        groups[i].position[1] = 1.0f - groups[i].attribute[0][1] * (2.0f / PANEL);
        groups[i].position[2] = rhw_splat(0);
        groups[i].position[3] = rhw_splat(1);
        groups[i].varying[0] = groups[i].attribute[1][0];
    }
}

static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            groups[i].color[0][k] = rhw_splat(ink[k]);
        }
        groups[i].color[0][3] =
            rhw_clamp(0.5f * line_width + 0.5f - rhw_abs(groups[i].varying[0]), 0.0f, 1.0f);
    }
}

// Line `i` of a sun: from its ring outwards.
static void find_line(int i, float from[2], float to[2])
{
    const float angle = 6.28318531f * ((float)i + 0.2f) / LINES, center = 0.5f * PANEL;
    const float direction[2] = {rhw_sin1(angle), rhw_cos1(angle)};
    for (int k = 0; k < 2; k++) {
        from[k] = center + 16.0f * direction[k];
        to[k] = center + (i % 2 ? 44.0f : 55.0f) * direction[k];
    }
}

// Two vertices of each line, or the six of a rectangle that is a pixel wider and longer.
static int fill(struct vertex vertices[6 * LINES], bool by_distance)
{
    int count = 0;
    for (int i = 0; i < LINES; i++) {
        float from[2], to[2];
        find_line(i, from, to);
        if (!by_distance) {
            vertices[count++] = (struct vertex){{from[0], from[1]}, 0};
            vertices[count++] = (struct vertex){{to[0], to[1]}, 0};
            continue;
        }
        const float x = to[0] - from[0], y = to[1] - from[1], scale = 1 / rhw_sqrt1(x * x + y * y);
        const float half = 0.5f * line_width + 1;
        for (int k = 0; k < 6; k++) {
            static const int ends[6] = {0, 1, 1, 0, 1, 0}, sides[6] = {-1, -1, 1, -1, 1, 1};
            const float *end = ends[k] ? to : from, across = (float)sides[k] * half;
            vertices[count++] =
                (struct vertex){{end[0] - y * scale * across, end[1] + x * scale * across}, across};
        }
    }
    return count;
}

// A panel in a texture of PANEL × PANEL pixels.
static void draw(rhw_context *context, rhw_texture target, int panel)
{
    const bool by_distance = panel == 2;
    struct vertex vertices[6 * LINES];
    const int count = fill(vertices, by_distance);
    struct rhw_pipeline_def def = {
        .program = {.vertex = {place},
                    .fragment = {paint},
                    .varyings = {{.components = 1, .qualifier = RHW_NOPERSPECTIVE}},
                    .varying_count = 1},
        .attributes = {{RHW_VERTEX_FLOAT2, 0, offsetof(struct vertex, position)},
                       {RHW_VERTEX_FLOAT1, 0, offsetof(struct vertex, distance)}},
        .attribute_count = 2,
        .buffer_count = 1,
        .topology = by_distance ? RHW_TRIANGLE_LIST : RHW_LINE_LIST,
        .line_width = by_distance ? 0 : line_width,
        .targets = {{.format = rhw_texture_format(context, target), .blend = by_distance}},
        .target_count = 1,
        .label = names[panel]};
    if (by_distance) {
        def.targets[0].color =
            (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    }
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    struct rhw_pass_def attachments = {.colors = {{.texture = target}},
                                       .color_count = 1,
                                       .samples = panel == 1 ? 16 : 1,
                                       .label = names[panel]};
    memcpy(attachments.colors[0].clear, paper, sizeof paper);
    const rhw_buffer buffer = picture_vertices(context, vertices, (size_t)count * sizeof *vertices);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, buffer, 0);
    rhw_pass_draw(context, pass, 0, (uint32_t)count, 0, 1);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_buffer_destroy(context, buffer);
    rhw_pipeline_destroy(context, pipeline);
}

static void draw_panel(rhw_context *context, int panel, enum rhw_format format, void *pixels)
{
    const rhw_texture target = picture_target(context, format, PANEL, PANEL, 1);
    draw(context, target, panel);
    must(rhw_texture_read(context, target, 0, pixels, 0), "read");
    rhw_texture_destroy(context, target);
}

// The part of the pixel that the lines cover, but for 32 × 32 steps.
static double coverage(int column, int row)
{
    enum { STEPS = 32 };
    int inside = 0;
    for (int i = 0; i < LINES; i++) {
        float from[2], to[2];
        find_line(i, from, to);
        const double x = (double)(to[0] - from[0]), y = (double)(to[1] - from[1]),
                     length = sqrt(x * x + y * y);
        const double middle_x = column + 0.5 - (double)from[0], middle_y = row + 0.5 - (double)from[1];
        if (fabs(middle_x * y - middle_y * x) / length > 0.5 * (double)line_width + 1) {
            continue; // no corner of the pixel is as near
        }
        for (int p = 0; p < STEPS * STEPS; p++) {
            const double dx = column + (p % STEPS + 0.5) / STEPS - (double)from[0],
                         dy = row + (p / STEPS + 0.5) / STEPS - (double)from[1];
            const double along = (dx * x + dy * y) / length, across = (dx * y - dy * x) / length;
            inside += along > 0 && along < length && fabs(across) < 0.5 * (double)line_width;
        }
    }
    return (double)inside / (STEPS * STEPS);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    static uint8_t picture[PANEL * ENLARGED][PANELS * PANEL * ENLARGED][4], panel[PANEL][PANEL][4];
    for (int i = 0; i < PANELS; i++) {
        draw_panel(context, i, RHW_FORMAT_RGBA8_SRGB, panel);
        for (int p = 0; p < PANEL * ENLARGED * PANEL * ENLARGED; p++) {
            const int x = p % (PANEL * ENLARGED), y = p / (PANEL * ENLARGED);
            memcpy(picture[y][i * PANEL * ENLARGED + x], panel[y / ENLARGED][x / ENLARGED], 4);
        }
    }
    picture_write_png(directory, "16_lines.png", PANELS * PANEL * ENLARGED, PANEL * ENLARGED, picture[0][0]);

    static float values[PANEL * PANEL][4];
    static double meant[PANEL * PANEL];
    for (int p = 0; p < PANEL * PANEL; p++) {
        meant[p] = coverage(p % PANEL, p / PANEL);
    }
    printf("ink, and how far pixels are from the part that lines cover:\n");
    for (int i = 0; i < PANELS; i++) {
        double squares = 0, all = 0, exact = 0;
        draw_panel(context, i, RHW_FORMAT_RGBA32_FLOAT, values);
        for (int p = 0; p < PANEL * PANEL; p++) {
            const double part =
                ((double)paper[0] - (double)values[p][0]) / ((double)paper[0] - (double)ink[0]);
            squares += (part - meant[p]) * (part - meant[p]);
            all += part;
            exact += meant[p];
        }
        printf("  %-12s %6.1f pixels of %6.1f, %.4f apart (root mean square)\n", names[i], all, exact,
               sqrt(squares / (PANEL * PANEL)));
    }
    rhw_context_destroy(context);
    return 0;
}
