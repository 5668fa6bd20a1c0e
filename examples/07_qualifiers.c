// SPDX-License-Identifier: MIT
// Lesson 7: the three ways a value travels across a triangle, side by side.
//
// The triangle lies on the ground: two corners near the eye (W = 1), the third far away (W = 6).
//
//     RHW_SMOOTH          I_P = a·I_A + b·I_B + c·I_C    the lines are evenly spaced on the ground
//     RHW_NOPERSPECTIVE   I_P = r·I_A + s·I_B + t·I_C    the lines are evenly spaced on the screen
//     RHW_FLAT            I_P = I_A                      the provoking corner's value, here the first's
//
// with a = r·W_P/W_A, … and 1/W_P = r/W_A + s/W_B + t/W_C.
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"

enum { PANEL = 300, LINES = 8, SCALE = 4, SCALE_LEVELS = 3 };

struct corner {
    float clip[4];
    float color[3]; // linear light
    float distance; // along the ground: 0 near, 1 at the far corner
};

static const struct corner triangle[3] = {
    {{-0.90f, -0.80f, 0, 1}, {0.90f, 0.16f, 0.06f}, 0},
    {{0.90f, -0.80f, 0, 1}, {0.95f, 0.70f, 0.08f}, 0},
    {{0.60f, 5.10f, 5, 6}, {0.05f, 0.22f, 0.80f}, 1},
};

static const struct {
    enum rhw_qualifier qualifier;
    const char *name;
} panels[3] = {{RHW_SMOOTH, "smooth"}, {RHW_NOPERSPECTIVE, "noperspective"}, {RHW_FLAT, "flat"}};

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_vertex *vertex = &groups[i];
        for (int k = 0; k < 4; k++) {
            vertex->position[k] = vertex->attribute[0][k];
        }
        for (int k = 0; k < 3; k++) {
            vertex->varying[k] = vertex->attribute[1][k];
        }
        vertex->varying[3] = vertex->attribute[2][0];
    }
}

// The colour, with a line wherever the distance is an odd multiple of 1/16.
static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        const rhw_float *varying = groups[i].varying;
        const rhw_int line = rhw_less(rhw_fract(varying[3] * (float)LINES + 0.55f), 0.10f);
        for (int k = 0; k < 3; k++) {
            groups[i].color[0][k] = rhw_select(line, varying[k] * 0.25f, varying[k]);
        }
        groups[i].color[0][3] = rhw_splat(1);
    }
}

// The four values as they are.
static void show_values(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        memcpy(groups[i].color[0], groups[i].varying, 4 * sizeof(rhw_float));
    }
}

static rhw_pipeline make_pipeline(rhw_context *context, rhw_fragment_function *fragment,
                                  enum rhw_format format, enum rhw_qualifier qualifier)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){.vertex = {place},
                                       .fragment = {fragment},
                                       .varyings = {{.components = 4, .qualifier = qualifier}},
                                       .varying_count = 1};
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct corner, clip)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, color)};
    def.attributes[2] = (struct rhw_attribute){RHW_VERTEX_FLOAT1, 0, offsetof(struct corner, distance)};
    def.attribute_count = 3;
    def.buffers[0].stride = sizeof(struct corner);
    def.buffer_count = 1;
    def.targets[0].format = format;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

// The three panels side by side; `size` is a panel's width in pixels of the target.
static void draw(rhw_context *context, rhw_fragment_function *fragment, rhw_texture target, int size)
{
    static const float background[4] = {0.80f, 0.82f, 0.84f, 0};
    const rhw_buffer corners = picture_vertices(context, triangle, sizeof triangle);
    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.colors[0].texture = target;
    memcpy(attachments.colors[0].clear, background, sizeof background);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    for (int i = 0; i < 3; i++) {
        const struct rhw_viewport panel = {(float)(i * size), 0, (float)size, (float)size, 0, 1};
        const enum rhw_format format = rhw_texture_format(context, target);
        rhw_pass_set_pipeline(context, pass, make_pipeline(context, fragment, format, panels[i].qualifier));
        rhw_pass_set_vertex_buffer(context, pass, 0, corners, 0);
        rhw_pass_set_viewport(context, pass, &panel);
        rhw_pass_draw(context, pass, 0, 3, 0, 1);
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture picture =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, 3 * PANEL * SCALE, PANEL * SCALE, SCALE_LEVELS);
    draw(context, paint, picture, PANEL * SCALE);
    rhw_texture_generate_mips(context, picture);
    picture_save(context, picture, SCALE_LEVELS - 1, directory, "07_qualifiers.png");

    static float values[PANEL][3 * PANEL][4];
    const rhw_texture plain = picture_target(context, RHW_FORMAT_RGBA32_FLOAT, 3 * PANEL, PANEL, 1);
    draw(context, show_values, plain, PANEL);
    rhw_texture_read(context, plain, 0, values, 0);
    const int column = PANEL / 2, row = PANEL / 2;
    printf("at pixel %d, %d of each panel      red   green    blue  distance\n", column, row);
    for (int i = 0; i < 3; i++) {
        const float *value = values[row][i * PANEL + column];
        printf("  %-28s %7.4f %7.4f %7.4f   %7.4f\n", panels[i].name, (double)value[0], (double)value[1],
               (double)value[2], (double)value[3]);
    }
    rhw_context_destroy(context);
    return 0;
}
