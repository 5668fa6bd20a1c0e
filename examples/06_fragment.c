// SPDX-License-Identifier: MIT
// Lesson 6: what a fragment function can do with its pixel, and what one sample per pixel cannot.
//
// Three panels: the function returns a colour; it returns a colour and an alpha, which the pipeline mixes with
// what is there already,
//
//     result = α·source + (1 − α)·destination;
//
// or it discards the fragment and leaves no trace. The upper row has one sample per pixel, at its centre:
// edges are stairs, and rings finer than a pixel turn into patterns that are not there. The lower row is
// drawn four times as large and averaged, 16 samples per pixel, in linear light.
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"

enum { PANEL = 224, PANELS = 3, SCALE = 4, SCALE_LEVELS = 3, RINGS = 64 };

enum answer { COLOR, BLEND, DISCARD };

struct corner {
    float position[2]; // the panel is −1..1 both ways, y up
    float color[3];    // linear light
};

static const struct corner upright[3] = {
    {{-0.86f, -0.72f}, {0.90f, 0.10f, 0.05f}},
    {{0.82f, -0.58f}, {0.05f, 0.65f, 0.12f}},
    {{0.07f, 0.88f}, {0.06f, 0.15f, 0.90f}},
};
static const struct corner hanging[3] = {
    {{-0.74f, 0.66f}, {0.95f, 0.75f, 0.10f}},
    {{0.12f, -0.90f}, {0.95f, 0.75f, 0.10f}},
    {{0.90f, 0.54f}, {0.95f, 0.75f, 0.10f}},
};
static const float alpha = 0.6f;

static void place(struct rhw_vertex1 *vertex)
{
    const float *position = vertex->attribute[0], *color = vertex->attribute[1];
    vertex->position[0] = position[0];
    vertex->position[1] = position[1];
    vertex->position[2] = 0;
    vertex->position[3] = 1;
    memcpy(vertex->varying, position, 2 * sizeof(float));
    memcpy(vertex->varying + 2, color, 3 * sizeof(float));
}

// Rings of equal area round the panel's centre; every other one is missing.
static bool in_gap(const float position[2])
{
    return (int)((position[0] * position[0] + position[1] * position[1]) * RINGS) % 2 == 1;
}

static void answer(struct rhw_fragment1 *fragment)
{
    const int32_t *kind = fragment->uniforms;
    memcpy(fragment->color[0], fragment->varying + 2, 3 * sizeof(float));
    fragment->color[0][3] = *kind == BLEND ? alpha : 1;
    fragment->discard = *kind == DISCARD && in_gap(fragment->varying);
}

static rhw_pipeline make_pipeline(rhw_context *context, enum rhw_format format)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){
        .vertex1 = place,
        .fragment1 = answer,
        .varyings = {{.components = 2}, {.components = 3}},
        .varying_count = 2,
        .uses = RHW_USE_DISCARD,
        .uniform_size = sizeof(int32_t),
    };
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT2, 0, offsetof(struct corner, position)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, color)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct corner);
    def.buffer_count = 1;
    def.targets[0].format = format;
    def.targets[0].blend = true;
    def.targets[0].color =
        (struct rhw_blend_component){RHW_BLEND_SRC_ALPHA, RHW_BLEND_ONE_MINUS_SRC_ALPHA, RHW_BLEND_ADD};
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

static void draw_triangle(rhw_context *context, rhw_pass pass, enum answer kind,
                          const struct corner corners[3])
{
    const int32_t uniforms = (int32_t)kind;
    const rhw_buffer buffer = picture_vertices(context, corners, 3 * sizeof *corners);
    rhw_pass_set_vertex_buffer(context, pass, 0, buffer, 0);
    rhw_pass_set_uniforms(context, pass, &uniforms, sizeof uniforms);
    rhw_pass_draw(context, pass, 0, 3, 0, 1);
    rhw_buffer_destroy(context, buffer); // the pass keeps what its draws need
}

// The three panels side by side; `size` is a panel's width in pixels of the target's level 0.
static void draw(rhw_context *context, rhw_texture target, int size)
{
    static const float background[4] = {0.015f, 0.02f, 0.03f, 1};
    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.colors[0].texture = target;
    memcpy(attachments.colors[0].clear, background, sizeof background);
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, make_pipeline(context, rhw_texture_format(context, target)));
    for (int kind = COLOR; kind < PANELS; kind++) {
        const struct rhw_viewport panel = {(float)(kind * size), 0, (float)size, (float)size, 0, 1};
        rhw_pass_set_viewport(context, pass, &panel);
        draw_triangle(context, pass, kind == DISCARD ? DISCARD : COLOR, upright);
        if (kind == BLEND) {
            draw_triangle(context, pass, BLEND, hanging);
        }
    }
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_texture_generate_mips(context, target);
}

static void explain(const uint8_t *one, const uint8_t *sixteen)
{
    size_t different = 0;
    for (size_t i = 0; i < (size_t)PANELS * PANEL * PANEL; i++) {
        different += memcmp(one + i * 4, sixteen + i * 4, 3) != 0;
    }
    printf("blend: %g of the yellow triangle over %g of what was there, in linear light\n", (double)alpha,
           1 - (double)alpha);
    printf("16 samples instead of one change %zu of %d pixels\n", different, PANELS * PANEL * PANEL);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const enum rhw_format format = RHW_FORMAT_RGBA8_SRGB;
    const rhw_texture plain = picture_target(context, format, PANELS * PANEL, PANEL, 1);
    const rhw_texture fine =
        picture_target(context, format, PANELS * PANEL * SCALE, PANEL * SCALE, SCALE_LEVELS);
    draw(context, plain, PANEL);
    draw(context, fine, PANEL * SCALE);

    static uint8_t both[2][PANELS * PANEL * PANEL * 4];
    rhw_texture_read(context, plain, 0, both[0], 0);
    rhw_texture_read(context, fine, SCALE_LEVELS - 1, both[1], 0);
    explain(both[0], both[1]);
    picture_write_png(directory, "06_fragment.png", PANELS * PANEL, 2 * PANEL, both[0]);
    rhw_context_destroy(context);
    return 0;
}
