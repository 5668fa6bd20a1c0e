// SPDX-License-Identifier: MIT
// Lesson 4: what is linear on the screen, and what is not.
//
// A plane runs away from the camera, from W = 1 at the left edge of the screen to W = 8 at the right. The
// lesson asks the pipeline for 1/w and z/w at every pixel of one row and plots them, and w itself:
//
//     1/W_P = r/W_A + s/W_B + t/W_C          a straight line on the screen
//     Z_P/W_P = r·d_A + s·d_B + t·d_C        a straight line too (d = Z/W): this is the depth buffer
//     W_P                                    no straight line: the dashed one is what mixing W itself,
//                                            r·W_A + s·W_B + t·W_C, would give
//
// The stripes on the plane are equally wide in space.
#include <stddef.h>
#include <stdio.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"
#include "plot.h"

enum {
    COLUMNS = 640,
    ROWS = 150,
    ROW = 75,
    COLUMN = 200, // the plane, and the pixel that is explained
    MARGIN = 44,
    GAP = 24,
    WIDTH = COLUMNS + MARGIN + GAP,
    HEIGHT = 4 * (ROWS + GAP) + GAP,
    SCALE = 4,
    SCALE_LEVELS = 3
};

static const float w_left = 1, w_right = 8;

struct corner {
    float clip[4];
    float along; // 0 at the left edge of the plane, 1 at the right
};

// Z = (W − 1)·8/7, so that Z/W runs from 0 to 1.
static const struct corner plane[6] = {
    {{-1, -0.9f, 0, 1}, 0}, {{8, -0.9f, 8, 8}, 1}, {{8, 0.9f, 8, 8}, 1},
    {{-1, -0.9f, 0, 1}, 0}, {{8, 0.9f, 8, 8}, 1},  {{-1, 0.9f, 0, 1}, 0},
};

struct sample {
    float over_w, depth, primitive, covered; // 1/w, z/w
};

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        for (int c = 0; c < 4; c++) {
            groups[i].position[c] = groups[i].attribute[0][c];
        }
        groups[i].varying[0] = groups[i].attribute[1][0];
    }
}

// Eight stripes, one in two darker.
static void stripes(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const rhw_int stripe = rhw_int_from_float(rhw_floor(groups[i].varying[0] * 8.0f));
        const rhw_float shade = rhw_select(-(stripe & 1), 0.45f, 1);
        groups[i].color[0][0] = shade * 0.95f;
        groups[i].color[0][1] = shade * 0.62f;
        groups[i].color[0][2] = shade * 0.25f;
        groups[i].color[0][3] = rhw_splat(1);
    }
}

// 1/w and z/w as the pipeline has them, and the weights on the screen.
static void measure(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        groups[i].color[0][0] = groups[i].coord[3];
        groups[i].color[0][1] = groups[i].coord[2];
        groups[i].color[0][2] = rhw_float_from_int(groups[i].primitive);
        groups[i].color[0][3] = rhw_splat(1);
        for (int k = 0; k < 3; k++) {
            groups[i].color[1][k] = groups[i].barycentric_noperspective[k];
        }
        groups[i].color[1][3] = rhw_splat(1);
    }
}

static rhw_pipeline make_pipeline(rhw_context *context, rhw_fragment_function *fragment, uint32_t uses,
                                  enum rhw_format format, int targets)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){.vertex = {place},
                                       .fragment = {fragment},
                                       .varyings = {{.components = 1}},
                                       .varying_count = 1,
                                       .uses = uses};
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct corner, clip)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT1, 0, offsetof(struct corner, along)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct corner);
    def.buffer_count = 1;
    def.target_count = targets;
    for (int i = 0; i < targets; i++) {
        def.targets[i].format = format;
    }
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

static void draw_plane(rhw_context *context, rhw_pass pass, rhw_pipeline pipeline)
{
    rhw_pass_set_pipeline(context, pass, pipeline);
    const rhw_buffer corners = picture_vertices(context, plane, sizeof plane);
    rhw_pass_set_vertex_buffer(context, pass, 0, corners, 0);
    rhw_pass_draw(context, pass, 0, 6, 0, 1);
    rhw_buffer_destroy(context, corners); // the pass keeps what its draws need
}

// Fills both with COLUMNS × ROWS pixels.
static void measure_plane(rhw_context *context, struct sample *samples, float (*weights)[4])
{
    const enum rhw_format format = RHW_FORMAT_RGBA32_FLOAT;
    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.color_count = 2;
    attachments.colors[0].texture = picture_target(context, format, COLUMNS, ROWS, 1);
    attachments.colors[1].texture = picture_target(context, format, COLUMNS, ROWS, 1);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    const uint32_t uses = RHW_USE_COORD | RHW_USE_IDS | RHW_USE_BARYCENTRIC;
    draw_plane(context, pass, make_pipeline(context, measure, uses, format, 2));
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_texture_read(context, attachments.colors[0].texture, 0, samples, 0);
    rhw_texture_read(context, attachments.colors[1].texture, 0, weights, 0);
}

// One panel: frame, value over column, and a dashed straight line from the first value to the last.
static void plot_values(struct plot *plot, float top, const char *label, const char *highest, float scale,
                        const float values[COLUMNS], const float color[3])
{
    static const float ink[3] = {0.02f, 0.03f, 0.05f}, frame[3] = {0.55f, 0.57f, 0.60f};
    const float bottom = top + ROWS;
    plot_line(plot, MARGIN, bottom, MARGIN + COLUMNS, bottom, 1, frame);
    plot_line(plot, MARGIN, top, MARGIN, bottom, 1, frame);
    plot_line(plot, MARGIN, top, MARGIN + COLUMNS, top, 1, frame);
    plot_line(plot, MARGIN + COLUMNS, top, MARGIN + COLUMNS, bottom, 1, frame);
    plot_text(plot, 20, bottom, 12, "0", ink);
    plot_text(plot, 20, top + 12, 12, highest, ink);
    plot_text(plot, MARGIN + COLUMNS / 2 - 20, top + 34, 20, label, color);

    const float height = ROWS / scale;
    for (int x = 0; x + 1 < COLUMNS; x++) {
        plot_line(plot, MARGIN + (float)x + 0.5f, bottom - values[x] * height, MARGIN + (float)x + 1.5f,
                  bottom - values[x + 1] * height, 3, color);
    }
    const float rise = (values[COLUMNS - 1] - values[0]) / (COLUMNS - 1);
    for (int x = 0; x + 8 < COLUMNS; x += 14) {
        plot_line(plot, MARGIN + (float)x + 0.5f, bottom - (values[0] + rise * (float)x) * height,
                  MARGIN + (float)x + 8.5f, bottom - (values[0] + rise * (float)(x + 8)) * height, 1, ink);
    }
}

static void draw_picture(rhw_context *context, const struct sample *row, rhw_texture target)
{
    static struct plot plot = {.width = WIDTH, .height = HEIGHT};
    static float values[3][COLUMNS];
    static const float colors[3][3] = {{0.02f, 0.25f, 0.62f}, {0.02f, 0.36f, 0.16f}, {0.65f, 0.06f, 0.05f}};
    for (int x = 0; x < COLUMNS; x++) {
        values[0][x] = row[x].over_w;
        values[1][x] = row[x].depth;
        values[2][x] = 1 / row[x].over_w;
    }
    plot_values(&plot, GAP + 1 * (ROWS + GAP), "1/w", "1", 1, values[0], colors[0]);
    plot_values(&plot, GAP + 2 * (ROWS + GAP), "z/w", "1", 1, values[1], colors[1]);
    plot_values(&plot, GAP + 3 * (ROWS + GAP), "w", "8", w_right, values[2], colors[2]);

    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.colors[0].texture = target;
    for (int c = 0; c < 3; c++) {
        attachments.colors[0].clear[c] = 0.93f;
    }
    const enum rhw_format format = RHW_FORMAT_RGBA8_SRGB;
    const struct rhw_viewport panel = {MARGIN * SCALE, GAP * SCALE, COLUMNS * SCALE, ROWS * SCALE, 0, 1};
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    plot_draw(&plot, context, pass, format);
    rhw_pass_set_viewport(context, pass, &panel);
    draw_plane(context, pass, make_pipeline(context, stripes, 0, format, 1));
    must(rhw_pass_end(context, pass, NULL), "pass");
}

static void explain(const struct sample *sample, const float weights[4])
{
    const struct corner *corner = &plane[(int)sample->primitive * 3];
    printf("pixel %d, %d lies in triangle %d with r = %.6f, s = %.6f, t = %.6f\n", COLUMN, ROW,
           (int)sample->primitive, (double)weights[0], (double)weights[1], (double)weights[2]);
    double over_w = 0, depth = 0, mixed = 0;
    for (int k = 0; k < 3; k++) {
        over_w += (double)weights[k] / (double)corner[k].clip[3];
        depth += (double)weights[k] * (double)(corner[k].clip[2] / corner[k].clip[3]);
        mixed += (double)weights[k] * (double)corner[k].clip[3];
    }
    printf("  1/W = %.6f/%g + %.6f/%g + %.6f/%g = %.7f    the pipeline's 1/w: %.7f\n", (double)weights[0],
           (double)corner[0].clip[3], (double)weights[1], (double)corner[1].clip[3], (double)weights[2],
           (double)corner[2].clip[3], over_w, (double)sample->over_w);
    printf("  Z/W = r*d_A + s*d_B + t*d_C = %.7f             the pipeline's z/w: %.7f\n", depth,
           (double)sample->depth);
    printf("  W = 1/(1/W) = %.6f, where mixing W itself would give %.6f\n", 1 / over_w, mixed);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    static struct sample samples[ROWS][COLUMNS];
    static float weights[ROWS][COLUMNS][4];
    rhw_context *context = picture_context();
    measure_plane(context, samples[0], weights[0]);
    printf("a plane from W = %g at the left edge to W = %g at the right\n", (double)w_left, (double)w_right);
    explain(&samples[ROW][COLUMN], weights[ROW][COLUMN]);

    const rhw_texture picture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, WIDTH * SCALE, HEIGHT * SCALE, SCALE_LEVELS);
    draw_picture(context, samples[ROW], picture);
    rhw_texture_generate_mips(context, picture);
    picture_save(context, picture, SCALE_LEVELS - 1, directory, "04_depth.png");
    rhw_context_destroy(context);
    return 0;
}
