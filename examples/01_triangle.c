// SPDX-License-Identifier: MIT
// Lesson 1: why a colour may not simply be mixed across the screen.
//
// A triangle stands in front of the camera; its corners are 114, 44 and 82 units away. Its picture comes
// from dividing x and y by that distance. The division squeezes what is far: halfway between two corners
// on the screen is not halfway between them in space. Colours mixed with the weights of the screen (r, s, t)
// are therefore wrong, colours mixed with the weights in space (a, b, c) are right:
//
//     naive     I_P = r·I_A + s·I_B + t·I_C             RHW_NOPERSPECTIVE
//     correct   I_P = a·I_A + b·I_B + c·I_C             RHW_SMOOTH
//               a = r·W_P/W_A, …   1/W_P = r/W_A + s/W_B + t/W_C
//
// It draws both, and the depth buffer, which *is* linear on the screen; and it draws once more with
// functions that see one vertex and one fragment at a time, to show that they give the same bytes.
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <rhw/rhw.h>
#include <rhw/shader.h>

#include "picture.h"

enum { SIZE = 512 };

// The depth buffer spreads 0..1 over these distances.
static const float near_plane = 40, far_plane = 200;

struct corner {
    float camera[3]; // right, down, forward
    float color[3];
};

static const struct corner triangle[3] = {
    {{13, 34, 114}, {0, 0, 1}},
    {{29, -15, 44}, {0, 1, 0}},
    {{-48, -10, 82}, {1, 0, 0}},
};

// x/z and y/z shall land at (1 + x/z)/2·512 and (1 + y/z)/2·512 pixels from the top left. The pipeline divides
// by W, so W = z. It then places X/W the same way, but Y/W from the bottom up; so Y = −y and the formula
// holds for rows as it stands.
static void place(struct rhw_vertex *groups, int count)
{
    for (int i = 0; i < count; i++) {
        struct rhw_vertex *vertex = &groups[i];
        const rhw_float *camera = vertex->attribute[0];
        vertex->position[0] = camera[0];
        vertex->position[1] = -camera[1];
        vertex->position[2] = (camera[2] - near_plane) * (far_plane / (far_plane - near_plane));
        vertex->position[3] = camera[2];
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

// The same two functions, one vertex and one fragment at a time.
static void place1(struct rhw_vertex1 *vertex)
{
    const float *camera = vertex->attribute[0];
    vertex->position[0] = camera[0];
    vertex->position[1] = -camera[1];
    vertex->position[2] = (camera[2] - near_plane) * (far_plane / (far_plane - near_plane));
    vertex->position[3] = camera[2];
    memcpy(vertex->varying, vertex->attribute[1], 3 * sizeof(float));
}

static void paint1(struct rhw_fragment1 *fragment)
{
    memcpy(fragment->color[0], fragment->varying, 3 * sizeof(float));
    fragment->color[0][3] = 1;
}

static const struct rhw_program by_lanes = {.vertex = {place}, .fragment = {paint}};
static const struct rhw_program one_by_one = {.vertex1 = place1, .fragment1 = paint1};

static void draw(rhw_context *context, const struct rhw_program *functions, enum rhw_qualifier qualifier,
                 rhw_texture color, rhw_texture depth)
{
    struct rhw_pipeline_def def = rhw_pipeline_def_default();
    def.program = *functions;
    def.program.varyings[0] = (struct rhw_varying){.components = 3, .qualifier = qualifier};
    def.program.varying_count = 1;
    def.attributes[0] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, camera)};
    def.attributes[1] = (struct rhw_attribute){RHW_VERTEX_FLOAT3, 0, offsetof(struct corner, color)};
    def.attribute_count = 2;
    def.buffers[0].stride = sizeof(struct corner);
    def.buffer_count = 1;
    def.targets[0].format = rhw_texture_format(context, color);
    def.depth_test = true;
    rhw_pipeline pipeline;
    must(rhw_pipeline_create(context, &def, &pipeline), "pipeline");
    const rhw_buffer corners = picture_vertices(context, triangle, sizeof triangle);

    struct rhw_pass_def attachments = rhw_pass_def_default();
    attachments.colors[0].texture = color;
    attachments.depth.enabled = true;
    attachments.depth.texture = depth;
    rhw_pass pass;
    must(rhw_pass_begin(context, &attachments, &pass), "pass");
    rhw_pass_set_pipeline(context, pass, pipeline);
    rhw_pass_set_vertex_buffer(context, pass, 0, corners, 0);
    rhw_pass_draw(context, pass, 0, 3, 0, 1);
    must(rhw_pass_end(context, pass, NULL), "pass");
    rhw_buffer_destroy(context, corners);
    rhw_pipeline_destroy(context, pipeline);
}

static void write_depth(rhw_context *context, rhw_texture depth, const char *directory)
{
    static float values[SIZE * SIZE];
    static uint8_t grey[SIZE * SIZE][4];
    rhw_texture_read(context, depth, 0, values, 0);
    for (int i = 0; i < SIZE * SIZE; i++) {
        memset(grey[i], (int)(values[i] * 255 + 0.5f), 4);
    }
    picture_write_png(directory, "01_triangle_depth.png", SIZE, SIZE, grey[0]);
    picture_write_ppm(directory, "01_triangle_depth.ppm", SIZE, SIZE, grey[0]);
}

static void explain(const uint8_t *naive, const uint8_t *correct)
{
    printf("corner     x    y    z=W      x/z      y/z   column      row\n");
    for (int i = 0; i < 3; i++) {
        const float *p = triangle[i].camera;
        const float x = p[0] / p[2], y = p[1] / p[2];
        printf("  %c     %4g %4g   %4g  %7.4f  %7.4f  %7.3f  %7.3f\n", 'A' + i, (double)p[0], (double)p[1],
               (double)p[2], (double)x, (double)y, (double)((1 + x) / 2 * SIZE),
               (double)((1 + y) / 2 * SIZE));
    }
    const size_t pixel = (size_t)(240 * SIZE + 260) * 4;
    printf("pixel 260, 240: naive %d %d %d, correct %d %d %d: the green corner is nearest and gets more\n",
           naive[pixel], naive[pixel + 1], naive[pixel + 2], correct[pixel], correct[pixel + 1],
           correct[pixel + 2]);
}

int main(int argc, char **argv)
{
    const char *directory = argc > 1 ? argv[1] : ".";
    rhw_context *context = picture_context();
    const rhw_texture color = picture_target(context, RHW_FORMAT_RGBA8_UNORM, SIZE, SIZE, 1);
    const rhw_texture depth = picture_target(context, RHW_FORMAT_D32_FLOAT, SIZE, SIZE, 1);

    draw(context, &by_lanes, RHW_NOPERSPECTIVE, color, depth);
    uint8_t *naive = picture_read(context, color, 0);
    draw(context, &by_lanes, RHW_SMOOTH, color, depth);
    uint8_t *correct = picture_read(context, color, 0);
    draw(context, &one_by_one, RHW_SMOOTH, color, depth);
    uint8_t *again = picture_read(context, color, 0);

    explain(naive, correct);
    picture_write_png(directory, "01_triangle_naive.png", SIZE, SIZE, naive);
    picture_write_ppm(directory, "01_triangle_naive.ppm", SIZE, SIZE, naive);
    picture_write_png(directory, "01_triangle.png", SIZE, SIZE, correct);
    picture_write_ppm(directory, "01_triangle.ppm", SIZE, SIZE, correct);
    write_depth(context, depth, directory);

    const bool same = memcmp(correct, again, (size_t)SIZE * SIZE * 4) == 0;
    printf("8 lanes at once and one fragment at a time: %s\n", same ? "the same bytes" : "DIFFERENT");
    free(naive);
    free(correct);
    free(again);
    rhw_context_destroy(context);
    return same ? 0 : 1;
}
