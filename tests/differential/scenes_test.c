// SPDX-License-Identifier: MIT
// What lets a fragment pass: depth, depth bias, stencil; and whether any did.
#include <math.h>
#include <string.h>

#include "scenes.h"

enum { COMPARES = 8, OPERATIONS = 8, STENCIL_BITS = 8 };

// Every comparison in a strip of its own; a triangle has one depth, or three.
static void compare_depths(struct frame *f, bool sloped)
{
    frame_begin(f, 256, 256);
    f->depth_format = RHW_FORMAT_D32_FLOAT;
    f->depth_clear = 0.5f;
    for (int i = 0; i < COMPARES; i++) {
        struct frame_draw draw = frame_draw_default(f, &flat_color);
        const int first = f->vertex_count;
        frame_add_triangles(f, 120, 80);
        for (int v = first; sloped && v < f->vertex_count; v++) {
            f->vertices[v].position[2] = 2 * frame_random_part(f) - 1;
        }
        draw.state.depth_test = true;
        draw.state.depth_compare = (enum rhw_compare)i;
        draw.scissor = (struct rhw_rect){32 * i, 0, 32, 256};
        frame_add_draw(f, draw);
        frame_add_triangles(f, 30, 80);
        draw.state.depth_compare = RHW_COMPARE_LESS;
        draw.state.depth_read_only = true;
        frame_add_draw(f, draw);
    }
}

static void depth_level(struct frame *f)
{
    compare_depths(f, false);
}

static void depth_sloped(struct frame *f)
{
    compare_depths(f, true);
}

static void depth_16(struct frame *f)
{
    compare_depths(f, false);
    f->depth_format = RHW_FORMAT_D16_UNORM;
}

static void depth_24(struct frame *f)
{
    compare_depths(f, false);
    f->depth_format = RHW_FORMAT_D24_UNORM_S8_UINT;
}

// A plane, and above it cells with another that lies `i` steps off and is moved back by `u` units: it is seen where
// i + u < 0. Depths are about 1/4.
static void add_units(struct frame *f, enum rhw_format format, double step, double odd)
{
    static const float ground[4] = {0.25f, 0.25f, 0.25f, 1};
    frame_begin(f, 128, 128);
    f->depth_format = format;
    struct frame_draw draw = frame_draw_default(f, &flat_color);
    draw.state.depth_test = true;
    frame_add_quad(f, 0, 0, 128, 128, -0.5, ground, ground);
    frame_add_draw(f, draw);
    for (int u = 0; u < 8; u++) {
        for (int i = 0; i < 8; i++) {
            const float color[4] = {(float)i / 8, (float)u / 8, 1, 1};
            frame_add_quad(f, 16 * i, 16 * u, 16, 16, -0.5 + 2 * step * (i - 4 + odd), color, color);
        }
        draw.state.depth_bias.constant = (float)(u - 4);
        frame_add_draw(f, draw);
    }
}

static void units_24(struct frame *f)
{
    add_units(f, RHW_FORMAT_D24_UNORM_S8_UINT, ldexp(1, -24), 0.5);
}

static void units_16(struct frame *f)
{
    add_units(f, RHW_FORMAT_D16_UNORM, ldexp(1, -16), 0.5);
}

static void units_float(struct frame *f)
{
    add_units(f, RHW_FORMAT_D32_FLOAT, ldexp(1, -25), 0);
}

// The same by slope: both planes rise by 1/512 a pixel to the right.
static void slopes(struct frame *f)
{
    static const float ground[4] = {0.25f, 0.25f, 0.25f, 1};
    frame_begin(f, 128, 128);
    f->depth_format = RHW_FORMAT_D32_FLOAT;
    struct frame_draw draw = frame_draw_default(f, &flat_color);
    draw.state.depth_test = true;
    for (int pass = 0; pass < 9; pass++) {
        const int u = pass - 1, first = f->vertex_count;
        for (int i = 0; i < 8; i++) {
            const float color[4] = {(float)i / 8, (float)u / 8, 1, 1};
            for (int row = pass == 0 ? 0 : u; row < (pass == 0 ? 8 : u + 1); row++) {
                frame_add_quad(f, 16 * i, 16 * row, 16, 16, pass == 0 ? 0 : (i - 4 + 0.5) / 256,
                               pass == 0 ? ground : color, pass == 0 ? ground : color);
            }
        }
        for (int v = first; v < f->vertex_count; v++) {
            float *const p = f->vertices[v].position;
            p[2] += p[0] / 4 - 0.25f;
        }
        draw.state.depth_bias.slope = pass == 0 ? 0 : (float)(u - 4);
        frame_add_draw(f, draw);
    }
}

static struct frame_draw stencil_draw(const struct frame *f)
{
    struct frame_draw draw = frame_draw_default(f, &flat_color);
    draw.state.stencil_test = true;
    return draw;
}

// Adds what the stencil holds, bit by bit, as red.
static void show_stencil(struct frame *f)
{
    for (int bit = 0; bit < STENCIL_BITS; bit++) {
        const float color[4] = {(float)(1 << bit) / 255, 0, 0, 0};
        struct frame_draw draw = stencil_draw(f);
        draw.state.stencil_front = (struct rhw_stencil_face){
            .compares = true, .compare = RHW_COMPARE_EQUAL, .read_mask = (uint16_t)(1 << bit)};
        draw.state.stencil_back = draw.state.stencil_front;
        draw.reference_front = draw.reference_back = 255;
        draw.state.targets[0].blend = true;
        draw.state.targets[0].color = draw.state.targets[0].alpha =
            (struct rhw_blend_component){RHW_BLEND_ONE, RHW_BLEND_ONE, RHW_BLEND_ADD};
        frame_add_quad(f, 0, 0, f->width, f->height, 0, color, color);
        frame_add_draw(f, draw);
    }
}

// Random triangles of both facings with every operation in every place, and masks.
static void stencil_operations(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->depth_format = RHW_FORMAT_D24_UNORM_S8_UINT;
    f->stencil_clear = 3;
    for (int i = 0; i < 3 * OPERATIONS; i++) {
        struct frame_draw draw = stencil_draw(f);
        frame_add_triangles(f, 12, 160);
        const struct rhw_stencil_face front = {
            .compares = true,
            .compare = (enum rhw_compare)frame_random(f, COMPARES),
            .fail = (enum rhw_stencil_operation)(i % OPERATIONS),
            .depth_fail = (enum rhw_stencil_operation)((i + 3) % OPERATIONS),
            .pass = (enum rhw_stencil_operation)((i * 5 + 1) % OPERATIONS),
            .read_mask = i % 3 ? 0 : 0x5a,
            .write_mask = i % 5 ? 0 : 0xf3,
        };
        draw.state.stencil_front = draw.state.stencil_back = front;
        draw.state.stencil_back.pass = (enum rhw_stencil_operation)((i * 3 + 2) % OPERATIONS);
        draw.state.stencil_back.compare = (enum rhw_compare)frame_random(f, COMPARES);
        draw.reference_front = (uint8_t)frame_random(f, 256);
        draw.reference_back = (uint8_t)frame_random(f, 256);
        draw.state.depth_test = i % 2 == 0;
        draw.state.targets[0].write_mask = RHW_WRITE_GREEN | RHW_WRITE_BLUE | RHW_WRITE_ALPHA;
        frame_add_draw(f, draw);
    }
    show_stencil(f);
}

// Each comparison in a cell, against what earlier triangles have left.
static void stencil_compares(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->depth_format = RHW_FORMAT_D32_FLOAT_S8_UINT;
    struct frame_draw draw = stencil_draw(f);
    draw.state.stencil_front.pass = draw.state.stencil_back.pass = RHW_STENCIL_INCREMENT_CLAMP;
    draw.state.targets[0].write_mask = RHW_WRITE_NONE;
    frame_add_triangles(f, 100, 120);
    frame_add_draw(f, draw);
    for (int i = 0; i < COMPARES; i++) {
        const float color[4] = {1, (float)i / 8, 0.5f, 1};
        draw = stencil_draw(f);
        draw.state.stencil_front.compares = draw.state.stencil_back.compares = true;
        draw.state.stencil_front.compare = draw.state.stencil_back.compare = (enum rhw_compare)i;
        draw.reference_front = draw.reference_back = 3;
        frame_add_quad(f, 32 * i, 0, 32, 256, 0, color, color);
        frame_add_draw(f, draw);
    }
}

static void paint_depth(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying + 4, sizeof f->color[0]);
    f->depth = f->varying[0];
}

static const struct shader_pair depth_color = {
    .fragment = "out vec4 color; void main() { color = flat_values; gl_FragDepth = flat_values.x; }",
    .fragment1 = paint_depth,
    .uses = RHW_USE_DEPTH};

static void written_depth(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->depth_format = RHW_FORMAT_D32_FLOAT;
    struct frame_draw draw = frame_draw_default(f, &depth_color);
    draw.state.depth_test = true;
    frame_add_triangles(f, 200, 100);
    for (int v = 0; v < f->vertex_count; v++) { // the same at all corners
        f->vertices[v].value[0] = f->vertices[v / 3 * 3].value[0];
    }
    frame_add_draw(f, draw);
}

static void queries(struct frame *f)
{
    frame_begin(f, 256, 256);
    f->depth_format = RHW_FORMAT_D32_FLOAT;
    f->extra = FRAME_OCCLUSION;
    for (int i = 0; i < 100; i++) {
        struct frame_draw draw = frame_draw_default(f, &flat_color);
        draw.state.depth_test = true;
        frame_add_triangles(f, i < 5 ? 40 : 1, i < 5 ? 120 : 4);
        frame_add_draw(f, draw);
    }
    f->number_count = f->draw_count;
}

// With units twice as large 8 of the 64 cells are seen, or not, where they would not be otherwise.
static const char two_steps[] =
    "a unit is one step of the format here, two there, which OpenGL and Vulkan both allow";

struct scene_list test_scenes(void)
{
    static const struct scene scenes[] = {
        {"depth comparisons", depth_level, NULL, 0, 0},
        {"depth comparisons, slopes", depth_sloped, NULL, 0, 0},
        {"depth of 16 bits", depth_16, NULL, 0, 0},
        {"depth of 24 bits", depth_24, NULL, 0, 0},
        {"polygon offset, units of 24 bits", units_24, two_steps, 2048, 255},
        {"polygon offset, units of 16 bits", units_16, two_steps, 2048, 255},
        {"polygon offset, units of floats", units_float, NULL, 0, 0},
        {"polygon offset, factor", slopes, NULL, 0, 0},
        {"stencil operations, two-sided", stencil_operations, NULL, 0, 0},
        {"stencil comparisons", stencil_compares, NULL, 0, 0},
        {"depth from the fragment function", written_depth, NULL, 0, 0},
        {"occlusion queries", queries, NULL, 0, 0},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
