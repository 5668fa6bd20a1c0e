// SPDX-License-Identifier: MIT
// Lesson 5: one triangle by hand, from clip coordinates to a pixel's value.
//
// Corner C lies behind the eye: W = −2. Dividing by it would put C in the wrong half of the picture (left
// panel), so the triangle is cut first, along the near plane (middle), and only what is in front is divided,
// snapped and filled. The value at a pixel still is a mixture of all three corners (right):
//
//     clip       keep Z ≥ 0; an edge is cut at P = A + k·(C − A), k = Z_A/(Z_A − Z_C)   in homogeneous space
//     divide     x = X/W, y = Y/W, d = Z/W
//     raster     column (1 + x)/2·size, row (1 − y)/2·size, rounded to 1/256 pixel; a pixel is covered when
//                its centre is on the inner side of every edge, or on a top or left edge
//     recover    1/W_P = r/W_A + s/W_B + t/W_C,   a = r·W_P/W_A, …,   I_P = a·I_A + b·I_B + c·I_C
//
// Everything is computed here in plain C and compared with what the pipeline says, at every pixel. The exit
// status is 1 where they differ.
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"
#include "plot.h"

enum {
    SIZE = 256,
    COLUMN = 140,
    ROW = 170, // the raster, and the pixel that is explained
    PANEL = 300,
    SCALE = 4,
    SCALE_LEVELS = 3, // the picture
    TARGETS = 4
};

struct corner {
    float clip[4];
    float uv[2];
};

// Z = W − 1: the near plane is one unit in front of the eye, the far plane infinitely far.
static const struct corner triangle[3] = {
    {{-1.75f, 0.375f, 3, 4}, {0, 1}},
    {{2.5f, 4, 9, 10}, {1, 0}},
    {{0.25f, -2, -3, -2}, {0, 0}},
};

// A point of the triangle: where it is, and its weights a, b, c in ABC.
struct point {
    double clip[4];
    double weight[3];
};

struct polygon {
    int count;
    struct point points[4];
    int64_t x_24_8[4], y_24_8[4]; // snapped raster positions
};

struct recovered {
    double over_w, depth;
    double screen[3], space[3]; // r, s, t and a, b, c in ABC
    double uv[2];
};

// What the pipeline gives for a pixel, in the order of its targets.
struct pixel {
    float space[3], covered;
    float screen[3], unused;
    float coord[4]; // x, y, z/w, 1/w
    float smooth_uv[2], noperspective_u, flat_u;
};

// Step 1 --------------------------------------------------------------------------------------------

static struct point cut(const struct point *p, const struct point *q)
{
    const double k = p->clip[2] / (p->clip[2] - q->clip[2]);
    struct point result;
    for (int i = 0; i < 4; i++) {
        result.clip[i] = p->clip[i] + k * (q->clip[i] - p->clip[i]);
    }
    for (int i = 0; i < 3; i++) {
        result.weight[i] = p->weight[i] + k * (q->weight[i] - p->weight[i]);
    }
    return result;
}

// Sutherland and Hodgman: walk round the triangle; keep corners with Z ≥ 0; add a point where an edge
// crosses. The other planes of the view do not meet this triangle.
static struct polygon clip_near(void)
{
    struct point corners[3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 4; k++) {
            corners[i].clip[k] = (double)triangle[i].clip[k];
        }
        for (int k = 0; k < 3; k++) {
            corners[i].weight[k] = i == k;
        }
    }
    struct polygon polygon = {0};
    for (int i = 0; i < 3; i++) {
        const struct point *here = &corners[i], *next = &corners[(i + 1) % 3];
        if (here->clip[2] >= 0) {
            polygon.points[polygon.count++] = *here;
        }
        if ((here->clip[2] >= 0) != (next->clip[2] >= 0)) {
            polygon.points[polygon.count++] = cut(here, next);
        }
    }
    return polygon;
}

// Steps 2 and 3 -------------------------------------------------------------------------------------

static void raster_position(const struct point *point, double position[2])
{
    position[0] = (1 + point->clip[0] / point->clip[3]) / 2 * SIZE;
    position[1] = (1 - point->clip[1] / point->clip[3]) / 2 * SIZE;
}

static void snap(struct polygon *polygon)
{
    for (int i = 0; i < polygon->count; i++) {
        double position[2];
        raster_position(&polygon->points[i], position);
        polygon->x_24_8[i] = (int64_t)rint(position[0] * 256);
        polygon->y_24_8[i] = (int64_t)rint(position[1] * 256);
    }
}

// The corners run clockwise on the screen, so the inside is where every edge function is positive. A
// centre on an edge belongs to it where the edge is a top or a left one.
static bool covers(const struct polygon *polygon, int column, int row)
{
    const int64_t x = column * 256 + 128, y = row * 256 + 128;
    for (int i = 0; i < polygon->count; i++) {
        const int next = (i + 1) % polygon->count;
        const int64_t dx = polygon->x_24_8[next] - polygon->x_24_8[i];
        const int64_t dy = polygon->y_24_8[next] - polygon->y_24_8[i];
        const int64_t edge = dx * (y - polygon->y_24_8[i]) - dy * (x - polygon->x_24_8[i]);
        const bool top_left = dy < 0 || (dy == 0 && dx > 0);
        if (edge < 0 || (edge == 0 && !top_left)) {
            return false;
        }
    }
    return true;
}

// Step 4 --------------------------------------------------------------------------------------------

// r, s, t of the pixel's centre in the triangle of polygon points 0, i, i + 1: areas on the screen.
static void screen_weights(const struct polygon *polygon, int i, int column, int row, double weights[3])
{
    const int index[3] = {0, i, i + 1};
    double p[3][2], whole = 0;
    for (int k = 0; k < 3; k++) {
        raster_position(&polygon->points[index[k]], p[k]);
        p[k][0] -= column + 0.5;
        p[k][1] -= row + 0.5;
    }
    for (int k = 0; k < 3; k++) {
        const double *q = p[(k + 1) % 3], *r = p[(k + 2) % 3];
        weights[k] = q[0] * r[1] - q[1] * r[0];
        whole += weights[k];
    }
    for (int k = 0; k < 3; k++) {
        weights[k] /= whole;
    }
}

// Any triangle of the polygon's fan does: they all lie in one plane. This takes the first.
static struct recovered recover(const struct polygon *polygon, int column, int row)
{
    struct recovered result = {0};
    double weights[3];
    screen_weights(polygon, 1, column, row, weights);
    for (int k = 0; k < 3; k++) {
        const double *clip = polygon->points[k].clip;
        result.over_w += weights[k] / clip[3];
        result.depth += weights[k] * clip[2] / clip[3];
    }
    const double w = 1 / result.over_w;
    for (int k = 0; k < 3; k++) {
        const struct point *point = &polygon->points[k];
        for (int i = 0; i < 3; i++) {
            result.space[i] += weights[k] * w / point->clip[3] * point->weight[i];
        }
    }
    // Backwards for the corners themselves: a = r·W_P/W_A, so r = a·W_A/W_P. Of C, behind the eye, it is
    // negative.
    for (int i = 0; i < 3; i++) {
        result.screen[i] = result.space[i] * (double)triangle[i].clip[3] / w;
        for (int k = 0; k < 2; k++) {
            result.uv[k] += result.space[i] * (double)triangle[i].uv[k];
        }
    }
    return result;
}

// The pipeline's word -------------------------------------------------------------------------------

// Varyings: u, v smooth; u noperspective; u flat.
static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 4; k++) {
            groups[i].position[k] = groups[i].attribute[0][k];
        }
        const rhw_float *uv = groups[i].attribute[1];
        groups[i].varying[0] = groups[i].varying[2] = groups[i].varying[3] = uv[0];
        groups[i].varying[1] = uv[1];
    }
}

static void report(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_fragment *fragment = &groups[i];
        for (int k = 0; k < 3; k++) {
            fragment->color[0][k] = fragment->barycentric[k];
            fragment->color[1][k] = fragment->barycentric_noperspective[k];
        }
        fragment->color[0][3] = rhw_splat(1);
        fragment->color[1][3] = rhw_splat(0);
        for (int k = 0; k < 4; k++) {
            fragment->color[2][k] = fragment->coord[k];
            fragment->color[3][k] = fragment->varying[k];
        }
    }
}

// Twelve fields along each side, tinted by the weights in space.
static void paint(struct rhw_fragment *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_fragment *fragment = &groups[i];
        const rhw_int column = rhw_int_from_float(rhw_floor(fragment->varying[0] * 12.0f));
        const rhw_int row = rhw_int_from_float(rhw_floor(fragment->varying[1] * 12.0f));
        const rhw_float shade = rhw_select(-((column ^ row) & 1), 0.35f, 1);
        for (int k = 0; k < 3; k++) {
            fragment->color[0][k] = shade * (0.12f + 0.88f * fragment->barycentric[k]);
        }
        fragment->color[0][3] = rhw_splat(1);
    }
}

static rhw_pipeline make_pipeline(rhw_context *context, rhw_fragment_function *fragment,
                                  enum rhw_topology topology, enum rhw_format format, int targets)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = (struct rhw_program){
        .vertex = {place},
        .fragment = {fragment},
        .varyings = {{.components = 2},
                     {.components = 1, .qualifier = RHW_NOPERSPECTIVE},
                     {.components = 1, .qualifier = RHW_FLAT}},
        .varying_count = 3,
        .uses = RHW_USE_COORD | RHW_USE_BARYCENTRIC,
    };
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT4, 0, offsetof(struct corner, clip)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT2, 0, offsetof(struct corner, uv)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct corner);
    def.buffer_count = 1;
    def.topology = topology;
    def.target_count = targets;
    for (int i = 0; i < targets; i++) {
        def.targets[i].format = format;
    }
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    return pipeline;
}

// Draws corners into float targets and reads them back as SIZE × SIZE pixels.
static struct rhw_stats ask_pipeline(rhw_context *context, enum rhw_topology topology,
                                     const struct corner *corners, int count, struct pixel *pixels)
{
    static float values[SIZE * SIZE][4];
    const enum rhw_format format = RHW_FORMAT_RGBA32_FLOAT;
    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.color_count = TARGETS;
    for (int i = 0; i < TARGETS; i++) {
        attachments.colors[i].texture = picture_target(context, format, SIZE, SIZE, 1);
    }
    rhw_pass pass;
    struct rhw_stats stats;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, make_pipeline(context, report, topology, format, TARGETS));
    rhw_pass_set_vertex_buffer(context, pass, 0,
                               picture_vertices(context, corners, (size_t)count * sizeof *corners), 0);
    rhw_pass_draw(context, pass, 0, (uint32_t)count, 0, 1);
    must(rhw_pass_end(context, pass, &stats), "pass");
    for (int i = 0; i < TARGETS; i++) {
        rhw_texture_read(context, attachments.colors[i].texture, 0, values, 0);
        for (int k = 0; k < SIZE * SIZE * 4; k++) {
            ((float *)&pixels[k / 4])[i * 4 + k % 4] = values[k / 4][k % 4];
        }
    }
    return stats;
}

// Comparison ----------------------------------------------------------------------------------------

// Eight times the gap between floats near `largest`, the bound the library promises.
static double bound(double largest)
{
    int exponent;
    frexp(largest, &exponent);
    return ldexp(8, exponent - 24);
}

struct comparison {
    const char *what;
    double largest, allowed;
};

static void compare(struct comparison *comparison, double ours, float pipeline)
{
    const double difference = fabs(ours - (double)pipeline);
    // Written so that NaN counts as a difference.
    if (!(difference <= comparison->largest)) {
        comparison->largest = difference == difference ? difference : INFINITY;
    }
}

// 1 where a line of the table is a mismatch.
static int verdict(const char *what, double difference, double allowed)
{
    const bool good = difference <= allowed;
    printf("  %-40s %9.2e   allowed %.2e   %s\n", what, difference, allowed, good ? "ok" : "MISMATCH");
    return !good;
}

// Compares the values of all covered pixels. Returns the count of mismatches.
static int check_values(const struct polygon *polygon, const struct pixel *pixels)
{
    // What the bound is taken of: a, b, c, 1/W and d stay below 1 in front of the near plane, where W = 1;
    // r = a·W_A/W_P and its like reach 0.25·10/1 there.
    struct comparison space = {"a, b, c", 0, bound(1)}, over_w = {"1/w", 0, bound(1)};
    struct comparison depth = {"z/w", 0, bound(1)}, smooth = {"u, v smooth", 0, bound(1)};
    struct comparison screen = {"r, s, t", 0, bound(2.5)};
    struct comparison noperspective = {"u noperspective", 0, bound(2.5)};
    struct comparison flat = {"u flat", 0, 0};
    for (int i = 0; i < SIZE * SIZE; i++) {
        if (!covers(polygon, i % SIZE, i / SIZE)) {
            continue;
        }
        const struct recovered ours = recover(polygon, i % SIZE, i / SIZE);
        double linear = 0;
        for (int k = 0; k < 3; k++) {
            compare(&space, ours.space[k], pixels[i].space[k]);
            compare(&screen, ours.screen[k], pixels[i].screen[k]);
            linear += ours.screen[k] * (double)triangle[k].uv[0];
        }
        compare(&over_w, ours.over_w, pixels[i].coord[3]);
        compare(&depth, ours.depth, pixels[i].coord[2]);
        compare(&smooth, ours.uv[0], pixels[i].smooth_uv[0]);
        compare(&smooth, ours.uv[1], pixels[i].smooth_uv[1]);
        compare(&noperspective, linear, pixels[i].noperspective_u);
        compare(&flat, (double)triangle[0].uv[0], pixels[i].flat_u);
    }
    const struct comparison *all[] = {&over_w, &depth, &space, &screen, &smooth, &noperspective, &flat};
    int mismatches = 0;
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        mismatches += verdict(all[i]->what, all[i]->largest, all[i]->allowed);
    }
    return mismatches;
}

static int check_coverage(const char *what, const struct polygon *polygon, const struct pixel *pixels)
{
    int different = 0;
    for (int i = 0; i < SIZE * SIZE; i++) {
        different += covers(polygon, i % SIZE, i / SIZE) != (pixels[i].covered == 1);
    }
    return verdict(what, different, 0);
}

// Tables --------------------------------------------------------------------------------------------

static void print_steps(const struct polygon *polygon)
{
    printf("corners          X        Y        Z        W\n");
    for (int i = 0; i < 3; i++) {
        const float *clip = triangle[i].clip;
        printf("  %c       %8g %8g %8g %8g\n", 'A' + i, (double)clip[0], (double)clip[1], (double)clip[2],
               (double)clip[3]);
    }
    printf("clip     polygon of %d\n", polygon->count);
    for (int i = 0; i < polygon->count; i++) {
        const struct point *p = &polygon->points[i];
        printf("  P%d      %8g %8g %8g %8g   = %gA + %gB + %gC\n", i, p->clip[0], p->clip[1], p->clip[2],
               p->clip[3], p->weight[0], p->weight[1], p->weight[2]);
    }
    printf("divide         X/W      Y/W      Z/W      1/W\n");
    for (int i = 0; i < polygon->count; i++) {
        const double *clip = polygon->points[i].clip;
        printf("  P%d      %8g %8g %8g %8g\n", i, clip[0] / clip[3], clip[1] / clip[3], clip[2] / clip[3],
               1 / clip[3]);
    }
    printf("raster      column      row   in 1/256 pixel\n");
    for (int i = 0; i < polygon->count; i++) {
        double position[2];
        raster_position(&polygon->points[i], position);
        printf("  P%d      %8g %8g   %lld, %lld\n", i, position[0], position[1],
               (long long)polygon->x_24_8[i], (long long)polygon->y_24_8[i]);
    }
}

static void print_pixel(const struct recovered *ours, const struct pixel *pipeline)
{
    printf("recover  at pixel %d, %d          by hand         pipeline\n", COLUMN, ROW);
    printf("  1/W                       %14.9f   %14.9f\n", ours->over_w, (double)pipeline->coord[3]);
    printf("  Z/W                       %14.9f   %14.9f\n", ours->depth, (double)pipeline->coord[2]);
    for (int k = 0; k < 3; k++) {
        printf("  %c on the screen           %14.9f   %14.9f\n", 'r' + k, ours->screen[k],
               (double)pipeline->screen[k]);
    }
    for (int k = 0; k < 3; k++) {
        printf("  %c in space                %14.9f   %14.9f\n", 'a' + k, ours->space[k],
               (double)pipeline->space[k]);
    }
    for (int k = 0; k < 2; k++) {
        printf("  %c                         %14.9f   %14.9f\n", 'u' + k, ours->uv[k],
               (double)pipeline->smooth_uv[k]);
    }
}

// The picture ---------------------------------------------------------------------------------------

static void plot_edge(struct plot *plot, int panel, const double from[4], const double to[4], float width,
                      const float color[3])
{
    const double radius = PANEL * 0.36, x = PANEL * (panel + 0.5), y = PANEL * 0.54;
    plot_line(plot, (float)(x + from[0] / from[3] * radius), (float)(y - from[1] / from[3] * radius),
              (float)(x + to[0] / to[3] * radius), (float)(y - to[1] / to[3] * radius), width, color);
}

static void plot_outlines(struct plot *plot, const struct polygon *polygon)
{
    static const float frame[3] = {0.20f, 0.22f, 0.26f}, ink[3] = {0.85f, 0.87f, 0.90f};
    static const float wrong[3] = {0.85f, 0.12f, 0.08f}, right[3] = {0.15f, 0.60f, 0.90f};
    static const float near_edge[3] = {0.95f, 0.55f, 0.05f};
    static const double view[4][4] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {1, 1, 0, 1}, {-1, 1, 0, 1}};
    for (int panel = 0; panel < 3; panel++) {
        for (int i = 0; i < 4; i++) {
            plot_edge(plot, panel, view[i], view[(i + 1) % 4], 1, frame);
        }
    }
    double corners[3][4];
    for (int i = 0; i < 12; i++) {
        corners[i / 4][i % 4] = (double)triangle[i / 4].clip[i % 4];
    }
    for (int i = 0; i < 3; i++) {
        plot_edge(plot, 0, corners[i], corners[(i + 1) % 3], 2.5f, wrong);
    }
    for (int i = 0; i < polygon->count; i++) {
        const double *from = polygon->points[i].clip, *to = polygon->points[(i + 1) % polygon->count].clip;
        const bool cut_edge = from[2] == 0 && to[2] == 0;
        plot_edge(plot, 1, from, to, 2.5f, cut_edge ? near_edge : right);
    }
    for (int i = 0; i < 3; i++) {
        const char name[2] = {(char)('A' + i), 0};
        const double radius = PANEL * 0.36, *c = corners[i];
        for (int panel = 0; panel < 2; panel++) {
            if (panel == 0 || c[3] > 0) {
                plot_edge(plot, panel, c, c, 7, ink);
                plot_text(plot, (float)(PANEL * (panel + 0.5) + c[0] / c[3] * radius + (i == 0 ? -18 : 8)),
                          (float)(PANEL * 0.54 - c[1] / c[3] * radius - 6), 11, name, ink);
            }
        }
    }
    for (int i = 0; i < polygon->count; i++) {
        const double *p = polygon->points[i].clip;
        plot_edge(plot, 1, p, p, 7, p[2] == 0 ? near_edge : ink);
    }
}

static void draw_picture(rhw_context *context, const struct polygon *polygon, const char *directory)
{
    static struct plot plot = {.width = 3 * PANEL, .height = PANEL};
    const enum rhw_format format = RHW_FORMAT_RGBA8_SRGB;
    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.colors[0].texture =
        picture_target(context, format, 3 * PANEL * SCALE, PANEL * SCALE, SCALE_LEVELS);
    for (int k = 0; k < 3; k++) {
        attachments.colors[0].clear[k] = 0.012f + 0.003f * (float)k;
    }
    const float side = PANEL * 0.72f * SCALE;
    const struct rhw_viewport view = {PANEL * 2.14f * SCALE, PANEL * 0.18f * SCALE, side, side, 0, 1};
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    plot_outlines(&plot, polygon);
    plot_draw(&plot, context, pass, format);
    rhw_pass_set_pipeline(context, pass, make_pipeline(context, paint, RHW_TRIANGLE_LIST, format, 1));
    rhw_pass_set_vertex_buffer(context, pass, 0, picture_vertices(context, triangle, sizeof triangle), 0);
    rhw_pass_set_viewport(context, pass, &view);
    rhw_pass_draw(context, pass, 0, 3, 0, 1);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_texture_generate_mips(context, attachments.colors[0].texture);
    picture_save(context, attachments.colors[0].texture, SCALE_LEVELS - 1, directory, "05_stages.png");
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    static struct pixel whole[SIZE * SIZE], parts[SIZE * SIZE];
    rhw_context *context = picture_context();
    struct polygon polygon = clip_near();
    snap(&polygon);
    print_steps(&polygon);

    const struct rhw_stats stats = ask_pipeline(context, RHW_TRIANGLE_LIST, triangle, 3, whole);
    const struct recovered ours = recover(&polygon, COLUMN, ROW);
    print_pixel(&ours, &whole[ROW * SIZE + COLUMN]);

    // The polygon cut by hand, given to the pipeline as a fan that needs no clipping.
    struct corner corners[4] = {0};
    for (int i = 0; i < polygon.count * 4; i++) {
        corners[i / 4].clip[i % 4] = (float)polygon.points[i / 4].clip[i % 4];
    }
    ask_pipeline(context, RHW_TRIANGLE_FAN, corners, polygon.count, parts);

    printf("largest differences over all pixels\n");
    const double clipped = (double)stats.triangles_clipped;
    int mismatches = verdict("triangles the pipeline clipped, less 1", fabs(clipped - 1), 0);
    mismatches += check_coverage("pixels covered by one alone", &polygon, whole);
    mismatches += check_coverage("the same, clipped by hand before", &polygon, parts);
    mismatches += check_values(&polygon, whole);
    draw_picture(context, &polygon, directory);
    rhw_context_destroy(context);
    return mismatches ? 1 : 0;
}
