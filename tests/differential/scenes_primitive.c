// SPDX-License-Identifier: MIT
// Points, lines, strips, fans, restart, indices, instances.
#include <string.h>

#include "scenes.h"

static const float white[4] = {1, 1, 1, 1};

static void paint_point(struct rhw_fragment1 *f)
{
    f->color[0][0] = f->point_coord[0];
    f->color[0][1] = f->point_coord[1];
    f->color[0][2] = f->varying[4];
    f->color[0][3] = 1;
}

// The peer counts gl_PointCoord from its top, which y turns.
static const struct shader_pair point_color = {
    .fragment = "out vec4 color; void main() { color = vec4(gl_PointCoord.x, 1.0 - gl_PointCoord.y, "
                "flat_values.x, 1); }",
    .fragment1 = paint_point,
    .uses = RHW_USE_POINT_COORD,
    .writes_point_size = true};
static void paint_flat_point(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying + 4, sizeof f->color[0]);
    f->color[0][3] = 1;
}

static const struct shader_pair point_dot = {
    .fragment = "out vec4 color; void main() { color = vec4(flat_values.rgb, 1); }",
    .fragment1 = paint_flat_point,
    .writes_point_size = true};

static void add_points(struct frame *f, int count, const struct shader_pair *shaders, int sizes, double part)
{
    for (int i = 0; i < count; i++) {
        const float value[4] = {frame_random_part(f), frame_random_part(f), frame_random_part(f),
                                (float)(1 + frame_random(f, sizes))};
        frame_add_vertex(f, frame_vertex_at(f, frame_random(f, f->width) + part,
                                            frame_random(f, f->height) + part, 0, value));
    }
    struct frame_draw draw = frame_draw_default(f, shaders);
    draw.state.topology = RHW_POINT_LIST;
    frame_add_draw(f, draw);
}

static void points_one(struct frame *f)
{
    frame_begin(f, 128, 128);
    add_points(f, 500, &point_dot, 1, 0.5 + 1.0 / 256);
    add_points(f, 500, &point_dot, 1, 0.25 + 1.0 / 256);
}

static void points(struct frame *f)
{
    frame_begin(f, 256, 256);
    add_points(f, 60, &point_dot, 24, 0.125 + 1.0 / 256);
    add_points(f, 60, &point_dot, 24, 0.75 + 1.0 / 256);
}

static void point_coordinates(struct frame *f)
{
    frame_begin(f, 256, 256);
    add_points(f, 60, &point_color, 40, 0.125 + 1.0 / 256);
}

static struct frame_vertex random_vertex(struct frame *f)
{
    const float value[4] = {frame_random_part(f), frame_random_part(f), frame_random_part(f), 1};
    return frame_vertex_at(f, (8 + frame_random(f, f->width - 16)) + 1.0 / 256,
                           (8 + frame_random(f, f->height - 16)) + 3.0 / 256, 0, value);
}

static struct frame_draw line_draw(const struct frame *f, const struct shader_pair *shaders,
                                   enum rhw_topology topology, enum rhw_line_mode mode)
{
    struct frame_draw draw = frame_draw_default(f, shaders);
    draw.state.topology = topology;
    draw.state.line_mode = mode;
    return draw;
}

static void lines_level(struct frame *f)
{
    frame_begin(f, 128, 128);
    for (int i = 0; i < 120; i++) {
        struct frame_vertex a = random_vertex(f), b = random_vertex(f);
        const int axis = i % 2;
        b.position[axis] = a.position[axis];
        frame_add_vertex(f, a);
        frame_add_vertex(f, b);
    }
    struct frame_draw draw = frame_draw_default(f, &flat_color);
    draw.state.topology = RHW_LINE_LIST;
    frame_add_draw(f, draw);
}

static void add_lines(struct frame *f, int vertices, const struct shader_pair *shaders,
                      enum rhw_topology topology, enum rhw_line_mode mode, float width)
{
    frame_begin(f, 256, 256);
    for (int i = 0; i < vertices; i++) {
        frame_add_vertex(f, random_vertex(f));
    }
    struct frame_draw draw = line_draw(f, shaders, topology, mode);
    draw.state.line_width = width;
    frame_add_draw(f, draw);
}

static void lines(struct frame *f)
{
    add_lines(f, 80, &flat_color, RHW_LINE_LIST, RHW_LINE_BRESENHAM, 1);
}

static void wide_lines(struct frame *f)
{
    add_lines(f, 60, &flat_color, RHW_LINE_LIST, RHW_LINE_BRESENHAM, 5);
}

static void line_strip(struct frame *f)
{
    add_lines(f, 30, &smooth_color, RHW_LINE_STRIP, RHW_LINE_BRESENHAM, 1);
}

static void line_loop(struct frame *f)
{
    add_lines(f, 30, &flat_color, RHW_LINE_LOOP, RHW_LINE_BRESENHAM, 1);
}

static void rectangles(struct frame *f)
{
    add_lines(f, 80, &flat_color, RHW_LINE_LIST, RHW_LINE_RECTANGULAR, 1);
}

static void wide_rectangles(struct frame *f)
{
    add_lines(f, 60, &flat_color, RHW_LINE_LIST, RHW_LINE_RECTANGULAR, 5);
}

// A strip, and a fan, of corners on a grid, flat: the provoking vertex is the last.
static void strips(struct frame *f)
{
    frame_begin(f, 256, 256);
    for (int row = 0; row < 6; row++) {
        for (int i = 0; i < 24; i++) {
            struct frame_vertex v = random_vertex(f);
            const struct frame_vertex place =
                frame_vertex_at(f, 4 + 10 * i + 1.0 / 256, 6 + 40 * row + 30 * (i & 1) + 1.0 / 256, 0, white);
            memcpy(v.position, place.position, sizeof v.position);
            frame_add_vertex(f, v);
        }
        struct frame_draw draw = frame_draw_default(f, row & 1 ? &smooth_color : &flat_color);
        draw.state.topology = RHW_TRIANGLE_STRIP;
        draw.state.cull = row > 3 ? RHW_CULL_BACK : RHW_CULL_NONE;
        frame_add_draw(f, draw);
    }
}

static void fans(struct frame *f)
{
    static const int rim[9][2] = {{30, 0},   {21, -21}, {0, -30}, {-21, -21}, {-30, 0},
                                  {-21, 21}, {0, 30},   {21, 21}, {30, 0}};
    frame_begin(f, 256, 256);
    for (int n = 0; n < 9; n++) {
        for (int i = -1; i < 9; i++) {
            struct frame_vertex v = random_vertex(f);
            const double x = 43 + 80 * (n % 3) + (i < 0 ? 5 : rim[i][0]),
                         y = 43 + 80 * (n / 3) + (i < 0 ? 3 : rim[i][1]);
            const struct frame_vertex place = frame_vertex_at(f, x + 1.0 / 256, y + 3.0 / 256, 0, white);
            memcpy(v.position, place.position, sizeof v.position);
            frame_add_vertex(f, v);
        }
        struct frame_draw draw = frame_draw_default(f, n & 1 ? &smooth_color : &flat_color);
        draw.state.topology = RHW_TRIANGLE_FAN;
        frame_add_draw(f, draw);
    }
}

// Indices into one set of vertices, with restarts.
static void add_restarts(struct frame *f, const enum rhw_topology *topologies, int count)
{
    enum { EACH = 60 };
    frame_begin(f, 256, 256);
    for (int i = 0; i < 80; i++) {
        frame_add_vertex(f, random_vertex(f));
    }
    for (int t = 0; t < count; t++) {
        for (int i = 0; i < EACH; i++) {
            f->indices[f->index_count++] = frame_random(f, 6) == 0 ? 0xffff : (uint16_t)frame_random(f, 80);
        }
        struct frame_draw draw = frame_draw_default(f, &flat_color);
        draw.state.topology = topologies[t];
        draw.state.primitive_restart = true;
        draw.state.line_mode = RHW_LINE_BRESENHAM;
        struct frame_draw *const added = frame_add_draw(f, draw);
        added->indexed = true;
        added->first = t * EACH;
        added->count = EACH;
    }
}

static void restarts(struct frame *f)
{
    static const enum rhw_topology topologies[] = {RHW_TRIANGLE_STRIP, RHW_TRIANGLE_FAN, RHW_TRIANGLE_LIST,
                                                   RHW_POINT_LIST};
    add_restarts(f, topologies, 4);
}

static void line_restarts(struct frame *f)
{
    static const enum rhw_topology topologies[] = {RHW_LINE_STRIP, RHW_LINE_LIST};
    add_restarts(f, topologies, 2);
}

static void paint_instance(struct rhw_fragment1 *f)
{
    f->color[0][0] = f->varying[10];
    f->color[0][1] = f->varying[11];
    f->color[0][2] = f->varying[0];
    f->color[0][3] = 1;
}

static const struct shader_pair instance_color = {
    .fragment = "out vec4 color; void main() { color = vec4(instance_values.zw, values.x, 1); }",
    .fragment1 = paint_instance};

static void instances(struct frame *f)
{
    frame_begin(f, 256, 256);
    for (int i = 0; i < FRAME_INSTANCES; i++) {
        const float instance[4] = {(float)(i % 4) / 2, -(float)(i / 4) / 2, (float)i / 16, 1 - (float)i / 16};
        memcpy(f->instances[i], instance, sizeof instance);
    }
    for (int step = 1; step <= 3; step++) {
        static const float low[4] = {0, 0, 0, 0}, high[4] = {1, 1, 1, 1};
        struct frame_draw draw = frame_draw_default(f, &instance_color);
        frame_add_quad(f, 2 + 18 * (step - 1) + 1.0 / 256, 4 + 1.0 / 256, 16, 40, 0, low, high);
        draw.instances = 16;
        draw.instance_step = step;
        frame_add_draw(f, draw);
    }
}

static void place_by_id(struct rhw_vertex1 *v)
{
    memcpy(v->position, v->attribute[0], sizeof v->position);
    v->point_size = 1;
    for (int c = 0; c < 4; c++) {
        v->varying[c] = v->varying[4 + c] =
            (float)((v->vertex_index * (c + 1) + v->instance_index * 31) % 64) / 64;
        v->varying[8 + c] = 0;
    }
}

static void paint_ids(struct rhw_fragment1 *f)
{
    memcpy(f->color[0], f->varying + 4, sizeof f->color[0]);
}

static const struct shader_pair id_color = {
    .fragment = "out vec4 color; void main() { color = flat_values; }",
    .fragment1 = paint_ids,
    .vertex = "gl_Position = position; ivec4 id = (ivec4(gl_VertexID) * ivec4(1, 2, 3, 4) + gl_InstanceID * "
              "31) % 64;\n"
              "flat_values = values = vec4(id) / 64.0;\n",
    .vertex1 = place_by_id};

static void ids(struct frame *f)
{
    frame_begin(f, 256, 256);
    for (int i = 0; i < 4; i++) {
        struct frame_draw draw = frame_draw_default(f, &id_color);
        draw.instances = 1 + i;
        frame_add_triangles(f, 20, 100);
        frame_add_draw(f, draw);
    }
}

struct scene_list primitive_scenes(void)
{
    static const struct scene scenes[] = {
        {"points of one pixel", points_one, NULL, 0, 0},
        {"points with sizes", points, NULL, 0, 0},
        {"point coordinates", point_coordinates, NULL, 0, 0},
        {"level and upright lines", lines_level, NULL, 0, 0},
        {"lines", lines, NULL, 0, 0},
        {"lines 5 pixels wide", wide_lines, NULL, 0, 0},
        {"line strip", line_strip,
         "a value is taken where the line is nearest to the pixel's centre here (the formula of OpenGL ES "
         "and Vulkan), and where it passes "
         "the middle of the column or row there",
         2, 2},
        {"line loop", line_loop, NULL, 0, 0},
        {"lines as rectangles", rectangles,
         "here a line is a rectangle one pixel across (Vulkan, rectangular lines), there one pixel of each "
         "column or row that "
         "its longer axis passes (diamond exit): fewer where it is slanted",
         400, 255},
        {"rectangles 5 pixels wide", wide_rectangles,
         "here a line is a rectangle 5 pixels across (Vulkan, rectangular lines), there 5 pixels of each "
         "column or row "
         "that its longer axis passes",
         1400, 255},
        {"triangle strips", strips, NULL, 0, 0},
        {"triangle fans", fans, NULL, 0, 0},
        {"indices with restart", restarts, NULL, 0, 0},
        {"lines with restart", line_restarts, NULL, 0, 0},
        {"instances with divisors", instances, NULL, 0, 0},
        {"vertex and instance ids", ids, NULL, 0, 0},
    };
    return (struct scene_list){scenes, sizeof scenes / sizeof *scenes};
}
