// SPDX-License-Identifier: MIT
// Coverage, interpolation, culling, viewport and scissor.
#include <string.h>

#include "scenes.h"

static void paint_smooth(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying, sizeof f->color[0]);
}

static void paint_flat(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying + 4, sizeof f->color[0]);
}

const struct shader_pair smooth_color = {.fragment = "out vec4 color; void main() { color = values; }",
                                         .fragment1 = paint_smooth};
const struct shader_pair flat_color = {.fragment = "out vec4 color; void main() { color = flat_values; }",
                                       .fragment1 = paint_flat};

static void coverage(struct frame *f)
{
    frame_begin(f, 256, 256);
    frame_add_triangles(f, 400, 60);
    frame_add_triangles(f, 100, 400);
    frame_add_draw(f, frame_draw_default(f, &flat_color));
}

static void wide_coverage(struct frame *f)
{
    frame_begin(f, 256, 256);
    frame_add_wide_triangles(f, 400, 60);
    frame_add_wide_triangles(f, 100, 400);
    frame_add_draw(f, frame_draw_default(f, &flat_color));
}

static void slivers(struct frame *f)
{
    frame_begin(f, 256, 256);
    for (int i = 0; i < 300; i++) {
        frame_add_triangles(f, 1, 2);
        struct frame_vertex *const v = &f->vertices[f->vertex_count - 1];
        v->position[0] += 1.5f * frame_random_part(f) - 0.75f;
        v->position[1] += 1.5f * frame_random_part(f) - 0.75f;
    }
    frame_add_draw(f, frame_draw_default(f, &flat_color));
}

// Edges through centres of pixels: a mesh of squares whose corners lie on them, split both ways. Each is added to what is
// there, so that a pixel drawn twice or not at all shows.
static void ties(struct frame *f)
{
    static const float one[4] = {0.25f, 0.25f, 0.25f, 0.25f};
    frame_begin(f, 128, 128);
    for (int i = 0; i < 36; i++) {
        frame_add_quad(f, 8.5 + 18 * (i % 6), 8.5 + 18 * (i / 6), 18, 18, 0, one, one);
    }
    struct frame_draw draw = frame_draw_default(f, &flat_color);
    draw.state.targets[0].blend = true;
    draw.state.targets[0].color = draw.state.targets[0].alpha =
        (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
    frame_add_draw(f, draw);
}

static void smooth_values(struct frame *f)
{
    frame_begin(f, 256, 256);
    frame_add_triangles(f, 200, 120);
    frame_add_draw(f, frame_draw_default(f, &smooth_color));
}

// w is 1, 2 or 4 by turns, so that positions stay exact.
static void give_depth(struct frame *f)
{
    for (int i = 0; i < f->vertex_count; i++) {
        const float w = (float)(1 << frame_random(f, 3));
        for (int c = 0; c < 4; c++) {
            f->vertices[i].position[c] *= w;
        }
    }
}

static void perspective(struct frame *f)
{
    frame_begin(f, 256, 256);
    frame_add_triangles(f, 200, 120);
    give_depth(f);
    frame_add_draw(f, frame_draw_default(f, &smooth_color));
}

static void float_perspective(struct frame *f)
{
    frame_begin(f, 128, 128);
    f->formats[0] = RHW_FORMAT_RGBA32_FLOAT;
    frame_add_triangles(f, 60, 120);
    give_depth(f);
    frame_add_draw(f, frame_draw_default(f, &smooth_color));
}

static void paint_derivatives(struct rhw_fragment1 *f)
{
    f->color[0][0] = 0.5f + 8 * f->ddx[0];
    f->color[0][1] = 0.5f + 8 * f->ddy[0];
    f->color[0][2] = 0.5f + 8 * f->ddx[1];
    f->color[0][3] = 0.5f + 8 * f->ddy[1];
}

static const struct shader_pair derivative_color = {
    .fragment = "out vec4 color; void main() { color = 0.5 + 8.0 * vec4(dFdx(values.x), dFdy(values.x), "
                "dFdx(values.y), dFdy(values.y)); }",
    .fragment1 = paint_derivatives,
    .derivatives = true};

static void derivatives(struct frame *f)
{
    frame_begin(f, 256, 256);
    frame_add_triangles(f, 60, 160);
    frame_add_draw(f, frame_draw_default(f, &derivative_color));
}

static void paint_coordinates(struct rhw_fragment1 *f)
{
    f->color[0][0] = f->coord[0] / 256;
    f->color[0][1] = f->coord[1] / 256;
    f->color[0][2] = f->coord[2];
    f->color[0][3] = f->coord[3];
}

static const struct shader_pair coordinate_color = {
    .fragment = "out vec4 color; void main() { color = gl_FragCoord / vec4(256, 256, 1, 1); }",
    .fragment1 = paint_coordinates,
    .uses = RHW_USE_COORD};

static void coordinates(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->formats[0] = RHW_FORMAT_RGBA32_FLOAT;
    frame_add_triangles(f, 100, 120);
    give_depth(f);
    struct frame_draw draw = frame_draw_default(f, &coordinate_color);
    draw.viewport = (struct rhw_viewport){0, 0, 256, 256, 0.25f, 0.75f};
    frame_add_draw(f, draw);
}

static void paint_facing(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying + 4, sizeof f->color[0]);
    f->color[0][0] = f->front_facing ? 1.0f : 0.0f;
}

static const struct shader_pair facing_color = {
    .fragment = "out vec4 color; void main() { color = flat_values; color.r = gl_FrontFacing ? 1.0 : 0.0; }",
    .fragment1 = paint_facing,
    .uses = RHW_USE_FACING};

// Every way of culling and winding in a quarter.
static void culling(struct frame *f)
{
    frame_begin(f, 256, 256);
    for (int i = 0; i < 8; i++) {
        struct frame_draw draw = frame_draw_default(f, &facing_color);
        frame_add_triangles(f, 60, 60);
        draw.state.cull = (enum rhw_cull)(i % 4);
        draw.state.front = (enum rhw_winding)(i / 4);
        frame_add_draw(f, draw);
    }
}

// Corners behind the eye, and beyond every side of the view volume.
static void clipping(struct frame *f)
{
    frame_begin(f, 256, 256);
    for (int i = 0; i < 60; i++) {
        frame_add_wide_triangles(f, 1, 600);
        struct frame_vertex *const v = &f->vertices[f->vertex_count - 3];
        v[0].position[2] = 1.5f;
        v[1].position[2] = -1.25f;
        if (i % 3 == 0) {
            v[2].position[3] = -0.5f;
        }
    }
    frame_add_draw(f, frame_draw_default(f, &smooth_color));
}

static void viewports(struct frame *f)
{
    static const struct rhw_viewport viewports[] = {{-64, -32, 256, 128, 0, 0},
                                                    {128, 100, 300, 300, 0, 0},
                                                    {16, 128, 64, 64, 0, 0},
                                                    {-512, 0, 1024, 64, 0, 0},
                                                    {0, -128, 256, 512, 0, 0}};
    frame_begin(f, 256, 256);
    for (int i = 0; i < 5; i++) {
        struct frame_draw draw = frame_draw_default(f, &smooth_color);
        frame_add_triangles(f, 20, 120);
        draw.viewport = viewports[i];
        frame_add_draw(f, draw);
    }
}

static void scissors(struct frame *f)
{
    frame_begin(f, 256, 256);
    for (int i = 0; i < 12; i++) {
        struct frame_draw draw = frame_draw_default(f, &flat_color);
        frame_add_triangles(f, 30, 200);
        draw.scissor = (struct rhw_rect){frame_random(f, 200), frame_random(f, 200), 1 + frame_random(f, 100),
                                         1 + frame_random(f, 100)};
        frame_add_draw(f, draw);
    }
}

static void paint_disc(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying, sizeof f->color[0]);
    f->discard = f->varying[0] * f->varying[0] + f->varying[1] * f->varying[1] > 0.5f;
}

static const struct shader_pair disc_color = {
    .fragment = "out vec4 color; void main() { color = values;\n"
                "if (values.x * values.x + values.y * values.y > 0.5) { discard; } }",
    .fragment1 = paint_disc,
    .uses = RHW_USE_DISCARD};

static void discarding(struct frame *f)
{
    frame_begin(f, 256, 256);
    for (int i = 0; i < 16; i++) {
        static const float low[4] = {-1, -1, 0, 1}, high[4] = {1, 1, 1, 0.5f};
        frame_add_quad(f, 64 * (i % 4), 64 * (i / 4), 64, 64, 0, low, high);
    }
    frame_add_draw(f, frame_draw_default(f, &disc_color));
}

struct scene_list raster_scenes(void)
{
    static const struct scene scenes[] = {
        {"coverage", coverage, NULL, 0, 0},
        {"coverage of what leaves the target", wide_coverage,
         "the peer cuts triangles at the target's sides and rounds the new corners to 1/256 pixel, which "
         "bends edges; "
         "here edges stay straight",
         2, 255},
        {"coverage of slivers", slivers, NULL, 0, 0},
        {"coverage of edges through centres", ties, NULL, 0, 0},
        {"smooth values", smooth_values, NULL, 0, 0},
        {"perspective values", perspective, NULL, 0, 0},
        {"perspective values, floats", float_perspective, NULL, 0, 0},
        {"derivatives", derivatives, NULL, 0, 0},
        {"fragment coordinates", coordinates, NULL, 0, 0},
        {"facing and culling", culling, NULL, 0, 0},
        {"clipping", clipping, NULL, 0, 0},
        {"viewports off the target", viewports, NULL, 0, 0},
        {"scissors", scissors, NULL, 0, 0},
        {"discard", discarding, NULL, 0, 0},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
