// SPDX-License-Identifier: MIT
// Lesson 15: blending depends on the order. Three panes of glass one behind the other, over an opaque board:
//
//     result = a·source + (1 − a)·what is there        "over"
//
// is right for the pane in front when everything behind it is there already. From left to right:
//
//     as listed      the nearest is drawn first: it is blended under the others
//     with depth     the same; depth is written, so that what comes later, behind it, is not drawn at all
//     sorted         the farthest first: each is blended over what is behind it
//     filtered       what is there times a·source + 1 − a, as coloured glass lets light through: products know no order
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"

enum { PANEL = 240, PANELS = 4, PANES = 3, SCALE = 4, SCALE_LEVELS = 3 };

// Nearest first. x0, y0, x1, y1 of the panel, −1..1; colours in linear light.
static const struct pane {
    float depth, rectangle[4], color[4];
} panes[PANES] = {
    {0.2f, {-0.25f, -0.85f, 0.85f, 0.25f}, {0.85f, 0.06f, 0.03f, 0.7f}},
    {0.4f, {-0.55f, -0.35f, 0.30f, 0.75f}, {0.05f, 0.55f, 0.10f, 0.6f}},
    {0.6f, {-0.85f, -0.60f, 0.55f, 0.50f}, {0.03f, 0.12f, 0.80f, 0.5f}},
};
static const float board[2][4] = {{0.85f, 0.84f, 0.80f, 1}, {0.55f, 0.54f, 0.50f, 1}};

struct vertex {
    float position[3], color[4];
};

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        memcpy(groups[i].position, groups[i].attribute[0],
               sizeof groups[i].position); // W: 1, as it is absent
        memcpy(groups[i].varying, groups[i].attribute[1], 4 * sizeof(rhw_float));
    }
}

static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const rhw_int premultiplies = rhw_splat_int(*(const int32_t *)groups[i].uniforms);
        for (int k = 0; k < 4; k++) {
            const rhw_float value = groups[i].varying[k];
            groups[i].color[0][k] =
                k == 3 ? value : rhw_select(premultiplies, value * groups[i].varying[3], value);
        }
    }
}

static void add_rectangle(struct vertex *vertices, const float r[4], float depth, const float color[4])
{
    const float x[6] = {r[0], r[2], r[2], r[0], r[2], r[0]}, y[6] = {r[1], r[1], r[3], r[1], r[3], r[3]};
    for (int k = 0; k < 6; k++) {
        vertices[k] = (struct vertex){{x[k], y[k], depth}, {color[0], color[1], color[2], color[3]}};
    }
}

// The board's two halves, then the panes in the order of the panel.
static void fill(struct vertex vertices[6 * (2 + PANES)], bool sorted)
{
    add_rectangle(vertices, (const float[]){-1, -1, 0, 1}, 0.9f, board[0]);
    add_rectangle(vertices + 6, (const float[]){0, -1, 1, 1}, 0.9f, board[1]);
    for (int i = 0; i < PANES; i++) {
        const struct pane *pane = &panes[sorted ? PANES - 1 - i : i];
        add_rectangle(vertices + 12 + 6 * i, pane->rectangle, pane->depth, pane->color);
    }
}

// Panel −1: the board, which replaces.
static rhw_pipeline make_pipeline(rhw_context *context, enum rhw_format format, int panel)
{
    struct rhw_pipeline_def def = {.program = {.vertex = {place},
                                               .fragment = {paint},
                                               .varyings = {{.components = 4, .qualifier = RHW_FLAT}},
                                               .varying_count = 1,
                                               .uniform_size = sizeof(int32_t)},
                                   .attributes = {{RHW_VERTEX_FLOAT3, 0, offsetof(struct vertex, position)},
                                                  {RHW_VERTEX_FLOAT4, 0, offsetof(struct vertex, color)}},
                                   .attribute_count = 2,
                                   .buffer_count = 1,
                                   .depth_test = true,
                                   .depth_read_only = panel != 1,
                                   .targets = {{.format = format, .blend = panel >= 0}},
                                   .target_count = 1,
                                   .label = "lesson 15"};
    def.targets[0].color =
        (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    if (panel == 3) { // a·source·there + (1 − a)·there: the fragment function has made a·source of the source
        def.targets[0].color =
            (struct rhw_blend_component){RHW_BLEND_DST, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    }
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

// The panels side by side; `size` is a panel's width in pixels of the target.
static void draw(rhw_context *context, rhw_texture target, int size)
{
    const struct rhw_pass_def attachments = {.colors = {{.texture = target}},
                                             .color_count = 1,
                                             .depth = {.enabled = true, .store = RHW_STORE_DISCARD},
                                             .label = "four orders"};
    const rhw_pipeline opaque = make_pipeline(context, rhw_texture_format(context, target), -1);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    for (int i = 0; i < PANELS; i++) {
        const struct rhw_viewport panel = {(float)(i * size), 0, (float)size, (float)size, 0, 1};
        struct vertex vertices[6 * (2 + PANES)];
        fill(vertices, i == 2);
        const rhw_buffer buffer = picture_vertices(context, vertices, sizeof vertices);
        const rhw_pipeline glass = make_pipeline(context, rhw_texture_format(context, target), i);
        const int32_t premultiplies = i == 3 ? -1 : 0;
        rhw_pass_set_pipeline(context, pass, opaque);
        rhw_pass_set_viewport(context, pass, &panel);
        rhw_pass_set_vertex_buffer(context, pass, 0, buffer, 0);
        rhw_pass_set_uniforms(context, pass, &premultiplies, sizeof premultiplies);
        rhw_pass_draw(context, pass, 0, 12, 0, 1);
        rhw_pass_set_pipeline(context, pass, glass);
        rhw_pass_draw(context, pass, 12, 6 * PANES, 0, 1);
        rhw_buffer_destroy(context, buffer); // the pass keeps what it draws until it ends
        rhw_pipeline_destroy(context, glass);
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_pipeline_destroy(context, opaque);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture picture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, PANELS * PANEL * SCALE, PANEL * SCALE, SCALE_LEVELS);
    draw(context, picture, PANEL * SCALE);
    must(rhw_texture_generate_mips(context, picture), "mips");
    picture_save(context, picture, SCALE_LEVELS - 1, directory, "15_order.png");

    static float values[PANEL][PANELS * PANEL][4];
    static const char *const names[PANELS] = {"as listed", "with depth", "sorted", "filtered"};
    const rhw_texture plain = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, PANELS * PANEL, PANEL, 1);
    draw(context, plain, PANEL);
    must(rhw_texture_read(context, plain, 0, values, 0), "read");
    printf("where all three lie over the board:\n");
    for (int i = 0; i < PANELS; i++) {
        const float *p = values[PANEL / 2][i * PANEL + PANEL / 2 + 4];
        printf("  %-10s  red %.4f  green %.4f  blue %.4f\n", names[i], (double)p[0], (double)p[1],
               (double)p[2]);
    }
    rhw_context_destroy(context);
    return 0;
}
