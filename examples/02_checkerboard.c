// SPDX-License-Identifier: MIT
// Lesson 2: the same with texture coordinates, where the eye sees the mistake at once.
//
// The triangle of lesson 1 carries the texture coordinates (0,1), (1,0) and (0,0), and the fragment function
// makes a checkerboard of 10 × 10 fields from them. Left: coordinates mixed with the weights of the screen,
// every field of the same size, the plane looks bent. Right: mixed with the weights in space,
//
//     a = r·W_P/W_A,  b = s·W_P/W_B,  c = t·W_P/W_C,     1/W_P = r/W_A + s/W_B + t/W_C,
//
// and the fields shrink towards the far corner as those of a real board do.
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"

// A panel is a window into a square view of SIZE × SIZE pixels, from column LEFT and row TOP on.
enum {
    SIZE = 720,
    LEFT = 116,
    TOP = 208,
    COLUMNS = 512,
    ROWS = 288,
    FIELDS = 10,
    SCALE = 4,
    SCALE_LEVELS = 3
};

struct corner {
    float camera[3];
    float st[2];
};

static const struct corner triangle[3] = {
    {{13, 34, 114}, {0, 1}},
    {{29, -15, 44}, {1, 0}},
    {{-48, -10, 82}, {0, 0}},
};

// As in lesson 1, without a depth buffer: any Z between 0 and W does.
static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_vertex *vertex = &groups[i];
        const rhw_float *camera = vertex->attribute[0];
        vertex->position[0] = camera[0];
        vertex->position[1] = -camera[1];
        vertex->position[2] = rhw_splat(0);
        vertex->position[3] = camera[2];
        vertex->varying[0] = vertex->attribute[1][0];
        vertex->varying[1] = vertex->attribute[1][1];
    }
}

// A field is light where ⌊10·s⌋ and ⌊10·t⌋ are both even or both odd; with fmod: where
// (fmod(5·s, 1) < ½) = (fmod(5·t, 1) < ½).
static void checker(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_fragment *fragment = &groups[i];
        const rhw_int column = rhw_int_from_float(rhw_floor(fragment->varying[0] * (float)FIELDS));
        const rhw_int row = rhw_int_from_float(rhw_floor(fragment->varying[1] * (float)FIELDS));
        const rhw_int dark = -((column ^ row) & 1);
        fragment->color[0][0] = rhw_select(dark, 0.04f, 0.90f);
        fragment->color[0][1] = rhw_select(dark, 0.10f, 0.86f);
        fragment->color[0][2] = rhw_select(dark, 0.20f, 0.76f);
        fragment->color[0][3] = rhw_splat(1);
    }
}

static struct rhw_viewport panel_viewport(int panel, int scale)
{
    const float size = (float)(SIZE * scale);
    const float x = (float)((panel * COLUMNS - LEFT) * scale), y = (float)(-TOP * scale);
    return (struct rhw_viewport){x, y, size, size, 0, 1};
}

static rhw_pipeline make_pipeline(rhw_context *context, rhw_fragment_function *paint, enum rhw_format format,
                                  enum rhw_qualifier qualifier)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program.vertex[RHW_ISA_BASELINE] = place;
    def.program.fragment[RHW_ISA_BASELINE] = paint;
    def.program.varyings[0] = (struct rhw_varying){.components = 2, .qualifier = qualifier};
    def.program.varying_count = 1;
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, camera)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT2, 0, offsetof(struct corner, st)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct corner);
    def.buffer_count = 1;
    def.targets[0].format = format;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

// Naive and correct beside each other, in a target that is `scale` times the picture.
static void draw(rhw_context *context, rhw_fragment_function *paint, rhw_texture target, int scale)
{
    static const enum rhw_qualifier qualifiers[2] = {RHW_NOPERSPECTIVE, RHW_SMOOTH};
    static const float background[4] = {0.36f, 0.40f, 0.46f, 0};
    const rhw_buffer corners = picture_vertices(context, triangle, sizeof triangle);
    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.colors[0].texture = target;
    memcpy(attachments.colors[0].clear, background, sizeof background);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    for (int panel = 0; panel < 2; panel++) {
        const struct rhw_viewport viewport = panel_viewport(panel, scale);
        const enum rhw_format format = rhw_texture_format(context, target);
        rhw_pass_set_pipeline(context, pass, make_pipeline(context, paint, format, qualifiers[panel]));
        rhw_pass_set_vertex_buffer(context, pass, 0, corners, 0);
        rhw_pass_set_viewport(context, pass, &viewport);
        rhw_pass_draw(context, pass, 0, 3, 0, 1);
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    // 4 × 4 samples a pixel: drawn four times as large, averaged on the way to mip level 2.
    const rhw_texture board =
        picture_target(context, RHW_FORMAT_RGBA8_SRGB, 2 * COLUMNS * SCALE, ROWS * SCALE, SCALE_LEVELS);
    draw(context, checker, board, SCALE);
    rhw_texture_generate_mips(context, board);
    picture_save(context, board, SCALE_LEVELS - 1, directory, "02_checkerboard.png");

    // Where halfway between B and C on the screen lies in space: 1/W = (1/W_B + 1/W_C)/2, b = W/(2·W_B).
    const double b = triangle[1].camera[2], c = triangle[2].camera[2];
    const double w = 2 / (1 / b + 1 / c);
    printf("halfway from B (W = %g) to C (W = %g) on the screen: s is 0.5 naively,\n", b, c);
    printf("but 1/W = 0.5/%g + 0.5/%g gives W = %.3f and b = 0.5 * W/%g = %.4f: field %d, not %d, of %d\n", b,
           c, w, b, w / (2 * b), (int)(FIELDS * w / (2 * b)) + 1, FIELDS / 2 + 1, FIELDS);
    rhw_context_destroy(context);
    return 0;
}
