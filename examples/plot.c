// SPDX-License-Identifier: MIT
// See plot.h.
#include "plot.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include <rhw/shader.h>

#include "picture.h"

// Glyphs on a grid of 4 × 6 units, y up. Four digits are a stroke: x, y of its ends.
struct glyph {
    char character;
    int advance; // units
    const char *strokes;
};

static const struct glyph glyphs[] = {
    {'0', 6, "10303041414545363616160505010110"},
    {'1', 5, "04262620"},
    {'2', 6, "06464643430303000040"},
    {'3', 6, "0646464040000343"},
    {'4', 6, "060202424640"},
    {'5', 6, "46060603034343404000"},
    {'6', 6, "46060600004040434303"},
    {'7', 6, "06464610"},
    {'8', 6, "103030414142423333131302020101103344444545363616160505040413"},
    {'9', 6, "43030306064646404000"},
    {'.', 3, "1010"},
    {'/', 6, "0046"},
    {'-', 6, "0343"},
    {'=', 6, "02420444"},
    {' ', 4, ""},
    {'w', 6, "0410102323303044"},
    {'z', 6, "044444000040"},
    {'x', 6, "04400044"},
    {'A', 6, "002626401232"},
    {'B', 6, "0006063636454544443303333342424141303000"},
    {'C', 6, "361616050501011010303041"},
};

static void push_quad(struct plot *plot, const float corner[4][2], const float color[3])
{
    static const int order[6] = {0, 1, 2, 0, 2, 3};
    if (plot->strokes == PLOT_MAX_STROKES) {
        return;
    }
    struct plot_vertex *vertices = plot->vertices + plot->strokes++ * 6;
    for (int i = 0; i < 6; i++) {
        vertices[i].x = corner[order[i]][0];
        vertices[i].y = corner[order[i]][1];
        memcpy(vertices[i].color, color, sizeof vertices[i].color);
    }
}

void plot_line(struct plot *plot, float x0, float y0, float x1, float y1, float width, const float color[3])
{
    const float dx = x1 - x0, dy = y1 - y0;
    const float length = sqrtf(dx * dx + dy * dy);
    // Half a width along and across the stroke; a stroke of no length is a square dot.
    const float ax = length > 0 ? dx / length * width / 2 : width / 2;
    const float ay = length > 0 ? dy / length * width / 2 : 0;
    const float corner[4][2] = {{x0 - ax - ay, y0 - ay + ax},
                                {x0 - ax + ay, y0 - ay - ax},
                                {x1 + ax + ay, y1 + ay - ax},
                                {x1 + ax - ay, y1 + ay + ax}};
    push_quad(plot, corner, color);
}

void plot_rectangle(struct plot *plot, float x, float y, float width, float height, const float color[3])
{
    const float corner[4][2] = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
    push_quad(plot, corner, color);
}

static const struct glyph *find_glyph(char character)
{
    for (size_t i = 0; i < sizeof glyphs / sizeof glyphs[0]; i++) {
        if (glyphs[i].character == character) {
            return &glyphs[i];
        }
    }
    return NULL;
}

float plot_text(struct plot *plot, float x, float y, float height, const char *text, const float color[3])
{
    const float unit = height / 6;
    for (; *text; text++) {
        const struct glyph *glyph = find_glyph(*text);
        if (!glyph) {
            continue;
        }
        for (const char *end = glyph->strokes; *end; end += 4) {
            plot_line(plot, x + unit * (float)(end[0] - '0'), y - unit * (float)(end[1] - '0'),
                      x + unit * (float)(end[2] - '0'), y - unit * (float)(end[3] - '0'), height / 7, color);
        }
        x += unit * (float)glyph->advance;
    }
    return x;
}

static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_vertex *vertex = &groups[i];
        const float *size = vertex->uniforms;
        vertex->position[0] = vertex->attribute[0][0] * (2 / size[0]) - 1.0f;
        vertex->position[1] = 1.0f - vertex->attribute[0][1] * (2 / size[1]);
        vertex->position[2] = rhw_splat(0);
        vertex->position[3] = rhw_splat(1);
        for (int c = 0; c < 3; c++) {
            vertex->varying[c] = vertex->attribute[1][c];
        }
    }
}

static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            groups[i].color[0][c] = groups[i].varying[c];
        }
        groups[i].color[0][3] = rhw_splat(1);
    }
}

void plot_draw(struct plot *plot, rhw_context *context, rhw_pass pass, enum rhw_format format)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){.vertex = {place},
                                       .fragment = {paint},
                                       .varyings = {{.components = 3, .qualifier = RHW_FLAT}},
                                       .varying_count = 1,
                                       .uniform_size = 2 * sizeof(float)};
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT2, 0, offsetof(struct plot_vertex, x)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct plot_vertex, color)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct plot_vertex);
    def.buffer_count = 1;
    def.targets[0].format = format;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    const size_t count = (size_t)plot->strokes * 6;
    const float size[2] = {(float)plot->width, (float)plot->height};
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(
        context, pass, 0, picture_vertices(context, plot->vertices, count * sizeof plot->vertices[0]), 0);
    rhw_pass_set_uniforms(context, pass, size, sizeof size);
    rhw_pass_draw(context, pass, 0, (uint32_t)count, 0, 1);
    plot->strokes = 0;
}
